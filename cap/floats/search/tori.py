"""Invariant curves of half periods with one hit, in doubles: where a proof of one starts.

The map and its units are those of `cap.tori.half_period`.  The curve is found from orbits: the
radius at which they turn by the right amount on average, then the Fourier coefficients of one, both
as averages with the weight exp(-1/(s(1 - s))), which converge faster than any power (Das, Saiki,
Sander and Yorke, Nonlinearity 30, 2017).
"""

import math
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from cap.errors import NotProved
from cap.flow.flight import place, velocity
from cap.parameters import Parameters

LONG = 8_000
SHORT = 2_000
ROUNDING = 1e-15
STEEP = 0.8  # no coefficients are taken to fall faster
NOISE, QUIET = 1e-11, 8  # so many modes in a row below it are the end
AVERAGES = (8_000, 160), (60_000, 800)  # over so many periods, for so many modes
FIRST = 1e-2  # the radius that is tried first
BRACKETS = 24  # radii at which orbits are tried
GRID = 24  # states along a side
SAME = 1e-6  # what states differ by that are one
State = tuple[float, float]
Array = np.ndarray[Any, Any]


class HalfPeriod(NamedTuple):
    """σ in doubles."""

    alpha: float
    a: float

    def hit(self, x: float, v: float) -> float:
        """Return the time of the hit, or NaN.

        Newton's method from the time of the greatest speed, where x(t) turns from convex to
        concave: so it comes to the hit from one side, and to no other root.
        """
        t = math.acos(self.alpha)
        for _ in range(60):
            sin, cos = math.sin(t), math.cos(t)
            beyond = place(x + 1, v, t, self.alpha / 2, cos) - self.a
            step = beyond / velocity(v, t, self.alpha, sin)
            t -= step
            if abs(step) < 1e-15 * (1 + abs(t)) or not abs(t) < 10:
                break
        return t if 0 < t < math.pi and abs(step) < 1e-12 else math.nan

    def __call__(self, x: float, v: float) -> State:
        """Return σ(x, v)."""
        t = self.hit(x, v)
        sin, d = math.sin(t), math.pi - t
        V = velocity(v, t, self.alpha, 2 * sin)
        X = place(-self.a - math.cos(t), V, d, self.alpha / 2, 1)
        return X, velocity(v, math.pi, self.alpha, 2 * sin)

    def derivative(self, x: float, v: float) -> Array:
        """Return Dσ."""
        t = self.hit(x, v)
        kick, d = -2 * math.cos(t) / velocity(v, t, self.alpha, math.sin(t)), math.pi - t
        drift = [np.array([[1, s], [0, 1]]) for s in (t, d)]
        result: Array = drift[1] @ np.array([[1, 0], [kick, 1]]) @ drift[0]
        return result


class Centre(NamedTuple):
    """An elliptic fixed point of σⁿ: with ``frame`` M, DΦ turns by ``angle`` in (0, π) in M⁻¹z."""

    halves: int
    map: HalfPeriod
    point: State
    frame: Array
    angle: float

    def turns(self, radius: float, count: int = SHORT) -> float:
        """Return the mean turn per period, in turns, of an orbit at this radius; NaN if it ends."""
        orbit = self.orbit(radius, count)
        angles = np.angle(orbit @ np.array([1, 1j]))
        steps = np.diff(angles)
        steps = self.angle + (steps - self.angle + math.pi) % (2 * math.pi) - math.pi
        return float(weights(count) @ steps) / (2 * math.pi)

    def orbit(self, radius: float, count: int) -> Array:
        """Return M⁻¹(z - P*) along an orbit from P* + M (radius, 0)."""
        z = np.array(self.point) + self.frame @ [radius, 0]
        states = [tuple(z)]
        for _ in range(count):
            at = states[-1]
            for _ in range(self.halves):
                at = self.map(*at)
            states.append(at)
            if not (abs(at[0]) < self.map.a and 0 < at[1] < 10):
                return np.full((count + 1, 2), math.nan)
        away = np.array(states) - self.point
        result: Array = away @ np.linalg.inv(self.frame).T
        return result


def weights(count: int) -> Array:
    """Return the weights of the average of so many numbers."""
    s = (np.arange(count) + 1) / (count + 1)
    w = np.exp(-1 / (s * (1 - s)))
    result: Array = w / w.sum()
    return result


