"""Saddles of a planar map, by Newton's method from a grid."""

from typing import NamedTuple

import numpy as np

from cap.floats.coverings.planar import Floats, Planar, images

GRID, STEPS = 40, 40


class Saddle(NamedTuple):
    """A fixed point with its multipliers, the larger first, and unit eigenvectors."""

    point: Floats
    large: float
    small: float
    unstable: Floats
    stable: Floats


def saddles(g: Planar) -> list[Saddle]:
    """Return the saddles in the window that are found, the weakest first."""
    found = list[Saddle]()
    for z in _fixed_points(g):
        D = images(g, z[None])[0, 2:].reshape(2, 2)
        values, vectors = np.linalg.eig(D)
        if np.iscomplexobj(values) or not min(abs(values)) < 1 < max(abs(values)):
            continue
        k = int(np.argmax(abs(values)))
        large, small = float(values[k]), float(values[1 - k])
        if all(np.hypot(*(z - other.point)) > 1e-6 * g.size for other in found):
            found.append(Saddle(z, large, small, vectors[:, k], vectors[:, 1 - k]))
    return sorted(found, key=lambda saddle: abs(saddle.large))


def _fixed_points(g: Planar) -> list[Floats]:
    x0, x1, y0, y1 = g.window
    axes = np.linspace(x0, x1, GRID + 2)[1:-1], np.linspace(y0, y1, GRID + 2)[1:-1]
    z = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    for _ in range(STEPS):
        now = images(g, z)
        known = np.isfinite(now[:, 0])
        z, now = z[known], now[known]
        (a, b), (c, d) = (now[:, 2] - 1, now[:, 3]), (now[:, 4], now[:, 5] - 1)
        r, s = now[:, 0] - z[:, 0], now[:, 1] - z[:, 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.stack([d * r - b * s, a * s - c * r], axis=1) / (a * d - b * c)[:, None]
        z = z - step
        z = z[np.isfinite(z).all(axis=1)]
    rest = images(g, z)[:, :2] - z
    return list(z[np.abs(rest).max(axis=1, initial=0) < 1e-9 * g.size]) if len(z) else []
