"""Lemmas M, C and B are found for what the literature has; each is an identity of polynomials."""

from dataclasses import replace
from fractions import Fraction

import pytest
from models import ball, cos, parabola, sin, spring, v, w

from cap.parameters import PAPER
from cap.system.friction import friction, oscillator
from cap.system.lemmas import Bisected, Clocked, Falls, clock_part, lemmas
from cap.system.masses import masses
from cap.system.model import Guard, Mode, System
from cap.system.polynomial import ONE, ZERO, variable, variables

VISCOUS = replace(PAPER, mu=Fraction(1, 10))
TWO = masses(PAPER, (Fraction(1), Fraction(9, 10)))
THREE = masses(PAPER, (Fraction(1), Fraction(9, 10), Fraction(2)))
FRICTION, GAP = Fraction(2, 5), Fraction(1, 3)


def test_friction():
    """The walls by M, the stops by C."""
    f = FRICTION
    assert lemmas(oscillator(PAPER), "right") == {
        "stop": Clocked(1, ZERO, cos - f, ()),
        "wall": Falls({"stop": 1}),
    }
    assert lemmas(oscillator(PAPER), "left") == {
        "stop": Clocked(1, ZERO, -cos - f, ()),
        "wall": Falls({"stop": 1}),
    }


def test_viscous_friction():
    """lambda is the viscosity; it may be a parameter."""
    found = lemmas(oscillator(VISCOUS), "right")
    assert found["stop"] == Clocked(1, ONE / 10, cos - FRICTION, ())
    F, f, mu = variables("F f mu")
    assert lemmas(friction(), "left")["stop"] == Clocked(1, mu, -F * cos - f, ())


def test_two_masses():
    """The gap falls by the sum of two stops; where both go the same way, L^2 is the clock's."""
    found = lemmas(TWO, "+-")
    assert found["meet 1 2"] == Falls({"stop 1": 1, "stop 2": 1})
    assert found["stop 2"] == Clocked(1, ZERO, (-cos - FRICTION) / Fraction(9, 10), ())
    gap = lemmas(TWO, "++")["meet 1 2"]
    assert gap == Clocked(2, ZERO, (cos - FRICTION) * (Fraction(10, 9) - 1), ())
    assert lemmas(TWO, "+0")["meet 1 2"] == Falls({"stop 1": 1})


def test_releases():
    """What holds a mass at rest changes with the clock alone."""
    assert lemmas(TWO, "00")["release 1 r"] == Clocked(1, ZERO, sin, ())


def test_only_springs_need_bisection():
    """Among all models here."""
    for system in (TWO, THREE, oscillator(VISCOUS), ball(), parabola()):
        for mode in system.modes:
            assert not any(isinstance(x, Bisected) for x in lemmas(system, mode).values())
    assert lemmas(spring(), "fly") == {"stop": Bisected()}


def test_ball_and_parabola():
    """By L^2; over the parabola with the horizontal velocity, constant on a flight."""
    assert lemmas(ball(), "fly")["table"] == Clocked(2, ZERO, Fraction(6, 5) * sin - 1, ())
    pi = variable("pi")
    value = 4 * pi * pi * sin - Fraction(981, 100) - 4 * v * v
    assert lemmas(parabola(), "fly")["table"] == Clocked(2, ZERO, value, ("v",))


@pytest.mark.parametrize(
    "system", [TWO, THREE, oscillator(VISCOUS), ball(), parabola(), friction()]
)
def test_identities(system):
    """What a lemma says is true, and none leans on one that comes after it."""
    for mode in system.modes:
        found = lemmas(system, mode)
        assert found.keys() == system.modes[mode].guards.keys()
        names = list(found)
        for name, lemma in found.items():
            h = system.guard(mode, name).value
            if isinstance(lemma, Falls):
                total = [c * system.guard(mode, n).value for n, c in lemma.others.items()]
                assert system.lie(mode, h) == -sum(total, ZERO)
                assert min(lemma.others.values()) > 0
                assert all(names.index(n) < names.index(name) for n in lemma.others)
            elif isinstance(lemma, Clocked):
                g = h
                for _ in range(lemma.order):
                    g = system.lie(mode, g) + lemma.rate * g
                assert g == lemma.value
                fixed = {z for z in system.state if not system.modes[mode].field[z]}
                assert g.variables & set(system.state) <= fixed


def test_two_guards_do_not_lean_on_each_other():
    """x' = -y, y' = -x: each falls while the other is positive, which proves nothing."""
    x, y = variables("x y")
    guards = {"a": Guard(x, ("m",)), "b": Guard(y, ("m",))}
    system = System(("x", "y"), ONE, {"m": Mode({"x": -y, "y": -x}, guards)})
    found = lemmas(system, "m")
    assert [type(lemma) for lemma in found.values()].count(Falls) <= 1


def test_a_rising_guard_is_not_falling():
    """The numbers of Lemma M are positive."""
    x = variable("x")
    guards = {"a": Guard(x, ("m",)), "b": Guard(w, ("m",))}
    system = System(("x", "w"), ONE, {"m": Mode({"x": w, "w": -x}, guards)})
    assert lemmas(system, "m")["a"] != Falls({"b": -1})
    assert lemmas(system, "m")["b"] == Falls({"a": 1})


def test_clock_part():
    """a cos wt + b sin wt + c, or nothing."""
    assert clock_part(Clocked(1, ZERO, 3 * cos - sin / 2 - GAP, ())) == (
        3 * ONE,
        -ONE / 2,
        -GAP * ONE,
    )
    assert clock_part(Clocked(1, ZERO, cos * sin, ())) is None
