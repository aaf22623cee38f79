"""Birkhoff normal form of an area-preserving map of the plane at an elliptic fixed point.

Coordinates.  Let the Jacobian be ((a, b), (c, d)), with trace 2 cos Θ and determinant one.  The
function z = p δx + q δv with p = sqrt(c/sin Θ), q = p (e^{iΘ} - a)/c satisfies z∘Φ' = e^{iΘ} z and
Im(p q) = 1, so dx∧dv = (i/2) dz∧dz̄: z preserves area and orientation.  It exists when c and sin Θ
have one sign, which fixes Θ in (-π, π).  Since bc = ad - 1 <= (trace/2)² - 1 < 0, c never vanishes.

Normal form.  If e^{ikΘ} != 1 for k = 1 .. n + 1 (n odd) there is w = z + O(|z|²), preserving
area to that order, in which

    Φ(w) = w exp(i(Θ + τ_1 |w|² + τ_2 |w|⁴ + ...)) + O(|w|^{n+1}).

τ_k is the k-th Birkhoff (twist) coefficient; per action I = |z|²/2 it counts 2^k-fold.

Method.  w = ψ(z) solves ψ∘Φ = N∘ψ with N(w) = λ w (1 + ν_1|w|² + ...) degree by degree: with
λ = e^{iΘ}, the coefficient of z^j z̄^k gives ψ_jk (λ^{j-k} - λ) = E_jk, known from lower degrees,
unless j = k + 1, which determines ν_k = -E_jk/λ and leaves ψ_jk free.  It is taken real such that
D = det Dψ = |ψ_z|² - |ψ_z̄|² has no term |z|^{2k}.  Then D = 1 to that degree: as Φ preserves area,
N preserves the form with density (1/D)∘ψ⁻¹, which without resonance depends on |w|² alone, and
whose terms are removed one by one.  So ψ preserves area, and τ_2, τ_3, ... are well defined.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from cap.errors import NotProved
from cap.sets.interval import Ball, ComplexBall, pi, subset
from cap.sets.jet import Jet


@dataclass(frozen=True)
class Ellipticity:
    """The linear part: ``theta`` = Θ, ``multiplier`` = e^{iΘ}, and z = ``p`` δx + ``q`` δv."""

    theta: Ball
    multiplier: ComplexBall
    p: Ball
    q: ComplexBall


def ellipticity(x: Jet, v: Jet) -> Ellipticity:
    """Return the linear part of the normal form of the map with jets ``x``, ``v``.

    Assumes that the jets are taken at a fixed point and that the determinant is one.  Verifies
    |trace| < 2 and that the lower left entry is not zero; raises `NotProved` where that is not
    certain.
    """
    a, c, d = x[1, 0], v[1, 0], v[0, 1]
    half = (a + d) / 2
    if not -1 < half < 1:
        raise NotProved("Lemma 3", "the trace may leave (-2, 2)", {"trace": a + d})
    if not (c > 0 or c < 0):
        raise NotProved("Lemma 3", "the Jacobian's lower left entry may vanish", {"c": c})
    sign = 1 if c > 0 else -1
    sin = sign * (1 - half * half).sqrt()
    multiplier = ComplexBall(half, sin)
    p = (c / sin).sqrt()
    return Ellipticity(sign * half.acos(), multiplier, p, (multiplier - a) * p / c)


def rotation_number(linear: Ellipticity) -> Ball:
    """Return |Θ|/2π."""
    return abs(linear.theta) / (2 * pi())


def twists(x: Jet, v: Jet) -> list[Ball]:
    """Return τ_1, ..., τ_m for jets of odd order 2m + 1 of an area-preserving map.

    Assumes the jets enclose the Taylor coefficients at an elliptic fixed point.  Verifies that
    the determinant may be one, that no divisor λ^{j-k} - λ vanishes, and that the real parts which
    area preservation makes zero contain zero.
    """
    determinant = x[1, 0] * v[0, 1] - x[0, 1] * v[1, 0]
    if not subset(Ball(1), determinant):
        raise NotProved("normal form", "the determinant is not one", {"determinant": determinant})
    linear = ellipticity(x, v)
    f = complex_map(x, v, linear)
    _, nu = normal_form(f, linear.multiplier)
    result = []
    for k, (real, imaginary) in enumerate(_logarithm(nu), start=1):
        if not (real.is_finite() and real.contains(0)):
            raise NotProved(
                "normal form", f"resonant term {k} breaks area preservation", {"Re": real}
            )
        if not imaginary.is_finite():
            raise NotProved("normal form", f"twist coefficient {k} is not bounded", {})
        result.append(imaginary)
    return result


def complex_map(x: Jet, v: Jet, linear: Ellipticity) -> Jet:
    """Return the jet in (z, z̄) of the map in the coordinate z, its fixed point at zero.

    With p Im q = 1 the inverse of z = p δx + q δv is δx = (q z̄ - q̄ z)/2i, δv = p (z - z̄)/2i.
    """
    space, (p, q) = x.space, (linear.p, linear.q)
    z, bar = Jet.variables((ComplexBall(0), ComplexBall(0)), space.order)
    half = ComplexBall(0, -1) / 2
    dx = (bar * q - z * q.conjugate()) * half
    dv = (z - bar) * (p * half)
    image = Jet(space, [p * a + q * b for a, b in zip(x.coefficients, v.coefficients, strict=True)])
    return substitute(image.above(0), (dx, dv))


def conjugate_real(f: Jet) -> Jet:
    """Return the conjugate of a jet in real variables."""
    return Jet(f.space, [(ComplexBall(0) + c).conjugate() for c in f.coefficients])


def substitute(f: Jet, values: Sequence[Jet]) -> Jet:
    """Return the jet of f(values), where the values vanish at the origin."""
    space = values[0].space
    powers = [[Jet.constant(1, space)] for _ in values]
    for value, table in zip(values, powers, strict=True):
        for _ in range(space.order):
            table.append(table[-1] * value)
    total = Jet.constant(0, space)
    for exponent, coefficient in zip(f.space.exponents, f.coefficients, strict=True):
        term = powers[0][exponent[0]]
        for table, power in zip(powers[1:], exponent[1:], strict=True):
            term = term * table[power]
        total = total + term * coefficient
    return total


def conjugate(f: Jet) -> Jet:
    """Return the jet in (z, z̄) of the complex conjugate of f."""
    coefficients = [ComplexBall(f[k, j]).conjugate() for j, k in f.space.exponents]
    return Jet(f.space, coefficients)


def normal_form(f: Jet, multiplier: ComplexBall) -> tuple[Jet, list[ComplexBall]]:
    """Return ψ, and ν_1, ν_2, ... of N, for the map ``f``; see the module's docstring."""
    space = f.space
    psi, _ = Jet.variables((ComplexBall(0), ComplexBall(0)), space.order)
    bar = conjugate(f)
    nu: list[ComplexBall] = []
    for degree in range(2, space.order + 1):
        low = psi.truncated(degree)
        image = substitute(low, (f.truncated(degree), bar.truncated(degree)))
        error = _normal_map(low, nu, multiplier) - image
        for j in range(degree + 1):
            k = degree - j
            e = error[j, k]
            if j == k + 1:
                nu.append(-e / multiplier)
                value = -_area_defect(psi, k) / (2 * (k + 1))
            else:
                divisor = multiplier ** (j - k) - multiplier
                if divisor.contains(0):
                    raise NotProved(
                        "normal form", f"resonance at z^{j} zbar^{k}", {"divisor": divisor}
                    )
                value = e / divisor
            psi.coefficients[space.index[j, k]] = value
    return psi, nu


