"""Section 4.3: the 'saddle-center' of the roots, Theorem 4.8, against the one that orbits have."""

from fractions import Fraction
from typing import Any

from cap.audit.means.algebra import identity, symbols
from cap.audit.means.balls import between, pair, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.equation import psi
from cap.audit.steps import Words
from cap.one_one.closed_form import symmetric
from cap.sets import interval
from cap.sets.interval import Ball

NEAR = Fraction(63, 100)  # f near 2F/π


def squared_distance() -> tuple[Any, Any, Any]:
    """Return d(θ - π/2)²/dμ at the fold, from Ψ as a function of (θ - π/2)² and f; F and f_sc."""
    value, theta, (F, f, _, _) = psi()
    y = symbols("y")
    even = value.subs(theta, sp.pi / 2 + sp.sqrt(y))
    slope_y = sp.limit(sp.diff(even, y), y, 0, "+")
    slope_f = sp.diff(value, f).subs(theta, sp.pi / 2)
    return sp.simplify(-slope_f / slope_y), F, f


def normal_form() -> None:
    derived, F, f = squared_distance()
    stated = sp.pi**2 / 2 / (F * sp.pi - 2 * f)
    identity("the coefficient", derived, stated)


def saddle_center_of_orbits() -> Words:
    with precisely():
        found = []
        for sign in (1, -1):
            orbit = symmetric(interval.ball(NEAR), Ball(2), sign)
            need(orbit.least_speed() > 0, "the orbit may stop")
            found.append(orbit.trace())
        need(-2 < found[0] < 2 < found[1], "the types are others")
        words = [between(trace, 5) for trace in found]
    claimed = stored("symmetric.json").claims["saddle_center"]
    return {"claimed": pair(claimed), "words": words[0], "words_2": words[1]}
