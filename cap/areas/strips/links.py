"""Compiled: which cells touch each other, in a column or over a line.  It steers."""

from cap.areas.strips.cover import Cover, Integers, at, same
from cap.sets.compiled import kernel, sources
from cap.sets.kept import kept

FAR = 1e9
OVER = 1e-7  # by so much cells meet over a line


@kernel
def _root(parent: Integers, k: int) -> int:
    while parent[k] != k:
        k = parent[k]
    return k


@kernel
def _join(parent: Integers, k: int, m: int) -> None:
    """Join two sets; the root is the least."""
    k, m = _root(parent, k), _root(parent, m)
    if k < m:
        parent[m] = k
    else:
        parent[k] = m


@kernel
def _interval(cover: Cover, j: int, i: int, s: float) -> tuple[float, float]:
    """Return the ends of a cell at a side: the bottom comes first, and the top last."""
    if i < cover.start[j]:
        return -FAR, at(cover.bottom[j], s) if cover.has_bottom[j] else -2 * FAR
    if i == cover.start[j + 1]:
        return at(cover.top[j], s), FAR
    return at(cover.cells[i, :3], s), at(cover.cells[i, 3:], s)


@kernel
def _number(cover: Cover, j: int, i: int) -> int:
    """Return the number of a cell among all: 0 is that of the tops, then come the bottoms."""
    if i < cover.start[j]:
        return 1 + j
    return 0 if i == cover.start[j + 1] else 1 + len(cover.top) + i


@kernel
def _along(cover: Cover, parent: Integers, j: int) -> None:
    """Join the cells of a column that have an edge in common."""
    first, end = cover.start[j], cover.start[j + 1]
    for i in range(first - 1, end):
        if i >= first or cover.has_bottom[j]:
            edge = cover.bottom[j] if i < first else cover.cells[i, 3:]
            if same(edge, cover.top[j] if i + 1 == end else cover.cells[i + 1, :3]):
                _join(parent, _number(cover, j, i), _number(cover, j, i + 1))


@kernel
def _over(cover: Cover, parent: Integers, j: int) -> None:
    """Join the cells of a column to those of the next one that they touch."""
    i, k = cover.start[j] - 1, cover.start[j + 1] - 1
    while i <= cover.start[j + 1] and k <= cover.start[j + 2]:
        a, b = _interval(cover, j, i, 1.0)
        c, d = _interval(cover, j + 1, k, -1.0)
        if min(b, d) - max(a, c) > OVER:
            _join(parent, _number(cover, j, i), _number(cover, j + 1, k))
        if b <= d:
            i += 1
        else:
            k += 1


def _link(cover: Cover, parent: Integers) -> None:
    """Find the links of all cells; ``parent`` (1 + C + N,) is room."""
    C = len(cover.top)
    for k in range(len(parent)):
        parent[k] = k
    for j in range(C):
        _along(cover, parent, j)
    for j in range(C - 1):
        _over(cover, parent, j)
    for j in range(C):
        cover.under[j] = _root(parent, 1 + j)
    for i in range(len(cover.links)):
        cover.links[i] = _root(parent, 1 + C + i)


link = kept(_link, sources(), error_model="numpy")
