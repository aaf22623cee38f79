"""The pull towards a wall, P = -h'', where it depends on the clock alone, and its integrals.

With s the time since t_0, P = m + c cos(w s) + d sin(w s).  From 0 to s it has the integral I, and
I has the integral J,

    I = m s + (c sin(w s) + d (1 - cos(w s)))/w,
    J = m s^2/2 + (c (1 - cos(w s)) + d (w s - sin(w s)))/w^2.

Times s are doubles, at which nothing is rounded; those of a grid are multiples of a power of 2.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from cap.checker.kernel.doubles import GROWTH, Double, between, cos_sin

PARTS = 64  # of a period, at least: steps of the grid
Sums = tuple[Double, Double]


class Wave(NamedTuple):
    """m, c, d, w > 0."""

    mean: Double
    cos: Double
    sin: Double
    omega: Double


class Pull:
    """P from 0 until a time, and I and J at times."""

    def __init__(self, wave: Wave, until: float) -> None:
        self.wave = wave
        self.middles = [x.mid for x in wave]
        square = wave.cos * wave.cos + wave.sin * wave.sin
        self.swing = math.sqrt(square.upper) * GROWTH
        self.step = 2.0 ** math.floor(math.log2(2 * math.pi / wave.omega.mid / PARTS))
        self.steps = math.ceil(until / self.step) + 1
        pieces = [self.during(j * self.step, (j + 1) * self.step) for j in range(self.steps)]
        self.least = [found.lower for found in pieces]
        self.most = [found.upper for found in pieces]
        self._known: dict[int, Sums] = {}

    def during(self, a: float, b: float) -> Double:
        """Return an enclosure of P in some time, halved if it is long: with P, P' at its middle,

        P(x) - P = P' sin(w x)/w - (P - m)(1 - cos(w x)), and |P(x) - m| <= sqrt(c^2 + d^2).
        """
        if b - a > self.step:
            middle = 0.5 * (a + b)
            halves = self.during(a, middle), self.during(middle, b)
            ends = [q for half in halves for q in (half.lower, half.upper)]
            finite = all(map(math.isfinite, ends))  # not a number: nothing is known
            return between(min(ends), max(ends)) if finite else Double(0.0, math.inf)
        m, c, d, w = self.wave
        time = between(a, b)
        cos, sin = cos_sin(w * time.mid)
        swing, slope = c * cos + d * sin, w * (d * cos - c * sin)
        bend, r = (swing * (w * w)).magnitude, time.rad
        swing = swing.widened((slope.magnitude * r + 0.5 * bend * r * r) * GROWTH)
        return m + between(max(swing.lower, -self.swing), min(swing.upper, self.swing))

    def sums(self, s: float) -> Sums:
        """Return I and J at a time."""
        m, c, d, w = self.wave
        t = Double(s)
        angle = t * w
        cos, sin = cos_sin(angle)
        rest = -(cos - 1.0)
        first = m * t + (c * sin + d * rest) / w
        second = m * (t * t) * 0.5 + (c * rest + d * (angle - sin)) / (w * w)
        return first, second

    def guess(self, s: float) -> tuple[float, float]:
        """Return about I and J at a time: they only steer."""
        m, c, d, w = self.middles
        cos, sin = math.cos(w * s), math.sin(w * s)
        first = m * s + (c * sin + d * (1 - cos)) / w
        return first, 0.5 * m * s * s + (c * (1 - cos) + d * (w * s - sin)) / (w * w)

    def at(self, j: int) -> Sums:
        """Return I and J at a time of the grid."""
        found = self._known.get(j)
        if found is None:
            found = self._known[j] = self.sums(j * self.step)
        return found

    def pieces(self, a: float, b: float) -> slice:
        """Return which pieces of the grid lie between two times, those at the ends as a whole."""
        return slice(int(a / self.step), int(b / self.step) + 1)

    def ends(self, a: float, b: float) -> tuple[float, float]:
        """Return bounds of P between two times, 0 <= a <= b; none after the last of the grid."""
        if not 0 <= a <= b < self.steps * self.step:
            return -math.inf, math.inf
        part = self.pieces(a, b)
        return min(self.least[part]), max(self.most[part])

    def lowest(self, a: float, b: float) -> float:
        """Return a lower bound of P between two times."""
        return self.ends(a, b)[0]
