"""Numbers of the paper against enclosures."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from decimal import Decimal
from fractions import Fraction

from cap.audit.means.need import made
from cap.audit.verdict import Outcome
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 120
DEEPEST = 60


@contextmanager
def precisely(bits: int = BITS) -> Iterator[None]:
    """Compute with many digits."""
    with interval.workprec(bits):
        yield


def between(ball: Ball, places: int = 10) -> str:
    """Return an enclosure in words: [lower, upper], rounded outwards."""
    lower, upper = interval.outward(ball, places)
    return lower if lower == upper else f"[{lower}, {upper}]"


def pair(claimed: Enclosure, places: int = 10) -> str:
    """Return the enclosure that a certificate claims, in words, rounded outwards."""
    unit = Fraction(1, 10**places)
    low, high = claimed.lower // unit * unit, -(-claimed.upper // unit) * unit
    ends = [interval.decimal(q, places) for q in (low, high)]
    return ends[0] if ends[0] == ends[1] else f"[{ends[0]}, {ends[1]}]"


def inner(claimed: Enclosure, places: int = 6) -> str:
    """Return a range in which something holds, in words, rounded inwards."""
    unit = Fraction(1, 10**places)
    low, high = -(-claimed.lower // unit) * unit, claimed.upper // unit * unit
    return f"[{interval.decimal(low, places)}, {interval.decimal(high, places)}]"


def above(claimed: Enclosure, places: int = 4) -> str:
    """Return a bound from above, rounded up."""
    unit = Fraction(1, 10**places)
    return interval.decimal(-(-claimed.upper // unit) * unit, places)


def below(claimed: Enclosure, places: int = 4) -> str:
    """Return a bound from below, rounded down."""
    unit = Fraction(1, 10**places)
    return interval.decimal(claimed.lower // unit * unit, places)


def compared(printed: str, value: Ball) -> Outcome:
    """Return the verdict on a printed decimal: what is found, rounded to its last digit, or not.

    If it is farther away, but by less than a unit of this digit, it is imprecise.
    """
    made()
    number = Decimal(printed)
    exponent = number.as_tuple().exponent
    last = Fraction(Decimal(1).scaleb(exponent if isinstance(exponent, int) else 0))
    with precisely():
        units = abs(value - interval.ball(Fraction(number))) / interval.ball(last)
        if 2 * units <= 1:
            return Outcome.CONFIRMED
        if 2 * units > 1 and units <= 1:
            return Outcome.IMPRECISE
        if units > 1:
            return Outcome.CORRECTED
    raise NotProved("number", f"whether {printed} is right is undecided", {"value": value})


def roots(
    function: Callable[[Ball], Ball], slope: Callable[[Ball], Ball], low: Ball, high: Ball
) -> list[Ball]:
    """Return disjoint enclosures of all zeros in [low, high], each with one zero, ascending.

    Intervals are bisected until the function has a sign, or is monotone with opposite signs at the
    ends.  Raises `NotProved` if that does not come to an end.
    """
    found: list[Ball] = []
    todo = [(interval.ends(interval.hull(low, high)), 0)]
    while todo:
        (a, b), depth = todo.pop()
        if depth > DEEPEST:
            raise NotProved("roots", "an interval stays undecided", {"near": (float(a), float(b))})
        whole = interval.hull(interval.ball(a), interval.ball(b))
        value, rate = function(whole), slope(whole)
        if value > 0 or value < 0:
            continue
        ends = function(interval.ball(a)), function(interval.ball(b))
        signed = all(end > 0 or end < 0 for end in ends)
        if (rate > 0 or rate < 0) and signed:
            if (ends[0] > 0) is not bool(ends[1] > 0):
                found.append(whole)
            continue
        middle = (a + b) / 2
        todo += [((middle, b), depth + 1), ((a, middle), depth + 1)]
    return found
