"""Section 8: what replaces the island."""

from fractions import Fraction

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words


def _certified_contraction() -> Fraction:
    """Return the factor with which an ellipse around P(1/1000, 1/1000) is mapped into itself."""
    factor: Fraction = stored("persistence.json").claims["basin"]["contraction"]
    return factor


def small_neighbourhoods() -> Words:
    factor = _certified_contraction()
    need(factor < 1, "the ellipse is not contracted")
    return {"factor": factor}


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
