"""The time-T map near a periodic orbit to third order, and its Birkhoff normal form.

*A contact, at its time.*  As in ``monodromy`` a neighbour, which deviates by (dx, dv) just before
the contact of the orbit, is on its flight before continued until it is in contact, sigma later, and
then on its flight after, back to that time.  With the accelerations a(t) = (F cos wt - s f)/m let

    A(sigma) = a sigma + a' sigma^2/2 + a'' sigma^3/6,  Q(sigma) = a sigma^2/2 + a' sigma^3/6,

what it adds to velocity and place, up to sigma^3.  sigma is the zero without constant term of

    n.(dx + (v + dv) sigma + Q-(sigma)) = 0,

found by iterating sigma = -n.(dx + dv sigma + Q-(sigma))/(n.v): each step gains a degree.  Then

    v+ + dv+ = C (v + dv + A-) - A+,      dx+ = dx + (v + dv) sigma + Q- - (v+ + dv+) sigma - Q+.

All are jets in the deviations at t = 0; a flight is linear: dx -> dx + d dv.

*Complex coordinates.*  With e_j of ``monodromy``, a deviation is the sum of w_j e_j + w_j^- e_j^-,
and w_j = Omega(., e_j^-)/i.  Then Omega = i sum dw_j ^ dw_j^-, and Phi is

    w_j -> f_j(w, w^-) = lambda_j w_j + terms of degree 2 and 3.

*The normal form.*  Let psi = w + psi_2 + psi_3 + ... with psi o f = N o psi.  A monomial w^m, m in
(N^4), becomes Lambda^m w^m under the linear part, Lambda = (lambda_1, lambda_2, and conjugates).
Without resonance of order 3, at degree 2

    psi_(j, m) = f_(j, m)/(lambda_j - Lambda^m),  |m| = 2,

removes all terms; at degree 3 N_j = f_j + [psi_(j, 2) o f] has, without resonance of order 4, to
keep the terms w_j |w_k|^2 only, and psi_3 does not touch these.  Omega is kept, so N_j = lambda_j
w_j exp(i sum_k B_jk |w_k|^2) to this order, B real and symmetric: i lambda_j B_jk is the
coefficient of w_j |w_k|^2.  (psi_2 is unique: it is the one of a symplectic normalisation.)
"""

from __future__ import annotations

from collections.abc import Sequence

from cap.checker.kernel.complex import Complex
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, Power, RealJet
from cap.checker.kernel.rejection import need
from cap.checker.kernel.substitution import substituted
from cap.checker.particles.existence import Matrix
from cap.checker.particles.mechanics import NORMALS, Contact, Instant, Mechanics, sign
from cap.checker.particles.monodromy import Plane

ORDER = 3
UNITS = [tuple(int(i == j) for j in range(4)) for i in range(4)]
ComplexJet = Jet[Complex]


def third_order(M: Mechanics, orbit: Sequence[Contact]) -> list[RealJet]:
    """Return x_1, x_2, v_1, v_2 at the time T as jets in these at t = 0, both as deviations."""
    z = [Jet(ORDER, {unit: M.number(1)}) for unit in UNITS]
    z = flown(z, orbit[0].at.t)
    for contact, end in zip(orbit, [*(c.at.t for c in orbit[1:]), M.period], strict=True):
        z = flown(passed(M, contact, z), end - contact.at.t)
    return z


def flown(z: Sequence[RealJet], d: Interval) -> list[RealJet]:
    """Return the deviations after a time d."""
    x1, x2, v1, v2 = z
    return [x1 + v1 * d, x2 + v2 * d, v1, v2]


def passed(M: Mechanics, contact: Contact, z: Sequence[RealJet]) -> list[RealJet]:
    """Return the deviations after a contact from those before, at its time."""
    dx, dv, v = z[:2], z[2:], contact.v
    before, after = [sign(u) for u in v], M.flight(contact)
    n, closing = NORMALS[contact.word], M.closing(contact)
    sigma = Jet[Interval](ORDER, {})
    for _ in range(ORDER):
        _, Q = added(M, before, contact.at, sigma)
        moved = [dx[i] + dv[i] * sigma + Q[i] for i in (0, 1)]
        sigma = (moved[0] * n[0] + moved[1] * n[1]) * (-M.number(1) / closing)
    A, Q = added(M, before, contact.at, sigma)
    back, Q_back = added(M, after.signs, contact.at, sigma)
    u = [dv[i] + A[i] for i in (0, 1)]
    u = [u[0] * c + u[1] * d - back[i] for i, (c, d) in enumerate(M.rule(contact.word))]
    jumps = [v[i] - after.v[i] for i in (0, 1)]
    x = [dx[i] + sigma * jumps[i] + (dv[i] - u[i]) * sigma + Q[i] - Q_back[i] for i in (0, 1)]
    return x + u


