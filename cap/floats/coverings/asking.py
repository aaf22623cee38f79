# ruff: noqa: PLR0913, PLR0917 (compiled functions take arrays, not records)
"""What one covering asks for: how far its source must reach, and how thick its target must be.

A few coverings carry much of the entropy.  So what is asked for is bounded between the points that
are looked at, too, and near where the map is not defined a covering is given up, before it breaks
others of its source.
"""

from typing import Any

import numpy as np
from numba.extending import register_jitable

from cap.floats.coverings.planar import image

MARGIN = 0.01
INNER, ACROSS, FINE = 5, 5, 9  # points that are looked at, in one direction
ROOM = 0.035  # of a parallelogram, beyond it, where the map has to be defined
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
    """Return what one covering asks for: the ends of U of the source, of W of the target.

    Between two of the points that are looked at a function is as far beyond them as a parabola is.
    """
    ends, inner = np.empty((ACROSS, 2)), np.empty((ACROSS, INNER))
    size = U[j, 1] - U[j, 0]
    close = 1e-9 * size + 1e-15
    for r in range(ACROSS):
        w = W[i, 0] + (W[i, 1] - W[i, 0]) * r / (ACROSS - 1)
        for s in range(INNER + 2):
            goal = U[j, 0] + size * (s - 1) / (INNER - 1)
            if s == 0:
                goal = U[j, 0] - MARGIN * size
            elif s == INNER + 1:
                goal = U[j, 1] + MARGIN * size
            known, u, Q = _solved(kind, y, frames[i], frames[j], goal, w, 0.0, close)
            if not known or abs(u) > most:
                return False, 0.0, 0.0, 0.0, 0.0
            if 0 < s <= INNER:
                inner[r, s - 1] = Q
            else:
                ends[r, min(s, 1)] = u
    far = _bend(ends) / 8
    thick = (_bend(inner) + _bend(inner.T)) / 8
    low, high = ends.min() - far, ends.max() + far
    known = _known(kind, y, frames[i], min(low, U[i, 0]), max(high, U[i, 1]), W[i])
    return known, low, high, inner.min() - thick, inner.max() + thick


@register_jitable
def _known(kind: Any, y: Any, frame: Any, low: Any, high: Any, W: Any) -> Any:
    """Return whether the map is defined on the edges of a parallelogram, and a little beyond."""
    beyond, wider = ROOM * (high - low), ROOM * (W[1] - W[0])
    for r in range(FINE):
        w = W[0] - wider + (W[1] - W[0] + 2 * wider) * r / (FINE - 1)
        for u in (low - beyond, high + beyond):
            known, _, _, _ = _seen(kind, y, frame, frame, u, w)
            if not known:
                return False
    return True


@register_jitable
def _bend(values: Any) -> Any:
    """Return the largest second difference along the first axis."""
    most = 0.0
    for k in range(1, values.shape[0] - 1):
        for s in range(values.shape[1]):
            most = max(most, abs(values[k - 1, s] - 2 * values[k, s] + values[k + 1, s]))
    return most


@register_jitable
def score(kind: Any, y: Any, frames: Any, U: Any, W: Any, i: Any, j: Any) -> Any:
    """Return by how much a covering fails, in half-widths; it is negative if it seems to hold."""
    worst = -1.0
    middle, half = (U[j, 0] + U[j, 1]) / 2, (U[j, 1] - U[j, 0]) / 2
    centre, thick = (W[j, 0] + W[j, 1]) / 2, (W[j, 1] - W[j, 0]) / 2
    for r in range(FINE):
        w = W[i, 0] + (W[i, 1] - W[i, 0]) * r / (FINE - 1)
        one, P, _, _ = _seen(kind, y, frames[i], frames[j], U[i, 0], w)
        other, R, _, _ = _seen(kind, y, frames[i], frames[j], U[i, 1], w)
        P, R = (P - middle) / half, (R - middle) / half
        if not (one and other) or P * R > 0:
            return FAIL
        worst = max(worst, 1 - min(abs(P), abs(R)))
        for s in range(FINE):
            goal = U[j, 0] + 2 * half * s / (FINE - 1)
            known, _, Q = _solved(kind, y, frames[i], frames[j], goal, w, 0.0, 1e-9 * half + 1e-15)
            if not known:
                return FAIL
            worst = max(worst, abs(Q - centre) / thick - 1)
    return worst
