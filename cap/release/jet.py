"""Jets of the release map: Taylor expansions in the place of the release, through the stick.

Every event time but that of a release is an analytic function of the place, because it is a
transverse zero of x - wall or of v; a release is at a known time.
"""

from collections.abc import Sequence
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
    flight = osc.launch(1, osc.slow(1, 0), place, Ball(0))
    for event in events:
        verb, _, side = event.word.partition(" ")
        if verb == "release":
            return place if side == "right" else osc.l + osc.r - place
        moment = osc.moment(_time_jet(osc, flight, event, order))
        if verb == "hit":
            flight = osc.reflect(flight, moment, osc.velocity(flight, moment))
        elif verb in ("turn", "stick"):
            place = osc.position(flight, moment)
            if verb == "turn":
                flight = osc.launch(SIDES[side], moment, place, Ball(0))
        else:
            raise NotProved("release map", "after a capture it is constant")
    raise NotProved("release map", "the events do not end with a release")


def _time_jet(osc: Oscillator[Any], flight: Flight[Any], event: Event[Any], order: int) -> Jet:
    """Return the jet of the time of a hit or of a stop, of which the value is known.

    Newton's iteration on jets: an iterate that is right to order k gives one right to 2k + 1.  The
    residual at order zero is exactly zero, because the value encloses the true times.
    """
    known, t = 0, Jet.constant(event.time, Space(1, 0))
    while known < order:
        known = min(2 * known + 1, order)
        t = t.extended(known)
        near = Flight(flight.s, *(_cut(q, known) for q in (flight.t, flight.x, flight.v)))
        moment = osc.moment(t)
        gap, rate = _crossing(osc, near, moment, hit=event.word.startswith("hit"))
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


def _cut(q: Any, order: int) -> Any:
    return q.truncated(order) if isinstance(q, Jet) else q
