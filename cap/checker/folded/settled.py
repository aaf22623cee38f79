"""Fates of places of release: portions are halved until they have one.

A portion has a fate if all its next places have it, by what is known so far; at first some
intervals are attracted, and some pieces have one.  When few more have a fate so, portions
are halved, if enough of their next places have a fate, or G' varies much.
"""

from __future__ import annotations

from collections.abc import Sequence

from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import Piece, Portion, portion
from cap.checker.folded.table import ATTRACTOR, Table

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
        known = [(node.ends(width), after) for node, after in pieces if isinstance(after, int)]
        self.table = Table(width, [*((ends, ATTRACTOR) for ends in kept), *known])
        first = [portion(n, z, z[1], width) for n, z in pieces if not isinstance(z, int)]
        self.portions = [p for p in first if not self.table.fate(p.ends)]
        while self._settle() or self._halve():
            pass

    def _settle(self) -> bool:
        """Find more fates, and return whether it is of use to do so once more."""
        fates = [(p, self.table.fate(p.image)) for p in self.portions]
        found = [(p.ends, fate) for p, fate in fates if fate]
        self.table = Table(self.width, [*self.table.known(), *found])
        self.portions = [p for p, fate in fates if not fate]
        return len(found) > _FEW * len(fates)

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
