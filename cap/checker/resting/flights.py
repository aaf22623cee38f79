"""The first hits of the flights of a cell: a set of (h, h') at a time T.

*The set.*  Its states are c + D x, for x in a rectangle |x_1| <= r_1, |x_2| <= r_2, D a matrix of
intervals, not one for all x; besides h >= 0, and h' has bounds.  Without a hit, at the time s,

    h = h_T + h'_T (s - T) - (J(s) - J(T) - I(T) (s - T)),      h' = h'_T - (I(s) - I(T)),

which is linear in the state at T: so it has bounds by c, D and r, and by h_T >= 0 and h'_T.

*Between two times* x < y, L = y - x, where P >= -M, M >= 0: h'' <= M, so h is at least its chord
less M (s - x)(y - s)/2.  If h(x) >= 0 and h(y) > 0, with chord >= h(y) (s - x)/L,

    h > 0 on (x, y]     where   h(y) > M L^2/2,   or   min(h(x), h(y)) > M L^2/8.

Whatever P is, h > 0 on [x, y] where h' < 0 on [x, y] and h(y) > 0: h decreases.

*A window* [a, b] of hits: for all flights h > 0 on (T, a], h < 0 at b, h' < 0 on [a, b].  So each
hits once in [a, b], and not before.  Where a window may be is found in doubles that only steer.
"""

from __future__ import annotations

from typing import NamedTuple

from cap.checker.kernel.doubles import GROWTH, Double, between
from cap.checker.resting.pull import Pull, Sums

Matrix = tuple[Double, Double, Double, Double]  # (h, h'), (h, h'): by rows
DEPTH = 10  # halvings of a step of the grid
NEWTON = 12  # steps of Newton's method
ASIDE = 2.0**-36, 2.0**-30, 2.0**-24  # tried, of the ends of a window from the zeros found
LONG = 8  # steps of the grid, the longest window


class Cell(NamedTuple):
    """States at the time T: c = (h, v), D, r; and bounds of h'."""

    T: float
    h: Double
    v: Double
    D: Matrix
    r: tuple[float, float]
    down: float
    up: float


class Window(NamedTuple):
    """The window [a, b] of hits; I and P during it; the speeds -h' at the hits."""

    a: float
    b: float
    first: Double
    pull: Double
    speed: Double


EMPTY = Window(0.0, 0.0, *(Double(0.0),) * 3)  # no window


