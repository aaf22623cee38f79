"""Section 4.4: Φ' along the branch, Table 1, and the approach to the impulse bound."""

from fractions import Fraction
from typing import NamedTuple

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import enclosure, formula, identity, same, symbols
from cap.audit.means.balls import between, number, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.linear import Event, derivative
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.claims.saltation import hit
from cap.audit.verdict import Verdict, confirmed, corrected, refuted, vacuous
from cap.one_one.closed_form import symmetric
from cap.proofs.census import Member, census
from cap.sets import interval
from cap.sets.interval import Ball

FRICTION, GAP = Fraction(2, 5), Fraction(2)  # f and R of Figure 3, with ω = 1


@claim("prop:DPhi-structure", Kind.THEOREM, stated="Φ' on the elliptic branch X₊, μ > 0")
def elliptic_branch() -> Verdict:
    """On the elliptic branch X₊ that is born at f_sc, Φ' is symplectic with trace 2 cos θ*(μ)."""
    F, f, y = symbols("F f y")
    need(same(sp.limit(F * sp.sin(y), y, 0), sp.Integer(0)), "|F cos θ| has another limit")
    need((f - sp.limit(F * sp.sin(y), y, 0)).is_positive is True, "|F cos θ| > f near the fold")
    return vacuous(
        "there is no such branch (fold.colliding-orbits). What exists: the symmetric orbit `plus` "
        "on f < 2F/π, with trace (2 - k)² - 2, k = 2π²S/(ρ + 2S), and the asymmetric pair, whose "
        "trace and least speed are enclosed for all its f",
        "Near θ = π/2 there is |F cos θ| < f. For what exists: symmetric.json, branch.json.",
        proof="periodic.md#no-orbit-has-the-pattern",
    )


@claim("eq:DPhi-trace", Kind.FORMULA, stated="tr Φ'(0+) = 2 - O(μ)")
def trace_near_the_fold() -> Verdict:
    """Near the fold the trace of the elliptic orbit is 2 - O(μ)."""
    S, rho, nu = symbols("S rho nu")
    k = 2 * sp.pi**2 * S / (rho + 2 * S)
    trace = ((2 - k) ** 2 - 2).subs(S, sp.sqrt(1 - (1 - sp.pi * nu / 2) ** 2))
    leading = sp.limit((trace - 2) / sp.sqrt(nu), nu, 0, "+")
    identity("the leading term", leading, -8 * sp.pi**2 * sp.sqrt(sp.pi) / rho)
    return corrected(
        "2 - 8π² sqrt(πν)/ρ + O(ν), ν = 2/π - f/F, at the saddle-center that exists: of the order "
        "of the square root of the distance",
        "The trace of the symmetric orbit in closed form, expanded by sympy.",
    )


@claim("prop:DPhi-structure", Kind.STEP, stated="at trace -2 the orbit becomes flip-unstable")
def flip() -> Verdict:
    """Where the trace reaches -2 first, at μ_flip, the orbit becomes flip-unstable."""
    S, rho = symbols("S rho")
    k = 2 * sp.pi**2 * S / (rho + 2 * S)
    trace = (2 - k) ** 2 - 2
    identity("trace + 2 is a square", trace + 2, (2 - k) ** 2)
    at = sp.solve(k - 2, S)[0]
    identity("where it is -2", at, rho / (sp.pi**2 - 2))
    slope = sp.diff(trace, S).subs(S, at)
    identity("the trace touches -2", slope, 0)
    return corrected(
        "not for symmetric orbits: their trace (2 - k)² - 2 touches -2 where S = ρ/(π² - 2), Φ' = "
        "-1 there, and they are elliptic on both sides. They lose stability at k = 4, trace +2, to "
        "the pair (pitchfork)",
        "The trace + 2 is the square of the trace of the half-period map, by sympy.",
    )


@claim("tab:jacobian", Kind.FORMULA, stated="2(F cos ωt* - f sgn v)/v(t*-) at the right wall")
def table_right_wall() -> Verdict:
    """Table 1: the entry of a hit of the right wall is 2(F cos ωt* - f sgn v)/v(t*-)."""
    M, u, c, f = hit(1)
    return formula(
        M[1, 0],
        2 * (c - f) / u,
        "From first principles (cap.audit.means.linear): friction changes sides and cancels. "
        "Corollary 3.4 has no f either, but the other sign; Section 10 has it right.",
        "2F cos ωt*/v(t*-)",
    )


@claim("tab:jacobian", Kind.FORMULA, stated="2(F cos ωt* - f sgn v)/v(t*-) at the left wall")
def table_left_wall() -> Verdict:
    """Table 1: the entry of a hit of the left wall is 2(F cos ωt* - f sgn v)/v(t*-)."""
    M, u, c, f = hit(-1)
    return formula(
        M[1, 0],
        2 * (c + f) / (-u),
        "From first principles, v(t*-) = -u.",
        "2F cos ωt*/v(t*-)",
    )


