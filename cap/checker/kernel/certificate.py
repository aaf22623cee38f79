"""The form of a certificate: exactly the fields of its theorem's tables."""

from __future__ import annotations

from typing import Any

from cap.checker.kernel.reading import MAX_BYTES, parsed, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Whole, Word, columns, matched
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems import NAMES, load

__all__ = ["MAX_BYTES", "Certificate", "read"]


def read(data: bytes) -> Certificate:
    """Return the certificate in these bytes; anything that is not exactly of its form rejects."""
    fields = matched(parsed(data), FIELDS, "certificate")
    theorem = load(fields["theorem"])
    p = theorem.parameters(matched(fields["parameters"], theorem.PARAMETERS, "parameters"))
    hints = matched(fields["hints"], columns(theorem.HINTS), "hints")
    claims = matched(fields["claims"], columns(theorem.CLAIMS), "claims")
    need(fields["cites"] == theorem.cited(claims), "cites is not the checker's own list")
    theorem.limit(hints, claims)
    return Certificate(fields["theorem"], p, fields["digits"], claims, hints)


def _strings(value: Any, where: str) -> dict[str, str]:
    """Return an object of strings."""
    need(isinstance(value, dict), f"{where} is not an object")
    return {key: text(part, f"{where}.{key}") for key, part in value.items()}


FIELDS: dict[str, Any] = {
    "format": Word(["cap-certificate/1"]),
    "theorem": Word(NAMES),
    "digits": Whole(6, 1000),
    "provenance": _strings,
} | dict.fromkeys(("parameters", "claims", "hints", "cites"), lambda value, _: value)
