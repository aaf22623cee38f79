"""Section 4.1: the symmetric ansatz and Theorem 4.2.

The algebra is right; but who turns and then moves right does not arrive at the left wall.
"""

from fractions import Fraction
from typing import Any

from cap.audit.means.algebra import differs, identity, symbols
from cap.audit.means.balls import between, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.equation import Equation, psi
from cap.audit.steps import Words
from cap.audit.verdict import Verdict, confirmed
from cap.sets import interval
from cap.sets.interval import Ball

HALF = Equation(Fraction(1, 2), Fraction(2))  # f = 1/2 at the paper's F, ω, R


class Pieces:
    """The formulas eq:xpiece1, eq:xpiece2 with the constants eq:ABconst."""

    def __init__(self) -> None:
        F, f, w, r, tau = symbols("F f omega r tau")
        t = sp.Symbol("t", real=True)
        self.F, self.f, self.w, self.r, self.tau, self.t = F, f, w, r, tau, t
        self.A1 = -F / w * sp.sin(w * tau) - f * tau
        self.B1 = r + F / w**2
        self.A2 = -F / w * sp.sin(w * tau) + f * tau
        self.B2 = self.B1 - f * tau**2
        forced = -F / w**2 * sp.cos(w * t)
        self.x1 = forced + f * t**2 / 2 + self.A1 * t + self.B1
        self.x2 = forced - f * t**2 / 2 + self.A2 * t + self.B2

    def at(self, expression: Any, time: Any) -> Any:
        """Return an expression at a time."""
        return expression.subs(self.t, time)


def symmetric_orbits_exist() -> Words:
    branches = stored("symmetric.json").claims["branches"]
    need(all(b["genuine"] == "yes" for b in branches.values()), "a branch is no orbit")
    types = {name: str(branch["type"]) for name, branch in branches.items()}
    return {"types": ", ".join(types)}


def ansatz_is_consistent() -> None:
    p = Pieces()
    arrival = p.at(sp.diff(p.x2, p.t), sp.pi / p.w)
    identity(
        "the formula's velocity at T/2",
        arrival,
        -p.F / p.w * sp.sin(p.w * p.tau) - p.f * (sp.pi / p.w - p.tau),
    )


def bijection() -> Words:
    with precisely():
        found = [HALF.bisected(root) for root in HALF.roots()]
        alpha = interval.ball(HALF.alpha)
        transverse = [theta for theta in found if abs(theta.cos()) > alpha]
        need(len(found) == len(transverse) == 2, "there are not two transverse roots")
        arrivals = [-theta.sin() - alpha * (interval.pi() - theta) for theta in found]
        need(all(v < 0 for v in arrivals), "a root arrives moving right")
        words = " and ".join(between(theta, 6) for theta in found)
    roots = stored("symmetric.json").claims["paper_roots"]
    need(all(root["velocity"].upper < 0 for root in roots), "the certificate disagrees")
    return {"words": words}


def existence_equation() -> None:
    p = Pieces()
    R = sp.Symbol("R", positive=True)
    theta = p.w * p.tau
    fourth = p.at(p.x2, sp.pi / p.w) - (p.r - R)  # x(T/2) = l
    stated = p.F * sp.pi * sp.sin(theta) - (
        2 * p.F + R * p.w**2 - p.f * sp.pi**2 / 2 + p.f * theta * (sp.pi - theta)
    )
    identity("(C4) is the equation", fourth * p.w**2, -stated)


def constants() -> None:
    p = Pieces()
    identity("(C1)", p.at(p.x1, 0), p.r)
    for x in (p.x1, p.x2):
        identity("(C2)", p.at(sp.diff(x, p.t), p.tau))
    identity("(C3)", p.at(p.x1, p.tau), p.at(p.x2, p.tau))
    identity("A₂ = A₁ + 2fτ", p.A2, p.A1 + 2 * p.f * p.tau)


def first_piece() -> Verdict:
    return _piece(Pieces(), 1)


def second_piece() -> Verdict:
    return _piece(Pieces(), -1)


def _piece(p: Pieces, sign: int) -> Verdict:
    x, A = (p.x1, p.A1) if sign > 0 else (p.x2, p.A2)
    identity("x'", sp.diff(x, p.t), p.F / p.w * sp.sin(p.w * p.t) + sign * p.f * p.t + A)
    identity("x''", sp.diff(x, p.t, 2), p.F * sp.cos(p.w * p.t) + sign * p.f)
    return confirmed("both x' and x''", "Differentiated by sympy.")


def reflection_at_the_left_wall() -> None:
    p = Pieces()
    leave = p.A1  # x'(0+)
    arrive = p.at(sp.diff(p.x2, p.t), sp.pi / p.w)
    # by symmetry x'(T/2+) = -x'(0+); the reflection asks for x'(T/2+) = -x'(T/2-)
    defect = sp.simplify(arrive - leave)
    identity("the defect of the reflection", defect, p.f * (2 * p.tau - sp.pi / p.w))
    need(differs(defect, sp.Integer(0)), "the reflection is always elastic")


def zeros_on_the_first_piece() -> Words:
    with precisely():
        theta = HALF.bisected(HALF.roots()[1])
        alpha = interval.ball(HALF.alpha)
        before = theta - Ball(1) / 10
        v = before.sin() + alpha * before - theta.sin() - alpha * theta
        need(v > 0, "x' is not positive just before τ", v=v)
        need(theta.cos() + alpha < 0, "x'' is not negative at τ")
        words = between(v, 6)
    return {"words": words}


def zeros_on_the_second_piece() -> None:
    p = Pieces()
    arrive = p.at(sp.diff(p.x2, p.t), sp.pi / p.w)
    theta = sp.Symbol("theta", positive=True)
    arrive = arrive.subs(p.tau, theta / p.w)
    identity("x'(T/2)", arrive * p.w, -p.F * sp.sin(theta) - p.f * (sp.pi - theta))
    with precisely():
        theta0 = HALF.bisected(HALF.roots()[0])
        alpha, after = interval.ball(HALF.alpha), interval.ball(Fraction(1, 10))
        later = theta0 + after
        v = later.sin() - alpha * later - theta0.sin() + alpha * theta0
        need(v > 0, "x' is not positive after τ")


def extension_by_symmetry() -> None:
    value, theta, (F, f, R, w) = psi()
    p = Pieces()
    end = p.at(p.x2, sp.pi / p.w) - (p.r - R)
    identity("x(T/2) - l is -Ψ/ω²", (end * p.w**2).subs(p.tau, theta / p.w), -value)
    need({F, f, R, w} <= value.free_symbols, "the equation lacks a parameter")
