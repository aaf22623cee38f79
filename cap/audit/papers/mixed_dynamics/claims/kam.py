"""Section 5.2: the twist theorem, its measure estimate, and the islands."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, same, symbols
from cap.audit.means.balls import inner, pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import States
from cap.audit.means.stored import stored
from cap.audit.verdict import (
    Verdict,
    confirmed,
    imprecise,
    refuted,
    still_open,
    uncheckable,
)
from cap.proofs.census import census


@claim("prop:moser-quantitative", Kind.THEOREM, stated="a C^ℓ exact symplectic map")
def smoothness_class() -> Verdict:
    """For a C^ℓ exact symplectic map with twist, every small disk is filled by invariant C^ℓ curves
    up to measure K δ^(5/2).
    """
    return uncheckable(
        "ℓ is not said. For small ℓ it is false (Moser's theorem needs more than three derivatives "
        "of the map), and invariant curves have fewer derivatives than the map. For C^∞ or "
        "analytic maps, as Φ is, nothing is lost",
        "The proof is by citation (Pöschel 2001, Salamon 2004), whose statements were not at hand.",
    )


@claim("eq:moser-bound", Kind.INEQUALITY, stated="complement at most K δ^(5/2)")
def measure_estimate() -> Verdict:
    """The complement of the invariant curves in the disk of radius δ has measure at most
    K δ^(5/2).
    """
    return still_open(
        "the exponent agrees with what is known for resonances excluded up to order l = 4: a "
        "relative measure O(δ^((l-3)/2)) of the complement (Pöschel 1982, for flows). It is cited, "
        "not proved, in the paper and here; that curves have density one at P* is Moser's theorem",
        "The text; 2 + (l - 3)/2 = 5/2 for l = 4.",
    )


@claim("thm:kam", Kind.THEOREM, stated="δ₀, K depend only on |τ₁|, |sin θ*| and the C^k norm of Φ")
def constants() -> Verdict:
    """The constants δ₀ and K depend only on |τ₁|, |sin θ*| and the C^k norm of Φ."""
    a, b, r, angle = symbols("a b r angle")
    H = a * r**4 + b * r**4 * sp.cos(4 * angle)
    turned = sp.expand_trig(H.subs(angle, angle + sp.pi / 2))
    identity("H is invariant under the rotation by π/2", turned, H)
    zero = sp.acos(-a / b)
    identity("H vanishes on rays", H.subs(angle, zero / 4), 0)
    speed = sp.diff(H, angle).subs(angle, zero / 4)  # dr/dt is ∂H/∂angle over r
    need(not same(speed, sp.Integer(0)), "orbits on the rays do not move")
    return imprecise(
        "they cannot be bounded by a lower bound of |sin θ*|: as |sin θ*| tends to 1, the "
        "resonance π/2, they degenerate (and nothing excludes it at 2π/3, |sin θ*| = √3/2), which "
        "the words hide. The rotation by θ after the time-one map of a|z|⁴ + b Re z⁴, b > a > 0, "
        "has the same twist for all θ, and no invariant curve at all around 0 for θ = π/2; as θ "
        "tends to π/2, islands shrink to nothing. At a fixed |sin θ*| this refutes nothing",
        "At θ = π/2 the map's fourth power is the flow of a Hamiltonian whose level curves, but "
        "for rays, all run off to infinity: symmetry and rays by sympy.",
        proof="kam.md#constants-of-the-measure-estimate",
    )


@claim("thm:kam", Kind.THEOREM, stated="(H1) to (H6) imply a Cantor family of invariant curves")
def invariant_curves() -> Verdict:
    """Around an elliptic never-stopping T-periodic orbit without resonance of order at most 4 and
    with twist there are invariant curves, of density one at the orbit.
    """
    claims = stored("elliptic.json").claims
    twist = claims["twist"]
    need(twist.lower > 0, "the twist may vanish")
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    return confirmed(
        "true, by Moser's theorem, and without the clause |F cos ωt*| > f of (H1). It applies at "
        f"the paper's parameters: τ₁ in {pair(twist, 9)}",
        "All hypotheses are certified; Moser's theorem is cited. For the exponent of the measure "
        "see kam.measure-estimate, for the constants kam.constants.",
        certificate="elliptic.json",
        proof="kam.md#smoothness-and-openness",
    )


@claim("H6", Kind.THEOREM, stated="τ₁ != 0 at P*")
def twist_at_the_orbit() -> Verdict:
    """(H6) holds at the elliptic orbit of the paper."""
    twist = stored("elliptic.json").claims["twist"]
    need(twist.lower > 0, "the twist may vanish")
    return confirmed(
        f"τ₁ in {pair(twist, 12)} per |z|²: not zero, though not -0.42",
        "Stored certificate: the hypothesis that the paper leaves open.",
        certificate="elliptic.json",
    )


@claim("H3", Kind.THEOREM, stated="for which parameters")
def islands_along_the_branch() -> Verdict:
    """The theorem applies near f = 0.4 as well."""
    claims = stored("branch.json").claims
    need(len(claims["exceptions"]) <= 4, "there are more exceptions")
    return confirmed(
        f"for all f in {inner(claims['f_range'])} with trace > -2 but {len(claims['exceptions'])} "
        "short intervals both orbits of the pair are surrounded by invariant curves (F = ω = 1, R "
        "= 2)",
        "Stored certificate of the whole branch.",
        certificate="branch.json",
    )


@claim("cor:Hamilton-island", Kind.INEQUALITY, stated=">= πδ₀²(1 - (K/π) δ₀^(1/2))")
def area_of_the_curves() -> Verdict:
    """The invariant curves in the disks of radius δ < δ₀ have measure at least
    πδ₀²(1 - (K/π) δ₀^(1/2)).
    """
    d, K = symbols("delta K")
    least = sp.pi * d**2 - K * d ** sp.Rational(5, 2)
    identity("the bound", least, sp.pi * d**2 * (1 - K / sp.pi * sp.sqrt(d)))
    threshold = sp.solve(1 - K / sp.pi * sp.sqrt(d), d)[0]
    identity("it is positive for δ₀ < (π/K)²", threshold, (sp.pi / K) ** 2)
    return confirmed(
        "true, given Theorem 5.6 with its measure estimate", "Algebra by sympy; continuity in δ."
    )


@claim("eq:KAM-final", Kind.STEP, stated="Ψ'(P*) = I, so N_δ corresponds to a disk")
def pullback() -> Verdict:
    """Steps 3 and 6: the normalising change has Ψ'(P*) = I, so disks correspond to disks."""
    jacobian = stored("elliptic.json").claims["jacobian"]
    a, d = jacobian[0][0], jacobian[1][1]
    need(a.lower > d.upper, "the diagonal entries may agree")
    return imprecise(
        "Φ'(P*) is no rotation in (x, v), so a linear change comes first and disks become "
        "ellipses; the estimate survives with another K, as an ellipse lies in a disk of larger "
        "radius",
        f"The diagonal entries of Φ'(P*) are in {pair(a, 4)} and {pair(d, 4)}, those of a rotation "
        "are equal.",
        certificate="elliptic.json",
    )


