"""A ceiling for launches that never stop: the high-speed lemma, and a function that decreases.

Units F = omega = 1; e = 1, mu = 0, 0 < f < 1.  A launch (t, u) leaves the left wall (or is the
mirror image of one that leaves the right one), E = u^2/2.  The flight map G sends it to (T + pi,
V), T the time and V the speed of its hit of the other wall; it is injective and preserves dt dE.  S
is the set of the launches all of whose images exist, t modulo 2 pi; G maps S into S.

**High speeds.**  u_n is the speed at hit n of an orbit in S.  Let m* = R/(2 f), V_0^2 = m*^2 + 4 (1
+ f) R, V_1^2 = V_0^2 + 4 (1 - f) R.  Along a flight d(u^2/2) = (s cos t - f) dy, y the way from the
wall that is left, s = 1 to the right and -1 to the left.  Let two flights pass the place x at the
times a(x) < b(x), and let m be the least speed on both.  As |cos a - cos b| <= b - a,

    (u_{n+2}^2 - u_n^2)/2 <= integral of (b - a) dx over [l, r] - 2 f R <= R^2/m - 2 f R,

since the way from x to x again is 2 (r - x), or 2 (x - l), of mean R.  As |d(u^2/2)| <= (1 + f) dy,
m^2 >= u_n^2 - 4 (1 + f) R, and u_{n+2}^2 - u_n^2 <= 4 (1 - f) R.
 (i)   If u_n > V_0 then m > m* and u_{n+2} < u_n; if u_n > V_1, u_n^2 decreases at least by a
       constant.
 (ii)  If u_n <= V_0 then u_{n+2} <= V_1.
 (iii) So G^2 maps S_1, the part of S with u <= V_1, into itself.  It is injective and preserves the
       measure, which is finite on S_1: up to a null set it is onto.  A launch of S above V_1
       comes into S_1 under some G^{2n}, by (i).  Those for which n = 1 are sent into S_1, and not
       where S_1 is sent: they are a null set.  G^{2(n-1)} sends the others there, injectively and
       preserving the measure: they are null sets, too.
So almost every launch of S has u <= V_1, S has finite measure, and G maps S onto S up to a null
set.

**The ceiling.**  Let W = E + a cos(t - b).  *Shown here:* all flights with 0 < u <= V_1 have W(G)
<= c or W(G) < W.  Then almost every launch of S has W <= c.  For G maps the part with W <= c into
itself; so U, the part with W > c, contains its preimage, which has the same finite measure: up to
null sets G is a bijection of U that preserves the measure.  So W and W(G) have the same integral
over U, W is bounded, and W(G) < W there: U is a null set.

A flight is known by its times: with d = T - t, from x(T) = R,

    g = (R - cos t + cos T)/d,    u = g + sin t + f d/2,    V = g + sin T - f d/2,
    W(G) - W = (V - u)(V + u)/2 - a cos(T - b) - a cos(t - b),    V - u = sin T - sin t - f d,

so boxes of (t, d) are examined, and halved until one of these is certain: u < 0, u > V_1, V < 0,
W(G) <= c, W(G) < W.  No flight with u <= V_1 is shorter than R/(2 V_1), as v <= V_1 + (1 - f) d and
V_1^2 > 4 (1 - f) R; none is longer than (V_1 + 2)/f, as v <= V_1 + 2 - f d.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from cap.checker.kernel.doubles import PI, Double, between, cos_sin
from cap.checker.kernel.rejection import need
from cap.checker.strips.strips import Ceiling
from cap.checker.system.flight import velocity

MOST = 60_000  # boxes: some seconds
TALL = 1.0  # boxes are no larger when they are examined


class Flight(NamedTuple):
    """What is known of the flights of a box of times; V + u and V - u, too."""

    t: Double
    T: Double
    u: Double
    V: Double
    sum: Double
    difference: Double


class Flights:
    """All flights over the distance R against the friction f, by their times."""

    def __init__(self, f: Double, R: Double) -> None:
        need(f.is_positive() and (Double(1.0) - f).is_positive(), "0 < f < F does not hold")
        self.f, self.R = f, R
        slow = R / (f * 2.0)
        square = slow * slow + (f + 1.0) * R * 4.0 + (Double(1.0) - f) * R * 4.0
        self.fastest = square.sqrt()
        self.shortest = (R / (self.fastest * 2.0)).lower
        self.longest = ((self.fastest + 2.0) / f).upper

    def of(self, t: Double, d: Double) -> Flight:
        """Return what is known of those that begin at t and take the time d."""
        T = t + d
        (cos_t, sin_t), (cos_T, sin_T) = cos_sin(t), cos_sin(T)
        g, half = (self.R - cos_t + cos_T) / d, self.f * d * 0.5
        gained = sin_T - sin_t - self.f * d
        return Flight(t, T, g + sin_t + half, g + sin_T - half, g * 2.0 + sin_T + sin_t, gained)

    def never(self, flight: Flight) -> bool:
        """Return whether there is no such flight with 0 < u <= V_1."""
        slow = flight.u.upper < 0 or flight.V.upper < 0
        return slow or flight.u.lower > self.fastest.upper

    def halts(self, flight: Flight) -> bool:
        """Return whether there is none, as the speed would vanish at one of its minima."""
        f, t, u = self.f, flight.t, flight.u
        sin_t = cos_sin(t)[1]
        rest = math.acos(f.mid)
        for k in range(8):
            low = Double(2 * math.pi * k - rest)  # any time will do
            if t.upper < low.mid < flight.T.lower:
                v = velocity(u - sin_t, low - t, f, cos_sin(low)[1])
                if v.upper < 0:
                    return True
        return False

    def examine(
        self, t: tuple[float, float], d: tuple[float, float], holds: Callable[[Flight], bool]
    ) -> int:
        """Prove that something holds for all flights of these times; return the number of boxes."""
        waiting, count = [(*t, *d)], 0
        while waiting:
            count += 1
            need(count <= MOST, "too many boxes of flights are not decided")
            low, high, least, most = waiting.pop()
            wide = high - low > TALL or most - least > TALL
            if not wide and holds(self.of(between(low, high), between(least, most))):
                continue
            if high - low > most - least:
                middle = (low + high) / 2
                waiting += [(low, middle, least, most), (middle, high, least, most)]
            else:
                middle = (least + most) / 2
                waiting += [(low, high, least, middle), (low, high, middle, most)]
        return count


def descends(flights: Flights, ceiling: Ceiling) -> int:
    """Prove that W(G) <= c or W(G) < W for all flights with u <= V_1; return the boxes."""
    a, b, c = ceiling

    def holds(flight: Flight) -> bool:
        if flights.never(flight):
            return True
        after, fastest = a * cos_sin(flight.T - b)[0], flight.V.upper
        speed = 0.0 if fastest <= 0 else fastest  # NaN stays NaN
        if (Double(speed) * speed * 0.5 - after - c).upper <= 0:
            return True
        change = flight.sum * flight.difference * 0.5
        return (change - after - a * cos_sin(flight.t - b)[0]).upper < 0

    return flights.examine((0.0, 6.3), (flights.shortest, flights.longest), holds)


def returns_in_time(flights: Flights, begin: float, end: float) -> None:
    """Prove that no flight that begins in [begin, end] hits after begin + 3 pi."""
    late = (PI * 3.0 + begin).lower

    def holds(flight: Flight) -> bool:
        early = flight.T.upper < late
        return early or flights.never(flight) or flights.halts(flight)

    flights.examine((begin, end), (flights.shortest, flights.longest), holds)


def closed(ceiling: Ceiling, begin: float, end: float) -> None:
    """Prove that W > c for E >= 0 at all times, modulo 2 pi, that are not in [begin, end].

    These are the times in [end - 2 pi, begin]; cos is at least as at the ends, if they are within
    pi of b.
    """
    a, b, c = ceiling
    need(a.is_positive(), "the ceiling has no height")
    for t in (Double(end) - PI * 2.0, Double(begin)):
        near = (t - b).magnitude < math.pi
        need(near and (a * cos_sin(t - b)[0] - c).is_positive(), "the columns miss some times")
