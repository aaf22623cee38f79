"""The fate of a cell of states: all motions from it rest in time, or all fly until the end.

*One hit* at tau in the window [a, b] makes h' to -e h'.  With r = -h' before it and u = tau - T,

    dtau = (dh + u dh')/r,     dr = -dh' + P dtau,

as h = 0 at tau, and the state at b, if there is no other hit until then,

    h' = e r - (I(b) - I(tau)),     h = e r (b - tau) - (J(b) - J(tau) - I(tau) (b - tau)),

changes by

    dh' = e dr + P dtau = q (dh + u dh') - e dh',  q = (1 + e) P/r,
    dh = -e r dtau + (b - tau) dh'_b.

I and J grow with time, and their differences are small.  If tau is in [a, s], d = s - tau, then

    I(b) - I(tau) = I(b) - I(s) + p d,
    J(b) - J(tau) - I(tau) (b - tau) = J(b) - J(s) - I(s) (b - s) + p' d (b - s + d/2),

p and p' averages of P over [tau, s], that with the weight b - t >= 0: both between its bounds.

There is no other hit if e r > P (b - tau)/2, as then e r s - integral of P stays positive.

*Mean values.*  Let F map a state x of the cell at t_0 to that at b.  For the middle x_c, F(x) -
F(x_c) = D (x - x_c), D an average of derivatives on the way, so in the product of enclosures of
those of each hit.  F(x_c) is followed besides.

*Rest* (``chatter``).  Let 0 < l <= P <= g.  A bounce that begins with the speed v rises for v/l at
most, falls for v/l at most, and ends with a speed v sqrt(g/l) at most; so the next one begins with
k v, k = e sqrt(g/l), at most.  All of them, if k < 1, last 2 v/(l (1 - k)) at most.  The bounds l
and g of a bounce need hold only while it may last.  A sum of doubles x + y is below the double z if
what it is rounded to is.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from cap.checker.kernel.doubles import GROWTH, Double, between
from cap.checker.resting.flights import Cell, Flights, Matrix, Window
from cap.checker.resting.pull import Pull

RESTS, FLIES, UNKNOWN = "r", "f", "-"
HITS, BOUNCES = 24, 6  # that are followed; that are bounded one by one
UP = 1 + 2.0**-40  # more than a few roundings lose
# Times tried, by one that would do under other bounds; more of them than where cells are found.
LONGER = 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.33, 1.36, 1.4, 1.5, 1.8, 1.9


class Fates(NamedTuple):
    """What is known of all cells; the end is not before ``early``, not after ``late``."""

    pull: Pull
    e: Double
    early: float
    late: float

    def of(self, h: tuple[float, float], v: tuple[float, float]) -> str:
        """Return the fate of the states with h and h' between such ends at s = 0, h >= 0."""
        y, w = between(*h), between(*v)
        one, none = Double(1.0), Double(0.0)
        same = one, none, none, one
        cell = Cell(0.0, Double(y.mid), Double(w.mid), same, (y.rad, w.rad), *v)
        for _ in range(HITS):
            flights = Flights(self.pull, cell)
            hit = flights.window(self.late)
            if hit is None:
                return FLIES
            if hit.a == hit.b:
                return UNKNOWN
            middle = cell._replace(r=(0.0, 0.0), down=cell.v.lower, up=cell.v.upper)
            thin = Flights(self.pull, middle).among(hit)
            if thin.a == thin.b:
                return UNKNOWN
            hit = hit._replace(speed=self.speed(cell, hit, thin))
            if self.rests(hit):
                return RESTS
            if not hit.b < self.late or self.hits_again(hit):
                return UNKNOWN
            cell = self.after(cell, hit, thin)
        return UNKNOWN

    def speed(self, cell: Cell, hit: Window, thin: Window) -> Double:
        """Return the speeds at a hit, by their mean values, too."""
        D, (x, y) = cell.D, cell.r
        steep = hit.pull / hit.speed
        tilt = steep * (between(hit.a, hit.b) - cell.T) - 1.0
        first, second = steep * D[0] + tilt * D[2], steep * D[1] + tilt * D[3]
        mean = thin.speed.widened((first.magnitude * x + second.magnitude * y) * GROWTH)
        return between(max(mean.lower, hit.speed.lower), min(mean.upper, hit.speed.upper))

    def hits_again(self, hit: Window) -> bool:
        """Return whether there may be another hit in the window."""
        needed = max(0.0, hit.pull.upper) * (hit.b - hit.a) * 0.5 * UP
        return not (self.e * hit.speed).lower > needed

    def after(self, cell: Cell, hit: Window, thin: Window) -> Cell:
        """Return the cell at the end of the window."""
        b, e = hit.b, self.e
        time = between(hit.a, b)
        u, left = time - cell.T, -(time - b)
        q = (e + 1.0) * hit.pull / hit.speed
        of_rate = q * u - e
        turn = left * q - e, left * of_rate - e * u, q, of_rate
        D = _product(turn, cell.D)
        h, v = self.landed(thin, b)
        rate = e * hit.speed - (self.pull.sums(b)[0] - hit.first)
        x, y = cell.r
        mean = v.widened((D[2].magnitude * x + D[3].magnitude * y) * GROWTH)
        down, up = max(rate.lower, mean.lower), min(rate.upper, mean.upper)
        return Cell(b, h, v, D, cell.r, down, up)

    def landed(self, hit: Window, b: float) -> tuple[Double, Double]:
        """Return the state at a time b after a hit, if there is no other one until then."""
        at, last = self.pull.sums(b), self.pull.sums(hit.b)
        left, d = Double(b) - hit.b, -(between(hit.a, hit.b) - hit.b)
        away = self.e * hit.speed
        lost = (at[0] - last[0]) + hit.pull * d
        fall = ((at[1] - last[1]) - last[0] * left) + hit.pull * d * (left + d * 0.5)
        return away * (left + d) - fall, away - lost

    def rests(self, hit: Window) -> bool:
        """Return whether after these hits infinitely many accumulate before the end."""
        e, fast, latest = self.e.upper, hit.speed.upper, hit.b
        for _ in range(BOUNCES):
            v = e * fast * UP
            l, g = self.pull.ends(hit.a, latest)
            if not 0 < l <= g < math.inf:
                return False
            k = e * math.sqrt(g / l) * UP
            needed = 2 * v / (l * (1 - k)) if k < 1 else math.inf
            if any(self.accumulate(hit.a, latest, v, needed * x) for x in LONGER):
                return True
            tried = (self.bounce(hit.a, latest, v, x) for x in LONGER)
            once = next((found for found in tried if found is not None), None)
            if once is None:
                return False
            fast, latest = once
        return False

    def bounce(
        self, a: float, latest: float, v: float, longer: float
    ) -> tuple[float, float] | None:
        """Return bounds of the speed and the time of the next hit, in so many times a time tried.

        None: it may be later.
        """
        until = _after(latest + 2 * v / self.pull.ends(a, latest)[0] * longer)
        l, g = self.pull.ends(a, until)
        if not (0 < l <= g < math.inf and latest + 2 * v / l * UP < until):
            return None
        return math.sqrt(g / l) * v * UP, until

    def accumulate(self, a: float, latest: float, v: float, tried: float) -> bool:
        """Return whether all bounces, the first one with the speed v, are over in a time tried."""
        until = min(_after(latest + tried), self.early)
        l, g = self.pull.ends(a, max(a, until))
        if not 0 < l <= g < math.inf:
            return False
        k = self.e.upper * math.sqrt(g / l) * UP
        return k < 1 and latest + 2 * v / (l * (1 - k)) * UP < until


def _after(x: float) -> float:
    """Return the double after another one: a sum that is rounded to x is below it."""
    return math.nextafter(x, math.inf)


def _product(m: Matrix, n: Matrix) -> Matrix:
    """Return the product of two matrices."""
    return (
        m[0] * n[0] + m[1] * n[2],
        m[0] * n[1] + m[1] * n[3],
        m[2] * n[0] + m[3] * n[2],
        m[2] * n[1] + m[3] * n[3],
    )
