"""Compiled: the derivative of a flight of `cap.areas.folded.backward` in the place where it begins.

That is the derivative of A and B in q at a fixed time t of the start; for all flights, also those
with errors, it is enclosed by models in X and Y.  See `cap.areas.folded.mirrored` for that of an
event: in

    w = d dA + dB,      dA' = dA - (2 cos T/s) w,               dB' = w - d' dA'    for a hit,
                        dA' = dA (a - cos T)/(cos T + a),       dB' = -w - d' dA'   for a turn,

w is the derivative of the place at the time of the event; at a stop also that of the place there.
"""

from typing import NamedTuple

from cap.areas.folded.backward import ROUND, Constants, Event, Flight, speed
from cap.areas.folded.polynomials import (
    Model,
    constant,
    inverse,
    moved,
    product,
    scaled,
    total,
    widened,
)
from cap.sets.compiled import kernel

FOLDED = 64 * ROUND  # more than what folding costs a time


class Slopes(NamedTuple):
    """The derivatives of A and B in q."""

    A: Model
    B: Model


@kernel
def at_start() -> Slopes:
    """Return the derivatives from rest."""
    return Slopes(constant(0.0, 0.0), constant(1.0, 0.0))


@kernel
def by_place(g: Slopes, event: Event) -> Model:
    """Return the derivative of the place at the time of an event, at a fixed time."""
    return total(product(widened(event.D, event.all), g.A), g.B)


@kernel
def after_the_hit(y: Constants, f: Flight, g: Slopes, event: Event) -> Slopes:
    """Return the derivatives after a hit; their errors are NaN if the speed may vanish."""
    w = by_place(g, event)
    s = widened(speed(y, f.A, event.D, event.sin), f.errors[0] + 2 * event.all)
    rate = product(scaled(widened(event.cos, event.all), -2.0, 0.0), inverse(s))
    A = total(g.A, product(rate, w))
    return Slopes(A, _shifted(event, A, w))


@kernel
def after_the_turn(y: Constants, g: Slopes, event: Event) -> Slopes:
    """Return the derivatives after a turn; their errors are NaN if s' may vanish."""
    cos = widened(event.cos, event.all)
    back = moved(scaled(cos, -1.0, 0.0), y.a, y.a_error)
    A = product(g.A, product(back, inverse(moved(cos, y.a, y.a_error))))
    return Slopes(A, _shifted(event, A, scaled(by_place(g, event), -1.0, 0.0)))


@kernel
def _shifted(event: Event, A: Model, w: Model) -> Model:
    """Return w - d' A."""
    later = widened(event.d, event.all + event.lag + FOLDED)
    return total(w, scaled(product(later, A), -1.0, 0.0))
