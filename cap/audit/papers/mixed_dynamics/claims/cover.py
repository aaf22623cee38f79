"""Section 3.1 and 3.2: the triangular wave, the lifted Hamiltonian, the lift of orbits."""

from fractions import Fraction
from typing import Any, NamedTuple

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, formula, identity, same, symbols
from cap.audit.means.balls import between
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.sets import interval


def wave(q: Fraction) -> Fraction:
    """Return the triangular wave W of eq:Wq."""
    rest = q % 2
    return rest if rest < 1 else 2 - rest


def branches(q: Any) -> tuple[Any, Any]:
    """Return W on [0, 1) and on [1, 2), as in eq:Wq."""
    return q, 2 - q


class Crossing(NamedTuple):
    """p' of eq:Heq just left and just right of an odd integer q, where W has its peak."""

    c: Any  # F cos ωt
    f: Any
    R: Any
    left: Any
    right: Any


def at_a_peak() -> Crossing:
    """Return the one-sided limits: W' is 1 on the left and -1 on the right."""
    c, (f, R) = sp.Symbol("c", real=True), symbols("f R")
    return Crossing(c, f, R, (c - f) / R, (-c - f) / R)


@claim("eq:Wq", Kind.FORMULA, stated="W continuous, piecewise affine, Lipschitz 1, W' = ±1")
def triangular_wave() -> Verdict:
    """W is continuous with period 2, piecewise affine, Lipschitz with constant 1, W' = ±1 almost
    everywhere; its peaks are the odd integers, its zeros the even ones.
    """
    q = sp.Symbol("q", real=True)
    up, down = branches(q)
    need((sp.diff(up, q), sp.diff(down, q)) == (1, -1), "a slope is not ±1")
    peak, zero = up.subs(q, 1), up.subs(q, 0)
    need((peak, zero) == (1, 0), "a peak or zero is elsewhere")
    need(same(down.subs(q, 1), peak) and same(down.subs(q, 2), zero), "W jumps")
    return confirmed(
        "all of it",
        "W is q on [0, 1) and 2 - q on [1, 2), of slopes 1 and -1; the branches meet at 1, with "
        "the value 1, and at 2, which is 0 of the next period, with the value 0.",
    )


@claim("fig:cover", Kind.NUMBER, stated="W(q*) = 0.6 at q* = 3.4")
def point_of_the_sketch() -> Verdict:
    """The point drawn at q* = 3.4 has W(q*) = 0.6."""
    value = wave(Fraction(34, 10))
    need(value == Fraction(6, 10), "W(3.4) is not 0.6")
    return confirmed(str(value), "W evaluated exactly; the picture on the right has 0.9/1.5 too.")


@claim("fig:cover", Kind.WORDS, stated="lifts to a smooth Hamiltonian flow on R")
def smooth_passage() -> Verdict:
    """A wall reflection corresponds to smooth passage of q through an integer: the flow lifts to a
    smooth Hamiltonian flow.
    """
    peak = at_a_peak()
    jump = sp.simplify(peak.right - peak.left)
    need(differs(jump, sp.Integer(0)), "the field may be continuous")
    return corrected(
        "p' jumps by -2F cos ωt/R W'(k-) there: q is C¹ and not C²; the flow is piecewise "
        "analytic, and Φ is analytic where no hit is at t = 0 or T",
        f"One-sided limits of the field at an odd integer differ by {sp.sstr(jump)}, c = F cos ωt.",
    )


@claim("eq:Heq", Kind.FORMULA, stated="q' = p, p' = (F/R) cos ωt W'(q) - f/R")
def hamilton_equations() -> Verdict:
    """These are the Hamilton equations of H = p²/2 - (F/R) cos ωt W(q) + (f/R) q."""
    q, p, t = sp.symbols("q p t", real=True)
    F, f, R, w = symbols("F f R omega")
    W = sp.Function("W")(q)
    H = p**2 / 2 - F / R * sp.cos(w * t) * W + f / R * q
    identity("q' = p", sp.diff(H, p), p)
    derived = -sp.diff(H, q)
    stated = F / R * sp.cos(w * t) * sp.diff(W, q) - f / R
    identity("p'", derived, stated)
    return confirmed("both equations", "∂H/∂p and -∂H/∂q by sympy, for any W.")


