"""Jets of the release map: Taylor expansions in the place of the release, through the stick.

Every event time but that of a release is an analytic function of the place, because it is a
transverse zero of x - wall or of v; a release is at a known time.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from cap.errors import NotProved
from cap.flow.event import E, Event
from cap.flow.model import Flight, Moment, Oscillator
from cap.sets.interval import Ball
from cap.sets.jet import Jet, Space

SIDES = {"right": 1, "left": -1}


def release_jet(osc: Oscillator[Any], x: E, events: Sequence[Event[E]], order: int) -> Jet:
    """Return the jet of G at every place of a set: coefficients enclose the Taylor coefficients.

    The set is a ball, or that of the values of a Taylor model, which the coefficients then are,
    too.  ``events`` are those up to the next release, as `passage` proves them for the set.
    """
    (place,) = Jet.variables((x,), order)
    return followed(partial(_lifted, osc), place, events)


Lifted = Callable[[Space], Oscillator[Any]]
"""The oscillator for jets of a space."""


def followed(lifted: Lifted, place: Jet, events: Sequence[Event[E]]) -> Jet:
    """Return the jet of G of a place; what the oscillator depends on may be variables, too."""
    space = place.space
    osc = lifted(space)
    begin = Moment(*(_jet(q, space) for q in osc.slow(1, 0)))
    flight = osc.launch(1, begin, place, Ball(0))
    for event in events:
        verb, _, side = event.word.partition(" ")
        if verb == "release":
            return place if side == "right" else osc.l + osc.r - place
        moment = osc.moment(_time_jet(lifted, flight, event, space))
        if verb == "hit":
            flight = osc.reflect(flight, moment, osc.velocity(flight, moment))
        elif verb in ("turn", "stick"):
            place = osc.position(flight, moment)
            if verb == "turn":
                flight = osc.launch(SIDES[side], moment, place, Ball(0))
        else:
            raise NotProved("release map", f"after a {verb} there is no jet of it")
    raise NotProved("release map", "the events do not end with a release")


def _time_jet(lifted: Lifted, flight: Flight[Any], event: Event[Any], space: Space) -> Jet:
    """Return the jet of the time of a hit or of a stop, of which the value is known.

    Newton's iteration on jets: an iterate that is right to order k gives one right to 2k + 1.  The
    residual at order zero is exactly zero, because the value encloses the true times.
    """
    known, t = 0, Jet.constant(event.time, space.truncated(0))
    while known < space.order:
        known = min(2 * known + 1, space.order)
        t = t.extended(known)
        near = Flight(flight.s, *(_cut(q, known) for q in (flight.t, flight.x, flight.v)))
        osc = lifted(t.space)
        gap, rate = _crossing(osc, near, osc.moment(t), hit=event.word.startswith("hit"))
        t = t - gap.above(0) / rate
    return t


def _crossing(
    osc: Oscillator[Any], flight: Flight[Any], moment: Moment[Any], *, hit: bool
) -> tuple[Jet, Jet]:
    """Return what vanishes at an event, and its derivative by time."""
    velocity = osc.velocity(flight, moment)
    if hit:
        return osc.position(flight, moment) - osc.wall(flight.s), velocity
    return velocity, osc.acceleration(flight, moment)


def _lifted(osc: Oscillator[Any], space: Space) -> Oscillator[Any]:
    """Return the oscillator for jets; f may be a Taylor model, which does not mix with them."""
    return replace(osc, f=Jet.constant(osc.f, space))


def _jet(q: Any, space: Space) -> Jet:
    return q if isinstance(q, Jet) else Jet.constant(q, space)


def _cut(q: Any, order: int) -> Any:
    return q.truncated(order) if isinstance(q, Jet) else q