@claim("fig:kam-gallery", Kind.THEOREM, stated="Theorem 4.2 guarantees existence")
def existence_of_the_gallery_orbit() -> Verdict:
    """Theorem 4.2 guarantees the existence of P*."""
    found = [m for m in census(Fraction(2, 5), Fraction(2)) if m.kind == "elliptic"]
    need([m.name for m in found] == ["pair"], "the elliptic orbits are others")
    return refuted(
        "it is about orbits with turning points, of which there are none; P* never turns. It "
        "exists by Theorem 10.1 of the paper, and by certificate",
        "cap.proofs.census at (1, 1, 2, 2/5): the elliptic orbits with one hit of each wall are "
        "one asymmetric pair.",
    )


@claim("fig:kam-gallery", Kind.NUMBER, stated="Δ ≈ 0.07 for (x* + 0.05, v* + 0.05)")
def displacement() -> Verdict:
    """The start (x* + 0.05, v* + 0.05) of row (d) is at the distance Δ ≈ 0.07."""
    square = 2 * Fraction(5, 100) ** 2
    need(Fraction(65, 1000) ** 2 < square < Fraction(75, 1000) ** 2, "the distance is another")
    return confirmed("0.05 sqrt 2, between 0.0707 and 0.0708", "Squares compared exactly.")


@claim("fig:kam-gallery", Kind.THEOREM, stated="four orbits share one right and one left hit")
def pattern_of_the_gallery() -> Verdict:
    """All four orbits of the gallery hit each wall once in each period."""
    starts = (("0.10028", "0.54194"), ("0.10328", "0.54194"), ("0.11228", "0.54194"))
    for x, v in starts:
        orbits = States(x, v).follow(4)
        need(orbits.words == ("hit r", "hit l") * 4, f"({x}, {v}) does something else")
    row_d = States("0.1502798898441954", "0.5919433067664584").follow(8)
    need(row_d.words == ("hit r", "hit l") * 8, "row (d) does something else", w=row_d.words)
    return confirmed(
        "over the periods shown, from near P*, from Δ = 0.003 and 0.012, and from (x* + 0.05, "
        "v* + 0.05), eight periods there as four are dropped",
        "Followed in balls from these states.",
    )
