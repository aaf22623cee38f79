"""Sentences here and there that a reading of the whole text stops at."""

from fractions import Fraction

from cap.audit import labels
from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, same, symbols
from cap.audit.means.balls import between, pair, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.claims.saltation import hit
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.sets import interval

READ = "The text."


@claim("ssec:intro-mixed", Kind.WORDS, stated="a potential that switches sign at every integer")
def sign_of_the_potential() -> Verdict:
    """On the cover the potential switches its sign at every integer."""
    q, c, R, f = sp.symbols("q c R f", positive=True)  # c = F cos ωt
    left, right = (-c / R * W + f / R * q for W in (q, 2 - q))
    identity("V is continuous at q = 1", left.subs(q, 1), right.subs(q, 1))
    jump = sp.diff(right, q) - sp.diff(left, q)
    identity("the part of its slope that is due to the forcing changes its sign", jump, 2 * c / R)
    return corrected(
        "its slope does, in the part that is due to the forcing; the potential is continuous",
        "V = -(F/R) cos ωt W(q) + (f/R) q on both sides of q = 1, by sympy.",
    )


@claim("thm:wellposed", Kind.STEP, stated="the first time at which a condition fails to hold")
def first_event() -> Verdict:
    """Step 1: t* is the first time at which one of the conditions (i) to (iii) fails to hold."""
    return corrected("at which one of them holds: they are the events", READ)


@claim("prop:twist-nondeg", Kind.STEP, stated="the base is (0, ∞)³, and connected")
def base_of_the_region() -> Verdict:
    """The base of the region Π is (0, ∞)³, which is connected, so Π is."""
    F, R, w = symbols("F R omega")
    f_sc, f_imp = 4 * (2 * F + R * w**2 - F * sp.pi) / sp.pi**2, 2 * F / sp.pi
    largest = sp.solve(f_sc - f_imp, R)
    need(len(largest) == 1 and bool(largest[0].is_positive), "f_sc < f_imp for all R")
    return imprecise(
        "the base is {f_sc < f_imp}, that is, Rω² < F(3π/2 - 2), not all of (0, ∞)³; it is "
        "connected all the same",
        f"f_sc = f_imp at R = {sp.sstr(sp.simplify(largest[0]))}, by sympy: an interval of R for "
        "each (F, ω).",
    )


@claim("ssec:num-saddle", Kind.WORDS, stated="two folds, at f_sc and f_fold")
def two_folds() -> Verdict:
    """There are two folds of T-periodic orbits, at f_sc ≈ 0.34790 and f_fold ≈ 0.467."""
    fork = stored("pitchfork.json").claims["f"]
    return refuted(
        "neither is a fold of orbits: at f_sc roots meet that are no orbits (ansatz.bijection), "
        f"and at f in {pair(fork, 6)} the pair meets the symmetric orbit in a pitchfork",
        "Stored certificate; Theorem 4.2.",
        certificate="pitchfork.json",
    )


@claim("ssec:num-diag", Kind.WORDS, stated="the lower bound is set by floating-point underflow")
def lower_end_of_the_index() -> Verdict:
    """The lower end -13.4 of log10 SALI is set by floating-point underflow."""
    with precisely():
        ten = interval.ball(10)
        need(bool(ten ** (-14) > interval.ball(Fraction(1, 2**1022))), "doubles underflow here")
        need(bool(ten ** (-14) < 100 * interval.ball(Fraction(1, 2**52))), "no rounding error")
    return corrected(
        "by rounding: two unit vectors in doubles differ by nothing or by about 2⁻⁵³ or more. "
        "Underflow begins at 10⁻³⁰⁸",
        "10⁻¹⁴ is more than 2⁻¹⁰²², and of the size of some 2⁻⁵².",
    )


@claim("ssec:num-cap", Kind.CONSISTENCY, stated="S_wall is derived in Corollary 3.4")
def wall_matrix_of_the_enclosure() -> Verdict:
    """Step 2: the matrix of a hit that Corollary 3.4 derives has the entry 2F cos ωt*/v₋."""
    M, u, c, _ = hit(1, sp.Integer(1))
    need(same(M[1, 0], 2 * c / u), "the entry is another")
    need(differs(M[1, 0], -2 * c / u), "the two may agree")
    return imprecise(
        "the entry is right; Corollary 3.4 derives the opposite of it, -2F cos ωt*/v₋, and Table 1 "
        "has a third one",
        "The saltation matrix by sympy, as in saltation.wall-entry.",
    )


@claim("ssec:num-cap", Kind.CONSISTENCY, stated="mpmath is Johansson2017, Arb is Johansson2017")
def reference_of_two_libraries() -> Verdict:
    """The library mpmath and the library Arb are cited as two sources."""
    return imprecise("both carry the same reference, to Arb's paper", READ)


