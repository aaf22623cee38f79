# ruff: noqa: PLR0913, PLR0917 (compiled functions take arrays, not records)
"""Sizes of parallelograms so that each covers those that follow it, by iteration.

A frame is (x, y, e, f): the origin and two unit vectors, unstable and stable.  A parallelogram has
the unstable coordinates U = [u0, u1] and the stable ones W = [w0, w1] in its frame.  U goes
backwards, so that the images of its ends lie a little beyond the U of the targets; W forwards, so
that it contains, with a margin, what comes into it.
"""

from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from cap.floats.coverings.planar import Floats, Planar, image, kept

Places = NDArray[np.int64]
MARGIN = 0.02
SWEEPS = 30
FARTHEST = 50.0  # times what is seen of a piece
FAIL = 1e3  # the score of a covering that cannot hold


@register_jitable
def _coordinates(frame: Any, x: Any, y: Any) -> Any:
    """Return coordinates in a frame."""
    a, b, e, f, p, q = frame
    size = e * q - f * p
    return ((x - a) * q - (y - b) * p) / size, (e * (y - b) - f * (x - a)) / size


@register_jitable
def _seen(kind: Any, y: Any, source: Any, target: Any, u: Any, w: Any) -> Any:
    """Return the image of a point in the frame of the target, and its derivative by u."""
    a, b, e, f, p, q = source
    known, (X, Y, d0, d1, d2, d3) = image(kind, y, a + u * e + w * p, b + u * f + w * q)
    P, Q = _coordinates(target, X, Y)
    slope, _ = _coordinates(target, target[0] + d0 * e + d1 * f, target[1] + d2 * e + d3 * f)
    return known, P, Q, slope


@register_jitable
def _solved(
    kind: Any, y: Any, source: Any, target: Any, goal: Any, w: Any, u: Any, close: Any
) -> Any:
    """Return u for which the image has the unstable coordinate ``goal``, and the stable one."""
    for _ in range(12):
        known, P, Q, slope = _seen(kind, y, source, target, u, w)
        if not known or slope == 0:
            return False, u, Q
        if abs(P - goal) < close:
            return True, u, Q
        u -= (P - goal) / slope
    return False, u, 0.0


@register_jitable
def _asked(kind: Any, y: Any, frames: Any, U: Any, W: Any, i: Any, j: Any, most: Any) -> Any:
    """Return what one covering asks for: the ends of U of the source, of W of the target."""
    low, high, least, largest = np.inf, -np.inf, np.inf, -np.inf
    size = U[j, 1] - U[j, 0]
    close = 1e-9 * size + 1e-15
    for r in range(3):
        w = W[i, 0] + (W[i, 1] - W[i, 0]) * r / 2
        for s in range(5):
            goal = U[j, 0] + size * (s - 1) / 2
            if s == 0:
                goal = U[j, 0] - MARGIN * size
            elif s == 4:
                goal = U[j, 1] + MARGIN * size
            known, u, Q = _solved(kind, y, frames[i], frames[j], goal, w, 0.0, close)
            if not known or abs(u) > most:
                return False, low, high, least, largest
            low, high = min(low, u), max(high, u)
            if 0 < s < 4:
                least, largest = min(least, Q), max(largest, Q)
    return True, low, high, least, largest


def _swept(
    kind: Any,
    y: Any,
    frames: Any,
    U: Any,
    W: Any,
    first: Any,
    most: Any,
    source: Any,
    target: Any,
    lost: Any,
    now: Any,
) -> Any:
    """Make one sweep.

    A covering that asks for too much is ``lost`` from ``now`` on: it asks for nothing more.
    """
    u, w = np.empty(U.shape), np.empty(U.shape)
    u[:, 0], u[:, 1], w[:, 0], w[:, 1] = np.inf, -np.inf, np.inf, -np.inf
    for k in range(len(source)):
        if lost[k] > 0:
            continue
        i, j = source[k], target[k]
        known, a, b, c, d = _asked(kind, y, frames, U, W, i, j, most[i])
        if not known:
            lost[k] = now
        if known:
            u[i, 0], u[i, 1] = min(u[i, 0], a), max(u[i, 1], b)
            w[j, 0], w[j, 1] = min(w[j, 0], c), max(w[j, 1], d)
    for i in range(len(frames)):
        U[i] = u[i] if u[i, 0] < u[i, 1] else first[i]
        if w[i, 0] <= w[i, 1]:
            margin = MARGIN * (w[i, 1] - w[i, 0]) + 1e-10
            W[i, 0], W[i, 1] = w[i, 0] - margin, w[i, 1] + margin


