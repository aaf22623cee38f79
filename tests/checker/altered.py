"""Certificates in bytes, with one part changed, verified or rejected: helpers of the tests."""

from __future__ import annotations

import copy
import json

import pytest

from cap.checker.rejection import Rejected
from cap.checker.theorem import check


def encode(certificate):
    """Return the bytes of a certificate."""
    return json.dumps(certificate).encode()


def verify(certificate):
    """Check a certificate and return the steps reported."""
    steps = []
    check(encode(certificate), steps.append)
    return steps


def rejected(certificate, why):
    """Check that a certificate is rejected for this reason."""
    with pytest.raises(Rejected, match=why):
        verify(certificate)


def changed(certificate, *path_and_value):
    """Return a copy with another value at a path, the last argument."""
    *path, last, value = path_and_value
    result = copy.deepcopy(certificate)
    part = result
    for key in path:
        part = part[key]
    part[last] = value
    return result


def decimal(q, places=60):
    """Return a decimal near a rational number."""
    n = round(q * 10**places)
    return ("-" if n < 0 else "") + f"{abs(n) // 10**places}.{abs(n) % 10**places:0{places}d}"
