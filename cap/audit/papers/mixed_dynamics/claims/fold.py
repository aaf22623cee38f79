"""Section 4.3: the 'saddle-center' of the roots, Theorem 4.8, against the one that orbits have."""

from fractions import Fraction
from typing import Any

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, same, symbols
from cap.audit.means.balls import between, pair, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.paper_equation import psi
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, refuted, vacuous
from cap.one_one.closed_form import symmetric
from cap.sets import interval
from cap.sets.interval import Ball

NEAR = Fraction(63, 100)  # f near 2F/π


def squared_distance() -> tuple[Any, Any, Any]:
    """Return d(θ - π/2)²/dμ at the fold, from Ψ as a function of (θ - π/2)² and f; F and f_sc."""
    value, theta, (F, f, _, _) = psi()
    y = symbols("y")
    even = value.subs(theta, sp.pi / 2 + sp.sqrt(y))
    slope_y = sp.limit(sp.diff(even, y), y, 0, "+")
    slope_f = sp.diff(value, f).subs(theta, sp.pi / 2)
    return sp.simplify(-slope_f / slope_y), F, f


@claim("eq:normalform-theta", Kind.FORMULA, stated="(θ± - π/2)² = (π²/2)/(Fπ - 2f_sc) μ + O(μ²)")
def normal_form() -> Verdict:
    """(a) (θ± - π/2)² = (π²/2)/(Fπ - 2f_sc) μ + O(μ²), with a positive coefficient."""
    derived, F, f = squared_distance()
    stated = sp.pi**2 / 2 / (F * sp.pi - 2 * f)
    identity("the coefficient", derived, stated)
    return confirmed(
        "true for the roots of eq:theta-eq, with this remainder: (θ - π/2)² is analytic in μ",
        "Implicit function theorem for Ψ as a function of (θ - π/2)² and f, by sympy; positive for "
        "f_sc < Fπ/2. The proof claims O(μ^(3/2)), which is weaker.",
    )


@claim("thm:saddlecenter", Kind.STEP, stated="Ψ_f(π/2) = π²/2 - π²/4 = π²/4")
def derivative_by_friction() -> Verdict:
    """(a) The derivative of Ψ by f at π/2 is π²/4 > 0."""
    value, theta, (_, f, _, _) = psi()
    identity("Ψ_f", sp.diff(value, f), sp.pi**2 / 2 - theta * (sp.pi - theta))
    identity("Ψ_f(π/2)", sp.diff(value, f).subs(theta, sp.pi / 2), sp.pi**2 / 4)
    return confirmed("π²/4", "Differentiated by sympy.")


@claim("eq:vgap-asymp", Kind.FORMULA, stated="Δv = +(2f_sc/ω) sqrt(..) sqrt μ (1 + O(sqrt μ))")
def velocity_gap() -> Verdict:
    """(b) Δv = X'₊(0+) - X'₋(0+) = (2f_sc/ω) sqrt((π²/2)/(Fπ - 2f_sc)) sqrt μ (1 + O(sqrt μ))."""
    F, f, w, y = symbols("F f omega y")  # θ± = π/2 ± y
    start = [-F / w * sp.sin(sp.pi / 2 + s * y) - f * (sp.pi / 2 + s * y) / w for s in (1, -1)]
    gap = sp.simplify(start[0] - start[1])
    identity("Δv is -2f y/ω exactly", gap, -2 * f * y / w)
    need(gap.is_negative is True, "the gap is not negative")
    return corrected(
        "Δv = -(2f/ω)(θ₊ - π/2), negative; exactly, as the sines are equal; so the relative error "
        "is O(μ). The proof passes to |Δv|, and says so",
        "A₁(θ₊) - A₁(θ₋) for θ± = π/2 ± y, by sympy. And no orbit leaves the wall so (ansatz).",
    )


@claim("thm:saddlecenter", Kind.CONSISTENCY, stated="X± are the orbits of Theorem 4.2")
def colliding_orbits() -> Verdict:
    """For small μ > 0 the roots θ± give T-periodic solutions X±, which collide at μ = 0."""
    f, F, y = symbols("f F y")
    at_fold = sp.Abs(F * sp.cos(sp.pi / 2))
    need(same(at_fold, sp.Integer(0)), "the forcing at the fold is not zero")
    need((f - at_fold).is_positive is True, "the condition |F cos θ| > f may hold at the fold")
    near = sp.limit(F * sp.sin(y), y, 0)  # |F cos θ| for θ = π/2 ± y
    need(same(near, sp.Integer(0)), "it does not hold near the fold only")
    return vacuous(
        "near the fold |F cos θ| < f, so by the paper's own condition eq:transverse-cond there is "
        "no orbit X± there: parts (b) and (c) are about nothing. (And none elsewhere: "
        "ansatz.bijection)",
        "|F cos θ| = F |sin(θ - π/2)| tends to 0 as μ does.",
        proof="periodic.md#no-orbit-has-the-pattern",
    )


