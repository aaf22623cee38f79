"""Planar maps in floats, with derivatives, for compiled code.

To add one that no formulas give: a number, a function like `half_period`, a line in `image`; and
for the checker a class in `cap.checker.coverings`.  Nothing else in this folder knows which map it
is.
"""

import math
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from cap.floats.coverings import contact
from cap.floats.coverings.contact import contact_map
from cap.floats.coverings.polynomials import evaluated, terms
from cap.floats.engine.compiled import announced
from cap.flow import flight
from cap.flow.kernels import place, velocity
from cap.system.planar import Map
from cap.system.polynomial import COS, SIN
from cap.system.section import Section

Floats = NDArray[np.float64]
Six = tuple[float, float, float, float, float, float]

HALF_PERIOD, FORMULAS, CONTACT = range(3)
STEPS, CLOSE, PHASES = 60, 1e-12, 16
FAR = 10.0  # from 0, in each coordinate of a plane: there orbits are given up, at first
GRID, STAY, BESIDE = 300, 4, 1.25  # of points; steps before and after; times what stays


class Planar(NamedTuple):
    """A map: its ``kind`` and ``constants``; ``window`` (x0, x1, y0, y1) has its saddles.

    ``size``: what is a large distance.
    """

    kind: int
    constants: Floats
    window: tuple[float, float, float, float]
    size: float


def half_period(phi: float, a: float) -> Planar:
    """Return sigma of motions that never stop, in units F = ω = 1, for φ = f/F and walls ±a."""
    return Planar(HALF_PERIOD, np.array([phi, a]), (-a, a, 0.0, 2.5 + 2 * a), a)


def formulas(given: Map) -> Planar:
    """Return a map given by formulas; its ``size`` is that of the torus, or 1.

    On a plane orbits are given up a little beyond those that stay for some steps.
    """
    far = math.pi if given.torus else FAR
    rows = [entry for row in given.derivative for entry in row]
    numbers = [float(given.torus), far]
    for q in (*(given.image[z] for z in given.state), *rows):
        numbers += terms(q, (*given.state, COS, SIN))
    size = math.pi if given.torus else 1.0
    g = Planar(FORMULAS, np.array(numbers), (-far, far, -far, far), size)
    return g if given.torus else _narrowed(g)


def _narrowed(g: Planar) -> Planar:
    """Return a map of a plane that gives up orbits where none stays."""
    far = g.constants[1]
    axis = np.linspace(-far, far, GRID)
    start = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    orbit = [start]
    for _ in range(2 * STAY):
        orbit.append(images(g, orbit[-1])[:, :2])
    stays = orbit[STAY][np.isfinite(orbit[-1]).all(axis=1)]
    least = min(far, BESIDE * float(np.abs(stays).max(initial=0)))
    if not 0 < least < far / BESIDE:
        return g
    narrow = np.concatenate([g.constants[:1], [least], g.constants[2:]])
    return _narrowed(g._replace(constants=narrow, window=(-least, least, -least, least)))


def contacts(section: Section, middle: float) -> Planar:
    """Return the map from contact to contact; phases are within half a period of a middle."""
    y = contact.constants(section, middle)
    cut, period = float(y[contact.CUT]), float(y[contact.PERIOD])
    trial = Planar(CONTACT, y, (0, 0, 0, 0), period / 2)
    phases = cut + period * (np.arange(PHASES) + 0.5) / PHASES
    sizes = np.concatenate([sign * 2.0 ** np.arange(-10, 11) for sign in (-1, 1)])
    points = np.stack(np.meshgrid(phases, sizes), axis=-1).reshape(-1, 2)
    known = points[np.isfinite(images(trial, points)[:, 0]), 1]
    low, high = (known.min(), known.max()) if len(known) else (0.0, 0.0)
    return trial._replace(window=(cut, cut + period, min(2 * low, 0.0), max(2 * high, 0.0)))


@register_jitable
def image(kind: int, y: Floats, x: float, v: float) -> tuple[bool, Six]:
    """Return whether the map is defined, its value, and its derivative row by row."""
    if kind == HALF_PERIOD:
        return _half_period(y[0], y[1], x, v)
    if kind == FORMULAS:
        return _formulas(y, x, v)
    if kind == CONTACT:
        return contact_map(y, x, v)
    return _nowhere()


