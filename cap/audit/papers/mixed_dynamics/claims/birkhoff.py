"""Section 5.1: Birkhoff normal form and twist."""

from dataclasses import replace
from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import enclosure, formula, same, symbols
from cap.audit.means.balls import between, inner, number, pair, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Strength, Verdict, confirmed, corrected, imprecise, refuted
from cap.sets import interval

RESONANT = Fraction(1, 5)


def kept(degree: int, rotation: Fraction) -> list[tuple[int, int]]:
    """Return the monomials z^a z̄^b of a degree that no change of coordinates removes.

    They are those with (a - b - 1) θ in 2πZ, θ = 2π ``rotation``.
    """
    pairs = [(a, degree - a) for a in range(degree + 1)]
    return [(a, b) for a, b in pairs if ((a - b - 1) * rotation).denominator == 1]


@claim("eq:BNF", Kind.THEOREM, stated="R = O(|z|⁵) if kθ* is not in 2πZ for k <= 4")
def remainder_of_the_normal_form() -> Verdict:
    """Without resonances of order up to 4, Ψ(z) = exp(i(θ* + τ₁|z|²)) z + O(|z|⁵)."""
    need(all((k * RESONANT).denominator > 1 for k in range(1, 5)), "1/5 is a resonance of order 4")
    need(kept(4, RESONANT) == [(0, 4)], "z̄⁴ can be removed", kept=kept(4, RESONANT))
    need(kept(2, RESONANT) == [] and kept(3, RESONANT) == [(2, 1)], "lower orders differ")
    z, w = sp.symbols("z w")  # w = z̄; time-one map of Re z⁵, a Hamiltonian of degree 5
    H = (z**5 + w**5) / 2
    need(same(sp.diff(H, w), sp.Rational(5, 2) * w**4), "the Hamiltonian gives another term")
    return corrected(
        "O(|z|⁴) is what these hypotheses give; O(|z|⁵) needs 5θ* not in 2πZ too. Counterexample: "
        "the rotation by 2π/5 after the time-one map of the Hamiltonian Re z⁵",
        "The term z̄⁴ belongs to the kernel of the homological operator iff 5θ* is in 2πZ, and "
        "this area-preserving map has it, and nothing of degree 2 or 3.",
        proof="kam.md#the-order-of-the-remainder",
    )


@claim("eq:birkhoff-nonres", Kind.STEP, stated="k = 3 rules out degree three, k = 4 degree four")
def roles_of_the_resonances() -> Verdict:
    """The resonances at k = 3 rule out degree-three terms, those at k = 4 off-diagonal degree-four
    terms, and only radial monomials remain through degree four.
    """
    third, quarter = Fraction(1, 3), Fraction(1, 4)
    need(kept(2, third) == [(0, 2)], "k = 3 is not about z̄²", kept=kept(2, third))
    need(kept(3, quarter) == [(0, 3), (2, 1)], "k = 4 is not about z̄³", kept=kept(3, quarter))
    return confirmed(
        "true for the generating function: k = 3 is about its terms of degree 3 (z̄² of the map), "
        "k = 4 about those of degree 4 (z̄³ of the map)",
        "All monomials of the map that a resonance keeps, listed.",
    )


@claim("remark 5.8", Kind.NUMBER, stated="π/2, 2π/3, π, 4π/3, 3π/2")
def resonances_of_order_four() -> Verdict:
    """The order-four resonances are θ* in {π/2, 2π/3, π, 4π/3, 3π/2}."""
    found = sorted({Fraction(p, k) for k in range(1, 5) for p in range(k)} - {Fraction(0)})
    stated = [Fraction(q) for q in ("1/4", "1/3", "1/2", "2/3", "3/4")]
    need(found == stated, "the list is another", found=found)
    return confirmed(
        "these, and 0, which ellipticity excludes", "All p/k with k <= 4, in units of 2π."
    )


@claim("eq:kam-bnf", Kind.FORMULA, stated="φ + θ* + τ₁ I with z = sqrt(2I) e^(iφ)")
def twist_per_action() -> Verdict:
    """With z = sqrt(2I) exp(iφ) the normal form eq:BNF turns φ by θ* + τ₁ I + .."""
    action, tau = symbols("I tau")
    z = sp.sqrt(2 * action)
    return formula(
        tau * z**2,
        tau * action,
        "|z|² = 2I. The two displays use τ₁ for two numbers that differ by the factor 2.",
        "θ* + 2τ₁ I, τ₁ of eq:BNF",
    )


