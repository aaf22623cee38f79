"""Numbers of the paper against enclosures."""

from contextlib import AbstractContextManager
from fractions import Fraction
from numbers import Rational
from typing import Any

from cap.audit.comparison import rounded
from cap.audit.means.need import made
from cap.audit.verdict import Outcome
from cap.checker.kernel.shapes import Enclosure
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 120


def precisely(bits: int = BITS) -> AbstractContextManager[None]:
    """Compute with many digits."""
    return interval.workprec(bits)


def ends(value: Any) -> tuple[Fraction, Fraction]:
    """Return the ends of what a certificate claims, of a ball, or of an exact number."""
    if isinstance(value, Enclosure):
        return value.lower, value.upper
    return (Fraction(value),) * 2 if isinstance(value, Rational) else interval.ends(value)


def below(q: Fraction, places: int) -> str:
    """Return a number, rounded down."""
    return interval.decimal(q * 10**places // 1 / Fraction(10**places), places)


def above(q: Fraction, places: int) -> str:
    """Return a number, rounded up."""
    return interval.decimal(-(-q * 10**places // 1) / Fraction(10**places), places)


def pair(value: Any, places: int = 10) -> str:
    """Return an enclosure in words: [lower, upper], rounded outwards, or a number."""
    lower, upper = ends(value)
    low, high = below(lower, places), above(upper, places)
    return low if low == high else f"[{low}, {high}]"


def inner(value: Any, places: int) -> str:
    """Return a range in which something holds, in words, rounded inwards."""
    lower, upper = ends(value)
    return f"[{above(lower, places)}, {below(upper, places)}]"


def compared(printed: str, value: Ball) -> Outcome:
    """Return the verdict on a printed decimal by an enclosure: see `rounded`."""
    made()
    return rounded(printed, *ends(value))
