"""Jets of Φ in impact coordinates: the time t of the right hit and E = u²/2 there, in scaled units.

dE∧dt = dx∧dv, because along the flow dv∧dx - dH∧dt is invariant, H = v²/2 - x (cos t - s α), and x
is constant at a wall.  A flight of sign s from (t, u) takes the time d that solves

    (u - s sin t) d - s (cos(t + d) - cos t) - α d²/2 = ρ,

and ends with the speed u + s (sin(t + d) - sin t) - αd.
"""

from math import factorial
from typing import Any, NamedTuple

from cap.flow.flight import place, velocity
from cap.one_one.closed_form import Orbit
from cap.sets.elementary import sqrt
from cap.sets.jet import Jet, Space


class Hit(NamedTuple):
    """Jets of the delay of a hit after that of the orbit, and of the energy u²/2."""

    delay: Jet
    energy: Jet


def period_jet(orbit: Orbit, order: int) -> tuple[Jet, Jet]:
    """Return the jets (E, t) of Φ at the right hit of ``orbit``, t less its value there."""
    u1, _ = orbit.speeds
    energy, delay = Jet.variables((u1 * u1 / 2, u1 * 0), order)
    hit = Hit(delay, energy)
    first, second = orbit.phases
    hit = _flight(orbit, -1, hit, (first, second), orbit.durations[0])
    hit = _flight(orbit, 1, hit, (second, first), orbit.durations[1])
    return hit.energy, hit.delay


def _flight(orbit: Orbit, s: int, hit: Hit, phases: Any, duration: Any) -> Hit:
    """Return the next hit, given sine and cosine of both times on the orbit, and their distance.

    Newton's iteration: an iterate that is right to order k gives one that is right to 2k + 1.
    """
    order = hit.delay.space.order
    u = sqrt(hit.energy * 2)
    sin, cos = _sin_cos(phases[0], hit.delay)
    rise = u - sin * s
    known, d = 0, Jet.constant(duration, Space(2, 0))
    while known < order:
        known = min(2 * known + 1, order)
        d = d.extended(known)
        later = hit.delay.truncated(known) + d
        sin_end, cos_end = _sin_cos(phases[1], later)
        at, begin = rise.truncated(known), cos.truncated(known) * s
        gap = place(begin, at, d, orbit.alpha / 2, cos_end * s)
        d = d - gap.above(0) / velocity(at, d, orbit.alpha, sin_end * s)
    later = (hit.delay + d).above(0)
    sin_end, _ = _sin_cos(phases[1], later)
    speed = velocity(rise, d, orbit.alpha, sin_end * s)
    return Hit(later, speed * speed / 2)


def _sin_cos(phase: tuple[Any, Any], delay: Jet) -> tuple[Jet, Jet]:
    """Return the jets of sine and cosine of a time, given those of its value."""
    sin, cos = phase
    cycle = (sin, cos, -sin, -cos)
    taylor = [
        [cycle[(k + shift) % 4] / factorial(k) for k in range(delay.space.order + 1)]
        for shift in (0, 1)
    ]
    return delay.series(taylor[0]), delay.series(taylor[1])
