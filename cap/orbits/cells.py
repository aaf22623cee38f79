"""Pieces of a curve of periodic orbits, each proved by Krawczyk's operator with a parameter.

On a *cell* one unknown s of w, ``along`` it, goes through an interval around s_0; the others are
near a line, w = w_0 + w_1 (s - s_0) + b, |b| <= r.  With a matrix C, A the derivative of F by the
others over all these w, and D that along the line,

    K = -C F(w_0) - C D (s - s_0) + (1 - C A) [-r, r].

If K lies inside of [-r, r], there is exactly one zero b of F for each s, and it lies in K.

*Two cells are one curve* if the zero at an end of one of them lies among the w of the other.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.curve import Curve
from cap.orbits.equations import derivative
from cap.orbits.numbers import Balls, Floats
from cap.orbits.periodic import symmetric
from cap.sets import interval
from cap.sets.interval import Ball, Exact, Matrix

SHIFT = 48  # C has the unit 2^-48
NEWTON, TRIALS = 12, 3
ROOM = 4  # of r beyond K
WIDER = 2 / 5
EVEN = 1000  # times r_k is no smaller than another one
MARGIN = 3 / 4  # of r, in which K must lie: the checker's K may be somewhat larger


@lru_cache
def _one(size: int, along: int) -> Matrix:
    """Return the matrix that takes all unknowns to those but one."""
    rows = interval.identity(size).tolist()
    return interval.matrix([[*row[:along], interval.ZERO, *row[along:]] for row in rows])


@dataclass(frozen=True)
class Line:
    """Where a cell is looked for: w_0, w_1, and C, of doubles; exact."""

    along: int
    ends: tuple[Fraction, Fraction]
    centre: Sequence[Fraction]
    slope: Sequence[Fraction]
    matrix: Sequence[Sequence[float]]

    @cached_property
    def middle(self) -> Fraction:
        """s_0."""
        return (self.ends[0] + self.ends[1]) / 2

    @cached_property
    def _exact(self) -> list[tuple[Exact, Exact]]:
        """w_0 and w_1, of which balls are made fast."""
        pairs = zip(self.centre, self.slope, strict=True)
        return [(interval.exact(c), interval.exact(q)) for c, q in pairs]

    @property
    def direction(self) -> list[Ball]:
        """w_1, enclosed."""
        return [interval.ball(q) for _, q in self._exact]

    @property
    def preconditioner(self) -> Matrix:
        """C, enclosed."""
        return interval.matrix(self.matrix)

    def at(self, offset: Ball) -> Box:
        """Return the points of the line at s - s_0."""
        return tuple([interval.ball(c) + interval.ball(q) * offset for c, q in self._exact])


class Cell(NamedTuple):
    """A proved piece of a curve; ``error`` encloses b, ``multipliers``, if any, e_1, ..., e_n."""

    line: Line
    reach: Sequence[Fraction]
    error: Box
    multipliers: list[Ball]

    def at(self, s: Fraction) -> Box:
        """Return an enclosure of the zero at s."""
        place = self.line.at(interval.ball(s - self.line.middle))
        return tuple(x + b for x, b in zip(place, self.error, strict=True))

    @property
    def box(self) -> Box:
        """An enclosure of the whole piece."""
        place = self.line.at(spread(self.line))
        return tuple(x + b for x, b in zip(place, self.error, strict=True))

    @property
    def wider(self) -> Box:
        """Somewhat more: the checker encloses the piece otherwise."""
        return tuple(map(wider, self.box))

    def holds(self, other: "Cell", s: Fraction) -> bool:
        """Return whether another cell's zero at its s is certain to be one of this cell's."""
        line, w = self.line, other.at(s)
        low, high = line.ends
        if other.line.along == line.along:
            inside, offset = low <= s <= high, interval.ball(s - line.middle)
        else:
            here = w[line.along]
            inside = bool(interval.ball(low) < here) and bool(here < interval.ball(high))
            offset = here - interval.ball(line.middle)
        away = [x - y for x, y in zip(w, line.at(offset), strict=True)]
        return inside and all(
            abs(b) < interval.ball(r)
            for k, (b, r) in enumerate(zip(away, self.reach, strict=True))
            if k != line.along
        )


def wider(x: Ball) -> Ball:
    """Return a ball of a somewhat larger radius."""
    return x + interval.symmetric((x - interval.point(x)) * WIDER)


def spread(line: Line) -> Ball:
    """Return a ball of all s - s_0 of a line."""
    low, high = line.ends
    return interval.symmetric(interval.ball((high - low) / 2))


class Cells:
    """Finds and proves cells of a curve."""

    def __init__(self, curve: Curve) -> None:
        self.curve = curve
        self.floats = Floats(curve.equations.itinerary.system)
        self._balls = dict[int, Balls]()

    @property
    def balls(self) -> Balls:
        """The numbers at the precision here."""
        bits = interval.working_bits()
        if bits not in self._balls:
            self._balls[bits] = Balls(self.curve.equations.itinerary.system)
        return self._balls[bits]

    def slopes(self, w: Any) -> Any:
        """Return F' in doubles."""
        of, curve = self.floats, self.curve
        return np.array(curve.rows(curve.blocks(list(map(float, w)), of)), float)

    def tangent(self, w: Sequence[float]) -> Any:
        """Return the direction of the curve in doubles: F' v = 0, |v| = 1."""
        try:
            v = np.linalg.svd(self.slopes(w))[2][-1]
        except (ArithmeticError, ValueError, np.linalg.LinAlgError):
            raise NotProved("curve", "F' is not finite in doubles", {"w": list(w)}) from None
        return v

    def newton(self, w: Sequence[float], along: int) -> tuple[list[float], Any]:
        """Return a zero of F with the same w_along in doubles, and F' there."""
        z, others = np.array(w, float), [k for k in range(len(w)) if k != along]
        for _ in range(NEWTON):
            try:
                F, blocks = self.curve.both(z.tolist(), self.floats)
                J = np.array(self.curve.rows(blocks), float)
                step = np.linalg.solve(J[:, others], np.array(F, float))
            except (ArithmeticError, ValueError, np.linalg.LinAlgError):
                break
            z[others] -= step
            if not np.abs(step).max() < 1e3:
                break
            if np.abs(step).max() < 1e-11 * (1 + np.abs(z).max()):
                return [float(x) for x in z], J
        raise NotProved("curve", "Newton's iteration does not converge", {"w": list(w)})

    def line(self, guess: Sequence[float], along: int, ends: tuple[Fraction, Fraction]) -> Line:
        """Return a line near the curve, from a guess in its middle."""
        middle = (ends[0] + ends[1]) / 2
        near = list(guess)
        near[along] = float(middle)
        w, J = self.newton(near, along)
        others = [k for k in range(len(w)) if k != along]
        C = np.linalg.inv(J[:, others])
        v = np.ones(len(w))
        v[others] = -C @ J[:, along]
        if not np.abs(C).max() < 1e9:
            raise NotProved("curve", "F' is nearly singular", {"w": w})
        centre = [decimal(x, 14) for x in w]
        centre[along] = middle
        return Line(along, ends, centre, [decimal(x, 8) for x in v.tolist()], in_units(C))

    def prove(self, line: Line) -> Cell:
        """Prove the same as `zeros`, and enclose the multipliers."""
        cell = self.zeros(line)
        return cell._replace(multipliers=self.multipliers(cell.wider))

    def zeros(self, line: Line) -> Cell:
        """Prove that the curve has one point for each s; see the statement of this module."""
        along, curve, of = line.along, self.curve, self.balls
        C, one = line.preconditioner, _one(curve.size, along)
        with interval.guarded():
            value = curve.value(line.at(interval.ZERO), of)
        F = C * interval.column(value)
        offset, w1 = spread(line), interval.column(line.direction)
        place, aside = line.at(offset), [interval.ZERO] * (curve.size + 1)
        reach = [Fraction(0)] * len(aside)
        for _ in range(TRIALS):
            blocks = curve.blocks([x + b for x, b in zip(place, aside, strict=True)], of)
            CA = C * interval.matrix(curve.rows(blocks))  # with a column for s, which b has not
            K = ((one - CA) * interval.column(aside) - F - CA * w1 * offset).entries()
            K.insert(along, interval.ZERO)
            inside = [abs(x) < MARGIN * b.rad() for x, b in zip(K, aside, strict=True)]
            if all(inside[:along] + inside[along + 1 :]):
                return Cell(line, reach, tuple(K), [])
            reach = _reach(K)
            reach[along] = Fraction(0)
            aside = [interval.symmetric(interval.ball(r)) for r in reach]
        raise NotProved("curve", "K does not lie inside of the box of a cell", {"s": place[along]})

    def rates(self, box: Box, along: int) -> list[Ball]:
        """Return an enclosure of dw/ds."""
        curve, size = self.curve, self.curve.size
        rows = curve.rows(curve.blocks(box, self.balls))
        others = [k for k in range(size + 1) if k != along]
        A = interval.matrix([[row[k] for k in others] for row in rows])
        b = interval.column([-row[along] for row in rows])
        try:
            rates: list[Ball] = A.solve(b).entries()
        except ZeroDivisionError:
            raise NotProved("curve", "F' may be singular along the curve") from None
        return [*rates[:along], interval.ONE, *rates[along:]]

    def multipliers(self, box: Box) -> list[Ball]:
        """Return the elementary symmetric functions of the multipliers of the orbits in a box."""
        D: Matrix = derivative(self.curve.of_round(self.curve.blocks(box, self.balls)))
        return symmetric(D, autonomous=self.curve.equations.autonomous)


def _reach(K: Sequence[Ball]) -> list[Fraction]:
    """Return short numbers above |K|, with room, none of them much smaller than another."""
    sizes = [float(interval.upper(abs(x))) for x in K]
    if not all(size < 1e3 for size in sizes):
        raise NotProved("curve", "a cell is too long", {"K": K[0]})
    above = [decimal(max(ROOM * size, 1e-60), 3) for size in sizes]
    least = max(above) / EVEN
    return [max(least, r) for r in above]


def decimal(x: float, digits: int) -> Fraction:
    """Return a decimal of so many significant digits near a double."""
    return Fraction(Decimal(f"{x:.{digits}g}"))


def in_units(C: Any) -> list[list[float]]:
    """Return a matrix in units of 2^-48, exact doubles."""
    rows: list[list[float]] = (np.round(C * 2.0**SHIFT) / 2.0**SHIFT).tolist()
    return rows
