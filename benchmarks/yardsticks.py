"""Entropy of planar maps given by formulas, for which others have published bounds.

    python benchmarks/yardsticks.py henon 4 5
    python benchmarks/yardsticks.py standard 2 3

The numbers are the symbols before and after by which sets are told apart.  The sets are found in
floats; coverings, the absence of diamonds and the growth are proved by the checker's functions, one
after the other, as of a certificate of ``horseshoe``.  The last line has processor time.
"""

import sys
import time
from collections.abc import Callable
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
from cap.floats.coverings.regions import regions
from cap.floats.coverings.saddles import Saddle, saddles
from cap.proofs.coverings import Proved, entropy, proved
from cap.runner import Runner

CELLS = 1000


class Yardstick(NamedTuple):
    """A map, for proofs and in floats, which of its saddles, and how its points are told apart."""

    map: Planar
    floats: planar.Planar
    number: int
    regions: Callable[[planar.Planar, Saddle], Regions]


def near_the_folds(g: planar.Planar, _saddle: Saddle) -> Regions:
    """Return the two sides of a line that passes near the folds of the Hénon attractor."""
    x0, x1, y0, y1 = window = np.array(g.window)
    steps = (np.arange(CELLS) + 0.5) / CELLS
    x, y = np.meshgrid(x0 + (x1 - x0) * steps, y0 + (y1 - y0) * steps, indexing="ij")
    return Regions((x > -0.1 + 0.3 * y).astype(np.int64), window, np.array([0.0, 1.0]))


def yardstick(name: str) -> Yardstick:
    """Return a map by its name."""
    if name == "henon":
        a, b = Fraction(7, 5), Fraction(3, 10)
        return Yardstick(Henon(a, b), planar.henon(float(a), float(b)), 0, near_the_folds)
    return Yardstick(Standard(Fraction(2)), planar.standard(2.0), 0, regions)


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
    name, before, after = words[0], int(words[1]), int(words[2])
    known, begin = yardstick(name), time.process_time()
    saddle = saddles(known.floats)[known.number]
    leaves = Leaves(known.floats, saddle, known.regions(known.floats, saddle), before, after)
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
