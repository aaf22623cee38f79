"""Rotation numbers: quadratic irrationals in (0, 1), as continued fractions.

alpha = [0; a_1, a_2, ...], from some place on periodic.  With A_n = [a_n; a_(n+1), ...], q_0 = 1,
q_(-1) = 0 and q_n = a_n q_(n-1) + q_(n-2),

    |q_n alpha - p_n| = 1/(q_n A_(n+1) + q_(n-1)),

and dist(k alpha, Z) is not smaller for 0 < k < q_(n+1) (Khinchin, Continued Fractions, Theorem 17).
So for q_n <= k < q_(n+1)

    k dist(k alpha, Z) >= 1/(A_(n+1) + q_(n-1)/q_n).

After the head, A_(n+1) takes as many values as the period is long, and q_(n-1)/q_n <= 1.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import chain, cycle, islice

from cap.checker.kernel.interval import Interval

AHEAD = 40


def quotients(head: list[int], period: list[int]) -> Iterator[int]:
    """Yield a_1, a_2, ..."""
    return chain(head, cycle(period))


def above(given: Iterator[int]) -> Fraction:
    """Return a number above [a; b, c, ...]: the greater of two convergents in a row."""
    *first, last = islice(given, AHEAD)
    return max(finite(first, last), finite(first, last + 1))


def finite(first: list[int], last: int) -> Fraction:
    """Return [a; b, ..., last]."""
    value = Fraction(last)
    for a in reversed(first):
        value = a + 1 / value
    return value


def constant(head: list[int], period: list[int]) -> Fraction:
    """Return gamma with dist(k alpha, Z) >= gamma/k for all k > 0."""
    q_before, q, bounds = 0, 1, []
    for n, a in enumerate(head):
        complete = above(quotients(head[n:], period))
        bounds.append(1 / (complete + Fraction(q_before, q)))
        q_before, q = q, a * q + q_before
    tails = (above(quotients(period[n:], period)) for n in range(len(period)))
    return min([*bounds, *(1 / (tail + 1) for tail in tails)])


def value(head: list[int], period: list[int], bits: int) -> Interval:
    """Return an enclosure of alpha: it lies between two convergents in a row."""
    p_before, q_before, p, q = 1, 0, 0, 1
    given = quotients(head, period)
    while q_before * q < 1 << bits:
        a = next(given)
        p_before, q_before, p, q = p, q, a * p + p_before, a * q + q_before
    low, high = sorted((Fraction(p_before, q_before), Fraction(p, q)))
    return Interval.enclosing(low, high, bits)
