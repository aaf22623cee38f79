"""Birkhoff's normal form of an area preserving map at an elliptic fixed point.

*The complex coordinate.*  Let the Jacobian be ((a, b), (c, d)), of determinant 1 and trace in (-2,
2), and e = e^(i Theta) its eigenvalue with sgn sin Theta = sgn c.  Then z = p dx + q dv with q = p
(e - a)/c satisfies z o Jacobian = e z: the coefficient of dx is p a + q c = e p, and that of dv, p
b + q d = e q, follows from e^2 - (a + d) e + 1 = 0.  Further Im(p^- q) = p^2 sin Theta / c, which
is 1 for p = sqrt(c / sin Theta). From Im q = 1/p: dv = (p/2i) (z - z^-) and dx = (i/2) (q^- z - q
z^-).

*The normal form.*  Write f for the map in z and z^-.  We seek psi = z + psi_2 + psi_3 + ... and

    psi o f = N o psi,    N(w) = e w (1 + nu_1 |w|^2 + nu_2 |w|^4 + ...).

Suppose that this holds below degree d, and let E be the terms of degree d of psi_<d o f - N_<d o
psi_<d.  A term psi_jk z^j z^-k, j + k = d, adds psi_jk (e^(j-k) - e) to E_jk.  So psi_jk = E_jk /
(e - e^(j-k)) unless j = k + 1; for j = k + 1 the coefficient psi_jk is free and e nu_k = E_jk.  The
division proves that e^(j-k-1) != 1.

*The free coefficients.*  Let D = |d psi/dz|^2 - |d psi/dz^-|^2, the Jacobian determinant of psi.
Choose psi_(k+1,k) = beta real: it adds 2 (k+1) beta |z|^2k to the terms of D of degree 2k, so that
beta = -D_kk / (2 (k+1)) removes |z|^2k.  (An imaginary part of beta would be the rotation w -> w
exp(ib |w|^2k), which commutes with N.)  Then D = 1, and N preserves area, up to the degree treated.
Proof: f preserves area, hence (D o f) = D (det N' o psi).  If D = 1 below degree 2k and N(w) = e w
(unimodular) (1 + rho |w|^2k + ...), rho real, the terms of degree 2k are D_2k o e = D_2k + 2 (k+1)
rho |z|^2k.  The left side has the same term |z|^2k as D_2k, so rho = 0; then e^(j-k) != 1 leaves no
other term of D_2k, and none of D_(2k+1).

*The twists.*  N = e w exp(i (tau_1 |w|^2 + tau_2 |w|^4 + ...)).  The logarithm g of 1 + nu_1 s +
nu_2 s^2 + ... has k g_k = k nu_k - sum over m < k of m g_m nu_(k-m), and g_k = i tau_k.  By the
proof above its real part is zero: the enclosures must contain 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.complex import Complex
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, RealJet
from cap.checker.kernel.rejection import need
from cap.checker.kernel.substitution import substituted


def told_form(x: str = "x", v: str = "v") -> str:
    """Return the normal form of Phi in words, with the names of its coordinates."""
    return (
        f"in a complex coordinate z around it, with d{x}^d{v} = (i/2) dz^dz^- there (so that "
        f"positive angles turn from {x} to {v}), Phi is z -> z exp(i (Theta + tau_1 |z|^2)) + "
        "O(|z|^4)"
    )


class EllipticFrame(NamedTuple):
    """The eigenvalue e = e^(i Theta), the angle Theta, and the coordinate z = p dx + q dv."""

    eigenvalue: Complex
    angle: Interval
    p: Interval
    q: Complex


def elliptic_frame(jacobian: Sequence[Sequence[Interval]]) -> EllipticFrame:
    """Return the angle and the coordinate for a Jacobian of determinant 1 and trace in (-2, 2)."""
    (a, _), (c, d) = jacobian
    need(not c.contains_zero(), "the lower left entry of the Jacobian is not certainly nonzero")
    sign = 1 if c.is_positive() else -1
    cos = (a + d) / 2
    sin = (-cos.square() + 1).sqrt() * sign
    p = (c / sin).sqrt()
    e = Complex(cos, sin)
    return EllipticFrame(e, arccos(cos) * sign, p, Complex(p * (cos - a) / c, p * sin / c))


def in_complex_coordinate(x: RealJet, v: RealJet, frame: EllipticFrame) -> Jet[Complex]:
    """Return z o Phi as a jet in (z, z^-) from the jets of Phi in (dx, dv) at the fixed point.

    Its linear part is e z exactly, since z is an eigenvector.
    """
    p, q = frame.p, frame.q
    zero, one = p.integer(0), p.integer(1)
    half = one / 2
    i_half_q = Complex(zero, half) * q.conjugate()
    dx = Jet(x.order, {(1, 0): i_half_q, (0, 1): i_half_q.conjugate()})
    dv = Jet(x.order, {(1, 0): Complex(zero, -p * half), (0, 1): Complex(zero, p * half)})
    image = complexified(x) * Complex(p, zero) + complexified(v) * q
    nonlinear = {power: c for power, c in image.coefficients.items() if sum(power) >= 2}
    composed = substituted(Jet(x.order, nonlinear), (dx, dv))
    return composed + Jet(x.order, {(1, 0): frame.eigenvalue})


def complexified(jet: RealJet) -> Jet[Complex]:
    """Return the same series with complex coefficients."""
    return Jet(
        jet.order, {power: Complex(c, c.integer(0)) for power, c in jet.coefficients.items()}
    )


def conjugate(jet: Jet[Complex]) -> Jet[Complex]:
    """Return the conjugate of a series in z and z^-."""
    return Jet(jet.order, {(k, j): c.conjugate() for (j, k), c in jet.coefficients.items()})


def twists(f: Jet[Complex]) -> list[Interval]:
    """Return enclosures of tau_1, tau_2, ... of an area preserving map f = e z + ..., |e| = 1.

    There are (order - 1)/2 of them.  A resonance of order at most order + 1 rejects, and so does a
    real part that certainly is not zero.
    """
    e, f_conjugate = f.coefficients[1, 0], conjugate(f)
    zero = e.re.integer(0)
    one = Complex(zero + 1, zero)
    psi, nu = Jet(f.order, {(1, 0): one}), list[Complex]()
    for d in range(2, f.order + 1):
        low = psi.truncated(d)
        rest = substituted(low, (f, f_conjugate)) - rotated(low, e, nu)
        rest_d = {power: c for power, c in rest.coefficients.items() if sum(power) == d}
        if d % 2:
            nu.append(rest_d.pop((d // 2 + 1, d // 2), Complex(zero, zero)) / e)
        psi = psi + Jet(
            f.order, {(j, k): c / (e - _power(e, j - k)) for (j, k), c in rest_d.items()}
        )
        if d % 2:
            psi = psi + Jet(f.order, {(d // 2 + 1, d // 2): free_coefficient(psi, d // 2, one)})
    return [_imaginary(g) for g in logarithm(nu)]


def rotated(psi: Jet[Complex], e: Complex, nu: Sequence[Complex]) -> Jet[Complex]:
    """Return N o psi for N(w) = e w (1 + nu_1 |w|^2 + nu_2 |w|^4 + ...)."""
    square = psi * conjugate(psi)
    total = term = psi * e
    for nu_k in nu:
        term = term * square
        total = total + term * nu_k
    return total


def free_coefficient(psi: Jet[Complex], k: int, one: Complex) -> Complex:
    """Return the real number that, as coefficient (k+1, k) of psi, removes |z|^2k from D."""
    psi_z = Jet(psi.order, {(i - 1, j): c * i for (i, j), c in psi.coefficients.items() if i})
    psi_w = Jet(psi.order, {(i, j - 1): c * j for (i, j), c in psi.coefficients.items() if j})
    determinant = psi_z * conjugate(psi_z) - psi_w * conjugate(psi_w)
    zero = one.im
    return Complex(
        -determinant.coefficients.get((k, k), Complex(zero, zero)).re / (2 * (k + 1)), zero
    )


def logarithm(nu: Sequence[Complex]) -> list[Complex]:
    """Return the coefficients g_1, g_2, ... of log(1 + nu_1 s + nu_2 s^2 + ...)."""
    g = list[Complex]()
    for k, nu_k in enumerate(nu, start=1):
        g_k = nu_k
        for m in range(1, k):
            product = g[m - 1] * nu[k - m - 1] * m
            g_k = g_k - Complex(product.re / k, product.im / k)
        g.append(g_k)
    return g


def _imaginary(g: Complex) -> Interval:
    """Return the imaginary part of a number whose real part is zero by theorem."""
    need(g.re.contains_zero(), "a coefficient of the normal form is not purely imaginary")
    return g.im


def _power(e: Complex, n: int) -> Complex:
    """Return e^n for |e| = 1, where e^-1 is the conjugate."""
    base = e if n >= 0 else e.conjugate()
    result = Complex(e.re.integer(1), e.re.integer(0))
    for _ in range(abs(n)):
        result = result * base
    return result