@claim("eq:kam-bnf", Kind.THEOREM, stated="remainders O(I^(5/2)), with τ₂")
def remainder_in_action() -> Verdict:
    """I and φ change by I-dependent terms up to τ₂I² with remainders O(I^(5/2)), by (H5)."""
    fifth, sixth = Fraction(1, 5), Fraction(1, 6)
    need(kept(4, fifth) == [(0, 4)], "order 5 has no part in degree 4")
    need((0, 5) in kept(5, sixth), "order 6 has no part in degree 5")
    need(all((k * q).denominator > 1 for k in range(1, 5) for q in (fifth, sixth)), "order 4")
    r, eps = symbols("r epsilon")  # a remainder of degree 4 in z, |z| = r
    change = sp.expand((r + eps * r**4) ** 2 / 2 - r**2 / 2)
    need(sp.Poly(change, r).monoms()[-1] == (5,), "I changes at another order")
    return corrected(
        "with resonances up to order 4 excluded: I changes by O(I^(5/2)), φ by θ* + 2τ₁I + "
        "O(I^(3/2)). A term τ₂I² and remainders O(I^(5/2)) in φ need orders 5 and 6 excluded too",
        "At 1/5 and 1/6 the terms z̄⁴ and z̄⁵ stay. A remainder of degree 4 in z changes I = "
        "|z|²/2 by degree 5, angles by degree 3.",
        proof="kam.md#the-order-of-the-remainder",
    )


@claim("prop:twist-nondeg", Kind.NUMBER, stated="τ₁ ≈ -0.42")
def value_of_the_twist() -> Verdict:
    """At P* the first twist coefficient is τ₁ ≈ -0.42."""
    claims = stored("elliptic.json").claims
    twist, per_action, angle = (claims[n] for n in ("twist", "twist_action", "rotation_angle"))
    need(twist.lower > 0 and angle.lower > 0, "the sign may be negative")
    need(per_action.upper < Fraction(42, 100), "it may be 0.42")
    return refuted(
        f"τ₁ in {pair(twist, 9)} per |z|², in {pair(per_action, 9)} per action, dx ∧ dv = (i/2) dz "
        "∧ dz̄, where θ* > 0: the other sign, in every normalisation with θ* in (0, π)",
        "Stored certificate: jets of Φ at P*, normal form, in two arithmetics. Reversing the "
        "orientation changes the signs of θ* and τ₁ together.",
        certificate="elliptic.json",
    )


@claim("prop:twist-nondeg", Kind.WORDS, stated="well separated from zero")
def separated_from_zero() -> Verdict:
    """The twist is well separated from zero at f = 0.4."""
    zeros = stored("branch.json").claims["twist_zeros"]
    near = min(zeros, key=lambda each: abs(each.lower - Fraction(2, 5)))
    gap = near.upper - Fraction(2, 5)
    need(0 < gap < Fraction(1, 30000), "no zero is near", gap=float(gap))
    return refuted(
        f"τ₁ = 0 at an f in {pair(near, 9)}: f = 0.4 is within 3·10⁻⁵ of a zero of the twist",
        "Stored certificate of the whole branch.",
        certificate="branch.json",
    )


@claim("prop:twist-nondeg", Kind.STEP, stated="Taylor coefficients of Φ to order four")
def order_needed_for_the_twist() -> Verdict:
    """The twist is computed from the Taylor coefficients of Φ to order four."""
    lam, a, b, c, g = sp.symbols("lam a b c g")
    # z -> lam (z + a z² + b z z̄ + c z̄² + g z² z̄ + ..): removing degree 2 changes z² z̄ only by
    # products of a, b, c; degree 4 of the map enters degree 4 and higher.
    z, w, fourth = sp.symbols("z w fourth")
    f = lam * (z + a * z**2 + b * z * w + c * w**2 + g * z**2 * w + fourth * z**4)
    change = z + a * z**2
    composed = sp.expand(f.subs(z, change))
    poly = sp.Poly(composed, z, w)
    low = [co for (i, j), co in poly.terms() if i + j <= 3]
    need(all(fourth not in co.free_symbols for co in low), "degree 4 enters the cubic terms")
    return corrected(
        "order three is enough: τ₁ is a function of the 3-jet of Φ (of the terms of degree four of "
        "a generating function)",
        "A quadratic change of coordinates leaves the terms of degree <= 3 free of those of degree "
        "4; the certificate computes τ₁ from a jet of order 3.",
    )


