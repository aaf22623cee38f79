"""Section 7: the proof of Proposition 7.3 above the impulse bound."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import formula, identity, symbols
from cap.audit.means.balls import above, between, pair, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import States, at
from cap.audit.means.paper_equation import Equation
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, refuted
from cap.sets import interval

ABOVE = Equation(Fraction(13, 20), Fraction(2))  # f = 0.65 > 2/π at the paper's F, ω, R


@claim("prop:Omdissip-flag", Kind.STEP, stated="Proposition 4.4 excludes orbits for f > f_imp")
def exclusion_by_the_proposition() -> Verdict:
    """For f > f_imp Proposition 4.4 excludes any non-sticking T-periodic orbit with the symmetric
    impact pattern.
    """
    with precisely():
        need(interval.ball(ABOVE.alpha) > 2 / interval.pi(), "f is below the impulse bound")
        found = [ABOVE.bisected(root) for root in ABOVE.roots()]
        need(len(found) == 2, "there are not two roots")
        words = " and ".join(between(theta, 5) for theta in found)
    return refuted(
        "it is about f < f_imp only; above, the equation goes on having roots: two at (1, 1, 2, "
        f"0.65), {words}. What excludes orbits is the impulse bound",
        "All roots of eq:theta-eq at f = 0.65 in balls.",
    )


@claim("prop:Omdissip-flag", Kind.STEP, stated="x'(T) - x'(0) = -f ∫ sgn x' ds, so ∫ sgn x' = 0")
def integrated_equation() -> Verdict:
    """Integrating over a period of a T-periodic orbit gives ∫ sgn x' ds = 0."""
    claims = stored("elliptic.json").claims
    first, second = claims["hit_times"]
    with precisely():
        leftwards = interval.ball(second.lower - first.upper)
        most = interval.ball(second.upper - first.lower)
        balance = 2 * interval.pi() - 2 * interval.hull(leftwards, most)
        need(balance > 1, "the integral may vanish")
        words = between(balance, 6)
    return refuted(
        f"x' jumps at hits, by -2x'(t-): at P* ∫ sgn x' ds is in {words}",
        f"P* moves left between its hits at {pair(first, 6)} and {pair(second, 6)}, right else: "
        "stored certificate.",
        certificate="elliptic.json",
    )


@claim("prop:Omdissip-flag", Kind.CONSISTENCY, stated="4F/ω over a half-period, friction fT")
def impulses() -> Verdict:
    """The forcing impulse 4F/ω over a half-period must balance fT over the same half-period."""
    t, F, w = symbols("t F omega")
    half = sp.integrate(F * sp.cos(w * t), (t, -sp.pi / (2 * w), sp.pi / (2 * w)))
    return formula(
        sp.simplify(half),
        4 * F / w,
        "Integrated by sympy. 4F/ω belongs to a whole period, as fT does; Remark 4.5 has 2F/ω and "
        "πf/ω for a half. The bound f <= 2F/π is the same.",
        "2F/ω over a half-period, 4F/ω over a period",
    )


@claim("prop:Omdissip-flag", Kind.STEP, stated="at least 2N hits and a path 2NR in N periods")
def path_length() -> Verdict:
    """A never-stopping orbit has at least 2N wall hits, hence a path of at least 2NR, in N
    periods.
    """
    wide = at(l="-1000", r="1000", f="13/20")
    orbits = States("-900", "20").follow(1, wide)
    need(orbits.words == (), "it hits a wall", words=orbits.words)
    with interval.workprec(100):
        way = orbits.state[0] + 900
        need(way < 2 * 2000, "the path is as long as stated")
        words = between(way, 2)
    return refuted(
        "not if the walls are far apart or the mass is slow: with R = 2000, f = 0.65, F = ω = 1 "
        f"the mass from x = -900 with v = 20 meets no wall in a period, and moves {words} only",
        "Followed in balls.",
    )


@claim("prop:Omdissip-flag", Kind.FORMULA, stated="2M + MωNT = 2M(1 + Nπ)")
def forcing_integral() -> Verdict:
    """|∫ x' cos ωs ds| <= 2M + Mω NT = 2M(1 + Nπ)."""
    M, N, w = symbols("M N omega")
    s, x = sp.Symbol("s", real=True), sp.Function("x")
    product = x(s) * sp.cos(w * s)
    by_parts = sp.diff(x(s), s) * sp.cos(w * s) - sp.diff(product, s) - w * x(s) * sp.sin(w * s)
    identity("by parts", by_parts)
    identity("the bound", 2 * M + M * w * N * 2 * sp.pi / w, 2 * M * (1 + N * sp.pi))
    return confirmed("true, M = max(|l|, |r|)", "By sympy.")


