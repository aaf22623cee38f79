"""Certificates in bytes, with one part changed, verified or rejected: helpers of the tests."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import jsonschema
import pytest

from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check

SMALL_LOSSES = ({"e": "999999999/1000000000"}, {"mu": "1/1000000000"})
"""Of energy: so small that no inequality of a theorem about invariant curves sees them."""

SCHEMA = Path(__file__).parents[2] / "certificates/schema/certificate.schema.json"


def encode(certificate):
    """Return the bytes of a certificate."""
    return json.dumps(certificate).encode()


@cache
def schema():
    """Return the JSON Schema of certificates, which is one itself: that is looked at once."""
    described = json.loads(SCHEMA.read_text("utf-8"))
    kind = jsonschema.validators.validator_for(described)
    kind.check_schema(described)
    return kind(described)


@cache
def schema_of(theorem):
    """Return what the JSON Schema says of one theorem: all others refuse its name."""
    parts = schema().schema["$defs"]
    for one in schema().schema["oneOf"]:
        name = one["$ref"].removeprefix("#/$defs/")
        assert parts[name]["properties"]["theorem"] == {"const": name}
    return schema().evolve(schema=parts[theorem])


def fits_the_schema(certificate):
    """Check that the JSON Schema describes a certificate, and refuses one field more or less."""
    described = schema_of(certificate["theorem"])
    described.validate(certificate)
    for part in ("parameters", "claims", "hints"):
        fields = certificate[part]
        for wrong in (dict(list(fields.items())[1:]), fields | {"extra": "1"}):
            assert not described.is_valid(certificate | {part: wrong})


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
    result = json.loads(encode(certificate))
    part = result
    for key in path:
        part = part[key]
    part[last] = value
    return result


def leaves(value, path=()):
    """Give the path and the value of every enclosure in a JSON value."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, (*path, key))
    elif isinstance(value, list) and not (len(value) == 2 and isinstance(value[0], str)):
        for n, part in enumerate(value):
            yield from leaves(part, (*path, n))
    elif isinstance(value, list):
        yield path, value


def decimal(q, places=60):
    """Return a decimal near a rational number."""
    n = round(q * 10**places)
    return ("-" if n < 0 else "") + f"{abs(n) // 10**places}.{abs(n) % 10**places:0{places}d}"
