"""The formulas of the folded flow are those of the system as data, symbolically."""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest
import sympy as sp

from cap.checker.folded.motion import Direction
from cap.checker.system.friction import LEFT, RIGHT, friction
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.walls import Parameters

PAPER = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)))
t, A, B, ref, a = sp.symbols("t A B ref a", real=True)
SYMBOLS = SimpleNamespace(
    total=lambda p, q: p + q,
    product=lambda p, q: p * q,
    scaled=lambda p, c, _error=0: p * c,
    moved=lambda p, c, _error=0: p + c,
)


def expression(polynomial, **values):
    """Return a polynomial of the data as an expression of sympy."""
    terms = (c * sp.prod([values[z] for z in z_s]) for z_s, c in polynomial.terms.items())
    return sp.Add(*terms)


@pytest.mark.parametrize(("forwards", "mode", "side"), [(True, RIGHT, 1), (False, LEFT, -1)])
def test_the_flight_is_that_of_the_data(forwards, mode, side):
    """s' is the force of the mode, p' is s; backwards a mass that moves left is seen to the right,
    and the speed changes as the force at -t."""
    names = dict.fromkeys(("F", "e"), Polynomial.of(1)) | {"mu": Polynomial.of(0)}
    model = friction(Fraction(1), names | {z: variable(z) for z in ("f", "l", "r")})
    y = Direction(PAPER, forwards=forwards)
    assert y.a == pytest.approx(-0.4 if forwards else 0.4, abs=1e-15)
    y.q, y.a, y.a_error = SYMBOLS, a, 0
    flight = SimpleNamespace(A=A, B=B, ref=ref)
    s, p = y.speed(A, t - ref, sp.sin(t)), y.place(flight, t - ref, sp.cos(t))
    f = -a if forwards else a
    clock = {"cos": sp.cos(side * t), "sin": sp.sin(side * t), "f": f, "v": side * s}
    force = expression(model.modes[mode].field["v"], **clock)
    assert sp.simplify(sp.diff(s, t) - force) == 0
    assert sp.simplify(sp.diff(p, t) - s) == 0


def test_a_flight_begins_where_it_is_said_to():
    """With B = `start` p is 0, and with what is added to it, that."""
    y = Direction(PAPER)
    y.q, y.a, y.a_error = SYMBOLS, a, 0
    flight = SimpleNamespace(A=A, B=B + y.start(A, t - ref, sp.cos(t)), ref=ref)
    assert sp.simplify(y.place(flight, t - ref, sp.cos(t)) - B) == 0