def _normal_map(psi: Jet, nu: list[ComplexBall], multiplier: ComplexBall) -> Jet:
    """Return the jet of N∘ψ = λ ψ (1 + ν_1 ψψ̄ + ...)."""
    square = psi * conjugate(psi)
    factor = Jet.constant(0, psi.space)
    for coefficient in reversed(nu):
        factor = (factor + coefficient) * square
    return psi * (factor + 1) * multiplier


def _area_defect(psi: Jet, k: int) -> Ball:
    """Return the coefficient of |z|^{2k} in |ψ_z|² - |ψ_z̄|², which is real."""
    by_z, by_bar = psi.derivative(0), psi.derivative(1)
    determinant = by_z * conjugate(by_z) - by_bar * conjugate(by_bar)
    return ComplexBall(determinant[k, k]).real


def _logarithm(nu: list[ComplexBall]) -> list[tuple[Ball, Ball]]:
    """Return (real, imaginary) of the coefficients of log(1 + ν_1 s + ν_2 s² + ...).

    With 1 + n(s) = exp(l(s)): n' = l' (1 + n), so k l_k = k ν_k - Σ_{j<k} j l_j ν_{k-j}.
    """
    logs: list[ComplexBall] = []
    for k in range(1, len(nu) + 1):
        known = sum((j * logs[j - 1] * nu[k - j - 1] for j in range(1, k)), ComplexBall(0))
        logs.append(nu[k - 1] - known / k)
    return [(value.real, value.imag) for value in logs]
