"""What the prover asks of a contact that is lost as its speed goes to 0."""

from fractions import Fraction
from types import SimpleNamespace

import pytest
from branches import certificate

from cap import Guard, Mode, System, variables
from cap.errors import NotProved
from cap.orbits.curve import Curve
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.lost_contact import Speed
from cap.orbits.numbers import Balls
from cap.sets.interval import Ball
from cap.system.polynomial import ONE, ZERO, variable

x, v, p, cos = variables("x v p cos")
W = tuple(map(Ball, (1.0, 0.5, -0.1, 0.5)))  # t, x, v, p


def speed(reset, to="m"):
    """Return that of the contact x = p of a mode with x' = v."""
    field, back = {"x": v, "v": cos, "p": ZERO}, "m" if to == "k" else "k"
    walls = {"m": Guard(x - p, to, reset), "k": Guard(x - p, back, reset)}
    system = System("x v p", 1, {key: Mode(field, {"wall": walls[key]}) for key in walls})
    contacts = [Contact("m", "wall", to), *([Contact("k", "wall", "m")] if to == "k" else [])]
    cells = SimpleNamespace(curve=Curve(Itinerary(system, contacts)), balls=Balls(system))
    return Speed(SimpleNamespace(cells=cells), 0)


def test_what_may_be_lost():
    """A contact that turns the speed; its derivative along a curve is that of v."""
    for reset in ({"v": v * Fraction(-1, 2)}, {"v": -v * p}, {"v": -v / (1 + p * p)}):
        found = speed(reset)
        found.confirm()
        found.turns(W)
        assert found.over(W).contains(-0.1)
        assert found.change(W, [Ball(0.25), Ball(3), Ball(2), Ball(1)]).contains(2)


@pytest.mark.parametrize(
    ("reset", "to", "reason"),
    [
        ({"v": -v}, "k", "another mode follows"),
        ({"v": -v, "x": x + v + 1}, "m", "the guard may not vanish after it"),
        ({"v": 1 - v}, "m", "it may move the state"),
        ({"v": v / 2}, "m", "it may not turn the speed"),
        ({"v": v * (p - Fraction(1, 4))}, "m", "it may not turn the speed"),
    ],
)
def test_what_may_not(reset, to, reason):
    """Each is refused for its own reason."""

    def tried():
        found = speed(reset, to)
        found.confirm()
        found.turns(W)

    with pytest.raises(NotProved, match=reason):
        tried()


def test_division():
    """A product is divided by its factors, and what is none is not."""
    pi = variable("pi")
    a, b = 2 * x * v + pi + 1, v * v - x * p / 3
    assert (a * b).divided(b) == a
    assert (a * b + 1).divided(b) is None
    assert ZERO.divided(a) == ZERO
    assert ONE.divided(pi) is None


def test_the_piece_goes_beyond():
    """The short cell lies within the piece, which has an end on each side."""
    (end,) = certificate("wall")["claims"]["lost"]
    (a, b), (c, d) = (map(Fraction, end[key]["ends"]) for key in ("piece", "short"))
    assert a < c < d < b
