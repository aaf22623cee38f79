"""Two events almost at once, and events in doubt: certified, or refused; never the wrong one."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import BITS, certified, moment, starting
from support import between, holds

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.itinerary import itinerary
from cap.flow.strobe import follow, oscillator
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

KINDS = pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])


@KINDS
def test_a_turn_next_to_a_hit(kind):
    """A wall 1e-14 beyond the turning point, or before it: 1e-7 apart in time; never both."""
    state, far = (Fraction(0), Fraction(7, 10)), replace(PAPER, l=Fraction(-5), r=Fraction(5))
    with interval.workprec(BITS):
        _, _, orbit = certified(far, state, 4)
        turn = interval.midpoint(orbit.events[0].time)
        osc = oscillator(far)
        flight = osc.launch(1, osc.moment(Ball(0)), *map(interval.ball, state))
        place = interval.midpoint(osc.position(flight, moment(osc, turn)))
        end = turn + Fraction(1, 100)

        def attempt(gap, word, width, radius):
            p = replace(far, r=place + gap)
            o, events = oscillator(p), (Expected(word, interval.around(turn, width)),)
            begin = starting(o, state, radius=radius, kind=kind)
            return follow(o, begin, events, moment(o, end), kind)

        hair = Fraction(1, 10**14)
        for width in (Fraction(1, 10**10), Fraction(1, 10**6), Fraction(1, 10**3)):
            assert attempt(hair, "turn left", width, 0).events[0].word == "turn left"
            for gap, word, radius in (
                (hair, "hit r", 0),
                (-hair, "turn left", 0),
                (-hair, "hit r", 0),  # the window holds both crossings, or none
                (Fraction(0), "turn left", 0),
                (Fraction(0), "hit r", 0),
                (hair, "turn left", 10 * hair),
                (-hair, "hit r", 10 * hair),
                (hair, "stick", 0),
                (hair, "turn right", 0),
            ):
                with pytest.raises(NotProved) as caught:
                    attempt(gap, word, width, radius)
                assert caught.value.step == "event 1"
        p = replace(far, r=place - hair)
        path, events, hit = certified(p, state, end, radius=0, kind=kind)
        assert path.words == ("hit r",)
        assert 0 < turn - Fraction(path.events[0].time) < Fraction(1, 10**6)
        assert holds(kind.bound(hit.events[0].velocity), path.events[0].velocity, hair * 10**6)
        with pytest.raises(NotProved):
            certified(p, state, end, radius=10 * hair, kind=kind)
        osc, formal = oscillator(p), Expected("turn left", interval.around(turn, hair))
        with pytest.raises(NotProved):  # the turn on paper, beyond the wall
            follow(osc, starting(osc, state, kind=kind), (*events, formal), moment(osc, end), kind)


def test_two_hits_of_one_wall():
    """Hit, turn, hit within 1e-6: all are certified; not two of them, nor one window of all."""
    state = 1 - Fraction(1, 10**12), Fraction(1, 10**6)
    with interval.workprec(BITS):
        hit = itinerary(PAPER, 1 - 1e-12, 1e-6, 1.0).events[0]
        up = hit.time + hit.velocity / 1.4  # F cos ωt = 1, with friction against it, then with it
        down = up + hit.velocity / 1.4 * (1.4 / 0.6) ** 0.5
        words = ("hit r", hit.time), ("turn right", up), ("hit r", down)
        near = Fraction(1, 10**9)
        events = [Expected(word, interval.around(Fraction(t), near)) for word, t in words]
        osc, end = oscillator(PAPER), Fraction(down) + 10 * near
        assert down < 4e-6
        begin = starting(osc, state)
        orbit = follow(osc, begin, events, moment(osc, end), BALLS)
        assert [event.word for event in orbit.events] == [word for word, _ in words]
        one, turn, two = events
        both = Expected("hit r", between(Fraction(hit.time) / 2, end))
        for wrong in (
            *([one], [one, turn], [one, two], [both], [both, turn, two], [turn, two]),
            *(events[::-1], [*events, turn], [one, turn, both], [one, one, two]),
        ):
            with pytest.raises(NotProved):
                follow(osc, begin, wrong, moment(osc, end), BALLS)


@pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
def test_turning_or_sticking_in_doubt(kind):
    """|F cos ωt| straddles f where v vanishes: neither; and never to the wrong side."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        boundary = interval.midpoint(interval.ball(PAPER.f).acos())  # F cos ωt falls to f
        near = Fraction(1, 10**6)
        for shift, word in ((near, "stick"), (-near, "turn right"), (Fraction(0), None)):
            rest = boundary + shift
            start = rest - Fraction(1, 100)
            back = osc.launch(-1, moment(osc, rest), Ball(0), Ball(0))
            at = moment(osc, start)
            state = osc.position(back, at), osc.velocity(back, at)
            state = tuple(map(interval.midpoint, state))
            assert state[1] < 0

            def attempt(word, radius, rest=rest, start=start, state=state):
                events = (Expected(word, interval.around(rest, Fraction(1, 10**4))),)
                begin = starting(osc, state, start, radius=radius, kind=kind)
                return follow(osc, begin, events, moment(osc, rest + near / 10), kind)

            if word:
                assert attempt(word, Fraction(1, 10**15)).events[0].word == word
            for other in {"stick", "turn right", "turn left"} - {word}:
                with pytest.raises(NotProved) as caught:
                    attempt(other, Fraction(1, 10**15))
                assert "undecided" in caught.value.reason
            for other in ("stick", "turn right", "turn left"):
                with pytest.raises(NotProved, match="undecided"):
                    attempt(other, Fraction(1, 10**5))
