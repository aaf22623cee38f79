"""What is no system is refused, with one line that says what is wrong."""

from fractions import Fraction

import pytest
import sympy
from models import cos, pi, v, x

from cap.errors import BadInput
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import ONE, ZERO, Polynomial, Quotient, variables

g, z, mass = variables("g z mass")
FALL = {"x": v, "v": -ONE}


def system(field=None, guard=None, **changes):
    """Return a ball over a floor, with something else in its place."""
    guard = guard or Guard(x, ("fly",), {"v": -v}, "rest")
    rest = Mode({"x": ZERO, "v": ZERO}, {})
    modes = {"fly": Mode(FALL if field is None else field, {"floor": guard}), "rest": rest}
    parts = {"state": ("x", "v"), "omega": ONE, "modes": modes} | changes
    return System(**parts)


def test_the_ball_itself_is_a_system():
    """So each refusal below is for what was changed."""
    assert system().reset("fly", "floor")["v"].numerator == -v


def over_floor(**changes):
    """Return the guard of the floor, with changes."""
    return Guard(**({"value": x, "to": ("fly",), "reset": {"v": -v}} | changes))


REFUSED = {
    "unknown mode": lambda: system(guard=over_floor(to=("swim",))),
    "unknown mode: sleep": lambda: system(guard=over_floor(rest="sleep")),
    "names no mode": lambda: system(guard=over_floor(to=())),
    "is constant": lambda: system(guard=over_floor(value=1 + g), parameters=("g",)),
    "is constant: 0": lambda: system(guard=over_floor(value=ZERO)),
    "not an exact polynomial": lambda: system(guard=over_floor(value=Quotient(x, v))),
    "not a polynomial": lambda: system(guard=over_floor(value=sympy.sin(sympy.Symbol("x")))),
    "exact polynomial: 0.5": lambda: system(guard=over_floor(reset={"v": 0.5})),
    "floor of the mode fly names an unknown variable: z": lambda: system(
        guard=over_floor(value=x + z)
    ),
    "a reset names": lambda: system(guard=over_floor(reset=[x, v, v])),
    "changes z, no variable": lambda: system(guard=over_floor(reset={"z": v})),
    "new v at the guard floor of the mode fly names an unknown variable: z": lambda: system(
        guard=over_floor(reset={"v": z})
    ),
    "denominator 0": lambda: system(guard=over_floor(reset={"v": Quotient(v, ZERO)})),
    "does not stay 0 in fly": lambda: system(guard=over_floor(rest="fly")),
    "restitution of the guard floor of the mode fly is not a rational": lambda: system(
        guard=over_floor(reset=Bounce(Polynomial.of(2)))
    ),
    "is not a rational in": lambda: system(guard=over_floor(reset=Bounce(pi))),
    "restitution of the guard floor of the mode fly is not constant": lambda: system(
        guard=over_floor(reset=Bounce(cos))
    ),
    "restitution of the guard floor of the mode fly names an unknown": lambda: system(
        guard=over_floor(reset=Bounce(g))
    ),
    "not a positive number: -1": lambda: system(guard=over_floor(reset=Bounce(ONE, {"v": -ONE}))),
    "mass of z": lambda: system(guard=over_floor(reset=Bounce(ONE, {"z": ONE}))),
    "no bounce at floor": lambda: system(guard=over_floor(value=x + v, reset=Bounce(ONE))),
    "v' in the mode fly is not linear": lambda: system({"x": v, "v": -x * x}),
    "x' in the mode fly is not linear": lambda: system({"x": v * cos, "v": ZERO}),
    "what v' is": lambda: system({"x": v}),
    "rate of z, no variable": lambda: system(FALL | {"z": ONE}),
    "v' in the mode fly names an unknown variable: g": lambda: system({"x": v, "v": -g}),
    "frequency": lambda: system(omega=ZERO),
    "power of pi: -1": lambda: system(omega=-ONE),
    "frequency must be a positive rational": lambda: system(omega=1 + pi),
    "times a power of pi: x": lambda: system(omega=x),
    "a dictionary of Mode": lambda: system(modes={"fly": FALL}),
    "a dictionary of Guard": lambda: Mode(FALL, {"floor": x}),
    "modes are named": lambda: system(modes=[Mode(FALL)]),
    "a field names": lambda: Mode([v, -ONE]),
    "at least one variable": lambda: system(state=()),
    "at least one mode": lambda: system(modes={}),
    "not a name": lambda: system(state=("x", "v", "a b")),
    "clock or of pi": lambda: system(state=("x", "v", "cos")),
    "name x": lambda: system(state=("x", "v", "x")),
    "have the name v": lambda: system(parameters=("v",)),
    "too many variables: 25": lambda: system(state=tuple(f"x{i}" for i in range(25))),
    "too many modes: 1001": lambda: system(modes={str(i): Mode(FALL) for i in range(1001)}),
    "too many guards of the mode fly": lambda: system(
        modes={"fly": Mode(FALL, {str(i): over_floor() for i in range(101)})}
    ),
    "degree above 12": lambda: system(guard=over_floor(value=x**13)),
    "too many terms": lambda: system(
        guard=over_floor(value=sum((g**i * x * v**j for i in range(40) for j in range(40)), ZERO)),
        parameters=("g",),
    ),
    "power of pi above 24": lambda: system(guard=over_floor(value=x * pi**25)),
}


@pytest.mark.parametrize("message", REFUSED)
def test_refused(message):
    """By one line that has the words."""
    with pytest.raises(BadInput) as refusal:
        REFUSED[message]()
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_rationals_are_written_as_such():
    """A double is no exact number, anywhere."""
    for make in (lambda: x * 0.5, lambda: Mode({"x": 0.5}), lambda: Bounce(0.5), lambda: x + "1"):
        with pytest.raises(BadInput, match="Fraction"):
            make()


def test_mass_numbers():
    """Masses may be rationals times powers of pi."""
    bounce = Bounce(Polynomial.of(Fraction(1, 2)), {"v": 2 * pi})
    assert system(guard=over_floor(reset=bounce)).reset("fly", "floor")["v"].numerator == v / -2
