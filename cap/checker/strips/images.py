"""Images of arcs after one flight, to the second order.

Notation as in `cap.checker.strips.arc`.

*Where T is.*  At s = 0 let |T - T_0| <= D.  On the arc, let |T'| <= m whenever |T - T_0| <= b.  If
D + m <= b, then T never leaves this interval: |T - T_0| <= D + m |s|.  The same holds for all arcs
of a set, if all of them have |T - T_0| <= D at s = 0, and m is a bound for all.
"""

from __future__ import annotations

from functools import cached_property

from cap.checker.kernel.doubles import Double, between, cos_sin
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.strips.arc import Launches, Taylor, numerator

ATTEMPTS = 4  # to find an interval for T


class Bends:
    """What is known of all hits: T, V, d, A, T', and the second derivatives of T and E = V^2/2.

    At s = 0 they are in T; ``slope`` is likely to be T' there, and needs no trust.
    """

    def __init__(self, launches: Launches, T: Double, slope: Double) -> None:
        whole, dt, f = launches.all, launches.dt, launches.f
        self.T, cos, sin, self.V, self.dT = _window(launches, T, slope)
        self.d, self.A = self.T - whole.t, cos - f
        d, A, dT, a, d1 = self.d, self.A, self.dT, whole.cos - f, self.dT - dt
        dV = whole.du + A * dT - a * dt
        a1, A1 = -(whole.sin * dt), -(sin * dT)
        dN = (whole.du + d1 * a + d * a1) * dt - d1 * whole.du - d * whole.d2u
        self.T2 = (dN - dV * dT) / self.V
        V2 = whole.d2u + A * self.T2 + A1 * dT - a1 * dt
        self.E2 = dV * dV + self.V * V2


class Image:
    """The image of an arc all of whose flights reach the other wall, ``shift`` later."""

    def __init__(self, launches: Launches, bends: Bends) -> None:
        self.launches, self.shift, hit = launches, Double(0.0), launches.hit
        self.T: Taylor = (hit.T, hit.T1, bends.T2)
        self.E: Taylor = (hit.V * hit.V * 0.5, hit.V * hit.V1, bends.E2)
        self.dT, self.all = bends.dT, bends.T
        self.crossings = dict[float, Double]()

    def move(self, shift: Double) -> Image:
        """Move all times."""
        T, T1, T2 = self.T
        self.shift, self.T, self.all = shift, (T + shift, T1, T2), self.all + shift
        return self

    @cached_property
    def times(self) -> Double:
        """All times of the hits, when these are not moved any more."""
        T, T1, T2 = self.T
        return T.widened(T1.magnitude + T2.magnitude / 2)

    def end(self, s: float) -> Double:
        """Return when the launch at s = -1 or 1 hits; it does so once among all these times."""
        T = self.launches.end(s).hit.T + self.shift
        return T if self.all.lower <= T.lower and T.upper <= self.all.upper else self.all

    def crossing(self, line: float) -> Double:
        """Return an interval: if T passes the line on the arc, it does so there; T' != 0.

        If it passes nowhere, as all r have T on one side, there are numbers beyond the end that is
        nearest to the line.
        """
        if line not in self.crossings:
            self.crossings[line] = (Double(line) - self.T[0]) / self.dT
        return self.crossings[line]

    def sharp_crossing(self, line: float) -> Double:
        """Return a smaller one: (T(r) - T(0))/r is T' + T'' r/2, T' at 0, for an r of the first.

        If T passes nowhere, the first one has the nearest end, or none of the arc; so r = -1 or 1
        is among these, and that end lies between the line and r = 0.
        """
        r, (T, T1, T2) = self.crossing(line), self.T
        if not (r.lower <= 1 and r.upper >= -1):
            return r
        chord = T1 + T2 * between(max(-1.0, r.lower), min(1.0, r.upper)) * 0.5
        return (Double(line) - T) / chord if abs(chord.mid) > 2 * chord.rad else r


def image(launches: Launches) -> Image:
    """Return the image of an arc, or reject it."""
    bends = Bends(launches, launches.hit.T, launches.hit.T1)
    need(launches.moves(bends.T.upper), "a flight may stop")
    return Image(launches, bends)


def _window(launches: Launches, T: Double, T1: Double) -> tuple[Double, ...]:
    """Return an interval of all T of the arc, with its cos T and sin T; all V, and all T'."""
    whole, bound = launches.all, 1.2 * T1.magnitude + 2 * T.rad + 1e-12
    for _ in range(ATTEMPTS):
        Ts = Double(T.mid, bound)
        cos, sin = cos_sin(Ts)
        V = launches.speed(whole, Ts, sin)
        need(V.is_positive(), "a wall may be reached without speed")
        slope = numerator(launches, whole, Ts) / V
        if (T.rad + slope.magnitude) * (1 + 1e-12) <= bound:
            return Ts, cos, sin, V, slope
        bound = 1.3 * (T.rad + slope.magnitude)
    raise Rejected("no interval was found for the times of the hits")
