"""A ceiling for launches that never stop: the high-speed lemma, and a function that decreases.

Units F = omega = 1; e = 1, mu = 0, 0 < f < 1.  Launches (t, E), E = u^2/2, from one wall, seen in
the mirror image after each hit: the flight map G sends (t, u) to (T + pi, V), T the time and V the
speed of the next hit, and preserves dt dE.  S is the set of launches all of whose images exist.

**High speeds.**  u_n is the speed at hit n.  Let m* = R/(2 f), V_0^2 = m*^2 + 4 (1 + f) R, V_1^2 =
V_0^2 + 4 (1 - f) R.  Along a flight d(u^2/2) = (s cos t - f) dy, y the way from the wall left, s =
+-1 in turn.  Over two flights, with a(y) < b(y) the times at which they pass the same place x,

    (u_{n+2}^2 - u_n^2)/2 = +- integral over x in [l, r] of (cos a - cos b) - 2 f R
                          <= integral of (b - a) - 2 f R <= R (2 R/m)/2 ... <= R^2/m - 2 f R,

m the least speed on both: from passing x to passing it again the way is 2 (r - x) or 2 (x - l), so
the mean of b - a over x is at most R/m.  As |d(u^2/2)| <= (1 + f) dy, m^2 >= u_n^2 - 4 (1 + f) R.
 (i)   If u_n > V_0 then m > m*, so R^2/m < 2 f R and u_{n+2} < u_n.
 (ii)  If u_n <= V_0 then u_{n+2}^2 <= V_0^2 + 4 (1 - f) R = V_1^2.
 (iii) So B = {u <= V_1} is invariant under two flights, as far as they exist, and of finite
       measure.  Almost every launch of S in B returns near itself (Poincare, G^2 on S in B).  A
       launch of S above V_1 decreases under G^2, by (i) at least by a positive amount as long as it
       stays above V_1, and so comes into B: S above V_1 is the union over n of sets that G^(2n)
       sends into B from outside; G^2 is injective and preserves the measure, S in B has finite
       measure and G^2 maps it into itself, so onto itself up to a null set: nothing comes into it
       from outside.  So almost every launch of S has u <= V_1.

**The ceiling.**  Let W = E + a cos(t - b).  *Shown here:* for all flights with 0 < u <= V_1, either
W(G) <= c or W(G) < W.  Then almost every launch of S has W <= c.  For W decreases along an orbit of
S as long as it is above c, and once below c stays there; almost every launch of S returns near
itself, and one with W > c does not: either W falls below c at some time, never to rise again, or it
decreases for ever, after the first flight by an amount that is not regained.

A flight is known by its times: with d = T - t, from x(T) = R,

    g = (R - cos t + cos T)/d,    u = g + sin t + f d/2,    V = g + sin T - f d/2,
    W(G) - W = (V - u)(V + u)/2 - a cos(T - b) - a cos(t - b),

so boxes of (t, d) are examined, and halved until one of these is certain: u < 0, u > V_1, V < 0,
W(G) <= c, W(G) < W.  As v <= V_1 + (1 - f) d and V_1^2 > R (1 - f)/4, no flight is shorter than
R/(2 V_1); as v <= V_1 + 2 - f d, none is longer than (V_1 + 2)/f.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from cap.checker.flow.strips import Ceiling
from cap.checker.kernel.doubles import PI, Double, between, cos_sin
from cap.checker.kernel.rejection import Rejected, need

MOST = 300_000  # boxes
TALL = 1.0  # |d(W)| and the like are examined on boxes no larger


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
                v = u + cos_sin(low)[1] - sin_t - f * (low - t)
                if v.upper < 0:
                    return True
        return False

    def examine(self, t: tuple[float, float], d: tuple[float, float], holds: Callable[[Flight], bool]) -> int:
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
        after, speed = a * cos_sin(flight.T - b)[0], max(0.0, flight.V.upper)
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


__all__ = ["Flights", "Rejected", "closed", "descends", "returns_in_time"]
