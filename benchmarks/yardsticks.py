"""Entropy of planar maps given by formulas, for which others have published bounds.

    python benchmarks/yardsticks.py henon 2 4 8 1
    python benchmarks/yardsticks.py standard 2 3 5 5

The numbers are the symbols before and after by which sets are told apart, and the columns and rows
of the cells that are symbols.  The sets are found in
floats; coverings, the absence of diamonds and the growth are proved by the checker's functions, one
after the other, as of a certificate of ``horseshoe``.  The last line has processor time.
"""

import math
import sys
import time
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cap.checker.coverings import graph
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.formulas import Henon, Standard
from cap.checker.coverings.planar import Planar
from cap.checker.kernel.rounding import in_doubles
from cap.floats.coverings import planar
from cap.floats.coverings.family import family
from cap.floats.coverings.leaves import Leaves, Regions
from cap.floats.coverings.saddles import Saddle, saddles
from cap.proofs.coverings import Proved, entropy, proved
from cap.runner import Runner

FINE = 60  # entries of the table of a cell, in each direction


class Yardstick(NamedTuple):
    """A map, for proofs and in floats; points are told apart by the cells of a grid."""

    map: Planar
    floats: planar.Planar
    window: tuple[float, float, float, float]
    cells: tuple[int, int]

    def saddle(self) -> Saddle:
        """Return the saddle farthest to the right: of the Hénon map that in the attractor."""
        return max(saddles(self.floats), key=lambda saddle: float(saddle.point[0]))

    def regions(self, saddle: Saddle) -> Regions:
        """Return the cells, and the stable direction of the saddle."""
        columns, rows = (np.arange(count * FINE) // FINE for count in self.cells)
        table = columns[:, None] * self.cells[1] + rows[None, :]
        return Regions(table.astype(np.int64), np.array(self.window), saddle.stable)


def yardstick(name: str, cells: tuple[int, int]) -> Yardstick:
    """Return a map by its name."""
    if name == "henon":
        a, b = Fraction(7, 5), Fraction(3, 10)
        window = -1.3, 1.3, -0.4, 0.4
        return Yardstick(Henon(a, b), planar.henon(float(a), float(b)), window, cells)
    whole = -math.pi, math.pi, -math.pi, math.pi
    return Yardstick(Standard(Fraction(2)), planar.standard(2.0), whole, cells)


@in_doubles()
def confirm(g: Planar, found: Proved) -> Fraction:
    """Check everything once more, by the functions of the checker; return the entropy."""
    graph.confirm_paths(found.edges)
    graph.confirm_no_diamond(found.edges, graph.overlaps(found.sets))
    for numbers, targets in zip(found.sets, found.edges, strict=True):
        covers(g, Parallelogram(numbers), [Parallelogram(found.sets[j]) for j in targets])
    graph.confirm_growth(found.edges, found.vector, found.growth)
    bound = entropy(found.growth, 1)
    graph.confirm_entropy(bound, found.growth, 1)
    return bound


def main(words: list[str]) -> None:
    """Prove a bound of the entropy, and say what it took."""
    name, (before, after, *cells) = words[0], map(int, words[1:5])
    known, begin = yardstick(name, (cells[0], cells[1])), time.process_time()
    saddle = known.saddle()
    leaves = Leaves(known.floats, saddle, known.regions(saddle), before, after)
    found = proved(known.map, family(known.floats, saddle, leaves), Runner(), disjoint=False)
    proving = time.process_time() - begin
    bound = confirm(known.map, found)
    checking = time.process_time() - begin - proving
    coverings = sum(map(len, found.edges))
    print(
        f"{name}: entropy at least {float(bound):.8f}; {len(found.sets)} sets, {coverings} "
        f"coverings; {proving:.1f} s to find and prove, {checking:.1f} s to check"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
