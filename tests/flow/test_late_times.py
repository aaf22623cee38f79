"""Late times and places far away: periods are counted in balls, however many there have been."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import MIXED, starting
from support import decimal_fraction, rounds, seeded

from cap.errors import NotProved
from cap.flow.event import next_slow, slow_numbers
from cap.flow.propagation import propagate
from cap.flow.strobe import State, oscillator
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.sets.interval import Ball

ROOMY = Parameters(Fraction(1), Fraction(1), Fraction(1, 10), Fraction(-100), Fraction(100))
LATE = [0, 1, 3 * 10**5, 18 * 10**9, 10**17 + 1, -(10**17) - 1, 10**25 + 7]
BITS = 200


@pytest.mark.parametrize("periods", LATE)
@pytest.mark.parametrize("s", [1, -1])
def test_all_slow_moments_are_numbered(periods, s):
    """Of short and long intervals, n periods late; and hardly any others."""
    random = seeded(periods)
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        for _ in range(rounds(100)):
            k, before, after = (
                periods + random.randint(-3, 3),
                *(abs(decimal_fraction(random)) / 10 ** random.choice([0, 3, 12]) for _ in "ab"),
            )
            t = osc.slow(s, k).t
            numbers = slow_numbers(osc, s, t - interval.ball(before), t + interval.ball(after))
            assert k in numbers
            assert len(numbers) <= 1 + (before == 0 or after == 0)
            assert k not in slow_numbers(osc, s, t + Ball(1) / 10**9, t + interval.ball(after) + 1)
            assert next_slow(osc, s, t + Ball(1) / 10**9) == k + 1


@pytest.mark.parametrize("periods", LATE)
def test_an_orbit_that_turns_late(periods):
    """It turns twice in each period, also in the last: no turning is overlooked."""
    with interval.workprec(BITS):
        osc = oscillator(ROOMY)
        start = osc.moment(periods * osc.T)
        begin = State(start, Ball(0), interval.ball(Fraction(7, 10)))
        image = propagate(ROOMY, begin, start.t + osc.T)
        assert [event.word for event in image.events] == ["turn left", "turn right"]


@pytest.mark.parametrize("name", MIXED)
@pytest.mark.parametrize("periods", [10**6, 10**17 + 1])
def test_an_orbit_and_the_same_one_later(name, periods):
    """The same events, the same periods later; sets that overlap and are hardly wider."""
    p, x, v, start, end = MIXED[name]
    state, times = (Fraction(x), Fraction(v)), (Fraction(start), Fraction(end))
    with interval.workprec(BITS):
        osc = oscillator(p)
        late = periods * osc.T
        soon = propagate(p, starting(osc, state, times[0]), interval.ball(times[1]))
        begin = State(osc.moment(late + interval.ball(times[0])), *map(interval.ball, state))
        then = propagate(p, begin, late + interval.ball(times[1]))
        assert [e.word for e in then.events] == [e.word for e in soon.events]
        assert then.wall == soon.wall
        for one, other in zip(soon.events, then.events, strict=True):
            assert (one.time + late).overlaps(other.time)
        for one, other in zip(soon.state, then.state, strict=True):
            assert one.overlaps(other)
            assert other.rad() < 1e-30


def test_times_too_late_for_the_precision():
    """If not even the period is known nothing is told, at any time however absurd."""
    osc = oscillator(PAPER)
    for time in (10**17 * osc.T, Ball("1e30"), Ball("1e400"), Ball("-1e10000000000000000000")):
        begin = State(osc.moment(time), Ball(0), Ball(1))
        for end in (time + 7, Ball("1e10000000000000000000")):
            with pytest.raises(NotProved):
                propagate(PAPER, begin, end)
            with pytest.raises(NotProved, match="too uncertain"):
                slow_numbers(osc, 1, time, end)
    with pytest.raises(NotProved, match="periods away"):
        propagate(PAPER, starting(osc, (Fraction(0), Fraction(1))), Ball("1e30"))


def test_a_thick_time_is_not_its_own_end():
    """The same ball may hold one time of the start and another of the end."""
    time = Ball(1, 0.5)
    begin = State(oscillator(PAPER).moment(time), Ball(0), Ball(1))
    for end in (time, begin.at.t):
        with pytest.raises(NotProved, match="after all that comes before"):
            propagate(PAPER, begin, end)


@pytest.mark.parametrize("name", MIXED)
def test_an_orbit_and_the_same_one_far_away(name):
    """Walls at 10^20 and a little more, which floats hold for one: the same events, and times."""
    p, x, v, start, end = MIXED[name]
    far = Fraction(10**20) + Fraction(1, 3)
    away, state = replace(p, l=p.l + far, r=p.r + far), (Fraction(x) + far, Fraction(v))
    with interval.workprec(BITS):
        osc, until = oscillator(p), interval.ball(Fraction(end))
        near = propagate(p, starting(osc, (Fraction(x), Fraction(v)), Fraction(start)), until)
        image = propagate(away, starting(oscillator(away), state, Fraction(start)), until)
        assert [e.word for e in image.events] == [e.word for e in near.events]
        for one, other in zip(image.events, near.events, strict=True):
            assert one.time.overlaps(other.time)
        assert image.state[0].overlaps(near.state[0] + interval.ball(far))
        assert image.state[1].overlaps(near.state[1])