def centre(halves: int, sigma: HalfPeriod, near: State) -> Centre:
    """Return the fixed point of σⁿ near a state; raise `NotProved` unless it is elliptic."""
    z = np.array(near)
    for _ in range(30):
        image, D = z, np.eye(2)
        for _ in range(halves):
            D = sigma.derivative(*image) @ D
            image = np.array(sigma(*image))
        if not np.isfinite(D).all():
            break
        z = z - np.linalg.solve(D - np.eye(2), image - z)
    cos = np.trace(D) / 2
    if not abs(cos) < 1:
        raise NotProved(
            "centre",
            "no elliptic orbit with one hit in each half period from a state with v > 0",
            {"trace": 2 * cos},
        )
    angle = math.acos(cos)
    values, vectors = np.linalg.eig(D)
    w = vectors[:, np.argmin(abs(values - np.exp(1j * angle)))]
    M = np.column_stack([w.real, -w.imag])
    return Centre(halves, sigma, (z[0], z[1]), M / math.sqrt(abs(np.linalg.det(M))), angle)


def of_orbit(p: Parameters, x: float, v: float) -> Centre:
    """Return the fixed point near a state: of σ if it is its own image, else of σσ."""
    sigma = HalfPeriod(float(p.f / p.F), float(p.R * p.omega**2 / p.F / 2))
    length, speed = (float(p.F / p.omega**k) for k in (2, 1))
    z = (x - float(p.l + p.r) / 2) / length, v / speed
    image = sigma(*z)
    halves = 1 if max(abs(image[0] - z[0]), abs(image[1] - z[1])) < SAME else 2
    return centre(halves, sigma, z)


def radius(at: Centre, rotation: float, ring: tuple[float, float]) -> float:
    """Return a radius in a ring at which orbits have this rotation number.

    It need not be monotone: a bracket is looked for from the outside; then bisection, then secants.
    """
    start, (least, most) = at.angle / (2 * math.pi), ring
    radii = [least + (most - least) * k / BRACKETS for k in range(BRACKETS + 1)]
    turns = [at.turns(r, SHORT) if r else start for r in radii]
    ends = zip(pairwise(radii), pairwise(turns), strict=True)
    brackets = [(r, a - rotation) for r, (a, b) in ends if (a - rotation) * (b - rotation) <= 0]
    if not brackets:
        raise NotProved(
            "search",
            "no orbits with this rotation number are found",
            {"at the centre": start, "wanted": rotation, "last radius": most},
        )
    (inner, outer), sign = brackets[-1]
    while outer - inner > 1e-3 * outer:
        middle = (inner + outer) / 2
        within = (at.turns(middle, SHORT) - rotation) * sign > 0
        inner, outer = (middle, outer) if within else (inner, middle)
    (r, a), (s, b) = ((r, at.turns(r, LONG) - rotation) for r in (inner, outer))
    for _ in range(8):
        if abs(b) < 1e-15 or not math.isfinite(b) or a == b:
            break
        (r, a), s = (s, b), s - b * (s - r) / (b - a)
        b = at.turns(s, LONG) - rotation
    if not abs(b) < 1e-9:
        raise NotProved(
            "search",
            "no orbits with this rotation number were found",
            {"at the centre": start, "wanted": rotation, "last radius": inner},
        )
    return s


def last_radius(at: Centre) -> float:
    """Return the largest radius found from which orbits go on, to a thousandth."""

    def goes_on(r: float) -> bool:
        return math.isfinite(at.turns(r, LONG))

    inner, outer = 0.0, FIRST
    while goes_on(outer):
        inner, outer = outer, 1.3 * outer
    while outer - inner > 1e-3 * outer:
        middle = (inner + outer) / 2
        inner, outer = (middle, outer) if goes_on(middle) else (inner, middle)
    return inner