@claim("lem:lift-flow", Kind.THEOREM, stated="unique for every (q₀, p₀) in R²")
def lifted_flow_is_unique() -> Verdict:
    """For every (q₀, p₀) the lifted system has one and only one forward Filippov solution."""
    peak = at_a_peak()
    left, right = (each.subs(peak.c, -2 * peak.f) for each in (peak.left, peak.right))
    need(left.is_negative is True and right.is_positive is True, "the field does not point away")
    return corrected(
        "from (q, p) = (1, 0), at a time with F cos ωt < -f, one solution goes left, one right, "
        "and some stay for a while: the field points away on both sides, and 0 is in its hull. It "
        "holds for p₀ > 0 as long as p stays positive, which is all that is used",
        "At q = 1-, 1+ the accelerations are (c - f)/R < 0 and (-c - f)/R > 0 for c = F cos ωt "
        "< -f; at c = -2f for instance.",
    )


@claim("lem:lift-flow", Kind.STEP, stated="p remains positive on every bounded interval")
def momentum_stays_positive() -> Verdict:
    """If p > 0 initially then p remains positive, since p' is bounded."""
    t, F, f, R, p0 = symbols("t F f R p0")
    p = p0 - (F + f) * t / R  # bound of p' attained where W' cos ωt = -1
    zero = sp.solve(p, t)[0]
    identity("p = 0 at p₀R/(F + f)", zero, p0 * R / (F + f))
    return refuted(
        "p reaches 0 in finite time from small p₀ > 0: where W' cos ωt < 0 it falls at least at "
        "the rate f/R. That is where the mass stops, and there the lift ends",
        "p' = ((F cos ωt) W' - f)/R <= -f/R there, so p = 0 before p₀R/f; and it is where the "
        "original orbit turns or sticks.",
    )


@claim("lem:lift-flow", Kind.FORMULA, stated="|f W'((k+1)⁻) - f W'(k⁺)|/R = 2f/R")
def jump_of_the_field() -> Verdict:
    """Across q = k the right-hand side of p' jumps by 2f/R."""
    peak = at_a_peak()
    derived, stated = peak.left - peak.right, 2 * peak.f / peak.R
    need(same(derived, 2 * peak.c / peak.R), "the jump is not 2F cos ωt/R")
    verdict = formula(
        derived,
        stated,
        "One-sided limits at an integer; friction is constant on the cover, it is the forcing that "
        "changes its sign. And W' is the same at k⁺ and (k+1)⁻, so the stated difference is 0.",
        "2F |cos ωt|/R",
    )
    need(wave(Fraction(1, 10)) - wave(Fraction(0)) == Fraction(1, 10), "W does not grow after 0")
    need(wave(Fraction(1)) - wave(Fraction(9, 10)) == Fraction(1, 10), "W does not grow before 1")
    return verdict


@claim("lem:lift-flow", Kind.FORMULA, stated="p'(t*+) - p'(t*-) = 2f W'(k⁺)/R != 0")
def jump_at_a_crossing() -> Verdict:
    """At a crossing of q = k, p' jumps by 2f W'(k⁺)/R, which is not zero."""
    peak = at_a_peak()
    return formula(
        peak.right - peak.left,
        -2 * peak.f / peak.R,  # W'(k⁺) = -1 at an odd k
        "One-sided limits at an odd integer; it vanishes for cos ωt = 0.",
        "2F cos ωt W'(k⁺)/R",
    )


@claim("lem:lift-flow", Kind.INEQUALITY, stated="p²/2 <= p₀²/2 + (F + f) t/R")
def lifted_energy_bound() -> Verdict:
    """p²/2 <= p₀²/2 + (F + f) t/R."""
    with interval.workprec(80):
        t, p0, f, R = (interval.ball(Fraction(n)) for n in ("1/200", "100", "2/5", "2"))
        p = p0 + (t.sin() - f * t) / R  # on the branch W' = 1, F = ω = 1
        need((p0 + 1) * t < 1, "the next branch is reached before")
        gain, bound = (p * p - p0 * p0) / 2, (1 + f) * t / R
        need(gain > bound, "the bound holds", gain=gain, bound=bound)
    return corrected(
        "|p| <= |p₀| + (F + f) t/R is true; at F = ω = 1, f = 2/5, R = 2 from q = 0, p₀ = 100 p²/2 "
        f"grows by {between(gain, 4)} until t = 1/200, where the bound allows {between(bound, 5)}",
        "(p²/2)' = p p', and |p| has no bound of 1: energies are compared with momenta. In balls.",
    )


