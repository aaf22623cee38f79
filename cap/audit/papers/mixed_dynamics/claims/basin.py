"""Section 8: what replaces the island."""

from fractions import Fraction

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.balls import precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.sets import interval


def _certified_contraction() -> Fraction:
    """Return the factor with which an ellipse around P(1/1000, 1/1000) is mapped into itself."""
    factor: Fraction = stored("persistence.json").claims["basin"]["contraction"]
    return factor


def small_neighbourhoods() -> Words:
    factor = _certified_contraction()
    need(factor < 1, "the ellipse is not contracted")
    return {"factor": factor}


def replacement_of_the_island() -> Words:
    sink, rectangle = stored("periodic-12.json"), stored("persistence.json").claims["range"]
    epsilon, mu = 1 - sink.parameters["e"], sink.parameters["mu"]
    need(0 < epsilon <= rectangle["epsilon"][-1], "P(ε, μ) is not certified at this ε")
    need(0 < mu <= rectangle["mu"][-1], "P(ε, μ) is not certified at this μ")
    times = sink.claims["event_times"]
    with precisely():
        gap = times[2].lower - times[0].upper  # of the first two hits of the right wall
        need(interval.ball(gap) > 2 * interval.pi(), "the orbit may have the period T")
    x, v = sink.claims["x"], sink.claims["v"]
    return {
        "epsilon": epsilon,
        "mu": mu,
        "lower": format(float(x.lower), ".4f"),
        "lower_2": format(float(v.lower), ".4f"),
        "type": sink.claims["type"],
    }


def no_invariant_curve() -> None:
    need(_certified_contraction() < 1, "the ellipse is not contracted")


def hartman_grobman() -> None:
    need(_certified_contraction() < 1, "the ellipse is not contracted")


def any_positive_value() -> Words:
    claims = stored("persistence.json").claims["range"]
    F, f, w, R, mu = symbols("F f omega R mu")
    bound = sp.solve(4 * F / w - f * 2 * sp.pi / w - mu * 2 * R, mu)[0]
    identity("the largest μ", bound, (2 * F - sp.pi * f) / (w * R))
    return {"epsilon": claims["epsilon"][-1], "mu": claims["mu"][-1]}