def decay(rows: Array) -> float:
    """Return a rate at which coefficients fall exponentially."""
    sizes = np.abs(rows).max(axis=0)
    envelope = np.maximum.accumulate(sizes[::-1])[::-1]
    later = range(max(2, len(sizes) // 2), len(sizes))
    return min([STEEP, *(math.log(sizes[1] / envelope[k]) / (k - 1) for k in later)])


def coefficients(at: Centre, rotation: float, ring: tuple[float, float]) -> Array:
    """Return Fourier coefficients of both components of the curve, as rows, down to the noise.

    An orbit that is too short shows modes that are none: they come back after the noise.
    """
    start = radius(at, rotation, ring)
    for count, modes in AVERAGES:
        orbit = at.orbit(start, count) @ at.frame.T + at.point
        turned = np.exp(-2j * math.pi * ((rotation * np.arange(count + 1)) % 1))
        rows, factor = [], weights(count + 1).astype(complex)
        for _ in range(modes):
            rows.append(factor @ orbit)
            factor = factor * turned
        sizes = np.abs(rows).max(axis=1)
        quiet = [k for k in range(modes - QUIET) if sizes[k : k + QUIET].max() < NOISE]
        if quiet:
            break
    result: Array = np.array(rows[: quiet[0] if quiet else modes]).T
    return result


def winds(at: Centre, rows: Array) -> bool:
    """Return whether, in the frame, one of the terms exp(±iθ) is larger than all others."""
    rows = rows.copy()
    rows[:, 0] -= at.point
    y = np.linalg.inv(at.frame) @ rows
    above, below = np.abs(y[0] + 1j * y[1]), np.abs(y[0] - 1j * y[1])  # of k and of -k
    total = above.sum() + below[1:].sum()
    return bool(2 * max(above[1], below[1]) > total)


def never_stops(at: Centre, rows: Array, reach: float) -> bool:
    """Return whether states on a grid of a parallelogram never stop for a period.

    It is that in which `cap.tori.around.half_width` finds all curves within ``reach``.
    """
    inverse = np.linalg.inv(at.frame)
    y = inverse @ rows
    y[:, 0] -= inverse @ at.point
    sizes = np.abs(y)
    most = float((2 * sizes.sum(axis=1) - sizes[:, 0]).max())
    half = most + float(np.abs(inverse).sum(axis=1).max()) * reach
    side = np.linspace(-half, half, GRID)
    alpha, a = at.map.alpha, at.map.a
    least = math.sqrt(1 - alpha**2) - alpha * math.acos(alpha)
    states = at.point + np.array([(p, q) for p in side for q in side]) @ at.frame.T
    for x, v in states:
        for _ in range(at.halves):
            if not (abs(x) < a and v > 0):
                return False
            x, v = at.map(x, v)  # noqa: PLW2901 (from half period to half period)
            if not (abs(x) < a and v > least):
                return False
    return True


class Torus(NamedTuple):
    """Coefficients 0..n of the curve, of a frame, and of hits with 1/speed: rows of arrays."""

    curve: Array
    frame: Array
    hits: list[Array]


def torus(at: Centre, curve: Array, degree: int) -> Torus:
    """Return what belongs to a curve, computed on a grid."""
    size = 1 << (4 * degree).bit_length()
    values = [on_grid(row, size) for row in curve]
    k = np.arange(curve.shape[1])
    tangent = np.array([on_grid(1j * k * row, size) for row in curve])
    y = np.linalg.inv(at.frame) @ tangent
    turned = np.array([-y[1], y[0]]) / ((y**2).sum(axis=0) * np.linalg.det(at.frame))
    frame = [off_grid(row, degree) for row in at.frame @ turned]
    hits = []
    x, v = values
    for _ in range(at.halves):
        t = np.array([at.map.hit(*z) for z in zip(x, v, strict=True)])
        speed = velocity(v, t, at.map.alpha, np.sin(t))
        hits.append(np.array([off_grid(t, degree), off_grid(1 / speed, degree)]))
        x, v = np.array([at.map(*z) for z in zip(x, v, strict=True)]).T
    return Torus(curve, np.array(frame), hits)


def on_grid(row: Array, size: int) -> Array:
    """Return the values of a real function at 2πj/size."""
    padded = np.zeros(size // 2 + 1, complex)
    padded[: len(row)] = row
    result: Array = np.fft.irfft(padded * size, size)
    return result


def off_grid(values: Array, degree: int) -> Array:
    """Return coefficients 0..degree of a real function, those that are above rounding errors."""
    result: Array = np.fft.rfft(values)[: degree + 1] / len(values)
    result[np.abs(result) < ROUNDING * np.abs(result).max()] = 0
    return result
