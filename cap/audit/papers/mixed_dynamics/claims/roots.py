"""Section 4.2: the roots of the existence equation, as a statement about an equation."""

from fractions import Fraction

from cap.audit.means.algebra import enclosure, identity, symbols
from cap.audit.means.balls import between, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.equation import Equation
from cap.audit.steps import Words
from cap.checker.kernel.shapes import Enclosure
from cap.sets import interval
from cap.sets.interval import Ball

PAPER_RHO = Fraction(2)


def _inside(value: Ball, claimed: Enclosure) -> bool:
    low, high = interval.ball(claimed.lower), interval.ball(claimed.upper)
    return bool(low <= value) and bool(value <= high)


def number_of_roots() -> None:
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
