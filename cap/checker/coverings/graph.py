"""Entropy and periodic points from a graph of coverings, for sets that may overlap.

Vertices are sets, edges coverings; A is the adjacency matrix, rho(A) its spectral radius.  Each
vertex has an edge from it and one to it, so it lies on a bi-infinite path.  Lambda is the set of
the points z_0 of orbits (z_k) along bi-infinite paths, z_k in N_(i_k): it is compact (the graph is
finite, the sets are compact, g is continuous on them), and g(Lambda) = Lambda.  h is the
topological entropy of g on Lambda.

*Disjoint sets.*  The path of an orbit is unique, and depends continuously on z_0; each path occurs
(Lemma 1 of ``covering``).  So g on Lambda is semiconjugate onto the subshift of paths (if g is
injective; else of forward paths), and h >= log rho(A).

*Overlapping sets.*  Coverings alone prove no entropy: for g(x) = 2x modulo 1 and three copies of
one arc around 0 all nine coverings hold, and rho(A) = 3 > 2.  Let O be the set of the pairs of
different sets that are not disjoint.  A *diamond* is a pair of paths of m >= 2 edges with the same
first and the same last vertex, and pairs in O between.

*Lemma 3.*  Without a diamond, h >= log rho(A), and g^n has at least tr(A^n)/mu fixed points in
Lambda, if no more than mu sets are pairwise in O.  *Proof.*  Let two different paths of n edges
have the same first and the same last vertex.  From where they part to where they meet again the
pairs between are not all in O: there would be a diamond.  So at some time they are in disjoint
sets.  Let d > 0 be the least distance of two disjoint sets.  Orbits along the (A^n)_ij paths from i
to j, continued to bi-infinite ones, are d apart at some time from 0 to n.  So for each n there are
at least max_ij (A^n)_ij such orbits, which is |A^n| up to a factor that does not depend on n: hence
h >= lim (1/n) log |A^n| = log rho(A).  For the second part, let several closed paths of n edges
belong to one point (Lemma 2 of ``covering``).  At each time their sets have a common point, so they
are equal or in O.  If two of them agreed at some time, they would also n later, and between they
would have a diamond, or be equal.  So at the time 0 they are pairwise in O: at most mu.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import lcm

from cap.checker.kernel.exponential import exp
from cap.checker.kernel.growth import Edges
from cap.checker.kernel.rejection import need

Point = tuple[int, int]
MOST_PAIRS = 1 << 20


def confirm_paths(edges: Edges) -> None:
    """Check that every vertex has an edge from it and one to it, and that no edge is repeated."""
    reached = {j for targets in edges for j in targets}
    need(reached == set(range(len(edges))), "a set is covered by none, or an edge leads nowhere")
    need(all(len(targets) > 0 for targets in edges), "a set covers none")
    need(all(len(set(t)) == len(t) for t in edges), "a covering is listed twice")


def overlaps(sets: Sequence[Sequence[Fraction]]) -> list[set[int]]:
    """Return for each parallelogram those others that are not disjoint from it, exactly.

    Two of them are disjoint if and only if the direction of a side of one separates them.
    """
    places = lcm(*(number.denominator for numbers in sets for number in numbers))
    corners = [_corners([int(n * places) for n in numbers]) for numbers in sets]
    found, pairs = [set[int]() for _ in sets], 0
    for i, j in _near(corners):
        if not _separated(corners[i], corners[j]) and not _separated(corners[j], corners[i]):
            found[i].add(j)
            found[j].add(i)
            pairs += 1
            need(pairs <= MOST_PAIRS, "too many sets overlap")
    return found


def _corners(numbers: Sequence[int]) -> list[Point]:
    """Return the corners, in their order around the parallelogram."""
    x, y, ax, ay, bx, by = numbers
    signs = (1, 1), (1, -1), (-1, -1), (-1, 1)
    return [(x + s * ax + t * bx, y + s * ay + t * by) for s, t in signs]


def _near(corners: Sequence[list[Point]]) -> Iterator[tuple[int, int]]:
    """Give the pairs whose shadows on both axes meet."""
    ends = [
        (min(x for x, _ in each), max(x for x, _ in each), min(y for _, y in each),
         max(y for _, y in each), k)
        for k, each in enumerate(corners)
    ]  # fmt: skip
    open_ = list[tuple[int, int, int, int, int]]()
    for this in sorted(ends):
        open_ = [other for other in open_ if other[1] >= this[0]]
        for other in open_:
            if other[2] <= this[3] and this[2] <= other[3]:
                yield other[4], this[4]
        open_.append(this)


def _separated(one: list[Point], other: list[Point]) -> bool:
    """Return whether the direction of a side of the first separates the two."""
    for k in (0, 1):
        (x0, y0), (x1, y1) = one[k], one[k + 1]
        nx, ny = y0 - y1, x1 - x0
        mine = [nx * x + ny * y for x, y in one]
        its = [nx * x + ny * y for x, y in other]
        if max(mine) < min(its) or max(its) < min(mine):
            return True
    return False


def confirm_no_diamond(edges: Edges, overlapping: Sequence[set[int]]) -> int:
    """Check that there is no diamond; return how many pairs of vertices two paths can reach.

    Pairs of O are followed from all that one vertex leads to, as long as they are in O.
    """
    waiting, seen = list[Point](), set[Point]()

    def meet(to_i: Sequence[int], to_j: Sequence[int]) -> None:
        for b in to_i:
            for c in overlapping[b].intersection(to_j):
                if (b, c) not in seen:
                    seen.update({(b, c), (c, b)})
                    waiting.append((b, c))

    for targets in edges:
        meet(targets, targets)
    while waiting:
        i, j = waiting.pop()
        need(not set(edges[i]) & set(edges[j]), "two paths make a diamond: the sets overlap")
        meet(edges[i], edges[j])
    return len(seen)


def confirm_entropy(entropy: Fraction, growth: Fraction, iterates: int) -> None:
    """Check that entropy <= iterates log(growth): exp(entropy/iterates) <= growth."""
    y = entropy / iterates
    need(0 <= y < 1, "the entropy claimed is not between 0 and the number of iterates")
    need(exp(y).upper <= growth, "the entropy claimed is more than the growth shows")
