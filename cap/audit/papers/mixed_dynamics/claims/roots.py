"""Section 4.2: the roots of the existence equation, as a statement about an equation."""

from fractions import Fraction

from cap.audit.means.algebra import enclosure, identity, symbols
from cap.audit.means.balls import between, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.equation import Equation, psi
from cap.audit.steps import Words
from cap.checker.kernel.shapes import Enclosure
from cap.sets import interval
from cap.sets.interval import Ball

PAPER_RHO = Fraction(2)
MONOTONE = (
    "Ψ' = Fπ cos θ - f(π - 2θ) > 0 on (0, π/2), as cos θ > 1 - 2θ/π there (cos is concave) and "
    "f < F; and Ψ(π - θ) = Ψ(θ)"
)


def _evenness() -> None:
    """Raise `NotProved` unless Ψ is even about π/2, and increasing on (0, π/2) for f < F."""
    value, theta, (F, f, _, _) = psi()
    identity("Ψ is even about π/2", value.subs(theta, sp.pi - theta), value)
    slope = sp.diff(value, theta)
    identity("Ψ'", slope, F * sp.pi * sp.cos(theta) - f * (sp.pi - 2 * theta))
    chord = 1 - 2 * theta / sp.pi
    at_ends = [sp.simplify((sp.cos(theta) - chord).subs(theta, end)) for end in (0, sp.pi / 2)]
    need(at_ends == [0, 0], "cos θ is not on its chord at the ends")
    identity("cos'' = -cos", sp.diff(sp.cos(theta), theta, 2), -sp.cos(theta))


def _inside(value: Ball, claimed: Enclosure) -> bool:
    low, high = interval.ball(claimed.lower), interval.ball(claimed.upper)
    return bool(low <= value) and bool(value <= high)


def one_critical_point() -> None:
    _evenness()


def number_of_roots() -> None:
    _evenness()
    value, theta, (F, f, R, w) = psi()
    middle = value.subs(theta, sp.pi / 2)
    identity("Ψ(π/2)", sp.diff(middle, f), sp.pi**2 / 4)
    end = value.subs(theta, 0)
    f_sc = 4 * (2 * F + R * w**2 - F * sp.pi) / sp.pi**2
    identity("Ψ(0) at f = 2F/π", end.subs(f, 2 * F / sp.pi), -(sp.pi**2) / 4 * f_sc)
    with precisely():
        counts = [len(Equation(Fraction(a), PAPER_RHO).roots()) for a in ("3/10", "2/5", "3/5")]
    need(counts == [0, 2, 2], "at the paper's R other numbers are found", counts=counts)


def branch_exists() -> Words:
    with precisely():
        equation = Equation(Fraction(2, 5), PAPER_RHO)
        found = [equation.bisected(root) for root in equation.roots()]
        need(len(found) == 2, "there are not two roots")
        need(all(abs(theta.cos()) < Fraction(2, 5).numerator / Ball(5) for theta in found), "turns")
        words = " and ".join(between(theta.cos(), 5) for theta in found)
    return {"words": words}


def universality() -> Words:
    S, rho = symbols("S rho")
    alpha = 2 / sp.pi * sp.sqrt(1 - S**2)
    value = sp.simplify(alpha.subs(S, 0))
    identity("the two symmetric orbits meet at S = 0", value, 2 / sp.pi)
    need(rho not in value.free_symbols, "the value depends on ρ")
    ratio = 2 / sp.pi  # their least speed at S = 0 is ρ/π less what is lost until its minimum
    lost = sp.sqrt(1 - ratio**2) - 1 + ratio * sp.asin(ratio)
    with precisely():
        gap = between(enclosure(sp.pi * lost), 5)
    claimed = stored("symmetric.json").claims["saddle_center"]
    with precisely():
        need(_inside(2 / interval.pi(), claimed), "the certificate disagrees")
    return {"gap": gap}
