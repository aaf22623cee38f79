"""Certificates of periodic orbits of four systems, each proved once."""

from copy import deepcopy
from fractions import Fraction
from functools import cache

import models
import pytest
from orbits.test_periodic import GUESS, HITS, STOP, TABLE, two_masses

from cap.certificate.writer import dumps
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check
from cap.orbits.itinerary import Itinerary
from cap.parameters import PAPER
from cap.proofs.contacts import prove
from cap.system.friction import oscillator

SPRING = models.spring(Fraction(27, 10), Fraction(9, 10), Fraction(1, 20), Fraction(1, 10))
__all__ = ["CASES", "SPRING", "STOP", "certificate", "rejected"]

CASES = {
    "ball": lambda: (Itinerary(models.ball(), TABLE), [0.51, 0.58, -3.14]),
    "spring": lambda: (Itinerary(SPRING, STOP), [1.0, 0.1, 1.0]),
    "elliptic": lambda: (Itinerary(oscillator(PAPER), HITS), GUESS),
    "two masses": lambda: two_masses()[1:],
}


def certificate(name):
    """Return a certificate, which may be changed."""
    return deepcopy(_proved(name))


@cache
def _proved(name):
    return prove(*CASES[name]())


def rejected(given, reason):
    """Check that a certificate is rejected for this reason."""
    with pytest.raises(Rejected, match=reason):
        check(dumps(given).encode(), lambda _: None)
