# ruff: noqa: PLR0913, PLR0917 (compiled functions take arrays, not records)
"""Words on the unstable manifold of a saddle: pieces of leaves, with what is seen before and after.

A *symbol* of a step z -> g(z) tells the region of z, and whether g keeps the orientation of the
unstable direction, as oriented by a half-plane.  A *piece* has a word of m symbols before and n
symbols from it on; of all points with these words on one leaf it knows a middle, the tangent, and
how far they reach along it.  Pieces are followed once, as far as they survive ``MORE`` steps more.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numba.extending import register_jitable

from cap.floats.coverings.planar import Floats, Planar, image, images, kept
from cap.floats.coverings.saddles import Saddle

MORE = 4
NEAR, TINY, ROOM = 0.1, 1e-6, 4000  # of sizes; of a piece; parts of a piece
MOST = 20_000  # pieces
Word = tuple[int, ...]
Key = tuple[Word, Word]


class Regions(NamedTuple):
    """Regions as a table (N, N) of numbers over the window (x0, x1, y0, y1), and a direction."""

    table: Any
    window: Floats
    direction: Floats


class Piece(NamedTuple):
    """A piece of a leaf: z + s T for s in [low, high]."""

    z: Floats
    T: Floats
    low: float
    high: float


@register_jitable
def _cell(t: float, low: float, high: float, count: int) -> int:
    return min(max(int((t - low) / (high - low) * count), 0), count - 1)


@register_jitable
def _word(
    kind: Any,
    y: Any,
    table: Any,
    window: Any,
    direction: Any,
    x: Any,
    v: Any,
    p: Any,
    q: Any,
    out: Any,
) -> Any:
    """Write the symbols of an orbit with a tangent; return whether it goes on so long."""
    before = 1.0 if p * direction[0] + q * direction[1] > 0 else -1.0
    for k in range(len(out)):
        i = _cell(x, window[0], window[1], table.shape[0])
        j = _cell(v, window[2], window[3], table.shape[1])
        region = table[i, j]
        known, (x, v, a, b, c, d) = image(kind, y, x, v)
        if not known:
            return False
        p, q = a * p + b * q, c * p + d * q
        size = math.hypot(p, q)
        p, q = p / size, q / size
        after = 1.0 if p * direction[0] + q * direction[1] > 0 else -1.0
        out[k] = 2 * region + (1 if before * after > 0 else 0)
        before = after
    return True


@register_jitable
def _parted(kind: Any, y: Any, a: Any, b: Any, c: Any, d: Any, steps: Any, near: Any) -> Any:
    """Return 0 if two orbits stay together, -1 if both end at one step, 1 if they part."""
    for _ in range(steps):
        one, (a, b, _, _, _, _) = image(kind, y, a, b)
        other, (c, d, _, _, _, _) = image(kind, y, c, d)
        if not one and not other:
            return -1
        if one != other or abs(a - c) + abs(b - d) > near:
            return 1
    return 0


def _follow(
    kind: Any,
    y: Any,
    near: Any,
    table: Any,
    window: Any,
    direction: Any,
    piece: Any,
    steps: Any,
    ends: Any,
    words: Any,
    stack: Any,
) -> Any:
    """Find the parts of a piece that survive; write their ends and words, return their number."""
    x, v, p, q, low, high = piece
    top, found = 0, 0
    for n in range(3, -1, -1):
        stack[top, 0], stack[top, 1] = low + (high - low) * n / 4, low + (high - low) * (n + 1) / 4
        top += 1
    while top > 0:
        top -= 1
        s, t = stack[top, 0], stack[top, 1]
        r = 0.5 * (s + t)
        parted = _parted(kind, y, x + s * p, v + s * q, x + t * p, v + t * q, steps, near)
        if parted == 0 and found < len(words):
            if _word(kind, y, table, window, direction, x + r * p, v + r * q, p, q, words[found]):
                ends[found, 0], ends[found, 1] = s, t
                found += 1
        elif parted == 1 and t - s > TINY * (high - low) and top < len(stack) - 2:
            stack[top, 0], stack[top, 1] = r, t
            stack[top + 1, 0], stack[top + 1, 1] = s, r
            top += 2
    return found


_FOLLOW = kept(_follow)


class Leaves:
    """Pieces with words of m and n symbols, and which follow which; ``torn`` of them are doubtful.

    ``torn``: how often one word was seen on both sides of another one.
    """

    def __init__(self, g: Planar, saddle: Saddle, regions: Regions, m: int, n: int) -> None:
        self.g, self.saddle, self.regions = g, saddle, regions
        self.m, self.n, self.torn = m, n, 0
        self.pieces, self.edges = dict[Key, Piece](), dict[Key, list[Key]]()
        self._ends, self._words = np.zeros((ROOM, 2)), np.zeros((ROOM, n + 1), dtype=np.int64)
        self._stack = np.zeros((400, 2))
        reach = 2 * g.size * abs(saddle.large) ** -n
        symbol = self._symbol(saddle)
        start = (symbol,) * m, (symbol,) * n
        self._waiting = [start]
        self.pieces[start] = self._own(Piece(saddle.point, saddle.unstable, -reach, reach), start)
        while self._waiting and len(self.pieces) < MOST:
            self._pass_on(self._waiting.pop(0))

    def _own(self, piece: Piece, key: Key) -> Piece:
        """Return the part of a piece that has the word of the key."""
        ends = [end for part in self._groups(piece, key[1]).values() for end in part]
        return piece._replace(low=min(ends), high=max(ends)) if ends else piece

    def _symbol(self, saddle: Saddle) -> int:
        """Return the symbol of the saddle."""
        table, (x0, x1, y0, y1), _ = self.regions
        (x, y), (k, l) = saddle.point, table.shape
        i, j = int((x - x0) / (x1 - x0) * k), int((y - y0) / (y1 - y0) * l)
        return 2 * int(table[min(max(i, 0), k - 1), min(max(j, 0), l - 1)]) + (saddle.large > 0)

    def _pass_on(self, key: Key) -> None:
        """Follow a piece; add those that follow it."""
        before, after = key
        piece = self.pieces[key]
        groups = self._groups(piece, after)
        then = (*before, after[0])[1:]
        self.edges[key] = []
        for word, (low, high) in groups.items():
            following = self._image(piece, low, high)
            if following is None:
                continue
            self.edges[key].append((then, word))
            if (then, word) not in self.pieces:
                self.pieces[then, word] = following
                self._waiting.append((then, word))

    def _groups(self, piece: Piece, after: Word) -> dict[Word, tuple[float, float]]:
        """Return the words of the images of a piece, and on which part of it."""
        wider = 0.05 * (piece.high - piece.low)
        row = np.array([*piece.z, *piece.T, piece.low - wider, piece.high + wider])
        count = _FOLLOW(
            self.g.kind, self.g.constants, NEAR * self.g.size, *self.regions, row,
            self.n + MORE, self._ends, self._words, self._stack,
        )  # fmt: skip
        groups, last = dict[Word, tuple[float, float]](), None
        for (low, high), symbols in zip(self._ends[:count], self._words[:count], strict=True):
            word = tuple(symbols.tolist())
            if word[:-1] != after:
                continue
            word = word[1:]
            self.torn += word in groups and word != last
            groups[word] = groups.get(word, (float(low), 0.0))[0], float(high)
            last = word
        return groups

    def _image(self, piece: Piece, low: float, high: float) -> Piece | None:
        """Return the image of a part of a piece."""
        s = (low + high) / 2
        x, v, *D = images(self.g, (piece.z + s * piece.T)[None])[0]
        if not np.isfinite(x):
            return None
        T = np.array(D).reshape(2, 2) @ piece.T
        size = float(np.hypot(*T))
        return Piece(np.array([x, v]), T / size, (low - s) * size, (high - s) * size)
