"""Birkhoff's normal form of an area preserving map at an elliptic fixed point.

*The complex coordinate.*  Let the Jacobian be ((a, b), (c, d)), of determinant 1 and trace in (-2,
2), and e = e^(i Theta) its eigenvalue with sgn sin Theta = sgn c.  Then z = p dx + q dv with q = p
(e - a)/c satisfies z o Jacobian = e z: the coefficient of dx is p a + q c = e p, and that of dv, p
b + q d = e q, follows from e^2 - (a + d) e + 1 = 0.  Further Im(p^- q) = p^2 sin Theta / c, which
is 1 for p = sqrt(c / sin Theta). From Im q = 1/p: dv = (p/2i) (z - z^-) and dx = (i/2) (q^- z - q
z^-).

*The normal form.*  Write f for the map in z and z^-.  We seek psi = z + psi_2 + psi_3 + ... and

    psi o f = N o psi,    N(w) = e w exp(i (tau_1 |w|^2 + tau_2 |w|^4 + ...)).

Suppose that this holds below degree d, and let E be the terms of degree d of psi_<d o f - N_<d o
psi_<d.  A term psi_jk z^j z^-k, j + k = d, adds psi_jk (e^(j-k) - e) to E_jk.  So psi_jk = E_jk /
(e - e^(j-k)) unless j = k + 1; for j = k + 1 the coefficient psi_jk is free, and e i tau_k = E_jk.
The division proves that e^(j-k-1) != 1.

*The free coefficients.*  Let D = |d psi/dz|^2 - |d psi/dz^-|^2, the Jacobian determinant of psi.
The monomials jk and lm of psi give |z|^2n, n > 0, where j + m = k + l = n + 1, with the factor
j l - k m = (n + 1)(j - k).  So the coefficient of |z|^2n in D is

    D_nn = (n + 1) times the sum of (j - k) Re(psi_jk psi^-_lm),    l = n + 1 - k,  m = n + 1 - j.

Choose psi_(n+1,n) = beta real: with psi_10 = 1 it adds 2 beta to the sum, so that beta = -1/2 times
the sum without it removes |z|^2n.  (An imaginary part of beta would be the rotation w -> w exp(ib
|w|^2n), which commutes with N.)  Then D = 1, and N preserves area, up to the degree treated.
Proof: f preserves area, hence (D o f) = D (det N' o psi).  If D = 1 below degree 2n and N(w) = e w
(unimodular) (1 + rho |w|^2n + ...), rho real, the terms of degree 2n are D_2n o e = D_2n + 2 (n+1)
rho |z|^2n.  The left side has the same term |z|^2n as D_2n, so rho = 0; then e^(j-k) != 1 leaves no
other term of D_2n, and none of D_(2n+1).

*The twists* tau_k are real, since N preserves area: the enclosure of Re(i tau_k) must contain 0,
and that of Im(i tau_k) is the enclosure of tau_k with which the next degrees are treated.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from operator import mul
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
    p, q, zero = frame.p, frame.q, frame.p.integer(0)
    i_half = Complex(zero, p.integer(1) / 2)
    linear = (i_half * q.conjugate(), i_half * Complex(-p, zero))
    real = [Jet(x.order, {(1, 0): c, (0, 1): c.conjugate()}) for c in linear]  # dx and dv
    nonlinear = {u for u in (*x.coefficients, *v.coefficients) if sum(u) >= 2}
    a, b = ({u: w.coefficients.get(u, zero) for u in nonlinear} for w in (x, v))
    image = Jet(x.order, {u: Complex(a[u] * p + b[u] * q.re, b[u] * q.im) for u in nonlinear})
    return substituted(image, real) + Jet(x.order, {(1, 0): frame.eigenvalue})


def conjugate(jet: Jet[Complex]) -> Jet[Complex]:
    """Return the conjugate of a series in z and z^-."""
    return Jet(jet.order, {(k, j): c.conjugate() for (j, k), c in jet.coefficients.items()})


def twists(f: Jet[Complex]) -> list[Interval]:
    """Return enclosures of tau_1, tau_2, ... of an area preserving map f = e z + ..., |e| = 1.

    There are (order - 1)/2 of them.  A resonance of order at most order + 1 rejects, and so does a
    real part that certainly is not zero.
    """
    e, f_conjugate = f.coefficients[1, 0], conjugate(f)
    zero, one = e.re.integer(0), Complex(e.re.integer(1), e.re.integer(0))
    turns = list(accumulate([e] * f.order, mul, initial=one))  # e^n, and e^-n is the conjugate
    psi, tau = Jet(f.order, {(1, 0): one}), list[Interval]()
    for d in range(2, f.order + 1):
        low, n = psi.truncated(d), d // 2
        rest = substituted(low, (f, f_conjugate)) - rotated(low, e, tau)
        E = {power: c for power, c in rest.coefficients.items() if sum(power) == d}
        if d % 2:
            i_tau = E.pop((n + 1, n), Complex(zero, zero)) / e
            need(i_tau.re.contains_zero(), "a coefficient of the normal form is not imaginary")
            tau.append(i_tau.im)
        solved = {u: c / (e - turns[u[0]] * turns[u[1]].conjugate()) for u, c in E.items()}
        psi = psi + Jet(f.order, solved)
        if d % 2:
            psi = psi + Jet(f.order, {(n + 1, n): Complex(free_coefficient(psi, n), zero)})
    return tau


def rotated(psi: Jet[Complex], e: Complex, tau: Sequence[Interval]) -> Jet[Complex]:
    """Return N o psi for N(w) = e w exp(i (tau_1 |w|^2 + tau_2 |w|^4 + ...))."""
    zero, one = e.re.integer(0), e.re.integer(1)
    square, i_angle = psi * conjugate(psi), Jet[Complex](psi.order, {})
    for power, tau_k in zip(accumulate([square] * len(tau), mul), tau, strict=True):
        i_angle = i_angle + power * Complex(zero, tau_k)
    total = term = psi * e
    for k in range(1, psi.order // 2 + 1):  # later terms have a degree of 2k + 1 at least
        term = term * i_angle * Complex(one / k, zero)
        total = total + term
    return total


def free_coefficient(psi: Jet[Complex], n: int) -> Interval:
    """Return the real number that, as coefficient (n+1, n) of psi, removes |z|^2n from D."""
    total = psi.coefficients[1, 0].re * 0
    for (j, k), c in psi.coefficients.items():
        partner = psi.coefficients.get((n + 1 - k, n + 1 - j))
        if partner is not None:
            total = total + (c * partner.conjugate()).re * (j - k)
    return total / -2
