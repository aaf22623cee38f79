"""Section 8: what replaces the island."""

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.stored import stored
from cap.audit.steps import Words


def any_positive_value() -> Words:
    claims = stored("persistence.json").claims["range"]
    F, f, w, R, mu = symbols("F f omega R mu")
    bound = sp.solve(4 * F / w - f * 2 * sp.pi / w - mu * 2 * R, mu)[0]
    identity("the largest μ", bound, (2 * F - sp.pi * f) / (w * R))
    return {"epsilon": claims["epsilon"][-1], "mu": claims["mu"][-1]}