@claim("thm:saddlecenter", Kind.STEP, stated="Φ' on Ω_NS is symplectic, det Φ' = 1")
def linearization_is_symplectic() -> Verdict:
    """(c) By Theorem 3.3 Φ' at X± is symplectic, so its eigenvalues are reciprocal."""
    a, f = symbols("a f")
    det = (a / (a + 2 * f)) ** 2
    need(sp.factor(1 - det).is_positive is True, "the determinant may be 1")
    return refuted(
        "X± turns twice in a period: it is not in Ω_NS, and det Φ' would be "
        "((|F cos θ| - f)/(|F cos θ| + f))² < 1; the eigenvalues are not reciprocal",
        "Corollary 3.4 of the paper, a = |F cos θ| - f > 0.",
    )


@claim("thm:saddlecenter", Kind.STEP, stated="∂X'(0+)/∂θ = -F cos θ/ω - f/ω != 0 at π/2")
def regular_dependence() -> Verdict:
    """(c) The initial velocity depends regularly on θ at π/2."""
    F, f, w = symbols("F f omega")
    theta = sp.Symbol("theta", real=True)
    start = -F / w * sp.sin(theta) - f * theta / w
    slope = sp.diff(start, theta).subs(theta, sp.pi / 2)
    identity("the derivative at π/2", slope, -f / w)
    return confirmed("-f/ω there", "Differentiated by sympy.")


@claim("eq:saddle-asymp", Kind.FORMULA, stated="multipliers 1 ± c sqrt μ + O(μ)")
def multipliers_of_a_fold() -> Verdict:
    """(c) At a saddle-center the multipliers of the saddle are 1 ± c sqrt μ + O(μ)."""
    mu = symbols("mu")
    x = -sp.sqrt(mu)  # (x, y) -> (x + y', y'), y' = y + μ - x²: area preserving, a generic fold
    trace = 2 - 2 * x
    outer = (trace + sp.sqrt(trace**2 - 4)) / 2
    first = sp.limit((outer - 1) / mu ** sp.Rational(1, 4), mu, 0, "+")
    identity("the outer multiplier is 1 + sqrt 2 μ^(1/4) + ..", first, sp.sqrt(2))
    S, rho, nu = symbols("S rho nu")
    k = 2 * sp.pi**2 * S / (rho + 2 * S)
    slope = sp.diff((2 - k) ** 2 - 2, S).subs(S, 0)
    identity("trace of the symmetric orbits", slope, -8 * sp.pi**2 / rho)
    size = sp.limit(sp.sqrt(1 - (1 - sp.pi * nu / 2) ** 2) / sp.sqrt(nu), nu, 0, "+")
    identity("|S| = sqrt(πν) + .., ν = 2/π - f/F", size, sp.sqrt(sp.pi))
    return corrected(
        "1 ± c ν^(1/4) + O(ν^(1/2)), and exp(±i c ν^(1/4)): fixed points part like the square root "
        "of the parameter, traces with them, multipliers like the root of that. For the symmetric "
        "orbits ν = 2/π - f/F, c = 2π sqrt(2/ρ) π^(1/4), ρ = Rω²/F",
        "A generic area-preserving fold, and trace Φ' = 2 ∓ 8π² sqrt(πν)/ρ + O(ν), by sympy.",
        proof="periodic.md#the-saddle-center-of-the-symmetric-orbits",
    )


@claim("eq:ellipt-asymp", Kind.FORMULA, stated="θ*(μ) = c̃ sqrt μ + O(μ)")
def rotation_at_a_fold() -> Verdict:
    """(c) On the elliptic branch θ* = c̃ sqrt μ + O(μ)."""
    mu = symbols("mu")
    trace = 2 - 2 * sp.sqrt(mu)
    square = sp.limit((2 - trace) / sp.sqrt(mu), mu, 0, "+")  # θ*² = 2 - trace + ..
    identity("θ*² = 2 sqrt μ + ..", square, 2)
    angle = sp.limit(sp.acos(trace / 2) / mu ** sp.Rational(1, 4), mu, 0, "+")
    identity("θ* = sqrt 2 μ^(1/4) + ..", angle, sp.sqrt(2))
    return corrected(
        "θ* = c̃ μ^(1/4) + O(μ^(1/2)) at a generic fold, and at that of the symmetric orbits",
        "trace = 2cos θ* for the map of fold.multipliers-of-a-fold.",
    )


