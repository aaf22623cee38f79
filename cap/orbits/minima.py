"""The times of the clock at which Lemma C cuts a flight, once for a system.

Let (L + λ) h = a cos wt + b sin wt + c with numbers a, b, c.  Then e^(λt) h has local minima only
where this comes from negative to positive: with R = |(a, b)| > |c| and (a, b) = R (cos p, sin p),
at wt = p - arccos(-c/R) modulo 2 π; nowhere if R < |c|.  Between two such times e^(λt) h rises, and
then falls, so it is nowhere smaller than at both ends.  Positive parameters that divide a, b and c
are left out.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.orbits.numbers import Balls
from cap.sets.interval import Ball
from cap.system.exponential import number
from cap.system.lemmas import Clocked, Lemma, clock_part
from cap.system.polynomial import Polynomial


class Minimum(NamedTuple):
    """An enclosure of a time, modulo the period, and of the clock then."""

    time: Ball
    cos: Ball
    sin: Ball


def minima(lemma: Lemma, of: Balls) -> list[Minimum] | None:
    """Return all times of minima; None if Lemma C does not hold with numbers a, b, c."""
    part = clock_part(lemma) if isinstance(lemma, Clocked) and lemma.order == 1 else None
    divided = _divided(part, of.values) if part else []
    if not divided or not all(q.is_number for q in divided):
        return None
    a, b, c = map(number, divided)
    size = (a * a + b * b).sqrt()
    if size < abs(c):
        return []
    if not size > abs(c):
        return None
    time = (Ball.atan2(b, a) - (-c / size).acos()) * of.period / (2 * Ball.pi())
    return [Minimum(time, *of.clock(time))]


def _divided(part: Sequence[Polynomial], values: Mapping[str, Ball]) -> list[Polynomial]:
    """Return polynomials without the positive parameters that divide all of them."""
    for name, value in values.items():
        every = [dict(monomial).get(name, 0) for q in part for monomial in q.terms]
        if value > 0 and every and min(every) > 0:
            part = [q * Polynomial({((name, -min(every)),): Fraction(1)}) for q in part]
    return [*part]