@register_jitable
def _nowhere() -> tuple[bool, Six]:
    return False, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@register_jitable
def _formulas(y: Floats, x: float, v: float) -> tuple[bool, Six]:
    """Evaluate six sums of products, one after the other in ``y``."""
    if not (abs(x) < y[1] and abs(v) < y[1]):
        return _nowhere()
    c, s = math.cos(x), math.sin(x)
    X, n = evaluated(y, 2, x, v, c, s)
    V, n = evaluated(y, n, x, v, c, s)
    d0, n = evaluated(y, n, x, v, c, s)
    d1, n = evaluated(y, n, x, v, c, s)
    d2, n = evaluated(y, n, x, v, c, s)
    d3, n = evaluated(y, n, x, v, c, s)
    if y[0] > 0:
        X -= 2 * math.pi * math.floor(X / (2 * math.pi) + 0.5)
        V -= 2 * math.pi * math.floor(V / (2 * math.pi) + 0.5)
    return True, (X, V, d0, d1, d2, d3)


@register_jitable
def _half_period(phi: float, a: float, x: float, v: float) -> tuple[bool, Six]:
    """Follow a motion: one hit, no stop.  Formulas: `cap.checker.coverings.half_period`."""
    if not (v > 0 and abs(x) < a):
        return _nowhere()
    end = _until(phi, v)
    if place(x + 1, v, end, phi / 2, math.cos(end)) <= a:
        return _nowhere()
    t = _hit(phi, a, x, v, end)
    w = velocity(v, t, phi, math.sin(t))
    slow = math.pi - math.acos(phi)
    least = velocity(v, slow, phi, 2 * math.sin(t) - math.sqrt(1 - phi * phi))
    d = math.pi - t
    X = place(-a - math.cos(t), w + math.sin(t), d, phi / 2, 1)
    if not (w > 0 and least > 0 and a > X):
        return _nowhere()
    k = -2 * math.cos(t) / w
    D = 1 + d * k
    V = velocity(v, math.pi, phi, 2 * math.sin(t))
    return True, (X, V, D, D * t + d, k, k * t + 1)


@register_jitable
def _until(phi: float, v: float) -> float:
    """Return the time, at most π, until which the velocity is positive."""
    low, high = math.acos(phi), math.pi
    if v - phi * high > 0:
        return high
    for _ in range(50):
        middle = (low + high) / 2
        if velocity(v, middle, phi, math.sin(middle)) > 0:
            low = middle
        else:
            high = middle
    return low


@register_jitable
def _hit(phi: float, a: float, x: float, v: float, end: float) -> float:
    """Return the time of the hit, by Newton's method kept in a bracket."""
    low, high = 0.0, end
    t = min(end, (a - x) / (v + 0.5))
    for _ in range(STEPS):
        s, c = math.sin(t), math.cos(t)
        gap = place(x + 1, v, t, phi / 2, c) - a
        if gap > 0:
            high = t
        else:
            low = t
        then: float = t - gap / velocity(v, t, phi, s)
        if not low <= then <= high:
            then = (low + high) / 2
        if abs(then - t) < CLOSE:
            return then
        t = then
    return t


def kept(function: Any) -> Any:
    """Compile a function, and keep it until a file of this folder, or the flight, changes."""
    return announced(function, _DIGEST)


_FILES = [*sorted(Path(__file__).parent.glob("*.py")), Path(flight.__file__)]
_DIGEST = sha256(b"".join(file.read_bytes() for file in _FILES)).hexdigest()


def _step(kind: Any, y: Any, points: Any, out: Any) -> Any:
    for k in range(len(points)):
        known, six = image(kind, y, points[k, 0], points[k, 1])
        for n in range(6):
            out[k, n] = six[n] if known else np.nan


_STEP = kept(_step)


def images(g: Planar, points: Floats) -> Floats:
    """Return (N, 6) values and derivatives of N points, nan where the map is not defined."""
    out = np.full((len(points), 6), np.nan)
    _STEP(g.kind, g.constants, np.ascontiguousarray(points, dtype=np.float64), out)
    return out
