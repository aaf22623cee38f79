"""Cones along the coverings of disjoint sets, and how much they stretch.

The lemmas: `cap.checker.coverings.cones`.  Directions come from floats: those that most steps
forwards lead to, and most steps back.  One slope for all sets is tried first; else slopes and units
are fitted (`cone_fields`).  The checker's own functions decide.
"""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from cap.checker.coverings.cones import carried
from cap.checker.coverings.covering import Parallelogram
from cap.checker.coverings.entropy import cone_rates, cones_of
from cap.checker.coverings.planar import Matrix, Planar, inverse, product
from cap.checker.kernel.rejection import Rejected
from cap.maps.graphs import Floats, Places, fastest
from cap.proofs.cone_fields import Field, Sizes, fitted
from cap.runner import Runner
from cap.sets import interval

ROUNDS = 30  # of directions, carried along
SLOPES = Fraction(1), Fraction(2), Fraction(4), Fraction(1, 2), Fraction(8)
SHORT, PLACES, DIGITS = 10**6, 4, 6  # of directions; of the rates; of slopes and units
OUT = 0.03  # of the coverings without cones: so many are left out at once
RARE = 1e-4  # a flow so small does not matter
Sets = list[list[Fraction]]
Edges = list[list[int]]
Edge = tuple[int, int]


class Cones(NamedTuple):
    """Directions, slopes and units, as a certificate holds them, and the rates."""

    given: dict[str, Any]
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
        rows = {
            name: [[interval.exact_decimal(q) for q in row] for row in self.given[name]]
            for name in self.given
            if name != "slope"
        }
        return {"slope": interval.exact_decimal(self.given["slope"]), **rows}


def cones(g: Planar, sets: Sets, edges: Edges, runner: Runner) -> Cones | None:
    """Return cones that the checker's functions confirm; none if they do not."""
    found = matrices(g, sets, edges, runner)
    pairs = [(i, j) for i, targets in enumerate(edges) for j in targets]
    if any(pair not in found for pair in pairs):
        return None
    listed = [[found[i, j] for j in targets] for i, targets in enumerate(edges)]
    for given in _fields(found, pairs, len(sets)):
        try:
            stretch, shrink = cone_rates(listed, edges, cones_of(given))
        except Rejected:
            continue
        unit = 10**PLACES
        low, high = (
            Fraction(math.floor(stretch * unit), unit),
            Fraction(math.ceil(shrink * unit), unit),
        )
        if low > 1 > high:
            return Cones(given, low, high)
    return None


def _fields(found: dict[Edge, Matrix], pairs: list[Edge], count: int) -> Iterator[dict[str, Any]]:
    """Give cones to try, as a certificate holds them."""
    leaning = directions(found, pairs, count)
    yield from ({"slope": slope, "leaning": leaning} for slope in SLOPES)
    source, target = _ends(pairs)
    field = fitted(sizes(found, pairs, leaning), source, target, count)
    if not field.bad.any():
        units = [[_digits(q) for q in row] for row in zip(*field[:3], strict=True)]
        yield {"slope": Fraction(1), "leaning": leaning, "units": units}


def with_cones(g: Planar, sets: Sets, edges: list[Edge], runner: Runner) -> list[Edge]:
    """Return coverings along which cones are mapped into cones, nearly; none if they make no loops.

    Of those for which that fails a few are left out, with the least flow for what they bend; then
    cones are fitted again.
    """
    lists: Edges = [[] for _ in sets]
    for i, j in edges:
        lists[i].append(j)
    found = matrices(g, sets, lists, runner)
    kept = [edge for edge in edges if edge in found]
    while kept:
        source, target = _ends(kept)
        part = fastest(source, target, len(sets))
        if part.growth <= 1:
            return []
        kept = [edge for edge in kept if part.right[edge[0]] > 0 and part.right[edge[1]] > 0]
        source, target = _ends(kept)
        known = sizes(found, kept, directions(found, kept, len(sets)))
        field = fitted(known, source, target, len(sets))
        if not field.bad.any():
            return kept
        out = _worst(known, field, part.flow(source, target))
        kept = [edge for k, edge in enumerate(kept) if k not in out]
    return []


def _worst(known: Sizes, field: Field, flow: Floats) -> set[int]:
    """Return which coverings are left out next: those that may have a fold first."""
    folds = np.flatnonzero(known.along <= 0)
    if len(folds) > 0:
        return set(folds.tolist())
    bent = known.aside * known.bent / known.along + np.maximum(0, 1 - known.along)
    score = np.where(field.bad, bent / (flow + RARE), -1)
    return set(np.argsort(-score)[: math.ceil(OUT * field.bad.sum())].tolist())


def matrices(g: Planar, sets: Sets, edges: Edges, runner: Runner) -> dict[Edge, Matrix]:
    """Return the matrices along coverings, where they are bounded."""
    tasks = [(i, sets[i], [sets[j] for j in targets]) for i, targets in enumerate(edges)]
    found = runner.map(partial(_carried, g), tasks, "cones are looked for", processes=True)
    return {
        (i, j): A
        for i, (targets, of_i) in enumerate(zip(edges, found, strict=True))
        for j, A in zip(targets, of_i, strict=True)
        if A is not None
    }


def _carried(
    g: Planar, task: tuple[int, list[Fraction], list[list[Fraction]]]
) -> list[Matrix | None]:
    """Return the matrices along all coverings by a set; none where one is not bounded."""
    i, source, targets = task
    found = list[Matrix | None]()
    for target in targets:
        try:
            found += carried(g.on(i), Parallelogram(source), [Parallelogram(target)])
        except Rejected:
            found.append(None)
    return found


def directions(
    found: dict[Edge, Matrix], pairs: Iterable[Edge], count: int
) -> list[list[Fraction]]:
    """Return sigma and tau for each set, in the middle of those that coverings lead to."""
    middle = {
        edge: np.array([[entry.mid for entry in row] for row in found[edge]]) for edge in pairs
    }
    sigma, tau = np.zeros(count), np.zeros(count)
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


def sizes(found: dict[Edge, Matrix], pairs: list[Edge], leaning: list[list[Fraction]]) -> Sizes:
    """Return how large the entries are, along these directions."""
    axes = [one.axes for one in cones_of({"slope": Fraction(1), "leaning": leaning})]
    rows = []
    for i, j in pairs:
        (along, aside), (bent, across) = product(inverse(axes[j]), product(found[i, j], axes[i]))
        least = max(along.lower, -along.upper)
        rows.append((least, aside.magnitude, bent.magnitude, across.magnitude))
    return Sizes(*np.array(rows).T)


def _ends(pairs: list[Edge]) -> tuple[Places, Places]:
    """Return where coverings begin, and where they end."""
    ends = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return ends[:, 0].copy(), ends[:, 1].copy()


def _short(x: float) -> Fraction:
    return Fraction(round(Fraction(x) * SHORT), SHORT) if math.isfinite(x) else Fraction(0)


def _digits(x: float) -> Fraction:
    """Return a decimal of a few digits near a positive number."""
    return Fraction(f"{x:.{DIGITS - 1}e}")
