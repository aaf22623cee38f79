"""The a-posteriori theorem: beside an almost invariant curve there is an invariant one.

Let F be real analytic and injective on a simply connected open set U of the plane, with det DF = 1.
Let K, N be real trigonometric polynomials, alpha with dist(k alpha, Z) >= gamma/|k|, u+ the
function u(theta + 2 pi alpha), and r, M > 0 such that for all rho' <= rho

    F(K + h) is defined and analytic for complex |h| <= r, |F(K + h) - F(K)| <= M; for real h the
    curve K + h lies in U, and F(K + h) is its image;
    |F(K) - K+| <= eps, |K'| <= l0, |N| <= n0, |det(K', N) - 1| <= d0 < 1/2;
    with N~ = N/det(K', N), T = det(DF(K) N~, N~+):   |T| <= t0, |<T>| >= tm > 0.

``near`` has the rest: numbers R*, s* and inequalities.  Then F(C(theta)) = C(theta + 2 pi alpha)
for an analytic C with |C - K| <= RK and |C' - K'| <= s in the norm of rho/7.  If a component has
|K_1| > RK, C is an embedded circle.  Proof: docs/invariant-curve-proof.md.

Norms: |u| = sum of |u_k| exp(rho |k|), of vectors the larger of the components; <u> = u_0.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.exponential import exp
from cap.checker.kernel.fourier import Circle, Function, ceiling
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

Vector = tuple[Function, Function]
Tangent = Callable[[Vector], Vector]


class Image(NamedTuple):
    """The image of curves (theta + x, y): its x and y, and the derivative along it of vectors."""

    x: Function
    y: Function
    tangent: Tangent


class Sizes(NamedTuple):
    """The numbers of the hypotheses, as intervals; ``small`` is 1/(4 e gamma)."""

    eps: Interval
    l0: Interval
    n0: Interval
    d0: Interval
    t0: Interval
    tm: Interval
    M: Interval
    r: Interval
    rho: Interval
    small: Interval


class Near(NamedTuple):
    """RK and s."""

    distance: Fraction
    slope: Fraction


class Shift:
    """u -> u+, by a rotation number alpha."""

    def __init__(self, circle: Circle, alpha: Interval, pi: Interval) -> None:
        self.circle = circle
        omega = alpha * pi * 2
        pairs = [[circle.near(c) for c in cos_sin(omega * k)] for k in range(circle.degree + 1)]
        self.factors = [(cos[0], sin[0]) for cos, sin in pairs]
        self.error = max(cos[1] + sin[1] for cos, sin in pairs)

    def __call__(self, u: Function) -> Function:
        """Return u+; its norm is that of u."""
        unit = self.circle.unit
        pairs = zip(u.coefficients, self.factors, strict=True)
        turned = [((a * c - b * s) // unit, (a * s + b * c) // unit) for (a, b), (c, s) in pairs]
        error = u.error + ceiling(u.size * self.error, unit) + 2 * self.circle.grain
        return Function(self.circle, turned, error)


def det(a: Vector, b: Vector) -> Function:
    """Return a_1 b_2 - a_2 b_1."""
    return a[0] * b[1] - a[1] * b[0]


def norm(w: Vector) -> int:
    """Return the larger norm."""
    return max(w[0].norm, w[1].norm)


def twist(circle: Circle, tangent: Tangent, N: Vector, ahead: Shift, d0: int) -> tuple[int, int]:
    """Return t0 and tm.

    T = T_0/(D D+) with T_0 = det(DF N, N+) and |D - 1| <= d0, so |T - T_0| <= |T_0| (1/(1 - d0)^2 -
    1).
    """
    unit = circle.unit
    need(2 * d0 < unit, "det(K', N) may be 1/2 away from 1")
    T = det(tangent(N), (ahead(N[0]), ahead(N[1])))
    most = ceiling(T.norm * unit**2, (unit - d0) ** 2)
    return most, abs(T.mean) - T.error - (most - T.norm)


class Setting(NamedTuple):
    """What the theorem is about, besides F: K, K', N, the rotation, gamma and r.

    K are the periodic parts of the curve.
    """

    K: Vector
    L: Vector
    N: Vector
    ahead: Shift
    gamma: Fraction
    reach: Fraction


def beside(given: Setting, defect: Vector, spread: Vector, tangent: Tangent) -> Near:
    """Return how near C is; the hypotheses must hold, and the inequalities.

    ``defect`` is F(K) - K+, ``spread`` F(K + h) - F(K) for |h| <= reach, ``tangent`` DF(K).
    """
    circle = given.ahead.circle
    unit, bits = circle.unit, circle.bits
    d0 = (det(given.L, given.N) - 1).norm
    t0, tm = twist(circle, tangent, given.N, given.ahead, d0)
    need(tm > 0, "the mean twist may vanish")
    norms = norm(defect), norm(given.L), norm(given.N), d0, t0, tm, norm(spread)
    sizes = [*(Fraction(n, unit) for n in norms), given.reach, circle.rho]
    numbers = [Interval.enclosing(q, q, bits) for q in sizes]
    return near(Sizes._make([*numbers, small_divisors(given.gamma, bits)]))


def near(sizes: Sizes) -> Near:
    """Return RK and s; the inequalities of the theorem must hold.

    R* and s* may be anything: here they are twice what the formulas give with a half of them.
    """
    zero = sizes.eps.integer(0)
    R_star = s_star = zero
    for _ in range(2):
        RK, s = bounds(sizes, R_star, s_star)
        R_star, s_star = RK * 2, s * 2
    RK, s = bounds(sizes, R_star, s_star)
    need(RK.hi <= R_star.lo, "RK <= R* may fail")
    need(R_star.hi * 4 <= sizes.r.lo, "R* <= r/4 may fail")
    need(s.hi <= s_star.lo, "s <= s* may fail")
    return Near(RK.upper, s.upper)


def bounds(sizes: Sizes, R_star: Interval, s_star: Interval) -> tuple[Interval, Interval]:
    """Return RK and s, if the other inequalities hold."""
    eps, l0, n0, d0, t0, tm, M, r, rho, small = sizes
    e, delta, one = exp(Fraction(1)).with_bits(eps.bits), rho / 7, eps.integer(1)
    ell, d = l0 + s_star, d0 + n0 * s_star * 2
    need((d * 2).hi <= one.lo, "d <= 1/2 may fail")
    n = n0 / (one - d)
    nu = n0.square() * s_star * 2 / ((one - d0) * (one - d))
    dT = (M * R_star * n.square() * 8 / r.square() + M * n * nu * 4 / r) * 2
    need((tm - dT).is_positive(), "the mean twist may be at most dT")
    t, tau = t0 + dT, one / (tm - dT)
    X2 = (ell * small * (tau * t + 1) + tau * n * delta) * 2
    X1 = small * (n * delta * 2 + t * X2)
    Y = ell * X1 + n * X2 * delta
    C = (
        ell * n * X1 * delta * 4 / e
        + n * (ell * t + n) * X2 * delta.square() * 4 / e
        + n * delta * delta.square() / (e * 2)
        + M * Y.square() * 8 / r.square()
    )
    y0 = C * eps * 16 / delta.square().square()
    need((n * eps * 4 / (e * delta)).hi <= one.lo, "c4 <= 1/2 may fail")
    need((y0 * 2).hi <= one.lo, "y0 <= 1/2 may fail")
    return Y * eps * 8 / (delta.square() * 7), Y * eps * 4 / (e * delta * delta.square() * 3)


def small_divisors(gamma: Fraction, bits: int) -> Interval:
    """Return 1/(4 e gamma)."""
    need(gamma > 0, "the Diophantine constant is not positive")
    return Interval.enclosing(1, 1, bits) / (
        exp(Fraction(1)).with_bits(bits) * Interval.enclosing(gamma, gamma, bits) * 4
    )
