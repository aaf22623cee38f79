"""Inelastic walls: the mass is slowest just after a hit, if it then speeds up."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import certified
from mpmath import mp, workdps
from oracle_flow import State, System, orbit
from support import holds, rational

from cap.flow.event import BALLS, TAYLOR_MODELS
from cap.parameters import PAPER

HALF = replace(PAPER, e=Fraction(1, 2))


@pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
@pytest.mark.parametrize("start", [0, 1, 2])
@pytest.mark.parametrize("p", [HALF, PAPER], ids=["e = 1/2", "e = 1"])
def test_the_least_speed(p, start, kind):
    """That of the whole orbit, at 300 times and just before and after each hit, in mpmath."""
    state, end = (Fraction(0), Fraction(3, 2)), Fraction(start) + 3
    _, _, proved = certified(p, state, end, start=start, kind=kind)
    assert all(event.word.startswith("hit") for event in proved.events)
    with workdps(30):
        events, _ = orbit(p, start, *state, end)
        system, speeds = System(p), [mp.mpf(3) / 2]
        begin = State(mp.mpf(start), mp.mpf(0), speeds[0], 1)
        for t in [start + mp.mpf(k) / 100 for k in range(1, 301)]:
            while events and events[0].time < t:
                hit = events.pop(0)
                speeds += [abs(hit.before), abs(hit.after)]
                begin = State(hit.time, hit.x, hit.after, -begin.s)
            speeds.append(abs(system.flight(begin, t)[1]))
        least = rational(min(speeds))
    assert holds(proved.least_speed, least, Fraction(1, 10**4))
    assert proved.least_speed.rad() < 1e-9
