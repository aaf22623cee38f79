"""Invariant curves around a cylinder, in doubles: where a proof of one starts.

A curve is (θ + x(θ), y(θ)), x modulo 2π, and is turned by ω.  Of a map without oscillation it is
level, and it is followed as the oscillation grows to its full size, by Newton's method in the frame
(K', JK'/K'²).
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Protocol, Self

import numpy as np

from cap.errors import NotProved

LEAST, MOST = 64, 1 << 15  # modes
NEWTON = 20
SMALL = 1e-10  # an error that is small enough on the way
TAIL = 1e-12  # of the coefficients in the last quarter, where there are enough modes
CLEAR = 1e-5, 1e-10  # coefficients between these show how they fall
STEEP = 0.8  # no coefficients are taken to fall faster
SHORTEST = 1e-5  # a step of the size of the oscillation
Array = np.ndarray[Any, Any]
Term = tuple[float, int, int]


class Step(NamedTuple):
    """The image of states: x' - x, y', and the entries of the derivative."""

    move: Array
    y: Array
    derivative: tuple[Array, Array, Array, Array]


class Oscillating(Protocol):
    """A map that preserves area, with a level of each turn ω where it does not oscillate."""

    def image(self, x: Array, y: Array) -> Step:
        """Return the image of states."""

    def level(self, omega: float) -> float:
        """Return the y that is turned by ω."""

    def scaled(self, part: float) -> Self:
        """Return the map with this part of the oscillation."""


class Kicked(NamedTuple):
    """(x, y) -> (x + b y' + c, y'), y' = y + q(x), q a polynomial in cos x, sin x with mean 0.

    Its terms: coefficient, powers of cos and sin.
    """

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

    def image(self, x: Array, y: Array) -> Step:
        """Return the image of states."""
        q, slope = self.kick(x)
        one = np.ones_like(x)
        derivative = one + self.b * slope, self.b * one, slope, one
        return Step(self.b * (y + q) + self.c, y + q, derivative)

    def level(self, omega: float) -> float:
        """Return the y that is turned by ω."""
        return (omega - self.c) / self.b

    def scaled(self, part: float) -> "Kicked":
        """Return the map with this part of q."""
        return self._replace(terms=[(part * k, m, n) for k, m, n in self.terms])


class Ball(NamedTuple):
    """A ball that bounces on a table a sin t, |a| < 1, elastically: g = 1; v relative to it.

    The states after impacts are (t, v²/2).  The time to the next one, s, solves

        a sin t + (v + a cos t) s - s²/2 = a sin(t + s),    v' = s - v - a cos t + a cos(t + s).
    """

    a: float

    def flight(self, t: Array, v: Array) -> Array:
        """Return the times to the next impacts, by Newton's method from above."""
        a, up = self.a, v + self.a * np.cos(t)
        s: Array = up + np.sqrt(up**2 + 4 * abs(a))
        for _ in range(NEWTON):
            above = a * np.sin(t) + up * s - s**2 / 2 - a * np.sin(t + s)
            s = s - above / (up - s - a * np.cos(t + s))
        return s

    def image(self, x: Array, y: Array) -> Step:
        """Return the image of states."""
        a, v = self.a, np.sqrt(2 * y)
        s = self.flight(x, v)
        cos, sin, later, high = np.cos(x), np.sin(x), np.cos(x + s), np.sin(x + s)
        w = s - v - a * cos + a * later
        s_t, s_v = (a * cos - a * sin * s - a * later) / w, s / w
        w_t = s_t + a * sin - a * high * (1 + s_t)
        w_v = s_v - 1 - a * high * s_v
        return Step(s, w**2 / 2, (1 + s_t, s_v / v, w * w_t, w * w_v / v))

    def hints(self, curve: "Curve") -> list[Array]:
        """Return coefficients along a curve: of v, 1/v, the time of the flight, and 1/v'."""
        x, y = curve.values()
        theta = 2 * math.pi * np.arange(len(x)) / len(x)
        v, step = np.sqrt(2 * y), self.image(theta + x, y)
        values = v, 1 / v, step.move, 1 / np.sqrt(2 * step.y)
        return [_modes(u, curve.modes) for u in values]

    def level(self, omega: float) -> float:
        """Return the v²/2 that is turned by ω."""
        return omega**2 / 8

    def scaled(self, part: float) -> "Ball":
        """Return the map with this part of the table's way."""
        return Ball(part * self.a)


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


def found(at: Oscillating, omega: float) -> tuple[Curve, float]:
    """Return the curve, and the rate at which its coefficients fall."""
    zero = np.zeros(LEAST + 1, complex)
    level = zero.copy()
    level[0] = at.level(omega)
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
                {"part of the oscillation reached": part, "modes": curve.modes},
            )
    return curve, rate(np.array(curve))


def rate(rows: Array) -> float:
    """Return the rate at which coefficients fall exponentially, before they are noise."""
    sizes = np.abs(rows).max(axis=0)
    envelope = np.maximum.accumulate(sizes[::-1])[::-1]
    first, last = (int(np.argmax(envelope < level)) for level in CLEAR)
    return min(STEEP, math.log(envelope[first] / envelope[last]) / max(1, last - first))


def _fitting(at: Oscillating, curve: Curve, omega: float) -> Curve | None:
    """Return the curve after Newton's method, with as many modes as it needs, or None."""
    while curve.modes <= MOST:
        better = _converged(at, curve, omega)
        if better is not None and better.tail < TAIL:
            return better
        if better is None and curve.tail < TAIL:
            return None
        curve = (better or curve).with_modes(2 * curve.modes)
    return None


def _converged(at: Oscillating, curve: Curve, omega: float) -> Curve | None:
    """Return the curve after Newton's method if its error is small."""
    last = math.inf
    for _ in range(NEWTON):
        with np.errstate(all="ignore"):  # where it does not converge
            curve, error = improved(at, curve, omega)
        if not math.isfinite(error) or error > 1e3 * last:
            return None
        if error < SMALL and error > last / 2:
            return curve
        last = min(last, error)
    return curve if last < SMALL else None


def improved(at: Oscillating, curve: Curve, omega: float) -> tuple[Curve, float]:
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
    move, after, (a, b, c, d) = at.image(theta + x, y)
    E = x + move - forward(x) - omega, after - forward(y)
    M, P = (np.array([forward(u) for u in w]) for w in (N, L))
    T = (a * N[0] + b * N[1]) * M[1] - (c * N[0] + d * N[1]) * M[0]
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
