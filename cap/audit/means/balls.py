"""Numbers of the paper against enclosures."""

from contextlib import AbstractContextManager
from decimal import Decimal
from fractions import Fraction

from cap.audit.comparison import unit
from cap.audit.means.need import made
from cap.audit.verdict import Outcome
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 120


def precisely(bits: int = BITS) -> AbstractContextManager[None]:
    """Compute with many digits."""
    return interval.workprec(bits)


def between(ball: Ball, places: int = 10) -> str:
    """Return an enclosure in words: [lower, upper], rounded outwards."""
    lower, upper = interval.outward(ball, places)
    return lower if lower == upper else f"[{lower}, {upper}]"


def below(q: Fraction, places: int) -> str:
    """Return a number, rounded down."""
    return interval.decimal(q * 10**places // 1 / Fraction(10**places), places)


def above(q: Fraction, places: int) -> str:
    """Return a number, rounded up."""
    return interval.decimal(-(-q * 10**places // 1) / Fraction(10**places), places)


def pair(claimed: Enclosure, places: int = 10) -> str:
    """Return the enclosure that a certificate claims, in words, rounded outwards."""
    low, high = below(claimed.lower, places), above(claimed.upper, places)
    return low if low == high else f"[{low}, {high}]"


def inner(claimed: Enclosure, places: int) -> str:
    """Return a range in which something holds, in words, rounded inwards."""
    return f"[{above(claimed.lower, places)}, {below(claimed.upper, places)}]"


def compared(printed: str, value: Ball) -> Outcome:
    """Return the verdict on a printed decimal: what is found, rounded to its last digit, or not.

    If it is farther away, but by less than a unit of this digit, it is imprecise.
    """
    made()
    number = Decimal(printed)
    with precisely():
        away = abs(value - interval.ball(Fraction(number)))
        units = away / interval.ball(Fraction(unit(number)))
        if 2 * units <= 1:
            return Outcome.CONFIRMED
        if 2 * units > 1 and units <= 1:
            return Outcome.IMPRECISE
        if units > 1:
            return Outcome.CORRECTED
    raise NotProved("number", f"whether {printed} is right is undecided", {"value": value})