@claim("ssec:num-coexist", Kind.THEOREM, stated="exponents in reciprocal pairs ±λ on Ω_NS")
def pairs_of_exponents() -> Verdict:
    """On Ω_NS the Lyapunov exponents come in pairs ±λ."""
    M, *_ = hit(1, sp.Integer(1))
    need(same(M.det(), sp.Integer(1)), "a hit changes areas")
    return confirmed(
        "where they exist: their sum is the mean of log |det Φ'|, which is 0. (Opposite, not "
        "reciprocal: the multipliers are reciprocal)",
        "det Φ' = 1 where nothing but hits happens, by sympy.",
    )


@claim("ssec:num-coexist", Kind.WORDS, stated="an additional negative average on Ω_dissip")
def average_on_the_dissipative_set() -> Verdict:
    """On Ω_dissip the contraction produces an additional negative average of the exponents."""
    segment = stored("segment.json").claims["basin_area"]
    need(segment.lower > 0, "the set may have no area")
    return imprecise(
        "there is no third exponent in the plane: what is negative is the sum of the two, and it "
        "is -∞ along orbits that stick again and again",
        "Two multipliers; det Φ' = 0 in each period with a stick (saltation.sticking-matrix).",
        certificate="segment.json",
    )


@claim("ssec:conclusion-summary", Kind.WORDS, stated="a boundary of trajectories that stop once")
def boundary_of_the_parts() -> Verdict:
    """The boundary between Ω_NS and Ω_dissip is traced by the trajectories that experience even one
    velocity-zero crossing per period.
    """
    sink = stored("periodic-1.json")
    need(sink.claims["type"] == "sink focus", "it attracts no open set")
    return refuted(
        "these fill open sets, far from any boundary: near the sink at F = 3, which turns twice in "
        "every period, all orbits do",
        "Stored certificate of a sink with two turns per period.",
        certificate="periodic-1.json",
    )


@claim("ssec:hist-connection", Kind.CONSISTENCY, stated="Theorem 2.5 (c)")
def part_of_the_theorem() -> Verdict:
    """Theorem 2.5 has a part (c), which excludes accumulation."""
    return refuted(
        "it has no parts; accumulation is excluded in Steps 4 to 6 of its proof, which fall "
        "(wellposed.no-accumulation)",
        READ,
    )


@claim("ssec:hist-connection", Kind.CONSISTENCY, stated="the pair at F = 3 is that of Prop. 4.4")
def pair_and_the_proposition() -> Verdict:
    """The pair at F = 3, one elliptic, one saddle, is consistent with Proposition 4.4."""
    with precisely():
        pi = interval.pi()
        f_sc = 4 * (6 + 2 - 3 * pi) / pi**2
        need(bool(f_sc < 0), "f_sc(3) is positive")
    return refuted(
        "both have two hits of each wall and two turns in a period, not one hit and one turn in "
        f"each half of it; and f_sc = {between(f_sc, 4)} < 0 at F = 3, where the proposition is "
        "not stated. (Nor is the first elliptic: it is a sink)",
        "The proposition assumes 0 < f_sc; the events are certified (periodic-1.json, "
        "periodic-2.json).",
    )


@claim("ssec:hist-chatter", Kind.STEP, stated="e = 1, no friction: energy conservation")
def reason_without_friction() -> Verdict:
    """With elastic walls and no friction chatter is impossible because energy is conserved."""
    F, w, t, v = symbols("F omega t v")
    rate = v * F * sp.cos(w * t)
    need(differs(rate, sp.Integer(0)), "the energy does not change")
    return imprecise(
        "the forced mass does not conserve its energy, E' = F cos ωt x'. Why hits do not "
        "accumulate at f = 0 is that a bounce against the force a = F cos ωt returns with the "
        "speed with which it began, to first order",
        "E' by sympy; the ratio sqrt((a - f)/(a + f)) of speeds (mirror.ratio-of-chatter) is 1.",
    )


@claim("ssec:hist-chatter", Kind.CONSISTENCY, stated="treated in Lemma 2.3 (c)")
def lemma_at_the_walls() -> Verdict:
    """Grazing with stiction at a wall is treated rigorously in Lemma 2.3 (c)."""
    return refuted(
        "the lemma assumes x(t*) in (l, r), and is about stops away from the walls; of stops at a "
        "wall the paper says nothing, and (F1) to (F3) leave them open (inclusion.rest-at-a-wall)",
        READ,
    )


@claim("app:historical", Kind.CONSISTENCY, stated="a bibliography")
def bibliography() -> Verdict:
    """The works that are cited are in a bibliography."""
    own = labels.stored()
    need(own.cited > 0 and own.references == 0, "there is a bibliography")
    return refuted(
        f"there is none: {own.cited} works are cited, and the file has no entry and names no file "
        "of entries",
        "Counted in the TeX file when its places were read.",
    )


@claim("app:historical", Kind.CONSISTENCY, stated="figures are included")
def pictures() -> Verdict:
    """The figures are in the paper."""
    own = labels.stored()
    need(own.pictures > 0, "all pictures have files")
    return refuted(
        f"{own.pictures} of them are \\includegraphics{{ }}, without the name of a file: the TeX "
        "file does not compile without errors, and its pictures cannot be checked",
        "Counted in the TeX file when its places were read.",
    )
