"""Entropy and periodic orbits of a map of an interval, from cells that cover and meet each other.

G maps an interval I continuously into itself; cells follow each other from one end of I to the
other.  A *lap* is a part of a cell on which G is monotone; a cell has one or two.

*From above.*  B_JK is the number of laps of J, if the image of J meets K, else 0.  If B w <= S w
for a vector w > 0, the entropy is at most log S.  *Proof.*  There are at most C S^m sequences of m
laps that orbits follow.  The points that follow one of them are an interval, on which G, ..., G^m
are monotone.  Of k such points, in their order, let no two be within r of each other under all of
1, G, ..., G^(m-1): neighbours are apart under one of these, and under each at most |I|/r
neighbours are, as images are in order.  So k <= 1 + m |I|/r: at most C S^m (1 + m |I|/r) points of
I are apart.

*From below.*  J covers K, if K lies in the interior between the images of the ends of J; A is the
matrix of the coverings.  If its spectral radius is at least s (``growth``), the entropy is at least
log s.  *Proof.*  An
interval K in the interior between the images of the ends of J is the image of an interval whose
ends are taken to those of K, so it lies in the interior of J.  Hence for a path of m coverings
there is an interval which G^i takes into the interior of the i-th cell for i < m, and G^m onto the
last cell.  Intervals of different closed paths at J are disjoint, as interiors of cells are.  Let
there be k_m of them: G^m takes each over all, so its entropy is at least log k_m.  The spectral
radius of A is that of a strong component: lim sup (log k_m)/m >= log s for a J in it.

*Periodic orbits.*  The interval of a closed path contains a fixed point of G^m, as G^m takes it
over itself.  The path of this point is the only one: so G^m has at least tr A^m fixed points, and
those of a path that repeats no shorter one have the least period m.  Of such paths there are

    p_m = tr A^m - (the sum of p_d over the divisors d < m of m),

and G has at least p_m/m orbits of the least period m.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import accumulate

from cap.checker.kernel.exponential import exp
from cap.checker.kernel.rejection import need

Edges = Sequence[range]  # for each cell the cells that follow
PATHS = 1 << 22  # the longest closed paths times the cells squared


def sums(edges: Edges, vector: Sequence[int]) -> list[int]:
    """Return the vector, summed over the cells that follow each."""
    before = [0, *accumulate(vector)]
    return [before[e.stop] - before[e.start] for e in edges]


def confirm_bound(met: Edges, laps: Sequence[int], weights: Sequence[int], bound: Fraction) -> None:
    """Check that B w <= S w for a vector w > 0."""
    need(min(weights) > 0, "a weight is not positive")
    rows = zip(laps, sums(met, weights), weights, strict=True)
    need(all(n * x <= bound * w for n, x, w in rows), "B may grow faster than claimed")


def confirm_logarithms(low: Fraction, high: Fraction, growth: Fraction, bound: Fraction) -> None:
    """Check that log s and log S are between two numbers, 0 < low <= high < 64."""
    need(0 < low <= high < 64, "the entropy claimed is not between 0 and 64")
    need(exp(low).upper <= growth, "the entropy may be below its lower bound")
    need(bound <= exp(high).lower, "the entropy may be above its upper bound")


def closed_paths(covered: Edges, longest: int, most: int = PATHS) -> list[int]:
    """Return tr A, tr A^2, ..., up to this power.

    Cells that cover none are left out; the power times the square of the others is at most so much.
    """
    kept = [0, *accumulate(int(bool(e)) for e in covered)]
    edges = [range(kept[e.start], kept[e.stop]) for e in covered if e]
    work = longest * len(edges) ** 2
    need(work <= most, f"the periods of orbits and cells are too much: {work} > {most}")
    traces = [0] * longest
    for k in range(len(edges)):
        vector = [int(k == j) for j in range(len(edges))]
        for m in range(longest):
            vector = sums(edges, vector)
            traces[m] += vector[k]
    return traces


def orbits(traces: Sequence[int]) -> list[int]:
    """Return p_1, p_2/2, p_3/3, ..."""
    paths = list[int]()
    for m, trace in enumerate(traces, 1):
        paths.append(trace - sum(p for d, p in enumerate(paths, 1) if m % d == 0))
    return [p // m for m, p in enumerate(paths, 1)]


def rank(period: int) -> tuple[int, int]:
    """Return where a period is in Sharkovsky's order: 3, 5, .., 2 3, 2 5, .., 4 3, .., 8, 4, 2, 1.

    What comes first has the least pair.
    """
    twos = (period & -period).bit_length() - 1
    odd = period >> twos
    return (twos, odd) if odd > 1 else (1 << 16, -twos)
