# ruff: noqa: PLR0913, PLR0917 (compiled functions take arrays, not records)
"""Sizes of parallelograms so that each covers those that follow it.

A frame is (x, y, e, f): the origin and two unit vectors, unstable and stable.  A parallelogram has
the unstable coordinates U = [u0, u1] and the stable ones W = [w0, w1] in its frame.  U goes
backwards, so that the images of its ends lie a little beyond the U of the targets; W forwards, so
that it contains, with a margin, what comes into it.  They begin small and only grow.
"""

from typing import Any

import numpy as np

from cap.floats.coverings.asking import asked, score
from cap.floats.coverings.growing import grow
from cap.floats.coverings.planar import Floats, Planar, kept
from cap.maps.graphs import Flags, Places

FIRST = 0.1  # of what is seen of a piece: the unstable size at first
THIN, THICK = 1e-6, 1e-4  # of sizes: stable half-widths at first; when limits are set
FARTHEST = 50.0  # times what is seen of a piece


def _asked_of(
    kind: Any, y: Any, frames: Any, U: Any, W: Any, most: Any, source: Any, target: Any, out: Any
) -> Any:
    """Write for each covering how far from its frame it asks its source to reach."""
    for k in range(len(source)):
        i, j = source[k], target[k]
        known, a, b, _, _ = asked(kind, y, frames, U, W, i, j, most[i])
        out[k] = max(abs(a), abs(b)) if known else 0.0


def _scored(
    kind: Any, y: Any, frames: Any, U: Any, W: Any, source: Any, target: Any, out: Any
) -> Any:
    """Score all coverings."""
    for k in range(len(source)):
        out[k] = score(kind, y, frames, U, W, source[k], target[k])


_ASKED, _SCORES = kept(_asked_of), kept(_scored)


class Sizes:
    """Frames (V, 6) and ranges (V, 2): small parts of what is seen of the pieces, at first."""

    def __init__(self, g: Planar, frames: Floats, seen: Floats, most: float) -> None:
        self.g, self.frames, self.seen, self.times = g, frames, seen, most
        self.U, self.W = seen * FIRST, np.tile([-THIN, THIN], (len(frames), 1)) * g.size
        self.most = most * np.abs(seen).max(axis=1)

    def limit(self, source: Places, target: Places) -> None:
        """Let parallelograms reach so many times farther than their targets, as seen, ask for."""
        far, out = np.abs(self.seen).max(axis=1), np.zeros(len(source))
        W = np.tile([-THICK, THICK], (len(far), 1)) * self.g.size
        common: Any = self.g.kind, self.g.constants, self.frames, self.seen, W
        _ASKED(*common, FARTHEST * far, source, target, out)
        np.maximum.at(far, source, out)
        self.most = self.times * far

    def grown(self, source: Places, target: Places, order: Places) -> Flags:
        """Make the sizes fit to coverings, tried in an order; return which ones succeed."""
        held = np.zeros(len(source), dtype=bool)
        grow(self.g, self.frames, (self.U, self.W, self.most), (source, target), held, order)
        return held

    def scores(self, source: Places, target: Places) -> Floats:
        """Return for each covering by how much it fails; that is negative if it seems to hold."""
        scores = np.zeros(len(source))
        common: Any = self.g.kind, self.g.constants, self.frames, self.U, self.W
        _SCORES(*common, source, target, scores)
        return scores

    def parallelograms(self, chosen: Places) -> Floats:
        """Return (N, 6) centres and axes."""
        (x, y, e, f, p, q), U, W = self.frames[chosen].T, self.U[chosen], self.W[chosen]
        u, w = U.mean(axis=1), W.mean(axis=1)
        a, b = (U[:, 1] - U[:, 0]) / 2, (W[:, 1] - W[:, 0]) / 2
        return np.stack([x + u * e + w * p, y + u * f + w * q, a * e, a * f, b * p, b * q], axis=1)
