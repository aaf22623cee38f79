"""The flights of half a period follow from the model as data, with F = ω = 1 and f = α."""

import sympy

from cap.system.flight import Scalars
from cap.system.flight import flights as of_mode
from cap.system.friction import LEFT, RIGHT, friction
from cap.tori import flights

X, V, T, D, ALPHA, A = sympy.symbols("x v t d alpha a")
OF = Scalars(lambda q: sympy.Rational(q.numerator, q.denominator), sympy.pi, None)


def flown(mode, state, begin, end):
    """Return the state at a time on the flight of a mode from that at another."""
    system = friction().at({"F": 1, "omega": 1, "mu": 0})
    form, values = of_mode(system, mode), {"f": ALPHA}
    first, last = ((sympy.cos(t), sympy.sin(t)) for t in (begin, end))
    rest = form.launch(state, first, values, OF)
    return form.state_at(rest, end - begin, last, values, OF)


def test_to_the_right():
    """Way beyond the wall, and speed."""
    place, velocity = flown(RIGHT, (X, V), sympy.Integer(0), T)
    beyond = flights.beyond(ALPHA, A, (X, V), T, sympy.cos(T))
    assert sympy.simplify(place - A - beyond) == 0
    assert sympy.simplify(velocity - flights.speed(ALPHA, V, T, sympy.sin(T))) == 0


def test_back_from_the_wall():
    """Minus the place at the time π; the velocity is v + 2 sin t - απ, from that at the hit."""
    u = sympy.Symbol("u")
    place, velocity = flown(LEFT, (A, -u), T, sympy.pi)
    landing = flights.landing(ALPHA, A, u, (sympy.sin(T), sympy.cos(T)), sympy.pi - T)
    assert sympy.simplify(place + landing) == 0
    hit = flights.speed(ALPHA, V, T, sympy.sin(T))
    end = V + 2 * sympy.sin(T) - ALPHA * sympy.pi
    assert sympy.simplify(velocity.subs(u, hit) + end) == 0
