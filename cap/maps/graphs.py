"""Graphs in floats: the strong component that grows fastest, its growth, its flow.  It steers."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Places = NDArray[np.int64]

STEPS, ROUNDS, CLOSE = 4000, 200, 1e-13
Flags = NDArray[np.bool_]


class Part(NamedTuple):
    """A strong component: its growth, and for all vertices the left and the right eigenvector.

    They are 0 outside of it.
    """

    growth: float
    left: Floats
    right: Floats

    def inside(self, source: Places, target: Places) -> Flags:
        """Return which edges lie in it."""
        return (self.right[source] > 0) & (self.right[target] > 0)

    def flow(self, source: Places, target: Places) -> Floats:
        """Return the part of the flow, that of the measure of most entropy, through each edge."""
        flow = self.left[source] * self.right[target]
        return np.asarray(flow / (flow.sum() or 1.0))


def fastest(source: Places, target: Places, count: int) -> Part:
    """Return the strong component with the largest growth; that is 0 if there is no cycle."""
    best = Part(0.0, np.zeros(count), np.zeros(count))
    for vertices in components(source, target, count):
        inside = np.zeros(count, dtype=bool)
        inside[vertices] = True
        kept = inside[source] & inside[target]
        if not kept.any():
            continue
        s, t = source[kept], target[kept]
        growth, right = _power(s, t, inside, count)
        if growth > best.growth:
            best = Part(growth, _power(t, s, inside, count)[1], right)
    return best


def _power(s: Places, t: Places, inside: Flags, count: int) -> tuple[float, Floats]:
    """Return the spectral radius of A and its eigenvector, by the power method on A + 1."""
    v: Floats = inside.astype(np.float64)
    growth = 1.0
    for k in range(STEPS):
        then = v + np.bincount(s, weights=v[t], minlength=count)
        growth = float(then.max())
        scaled: Floats = then / growth
        if k % 20 == 0 and np.abs(scaled - v).max() < CLOSE:
            break
        v = scaled
    return growth - 1, v


def in_time(source: Places, target: Places, times: Floats) -> Floats:
    """Return the eigenvector of exp(-s times) A with the value 1, for the s where that is largest.

    A step of s is that of Newton's method, with the largest time for the mean, so it never goes
    too far.
    """
    s, v = 0.0, np.ones(len(times))
    for _ in range(ROUNDS):
        weights = np.exp(-s * times)[source]
        for k in range(STEPS):
            then = v + np.bincount(source, weights=weights * v[target], minlength=len(v))
            growth = float(then.max())
            change = float(np.abs(then / growth - v).max())
            v = then / growth
            if k % 20 == 0 and change < CLOSE:
                break
        step = np.log(growth - 1) / times.max()
        s += step
        if abs(step) < CLOSE:
            break
    return v


def components(source: Places, target: Places, count: int) -> list[list[int]]:
    """Return the strong components, the largest ones first (Kosaraju)."""
    out, into = _lists(source, target, count), _lists(target, source, count)
    order, seen = list[int](), np.zeros(count, dtype=bool)
    for root in range(count):
        if not seen[root]:
            order += _visited(root, out, seen)
    found, seen = list[list[int]](), np.zeros(count, dtype=bool)
    for root in reversed(order):
        if not seen[root]:
            found.append(_visited(root, into, seen))
    return sorted(found, key=len, reverse=True)[:8]


def _lists(source: Places, target: Places, count: int) -> list[list[int]]:
    lists = [list[int]() for _ in range(count)]
    for i, j in zip(source.tolist(), target.tolist(), strict=True):
        lists[i].append(j)
    return lists


def _visited(root: int, edges: list[list[int]], seen: Flags) -> list[int]:
    """Return what is reached from a vertex and was not seen, in the order in which it is left."""
    seen[root] = True
    left, path = list[int](), [(root, iter(edges[root]))]
    while path:
        here, rest = path[-1]
        for then in rest:
            if not seen[then]:
                seen[then] = True
                path.append((then, iter(edges[then])))
                break
        else:
            left.append(here)
            path.pop()
    return left
