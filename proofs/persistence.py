"""Theorem (persistence).  Let Φ be the stroboscopic map of

    x'' = F cos ωt - f sgn x' - μ x',   l < x < r,   v -> -(1-ε) v at the walls,   T = 2π/ω,

and let P(0, 0) be an elliptic fixed point of it for ε = μ = 0, with N hits per period and no
turning.  If the lemmas succeed, then

 (i)   at the ε and μ given, Φ has exactly one fixed point P(ε, μ) in an explicit box, with the same
       hits, det Φ'(P) = exp(-μT) (1-ε)^(2N), both multipliers inside the unit circle, and an
       explicit ellipse around it in its basin: theorem `cap.proofs.periodic`;
 (ii)  for all (ε, μ) of an explicit rectangle [0, e_0] x [0, m_0] there is a fixed point P(ε, μ)
       with these hits, it is one real analytic function of (ε, μ), elliptic at (0, 0), and
       asymptotically stable everywhere else.

Lemma 5 gives (ii), over the cells of a grid.  This is Theorem persistence of the paper with "small
ε and μ" made explicit, and its saltation matrix of an inelastic wall corrected: the lower left
entry is ((1+e) F cos ωt + (1-e) f sgn v)/v, v the velocity before the hit.
"""

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from typing import Any

from cap.certificate import writer as certificate
from cap.checker.flow.events import CELL_WORK
from cap.checker.flow.itinerary import MAX_WORK, work
from cap.errors import NotProved
from cap.floats import candidates
from cap.flow.event import TAYLOR_MODELS
from cap.flow.model import Constants
from cap.flow.strobe import oscillator
from cap.flow.windows import Itinerary
from cap.maps import family
from cap.maps.family import Cell, Pair
from cap.maps.fixed_point import FixedPoint, Start, refined
from cap.parameters import Parameters
from cap.proofs import periodic
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Around, Located, Proof, Setting, proof_of
from cap.proofs.orbit import EVENTS, need_hits
from cap.sets import interval, matrix
from cap.sets.interval import Ball

SUMMARY = "the elliptic orbit with inelastic walls and viscous friction: it becomes a sink"
GROUP = "orbit"
SEARCH = candidates.continued

BITS = 64  # enough for boxes of a thousandth
LONGEST = 40  # decimals of a node
PLACES = 9  # decimals of the hints
STEP = Fraction(1, 200), Fraction(1, 400)  # of the grid, in ε and μ, at first
FINEST = Fraction(1, 8)  # of that
FILLED = Fraction(1, 2)  # of a box, at most, by K: the checker loses more in its bounds
SHARED = (  # of its box holds the K of a neighbour, where this part of the orbit's box is claimed
    (Fraction(1, 2), Fraction(99, 100)),
    (Fraction(3, 10), Fraction(9, 10)),
    (Fraction(0), Fraction(3, 4)),
)
CROWDED = Fraction(9, 10)  # the same where it takes many cells to reach the (ε, μ) given
MOST_CELLS = 150  # the rectangle grows no further than needed


@dataclass
class Grid:
    """Cells over the rectangles between ``nodes`` of ε and of μ, which begin with 0."""

    nodes: tuple[list[Fraction], list[Fraction]]
    cells: dict[tuple[int, int], Cell] = field(default_factory=dict)

    def claims(self) -> dict[str, Any]:
        """Return the claim ``range``."""
        epsilon, mu = ([interval.exact_decimal(q) for q in side] for side in self.nodes)
        return {"epsilon": epsilon, "mu": mu, "boxes": [_box(c) for c in self.ordered()]}

    def below(self, corner: Pair) -> tuple[int, int]:
        """Return the cell that contains a point, the one below and left of it if it is a node."""
        i, j = (bisect_left(side, q) for side, q in zip(self.nodes, corner, strict=True))
        return max(i - 1, 0), max(j - 1, 0)

    def ordered(self) -> list[Cell]:
        """Return the cells, μ changing fastest."""
        return [self.cells[key] for key in sorted(self.cells)]


def _box(cell: Cell) -> dict[str, list[str]]:
    exact, sides = interval.exact_decimal, zip(cell.hint.centre, cell.reach, strict=True)
    x, v = ([exact(m - half), exact(m + half)] for m, half in sides)
    return {"x": x, "v": v}


