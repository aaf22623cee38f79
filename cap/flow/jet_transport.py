"""Jet transport: Taylor expansions of the stroboscopic map along non-sticking orbits."""

from typing import Any

from cap.flow.event import Event
from cap.flow.model import Flight, Moment, Oscillator
from cap.flow.strobe import Orbit
from cap.sets.interval import Ball, Box
from cap.sets.jet import Jet


def strobe_jet(osc: Oscillator[Any], box: Box, orbit: Orbit[Ball], order: int) -> tuple[Jet, Jet]:
    """Return jets of Φ at every state of ``box``: coefficients enclose the Taylor coefficients.

    ``orbit`` is ``strobe(osc, box, ...)``, with hits only: it proves that the hit times are
    analytic functions of the state on ``box`` and encloses them.  The jets are in (δx, δv).
    """
    x, v = Jet.variables(box, order)
    return transported(osc, orbit, x, v)


def transported(osc: Oscillator[Any], orbit: Orbit[Ball], x: Jet, v: Jet) -> tuple[Jet, Jet]:
    """Return jets of Φ∘z, where (x, v) are those of z, in any variables, with values in the box.

    ``orbit`` is ``strobe(osc, box, ...)``, with hits only, as in `strobe_jet`.
    """
    if orbit.events != orbit.hits:
        raise ValueError("jets are transported through hits only")
    flight = osc.launch(orbit.s, Moment(Ball(0), Ball(0), Ball(1)), x, v)
    for hit in orbit.events:
        moment = _hit_moment(osc, flight, hit)
        flight = osc.reflect(flight, moment, osc.velocity(flight, moment))
    end = Moment(osc.T, Ball(0), Ball(1))
    return osc.position(flight, end), osc.velocity(flight, end)


def _hit_moment(osc: Oscillator[Any], flight: Flight[Any], hit: Event[Ball]) -> Moment[Any]:
    """Return the jets of the hit time, whose value is known, and of its sine and cosine.

    Newton's iteration on jets.  If t is right to order k, then the gap x(t) - wall has exactly no
    terms up to there, as the coefficients of t enclose the true ones; so those of v(t) matter to
    order k only, and t - gap/v(t) is right to order 2k + 1.
    """
    known, order, moment = 0, flight.v.space.order, osc.moment(hit.time)
    while known < order:
        velocity = osc.velocity(_truncated(flight, known), moment)
        reached = min(2 * known + 1, order)
        if known:
            moment = osc.moment(moment.t.extended(reached))
        gap = osc.position(_truncated(flight, reached), moment) - osc.wall(flight.s)
        moment = _earlier(osc, moment, _quotient(gap.above(known), velocity))
        known = reached
    return moment


def _truncated(flight: Flight[Any], order: int) -> Flight[Any]:
    """Return the flight to an order, in scalars if that is 0."""

    def terms(q: Any) -> Any:
        if not isinstance(q, Jet):
            return q
        return q.truncated(order) if order else q.coefficients[0]

    return Flight(flight.s, terms(flight.t), terms(flight.x), terms(flight.v))


def _quotient(gap: Jet, velocity: Any) -> Any:
    """Return gap/velocity, whose terms need those of ``velocity`` only that are given."""
    if isinstance(velocity, Jet):
        return gap * velocity.reciprocal().extended(gap.space.order)
    return gap / velocity


def _earlier(osc: Oscillator[Any], moment: Moment[Any], shift: Any) -> Moment[Any]:
    """Return the moment at t - c, for a ``shift`` c whose square vanishes to the order here."""
    t, sin, cos = moment
    angle = osc.omega * shift
    return Moment(t - shift, sin - angle * cos, cos + angle * sin)
