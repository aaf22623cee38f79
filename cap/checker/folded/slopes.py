"""The derivative of a flight by a parameter of its start, for all orbits of a region.

At a fixed time of the start, with dA and dB the derivatives of A and B by the parameter (`events`):

    w = d dA + dB,     dA' = dA - (2 cos T/s) w,               dB' = w - d' dA'      after a hit,
                       dA' = dA (a - cos T)/(cos T + a),       dB' = -w - d' dA'     after a turn,

d = T - ref and d' = T - pi - ref'.  w is the derivative of p at the time T, and at a stop that of
the place of the stop.  All are models in X and Y of what they are for the orbits, errors included.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.folded.events import Event
from cap.checker.folded.motion import Direction
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.polynomials import Model


class Slopes(NamedTuple):
    """The derivatives of A and B by a parameter of the start: `BEGIN` by its place."""

    A: Model
    B: Model


BEGIN = Slopes(q.model(), q.model(one=1.0))


def of_place(g: Slopes, e: Event) -> Model:
    """Return the derivative of p at the time of an event."""
    return q.total(q.product(q.widened(e.D, e.e_all), g.A), g.B) if any(g.A) else g.B


def after(y: Direction, g: Slopes, e: Event) -> Slopes:
    """Return the derivatives after an event."""
    w, cos = of_place(g, e), q.widened(e.cos, e.e_all)
    later = y.folded(e.near, q.widened(e.d, e.e_all))[1]
    if e.p is None:
        A = q.total(g.A, q.product(q.product(q.scaled(cos, -2.0), q.inverse(e.s)), w))
    else:
        w, least = q.scaled(w, -1.0), q.inverse(q.moved(cos, y.a, y.a_error))
        A = q.product(g.A, q.product(q.moved(q.scaled(cos, -1.0), y.a, y.a_error), least))
    return Slopes(A, q.total(w, q.scaled(q.product(later, A), -1.0)))
