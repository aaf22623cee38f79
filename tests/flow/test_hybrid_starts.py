"""How orbits begin: at a wall or inside, moving or at rest, at any phase of the forcing."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import BITS, OILY, SOFT, certified, moment, starting
from support import holds

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.strobe import State, follow, oscillator
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

KINDS = pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
WORDS = (
    *("hit r", "hit l", "turn right", "turn left", "stick"),
    *("capture r", "capture l", "release right", "release left"),
)


STARTS = {  # x, v, wall, start: the events until start + 1/2, or the reason of the refusal
    "away from r": ("1", "-2", 1, 0, ()),
    "away from l": ("-1", "2", -1, 0, ()),
    "from r, that holds": ("1", "-1/100", 1, 0, ("turn right", "hit r", "capture r")),
    "into r": ("1", "1/2", 1, 0, "moves into the wall"),
    "into l": ("-1", "-1/2", -1, 3, "moves into the wall"),
    "at r, unsaid": ("1", "1/2", 0, 0, "between the walls"),
    "beyond r": ("2", "-1/2", 0, 0, "between the walls"),
    "rest, pushed right": ("0", "0", 0, 0, ()),
    "rest, pushed left": ("0", "0", 0, 3, ()),
    "rest, held": ("0", "0", 0, "7/5", ()),
    "rest, held, later released": ("0", "0", 0, "19/10", ("release left",)),
    "rest, held, released right": ("0", "0", 0, "5", ("release right",)),
    "at r, pressed": ("1", "0", 1, 0, ()),
    "at r, pressed in the past": ("1", "0", 1, -6, ()),
    "at r, held by friction": ("1", "0", 1, "7/5", ()),
    "at r, released": ("1", "0", 1, "19/10", ("release left",)),
    "at r, pushed off": ("1", "0", 1, 3, ()),
    "at r, no release inwards": ("1", "0", 1, "5", ()),
    "at l, pressed": ("-1", "0", -1, 3, ()),
    "at l, pushed off": ("-1", "0", -1, 0, ()),
    "at l, released": ("-1", "0", -1, 5, ("release right",)),
}


@KINDS
@pytest.mark.parametrize("p", [PAPER, SOFT, OILY], ids=["elastic", "soft", "viscous"])
@pytest.mark.parametrize("name", STARTS)
def test_starts(name, p, kind):
    """At a wall and inside, moving and at rest, at any time; against the orbit in floats."""
    x, v, wall, start, outcome = STARTS[name]
    state, start = (Fraction(x), Fraction(v)), Fraction(start)
    end = start + Fraction(1, 2)
    with interval.workprec(BITS):
        if isinstance(outcome, str):
            osc = oscillator(p)
            box = (interval.ball(state[0]), interval.ball(state[1]))
            with pytest.raises(NotProved, match=outcome):
                follow(osc, State(moment(osc, start), *box, wall), (), moment(osc, end), kind)
            return
        path, events, orbit = certified(p, state, end, start=start, wall=wall, kind=kind)
        if name != "from r, that holds":
            assert path.words == outcome
        assert tuple(event.word for event in orbit.events) == path.words
        for ball, value in zip(orbit.end, path.end, strict=True):
            assert holds(kind.bound(ball), value, Fraction(1, 10**13))
        assert (orbit.s == 0) == (state[1] == 0 and (path.words != () or path.end[1] == 0))
        osc = oscillator(p)
        begin = starting(osc, state, start, wall=wall, kind=kind)
        for word in WORDS:
            if (word,) != path.words[:1]:
                window = interval.around(start + Fraction(1, 10), Fraction(1, 1000))
                with pytest.raises(NotProved):
                    follow(osc, begin, (Expected(word, window), *events), moment(osc, end), kind)


@pytest.mark.parametrize("start", [Fraction(19, 10), Fraction(5), Fraction(-6, 5)])
def test_the_next_release_counts(start):
    """A rest inside ends at the first release, never at the next one to the other side."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        path, events, _ = certified(PAPER, (0, 0), start + Fraction(1, 2), start=start)
        for word in ("release right", "release left"):
            if word != path.words[0]:
                for later in (2, 4):
                    end = moment(osc, start + later)
                    wrong = (events[0]._replace(word=word),)
                    with pytest.raises(NotProved, match="another, or undecided"):
                        follow(osc, starting(osc, (0, 0), start), wrong, end, BALLS)


@KINDS
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("wall", [0, 1, -1])
def test_a_rest_exactly_at_a_release(kind, side, wall):
    """At the phase where |F cos ωt| = f: whether the mass moves at once is not decided.

    It is if a wall is in the way: then it rests.
    """
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        slow = osc.slow(side, 0)
        near = interval.around(interval.midpoint(slow.t), Fraction(1, 10**9))
        times = [slow, osc.moment(slow.t), osc.moment(near)]
        x = osc.wall(wall) if wall else Ball(0)
        for at in times:
            for words in ((), ("release right",), ("release left",), ("stick",)):
                events = tuple(Expected(word, at.t) for word in words)
                end = osc.moment(at.t + Ball(1) / 10)
                if wall == side and not words:
                    assert follow(osc, State(at, x, Ball(0), wall), (), end, kind).s == 0
                    continue
                with pytest.raises(NotProved):
                    follow(osc, State(at, x, Ball(0), wall), events, end, kind)


def test_a_release_between_two_walls_of_friction():
    """f within 1e-12 of F: hardly ever released; and f = 0: no rest inside at all."""
    tight = replace(PAPER, f=1 - Fraction(1, 10**12))
    with interval.workprec(BITS):
        _, _, orbit = certified(tight, (0, 0), 5, start=1)
        assert [event.word for event in orbit.events] == ["release left", "stick"]
        assert abs(orbit.end[0]) < 1e-15
        free = replace(PAPER, f=Fraction(0))
        osc = oscillator(free)
        quarter = osc.T / 4
        for start in (quarter, 3 * quarter):
            begin = State(osc.moment(start), Ball(0), Ball(0))
            with pytest.raises(NotProved, match="undecided"):
                follow(osc, begin, (), osc.moment(start + 1), BALLS)
        _, _, orbit = certified(free, (1, 0), 2, wall=1)
        assert [event.word for event in orbit.events] == ["release left"]
        assert orbit.events[0].time.overlaps(quarter)
