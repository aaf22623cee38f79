"""Section 9: KAM tori for particles, two particles, and the conjecture."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, same, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.claims.particles import EMPTY, collision, drift_is_negative
from cap.audit.verdict import (
    Verdict,
    confirmed,
    corrected,
    imprecise,
    still_open,
    uncheckable,
    vacuous,
)
from cap.parameters import PAPER

TWO_PARTICLES = "particles.json"  # an elliptic orbit, and the one that the paper expects
NOT_ELLIPTIC = "particles_saddle.json"
LIMITS = "particles_limits.json"  # down to which masses the orbit is elliptic


@claim("cor:multi-KAM", Kind.THEOREM, stated="(K1) with θ₀ = 2π and Σ|k_j| <= 2N + 4")
def hypothesis_k1() -> Verdict:
    """(K1): Σ k_j θ_j is not in 2πZ for every non-zero integer vector (k₀, .., k_N), θ₀ = 2π."""
    k = (1, 0, 0)
    turns = Fraction(k[0])  # Σ k_j θ_j in units of 2π, whatever θ₁, .., θ_N are
    need(any(k) and turns.denominator == 1, "this vector does not violate (K1)")
    need(sum(map(abs, k)) <= 2 * 2 + 4, "it is too long")
    return vacuous(
        "(K1) can never hold: k = (1, 0, .., 0) gives θ₀ = 2π, which is in 2πZ. What is meant: Σ "
        "k_j θ_j not in 2πZ for non-zero (k₁, .., k_N); and order 4 is enough for the normal form "
        "used",
        "One vector, exactly.",
    )


@claim("cor:multi-KAM", Kind.THEOREM, stated="P* non-sticking for N particles")
def orbits_of_the_corollary() -> Verdict:
    """The corollary is about elliptic periodic orbits in Ω_NS^(N)."""
    drift_is_negative()
    return vacuous(
        "for N >= 2 there is no such orbit: Ω_NS^(N) is empty. With Σ f_i Δs_i = 0 at collisions "
        "in place of Definition 9.2 the corollary has content",
        "See particles.never-stopping-set-is-empty.",
        proof=EMPTY,
    )


@claim("cor:multi-KAM", Kind.STEP, stated="N_δ is contained in Ω_NS^(N)")
def neighbourhood_of_tori() -> Verdict:
    """The disk N_δ around P* lies in Ω_NS^(N)."""
    for n in (1, 2, 3):
        separates = n == 2 * n - 1  # an n-torus has codimension one in a section of dimension 2n
        need(separates is (n == 1), "the dimensions are others")
    return still_open(
        "for N >= 2 tori do not enclose a neighbourhood: dimension N in 2N. Orbits between them "
        "may drift away and stop; only the tori, and their closure, are known to be never-stopping",
        "An N-torus separates a space of dimension 2N for N = 1 only.",
    )


@claim("cor:multi-KAM", Kind.INEQUALITY, stated="complement at most K δ^(2N + 1/2)")
def measure_of_tori() -> Verdict:
    """The complement of the tori in the ball of radius δ has measure at most K δ^(2N + 1/2)."""
    order = 4
    need(Fraction(order - 3, 2) == Fraction(1, 2), "the exponent is another")
    return still_open(
        "cited, not proved, in the paper and here; the exponent agrees with a relative measure "
        "O(δ^((l-3)/2)) of the complement for resonances excluded up to order l = 4. The "
        "references given were not at hand",
        "(l - 3)/2 = 1/2 for l = 4.",
    )


@claim("rem:multi-KAM-feasibility", Kind.THEOREM, stated="equal masses: two independent problems")
def equal_masses() -> Verdict:
    """For two equal masses the system decouples into two single-particle problems by the swap."""
    k = collision()
    m1, m2 = k.m
    need(
        same(k.collision.subs(m2, m1), sp.Matrix([[0, 1], [1, 0]])), "velocities are not exchanged"
    )
    c, f, s = sp.symbols("c f s", real=True)
    identity("the acceleration belongs to the velocity", (c - f * s) / m1 - (c - s * f) / m1)
    return confirmed(
        "true, if both have the same friction force: exchanging velocities is passing through each "
        "other, and force and friction depend on the velocity only",
        "By sympy.",
    )


@claim(
    "rem:multi-KAM-feasibility", Kind.STEP, stated="the twist matrix is diagonal with entries τ₁"
)
def twist_matrix_of_equal_masses() -> Verdict:
    """For equal masses (K2) holds: the twist matrix is diagonal with the non-zero entries τ₁."""
    twist = stored("elliptic.json").claims["twist"]
    need(twist.lower > 0, "the twist may vanish")
    angle = stored("elliptic.json").claims["rotation_number"]
    other = stored("elliptic-2.json").claims["rotation_number"]
    need(angle.lower <= other.upper and other.lower <= angle.upper, "the rotation numbers differ")
    return imprecise(
        "true for a product of P* and its mirror image; but both have the same rotation number, so "
        "multipliers are double and (K1), repaired, fails. The product of the invariant curves of "
        "both are invariant tori without any theorem in dimension four",
        "Stored certificates of both orbits.",
        certificate="elliptic-2.json",
    )


@claim(
    "rem:multi-KAM-feasibility", Kind.STEP, stated="non-degenerate by the real-analyticity argument"
)
def analyticity_argument() -> Verdict:
    """For m₁ != m₂ the twist matrix is non-degenerate by the real-analyticity argument."""
    x = sp.Symbol("x", real=True)
    det = x * (x - sp.Rational(9, 10))  # analytic, not identically zero, zero at 9/10
    need(det.subs(x, sp.Rational(9, 10)) == 0, "it does not vanish at 9/10")
    need(sp.simplify(det) != 0, "it vanishes identically")
    return imprecise(
        "that argument gives almost every parameter of a family, never a given one such as m₂ = "
        "0.9. The paper says that it is not proved",
        "x(x - 9/10) is analytic, not identically zero, and vanishes at 9/10.",
    )


@claim("rem:N2", Kind.THEOREM, stated="an elliptic orbit at m = (1, 0.9), from equal masses")
def elliptic_orbit_of_two_particles() -> Verdict:
    """For m₁ = 1, m₂ = 0.9 an elliptic never-stopping periodic orbit exists, by perturbation from
    equal masses.
    """
    masses = Fraction(1), Fraction(9, 10)
    elliptic, other = stored(TWO_PARTICLES), stored(NOT_ELLIPTIC)
    need(elliptic.parameters["masses"] == other.parameters["masses"] == masses, "other masses")
    paper = {key: other.parameters[key] for key in PAPER.elastic_strings()}
    need(paper == {key: getattr(PAPER, key) for key in paper}, "other parameters")
    determinant = elliptic.claims["twist_determinant"]
    need(not determinant.lower <= 0 <= determinant.upper, "the twist matrix may be singular")
    limits = stored(LIMITS)
    need({key: limits.parameters[key] for key in paper} == paper, "other parameters of the limits")
    need(limits.parameters["masses"] == (1, 1), "other masses of the limits")
    flip, stop = limits.claims["flip"], limits.claims["stop"]
    need(flip.lower > masses[1] > stop.upper, "9/10 is not between the limits")
    outer = other.claims["multipliers"][0]
    need(outer.upper < -1, "the outer multiplier may be on the unit circle")
    f, speed = elliptic.parameters["f"], other.claims["least_speeds"][1]
    return corrected(
        "at the paper's parameters the orbit continued from P* and its mirror image exists at "
        f"m = (1, 9/10), no mass stops (least speed in {speed}), but one multiplier is in {outer}: "
        f"not elliptic. Of one family with the same contacts one multiplier is -1 at an m₂ in "
        f"{flip}, elliptic above it and not below, and a mass stops at an m₂ in {stop}. At f = {f} "
        "one at this m is elliptic, without resonance of order up to 4, with a twist determinant "
        f"in {determinant}, not 0. Whether one is at f = 2/5 is unknown. In the sense of "
        "Definition 9.2 there is none anywhere (particles.never-stopping-set-is-empty): here "
        "collisions exchange signs",
        f"Stored certificates: {TWO_PARTICLES}, {NOT_ELLIPTIC}, {LIMITS}.",
        certificate=NOT_ELLIPTIC,
    )


@claim("sec:multiparticle", Kind.THEOREM, stated="rigorous in this setting")
def mixed_dynamics_of_two_particles() -> Verdict:
    """The mixed dynamics of the two-particle figure of GKR2019 is rigorous in this setting."""
    drift_is_negative()
    return vacuous(
        "the setting contains no never-stopping orbit of two particles, and by the paper's own "
        "words no configuration is verified",
        "See particles.never-stopping-set-is-empty, tori.hypothesis-k1.",
        proof=EMPTY,
    )


@claim("conj:Ninfty", Kind.THEOREM, stated="V_N -> 0 at fixed energy density")
def conjecture() -> Verdict:
    """The relative phase space volume of the islands at fixed energy density tends to 0 as N
    -> ∞.
    """
    t, F, w, v, f = symbols("t F omega v f")
    rate = v * (F * sp.cos(w * t) - f)
    need(sp.simplify(rate) != 0, "energy is conserved")
    return uncheckable(
        "energy is not conserved under forcing, so 'fixed energy density' means nothing; the phase "
        "space has infinite volume; for N >= 2 tori bound no islands. With Definition 9.2 V_N = 0 "
        "for all N >= 2. A box of states and unequal masses would have to be fixed",
        "dE/dt = Σ v_i (F cos ωt - f sgn v_i), not identically zero.",
    )


@claim("cor:multi-KAM", Kind.WORDS, stated="genuinely informative")
def conditional_statement() -> Verdict:
    """The corollary identifies precisely the hypotheses under which multi-particle KAM theory
    follows.
    """
    size = 2 * 2 + 4
    need(size > 4, "the order is not larger than 4")
    return imprecise(
        "the hypotheses needed are weaker and other: order 4 in place of 2N + 4 and without θ₀; "
        "Kolmogorov's condition det T != 0; Σ m_i dv_i ∧ dx_i; and Σ f_i Δs_i = 0 at collisions. "
        "As stated no orbit satisfies them",
        "tori.hypothesis-k1, particles.condition-at-a-collision.",
        proof="particles.md#when-a-collision-is-symplectic",
    )
