"""Jet transport: Taylor expansions of the stroboscopic map along non-sticking orbits."""

from typing import Any

from cap.flow.event import Event
from cap.flow.model import Flight, Moment, Oscillator
from cap.flow.strobe import Orbit
from cap.sets.interval import Ball, Box
from cap.sets.jet import Jet, Space


def strobe_jet(osc: Oscillator[Any], box: Box, orbit: Orbit[Ball], order: int) -> tuple[Jet, Jet]:
    """Return jets of Φ at every state of ``box``: coefficients enclose the Taylor coefficients.

    ``orbit`` is ``strobe(osc, box, ...)``, with hits only: it proves that the hit times are
    analytic functions of the state on ``box`` and encloses them.  The jets are in (δx, δv).
    """
    if orbit.events != orbit.hits:
        raise ValueError("jets are transported through hits only")
    x, v = Jet.variables(box, order)
    flight = osc.launch(orbit.s, Moment(Ball(0), Ball(0), Ball(1)), x, v)
    for hit in orbit.events:
        moment = osc.moment(_hit_time_jet(osc, flight, hit))
        flight = osc.reflect(flight, moment, osc.velocity(flight, moment))
    end = Moment(osc.T, Ball(0), Ball(1))
    return osc.position(flight, end), osc.velocity(flight, end)


def _hit_time_jet(osc: Oscillator[Any], flight: Flight[Any], hit: Event[Ball]) -> Jet:
    """Return the jet of the hit time: it solves x(t) = wall, and its value is known.

    Newton's iteration on jets: an iterate that is right to order k gives one right to 2k + 1.
    The residual at order zero is exactly zero, because the value encloses the true hit times.
    """
    order = flight.v.space.order
    known, t = 0, Jet.constant(hit.time, Space(flight.v.space.variables, 0))
    while known < order:
        known = min(2 * known + 1, order)
        t = t.extended(known)
        constants = (_truncated(q, known) for q in (flight.t, flight.x, flight.v))
        near, moment = Flight(flight.s, *constants), osc.moment(t)
        gap = (osc.position(near, moment) - osc.wall(flight.s)).without_constant()
        t = t - gap / osc.velocity(near, moment)
    return t


def _truncated(q: Any, order: int) -> Any:
    return q.truncated(order) if isinstance(q, Jet) else q
