"""Invariant curves around a cylinder, in doubles: where a proof of one starts.

The map is (x, y) -> (x + b y' + c, y'), y' = y + q(x), x modulo 2π, q a polynomial in cos x and sin
x with mean 0.  A curve is (θ + x(θ), y(θ)); for q = 0 that with the rotation number α is y = (2πα -
c)/b, and it is followed as q grows to its full size, by Newton's method in the frame (K', JK'/K'²).
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from cap.errors import NotProved

LEAST, MOST = 64, 1 << 15  # modes
NEWTON = 20
SMALL = 1e-10  # an error that is small enough on the way
TAIL = 1e-12  # of the coefficients in the last quarter, where there are enough modes
CLEAR = 1e-5, 1e-10  # coefficients between these show how they fall
STEEP = 0.8  # no coefficients are taken to fall faster
SHORTEST = 1e-5  # a step of the size of q
Array = np.ndarray[Any, Any]
Term = tuple[float, int, int]


class Kicked(NamedTuple):
    """The map: b, c, and the terms of q: coefficient, powers of cos and sin."""

    b: float
    c: float
    terms: Sequence[Term]

    def kick(self, x: Array) -> tuple[Array, Array]:
        """Return q and q'."""
        cos, sin = np.cos(x), np.sin(x)
        value, slope = np.zeros_like(x), np.zeros_like(x)
        for k, m, n in self.terms:
            value += k * cos**m * sin**n
            if m:
                slope -= k * m * cos ** (m - 1) * sin ** (n + 1)
            if n:
                slope += k * n * cos ** (m + 1) * sin ** (n - 1)
        return value, slope

    def scaled(self, part: float) -> "Kicked":
        """Return the map with this part of q."""
        return self._replace(terms=[(part * k, m, n) for k, m, n in self.terms])


class Curve(NamedTuple):
    """Coefficients of 0, 1, ..., n of x and y; grids have four points for each mode."""

    x: Array
    y: Array

    @property
    def modes(self) -> int:
        """The number n."""
        return len(self.x) - 1

    def values(self, f: Callable[[Array], Array] = lambda row: row) -> tuple[Array, Array]:
        """Return the values of x and y, or of what a function makes of the coefficients."""
        size = 4 * self.modes
        x, y = (np.fft.irfft(_long(f(row), size) * size, size) for row in (self.x, self.y))
        return x, y

    def with_modes(self, n: int) -> "Curve":
        """Return it with more modes."""
        x, y = (np.pad(row, (0, n - self.modes)) for row in (self.x, self.y))
        return Curve(x, y)

    @property
    def tail(self) -> float:
        """The largest coefficient in the last quarter."""
        return float(np.abs(np.array(self))[:, -self.modes // 4 :].max())


def found(at: Kicked, rotation: float) -> tuple[Curve, float]:
    """Return the curve, and the rate at which its coefficients fall."""
    omega = 2 * math.pi * rotation
    zero = np.zeros(LEAST + 1, complex)
    level = zero.copy()
    level[0] = (omega - at.c) / at.b
    curve, part, step = Curve(zero, level), 0.0, 0.25
    while part < 1:
        following = min(1.0, part + step)
        better = _fitting(at.scaled(following), curve, omega)
        if better is not None:
            curve, part, step = better, following, 1.5 * step
            continue
        step /= 2
        if step < SHORTEST:
            raise NotProved(
                "search",
                "no curve with this rotation number is found",
                {"part of q reached": part, "modes": curve.modes},
            )
    return curve, rate(np.array(curve))


def rate(rows: Array) -> float:
    """Return the rate at which coefficients fall exponentially, before they are noise."""
    sizes = np.abs(rows).max(axis=0)
    envelope = np.maximum.accumulate(sizes[::-1])[::-1]
    first, last = (int(np.argmax(envelope < level)) for level in CLEAR)
    return min(STEEP, math.log(envelope[first] / envelope[last]) / max(1, last - first))


def _fitting(at: Kicked, curve: Curve, omega: float) -> Curve | None:
    """Return the curve after Newton's method, with as many modes as it needs, or None."""
    while curve.modes <= MOST:
        better = _converged(at, curve, omega)
        if better is not None and better.tail < TAIL:
            return better
        if better is None and curve.tail < TAIL:
            return None
        curve = (better or curve).with_modes(2 * curve.modes)
    return None


def _converged(at: Kicked, curve: Curve, omega: float) -> Curve | None:
    """Return the curve after Newton's method if its error is small."""
    last = math.inf
    for _ in range(NEWTON):
        curve, error = improved(at, curve, omega)
        if not math.isfinite(error) or error > 1e3 * last:
            return None
        if error < SMALL and error > last / 2:
            return curve
        last = min(last, error)
    return curve if last < SMALL else None


def improved(at: Kicked, curve: Curve, omega: float) -> tuple[Curve, float]:
    """Return the curve after a step of Newton's method, and the largest error before it."""
    n = curve.modes
    size = 4 * n
    k = np.arange(n + 1)
    ahead = np.exp(1j * k * omega)
    theta = 2 * math.pi * np.arange(size) / size

    def forward(u: Array) -> Array:
        return np.fft.irfft(_long(_modes(u, n) * ahead, size) * size, size)

    def solved(u: Array) -> Array:
        divisors = ahead - 1
        divisors[0] = 1
        row = _modes(u, n) / divisors
        row[0] = 0
        return np.fft.irfft(_long(row, size) * size, size)

    x, y = curve.values()
    L = np.array(curve.values(lambda row: 1j * k * row))
    L[0] += 1
    N = np.array([-L[1], L[0]]) / (L**2).sum(axis=0)
    q, slope = at.kick(theta + x)
    after = y + q
    E = x + at.b * after + at.c - forward(x) - omega, after - forward(y)
    M, P = (np.array([forward(u) for u in w]) for w in (N, L))
    pushed = N[1] + slope * N[0]
    T = (N[0] + at.b * pushed) * M[1] - pushed * M[0]
    first, second = E[0] * M[1] - E[1] * M[0], P[0] * E[1] - P[1] * E[0]
    swing = solved(second)
    swing -= (first + T * swing).mean() / T.mean()
    along = solved(first + T * swing)
    change = L * along + N * swing
    better = Curve(*(row + _modes(u, n) for row, u in zip(curve, change, strict=True)))
    error = float(np.abs(E).max())
    return better, error


def normal(rows: Sequence[Sequence[complex]]) -> Array:
    """Return coefficients of J K'/K'² from those of K'."""
    n = len(rows[0]) - 1
    L = np.array([np.fft.irfft(_long(np.array(row), 4 * n) * 4 * n, 4 * n) for row in rows])
    N = np.array([-L[1], L[0]]) / (L**2).sum(axis=0)
    return np.array([_modes(u, n) for u in N])


def _modes(u: Array, n: int) -> Array:
    result: Array = np.fft.rfft(u)[: n + 1] / len(u)
    return result


def _long(row: Array, size: int) -> Array:
    padded = np.zeros(size // 2 + 1, complex)
    padded[: len(row)] = row
    return padded
