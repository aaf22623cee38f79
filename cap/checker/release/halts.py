"""Halts: stops at about the time at which the force becomes too weak for a turn.

A flight of direction -s ends at the time tau, between the walls.  At t_b = (2 pi k + theta)/w for s
= 1, half a period later for s = -1, s F cos wt decreases through f.  If tau < t_b, not too long
before, the mass turns to the side s, moves on for a short time and sticks; if tau >= t_b it sticks
at once.  Let g(t) = s F cos wt - f, e >= t_b - tau, e >= 0, and w e < min(2 theta, pi/2 - theta).

*The excursion.*  On [tau, t_b] g >= 0; up to t_b + e, s cos wt > 0, so g is concave, and below its
tangent at t_b, with the slope -K, K = w sqrt(F^2 - f^2).  The speed u to the side s has u' <= g, so
up to t_b it is at most K e^2/2; and as the integral of g from tau to t_b + (t_b - tau) is at most
0, u vanishes before t_b + e.  There |F cos wt| < f: the mass sticks.  It has moved by D,

    0 <= D <= (2 e) (K e^2/2) = K e^3.

*Derivatives.*  At a fixed time, du/dtau lies in [-g(tau), 0], g(tau) <= K e, and du/df in
[-(t - tau), 0]; D is the integral of u, which is 0 at both ends: dD/dtau lies in [-2 K e^2, 0],
dD/df in [-2 e^2, 0].  Both tend to 0 with t_b - tau, and are 0 for tau >= t_b: D is continuously
differentiable in tau and f.  So a place at which one halts is known with its first derivatives.
The rest begins after t_b and before max(tau, t_b + e), less than half a period before the release
to the side -s, and more than that before one to the side s.
"""

from __future__ import annotations

from typing import Any

from cap.checker.flow.mechanics import Ends, Flight
from cap.checker.flow.stops import SIDES, Event, Rest, stop
from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, Power, raised
from cap.checker.kernel.rejection import Rejected, need

HALTS = ("halt right", "halt left")


def halt(M: Any, flight: object, word: str, window: Ends) -> tuple[Event, Rest]:
    """Prove that the flight ends with a halt, to this side if with a turn."""
    side = SIDES[word.split()[1]]
    if not isinstance(flight, Flight):
        raise Rejected("the mass rests, and no release follows")
    need(flight.s == -side, "a halt to the side to which the mass moves")
    event, x = stop(M, flight, word, window)
    tau, half_turn = event.moment.t.value, pi(M.bits)
    theta = M.theta.value
    ends = [m.t.value + theta * 2 / M.omega for m in M.minima[side]]
    near = [t for t in ends if (t - tau).magnitude().hi < (half_turn / M.omega / 2).lo]
    need(len(near) == 1, "no halt is near a time at which the force becomes too weak")
    late = near[0]
    room = Interval(0, max(0, late.hi - tau.lo), M.bits)  # it contains e
    turned = room * M.omega
    short = turned.is_before(theta * 2) and turned.is_before(half_turn / 2 - theta)
    need(short, "the mass may turn too long before the force becomes too weak")
    later = late + half_turn / M.omega - theta * 2 / M.omega
    need(tau.is_before(later), "the mass may halt after the end of an arc")
    place = moved(M, x, event.moment.t, room, side)
    need(M.is_between_walls(place.value), "the mass may reach the wall after a halt")
    since = Interval(max(tau.lo, late.lo), max(tau.hi, (late + room).hi), M.bits)
    return event, Rest(place, since, half_turn / M.omega, (-side,))


def moved(M: Any, x: Centred, tau: Centred, room: Interval, side: int) -> Centred:
    """Return the place after a halt, with its first derivatives."""
    zero, square = room.integer(0), room.square()
    K = M.omega * (M.F.square() - M.f.square()).sqrt()
    far = K * square * room
    excursion = Interval(0, far.hi, M.bits)
    by_time = Interval((-(K * square * 2)).lo, 0, M.bits)
    by_f = Interval(-(square * 2).hi, 0, M.bits)
    origin: Power = (0,) * len(M.offsets)
    terms = {origin: excursion * side}
    for power in raised(origin):
        f = M.friction.box.coefficients.get(power, zero)
        t = tau.box.coefficients.get(power, zero)
        terms[power] = (by_time * t + by_f * f) * side
    box = x.box.truncated(1) + Jet(1, terms)
    centre = x.centre.truncated(0) + Jet(0, {origin: excursion * side})
    return Centred(centre, box, M.offsets)
