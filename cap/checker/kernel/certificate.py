"""The form of a certificate: exactly the fields of its theorem's tables."""

from __future__ import annotations

from cap.checker.kernel.reading import MAX_BYTES, parsed, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Whole, matched, tabled
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems import NAMES, load

__all__ = ["MAX_BYTES", "Certificate", "read"]

DIGITS = Whole(6, 1000)


def read(data: bytes) -> Certificate:
    """Return the certificate in these bytes; anything that is not exactly of its form rejects."""
    fields = matched(parsed(data), _FIELDS, "certificate")
    need(fields["format"] == "cap-certificate/1", "the format is not cap-certificate/1")
    name = fields["theorem"]
    need(name in NAMES, f"the theorem is none of: {', '.join(NAMES)}")
    theorem = load(name)
    need(isinstance(fields["provenance"], dict), "provenance is not an object")
    p = theorem.parameters(matched(fields["parameters"], theorem.PARAMETERS, "parameters"))
    hints = tabled(fields["hints"], theorem.HINTS, "hints")
    claims = tabled(fields["claims"], theorem.CLAIMS, "claims")
    need(fields["cites"] == theorem.cited(claims), "cites is not the checker's own list")
    theorem.limit(hints, claims)
    return Certificate(name, p, fields["digits"], claims, hints)


def _anything(value: object, _: str) -> object:
    """Return the value as it is."""
    return value


_FIELDS = {"format": text, "theorem": text, "digits": DIGITS} | dict.fromkeys(
    ("parameters", "claims", "hints", "cites", "provenance"), _anything
)
