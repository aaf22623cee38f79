"""The one-bounce orbits of the ball in closed form, from its model: where they begin, and flip."""

import math
from fractions import Fraction

import pytest
import sympy
from own_systems import certificate

from cap.system.files import read

t, s, v, A, e = sympy.symbols("t s v A e", positive=True)
COS = sympy.pi * (1 - e) / ((1 + e) * A)  # cos t at the bounce


def symbols(q, known):
    """Return a polynomial of a model in sympy."""
    return q.evaluated(known, sympy.Rational, sympy.pi)


def test_the_equations_here_are_those_of_the_model():
    """Guard, reset and field, at three parameters."""
    for a, loss in (("6/5", "1/2"), ("2", "1/3"), ("7/3", "9/10")):
        system = read("examples/ball.py", {"A": a, "e": loss})
        known = {"y": sympy.Symbol("y"), "v": v, "cos": sympy.cos(t), "sin": sympy.sin(t)}
        here = {A: sympy.Rational(a), e: sympy.Rational(loss)}
        guard = symbols(system.guard("fly", "table").value, known)
        assert sympy.simplify(guard - (known["y"] - A * sympy.sin(t)).subs(here)) == 0
        reset = symbols(system.reset("fly", "table")["v"].numerator, known)
        assert sympy.simplify(reset - after().subs(here)) == 0
        assert str(system.modes["fly"].field) == "{'y': v, 'v': -1}"


def after():
    """Return the velocity after a bounce."""
    return -e * v + (1 + e) * A * sympy.cos(t)


def multipliers():
    """Return trace and determinant of the return map (t, v) -> (s, v') of one bounce."""
    gap = A * sympy.sin(t) + after() * (s - t) - (s - t) ** 2 / 2 - A * sympy.sin(s)
    arrival = after() - (s - t)
    by = [-sympy.diff(gap, z) / sympy.diff(gap, s) for z in (t, v)]
    rows = [by, [sympy.diff(arrival, z) + sympy.diff(arrival, s) * d for z, d in zip((t, v), by)]]  # noqa: B905
    D = sympy.Matrix(rows).subs({s: t + 2 * sympy.pi, v: -sympy.pi})
    D = D.subs({sympy.cos(t): COS})
    return sympy.simplify(D.trace()), sympy.simplify(D.det())


def test_they_exist_from_the_onset_on():
    """v = -pi and cos t = pi (1 - e)/((1 + e) A) solve the equations: A >= pi (1 - e)/(1 + e)."""
    launch = after().subs({v: -sympy.pi, sympy.cos(t): COS})
    assert sympy.simplify(launch - sympy.pi) == 0  # it flies for 2 pi, and arrives with -pi


@pytest.mark.slow
def test_the_flip():
    """1 + trace + determinant is 0 at A^2 = (pi (1 - e)/(1 + e))^2 + (2 (1 + e^2)/(1 + e)^2)^2."""
    trace, det = multipliers()
    assert sympy.simplify(det - e**2) == 0
    assert sympy.simplify(trace - (1 + e**2 - (1 + e) ** 2 * A * sympy.sin(t))) == 0
    sine = 2 * (1 + e**2) / ((1 + e) ** 2 * A)
    flip = sympy.sqrt((sympy.pi * (1 - e) / (1 + e)) ** 2 + (2 * (1 + e**2) / (1 + e) ** 2) ** 2)
    assert sympy.simplify(1 + trace.subs(sympy.sin(t), sine) + det) == 0
    assert sympy.simplify((COS**2 + sine**2).subs(A, flip) - 1) == 0
    assert float(flip.subs(e, sympy.Rational(1, 2))) == pytest.approx(1.5268237, abs=1e-7)


def test_the_certificate_agrees():
    """The trace that is proved at A = 6/5, e = 1/2."""
    low, high = map(Fraction, certificate("ball")["claims"]["symmetric"][0])
    sine = math.sqrt(1.44 - math.pi**2 / 9)
    assert low < Fraction(1.25 - 2.25 * sine) < high
