"""Exact numbers for people."""

from __future__ import annotations

from fractions import Fraction


def decimal(q: Fraction) -> str:
    """Return a number for people: as a decimal, if it is a short one, else as a fraction."""
    places = next((n for n in range(40) if 10**n % q.denominator == 0), 0)
    if q.denominator == 1 or not places:
        return str(q)
    digits = str(abs(q.numerator) * 10**places // q.denominator).zfill(places + 1)
    return f"{'-' if q < 0 else ''}{digits[:-places]}.{digits[-places:]}"