@claim("lem:lift-flow", Kind.STEP, stated="div X_H = 0")
def divergence() -> Verdict:
    """The lifted vector field is free of divergence on each open region."""
    q, p, t = sp.symbols("q p t", real=True)
    H = sp.Function("H")(q, p, t)
    identity("div X_H", sp.diff(H, p, q) - sp.diff(H, q, p))
    return confirmed("∂²H/∂q∂p - ∂²H/∂p∂q = 0", "Symbolic identity.")


@claim("lem:lift-flow", Kind.STEP, stated="the transition is the identity, hence preserves ω₀")
def transition_is_the_identity() -> Verdict:
    """At a crossing of q = k the state is continuous, so the transition preserves area
    trivially.
    """
    p, jump, a, f = symbols("p jump a f")
    crossing = sp.Matrix([[1, 0], [jump / p, 1]])
    need(same(crossing.det(), sp.Integer(1)), "the saltation matrix has another determinant")
    turn = (a - f) / (
        a + f
    )  # at v = 0 the state is continuous too, and both fields are Hamiltonian
    need(differs(turn, sp.Integer(1)), "a turn preserves area")
    return corrected(
        "area is preserved because the saltation matrix ((1, 0), (Δp'/p, 1)) has determinant 1. "
        "Continuity of the state is no reason: it is continuous at a turning point too, between "
        "two divergence-free fields, and area shrinks there by (a - f)/(a + f), a = |F cos ωt|",
        "The saltation formula I + (g₊ - g₋)nᵀ/(nᵀg₋) for n = dq (crossing) and n = dv (turn).",
    )


@claim("lem:lift-flow", Kind.STEP, stated="time at least 1/sup p between crossings")
def crossings_do_not_accumulate() -> Verdict:
    """Crossings of q = k and q = k + 1 are at least 1/sup p apart in time."""
    P, d = symbols("P d")
    identity("1 <= P d", sp.solve(sp.Eq(1, P * d), d)[0], 1 / P)
    return confirmed(
        "true as long as p > 0: q covers a length of 1", "1 = ∫ p dt <= sup p times the duration."
    )


@claim("ssec:lift-triangular", Kind.WORDS, stated="R = R/(reflections at 0 and 1)")
def dihedral_group() -> Verdict:
    """π identifies exactly the points of an orbit of the group generated by the reflections of the
    line at the lifts of the walls.
    """
    q, w = sp.symbols("q w", real=True)
    up, down = branches(q)
    identity("-q, moved by 2, is on the other branch: W(2 - q) = W(q)", down.subs(q, 2 - q), up)
    fibre = [root for branch in (up, down) for root in sp.solve(branch - w, q)]
    need(len(fibre) == 2, "W takes a value more than twice in a period")
    identity("the two are images by the reflection at 1", fibre[0] + fibre[1], 2)
    return confirmed(
        "W(-q) = W(q) = W(2 - q), and fibres are orbits",
        "On a period W takes the value w at w and at 2 - w, by sympy; the reflections at 0 and 1 "
        "generate q -> ±q + 2n, so the fibre of w is the orbit of w.",
    )


@claim("lem:lift-flow", Kind.INEQUALITY, stated="|p'| <= (F + f)/R")
def bound_of_the_field() -> Verdict:
    """The right-hand side of eq:Heq is bounded by (F + f)/R."""
    F, f, R = symbols("F f R")
    ends = [((sign * F - f) / R) for sign in (1, -1)]  # of p' = (F cos ωt W' - f)/R
    bound = (F + f) / R
    need(same(sp.Abs(ends[1]), bound), "the bound is not attained")
    need((bound - ends[0]).simplify().is_positive is True, "it is exceeded")
    return imprecise(
        "p' is; q' = p is not bounded",
        "p' = (F cos ωt W' - f)/R is between (-F - f)/R and (F - f)/R.",
    )