@claim("prop:Omdissip-flag", Kind.INEQUALITY, stated="2πMF - 2fR < 0 for f > f_imp, R >= 1")
def sign_of_the_coefficient() -> Verdict:
    """For f > 2F/π and R >= 1 the coefficient 2πMF - 2fR is negative."""
    F, f, R = symbols("F f R")
    M = R / 2  # the least possible max(|l|, |r|)
    needed = sp.solve(2 * sp.pi * M * F - 2 * f * R, f)[0]
    identity("it needs f > πF/2", needed, sp.pi * F / 2)
    with precisely():
        need(interval.pi() / 2 > 1, "π/2 may be below 1")
    return refuted(
        "it is positive for all f < F: M = max(|l|, |r|) >= R/2, so it would need f > πF/2 > F. "
        "The energy argument excludes nothing",
        "Solved by sympy; π/2 > 1 in balls.",
    )


@claim("prop:Omdissip-flag", Kind.THEOREM, stated="above the bound every orbit enters Ω_dissip")
def eventual_entry() -> Verdict:
    """For f > 2F/π every forward orbit visits Ω_dissip^[0,T] infinitely often."""
    F, f, w, u = symbols("F f omega u")
    loss = f * 2 * sp.pi / w - 4 * F / w
    periods = sp.solve(u - sp.Symbol("n") * loss, sp.Symbol("n"))[0]
    identity("periods until a stop", periods, u * w / (2 * sp.pi * f - 4 * F))
    found = stored("impulse-1.json")
    p, claims = found.parameters, found.claims
    need(p["F"] == p["omega"] == 1 and claims["margin"].lower > 0, "f is not above the bound")
    return corrected(
        "true, by another argument: the speed falls by at least fT - 4F/ω > 0 in each period "
        "without a stop, so every orbit stops within about uω/(2πf - 4F) periods, again and again; "
        "Ω_NS is empty and Ω_dissip is all of X, hence forward invariant. Explicitly, at F = ω = 1 "
        f"and f = {p['f']} it rests within any time longer than {above(claims['delay'])} + "
        f"{above(claims['delay_per_speed'])} |v|",
        "u' = sgn(x') F cos ωt - f for u = |x'|, continuous through hits; theorem impulse.",
        certificate="impulse-1.json",
        proof="periodic.md#the-impulse-bound",
    )


@claim("rem:fsc-vs-fimp", Kind.THEOREM, stated="f_imp = 2F/π, regardless of the impact pattern")
def sharpness_of_the_bound() -> Verdict:
    """2F/π is the bound for all impact patterns, and no better one holds for all gaps."""
    claims = stored("impulse-1.json").claims
    theta = sp.Symbol("theta", real=True)
    speed = sp.sin(theta) - 2 * theta / sp.pi  # at f = 2F/π, less the mean speed R ω/π
    identity("it is odd", speed.subs(theta, -theta), -speed)
    identity("it vanishes at the hits", speed.subs(theta, sp.pi / 2), 0)
    identity("its law of motion", sp.diff(speed, theta), sp.cos(theta) - 2 / sp.pi)
    return confirmed(
        "and it is sharp: for f = 2F/π and walls farther apart than "
        f"{above(claims['gap'], 6)} F/ω² a T-periodic orbit with one hit of each wall "
        "never stops",
        "The orbit in closed form, by sympy; theorem impulse.",
        certificate="impulse-1.json",
    )


@claim("prop:Omdissip-flag", Kind.FORMULA, stated="E(NT) <= E(0) + 2MF + (2πMF - 2fR) N")
def combined_energy() -> Verdict:
    """The two integrals combine to E(NT) <= E(0) + 2MF + (2πMF - 2fR) N."""
    E, F, f, M, N, R = symbols("E F f M N R")
    combined = E + F * 2 * M * (1 + N * sp.pi) - f * 2 * N * R
    stated = E + 2 * M * F + (2 * sp.pi * M * F - 2 * f * R) * N
    identity("the sum", combined, stated)
    return confirmed(
        "they do; but the path 2NR that goes in is not there (impulse.path-length)",
        "Expanded by sympy.",
    )
