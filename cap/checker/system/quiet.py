"""Lemma B: a guard stays positive on a leg, for given cuts; nothing is searched.

Let h be a guard along the flights of a mode from t_0 to t_1, each known in an interval, and cut the
time from the least t_0 to the greatest t_1 into pieces.  Here h is what the formula of the flights
has, beyond their ends, too.

1. *In the middle.*  On a piece P with a point m in it, h(t) = h(m) + (t - m) L h(s) for some s in
   P: h is positive on P, if h(m) + (P - m) L h(P) is.
2. *At the start.*  If h, L h, ..., L^(n-1) h vanish at t_0, n > 0, by Taylor's formula h(t) is the
   integral of (t - s)^(n-1)/(n-1)! L^n h(s) from t_0 to t: it is positive after t_0 on the first
   piece, if L^n h is positive on it.
3. *At the end.*  If h, ..., L^(n-1) h vanish at t_1, the same backward in time: h is positive
   before t_1 on the last piece, if (-1)^n L^n h is positive on it.

So h > 0 strictly between t_0 and t_1, and at those ends where it does not vanish.  If it is so for
all guards of the mode, the flights are orbits of the system until t_1.

*What vanishes after an event.*  Where the guard g comes to zero, the state z becomes R(z).  If h(R)
is a constant times g, as polynomials, h vanishes after the event; and so for L h, and so on.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Protocol

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.model import Guard, Model
from cap.checker.system.polynomial import Polynomial


class Flights(Protocol):
    """Flights of a mode, each from a time in the interval ``start`` on."""

    @property
    def model(self) -> Model:
        """The system."""

    @property
    def mode(self) -> str:
        """The mode."""

    @property
    def start(self) -> Interval:
        """The times at which they begin."""

    def over(self, g: Polynomial, t: Interval) -> Interval:
        """Return a polynomial in the state at all times of an interval, for all of the flights."""


def stays_positive(
    flights: Flights,
    h: Polynomial,
    end: Interval,
    cuts: Sequence[Fraction],
    zeros: tuple[int, int] = (0, 0),
) -> None:
    """Prove that a guard stays positive until each flight ends, at a time in ``end``.

    So many of h, L h, ... vanish at the start and at the end, as ``zeros`` says.
    """
    first, last = zeros
    rates = [h]
    for _ in range(max(1, first, last)):
        rates.append(flights.model.lie(flights.mode, rates[-1]))
    pieces = _pieces(flights.start, end, cuts)
    need(len(pieces) >= bool(first) + bool(last), "a guard is 0 at both ends of a piece")
    if first:
        leaves = flights.over(rates[first], pieces.pop(0)).is_positive()
        need(leaves, "a guard may vanish again just after the start")
    if last:
        comes = (flights.over(rates[last], pieces.pop()) * (-1) ** last).is_positive()
        need(comes, "a guard may vanish already before the end")
    for piece in pieces:
        m = piece.midpoint()
        value = flights.over(h, m) + flights.over(rates[1], piece) * (piece - m)
        need(value.is_positive(), f"a guard may vanish near {float(m.lower):.6g}")


def _pieces(start: Interval, end: Interval, cuts: Sequence[Fraction]) -> list[Interval]:
    """Return the pieces, which abut."""
    ends = [start.lower, *cuts, end.upper]
    need(all(a < b for a, b in pairwise(ends)), "the cuts of a leg are not in order")
    return [Interval.enclosing(a, b, start.bits) for a, b in pairwise(ends)]


def zeros_after(model: Model, mode: str, h: Polynomial, event: Guard, most: int = 2) -> int:
    """Return how many of h, L h, ..., at most so many, vanish in a mode just after an event."""
    for n in range(most):
        if not _is_multiple(h.substituted(event.reset), event.value):
            return n
        h = model.lie(mode, h)
    return most


def _is_multiple(h: Polynomial, g: Polynomial) -> bool:
    """Return whether h is a constant times g."""
    if not h.terms:
        return True
    monomial, c = next(iter(h.terms.items()))
    divisor = g.terms.get(monomial)
    return divisor is not None and h == g * (c / divisor)
