"""Section 4.2: the roots of the existence equation, as a statement about an equation."""

from fractions import Fraction

from cap.audit.means.balls import between, precisely
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.equation import Equation
from cap.audit.steps import Words
from cap.sets.interval import Ball

PAPER_RHO = Fraction(2)


def number_of_roots() -> None:
    with precisely():
        counts = [len(Equation(Fraction(a), PAPER_RHO).roots()) for a in ("3/10", "2/5", "3/5")]
    need(counts == [0, 2, 2], "at the paper's R other numbers are found", counts=counts)


def branch_exists() -> Words:
    with precisely():
        found = Equation(Fraction(2, 5), PAPER_RHO).both()
        need(all(abs(theta.cos()) < Fraction(2, 5).numerator / Ball(5) for theta in found), "turns")
        words = " and ".join(between(theta.cos(), 5) for theta in found)
    return {"words": words}
