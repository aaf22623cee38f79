"""The derivative of the time-T map at a periodic orbit, in the order (x_1, x_2, v_1, v_2).

*A flight* of the duration d is a shear, since the forces do not depend on the state:

    E = ((1, d 1), (0, 1)).

*A contact.*  A neighbour that deviates by dx just before is in contact later by sigma = -n.dx/n.v.
Compare it at the time of the contact itself, on its flight before and its flight after, continued:

    dx+ = dx + (v - C v) sigma = C dx,            dv+ = C dv + (C a- - a+) sigma,
    S = ((C, 0), (K, C)),      K = (a+ - C a-) n^T/(n.v),

a+- the accelerations, v = v- the velocity before: v - C v = 2 (n.v) M^-1 n/(n^T M^-1 n).

*The form* Omega = sum m_i dv_i ^ dx_i.  E and hits keep it.  As C^T M C = M and C^2 = 1, a
collision keeps it if C^T M K is symmetric, that is, if M (C a+ - a-) = C^T M a+ - M a- is parallel
to n.  C^T = 1 up to multiples of n; M (a+ - a-) = -f (s+ - s-): so if s_1 + s_2 is kept.

*Multipliers.*  So the characteristic polynomial is z^4 - a z^3 + b z^2 - a z + 1, a = tr D, b =
(a^2 - tr D^2)/2, and the reduced traces z = lambda + 1/lambda are (a +- sqrt(a^2 - 4 b + 8))/2.

*Rotation.*  Let z, z' be different, |z| < 2, p a vector of the image of D^2 - z' D + 1: there D^2 -
z D + 1 = 0.  For lambda = z/2 + i s, |lambda| = 1, e = D p - lambda^- p satisfies D e = lambda e,
and

    Omega(e, e^-) = -lambda Omega(D p, p) - lambda^- Omega(p, D p) = 2 i s Omega(p, D p):

so we choose s with the sign of Omega(p, D p), and divide e by the root of 2 s Omega(p, D p): then
Omega(e, e^-) = i.  For the other pair Omega(e, e') = Omega(e, e'^-) = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.complex import Complex
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.existence import Matrix, dot
from cap.checker.particles.mechanics import NORMALS, Contact, Mechanics, sign

Vector = list[Interval]


class Plane(NamedTuple):
    """A rotation of an invariant plane: lambda, theta in (0, 1), and e with Omega(e, e^-) = i."""

    multiplier: Complex
    theta: Interval
    e: list[Complex]


def monodromy(M: Mechanics, orbit: Sequence[Contact]) -> Matrix:
    """Return D, from t = 0 to T."""
    D = shear(M, orbit[0].at.t)
    for contact, end in zip(orbit, [*(c.at.t for c in orbit[1:]), M.period], strict=True):
        D = product(shear(M, end - contact.at.t), product(saltation(M, contact), D))
    return D


def shear(M: Mechanics, d: Interval) -> Matrix:
    """Return E."""
    rows = [[M.number(int(i == j)) for j in range(4)] for i in range(4)]
    rows[0][2] = rows[1][3] = d
    return rows


def saltation(M: Mechanics, contact: Contact) -> Matrix:
    """Return S."""
    C, n, closing = M.rule(contact.word), NORMALS[contact.word], M.closing(contact)
    zero, after = M.number(0), M.flight(contact).signs
    a = [M.acceleration(i, sign(contact.v[i]), contact.at) for i in (0, 1)]
    reflected = [row[0] * a[0] + row[1] * a[1] for row in C]
    jumps = [(M.acceleration(i, after[i], contact.at) - reflected[i]) / closing for i in (0, 1)]
    K = [[jump * n[0], jump * n[1]] for jump in jumps]
    return [[*row, zero, zero] for row in C] + [k + row for k, row in zip(K, C, strict=True)]


def product(A: Matrix, B: Matrix) -> Matrix:
    """Return the product of two matrices."""
    columns = list(zip(*B, strict=True))
    return [[dot(row, column) for column in columns] for row in A]


def form(M: Mechanics, u: Sequence[Interval], w: Sequence[Interval]) -> Interval:
    """Return Omega(u, w)."""
    parts = [m * (u[i + 2] * w[i] - u[i] * w[i + 2]) for i, m in enumerate(M.m)]
    return parts[0] + parts[1]


def symplectic(M: Mechanics, D: Matrix) -> None:
    """Check that the enclosures agree with the theorem: D keeps Omega."""
    columns = [list(column) for column in zip(*D, strict=True)]
    units = shear(M, M.number(0))
    for j in range(4):
        for k in range(4):
            defect = form(M, columns[j], columns[k]) - form(M, units[j], units[k])
            need(defect.contains_zero(), "the monodromy does not keep the symplectic form")


def reduced_traces(D: Matrix) -> list[Interval]:
    """Return z_1 > z_2."""
    a, square = trace(D), trace(product(D, D))
    b = (a.square() - square) / 2
    discriminant = a.square() - b * 4 + 8
    need(discriminant.is_positive(), "the two pairs of multipliers may coincide, or be complex")
    root = discriminant.sqrt()
    return [(a + root) / 2, (a - root) / 2]


def trace(A: Matrix) -> Interval:
    """Return the trace."""
    return A[0][0] + A[1][1] + A[2][2] + A[3][3]


def rotation(M: Mechanics, D: Matrix, z: Interval, other: Interval) -> Plane:
    """Return the rotation of the pair with the reduced trace z in (-2, 2)."""
    vectors = image(D, other)
    areas = [turned(M, D, p) for p in vectors]
    best = max(range(4), key=lambda n: abs(areas[n].lo + areas[n].hi))
    return plane(M, D, z, vectors[best])


def plane(M: Mechanics, D: Matrix, z: Interval, p: Vector) -> Plane:
    """Return the rotation of the plane in which p lies, and in which D^2 - z D + 1 = 0."""
    s = (-(z / 2).square() + 1).sqrt()
    angle, area = arccos(z / 2) / M.two_pi, turned(M, D, p)
    need(not area.contains_zero(), "the sign of a rotation is not certain")
    if not area.is_positive():
        s, angle = -s, -angle + 1
    scale = (s * area * 2).sqrt()
    image = [dot(row, p) for row in D]
    # e = D p - (z/2 - i s) p
    e = [Complex((b - z / 2 * a) / scale, s * a / scale) for a, b in zip(p, image, strict=True)]
    return Plane(Complex(z / 2, s), angle, e)


def image(D: Matrix, z: Interval) -> list[Vector]:
    """Return the columns of D^2 - z D + 1."""
    square = product(D, D)
    rows = [[square[i][j] - z * D[i][j] for j in range(4)] for i in range(4)]
    for i in range(4):
        rows[i][i] = rows[i][i] + 1
    return [list(column) for column in zip(*rows, strict=True)]


def turned(M: Mechanics, D: Matrix, p: Vector) -> Interval:
    """Return Omega(p, D p)."""
    return form(M, p, [dot(row, p) for row in D])
