"""How long orbits stay in an ellipse: by a polynomial that the map hardly changes.

Let Phi be a map of R^n, n even, with a fixed point P*, continuous and injective on E = {c + A u :
|u| <= 1}, where A is regular, and let P* lie in E' = {c + A u : |u| <= kappa}, kappa < 1.  Let H be
a polynomial in u, and

    H <= inner on E',    H >= outer on the boundary of E,    |H o Phi - H| <= D on E.

*Lemma.*  If inner + N D < outer, then Phi^n(E') lies in E for all integers |n| <= N.

Proof.  Let W_n be the component of P* in {z in int E : H(z) <= inner + n D}.  W_0 contains E',
which is connected.  Let n < N.  Phi(W_n) is connected, contains P*, and has H <= inner + (n+1) D <
outer there; so it does not meet the boundary of E, and lies in W_(n+1).  The set Phi(int E) is open
(invariance of domain), its boundary lies in Phi(boundary of E), where H >= outer - D > inner + n D;
so W_n does not meet it, and as it is connected and contains P* it lies in Phi(int E).  Its preimage
in int E is connected, contains P*, and has H <= inner + (n+1) D: it lies in W_(n+1).

*The change of H.*  Let G = H o Phi - H as a function of z, and n the order of the jets over a box
around E, which is convex, with centre c.  By Taylor's formula, with xi in the box,

    G(c + dz) = sum over k < n of G_k(c)(dz) + G_n(xi)(dz),       dz = A u.

*A homogeneous polynomial* of degree k in u is, with zeta_1 = u_1 + i u_2, zeta_2 = u_3 + i u_4, ..,
a sum of monomials in these and their conjugates.  One of degree k_j in zeta_j and its conjugate has
the modulus prod |zeta_j|^k_j; where sum |zeta_j|^2 = |u|^2 <= kappa^2 this is at most kappa^k times
the root of prod k_j^k_j / k^k.  A form a u_1 + b u_2 is (a - ib)/2 zeta + (a + ib)/2 zeta^-.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import prod

from cap.checker.kernel.complex import Complex
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, Power, RealJet, lift
from cap.checker.kernel.rejection import need
from cap.checker.kernel.substitution import substituted

Rows = Sequence[Sequence[Fraction]]
Polynomial = Mapping[Power, Fraction]


def eliminated(axes: Rows) -> tuple[Fraction, Rows]:
    """Return det A and A^-1, by Gauss's elimination; A must be regular."""
    n, det = len(axes), Fraction(1)
    rows = [[*row, *(Fraction(int(i == j)) for j in range(n))] for i, row in enumerate(axes)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        need(pivot is not None, "the axes do not span the space")
        p = pivot or k
        if p != k:
            rows[k], rows[p], det = rows[p], rows[k], -det
        det *= rows[k][k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [a - rows[i][k] * b for a, b in zip(rows[i], rows[k], strict=True)]
    return det, [row[n:] for row in rows]


def half_widths(axes: Rows, bits: int) -> list[Interval]:
    """Return the half-widths of the least box around E: the norms of the rows of A."""
    squares = (sum(entry**2 for entry in row) for row in axes)
    return [Interval.enclosing(q, q, bits).sqrt() for q in squares]


def coordinate(
    row: Sequence[Fraction], z: Sequence[RealJet], centre: Sequence[Fraction]
) -> RealJet:
    """Return the entry of A^-1 (z - c) that a row of A^-1 gives."""
    bits = z[0].constant.bits
    total = Jet(z[0].order, {z[0].origin: z[0].constant.integer(0)})
    for entry, w, c in zip(row, z, centre, strict=True):
        shift = Jet(w.order, {w.origin: Interval.enclosing(c, c, bits)})
        total = total + (w - shift) * Interval.enclosing(entry, entry, bits)
    return total


def value(H: Polynomial, u: Sequence[RealJet]) -> RealJet:
    """Return H(u) by Horner's rule in u_1, its coefficients polynomials in the other variables."""
    first, *others = u
    zero = Jet(first.order, {first.origin: first.constant.integer(0)})
    total, bits = zero, first.constant.bits
    for k in range(max((p[0] for p in H), default=0), -1, -1):
        rest = {p[1:]: c for p, c in H.items() if p[0] == k}
        total = total * first
        if others and rest:
            total = total + value(rest, others)
        for c in () if others else rest.values():
            total = total + Jet(zero.order, {first.origin: Interval.enclosing(c, c, bits)})
    return total


def change(H: Polynomial, axes: Rows, centre: Sequence[Fraction], z: Sequence[Centred]) -> Centred:
    """Return H o Phi - H over a box, from the coordinates and their images under Phi."""
    rows, n = eliminated(axes)[1], len(axes)

    def formula(*jets: RealJet) -> RealJet:
        before, after = ([coordinate(row, q, centre) for row in rows] for q in (jets[:n], jets[n:]))
        return value(H, after) - value(H, before)

    return lift(formula, *z)


def terms(jet: RealJet, degree: int) -> RealJet:
    """Return the terms of one degree."""
    return Jet(degree, {p: c for p, c in jet.coefficients.items() if sum(p) == degree})


def size(homogeneous: RealJet, axes: Rows, zero: Interval) -> Interval:
    """Return a bound of a homogeneous polynomial in dz at dz = A u, |u| <= 1."""
    forms = [_form(row, homogeneous.order, zero) for row in axes]
    total = zero
    terms = {power: Complex(c, zero) for power, c in homogeneous.coefficients.items()}
    for power, c in substituted(Jet(homogeneous.order, terms), forms).coefficients.items():
        k = [sum(power[j : j + 2]) for j in range(0, len(power), 2)]
        most = Fraction(prod(d**d for d in k), sum(k) ** sum(k))
        square = (c.re.square() + c.im.square()) * Interval.enclosing(most, most, zero.bits)
        total = total + square.sqrt()
    return total


def _form(row: Sequence[Fraction], order: int, zero: Interval) -> Jet[Complex]:
    """Return the sum of a u_1 + b u_2, .. as a polynomial in the zeta_j and their conjugates."""
    form = dict[Power, Complex]()
    for j in range(0, len(row), 2):
        a, b = (Interval.enclosing(entry / 2, entry / 2, zero.bits) for entry in row[j : j + 2])
        for k, c in ((j, Complex(a, -b)), (j + 1, Complex(a, b))):
            form[tuple(int(i == k) for i in range(len(row)))] = c
    return Jet(order, form)


def drift(G: Centred, axes: Rows) -> Interval:
    """Return a bound of |G| on E, from its jets at c and over a box around E."""
    zero, n = G.value.integer(0), G.box.order
    need(G.centre.order >= n - 1, "the jets at the centre are too short")
    total = G.centre.constant.magnitude()
    for k in range(1, n):
        total = total + size(terms(G.centre, k), axes, zero)
    return total + size(terms(G.box, n), axes, zero)


def excess(H: Polynomial, kappa: Fraction, bits: int) -> Interval:
    """Return a bound of |H - |u|^2| for |u| <= kappa."""
    n = len(next(iter(H)))
    unit = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    rest = {tuple(2 * int(i == j) for j in range(n)): Fraction(-1) for i in range(n)}
    for power, c in H.items():
        rest[power] = rest.get(power, Fraction(0)) + c
    total = zero = Interval.enclosing(0, 0, bits)
    for degree in {sum(power) for power in rest}:
        part = {p: Interval.enclosing(c, c, bits) for p, c in rest.items() if sum(p) == degree}
        scale = Interval.enclosing(kappa**degree, kappa**degree, bits)
        total = total + size(Jet(degree, part), unit, zero) * scale
    return total