@claim("thm:saddlecenter", Kind.STEP, stated="tr = 2 - a sqrt μ - .., with a = c̃² > 0")
def trace_and_rotation() -> Verdict:
    """(c) θ* = c̃ sqrt μ forces tr Φ' = 2 - a sqrt μ - bμ with a = c̃² > 0."""
    mu, c = symbols("mu c")
    trace = 2 * sp.cos(c * sp.sqrt(mu))
    half = sp.limit((trace - 2) / sp.sqrt(mu), mu, 0, "+")
    whole = sp.limit((trace - 2) / mu, mu, 0, "+")
    identity("no term in sqrt μ", half, 0)
    identity("the term in μ", whole, -(c**2))
    return refuted(
        "2 cos(c̃ sqrt μ) = 2 - c̃² μ + ..: then a = 0 and b = c̃², and the contradiction that the "
        "Jordan block rests on is not there; with θ* = c̃ μ^(1/4) it would be",
        "Limits by sympy.",
    )


@claim("thm:saddlecenter", Kind.STEP, stated="tr Φ'(P*; 0) = 2 by continuity from both branches")
def trace_at_the_fold() -> Verdict:
    """(c) At the collision both multipliers are 1, with a Jordan block."""
    rho = symbols("rho")
    S = sp.Symbol("S", real=True)
    kappa = 2 * sp.pi * S / (rho + 2 * S)
    impact, flight = sp.Matrix([[-1, 0], [kappa, -1]]), sp.Matrix([[1, sp.pi], [0, 1]])
    half = (-1) * impact * flight  # and the reflection, which is -1
    at_fold = half.subs(S, 0) ** 2
    need(same(at_fold, sp.Matrix([[1, 2 * sp.pi], [0, 1]])), "Φ' at S = 0 is another matrix")
    need(differs(at_fold[0, 1], sp.Integer(0)), "it is the identity")
    return corrected(
        "true at the saddle-center that exists, f = 2F/π: there Φ' is conjugate to ((1, 2π), (0, "
        "1)), in units F = ω = 1. The proof given assumes the multipliers it is to find",
        "At S = 0 a hit happens at cos ωt = 0, its saltation is -1: Φ' is two flights of T/2.",
        proof="periodic.md#the-saddle-center-of-the-symmetric-orbits",
    )


@claim("ssec:periodic-saddle", Kind.THEOREM, stated="non-degenerate saddle-center at f_sc")
def saddle_center_of_orbits() -> Verdict:
    """Two T-periodic orbits, a saddle and an elliptic one, collide in a saddle-center."""
    with precisely():
        found = []
        for sign in (1, -1):
            orbit = symmetric(interval.ball(NEAR), Ball(2), sign)
            need(orbit.least_speed() > 0, "the orbit may stop")
            found.append(orbit.trace())
        need(-2 < found[0] < 2 < found[1], "the types are others")
        words = [between(trace, 5) for trace in found]
    claimed = stored("symmetric.json").claims["saddle_center"]
    return corrected(
        f"at f = 2F/π, in {pair(claimed)} at F = 1: two symmetric orbits that hit each wall once a "
        f"period and never stop. At (1, 1, 2, 63/100) their traces are {words[0]} and {words[1]}",
        "Closed form in balls (cap.one_one.closed_form), and the stored certificate.",
        certificate="symmetric.json",
        proof="periodic.md#the-saddle-center-of-the-symmetric-orbits",
    )


@claim("ssec:intro-mixed", Kind.THEOREM, stated="the equation has zero, one or two solutions")
def solutions_and_orbits() -> Verdict:
    """The symmetric orbits with one hit and one turn per half-period number zero, one or two, and
    coalesce at f_sc: this corrects GKR2019.
    """
    pitchfork = stored("pitchfork.json").claims["f"]
    centre = stored("symmetric.json").claims["saddle_center"]
    need(pitchfork.upper < centre.lower, "the order of the bifurcations is another")
    return refuted(
        "these numbers count roots, not orbits. What the orbits with one hit of each wall do, at "
        f"the paper's F, ω, R: a pair is born in a pitchfork at f in {pair(pitchfork)}, and the "
        "symmetric ones meet in a saddle-center at 2F/π",
        "Stored certificates pitchfork.json, branch.json and symmetric.json.",
        certificate="pitchfork.json",
    )
