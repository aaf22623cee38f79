"""Cones along the coverings of disjoint sets, and how much they stretch.

The lemmas: `cap.checker.coverings.cones`.  Directions come from floats: those that most steps
forwards lead to, and most steps back; the checker's own functions decide.
"""

import math
from collections import defaultdict
from fractions import Fraction
from functools import partial
from typing import NamedTuple

import numpy as np

from cap.checker.coverings.cones import Matrix, carried
from cap.checker.coverings.covering import Parallelogram
from cap.checker.coverings.entropy import cone_rates
from cap.checker.coverings.planar import Planar
from cap.checker.kernel.rejection import Rejected
from cap.runner import Runner
from cap.sets import interval

ROUNDS = 30  # of directions, carried along
SLOPES = Fraction(1), Fraction(2), Fraction(4), Fraction(1, 2), Fraction(8)
SHORT, PLACES = 10**6, 4  # of directions; of the rates
Sets = list[list[Fraction]]
Edges = list[list[int]]


class Cones(NamedTuple):
    """A slope for all, the directions of each set, and the rates."""

    slope: Fraction
    leaning: list[list[Fraction]]
    stretch: Fraction
    shrink: Fraction

    def claims(self) -> dict[str, str]:
        """Return the rates, as claimed."""
        return {
            "stretch": interval.exact_decimal(self.stretch),
            "shrink": interval.exact_decimal(self.shrink),
        }

    def hints(self) -> dict[str, object]:
        """Return what the certificate says of the cones."""
        leaning = [[interval.exact_decimal(q) for q in pair] for pair in self.leaning]
        return {"slope": interval.exact_decimal(self.slope), "leaning": leaning}


def cones(g: Planar, sets: Sets, edges: Edges, runner: Runner) -> Cones | None:
    """Return cones that the checker's functions confirm; none if they do not."""
    tasks = [(i, sets[i], [sets[j] for j in targets]) for i, targets in enumerate(edges)]
    found = runner.map(partial(_carried, g), tasks, "cones are looked for", processes=True)
    matrices = [each for each in found if each is not None]
    if len(matrices) < len(tasks):
        return None
    leaning = directions(matrices, edges)
    for slope in SLOPES:
        try:
            stretch, shrink = cone_rates(matrices, edges, leaning, slope)
        except Rejected:
            continue
        unit = 10**PLACES
        low, high = (
            Fraction(math.floor(stretch * unit), unit),
            Fraction(math.ceil(shrink * unit), unit),
        )
        if low > 1 > high:
            return Cones(slope, leaning, low, high)
    return None


def _carried(
    g: Planar, task: tuple[int, list[Fraction], list[list[Fraction]]]
) -> list[Matrix] | None:
    """Return the matrices along all coverings by a set; none if one is not bounded."""
    i, source, targets = task
    try:
        return carried(g.on(i), Parallelogram(source), [Parallelogram(each) for each in targets])
    except Rejected:
        return None


def directions(matrices: list[list[Matrix]], edges: Edges) -> list[list[Fraction]]:
    """Return sigma and tau for each set, in the middle of those that coverings lead to."""
    middle = {
        (i, j): np.array([[entry.mid for entry in row] for row in A])
        for i, targets in enumerate(edges)
        for j, A in zip(targets, matrices[i], strict=True)
    }
    sigma, tau = np.zeros(len(edges)), np.zeros(len(edges))
    for _ in range(ROUNDS):
        forwards, back = defaultdict[int, list[float]](list), defaultdict[int, list[float]](list)
        for (i, j), A in middle.items():
            p, q = A @ (1.0, sigma[i])
            forwards[j].append(q / p)
            p, q = np.linalg.solve(A, (tau[j], 1.0))
            back[i].append(p / q)
        for j, slopes in forwards.items():
            sigma[j] = (min(slopes) + max(slopes)) / 2
        for i, slopes in back.items():
            tau[i] = (min(slopes) + max(slopes)) / 2
    return [[_short(s), _short(t)] for s, t in zip(sigma, tau, strict=True)]


def _short(x: float) -> Fraction:
    return Fraction(round(Fraction(x) * SHORT), SHORT) if math.isfinite(x) else Fraction(0)