@claim("tab:jacobian", Kind.FORMULA, stated="determinant +1 of both hits")
def table_determinants() -> Verdict:
    """Table 1: both wall hits have determinant +1."""
    need(all(same(hit(side)[0].det(), sp.Integer(1)) for side in (1, -1)), "another determinant")
    return confirmed("+1", "From first principles; it does not depend on the lower left entry.")


@claim("tab:jacobian", Kind.FORMULA, stated="diag(1, (|F cos ωt*| - f)/(|F cos ωt*| + f))")
def table_turn() -> Verdict:
    """Table 1: a turning point has diag(1, (|F cos ωt*| - f)/(|F cos ωt*| + f)), and the incoming
    deceleration |F cos ωt*| + f and the outgoing acceleration |F cos ωt*| - f give the ratio.
    """
    a, f = symbols("a f")
    size = a + f
    for sign in (1, -1):  # of F cos ωt*; the velocity had the other one
        M = derivative(Event(sp.S.Zero, sign * (size + f), sp.S.Zero, sign * (size - f)), False)
        need(same(M, sp.diag(1, (size - f) / (size + f))), "the matrix is another")
    return confirmed("as stated, for both directions", "From first principles.")


@claim("ssec:periodic-linearization", Kind.FORMULA, stated="F_imp = πf/(2ω)")
def impulse_bound_in_f() -> Verdict:
    """The impulse bound in F is F_imp = πf/(2ω)."""
    F, f, w = symbols("F f omega")
    bound = sp.solve(2 * F / sp.pi - f, F)[0]
    return formula(
        bound, sp.pi * f / (2 * w), "f_imp = 2F/π solved for F; the same for ω = 1.", "πf/2"
    )


@claim("ssec:periodic-linearization", Kind.NUMBER, stated="0.628")
def value_of_the_bound() -> Verdict:
    """At f = 0.4, ω = 1 the bound is F_imp ≈ 0.628."""
    with precisely():
        value = interval.pi() * interval.ball(FRICTION) / 2
        return number("0.628", value, "π/5 in balls.")


@claim("ssec:periodic-linearization", Kind.STEP, stated="from ∮ cos ωt dt = 0 and friction")
def proof_of_the_bound() -> Verdict:
    """The impulse bound follows by integrating eq:model over a period, with ∮ cos ωt dt = 0."""
    t = sp.Symbol("t", real=True)
    whole = sp.integrate(sp.cos(t), (t, 0, 2 * sp.pi))
    best = sp.integrate(sp.Abs(sp.cos(t)), (t, 0, 2 * sp.pi))
    need(whole == 0 and best == 4, "the integrals are others")
    return corrected(
        "x' jumps at hits, so the integral of x'' says little; the bound follows from the speed u "
        "= |x'|, which does not jump: u' = sgn(x') F cos ωt - f, and |∫ sgn(x') cos ωt dt| <= 4/ω",
        "∫ cos = 0, ∫ |cos| = 4 over a period, by sympy.",
        proof="periodic.md#the-impulse-bound",
    )


@claim("ssec:periodic-linearization", Kind.THEOREM, stated="Ω_dissip = X for F < F_imp")
def below_the_bound() -> Verdict:
    """For F < F_imp no T-periodic non-sticking orbit exists, every datum enters Ω_dissip, and Ω_NS
    is at most a null set.
    """
    with precisely():
        F, f = interval.ball(Fraction(62, 100)), interval.ball(FRICTION)
        loss = 2 * interval.pi() * f - 4 * F
        need(loss > 0, "the speed may grow")
        words = between(loss, 5)
    return confirmed(
        "true, and Ω_NS is empty: every orbit stops, again and again. At F = 0.62 the speed falls "
        f"by at least {words} in a period without a stop",
        "4F/ω - fT < 0, in balls.",
        proof="periodic.md#the-impulse-bound",
    )


class Along(NamedTuple):
    """An elliptic orbit at a value of F, with f = 2/5, R = 2, ω = 1."""

    F: Fraction
    orbit: Member


def elliptic_at(F: Fraction) -> Along:
    """Return the elliptic orbit with one hit of each wall, which is one only or one pair."""
    found = [each for each in census(FRICTION / F, GAP / F) if each.kind == "elliptic"]
    need(len(found) == 1, f"there is not one elliptic orbit at F = {F}", found=len(found))
    return Along(F, found[0])


