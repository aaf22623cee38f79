"""Periodic orbits along closed paths of coverings: short paths, Newton's method, a box for each.

The lemmas: `cap.checker.coverings.orbits`.  Paths and points come from floats; the boxes are
confirmed by the checker's own function, and what it refuses is left out.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from cap.checker.coverings.entropy import ORBITS
from cap.checker.coverings.orbits import confirm_orbits
from cap.checker.coverings.planar import Planar
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.sets import interval

PERIODS = range(1, 11)  # those looked for
EACH = 2  # orbits of one period, at most
TRIED = 40  # paths of one period, at most
VISITED = 100_000  # steps of the search for paths of one period, at most
PLACES = range(3, 13)  # half the width of a box is 10^-places: the first that will do
NEWTON, CLOSE = 40, 1e-10

Orbit = dict[str, Any]  # as a certificate holds it
Sets = list[list[Fraction]]
Edges = list[list[int]]


def periodic_orbits(g: Planar, sets: Sets, edges: Edges) -> list[Orbit]:
    """Return orbits that the checker confirms, a few of each period."""
    found: list[Orbit] = []
    for n in PERIODS:
        of_n: list[Orbit] = []
        for path in closed_paths(edges, n):
            if len(of_n) == EACH:
                break
            point = newton(g, sets, path)
            orbit = None if point is None else _boxed(g, sets, edges, path, point)
            if orbit is not None and _confirmed(g, sets, edges, [*of_n, orbit]):
                of_n.append(orbit)
        found += of_n
    return found


def closed_paths(edges: Sequence[Sequence[int]], n: int) -> Iterator[list[int]]:
    """Give closed paths of n coverings through n different sets, each from its least number on."""
    steps = given = 0
    for start in range(len(edges)):
        waiting = [[start]]
        while waiting:
            steps += 1
            if steps > VISITED or given >= TRIED:
                return
            path = waiting.pop()
            if len(path) < n:
                waiting += [[*path, j] for j in edges[path[-1]] if j > start and j not in path]
            elif start in edges[path[-1]]:
                given += 1
                yield path


def newton(g: Planar, sets: Sets, path: Sequence[int]) -> tuple[float, float] | None:
    """Return the first point of an orbit along a path, nearly; none if the method fails.

    Each step is cut off at the sides of the sets, within which g is defined.
    """
    n = len(path)
    numbers = np.array([[float(q) for q in sets[i]] for i in path])
    centre, axes = numbers[:, :2], numbers[:, 2:].reshape(n, 2, 2).swapaxes(1, 2)
    place = np.zeros((n, 2))  # p and q
    for _ in range(NEWTON):
        z = centre + np.einsum("kij,kj->ki", axes, place)
        slopes, missing = np.zeros((2 * n, 2 * n)), np.zeros((n, 2))
        for k, i in enumerate(path):
            try:
                image = g.on(i).image(Double(float(z[k, 0])), Double(float(z[k, 1])))
            except Rejected:
                return None
            after = (k + 1) % n
            missing[k] = image.x.mid - z[after, 0], image.y.mid - z[after, 1]
            here, there = slice(2 * k, 2 * k + 2), slice(2 * after, 2 * after + 2)
            derivative = np.array([[entry.mid for entry in row] for row in image.derivative])
            slopes[here, here] += derivative @ axes[k]
            slopes[here, there] -= axes[after]
        step = np.linalg.solve(slopes, missing.ravel()).reshape(n, 2)
        if np.abs(step).max() < CLOSE:
            return float(z[0, 0]), float(z[0, 1])
        place = np.clip(place - step, -1, 1)
    return None


def _boxed(
    g: Planar, sets: Sets, edges: Edges, path: Sequence[int], point: tuple[float, float]
) -> Orbit | None:
    """Return an orbit with the largest box, of those tried, that the checker confirms."""
    for places in PLACES:
        reach = Fraction(1, 10**places)
        ends = [(Fraction(x) - reach, Fraction(x) + reach) for x in point]
        box = [[_short(q, places + 4) for q in side] for side in ends]
        orbit = {"path": [str(i) for i in path], "box": box}
        if _confirmed(g, sets, edges, [orbit]):
            return orbit
    return None


def _short(q: Fraction, places: int) -> str:
    """Return a decimal near q; any box will do that the checker confirms."""
    return interval.exact_decimal(Fraction(round(q * 10**places), 10**places))


def _confirmed(g: Planar, sets: Sets, edges: Edges, orbits: list[Orbit]) -> bool:
    """Return whether the checker confirms orbits, read as from a certificate."""
    try:
        confirm_orbits(g, sets, edges, matched(orbits, ORBITS.shape.shape, "orbits"))
    except Rejected:
        return False
    return True