@register_jitable
def _score(kind: Any, y: Any, frames: Any, U: Any, W: Any, i: Any, j: Any) -> Any:
    """Return by how much a covering fails, in half-widths; it is negative if it seems to hold."""
    worst = -1.0
    middle, half = (U[j, 0] + U[j, 1]) / 2, (U[j, 1] - U[j, 0]) / 2
    centre, thick = (W[j, 0] + W[j, 1]) / 2, (W[j, 1] - W[j, 0]) / 2
    for r in range(5):
        w = W[i, 0] + (W[i, 1] - W[i, 0]) * r / 4
        one, P, _, _ = _seen(kind, y, frames[i], frames[j], U[i, 0], w)
        other, R, _, _ = _seen(kind, y, frames[i], frames[j], U[i, 1], w)
        P, R = (P - middle) / half, (R - middle) / half
        if not (one and other) or P * R > 0:
            return FAIL
        worst = max(worst, 1 - min(abs(P), abs(R)))
        for s in range(5):
            goal = U[j, 0] + half * s / 2
            known, _, Q = _solved(kind, y, frames[i], frames[j], goal, w, 0.0, 1e-9 * half + 1e-15)
            if not known:
                return FAIL
            worst = max(worst, abs(Q - centre) / thick - 1)
    return worst


def _scored(
    kind: Any, y: Any, frames: Any, U: Any, W: Any, source: Any, target: Any, out: Any
) -> Any:
    """Score all coverings."""
    for k in range(len(source)):
        out[k] = _score(kind, y, frames, U, W, source[k], target[k])


_SWEEP, _SCORES = kept(_swept), kept(_scored)


class Sizes:
    """Frames (V, 6) and ranges (V, 2); the unstable ones begin with what is seen of the pieces."""

    def __init__(self, g: Planar, frames: Floats, seen: Floats, most: float) -> None:
        self.g, self.frames, self.first, self.U = g, frames, seen, seen.copy()
        self.W = np.tile([-1e-4, 1e-4], (len(frames), 1)) * g.size
        self.times, self.most = most, most * np.abs(seen).max(axis=1)

    def limit(self, source: Places, target: Places) -> None:
        """Let parallelograms reach so many times farther than their targets, as seen, ask for."""
        lost = np.zeros(len(source), dtype=np.int64)
        U, W, far = self.first.copy(), self.W.copy(), np.abs(self.first).max(axis=1)
        common: Any = self.g.kind, self.g.constants, self.frames, U, W, self.first
        _SWEEP(*common, FARTHEST * far, source, target, lost, 1)
        self.most = self.times * np.maximum(far, np.abs(U).max(axis=1))

    def fitted(self, source: Places, target: Places) -> tuple[Places, Floats]:
        """Fit the sizes to coverings, from the beginning.

        Return for each covering in which sweep it was lost, 0 if in none, and by how much it fails.
        """
        lost = np.zeros(len(source), dtype=np.int64)
        self.U[:] = self.first
        common: Any = self.g.kind, self.g.constants, self.frames, self.U, self.W
        for now in range(1, SWEEPS + 1):
            _SWEEP(*common, self.first, self.most, source, target, lost, now)
        scores = np.zeros(len(source))
        _SCORES(*common, source, target, scores)
        return lost, scores

    def parallelograms(self, chosen: Places) -> Floats:
        """Return (N, 6) centres and axes."""
        (x, y, e, f, p, q), U, W = self.frames[chosen].T, self.U[chosen], self.W[chosen]
        u, w = U.mean(axis=1), W.mean(axis=1)
        a, b = (U[:, 1] - U[:, 0]) / 2, (W[:, 1] - W[:, 0]) / 2
        return np.stack([x + u * e + w * p, y + u * f + w * q, a * e, a * f, b * p, b * q], axis=1)
