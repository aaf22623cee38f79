"""The guards of the folded flow: of events that are not certain each is refused for its reason."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from cap.checker.attracting import cycles, sinks
from cap.checker.folded import events, flights, motion, paths
from cap.checker.folded.events import hit, stop
from cap.checker.folded.instants import stopping
from cap.checker.folded.motion import upcoming
from cap.checker.kernel import line
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.line import DEGREE
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Parameters

PAPER = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)))
A = 0.4  # the friction
THETA = math.acos(A)
SLOW = 2 * math.pi - THETA  # the first slow time after 0, at which the first arc ends
AHEAD, BACK = motion.System(PAPER, forwards=True), motion.System(PAPER)
LINES = flights.System(PAPER)
EXACT = (1.0, 0.0, 0.0, 1.0)
BEGUN = 1.3  # in the first arc, in which masses stop


def flight(p, s, t=0.0, errors=(0.0, 0.0)):
    """Return the flight of one state, as models in two variables."""
    models = q.model(one=s - math.sin(t)), q.model(one=p + math.cos(t))
    return motion.Flight((t, t), t, *models, EXACT, errors, errors, 1, 0)


def path(p, s, t=0.0, errors=(0.0, 0.0)):
    """Return the flight of one state, as models in one variable."""
    zeros = (0.0,) * DEGREE
    models = (s - math.sin(t), *zeros), (p + math.cos(t), *zeros)
    return flights.Path((t, t), t, *models, EXACT, errors, errors, 1)


def falling(T, t=BEGUN):
    """Return the speed at t of which at T, by the formula, nothing is left."""
    return math.sin(t) - math.sin(T) + A * (T - t)


# hits, in two variables


def test_a_hit_is_refused_if_the_speed_may_vanish():
    """The errors of the speed are larger than the speed."""
    f = flight(-1, 2)
    _, near, _ = upcoming(AHEAD, f)
    slowest = hit(AHEAD, f, near).speeds[0]
    hit(AHEAD, flight(-1, 2, errors=(0.1 * slowest, 0.0)), near)
    with pytest.raises(Rejected, match="the mass may stop, or hit"):
        hit(AHEAD, flight(-1, 2, errors=(1.1 * slowest, 0.0)), near)


def test_a_hit_is_refused_if_its_time_is_not_certain():
    """The error of the place is not small beside the square of the speed: it may not take place."""
    f = flight(-1, 2)
    _, near, _ = upcoming(AHEAD, f)
    square = hit(AHEAD, f, near).speeds[0] ** 2
    known = hit(AHEAD, flight(-1, 2, errors=(0.0, square / 9)), near)
    assert known.e_all == pytest.approx(2 * math.sqrt(square) / 9, rel=1e-6)
    with pytest.raises(Rejected, match="the time of a hit is not certain"):
        hit(AHEAD, flight(-1, 2, errors=(0.0, square / 7)), near)


def test_a_hit_is_refused_if_it_may_be_at_times_far_apart():
    """Within three is allowed, and no more."""
    f = flight(-1, 8)
    _, near, _ = upcoming(BACK, f)
    ends = hit(BACK, flight(-1, 8, errors=(0.0, 5.6)), near).ends
    assert 2.5 < ends[1] - ends[0] < 3
    with pytest.raises(Rejected, match="the time of a hit is not certain"):
        hit(BACK, flight(-1, 8, errors=(0.0, 6.4)), near)


@pytest.mark.parametrize("y", [AHEAD, BACK])
def test_a_hit_is_refused_if_it_may_be_before_the_start(y):
    """A slow time, or it may be the one before, lies between; else it is after the start."""
    slow = y.slow(0)[0]
    for low, start, certain in (
        (slow - 0.1, slow - 0.2, True),
        (slow - 0.1, slow + 0.1, False),
        (slow + 0.1, slow + 0.2, True),
        (slow + 0.1, slow - 0.1, True),
        (slow + 2 * math.pi - 0.1, slow + 2 * math.pi + 0.1, False),
        (slow - 2 * math.pi + 0.9, slow - 0.1, False),
        (slow - 2 * math.pi + 1.1, slow - 0.1, True),
    ):
        f = flight(-1, 1)._replace(begun=(start, start))
        if certain:
            y.since_start(f, low)
        else:
            with pytest.raises(Rejected, match="a hit may be before the start"):
                y.since_start(f, low)


def test_a_flight_is_refused_if_it_is_too_long():
    """In either number of variables; the mass moves at all slow times that are looked at."""
    AHEAD.moving(flight(-1, 50), 30)
    with pytest.raises(Rejected, match="a flight is too long"):
        AHEAD.moving(flight(-1, 50), 40)
    paths.moving(LINES, path(-1, 50), 60)
    with pytest.raises(Rejected, match="a flight is too long"):
        paths.moving(LINES, path(-1, 50), 80)


def test_a_flight_is_refused_if_the_mass_may_stop():
    """At the next slow time it nearly does, or does; in either number of variables."""
    for left, moves in ((0.1, True), (-0.1, False), (1e-16, False)):
        s = falling(SLOW) + left
        for moving in (
            lambda s=s: AHEAD.moving(flight(-20, s, BEGUN), 6),
            lambda s=s: paths.moving(LINES, path(-20, s, BEGUN), 6),
        ):
            if moves:
                moving()
            else:
                with pytest.raises(Rejected, match="the mass may stop, or not"):
                    moving()


# stops, in two variables


def test_a_stop_is_refused_if_its_time_is_not_certain():
    """The error of the speed is not small beside the square of the force."""
    T = 2.3
    f = flight(-5, falling(T), BEGUN)
    square = (A - math.cos(T)) ** 2
    known = stop(AHEAD, f._replace(errors=(square / 5, 0.0), R=(square / 5, 0.0)), T, 1)
    assert known.e_all == pytest.approx(2 * math.sqrt(square) / 5, rel=1e-6)
    with pytest.raises(Rejected, match="the time of a stop is not certain"):
        stop(AHEAD, f._replace(errors=(square / 3, 0.0), R=(square / 3, 0.0)), T, 1)


def bouncing():
    """Return speed and time of a stop that the formula forgets: it stops again, an arc later."""
    s = falling(SLOW) - 0.05
    f = flight(-20, s, BEGUN)
    return s, 9.2 + stopping(AHEAD, f, 9.2)[0]


def test_a_stop_is_refused_in_another_arc():
    """By the formula the mass stops in the first arc and in the second; and in the second only."""
    s, T = bouncing()
    with pytest.raises(Rejected, match="a stop may be in another arc"):
        stop(AHEAD, flight(-20, s, BEGUN), T, 1)
    with pytest.raises(Rejected, match="the mass may stop, or not"):
        stop(AHEAD, flight(-20, s, BEGUN), T, 2)
    f = flight(-20, s + 0.1, BEGUN)
    later = T + stopping(AHEAD, f, T)[0]
    assert stop(AHEAD, f, later, 2).ends[0] > SLOW
    for k in (1, 3):
        with pytest.raises(Rejected, match="a stop may be in another arc"):
            stop(AHEAD, f, later, k)


def test_a_stop_is_refused_if_the_flight_may_begin_after_its_arc():
    """Some of the orbits may not fly yet."""
    f = flight(-5, falling(2.3), BEGUN)
    stop(AHEAD, f._replace(begun=(BEGUN, SLOW - 0.1)), 2.3, 1)
    with pytest.raises(Rejected, match="a flight may begin after the arc of a stop"):
        stop(AHEAD, f._replace(begun=(BEGUN, SLOW + 0.1)), 2.3, 1)


# in one variable


@pytest.mark.parametrize("m", [1.0, -1.0])
def test_an_event_is_refused_if_its_time_is_not_certain(m):
    """What is left of p or s, or how the slope varies, is too much for a contraction."""
    h = paths.event(path(-1, 2), (0.5, *[0.0] * DEGREE))
    assert paths.certain(h, m, 0.0, (0.1, 0.2), 1.2).e_all == pytest.approx(0.4)
    assert paths.certain(h, m, 0.4, (0.0, 0.0), 1.2).e_all == 0
    for change, left, K in ((0.0, 0.6, 0.0), (0.6, 0.0, 1.2), (0.0, 0.3, 1.2), (0.3, 0.1, 1.2)):
        with pytest.raises(Rejected, match="the time of an event is not certain"):
            paths.certain(h, m, change, (0.0, left), K)


def test_a_path_hits_forwards(monkeypatch):
    """By the formula the mass comes back from behind the wall: that is no hit."""
    f = path(-0.1, 1, BEGUN)

    def ahead(t):
        d = t - BEGUN
        return -math.cos(t) - A * d * d / 2 + f.A[0] * d + f.B[0]

    low, high = 2.0, 4.0
    assert ahead(low) > 0 > ahead(high)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if ahead(middle) > 0 else (low, middle)
    assert low < SLOW
    monkeypatch.setattr(paths, "hit_guess", lambda *_: (low, *[0.0] * DEGREE))
    with pytest.raises(Rejected, match="the mass may stop, or hit"):
        paths.hit(LINES, f, low)


def test_a_path_hits_after_its_start():
    """Times from which it is not known that the start was before."""
    slow = LINES.slows[0][0]
    for low, start, certain in (
        (slow - 0.1, slow - 0.2, True),
        (slow - 0.2, slow - 0.1, True),
        (slow - 0.1, slow + 0.1, False),
        (slow + 0.1, slow + 0.2, True),
        (SLOW - 0.1, SLOW + 0.1, False),
        (slow - 6.1, slow - 0.1, False),
        (slow - 5.9, slow - 0.1, True),
    ):
        f = path(-1, 1)._replace(begun=(start, start))
        if certain:
            paths.since_start(LINES, f, low)
        else:
            with pytest.raises(Rejected, match="a hit may be before the start"):
                paths.since_start(LINES, f, low)


@pytest.mark.parametrize("border", [math.pi - THETA, math.pi + THETA])
def test_a_path_sticks_or_turns(border):
    """What stops at a border does either; so does what stops next to it, less well known."""

    def stopped(T, error=0.0):
        return paths.stop(LINES, path(-9, falling(T), BEGUN, (error, 0.0)), T, 1)[1]

    outwards = math.copysign(0.01, border - math.pi)
    assert isinstance(stopped(border - outwards), flights.Path)
    assert not isinstance(stopped(border + outwards), flights.Path)
    for T, error in ((border, 0.0), (border - outwards, 0.01), (border + outwards, 0.01)):
        with pytest.raises(Rejected, match="a stick or a turn"):
            stopped(T, error)


def test_a_path_stops_in_its_arc():
    """Not in another one, nor before it begins."""
    s, T = bouncing()
    with pytest.raises(Rejected, match="a stop may be in another arc"):
        paths.stop(LINES, path(-20, s, BEGUN), T, 1)
    with pytest.raises(Rejected, match="the mass may stop, or not"):
        paths.stop(LINES, path(-20, s, BEGUN), T, 2)
    f = path(-20, s + 0.1, BEGUN)
    assert paths.stop(LINES, f, T, 2)[0] > SLOW
    for k in (1, 3):
        with pytest.raises(Rejected, match="a stop may be in another arc"):
            paths.stop(LINES, f, T, k)
    f = path(-5, falling(2.3), BEGUN)
    paths.stop(LINES, f._replace(begun=(BEGUN, SLOW - 0.1)), 2.3, 1)
    with pytest.raises(Rejected, match="a flight may begin after the arc of a stop"):
        paths.stop(LINES, f._replace(begun=(BEGUN, SLOW + 0.1)), 2.3, 1)


def test_a_path_is_folded_by_known_multiples_of_pi():
    """Times that are too large are refused."""
    h = paths.event(path(-1, 2), (100.0, *[0.0] * DEGREE))
    with pytest.raises(Rejected, match="a flight is too long"):
        paths.folded(LINES, h)


# sinks


def test_a_sink_does_not_reach_behind_a_wall():
    """There are no states: the wall behind is W from the one ahead."""
    W, v = AHEAD.width[0], q.model(one=1.0)
    sinks.launched(AHEAD, False, q.model(one=-W + 0.1, X=0.09), v)
    for p in (q.model(one=-W + 0.1, X=0.11), q.model(one=-W - 0.1, X=0.05), q.model(one=-W)):
        with pytest.raises(Rejected, match="a sink reaches behind a wall"):
            sinks.launched(AHEAD, False, p, v)


def test_after_a_rest_near_the_wall_no_slope_is_known():
    """The place is known, but a cycle needs the derivative."""
    known = line.across((0.3, 0.32))
    assert cycles.slope(known, (0.3, 0.4)) == pytest.approx(0.2, rel=1e-9)
    with pytest.raises(Rejected, match="a cycle of releases may rest near a wall"):
        cycles.slope(line.constant(0.31, 0.01), (0.3, 0.4))


def test_a_stop_is_transversal(monkeypatch):
    """Where the force drives the mass on it does not stop, whatever is guessed."""
    T = 0.5
    s = falling(T, 0.1)
    monkeypatch.setattr(paths, "stop_guess", lambda *_: (T, *[0.0] * DEGREE))
    with pytest.raises(Rejected, match="a stop is not transversal"):
        paths.stop(LINES, path(-5, s, 0.1), T, 1)
    monkeypatch.setattr(events, "stopping", lambda *_: q.model())
    with pytest.raises(Rejected, match="a stop is not transversal"):
        stop(AHEAD, flight(-5, s, 0.1), T, 1)