@claim("fig:impulse-bound", Kind.THEOREM, stated="the orbit predicted by Theorem 4.2 is present")
def predicted_orbit() -> Verdict:
    """At F = 0.95 and 0.85 the elliptic orbit predicted by Theorem 4.2 is present."""
    found = [elliptic_at(Fraction(n, 100)) for n in (95, 85)]
    need(all(each.orbit.least_speed > 0 for each in found), "an orbit may stop")
    names = [each.orbit.name for each in found]
    need(names == ["pair", "plus"], "the orbits are others", names=names)
    return corrected(
        "an elliptic orbit is present at both, but Theorem 4.2 predicts none: these never turn. At "
        "0.95 it is one of the asymmetric pair, at 0.85 the symmetric orbit: not the same branch",
        "All orbits with one hit of each wall at (ω, R, f) = (1, 2, 2/5), by cap.proofs.census in "
        "balls.",
    )


@claim("fig:impulse-bound", Kind.THEOREM, stated="it persists, its rotation number varies smoothly")
def smooth_rotation_number() -> Verdict:
    """The elliptic orbit persists as F falls, and its rotation number varies smoothly."""
    F, f, R = symbols("F f R")
    S = 2 * (R / F) / (sp.pi**2 - 4)  # of the pitchfork
    born = sp.solve((sp.pi * f / (2 * F)) ** 2 + S**2 - 1, F)
    point = {f: FRICTION, R: GAP}
    with precisely():
        at = enclosure(born[0], point)
        before, after = (elliptic_at(Fraction(n, 1000)).orbit for n in (928, 926))
        need(Fraction(926, 1000).numerator < 1000 * at < 928, "the pitchfork is elsewhere", at=at)
        need(before.name == "pair" and after.name == "plus", "the orbits are others")
        traces = [between(each.trace, 3) for each in (before, after)]
        words = between(at, 6)
    return corrected(
        f"at F in {words} the pair to which P* belongs merges with the symmetric orbit in a "
        "pitchfork, and the symmetric orbit takes over as the elliptic one; the rotation number is "
        f"near 0 on both sides (traces {traces[0]} at F = 0.928, {traces[1]} at 0.926)",
        "The birth of the pair in closed form, solved for F; cap.proofs.census in balls.",
    )


@claim("fig:impulse-bound", Kind.NUMBER, stated="1/4, 1/3, 1/2")
def resonances_on_the_way() -> Verdict:
    """On the way from F = 1 to F_imp the rotation number passes through 1/4, 1/3 and 1/2."""
    with precisely():
        first, last = (elliptic_at(Fraction(n, 1000)).orbit for n in (1000, 940))
        need(first.trace < 0 < last.trace, "the trace does not pass 0 on the pair")
        half = [_half_trace(Fraction(n, 1000)) for n in (900, 630)]
        need(half[0] < -1 and half[1] > 1, "the half trace does not pass -1, 0 and 1", half=half)
    return confirmed(
        "1/4 on the pair already; on the symmetric orbit, whose half-period map has a trace "
        "growing from -2 to 2, all three, 1/4 and 1/3 twice",
        "Signs of traces in balls: 0 for 1/4; the half trace passes -1 and 1 (1/3), -sqrt 2 and "
        "sqrt 2 (1/4), 0 (1/2).",
    )


def _half_trace(F: Fraction) -> Ball:
    """Return the trace 2 - k of the half-period map at the symmetric orbit `plus`."""
    orbit = symmetric(interval.ball(FRICTION / F), interval.ball(GAP / F), 1)
    need(orbit.least_speed() > 0, "the orbit may stop")
    k = 2 * interval.pi() ** 2 * orbit.S / (orbit.rho + 2 * orbit.S)
    half: Ball = 2 - k
    return half


@claim("ssec:periodic-linearization", Kind.CONSISTENCY, stated="det Φ' is the product")
def determinant_is_the_product() -> Verdict:
    """The determinant of Φ' is exactly the product of the per-event determinants."""
    a, b, c, d, k = symbols("a b c d k")
    product = sp.Matrix([[-1, 0], [k, -1]]) * sp.Matrix([[1, d], [0, 1]]) * sp.diag(1, a)
    need(same(product.det(), a), "determinants do not multiply")
    need(same(sp.diag(1, b).det() * sp.diag(1, c).det(), b * c), "determinants do not multiply")
    return confirmed("as stated", "Multiplicativity of determinants.")


@claim("ssec:periodic-linearization", Kind.THEOREM, stated="Theorem 4.2 guarantees the orbit")
def closed_forms_for_kam() -> Verdict:
    """The closed forms of this section are those at whose elliptic branch KAM theory is applied."""
    orbit = elliptic_at(Fraction(1)).orbit
    need(orbit.name == "pair" and orbit.least_speed > 0, "P* is another orbit")
    return refuted(
        "P* of Section 10, to which Section 5 is applied, never turns and is not symmetric: it is "
        f"one of the asymmetric pair with one hit of each wall, trace {between(orbit.trace, 6)}. "
        "That family has a closed form too, in one parameter (cap.one_one.closed_form)",
        "cap.proofs.census at (1, 1, 2, 2/5), in balls.",
    )
