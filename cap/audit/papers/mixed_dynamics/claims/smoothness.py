"""Section 5.1: smoothness of Φ near never-stopping orbits."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means import block
from cap.audit.means.algebra import same, symbols
from cap.audit.means.balls import between, pair, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.claims.wellposed import velocity_jump
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.one_one.closed_form import symmetric
from cap.proofs.census import census
from cap.sets import interval
from cap.sets.interval import Ball

SMALL_BLOCK = Fraction(8, 10**9)


@claim("prop:smooth-NS", Kind.THEOREM, stated="Φ is C^∞ near P*")
def smooth_near_the_orbit() -> Verdict:
    """Near a never-stopping T-periodic orbit with transverse impacts Φ is C^∞."""
    t, x, v, b = sp.symbols("t x v b", real=True)
    G = x + v * t + b * t**2 / 2  # distance to the wall on a flight: G(t*) = 0
    need(same(sp.diff(G, t), v + b * t), "the derivative by t is not the velocity")
    return confirmed(
        "true, and Φ is real analytic: hit times are analytic by the implicit function theorem, as "
        "the velocity at a hit is not 0. It is tacitly assumed that no hit is at t = 0 or T",
        "∂G/∂t = x' != 0 at the hit; the rest is composition.",
        proof="kam.md#smoothness-and-openness",
    )


@claim("prop:smooth-NS", Kind.THEOREM, stated="hypothesis |F cos ωt*| > f at every hit")
def forcing_at_hits() -> Verdict:
    """Smoothness needs |F cos ωt*| > f at every wall hit."""
    plus = next(m for m in census(Fraction(3, 5), Fraction(2)) if m.name == "plus")
    need(plus.kind == "elliptic" and plus.least_speed > 0, "no elliptic never-stopping orbit")
    with precisely():
        alpha = interval.ball(Fraction(3, 5))
        orbit = symmetric(alpha, Ball(2), 1)
        force = [abs(cos) for _, cos in orbit.phases]
        need(all(each < alpha for each in force), "the forcing at a hit exceeds f")
        words = between(force[0], 6)
    return corrected(
        "not needed: at a hit with v != 0 friction does not decide anything. At (1, 1, 2, 3/5) the "
        f"symmetric elliptic orbit has |F cos ωt*| in {words} < f at both hits, never stops, and Φ "
        "is analytic near it",
        "cap.proofs.census and cap.one_one.closed_form in balls.",
    )


@claim("prop:smooth-NS", Kind.STEP, stated="‖perturbed - reference‖ < ε on all flights")
def uniform_closeness() -> Verdict:
    """Perturbed orbits are uniformly near the reference orbit on all of its free flights."""
    with interval.workprec(120):
        jumps = [velocity_jump(distance) for distance in (Fraction(1, 10**3), Fraction(1, 10**7))]
        need(all(jump > 1 for jump in jumps), "the velocities come together")
    return imprecise(
        "not between the two hit times: there one has bounced and the other not, and velocities "
        "differ by about 2|v|. What is used, |v| >= ε on all flights of both, is true",
        "In balls: orbits 2·10⁻³ and 2·10⁻⁷ apart at t = 0 have velocities more than 1 apart at "
        "the time of a hit (wellposed.continuous-dependence).",
    )


@claim("H1", Kind.STEP, stated="so the orbit lies in the open interior of Ω_NS")
def interior_of_the_set() -> Verdict:
    """(H1), hits with |F cos ωt*| > f and no stops, puts the orbit in the interior of Ω_NS."""
    saddle = stored("saddle.json").claims
    need(all(force.lower > 0 for force in saddle["hit_forcing"]), "|F cos ωt*| > f fails at a hit")
    need(saddle["least_speed"].lower > 0, "the orbit may stop")
    with interval.workprec(block.BITS):
        around = block.around_the_saddle(SMALL_BLOCK, 2 * SMALL_BLOCK)
        around.covers_itself()
        words = [event.word for event in block.followed(around.edge(-1), 3).events]
    need(any(word.startswith("turn") for word in words), "not all stop", events=words)
    return refuted(
        "neighbours of such an orbit do not stop in the first period, but later they may: the "
        f"saddle (x, v) in {pair(saddle['x'], 6)} × {pair(saddle['v'], 6)} satisfies (H1), and "
        "every neighbourhood of it contains states that stop. For P* it is true by its invariant "
        "curves",
        "A block of half-width 8·10⁻⁹ with a cone condition around the saddle (the proof is in "
        f"cap.audit.means.block), and all orbits from one of its edges: {', '.join(words)}.",
        certificate="saddle.json",
        proof="kam.md#smoothness-and-openness",
    )


@claim("remark 5.2", Kind.CONSISTENCY, stated="uniformly for μ in [μ₀, 0) for any μ₀ > 0")
def empty_interval() -> Verdict:
    """Smoothness holds uniformly for μ in [μ₀, 0), for any μ₀ > 0."""
    mu0 = symbols("mu0")
    need(sp.Interval.Ropen(mu0, 0) == sp.S.EmptySet, "the interval is not empty")
    return corrected(
        "[μ₀, 0) is empty for μ₀ > 0; what is meant is true for μ >= μ₀, while the orbit exists",
        "Sets by sympy; Proposition 5.1 at each μ, and compactness.",
    )


@claim("remark 5.2", Kind.STEP, stated="smoothness breaks down at μ = 0")
def smoothness_at_the_fold() -> Verdict:
    """At the saddle-center, where the implicit function theorem fails for the fixed point, the
    smoothness of Φ breaks down.
    """
    with precisely():
        ratio = 2 / interval.pi()
        lost = (1 - ratio * ratio).sqrt() - 1 + ratio * ratio.asin()
        least = Ball(2) / interval.pi() - lost
        need(least > 0, "the orbit may stop")
        words = between(least, 6)
    return refuted(
        "Φ is analytic there too: at the saddle-center that exists, f = 2F/π, the orbit never "
        f"stops (least speed in {words} at F = ω = 1, R = 2). What fails is that the fixed point "
        "is a smooth function of f",
        "Closed form of the symmetric orbit at S = 0 in balls.",
    )


@claim("H1", Kind.THEOREM, stated="|F cos ωt*| > f at the hits of P*")
def hypothesis_at_the_orbit() -> Verdict:
    """(H1) holds at the elliptic orbit of the paper."""
    claims = stored("elliptic.json").claims
    margins = [force.lower for force in claims["hit_forcing"]]
    need(min(margins) > 0, "|F cos ωt*| <= f at a hit")
    return confirmed(
        f"|F cos ωt*| - f is in {pair(claims['hit_forcing'][0], 6)} at the right hit and in "
        f"{pair(claims['hit_forcing'][1], 6)} at the left one; least speed in "
        f"{pair(claims['least_speed'], 6)}",
        "Stored certificate. (The clause is not needed: smoothness.forcing-at-hits.)",
        certificate="elliptic.json",
    )


@claim("H4", Kind.THEOREM, stated="P* is elliptic")
def ellipticity() -> Verdict:
    """(H4) holds at the elliptic orbit of the paper, with θ* in (0, π)."""
    claims = stored("elliptic.json").claims
    trace, angle = claims["trace"], claims["rotation_angle"]
    need(trace.lower > -2 and trace.upper < 2, "the trace is not in (-2, 2)")
    need(angle.lower > 0, "the angle is not positive in the orientation dx ∧ dv")
    return confirmed(
        f"trace in {pair(trace, 12)}, θ* in {pair(angle, 10)}, anticlockwise in the (x, v)-plane",
        "Stored certificate.",
        certificate="elliptic.json",
    )


@claim("H5", Kind.THEOREM, stated="kθ* not in 2πZ for k = 1, .., 4")
def no_resonance() -> Verdict:
    """(H5) holds at the elliptic orbit of the paper."""
    claims = stored("elliptic.json").claims
    distances = claims["resonance_distances"]
    need(all(each.lower > 0 for each in distances.values()), "a resonance is possible")
    need(set(distances) == {"0", "1/4", "1/3", "1/2"}, "a resonance is not considered")
    shown = ", ".join(f"{pair(each, 4)} from {name}" for name, each in distances.items())
    return confirmed(
        f"the rotation number is {shown}",
        "Stored certificate; by symmetry 2/3 and 3/4 are as far as 1/3 and 1/4 from 1 minus it.",
        certificate="elliptic.json",
    )


@claim("H2", Kind.CONSISTENCY, stated="(H2) and (H3) by Theorem 3.3 and Proposition 5.1")
def derived_hypotheses() -> Verdict:
    """(H2) symplecticity and (H3) smoothness follow from (H1)."""
    k, d = sp.symbols("k d", real=True)
    det = (sp.Matrix([[-1, 0], [k, -1]]) * sp.Matrix([[1, d], [0, 1]])).det()
    need(same(det, sp.Integer(1)), "the determinant is another")
    return confirmed(
        "they do, and without the clause of (H1) on F cos ωt*: Φ is analytic near P*, preserves "
        "dv ∧ dx, and is exact on a disk",
        "Proposition 5.1, and det Φ' = 1.",
        proof="kam.md#smoothness-and-openness",
    )
