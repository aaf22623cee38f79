"""The standard map (x, v) -> (x + v', v'), v' = v + K sin x, and its spanning invariant curves.

It is the simplified map of a ball that bounces on a vibrating table, and of Fermi's accelerator: x
is the phase of an impact, v the speed after it, up to a constant, and the way of the table, or of
the wall, is neglected.  On the cylinder (x mod 2π, v) it is analytic, invertible, det = 1, and

    v' dx' - v dx = d(v'²/2 - K cos x):

it is exact.  For a curve (θ + x, v) with 𝓕(K) = K⁺ + E this gives, as ∮ v dx is the same for K,
K⁺ and 𝓕(K), after an integration by parts

    0 = 2 <det(E, K⁺')> + <det(E, E')>:

what the proof of the a-posteriori theorem has of closed curves in a simply connected U.  The curve
is embedded: if K∞(a) and K∞(b) are one point of the cylinder, so are K∞(θ + a) and K∞(θ + b) for
all θ, by 𝓕 and by density, and comparing the means a - b is a multiple of 2π.

An invariant curve that spans the cylinder separates it, and 𝓕 keeps its ends apart: orbits that
start below it stay below it, in both directions of time.  𝓕 commutes with (x, v) -> (x, v + 2π) and
with (x, v) -> (-x, -v): so with the curve its images are invariant, too.

Curves are found from K = 0, where they are v = ω, and followed in K by Newton's method.
"""

from fractions import Fraction
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel
from cap.sets.interval import Ball, ComplexBall
from cap.tori.invariant_curve import (
    Curve,
    Found,
    Image,
    Map,
    Rotation,
    Vector,
    error_of,
    invariant_curve,
    measured,
    norm,
)
from cap.tori.newton import improved, levelled, shortened
from cap.tori.rotation import Quadratic

GOLDEN = Quadratic((), (1,))
HALF_I = ComplexBall(0, Ball((1, -1)))
NEWTON, FEW = 12, 4  # steps, at most: for the last K, before
LEAST = 64  # degree
REACH = Ball(1) / 8
WIDE = Ball(1) / 2**20  # a state that is followed no further
GRID = 4  # points for each mode, where the frame is computed


def standard_map(circle: Circle, K: Ball) -> Map:
    """Return the map for curves (θ + x(θ), v(θ)); it is entire."""
    sine = circle.model([HALF_I, ComplexBall(0), -HALF_I])
    cosine = circle.model([ComplexBall(1) / 2, ComplexBall(0), ComplexBall(1) / 2])

    def mapped(x: FourierModel, v: FourierModel) -> Image:
        s, c = x.sin_cos()
        sin, cos = sine * c + cosine * s, cosine * c - sine * s
        after = v + sin * K

        def tangent(w: Vector) -> Vector:
            pushed = w[1] + cos * K * w[0]
            return w[0] + pushed, pushed

        return Image(x + after, after, tangent)

    return mapped


class Spanning(NamedTuple):
    """An invariant curve that spans the cylinder, within ``found.distance`` of ``curve``."""

    curve: Curve
    found: Found

    def speeds(self) -> tuple[Ball, Ball]:
        """Return bounds of v on the invariant curve, from below and from above.

        So no orbit passes from below the first to above the second, or back.
        """
        v, far = self.curve.v, self.found.distance
        mean, swing = v.mean.real, v.swing + far
        return interval.lower(mean - swing), interval.upper(mean + swing)


def spanning_curve(
    K: Fraction,
    degree: int,
    rho: Fraction,
    *,
    rotation: Quadratic = GOLDEN,
    steps: int = 4,
) -> Spanning:
    """Prove that the standard map has an invariant curve with this rotation number.

    It lies in the strip |Im θ| <= ρ/7 near a trigonometric polynomial of this ``degree``.  Raises
    `NotProved`; then there may be none, or the degree, ρ or the working precision do not suffice.
    """
    omega, gamma = 2 * interval.pi() * rotation.value(), interval.ball(rotation.diophantine())
    curve = level(Circle(LEAST, rho), omega)
    for part in range(1, steps + 1):  # nearer to K in smaller steps, with higher degrees
        circle = Circle(max(LEAST, degree >> (steps - part)), rho)
        turn = Rotation.of(circle, omega, gamma)
        k = interval.ball(K * (1 - (1 - Fraction(part, steps)) ** 2))
        mapped = standard_map(circle, k)
        curve = followed(mapped, moved(curve, circle), turn, NEWTON if part == steps else FEW)
    frame = levelled(mapped, curve, normal(curve), turn)
    found = invariant_curve(measured(mapped, curve, frame, turn, REACH))
    return Spanning(curve, found)


def reached(K: Fraction, x: Fraction, v: Fraction, count: int) -> Ball:
    """Return a lower bound of the largest v of the first states of an orbit, at most ``count``.

    So each invariant spanning curve above the state (x, v) has points with a larger v: as the orbit
    stays below it.  The orbit is followed in balls, as far as the working precision suffices.
    """
    k, a, b = (interval.ball(q) for q in (K, x, v))
    highest = interval.lower(b)
    for _ in range(count):
        b = b + k * a.sin()
        a = a + b
        if not b.rad() < WIDE:
            break
        highest = interval.lower(b) if interval.lower(b) > highest else highest
    return highest


def level(circle: Circle, omega: Ball) -> Curve:
    """Return the curve v = ω, invariant for K = 0."""
    zero = circle.constant(0)
    return Curve(zero, zero + omega.mid(), 1)


def moved(curve: Curve, circle: Circle) -> Curve:
    """Return the same curve with polynomials of a higher degree."""
    x, v = (circle.model(w.coefficients) for w in (curve.x, curve.v))
    return Curve(x, v, curve.turns)


def followed(mapped: Map, curve: Curve, rotation: Rotation, most: int) -> Curve:
    """Return the curve after Newton's method, which stops where the error does not decrease."""
    best = _error(mapped, curve, rotation)
    for _ in range(most):
        better = improved(mapped, curve, normal(curve), rotation)
        size = _error(mapped, better, rotation)
        if not size < best:
            break
        curve, best = better, size
    return curve


def _error(mapped: Map, curve: Curve, rotation: Rotation) -> Ball:
    return norm(error_of(mapped(curve.x, curve.v), curve, rotation))


def normal(curve: Curve) -> Vector:
    """Return a frame near J K'/|K'|², from values on a grid in floats: a hint."""
    circle = curve.x.circle
    x, v = (values(w) for w in curve.tangent)
    square = x * x + v * v
    a, b = (of_values(circle, u) for u in (-v / square, x / square))
    return a, b


def values(u: FourierModel) -> npt.NDArray[np.float64]:
    """Return the values of a real function on a grid, in floats."""
    n = u.circle.degree
    modes = np.array([complex(c.mid()) for c in u.coefficients[n:]])
    size = GRID * n
    padded = np.zeros(size // 2 + 1, dtype=complex)
    padded[: n + 1] = modes
    return np.fft.irfft(padded * size, size)


def of_values(circle: Circle, u: npt.NDArray[np.float64]) -> FourierModel:
    """Return a trigonometric polynomial near a real function with these values."""
    modes = np.fft.rfft(u)[: circle.degree + 1] / len(u)
    return shortened(circle.real([ComplexBall(z.real, z.imag) for z in modes]))
