"""Section 5.1: Birkhoff normal form and twist."""

from fractions import Fraction

from cap.audit.means.algebra import same, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need

RESONANT = Fraction(1, 5)


def kept(degree: int, rotation: Fraction) -> list[tuple[int, int]]:
    """Return the monomials z^a z̄^b of a degree that no change of coordinates removes.

    They are those with (a - b - 1) θ in 2πZ, θ = 2π ``rotation``.
    """
    pairs = [(a, degree - a) for a in range(degree + 1)]
    return [(a, b) for a, b in pairs if ((a - b - 1) * rotation).denominator == 1]


def remainder_of_the_normal_form() -> None:
    need(all((k * RESONANT).denominator > 1 for k in range(1, 5)), "1/5 is a resonance of order 4")
    need(kept(4, RESONANT) == [(0, 4)], "z̄⁴ can be removed", kept=kept(4, RESONANT))
    need(kept(2, RESONANT) == [] and kept(3, RESONANT) == [(2, 1)], "lower orders differ")
    z, w = sp.symbols("z w")  # w = z̄; time-one map of Re z⁵, a Hamiltonian of degree 5
    H = (z**5 + w**5) / 2
    need(same(sp.diff(H, w), sp.Rational(5, 2) * w**4), "the Hamiltonian gives another term")


def roles_of_the_resonances() -> None:
    third, quarter = Fraction(1, 3), Fraction(1, 4)
    need(kept(2, third) == [(0, 2)], "k = 3 is not about z̄²", kept=kept(2, third))
    need(kept(3, quarter) == [(0, 3), (2, 1)], "k = 4 is not about z̄³", kept=kept(3, quarter))


def resonances_of_order_four() -> None:
    found = sorted({Fraction(p, k) for k in range(1, 5) for p in range(k)} - {Fraction(0)})
    stated = [Fraction(q) for q in ("1/4", "1/3", "1/2", "2/3", "3/4")]
    need(found == stated, "the list is another", found=found)


def remainder_in_action() -> None:
    fifth, sixth = Fraction(1, 5), Fraction(1, 6)
    need(kept(4, fifth) == [(0, 4)], "order 5 has no part in degree 4")
    need((0, 5) in kept(5, sixth), "order 6 has no part in degree 5")
    need(all((k * q).denominator > 1 for k in range(1, 5) for q in (fifth, sixth)), "order 4")
    r, eps = symbols("r epsilon")  # a remainder of degree 4 in z, |z| = r
    change = sp.expand((r + eps * r**4) ** 2 / 2 - r**2 / 2)
    need(sp.Poly(change, r).monoms()[-1] == (5,), "I changes at another order")
