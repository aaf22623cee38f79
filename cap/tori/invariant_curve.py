"""An invariant curve beside an approximate one: the a-posteriori theorem, for any planar map.

*The map* 𝓕 is real analytic, injective and exact symplectic on an open set U of the plane, or of
a cylinder: det D𝓕 = 1, and ∮ x dv is kept on every closed curve in U (if U is simply connected,
det D𝓕 = 1 implies it; on a cylinder it is a hypothesis more).

*The curve* K(θ) = (turns θ + x(θ), v(θ)), with real trigonometric polynomials x, v; ``turns`` is 0
for a closed curve in the plane, and 1 (x in radians) for one that spans a cylinder.

*How a map is plugged in.*  Write a function that takes the models x, v of periodic parts (errors
allowed: then it is about all functions in them, complex ones too) and returns an `Image`: models of
the periodic parts of 𝓕(K), and ``tangent``, which maps models (a, b) to models of D𝓕(K) (a, b).
That function raises `NotProved` if 𝓕 may be undefined.  It must be analytic in x, v, and its bounds
must hold in all norms of smaller ρ too: arithmetic of `cap.sets.fourier`, with hints that are
fixed polynomials, is.  Whoever calls shows that for real functions it is 𝓕, and that real curves
within ``reach`` of K lie in U.  `invariant_curve` then does the rest.

*The theorem*: docs/invariant-curve-proof.md, with this notation.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel
from cap.sets.interval import Ball, ComplexBall

Vector = tuple[FourierModel, FourierModel]


class Image(NamedTuple):
    """The image of a curve, and what D𝓕 along the curve makes of a vector."""

    x: FourierModel
    v: FourierModel
    tangent: Callable[[Vector], Vector]


Map = Callable[[FourierModel, FourierModel], Image]


@dataclass(frozen=True)
class Rotation:
    """θ -> θ + ω, with |exp(ikω) - 1| >= 4γ/|k| for all k != 0, at one degree of polynomials.

    ``factors`` enclose exp(ikω).
    """

    omega: Ball
    gamma: Ball
    factors: list[ComplexBall]

    @classmethod
    def of(cls, circle: Circle, omega: Ball, gamma: Ball) -> "Rotation":
        """Return the rotation by ω = 2πα, where dist(kα, Z) >= γ/|k|."""
        factors = [ComplexBall(0, k * omega).exp() for k in circle.modes(circle.degree)]
        return cls(omega, gamma, factors)

    def ahead(self, u: FourierModel) -> FourierModel:
        """Return u⁺ = u(θ + ω); its norm is that of u."""
        return u.times(self.factors)

    def both(self, w: Vector) -> Vector:
        """Return both components ahead."""
        return self.ahead(w[0]), self.ahead(w[1])


@dataclass(frozen=True)
class Curve:
    """The periodic parts of K, without error, and its ``turns``."""

    x: FourierModel
    v: FourierModel
    turns: int = 0

    @property
    def tangent(self) -> Vector:
        """K'."""
        return self.x.derivative() + self.turns, self.v.derivative()


class Sizes(NamedTuple):
    """The numbers of which the theorem has its hypotheses.

    ``defect`` >= |𝓕(K) - K⁺|, ``tangent`` >= |K'|, ``frame`` >= |N|, ``skew`` >= |det(K', N) - 1|,
    ``twist`` >= |T|, ``mean_twist`` <= |<T>|, ``spread`` >= |𝓕(K + h) - 𝓕(K)| for |h| <= ``reach``;
    ``rho``, and ``small`` = 1/(4eγ).  Here T = det(D𝓕(K) Ñ, Ñ⁺), Ñ = N/det(K', N).
    """

    defect: Ball
    tangent: Ball
    frame: Ball
    skew: Ball
    twist: Ball
    mean_twist: Ball
    spread: Ball
    reach: Ball
    rho: Ball
    small: Ball


class Found(NamedTuple):
    """The theorem: an invariant curve K∞ with |K∞ - K| <= ``distance``, |K∞' - K'| <= ``slope``.

    In the norm of ρ/7, so for all real θ; ``contraction`` is y0 <= 1/2.
    """

    distance: Ball
    slope: Ball
    contraction: Ball


def det(a: Vector, b: Vector) -> FourierModel:
    """Return a1 b2 - a2 b1."""
    return a[0] * b[1] - a[1] * b[0]


