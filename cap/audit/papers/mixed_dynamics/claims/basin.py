"""Section 8: what replaces the island."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, reals, same, symbols
from cap.audit.means.balls import precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, refuted
from cap.sets import interval


def _certified_contraction() -> Fraction:
    """Return the factor with which an ellipse around P(1/1000, 1/1000) is mapped into itself."""
    factor: Fraction = stored("persistence.json").claims["basin"]["contraction"]
    return factor


@claim("cor:island-basin", Kind.THEOREM, stated="small neighbourhoods lie in the basin")
def small_neighbourhoods() -> Verdict:
    """Every sufficiently small neighbourhood of P(ε, μ) lies in its basin of attraction."""
    factor = _certified_contraction()
    need(factor < 1, "the ellipse is not contracted")
    return confirmed(
        "true; at (ε, μ) = (1/1000, 1/1000) an explicit ellipse is certified, mapped into itself "
        f"with the factor {factor}",
        "Asymptotic stability; stored certificate.",
        certificate="persistence.json",
    )


@claim("cor:island-basin", Kind.THEOREM, stated="the island is replaced by a single open basin")
def replacement_of_the_island() -> Verdict:
    """The family of invariant curves around P* is replaced by a single open basin."""
    sink, rectangle = stored("periodic-12.json"), stored("persistence.json").claims["range"]
    epsilon, mu = 1 - sink.parameters["e"], sink.parameters["mu"]
    need(0 < epsilon <= rectangle["epsilon"][-1], "P(ε, μ) is not certified at this ε")
    need(0 < mu <= rectangle["mu"][-1], "P(ε, μ) is not certified at this μ")
    times = sink.claims["event_times"]
    with precisely():
        gap = times[2].lower - times[0].upper  # of the first two hits of the right wall
        need(interval.ball(gap) > 2 * interval.pi(), "the orbit may have the period T")
    x, v = sink.claims["x"], sink.claims["v"]
    return refuted(
        f"at (ε, μ) = ({epsilon}, {mu}) the orbit of P(ε, μ) is a sink, and another sink, of "
        f"period 7T through ({float(x.lower):.4f}, {float(v.lower):.4f}), has a basin of its own: "
        "the resonance 2/7 of the island becomes it. No invariant curve is left near P(ε, μ), and "
        "it has an open basin; but the basin does not cover the island",
        f"Both are certified: this one as an orbit of period 7T, of type {sink.claims['type']}, "
        "whose first two hits of the right wall are more than T apart, so that its least period "
        "is 7T; P(ε, μ) for a rectangle of (ε, μ). That the orbit lies between invariant curves of "
        "(0, 0) is seen in floats.",
        certificate="periodic-12.json",
    )


@claim("cor:island-basin", Kind.STEP, stated="the discrete Lyapunov equation has a solution P")
def lyapunov_equation() -> Verdict:
    """Mᵀ P M - P = -I has a positive definite solution when |λ±| < 1."""
    r, c, s = reals("r c s")  # M = r times the rotation with c² + s² = 1
    M = r * sp.Matrix([[c, -s], [s, c]])
    P = sp.eye(2) / (1 - r**2)
    residue = (M.T * P * M - P + sp.eye(2)).applyfunc(sp.simplify).subs(s**2, 1 - c**2)
    need(
        same(residue.applyfunc(sp.simplify).subs(s**2, 1 - c**2), sp.zeros(2)), "it is no solution"
    )
    return confirmed(
        "true: P = Σ (Mᵀ)ⁿ Mⁿ; for M = r times a rotation it is 1/(1 - r²)", "By sympy."
    )


@claim("cor:island-basin", Kind.STEP, stated="no invariant closed curve but P(ε, μ) in U")
def no_invariant_curve() -> Verdict:
    """No closed curve in the basin is invariant, since forward orbits on it tend to P(ε, μ)."""
    need(_certified_contraction() < 1, "the ellipse is not contracted")
    return corrected(
        "true; the argument needs invariance in both directions: on an invariant curve in a basin "
        "that is contracted with a factor κ < 1 the largest distance d from P(ε, μ) would satisfy "
        "d <= κ d. (That forward orbits accumulate at P is no contradiction by itself.)",
        "For γ = Φ(γ) the maximum of the norm on γ is at most κ times itself; a norm and κ < 1 are "
        "certified for (ε, μ) = (1/1000, 1/1000).",
        certificate="persistence.json",
        proof="persistence.md#no-invariant-curve-in-a-basin",
    )


@claim("remark 8.4", Kind.WORDS, stated="shrinks the island at rate sqrt ε in radius")
def shrinking_of_the_island() -> Verdict:
    """Any viscosity, restitution defect or rounding error of order ε shrinks the apparent island at
    rate sqrt ε in radius.
    """
    eps, n = symbols("epsilon n")
    rate = (1 - eps) ** n
    first = sp.limit((1 - rate) / eps, eps, 0)
    half = sp.limit((1 - rate) / sp.sqrt(eps), eps, 0, "+")
    need(same(first, n) and half == 0, "the radius changes at another rate")
    return corrected(
        "distances from P(ε, 0) shrink by (1 - ε)^(n*) = 1 - n*ε + .. per period: linearly in ε; "
        "sqrt ρ may be meant. Nothing of the order sqrt ε is derived in the section",
        "|λ±| = sqrt ρ at μ = 0, expanded by sympy.",
    )


@claim("thm:persistence", Kind.STEP, stated="Step 5: Hartman-Grobman gives asymptotic stability")
def hartman_grobman() -> Verdict:
    """Step 5: asymptotic stability follows by the Hartman-Grobman theorem."""
    need(_certified_contraction() < 1, "the ellipse is not contracted")
    return confirmed(
        "true; simpler, in an adapted norm Φ contracts near a fixed point with |λ±| < 1",
        "Φ is analytic near P(ε, μ), see smoothness.smooth-near-the-orbit; such a norm is "
        "certified for (ε, μ) = (1/1000, 1/1000).",
        certificate="persistence.json",
        proof="persistence.md#no-invariant-curve-in-a-basin",
    )


@claim("sec:persistence", Kind.THEOREM, stated="for any positive value of either perturbation")
def any_positive_value() -> Verdict:
    """For any positive value of either perturbation every elliptic never-stopping orbit becomes
    asymptotically stable.
    """
    claims = stored("persistence.json").claims["range"]
    F, f, w, R, mu = symbols("F f omega R mu")
    bound = sp.solve(4 * F / w - f * 2 * sp.pi / w - mu * 2 * R, mu)[0]
    identity("the largest μ", bound, (2 * F - sp.pi * f) / (w * R))
    return refuted(
        "for small values, as Theorem 8.2 says; for μ > (2F - πf)/(ωR) no T-periodic orbit that "
        f"never stops exists. Certified: 0 <= ε <= {claims['epsilon'][-1]}, 0 <= μ <= "
        f"{claims['mu'][-1]}",
        "Gain and loss of speed over a period, solved by sympy.",
        certificate="persistence.json",
        proof="persistence.md#no-orbit-at-large-viscosity",
    )
