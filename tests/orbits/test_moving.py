"""A parameter as a variable of the state."""

from fractions import Fraction

import models
import pytest

from cap.errors import BadInput
from cap.system.model import Guard, Mode, System
from cap.system.moving import moving
from cap.system.polynomial import ONE, variables

x, v, y, A, e, cos, sin, s = variables("x v y A e cos sin s")
ENDS = Fraction(1, 4), Fraction(3, 4)


def test_the_restitution_of_a_ball():
    """It stands in the reset alone; the mode in which the ball rests is not reached by contacts."""
    system = moving(lambda q: models.ball(e=q), "e", ENDS, ["fly"])
    assert system.state == ("y", "v", "e")
    assert list(system.modes) == ["fly"]
    assert system.modes["fly"].field == {"y": v, "v": -ONE, "e": 0 * ONE}
    value = Fraction(6, 5) * cos
    assert system.reset("fly", "table")["v"].numerator == value + e * value - e * v
    assert system.reset("fly", "table")["e"].numerator == e


def test_another_parameter_has_another_system():
    """At each value the guard, the field and the reset are those of the model."""
    system = moving(lambda q: models.ball(A=q), "A", ENDS, ["fly"])
    for q in (Fraction(1, 3), Fraction(5, 7)):
        there, at = models.ball(A=q), {"A": ONE * q}
        assert (
            system.guard("fly", "table").value.substituted(at) == there.guard("fly", "table").value
        )
        new = system.reset("fly", "table")["v"].numerator.substituted(at)
        assert new == there.reset("fly", "table")["v"].numerator


def one(field=v, value=1 - x, to="fly", reset=None, omega=1, state="x v"):
    """Return a system of one mode."""
    fly = Mode({"x": v, "v": field}, {"wall": Guard(value, to, reset or {"v": -v})})
    rest = Mode({"x": 0, "v": 0}, {})
    return System(state, omega, {"fly": fly, "rest": rest})


REFUSED = {
    "the frequency depends on s": lambda q: one(omega=q),
    "s multiplies a variable or the clock": lambda q: one(field=-q * x),
    "in the mode fly s multiplies": lambda q: one(field=q * cos),
    "modes or guards depend on s": lambda q: one(to="fly" if q < Fraction(1, 2) else "rest"),
    "is no polynomial in s of degree 4": lambda q: one(value=1 / q - x),
    "is divided by what depends on s": lambda q: one(reset={"v": v / (1 + q * x)}),
}


@pytest.mark.parametrize("why", REFUSED)
def test_refused(why):
    """Each in one line, for its own reason."""
    with pytest.raises(BadInput, match=why) as refused:
        moving(REFUSED[why], "s", ENDS, ["fly"])
    assert "\n" not in str(refused.value)


def test_a_variable_is_no_parameter():
    """Its name is taken."""
    with pytest.raises(BadInput, match="x is a variable of the state"):
        moving(lambda q: one(value=q - x), "x", ENDS, ["fly"])
