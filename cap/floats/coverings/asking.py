# ruff: noqa: PLR0913, PLR0917 (compiled functions take arrays, not records)
"""What one covering asks for: how far its source must reach, and how thick its target must be."""

from typing import Any

import numpy as np
from numba.extending import register_jitable

from cap.floats.coverings.planar import image

MARGIN = 0.04
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
def asked(kind: Any, y: Any, frames: Any, U: Any, W: Any, i: Any, j: Any, most: Any) -> Any:
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


@register_jitable
def score(kind: Any, y: Any, frames: Any, U: Any, W: Any, i: Any, j: Any) -> Any:
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