def norm(w: Vector) -> Ball:
    """Return the larger norm of the components."""
    return interval.upper(w[0].norm.max(w[1].norm))


def measured(mapped: Map, curve: Curve, frame: Vector, rotation: Rotation, reach: Ball) -> Sizes:
    """Return the sizes for a curve K and a frame N, which should be near det(K', N) = 1."""
    circle = curve.x.circle
    image = mapped(curve.x, curve.v)
    around = mapped(curve.x.widened_to(reach), curve.v.widened_to(reach))
    spread = norm((around.x - image.x, around.v - image.v))
    defect = error_of(image, curve, rotation)
    skew = (det(curve.tangent, frame) - 1).norm
    if not skew < 1:
        raise NotProved("frame", "the frame may be degenerate", {"|det(K', N) - 1|": skew})
    twist = det(image.tangent(frame), rotation.both(frame))
    most, change = twist.norm, 1 / (1 - skew) ** 2
    mean_twist = interval.lower(twist.mean.abs_lower() - most * (change - 1))
    small = 1 / (4 * Ball(1).exp() * rotation.gamma)
    return Sizes(
        *(norm(defect), norm(curve.tangent), norm(frame), skew, most * change, mean_twist),
        *(spread, reach, interval.ball(circle.rho), small),
    )


def error_of(image: Image, curve: Curve, rotation: Rotation) -> Vector:
    """Return 𝓕(K) - K⁺."""
    x, v = rotation.both((curve.x, curve.v))
    return image.x - x - curve.turns * rotation.omega, image.v - v


def invariant_curve(sizes: Sizes) -> Found:
    """Return how near an invariant curve is, or raise `NotProved` with the hypothesis that fails.

    R* and s* of the theorem are found: first with 0 in their place, then twice what this gives.
    """
    zero = interval.ZERO
    allowed = zero, zero
    for _ in range(2):
        found = constants(sizes, *allowed)
        allowed = 2 * interval.upper(found.distance), 2 * interval.upper(found.slope)
    found = constants(sizes, *allowed)
    distance, slope = allowed
    confirm("RK <= R*", found.distance, distance)
    confirm("R* <= r/4", distance, sizes.reach / 4)
    confirm("s <= s*", found.slope, slope)
    return found


def confirm(name: str, small: Ball, large: Ball | int) -> None:
    """Raise `NotProved` unless one number is at most the other."""
    if not small <= large:
        raise NotProved(
            "invariant curve", f"{name} may fail", {"left": small, "right": Ball(large)}
        )


def constants(sizes: Sizes, allowed: Ball, tilt: Ball) -> Found:
    """Return y0, RK and s with R* = ``allowed`` and s* = ``tilt`` in their formulas."""
    eps, l0, n0, d0, t0, tm, M, r, rho, small = sizes
    e, delta = Ball(1).exp(), rho / 7
    ell, d = l0 + tilt, d0 + 2 * n0 * tilt
    confirm("d0 <= d <= 1/2", 2 * d, 1)
    n, nu = n0 / (1 - d), 2 * n0**2 * tilt / ((1 - d0) * (1 - d))
    turned = 2 * (8 * M * allowed * n**2 / r**2 + 4 * M / r * n * nu)
    confirm("dT < tm", turned, tm)
    t, tau = t0 + turned, 1 / (tm - turned)
    if not tau > 0:
        raise NotProved("invariant curve", "the twist may vanish on average", {"<T>": tm})
    X2 = 2 * (ell * small * (1 + tau * t) + tau * n * delta)
    X1 = small * (2 * n * delta + t * X2)
    Y = ell * X1 + n * X2 * delta
    C = (
        4 / e * ell * n * X1 * delta
        + 4 / e * n * (ell * t + n) * X2 * delta**2
        + n * delta**3 / (2 * e)
        + 8 * M * Y**2 / r**2
    )
    contraction = 16 * C * eps / delta**4
    confirm("y0 <= 1/2", 2 * contraction, 1)
    confirm("c4 <= 1/2", 4 * n * eps / (e * delta), 1)
    return Found(
        interval.upper(Ball(8) / 7 * Y * eps / delta**2),
        interval.upper(Ball(4) / 3 * Y * eps / (e * delta**3)),
        interval.upper(contraction),
    )
