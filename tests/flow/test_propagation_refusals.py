"""Nothing is told of boxes whose orbits differ, nor of times and states that make no sense."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import starting

from cap.errors import BadInput, NotProved
from cap.flow import propagation
from cap.flow.itinerary import itinerary
from cap.flow.propagation import after_periods, at_time_zero, propagate
from cap.flow.strobe import State, oscillator
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

P_STAR = Fraction("0.1002798898"), Fraction("0.5419433068")
HAIR = Fraction(1, 10**9)


def far(p, state, end, radius=0, **options):
    """Return `propagate` from a box around an exact state to an exact time."""
    state = tuple(map(Fraction, state))
    begin = starting(oscillator(p), state, radius=radius, **options)
    return propagate(p, begin, interval.ball(Fraction(end)))


def test_input_that_is_no_state():
    """Outside the walls, not finite, moving into the wall."""
    for state in (("2", "1"), ("-2", "1")):
        with pytest.raises((BadInput, NotProved)):
            far(PAPER, state, 1)
    for x, v in ((Ball("nan"), Ball(1)), (Ball(0), Ball("nan")), (Ball(0, "inf"), Ball(1))):
        with pytest.raises((BadInput, NotProved)):
            propagate(PAPER, at_time_zero(x, v), Ball(1))
    with pytest.raises((BadInput, NotProved)):
        far(PAPER, (1, 1), 1, wall=1)


@pytest.mark.parametrize("size", ["1e400", "1e10000000000000000000000000"])
def test_absurd_sizes(size):
    """Of states and times, in balls that no fraction and no float holds."""
    huge, one = Ball(size), Ball(1)
    for x, v, end in ((huge, one, one), (Ball(0), huge, one), (Ball(0, huge), one, one)):
        with pytest.raises(NotProved):
            propagate(PAPER, at_time_zero(x, v), end)
    with pytest.raises(NotProved, match="periods away"):
        propagate(PAPER, at_time_zero(Ball(0), one), huge)


@pytest.mark.parametrize("name", ["F", "omega", "R"])
@pytest.mark.parametrize("power", [400, -400])
def test_absurd_parameters(name, power):
    """That no float holds, or walls that nobody can tell apart: nothing is proved."""
    p = replace(PAPER, l=Fraction(0), f=Fraction(0))
    with pytest.raises((NotProved, BadInput)):  # noqa: PT012
        p = replace(p, **{"r" if name == "R" else name: Fraction(10) ** power})
        after_periods(p, interval.ball(p.R / 2), Ball(1), 1)


def refused(p, box, end, *steps, start=0):
    """Check that the flow is refused at one of these steps; return why."""
    begin = State(oscillator(p).moment(interval.ball(Fraction(start))), *box)
    with pytest.raises(NotProved) as caught:
        propagate(p, begin, end)
    assert caught.value.step.split()[0] in steps
    assert caught.value.sets
    return caught.value.reason


def border(p, low, high, start, end):
    """Return a state between two, where the itinerary changes, by bisection in floats."""
    same = itinerary(p, *low, end, start=start).words
    for _ in range(45):
        middle = tuple((a + b) / 2 for a, b in zip(low, high, strict=True))
        changed = itinerary(p, *middle, end, start=start).words != same
        low, high = (low, middle) if changed else (middle, high)
    return tuple(map(Fraction, low))


@pytest.mark.parametrize(
    ("low", "high", "reason"),
    [
        ((0.0, 0.1), (0.9, 0.1), "before its velocity vanishes"),
        ((-0.5, -0.2), (-0.5, -0.3), "turns or sticks"),
    ],
    ids=["grazing", "turn or stick"],
)
def test_an_undecided_event_is_named(low, high, reason):
    """A box over a border is refused at the event; on both sides of it there is a proof."""
    end = 3.0
    state, step = border(PAPER, low, high, 0.0, end), Fraction(1, 100)
    for radius in (Fraction(1, 10**3), Fraction(1, 10**6), HAIR):
        x, v = (interval.around(q, radius) for q in state)
        assert reason in refused(PAPER, (x, v), Ball(end), "event")
    found = {
        tuple(e.word for e in far(PAPER, (state[0] + a, state[1] + b), end, HAIR).events)
        for a, b in ((step, step), (-step, -step))
    }
    assert len(found) == 2


def test_boxes_too_large():
    """At once, or after the saddle has spread them."""
    x, v = (interval.around(q, Fraction(3, 10)) for q in P_STAR)
    refused(PAPER, (x, v), Ball(7), "event", "flight", "end", "windows")
    saddle = [interval.around(Fraction(q), HAIR) for q in ("0.34352606", "0.7753195")]
    after_periods(PAPER, *saddle, 3)
    refused(PAPER, saddle, 50 * oscillator(PAPER).T, "event", "flight", "end", "windows")


@pytest.mark.parametrize("bad", [Ball("nan"), Ball("inf"), Ball(0, "inf")], ids=str)
@pytest.mark.parametrize("name", ["box", "monodromy"])
def test_sets_that_are_not_finite(monkeypatch, name, bad):
    """Every number would be in them: that is not told as a result."""
    one = Ball(1)
    monkeypatch.setattr(propagation, "_plan", lambda _p, _osc, _cloud, end: ((), end))
    monkeypatch.setattr(propagation._Doubleton, "advance", lambda *_: [])
    far(PAPER, P_STAR, 1)
    value = (one, bad) if name == "box" else ((one, one), (bad, one))
    monkeypatch.setattr(propagation._Doubleton, name, lambda _: value)
    with pytest.raises(NotProved, match="too large"):
        far(PAPER, P_STAR, 1)


def test_beginnings_that_are_undecided():
    """The velocity may vanish; the box may leave the walls; rest at a border of friction."""
    refused(PAPER, (Ball(0), Ball(0, 0.1)), Ball(1), "start")
    refused(PAPER, (Ball(0, 2), Ball(1)), Ball(1), "start")
    begin = State(oscillator(PAPER).slow(1, 0), Ball(0), Ball(0))
    with pytest.raises(NotProved):
        propagate(PAPER, begin, Ball(9))


@pytest.mark.parametrize("start", [(P_STAR, 0), (("1/3", 0), "3/2")], ids=["moving", "resting"])
def test_ends_that_are_no_time_after_the_start(start):
    """Before the start, not finite, or so thick that it may be before it."""
    state, since = start
    begin = starting(oscillator(PAPER), tuple(map(Fraction, state)), since)
    for end in (Ball(-1), begin.at.t - 1e-9, Ball("nan"), Ball("inf"), Ball(1, 10)):
        with pytest.raises(NotProved):
            propagate(PAPER, begin, end)


def test_a_thick_end():
    """What is told of the end holds at each of its times."""
    box = starting(oscillator(PAPER), P_STAR, radius=HAIR)
    for thick in (Ball(7.5, 0.25), Ball(14, 0.5), Ball(20, 12)):
        try:
            image = propagate(PAPER, box, thick)
        except NotProved:
            continue
        for end in (interval.lower(thick), thick.mid(), interval.upper(thick)):
            sharp = propagate(PAPER, box, end)
            assert all(a.overlaps(b) for a, b in zip(image.state, sharp.state, strict=True))
