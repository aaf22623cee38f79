"""Fates of places of release: portions are halved until they have one.

A portion has a fate if all its next places have it, by what is known so far; at first some
intervals are attracted, and some pieces have one.  When few more have a fate so, portions
are halved, if enough of their next places have a fate, or G' varies much.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import Piece, Portion, portion
from cap.checker.folded.table import ATTRACTOR, SEGMENT, Known, table

_FEW = 0.05  # of the portions without a fate
_DOUBTFUL = 0.8  # part of the next places without a fate, for which it is of no use to halve
_MOST = 1 << 17  # portions that may be halved


class Settled:
    """The fates of places in [0, W], and the portions without one, in order."""

    def __init__(
        self, kept: Sequence[Pair], width: float, level: int, pieces: Sequence[Piece]
    ) -> None:
        """``kept`` are attracted; no two pieces overlap; portions are nodes up to a level."""
        self.kept, self.width, self.level = kept, width, level
        known = self._attracted()
        for fate in (ATTRACTOR, SEGMENT):
            have = [piece.node.ends(width) for piece in pieces if piece.next == fate]
            known += self._outside(have, fate)
        self.table = table(width, known)
        first = [portion(n, z, z[1], width) for n, z in pieces if not isinstance(z, int)]
        self.portions = [p for p in first if not self._inside(p)]
        while self._settle() or self._halve():
            pass

    def _inside(self, p: Portion) -> bool:
        return any(low <= p.ends[0] and p.ends[1] <= high for low, high in self.kept)

    def _attracted(self) -> list[Known]:
        return [(ends, ATTRACTOR) for ends in self.kept]

    def _outside(self, intervals: Iterable[Pair], fate: int) -> list[Known]:
        """Return the parts of these intervals outside those that are kept, all with one fate."""
        found = list(intervals)
        for low, high in self.kept:
            found = [part for a, b in found for part in ((a, min(b, low)), (max(a, high), b))]
            found = [part for part in found if part[0] < part[1]]
        return [(part, fate) for part in found]

    def _settle(self) -> bool:
        """Find more fates, and return whether it is of use to do so once more."""
        fates = [self.table.fate(p.image) for p in self.portions]
        count = len(fates)
        found = [*self.table.known()]
        for fate in (ATTRACTOR, SEGMENT):
            ends = (p.ends for p, known in zip(self.portions, fates, strict=True) if known == fate)
            found += self._outside(ends, fate)
        self.table = table(self.width, found)
        self.portions = [p for p, fate in zip(self.portions, fates, strict=True) if not fate]
        return count - len(self.portions) > _FEW * count

    def _halve(self) -> bool:
        """Halve portions, and return whether there were any."""
        if len(self.portions) > _MOST:
            return False
        found = list[Portion]()
        for p in self.portions:
            found += p.halves(self.width) if self._useful(p) else [p]
        more = len(found) > len(self.portions)
        self.portions = found
        return more

    def _useful(self, p: Portion) -> bool:
        """Return whether it may be of use to halve a portion: it steers."""
        if p.node.m >= self.level or p.blurred():
            return False
        low, high = max(0.0, p.image[0]), min(p.image[1], self.width)
        return not p.even or self.table.doubtful((low, high)) < _DOUBTFUL * (high - low)
