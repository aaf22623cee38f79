"""The float flow where events are hard to tell apart, or begin where they happen."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from test_swarm import compare

from cap.floats.engine.swarm import follow, itinerary
from cap.parameters import PAPER

HELD = 1.1592794807274087  # |a| = f, falling: the double above acos(2/5), held already
LOOSE = np.pi - HELD  # |a| = f, growing, to the left
CLOSEST = [1e-2, 1e-4, 1e-7, 1e-10, 1e-13, 1e-15]


def words(state, periods=1.0, t0=0.0, p=PAPER):
    """Return the words of an orbit."""
    return [event.word for event in itinerary(p, state, periods, t0)]


def borderline(kind, low, high, t0=0.0):
    """Return the velocity between two, at x = 0, at which an event at first comes or goes."""
    few = words((0.0, low), 0.5, t0)[0] == kind
    assert few != (words((0.0, high), 0.5, t0)[0] == kind)
    while low < (middle := (low + high) / 2) < high:
        if (words((0.0, middle), 0.5, t0)[0] == kind) == few:
            low = middle
        else:
            high = middle
    return low


@pytest.mark.parametrize("distance", CLOSEST)
@pytest.mark.parametrize("side", [-1, 1])
def test_turn_next_to_a_hit(distance, side):
    """A mass that just reaches a wall, or turns just before it, is where it is in mpmath."""
    v = borderline("hit r", 0.1, 0.9)
    compare(PAPER, (0.0, v + side * distance), 1)
    turn = itinerary(PAPER, (0.0, v - distance), 1)[0]
    assert turn.word in ("turn left", "stick")
    assert 0 <= 1 - turn.x < 3 * distance


@pytest.mark.parametrize("distance", CLOSEST)
@pytest.mark.parametrize("side", [-1, 1])
def test_brief_stick(distance, side):
    """Speed almost 0 when the forcing begins to grow: a stick and a release, or neither."""
    v = borderline("stick", 0.1, 0.3, 4.5)
    compare(PAPER, (0.0, v + side * distance), 1, 4.5)


def test_two_events_within_a_millionth():
    """Pairs of events less than 1e-6 apart are both found, as in mpmath."""
    v, closest = borderline("stick", 0.1, 0.3, 4.5), []
    for distance in (3e-14, 1e-13, 3e-13):
        for state in [(0.0, v - distance), (0.0, v + distance)]:
            events = itinerary(PAPER, state, 1, 4.5)
            closest += [b.time - a.time for a, b in pairwise(events)]
            compare(PAPER, state, 1, 4.5)
    assert 0 < min(closest) < 1e-6


def test_grazing_is_said():
    """At the borderlines, and only there, the orbit is flagged."""
    v = borderline("hit r", 0.1, 0.9)
    states = [(0.0, v), (0.0, v + 1e-6), (0.0, v - 1e-6)]
    assert follow(PAPER, states, 1).grazing.tolist() == [True, False, False]


@pytest.mark.parametrize(("wall", "inward"), [(1.0, "r"), (-1.0, "l")])
def test_start_at_a_wall(wall, inward):
    """Moving into the wall is a hit at once, moving off is not."""
    into = itinerary(PAPER, (wall, 0.7 * wall), 1)
    off = itinerary(PAPER, (wall, -0.7 * wall), 1)
    assert (into[0].word, into[0].time, into[0].after) == (f"hit {inward}", 0.0, -0.7 * wall)
    assert into[1:] == off
    compare(PAPER, (wall, 0.7 * wall), 1)
    compare(PAPER, (wall, -0.7 * wall), 1)


@pytest.mark.parametrize("t0", [0.0, 1.0, 1.5, 3.0, 4.0, 5.0, 6.0, HELD, LOOSE, 2 * np.pi - HELD])
@pytest.mark.parametrize("x", [-1.0, -0.3, 1.0])
def test_start_at_rest(x, t0):
    """At rest between the walls or at one, pushed to any side, or just held, or just released."""
    compare(PAPER, (x, 0.0), 1.5, float(t0))


def test_rest_is_exact():
    """A captured mass is at the wall, a stuck one does not move, until the release."""
    swarm = follow(PAPER, [(0.999, 0.001), (0.999, -0.001)], 0.25)
    assert swarm.captured.all()
    np.testing.assert_array_equal(swarm.states, [(1.0, 0.0)] * 2)
    stuck = [event for event in itinerary(PAPER, (0.0, 0.0), 4) if "st" in event.word or event.x]
    pairs = [(a, b) for a, b in pairwise(stuck) if a.word == "stick"]
    assert all(a.x == b.x and b.word.startswith("release") for a, b in pairs)


def test_capture_is_the_limit_of_bounces():
    """The time of capture does not depend on where the bounces are summed up."""
    first = follow(PAPER, [(0.999, 0.001)], 0.25).first_time("capture")[0]
    for event in itinerary(PAPER, (0.999, 0.001), 0.25):
        if event.word != "hit r":
            continue
        turns = event.time / (2 * np.pi)
        late = follow(PAPER, [(1.0, event.after)], 0.25 - turns, event.time)
        assert abs(late.first_time("capture")[0] - first) < 4e-15


def test_end_within_the_bounces():
    """An orbit that ends before its bounces accumulate is still bouncing, and goes on so."""
    captured = follow(PAPER, [(0.999, 0.001)], 0.25).first_time("capture")[0]
    for before in (1e-3, 1e-6, 1e-8, 1e-9, 1e-11):
        part = (captured - before) / (2 * np.pi)
        end = follow(PAPER, [(0.999, 0.001)], part)
        assert not end.captured[0]
        assert 0 < abs(end.states[0, 1]) < before
        rest = follow(PAPER, end.states, 0.25, captured - before)
        # x is known up to 1e-16, which the mass passes at a speed of about half the time left
        assert abs(rest.first_time("capture")[0] - captured) < min(before, 1e-15 / before)
        assert rest.states.tolist() == [[1.0, 0.0]]


def test_release_at_the_end_of_a_period():
    """A release when the clock restarts happens once, and at that time."""
    for t0 in (LOOSE, np.nextafter(LOOSE, 0), np.nextafter(LOOSE, 4)):
        swarm = follow(PAPER, [(0.2, 0.0), (1.0, 0.0)], 3, float(t0), every=True)
        assert not swarm.lost.any()
        assert (swarm.states[:, 1] < [0.2, 1.0]).any(axis=1).all()
        compare(PAPER, (0.2, 0.0), 2.5, float(t0))
        assert words((1.0, 0.0), 1, float(t0))[0] == "release left"
    waiting = itinerary(PAPER, (0.2, 0.0), 1, HELD + 0.01)
    through = itinerary(PAPER, (0.2, 0.0), 1 - (HELD + 0.01 - LOOSE) / (2 * np.pi), LOOSE)
    assert waiting[0].word == "release left"
    assert abs(waiting[0].time - LOOSE) < 1e-15
    assert waiting[1].word == through[1].word


@pytest.mark.parametrize("e", [Fraction(1), Fraction(1, 2)])
@pytest.mark.parametrize("state", [(0.3, 0.4), (1.0, -0.1), (-1.0, 0.0), (0.9, -1.3)])
def test_without_friction(state, e):
    """At f = 0 nothing sticks between the walls, and with e < 1 walls still capture."""
    p = replace(PAPER, f=Fraction(0), e=e)
    swarm = follow(p, [state], 3)
    assert not swarm.stuck[0]
    assert swarm.captured[0] <= (e < 1)
    compare(p, state, 1)


@pytest.mark.slow
@pytest.mark.parametrize("state", [(0.3, 0.4), (0.2, -1.7), (0.999, 0.001)])
def test_viscosity_has_a_limit(state):
    """As μ -> 0 the end tends to that without viscosity, at the rate of μ."""
    limit = follow(PAPER, [state], 1).states[0]
    for k in range(3, 16):
        end = follow(replace(PAPER, mu=Fraction(1, 10**k)), [state], 1).states[0]
        assert np.abs(end - limit).max() < 30 * 10.0**-k + 1e-14
    compare(replace(PAPER, mu=Fraction(1, 10**9)), state, 1, digits=50)


@pytest.mark.slow
@pytest.mark.parametrize("mu", [2, 5])
def test_much_viscosity(mu):
    """A mass that hardly keeps its speed is where it is in mpmath."""
    compare(replace(PAPER, mu=Fraction(mu)), (0.3, 1.4), 1)