def _hint(cell: Cell) -> dict[str, Any]:
    exact = interval.exact_decimal
    return {
        "centre": [exact(q) for q in cell.hint.centre],
        "preconditioner": [[exact(q) for q in row] for row in cell.hint.matrix],
        "events": [certificate.window(event.window) for event in cell.expected],
    }


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of the box of P*; return the rest of the proof.

    ``setting.start`` is a guess of P at its parameters.  Raises `NotProved` with the step that
    failed and the sets at which it did.
    """
    need_hits("persistence", setting)
    return proof_of("persistence", setting, EVENTS, conclusion)


def conclusion(orbit: Located) -> Callable[[Around], Content]:
    """Prove what the theorem says of P* and, when its box is known, of P(ε, μ)."""
    of_orbit = periodic.conclusion(orbit)

    @cache
    def family_with(shared: Fraction) -> Grid:
        with interval.workprec(BITS):
            return lemma_5_family(orbit.setting, orbit.point, shared)

    def conclude(around: Around) -> Content:
        claims, hints = of_orbit(around)
        grid = family_with(next(shared for least, shared in SHARED if around.part >= least))
        cells = [_hint(cell) for cell in grid.ordered()]
        return {**claims, "range": grid.claims()}, {**hints, "cells": cells}

    return conclude


def lemma_5_family(setting: Setting, point: FixedPoint, shared: Fraction) -> Grid:
    """*Statement.* Statement (ii), on a rectangle that contains the (ε, μ) given.

    *Computed.* `cap.maps.family` over each cell, that neighbours have the same fixed point on the
    common side, |trace| < 1 + det with det = exp(-μT) (1-ε)^(2N), and |trace| < 2 at (0, 0).  As
    det < 1 except at (0, 0), this means that both multipliers lie inside the unit circle.  In
    a cell that contains the (ε, μ) given, P is P* there.  Neighbours agree with only a part
    ``shared`` of their boxes.
    """
    p = setting.parameters
    grid = Grid(([Fraction(0)], [Fraction(0)]))
    given = 1 - p.e, p.mu
    x, v = (float(side.mid()) for side in point.box)
    builder = _Builder(setting, grid, replace(setting.start, x=x, v=v), shared)
    builder.reach(given)
    builder.grow()
    cell = grid.cells[grid.below(given)]
    if not cell.hint.contains(point.box, cell.reach):
        raise NotProved("Lemma 5", "P* may be another fixed point than that of the family")
    return grid


class _Builder:
    """Adds cells to a grid, proved one by one, column by column and row by row."""

    def __init__(self, setting: Setting, grid: Grid, start: Start, shared: Fraction) -> None:
        p = setting.parameters
        self.p, self.grid, self.start, self.progress = p, grid, start, setting.progress
        self.shared = shared
        self.fitting = _most_cells(len(start.events), setting.checker_bits)
        self.period = 2 * interval.pi() / interval.ball(p.omega)

    def reach(self, given: Pair) -> None:
        """Prove cells up to the (ε, μ) given: a single one, or if that fails as many as it takes.

        ``start`` is a guess of P there.  Raises `NotProved` with the rectangle that is reached.
        """
        corner = _or_steps(given)
        try:
            self._begin(corner, self.start)
        except NotProved:
            self.shared = min(self.shared, CROWDED)
            self._begin_small(given)
            self.grow(corner)
        reached = self.grid.nodes[0][-1], self.grid.nodes[1][-1]
        if reached != corner:
            e, m = map(interval.exact_decimal, reached)
            reason = f"the family is proved for epsilon <= {e}, mu <= {m} only"
            raise NotProved("Lemma 5", f"{reason} ({len(self.grid.cells)} cells)")

    def _begin(self, corner: Pair, start: Start) -> None:
        """Prove the cell between (0, 0) and the corner."""
        for side, end in zip(self.grid.nodes, corner, strict=True):
            side[:] = [Fraction(0), end]
        self._add((0, 0), start)

    def _begin_small(self, given: Pair) -> None:
        """Prove the cell between (0, 0) and the (ε, μ) given, or less far."""
        corner = _or_steps((min(given[0], STEP[0]), min(given[1], STEP[1])))
        try:
            self._begin(corner, self._back(given, corner))
        except NotProved as failure:
            reason = "P*, followed back to epsilon = mu = 0, is not proved to be of a family there"
            raise NotProved("Lemma 5", f"{reason}: {failure}") from None

    def _back(self, given: Pair, corner: Pair, steps: int = 50) -> Start:
        """Follow the guess from the (ε, μ) given to the middle of the cell up to the corner."""
        start = self.start
        for k in range(1, steps + 1):
            e, m = (q + (c / 2 - q) * k / steps for q, c in zip(given, corner, strict=True))
            hint, events = refined(oscillator(self._at(e, m)), start, [PLACES, PLACES])
            start = _start(hint.centre, events)
        return start

    def _at(self, epsilon: Fraction, mu: Fraction) -> Parameters:
        return replace(self.p, e=1 - epsilon, mu=mu)

    def grow(self, corner: Pair | None = None) -> None:
        """Extend the rectangle in turn to larger ε and larger μ while that succeeds.

        Not beyond the ``corner``, if there is one.
        """
        steps, open_sides = list(STEP), [0, 1]
        most = self.fitting if corner else min(MOST_CELLS, self.fitting)
        while open_sides:
            for side in tuple(open_sides):
                others = len(self.grid.nodes[1 - side]) - 1
                room = corner[side] - self.grid.nodes[side][-1] if corner else steps[side]
                if room == 0 or len(self.grid.cells) + others > most:
                    open_sides.remove(side)
                elif not self._extend(side, min(steps[side], room)):
                    steps[side] /= 2
                    if steps[side] < STEP[side] * FINEST:
                        open_sides.remove(side)

    def _extend(self, side: int, step: Fraction) -> bool:
        """Add a strip of cells beyond the largest ε or μ; return whether that succeeded."""
        nodes, number = self.grid.nodes[side], len(self.grid.nodes[side]) - 1
        nodes.append(nodes[-1] + step)
        keys = [
            (number, k) if side == 0 else (k, number)
            for k in range(len(self.grid.nodes[1 - side]) - 1)
        ]
        try:
            for key in keys:
                before = (key[0] - 1, key[1]) if side == 0 else (key[0], key[1] - 1)
                cell = self.grid.cells[before]
                self._add(key, _start(cell.hint.centre, cell.expected))
        except NotProved:
            nodes.pop()
            for key in keys:
                self.grid.cells.pop(key, None)
            return False
        return True

    def _rectangle(self, key: tuple[int, int]) -> tuple[Pair, Pair]:
        (i, j), (epsilon, mu) = key, self.grid.nodes
        return (epsilon[i], epsilon[i + 1]), (mu[j], mu[j + 1])

    def _add(self, key: tuple[int, int], start: Start) -> None:
        """Prove a cell and that it agrees with its neighbours so far."""
        rectangle = self._rectangle(key)
        (a, b), (c, d) = rectangle
        middle = self._at((a + b) / 2, (c + d) / 2)
        hint, events = refined(oscillator(middle), start, [PLACES, PLACES])
        cell = family.Problem(self._constants, rectangle, hint, events).prove()
        if not cell.hint.contains(cell.image, _part(FILLED, cell.reach)):
            raise NotProved("Lemma 5", "the box is too tight for a looser arithmetic to follow")
        for neighbour in ((key[0] - 1, key[1]), (key[0], key[1] - 1)):
            if neighbour in self.grid.cells:
                family.agree(cell, self.grid.cells[neighbour], self.shared)
        _stable(cell, len(start.events), self.period, origin=key == (0, 0))
        self.grid.cells[key] = cell
        (_, e), (_, m) = rectangle
        cells = len(self.grid.cells)
        self.progress(f"{cells} cells, up to epsilon = {float(e):.4g}, mu = {float(m):.4g}")

    def _constants(self, epsilon: Any, mu: Any) -> Constants[Any]:
        constants = Constants.of(self._at(Fraction(0), Fraction(0)), interval.ball)
        return constants._replace(e=1 - epsilon, mu=mu)


def _most_cells(events: int, bits: int) -> int:
    """Return how many cells a certificate may have, which the checker must finish in time."""
    return (MAX_WORK - work(events, bits)) // (events * CELL_WORK)


def _start(centre: Pair, events: Itinerary) -> Start:
    """Return the guess of a centre and events in windows."""
    x, v = map(float, centre)
    return Start(x, v, tuple((e.word, float(e.window.mid())) for e in events))


def _part(factor: Fraction, sides: Pair) -> Pair:
    return factor * sides[0], factor * sides[1]


def _or_steps(corner: Pair) -> Pair:
    """Return the corner, of decimals, of a rectangle up to there at least, no side being zero."""
    return _decimal(corner[0] or STEP[0]), _decimal(corner[1] or STEP[1])


def _decimal(q: Fraction) -> Fraction:
    """Return ``q`` if it is a decimal of at most `LONGEST` places, else one a little larger."""
    scale = 10 ** max(PLACES, 6 - interval.decade(q))
    return q if 10**LONGEST % q.denominator == 0 else Fraction(-(-q * scale // 1), scale)


def _stable(cell: Cell, hits: int, period: Ball, *, origin: bool) -> None:
    """Prove |trace| < 1 + det over the cell, and |trace| < 2 if it contains (0, 0)."""
    (_, most), (_, thick) = cell.rectangle
    trace = abs(TAYLOR_MODELS.bound(matrix.trace(cell.orbit.monodromy)))
    least = interval.ball((1 - most) ** (2 * hits)) * (-interval.ball(thick) * period).exp()
    if not trace < 1 + least or (origin and not trace < 2):
        sets = {"trace": trace, "least determinant": least}
        raise NotProved("Lemma 5", "a multiplier may lie outside the unit circle", sets)
