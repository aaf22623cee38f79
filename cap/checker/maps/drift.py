"""How long orbits stay in an ellipse: by a polynomial that the map hardly changes.

Let Phi be a map with a fixed point P*, continuous and injective on E = {c + A u : |u| <= 1}, where
A is regular, and let P* lie in E' = {c + A u : |u| <= kappa}, kappa < 1.  Let H be a polynomial in
u, and

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

*A homogeneous polynomial* of degree k in u is, with zeta = u_1 + i u_2, a sum of a_jl zeta^j
zeta^-^l, j + l = k: on |u| <= kappa it is at most kappa^k times the sum of |a_jl|.  A form a u_1 +
b u_2 is (a - ib)/2 zeta + (a + ib)/2 zeta^-.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.complex import Complex
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, Power, RealJet, lift
from cap.checker.kernel.rejection import need
from cap.checker.kernel.substitution import powers, substituted
from cap.checker.maps.normal_form import complexified

Rows = Sequence[Sequence[Fraction]]
Integral = Sequence[Sequence[Fraction]]
"""H: for each degree n = 1, 2, .. the coefficients of u_1^(n-j) u_2^j, j = 0 .. n."""

UNIT = ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(1)))


def determinant(axes: Rows) -> Fraction:
    """Return det A."""
    (a, b), (c, d) = axes
    return a * d - b * c


def inverse(axes: Rows) -> Rows:
    """Return A^-1 of a regular A."""
    (a, b), (c, d) = axes
    det = determinant(axes)
    return ((d / det, -b / det), (-c / det, a / det))


def half_widths(axes: Rows, bits: int) -> list[Interval]:
    """Return the half-widths of the least rectangle around E: the norms of the rows of A."""
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


def value(H: Integral, u: Sequence[RealJet]) -> RealJet:
    """Return H(u), by Horner's rule in u_1, its coefficients polynomials in u_2."""
    degree, (first, second) = len(H), u
    zero, bits = first.constant.integer(0), first.constant.bits
    known = [Jet(first.order, {first.origin: zero + 1}), *powers(second, degree)]
    total = Jet(first.order, {first.origin: zero})
    for i in range(degree, -1, -1):
        total = total * first
        for j in range(int(i == 0), degree - i + 1):
            c = H[i + j - 1][j]
            total = total + known[j] * Interval.enclosing(c, c, bits)
    return total


def change(H: Integral, axes: Rows, centre: Sequence[Fraction], z: Sequence[Centred]) -> Centred:
    """Return H o Phi - H over a box, from x, v and their images under Phi."""
    rows = inverse(axes)

    def formula(*jets: RealJet) -> RealJet:
        before, after = ([coordinate(row, q, centre) for row in rows] for q in (jets[:2], jets[2:]))
        return value(H, after) - value(H, before)

    return lift(formula, *z)


def terms(jet: RealJet, degree: int) -> RealJet:
    """Return the terms of one degree."""
    return Jet(degree, {p: c for p, c in jet.coefficients.items() if sum(p) == degree})


def size(homogeneous: RealJet, axes: Rows, zero: Interval) -> Interval:
    """Return a bound of a homogeneous polynomial in dz at dz = A u, |u| <= 1."""
    forms = [_form(row, homogeneous.order, zero) for row in axes]
    total = zero
    for c in substituted(complexified(homogeneous), forms).coefficients.values():
        total = total + (c.re.square() + c.im.square()).sqrt()
    return total


def _form(row: Sequence[Fraction], order: int, zero: Interval) -> Jet[Complex]:
    """Return a u_1 + b u_2 as a polynomial in zeta and zeta^-."""
    a, b = (Interval.enclosing(entry / 2, entry / 2, zero.bits) for entry in row)
    return Jet(order, {(1, 0): Complex(a, -b), (0, 1): Complex(a, b)})


def drift(G: Centred, axes: Rows) -> Interval:
    """Return a bound of |G| on E, from its jets at c and over a box around E."""
    zero, n = G.value.integer(0), G.box.order
    need(G.centre.order >= n - 1, "the jets at the centre are too short")
    total = G.centre.constant.magnitude()
    for k in range(1, n):
        total = total + size(terms(G.centre, k), axes, zero)
    return total + size(terms(G.box, n), axes, zero)


def excess(H: Integral, kappa: Fraction, bits: int) -> Interval:
    """Return a bound of |H - |u|^2| for |u| <= kappa."""
    total = zero = Interval.enclosing(0, 0, bits)
    for n, row in enumerate(H, start=1):
        square = {0: 1, 2: 1} if n == 2 else {}
        rest = (c - square.get(j, 0) for j, c in enumerate(row))
        jet: dict[Power, Interval] = {
            (n - j, j): Interval.enclosing(c, c, bits) for j, c in enumerate(rest)
        }
        scale = Interval.enclosing(kappa**n, kappa**n, bits)
        total = total + size(Jet(n, jet), UNIT, zero) * scale
    return total
