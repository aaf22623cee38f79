"""Guards that motions meet again and again: what is solved for, and refusals."""

from fractions import Fraction

import models
import pytest
from models import cos, pi, sin, v, x, y

from cap.errors import BadInput
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import ONE, Polynomial, Quotient
from cap.system.section import Section, sections

A, e = Fraction(6, 5), Fraction(1, 2)


def flying(guard, state=("y", "v"), field=None, omega=ONE):
    """Return a system of one mode."""
    rates = field or {"y": v, "v": -ONE}
    return System(state, omega, {"fly": Mode(rates, {"table": guard})})


def test_the_ball():
    """At a contact the height is that of the table, and the velocity jumps."""
    (section,) = sections(models.ball(A, e))
    assert (section.mode, section.guard) == ("fly", "table")
    assert (section.fixed, section.free) == ("y", "v")
    assert section.place == A * sin
    assert section.after == Quotient.of((1 + e) * A * cos - e * v)


def test_a_reset_that_divides():
    """What is fixed is substituted in both parts."""
    guard = Guard(3 * y - sin, ("fly",), {"v": Quotient(y + v, 1 + y)})
    (section,) = sections(flying(guard))
    assert section.place == Fraction(1, 3) * sin
    after = section.after
    assert after.numerator * (3 + sin) == (sin + 3 * v) * after.denominator


def test_several_guards():
    """Each that is one counts."""
    bounce = Bounce(ONE)
    guards = {"low": Guard(y - sin, ("fly",), bounce), "high": Guard(4 - y, ("fly",), bounce)}
    system = System(("y", "v"), ONE, {"fly": Mode({"y": v, "v": -ONE}, guards)})
    assert [section.guard for section in sections(system)] == ["low", "high"]


RESET = {"v": -1 * v}
REFUSED = {
    "variables": (models.parabola(), "the state has 4 variables"),
    "clock": (flying(Guard(y, ("fly",), RESET)), "nothing depends on the clock"),
    "squared": (flying(Guard(y * y - sin, ("fly",), RESET)), "not of degree 1"),
    "velocity": (flying(Guard(y + v - sin, ("fly",), RESET)), "not of degree 1"),
    "pi": (flying(Guard(pi * y - sin, ("fly",), RESET)), "not of degree 1"),
    "clock alone": (flying(Guard(1 - sin, ("fly",), RESET)), "not of degree 1"),
    "spring": (models.spring(), "not polynomial in time"),
    "jumps": (flying(Guard(y - sin, ("fly",), {"y": y + cos, **RESET})), "y jumps"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name):
    """Each in a line."""
    system, why = REFUSED[name]
    with pytest.raises(BadInput, match=why):
        sections(system)


def test_another_mode():
    """After the contact the system goes on elsewhere."""
    rest = Mode({"y": 0 * y, "v": 0 * v}, {"leave": Guard(1 - sin, ("fly",))})
    fly = Mode({"y": v, "v": -ONE}, {"table": Guard(y - sin, ("rest",))})
    system = System(("y", "v"), ONE, {"fly": fly, "rest": rest})
    with pytest.raises(BadInput, match="the mode is another one"):
        Section(system, "fly", "table")
    assert isinstance(x, Polynomial)
