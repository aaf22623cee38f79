"""The states that go to the segment without a stick, found backwards from a strip.

See `cap.checker.folded.strips`.  All states of the strip at t = 0 go to the segment; so do those
that enter it.  Regions of the strip are followed backwards in outward-rounded doubles
(`cap.cells.entries`), and the best of them are chosen.
"""

from fractions import Fraction

from cap.cells.cuts import dearest
from cap.cells.entering import Half, search
from cap.cells.listing import written
from cap.cells.trees import Arc, Plan
from cap.checker.folded.backward import System
from cap.checker.folded.numbers import Pair
from cap.checker.folded.regions import Region
from cap.checker.folded.strips import counts, half_strip
from cap.checker.theorems.mixed import Mixed, below
from cap.proofs.fixed_point import Setting
from cap.proofs.places import target

NAMES = ("slow", "fast")
STROBES, POINTS = 24, 4
WORTH = 1e-5  # area that is missing of a region before it is cut
LEAVES = 2000  # regions that are followed


def by_strip(setting: Setting, theorem: Mixed) -> tuple[Fraction, dict[str, str]]:
    """Return the area of states that go to the segment without a stick, and the trees for it."""
    y, strip, V = System(theorem.p), theorem.strip(), below(theorem.region()[1])
    total, texts = Fraction(theorem.inside(y, V)), dict.fromkeys(NAMES, written([0]))
    if not counts(y, strip):
        return total, texts
    halves = [half_of(*half_strip(y, strip, fast=fast)) for fast in (False, True)]
    plan = Plan(WORTH, STROBES, points=POINTS)
    trees = search(setting.parameters, target(strip), halves, V, plan, setting.runner)
    price = dearest(trees, [tree.areas for tree in trees], LEAVES)
    for name, tree in zip(NAMES, trees, strict=True):
        chosen = tree.best(tree.areas, price)
        total += sum(map(Fraction, tree.areas[chosen].tolist()), Fraction(0))
        texts[name] = tree.text(chosen)
    return total, texts


def half_of(region: Region, speeds: Pair) -> Half:
    """Return half a strip."""
    low, high = speeds
    return Half((region.low, region.high), Arc((low + high) / 2, (high - low) / 2))