class Flights:
    """The flights of a cell until the first hit."""

    def __init__(self, pull: Pull, cell: Cell) -> None:
        self.pull, self.cell = pull, cell
        self.begin = pull.sums(cell.T)

    def height(self, s: float, at: Sums) -> tuple[float, float]:
        """Return bounds of h at a time, if there was no hit."""
        T, h, v, D, r, down, _ = self.cell
        d = Double(s) - T
        fall = (at[1] - self.begin[1]) - self.begin[0] * d
        far = (D[0] + D[2] * d).magnitude * r[0] + (D[1] + D[3] * d).magnitude * r[1]
        found = ((h + v * d) - fall).widened(far * GROWTH)
        return max(found.lower, (d * down - fall).lower), found.upper

    def first(self) -> tuple[float, float] | None:
        """Return x < y, h > 0 on (T, x], perhaps not at y; None if h > 0 until the grid ends.

        If it is not known where that would be, y = x.
        """
        pull = self.pull
        return self._first(self.cell.T, 0.0, int(self.cell.T / pull.step) + 1, pull.steps - 1)[0]

    def _first(
        self, x: float, low: float, i: int, k: int
    ) -> tuple[tuple[float, float] | None, float]:
        """Return the same, and a lower bound of h at y, from x until the time k of the grid.

        ``low`` is one of h at x; i is the first time of the grid after x.
        """
        pull = self.pull
        y = k * pull.step
        after = self.height(y, pull.at(k))[0]
        if self._stays(x, low, y, after):
            return None, after
        if k > i:
            middle = (i + k) // 2
            found, there = self._first(x, low, i, middle)
            if found is not None:
                return found, there
            return self._first(middle * pull.step, there, middle + 1, k)
        return self._within(x, low, y), after

    def _within(self, x: float, low: float, y: float) -> tuple[float, float] | None:
        """Return the same in a step of the grid."""
        goal = y
        for _ in range(2 * DEPTH):
            after = self.height(goal, self.pull.sums(goal))[0]
            if self._stays(x, low, goal, after):
                if goal == y:
                    return None
                x, low, goal = goal, after, y
            elif after <= 0:
                return x, goal
            else:
                goal = 0.5 * (x + goal)
        return x, x

    def _stays(self, x: float, low: float, y: float, after: float) -> bool:
        """Return whether h > 0 on (x, y], from lower bounds of h at both."""
        bend = max(0.0, -self.pull.lowest(x, y)) * (y - x) * (y - x) * GROWTH
        some = low >= 0 and after > 0 and after > 0.5 * bend
        return some or (low > 0.125 * bend and after > 0.125 * bend)

    def window(self, late: float) -> Window | None:
        """Return a window of the first hits; None if h > 0 until a time for all flights.

        If neither is certain it is empty, a = b.
        """
        found = self.first()
        if found is None:
            return None
        x, y = found
        if x >= late:
            return None
        tried = (self.after(x, y, late, aside) for aside in ASIDE)
        return next((hit for hit in tried if hit is None or hit.a < hit.b), EMPTY)

    def after(self, x: float, y: float, late: float, aside: float) -> Window | None:
        """Return the same if h > 0 on (T, x], by a window that reaches beyond the zeros found."""
        a = max(x, self.zero(-1, y) - aside)
        if not a < y or (a > x and not self.flies(x, a)):
            return EMPTY
        if a >= late:
            return None
        b = self.zero(1, a) + aside
        return self.hits(a, b) if a < b < a + LONG * self.pull.step else EMPTY

    def flies(self, x: float, y: float) -> bool:
        """Return whether h > 0 on (x, y], if it is so on (T, x]."""
        low = self.height(x, self.pull.sums(x))[0] if x > self.cell.T else 0.0
        after = self.height(y, self.pull.sums(y))[0]
        return self._stays(x, low, y, after) or (after > 0 and self.during(x, y).speed.lower > 0)

    def among(self, all_of: Window) -> Window:
        """Return the window of the hits of these flights, which are some of those of a window."""
        t = self.zero(1, 0.5 * (all_of.a + all_of.b))
        first = self.zero(-1, t)
        ends = ((max(all_of.a, first - q), min(all_of.b, t + q)) for q in ASIDE)
        tried = (self._from(all_of.a, a, b) for a, b in ends)
        return next((hit for hit in tried if hit.a < hit.b), EMPTY)

    def _from(self, before: float, a: float, b: float) -> Window:
        """Return the hits of a window in a larger one, which begins ``before``."""
        if not a < b or (a > before and not self.height(a, self.pull.sums(a))[0] > 0):
            return EMPTY
        return self.hits(a, b)

    def hits(self, a: float, b: float) -> Window:
        """Return a window before which there are no hits, if h < 0 at b and h' < 0."""
        if not self.height(b, self.pull.sums(b))[1] < 0:
            return EMPTY
        found = self.during(a, b)
        return found if found.speed.lower > 0 else EMPTY

    def during(self, a: float, b: float) -> Window:
        """Return I, P and the speeds -h' during some time, without a hit."""
        pull, time = self.pull.during(a, b), between(a, b)
        first = self.pull.sums(time.mid)[0] + pull * Double(0.0, time.rad)
        speed = (first - self.begin[0]) - between(self.cell.down, self.cell.up)
        return Window(a, b, first, pull, speed)

    def zero(self, side: int, near: float) -> float:
        """Return about when the first (side -1) or the last (1) of the flights hits; a guess."""
        T, h, v, D, r, _, _ = self.cell
        s, (I0, J0) = near, self.pull.guess(T)
        for _ in range(NEWTON):
            d = s - T
            I, J = self.pull.guess(s)
            p, q = D[0].mid + d * D[2].mid, D[1].mid + d * D[3].mid
            thick = h.rad + d * v.rad + (D[0].rad + d * D[2].rad) * r[0]
            thick += (D[1].rad + d * D[3].rad) * r[1]
            far = side * (abs(p) * r[0] + abs(q) * r[1] + thick)
            turn = (D[2].mid if p > 0 else -D[2].mid) * r[0]
            turn += (D[3].mid if q > 0 else -D[3].mid) * r[1]
            fall = J - J0 - I0 * d
            height = h.mid + v.mid * d - fall + far
            rate = v.mid - (I - I0) + side * turn
            if not rate < 0:
                return near
            s -= height / rate
            if abs(height) < 1e-13 * (abs(rate) + 1):
                break
        return s if 0 <= s < self.pull.steps * self.pull.step else near
