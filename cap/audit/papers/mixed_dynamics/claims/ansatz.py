"""Section 4.1: the symmetric ansatz and Theorem 4.2.

The algebra is right; but who turns and then moves right does not arrive at the left wall.
"""

from fractions import Fraction

from cap.audit.means.balls import between, precisely
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.equation import Equation
from cap.audit.steps import Words
from cap.sets import interval
from cap.sets.interval import Ball

HALF = Equation(Fraction(1, 2), Fraction(2))  # f = 1/2 at the paper's F, ω, R


def bijection() -> Words:
    with precisely():
        found = HALF.both()
        alpha = interval.ball(HALF.alpha)
        need(all(abs(theta.cos()) > alpha for theta in found), "a root is not transverse")
        arrivals = [-theta.sin() - alpha * (interval.pi() - theta) for theta in found]
        need(all(v < 0 for v in arrivals), "a root arrives moving right")
        words = " and ".join(between(theta, 6) for theta in found)
    roots = stored("symmetric.json").claims["paper_roots"]
    need(all(root["velocity"].upper < 0 for root in roots), "the certificate disagrees")
    return {"words": words}


def zeros_on_the_first_piece() -> Words:
    with precisely():
        _, theta = HALF.both()
        alpha = interval.ball(HALF.alpha)
        before = theta - Ball(1) / 10
        v = before.sin() + alpha * before - theta.sin() - alpha * theta
        need(v > 0, "x' is not positive just before τ", v=v)
        need(theta.cos() + alpha < 0, "x'' is not negative at τ")
    return {"words": v}


def zeros_on_the_second_piece() -> None:
    with precisely():
        theta0, _ = HALF.both()
        alpha, after = interval.ball(HALF.alpha), interval.ball(Fraction(1, 10))
        later = theta0 + after
        v = later.sin() - alpha * later - theta0.sin() + alpha * theta0
        need(v > 0, "x' is not positive after τ")
