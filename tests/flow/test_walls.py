"""Walls that are no dyadic numbers: what rests at a wall is at the wall, not next to it."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import MIXED, certified, moment, starting
from mpmath import workdps
from oracle_flow import orbit
from support import holds, width

from cap.errors import BadInput, NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS
from cap.flow.propagation import propagate
from cap.flow.strobe import State, follow, oscillator
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

KINDS = pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
THIRDS = replace(PAPER, l=Fraction(-2, 3), r=Fraction(1, 3))
WALLS = {1: THIRDS.r, -1: THIRDS.l}
RESTS = {  # wall, start, end of a rest: pressed, held by friction, both, after one or two steps
    "pressed to r": (1, 0, 1),
    "pressed to l": (-1, 3, 4),
    "held at r": (1, "7/5", "3/2"),
    "held at l": (-1, "-17/10", "-8/5"),
    "first pressed, then held": (1, "-1/2", "9/5"),
    "first held, then pressed": (1, "19/4", 7),
    "for long": (1, "9/2", "79/10"),
}


def resting(name):
    """Return (wall, start, end) of one of `RESTS`, exact."""
    wall, start, end = RESTS[name]
    return wall, Fraction(start), Fraction(end)


@pytest.mark.parametrize("bits", [30, 53, 200])
@pytest.mark.parametrize("name", RESTS)
def test_a_rest_at_a_wall(name, bits):
    """The place is the wall, to the last bits; nothing can vary, so the derivative is zero."""
    wall, start, end = resting(name)
    with interval.workprec(bits):
        begin = starting(oscillator(THIRDS), (WALLS[wall], 0), start, wall=wall)
        image = propagate(THIRDS, begin, interval.ball(end))
        assert image.events == ()
        assert image.wall == wall
        assert holds(image.state[0], WALLS[wall], 0)
        assert width(image.state[0]) <= 4 * 2.0**-bits
        assert image.state[1].is_zero()
        assert all(entry.is_zero() for row in image.monodromy for entry in row)


@KINDS
@pytest.mark.parametrize("name", RESTS)
def test_a_rest_at_a_number_near_the_wall(name, kind):
    """A start said to be at a wall is there, even if its ball holds other numbers only."""
    wall, start, end = resting(name)
    osc = oscillator(THIRDS)
    x = interval.point(osc.wall(wall))
    assert not holds(x, WALLS[wall], 0)
    if kind is TAYLOR_MODELS:
        x, _ = Domain((Ball(0), Ball(0)), 2).variables((x, Ball(0)))
    begin = State(moment(osc, start), x, Ball(0), wall)
    orbit = follow(osc, begin, (), moment(osc, end), kind)
    assert holds(kind.bound(orbit.end[0]), WALLS[wall], 0)


@pytest.mark.parametrize("name", [name for name in MIXED if name.startswith("capture")])
@pytest.mark.parametrize("steps", [1, 4])
def test_a_rest_after_a_capture(name, steps):
    """The same, whether the rest goes on for one step or for several."""
    p, x, v, start, end = MIXED[name]
    p, x = replace(p, l=p.l + Fraction(1, 3), r=p.r + Fraction(1, 3)), Fraction(x) + Fraction(1, 3)
    side = -1 if name == "capture l" else 1
    start, end = Fraction(start), Fraction(end)
    path, _, _ = certified(p, (x, v), end, start=start)
    capture = next(event for event in path.events if event.word.startswith("capture"))
    since, box = Fraction(capture.time), None
    state = starting(oscillator(p), (Fraction(x), Fraction(v)), start)
    for k in range(steps):
        until = interval.ball(since + Fraction(k + 1, 20))
        image = propagate(p, state, until)
        box, state = image.state, State(oscillator(p).moment(until), *image.state, image.wall)
        assert image.wall == side
    assert holds(box[0], p.r if side > 0 else p.l, 0)


@pytest.mark.parametrize("v", ["0", "-1/9"])
@pytest.mark.parametrize("bits", [30, 53, 100])
def test_leaving_a_wall(v, bits):
    """Pushed off from rest, or moving: the orbit begins at the wall itself, against mpmath."""
    start, end = Fraction(5, 2), Fraction(31, 10)
    with interval.workprec(bits):
        begin = starting(oscillator(THIRDS), (THIRDS.r, Fraction(v)), start, wall=1)
        image = propagate(THIRDS, begin, interval.ball(end))
    with workdps(50):
        _, exact = orbit(THIRDS, start, THIRDS.r, Fraction(v), end)
    for side, value in zip(image.state, exact, strict=True):
        assert holds(side, value)
        assert width(side) < 200 * 2.0**-bits


def test_walls_that_are_none():
    """A wall is 1, -1 or 0; a box at a wall must meet it."""
    osc = oscillator(PAPER)
    for wall in (2, -2, 3):
        with pytest.raises(BadInput, match="wall"):
            propagate(PAPER, State(osc.moment(Ball(0)), Ball(1), Ball(-1), wall), Ball(1))
    for x in (Ball(0), Ball("nan"), Ball("inf"), Ball(0, "inf")):
        with pytest.raises(NotProved, match="not at its wall"):
            propagate(PAPER, State(osc.moment(Ball(0)), x, Ball(-1), 1), Ball(1))