@claim("prop:twist-nondeg", Kind.STEP, stated="Φ at the orbit is analytic on all of Π")
def analytic_family() -> Verdict:
    """The elliptic orbit of the family is that of Theorem 4.2, which is analytic in the parameters
    on the connected set f_sc < f < f_imp, so τ₁ is.
    """
    pitchfork = stored("pitchfork.json").claims["f"]
    end = stored("branch.json").claims["f_end"]
    need(end.upper < Fraction(2, 5) < pitchfork.lower, "f = 0.4 is not on the branch of pairs")
    return refuted(
        "no orbit belongs to those formulas; P* belongs to the asymmetric pair, which at F = ω = "
        f"1, R = 2 exists for f between {pair(end, 6)} and {pair(pitchfork, 6)} only, not on "
        "(f_sc, f_imp)",
        "Stored certificates pitchfork.json and branch.json.",
        certificate="branch.json",
    )


@claim("prop:twist-nondeg", Kind.THEOREM, stated="τ₁ != 0 for almost every parameter")
def twist_almost_everywhere() -> Verdict:
    """For almost every parameter point with an elliptic never-stopping T-periodic orbit and without
    low resonance, τ₁ != 0.
    """
    claims = stored("branch.json").claims
    low, high = claims["f_range"].lower, claims["f_range"].upper
    exceptions = claims["exceptions"]
    length = sum((e.upper - e.lower for e in exceptions), Fraction(0))
    need(length < Fraction(1, 10**6), "the exceptions are long", length=float(length))
    need(low < Fraction(348, 1000) and high > Fraction(4658, 10000), "the range is short")
    return corrected(
        "for the pairs to which P* belongs it is true, with another proof: they have a closed form "
        "in (δ, ρ) on a connected set, on which (1 + trace) τ₁ is analytic and not identically 0. "
        "At R = 2, F = ω = 1 it is certified for all f in "
        f"{inner(claims['f_range'])} but {len(exceptions)} intervals of total length below 10⁻⁶",
        "Stored certificate, and the closed form of cap.one_one.closed_form.",
        certificate="branch.json",
        proof="kam.md#the-twist-vanishes-almost-nowhere",
    )


@claim("prop:twist-nondeg", Kind.NUMBER, stated="0.348 < 0.4 < 0.637")
def point_of_the_region() -> Verdict:
    """(1, 1, 2, 0.4) has f_sc ≈ 0.348 < 0.4 < f_imp ≈ 0.637."""
    with precisely():
        low = enclosure((16 - 4 * sp.pi) / sp.pi**2)
        high = 2 / interval.pi()
        point = interval.ball(Fraction(2, 5))
        need(low < point < high, "the point is not between them")
        for stated, value in (("0.348", low), ("0.637", high)):
            number(stated, value, "")
    return confirmed(f"{between(low, 6)} < 0.4 < {between(high, 6)}", "In balls.")


@claim("prop:twist-nondeg", Kind.NUMBER, stated="1.803")
def value_of_the_angle() -> Verdict:
    """At P* the eigenvalues are exp(±iθ*) with θ* ≈ 1.803."""
    angle = stored("elliptic.json").claims["rotation_angle"]
    with precisely():
        ball = interval.hull(interval.ball(angle.lower), interval.ball(angle.upper))
        verdict = number("1.803", ball, "Stored certificate.")
    return replace(verdict, strength=Strength.CERTIFIED, certificate="elliptic.json")


@claim("prop:birkhoff", Kind.DEFINITION, stated="real numbers θ*, τ₁")
def normalisation_of_the_twist() -> Verdict:
    """The twist coefficient is a number of the map."""
    tau, scale = symbols("tau scale")
    z = symbols("z")
    rescaled = tau * (z / scale) ** 2
    need(not same(rescaled, tau * z**2), "τ₁ does not depend on the scale of z")
    return imprecise(
        "its sign relative to θ* is; its size depends on the scale of z, which is not fixed. With "
        "the area form (i/2) dz ∧ dz̄ = dx ∧ dv it is",
        "z -> z/s multiplies τ₁ by s².",
    )
