"""A rectangle of states in cells, halved where no fate is certain: a tree, as letters.

In order, 0 or 1 halves a part across its first or second side, r is a cell whose motions all rest
before the end, f one whose motions all fly until then, - a part of which nothing is certain.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cap.areas.resting.fates import FLIES, RESTS, Sides, fates
from cap.areas.resting.pull import Pull, table
from cap.sets.compiled import PROBE, require_ieee

DEEPEST = 48  # halvings: the ends of cells are multiples of 2^-48 of a side

Tell = Callable[[str, float | None], None]


class Swept(NamedTuple):
    """The letters; the shares of the rectangle that rest, and that fly, in units of 2^-48."""

    tree: str
    rests: int
    flies: int


def sweep(p: Pull, sides: Sides, cells: int, tell: Tell = lambda *_: None) -> Swept:
    """Halve until there are about so many cells, the largest undecided ones first."""
    grid = table(p)
    places = np.array([[0.0, 1.0, 0.0, 1.0]])
    levels, shares, decided = list[np.ndarray](), [0, 0], 0
    while True:
        found = np.empty(len(places), dtype=np.int8)
        require_ieee(fates(p, grid, PROBE, sides, places, found))
        levels.append(found)
        for k, fate in enumerate((RESTS, FLIES)):
            shares[k] += int((found == fate).sum()) << DEEPEST - len(levels) + 1
        left = found <= 0
        decided += len(places) - int(left.sum())
        told = f"{decided + int(left.sum())} cells of the rectangle are followed"
        tell(told, None)
        if not left.any() or decided + 2 * int(left.sum()) > cells or len(levels) > DEEPEST:
            return Swept(_letters(levels), *shares)
        places = _halves(places[left], -found[left].astype(int))


def _halves(places: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Return the halves of cells, each across one side: those of one cell one after the other."""
    rows, low = np.arange(len(places)), 2 * across
    halves = np.repeat(places, 2, axis=0)
    middles = 0.5 * (places[rows, low] + places[rows, low + 1])
    halves[2 * rows, low + 1] = halves[2 * rows + 1, low] = middles
    return halves


def _letters(levels: list[np.ndarray]) -> str:
    """Return the tree from the fates of each level; halves of which nothing is certain are one."""
    names = {RESTS: "r", FLIES: "f"}
    below: list[str] = []
    for depth, found in enumerate(reversed(levels)):
        words, parts = list[str](), iter(below)
        for fate in found.tolist():
            if fate in names:
                words.append(names[fate])
            elif not depth:
                words.append("-")
            else:
                pair = next(parts) + next(parts)
                words.append("-" if pair == "--" else f"{-fate}{pair}")
        below = words
    return below[0]