def added(
    M: Mechanics, signs: Sequence[int], at: Instant, sigma: RealJet
) -> tuple[list[RealJet], list[RealJet]]:
    """Return A and Q of both masses."""
    square = sigma * sigma
    cube = square * sigma
    A, Q = list[RealJet](), list[RealJet]()
    for i, m in enumerate(M.m):
        a = M.acceleration(i, signs[i], at)
        slope = -(M.F * M.omega * at.sin) / m
        bend = -(M.F * M.omega.square() * at.cos) / m
        A.append(sigma * a + square * (slope / 2) + cube * (bend / 6))
        Q.append(square * (a / 2) + cube * (slope / 6))
    return A, Q


# complex coordinates


def in_complex_coordinates(
    M: Mechanics, z: Sequence[RealJet], planes: Sequence[Plane]
) -> list[ComplexJet]:
    """Return f_1 and f_2 as jets in w_1, w_2, w_1^-, w_2^-, with their linear parts exact."""
    zero = M.number(0)
    columns = [plane.e for plane in planes]
    columns += [[c.conjugate() for c in e] for e in columns]
    start = [Jet(ORDER, {u: e[i] for u, e in zip(UNITS, columns, strict=True)}) for i in range(4)]
    result = list[ComplexJet]()
    for unit, plane in zip(UNITS, planes, strict=False):
        total = Jet[Complex](ORDER, {})
        for row, jet in zip(coordinate(M, plane.e), z, strict=True):
            curved = {p: Complex(c, zero) for p, c in jet.coefficients.items() if sum(p) > 1}
            total = total + Jet(ORDER, curved) * row
        result.append(substituted(total, start) + Jet(ORDER, {unit: plane.multiplier}))
    return result


def coordinate(M: Mechanics, e: Sequence[Complex]) -> list[Complex]:
    """Return the row of the linear form Omega(., e^-)/i."""
    # Omega(u, e^-) = sum m_i (u_(v_i) x_i(e^-) - u_(x_i) v_i(e^-));  1/i = -i
    x, v = ([_over_i(c.conjugate()) for c in part] for part in (e[:2], e[2:]))
    return [_scaled(-c, m) for c, m in zip(v, M.m, strict=True)] + [
        _scaled(c, m) for c, m in zip(x, M.m, strict=True)
    ]


def _over_i(c: Complex) -> Complex:
    """Return c/i."""
    return Complex(c.im, -c.re)


def _scaled(c: Complex, m: Interval) -> Complex:
    """Return c m."""
    return Complex(c.re * m, c.im * m)


# the normal form


def twist_matrix(f: Sequence[ComplexJet]) -> Matrix:
    """Return B; a resonance of order at most 4, or a part that must be zero and is not, rejects."""
    multipliers = [f[j].coefficients[UNITS[j]] for j in (0, 1)]
    arguments = [*f, *map(conjugate, f)]
    B = [_row(j, f[j], multipliers, arguments) for j in (0, 1)]
    B[0][1] = B[1][0] = B[0][1].intersection(B[1][0])
    return B


def _row(
    j: int, f: ComplexJet, multipliers: Sequence[Complex], arguments: Sequence[ComplexJet]
) -> list[Interval]:
    """Return B_j1 and B_j2."""
    own = multipliers[j]
    terms = {p: c for p, c in f.coefficients.items() if sum(p) == 2}
    psi = Jet(ORDER, {p: c / (own - _power(multipliers, p)) for p, c in terms.items()})
    N = (f + substituted(psi, arguments)).coefficients
    row = list[Interval]()
    for k in (0, 1):
        power = tuple((i == j) + (i % 2 == k) for i in range(4))
        b = _over_i(N[power] / own)
        need(b.im.contains_zero(), "an entry of the twist matrix is not real")
        row.append(b.re)
    return row


def conjugate(jet: ComplexJet) -> ComplexJet:
    """Return the conjugate of a jet in w_1, w_2, w_1^-, w_2^-."""
    turned: dict[Power, Complex] = {
        (*p[2:], *p[:2]): c.conjugate() for p, c in jet.coefficients.items()
    }
    return Jet(jet.order, turned)


def _power(multipliers: Sequence[Complex], p: Sequence[int]) -> Complex:
    """Return Lambda^p."""
    one = multipliers[0].re.integer(1)
    result = Complex(one, one.integer(0))
    for multiplier, times in zip(
        [*multipliers, *(c.conjugate() for c in multipliers)], p, strict=True
    ):
        for _ in range(times):
            result = result * multiplier
    return result
