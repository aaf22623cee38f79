"""The map sigma over half a period, of motions whose velocity does not vanish in that time.

Units F = omega = 1, phi = f/F < 1, walls at -a and a.  With Theta the flow from t = 0 to t = pi,
sigma = -Theta: as (x, v, t) -> (-x, -v, t + pi) is a symmetry, sigma^2 is the flow over a period.

*First flight.*  Let -a < x < a, v > 0.  While v > 0, v' = cos t - phi, so

    w(t) = v + sin t - phi t,      g(t) = x + v t + 1 - cos t - phi t^2/2 - a

are the velocity and the distance beyond the wall.  w rises up to t = arccos phi and falls from
there to pi.  So if w is positive on an interval T in (0, pi), it is so on [0, T] (w(0) = v > 0): g
increases there.  If Newton's operator t - g(t)/w(T), t in T, lies inside T, g has a zero t1 in T,
and it is the first hit, transverse.  It depends analytically on (x, v).

*Second flight.*  The velocity is -w(t1) at first, v' = cos t + phi; for t in [t1, pi],

    velocity = -v - 2 sin t1 + sin t + phi t.

This rises up to t* = pi - arccos phi and falls after that, so it is negative on [t1, pi] if it is
at t*.  Then x decreases, and if x(pi) > -a no wall is hit again.  With d = pi - t1,

    x(pi) = a - (v + 2 sin t1 - phi t1) d + 1 + cos t1 + phi d^2/2,
    v(pi) = -v - 2 sin t1 + phi pi.

*Derivative.*  dt1 = -(dx + t1 dv)/w1, w1 = w(t1).  With k = -2 cos(t1)/w1 and D = 1 + d k,

    D sigma = [[D, D t1 + d], [k, k t1 + 1]].

The second row is that of v + 2 sin t1; for the first, d(-x(pi)) = d (dv + 2 cos t1 dt1 - phi dt1) -
(v + 2 sin t1 - phi t1) dt1 + sin t1 dt1 + phi d dt1 = d (dv + 2 cos t1 dt1) - w1 dt1.  So sigma
preserves area: D (k t1 + 1) - k (D t1 + d) = 1; it is injective, for flights can be followed back.
"""

from __future__ import annotations

import math
from fractions import Fraction

from cap.checker.coverings.planar import Image, Planar
from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.doubles import GROWTH, PI, Double, cos_sin, enclosing
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.flight import place, velocity

_BITS, _STEPS = 80, 30
_SLACK, _LEAST = 1.25, 2.0**-44  # of the interval T, around a guess


class HalfPeriod(Planar):
    """sigma, for phi = f/F and walls at -a and a."""

    def __init__(self, phi: Fraction, a: Fraction) -> None:
        need(0 <= phi < 1 and a > 0, "0 <= f < F, l < r does not hold")
        self.phi, self.half, self.a = enclosing(phi), enclosing(phi / 2), enclosing(a)
        slow = arccos(Interval.enclosing(phi, phi, _BITS))
        self.slow = PI - (enclosing(slow.lower).widened(float(slow.upper - slow.lower) * GROWTH))
        self.sine = (Double(1.0) - self.phi * self.phi).sqrt()

    def image(self, x: Double, v: Double) -> Image:
        """Enclose sigma and its derivative; reject what may stop, or hit otherwise."""
        need(abs(x.mid) + x.rad < self.a.lower * (1 - 2.0**-50), "a state beyond a wall")
        need(v.is_positive(), "a velocity that is not positive")
        t, cos, sin, w = self.first_hit(x, v)
        least = velocity(v, self.slow, self.phi, sin * 2.0 - self.sine)  # of minus the velocity
        need(least.is_positive(), "the velocity may vanish after the hit")
        d = PI - t
        X = place(-self.a - cos, w + sin, d, self.half, 1.0)
        need((self.a - X).is_positive(), "a second hit within half a period")
        k = cos * -2.0 / w
        D = d * k + 1.0
        return Image(X, velocity(v, PI, self.phi, sin * 2.0), ((D, D * t + d), (k, k * t + 1.0)))

    def first_hit(self, x: Double, v: Double) -> tuple[Double, Double, Double, Double]:
        """Return t1 in (0, pi), its cosine and sine, and w(t1), all w > 0 before."""
        t = _guess(x.mid, v.mid, self.phi.mid, self.a.mid)
        speed = velocity(v.mid, t, self.phi.mid, math.sin(t))
        need(speed > 0, "a mass that may not reach the wall")
        reach = (x.rad + t * v.rad) / speed * _SLACK + _LEAST
        need(t - 2 * reach > 0 and t + 2 * reach < 3.14159, "a hit that may be too early or late")
        at, T, all_d = Double(t), Double(t, reach), Double(0.0, reach)
        cos, sin = cos_sin(at)
        w = velocity(v, T, self.phi, (sin + cos * all_d).widened(_half_square(reach)))
        need(w.is_positive(), "the velocity may vanish before the hit")
        g = place(x + 1.0, v, at, self.half, cos) - self.a
        step = -g / w
        need(abs(step.mid) + step.rad < reach * (1 - 2.0**-40), "no certain hit")
        rest = _half_square(step.magnitude)
        t1 = at + step
        c1, s1 = (cos - sin * step).widened(rest), (sin + cos * step).widened(rest)
        return t1, c1, s1, velocity(v, t1, self.phi, s1)


def _half_square(d: float) -> float:
    """Return a bound of |sin(t + d) - sin t - d cos t|, and of the same for the cosine."""
    return 0.5 * d * d * GROWTH


def _guess(x: float, v: float, phi: float, a: float) -> float:
    """Return a time near the first hit, by Newton's method from above: it needs no trust."""
    t = min(3.0, max(0.1, (a - x) / (v + 0.5)))
    for _ in range(_STEPS):
        w = velocity(v, t, phi, math.sin(t))
        need(w > 0, "a mass that may not reach the wall")
        step = (place(x + 1, v, t, phi / 2, math.cos(t)) - a) / w
        t = min(3.14, max(1e-3, t - step))
        if abs(step) < 1e-14:
            break
    return t
