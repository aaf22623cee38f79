"""The guards of the folded flow: of events that are not certain each is refused for its reason."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from cap.checker.attracting import cycles, sinks
from cap.checker.folded import events, flights, motion, paths
from cap.checker.folded.events import hit, stop
from cap.checker.folded.instants import hitting, stopping
from cap.checker.folded.motion import upcoming
from cap.checker.kernel import line
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.line import DEGREE
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters

PAPER = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)))
A = 0.4  # the friction
THETA = math.acos(A)
SLOW = 2 * math.pi - THETA  # the first slow time after 0, at which the first arc ends
AHEAD, BACK = motion.Direction(PAPER, forwards=True), motion.Direction(PAPER)
LINES = motion.Releases(PAPER)
EXACT = (1.0, 0.0, 0.0, 1.0)
BEGUN = 1.3  # in the first arc, in which masses stop


def flight(p, s, t=0.0, errors=(0.0, 0.0)):
    """Return the flight of one state, as models in two variables."""
    models = q.model(one=s - math.sin(t)), q.model(one=p + math.cos(t))
    return flights.Flight((t, t), t, *models, EXACT, errors, errors, 1, 0)


def path(p, s, t=0.0, errors=(0.0, 0.0)):
    """Return the flight of one state, as models in one variable."""
    zeros = (0.0,) * DEGREE
    models = ((s - math.sin(t), *zeros), 0.0), ((p + math.cos(t), *zeros), 0.0)
    return flights.Flight((t, t), t, *models, EXACT, errors, errors, 1, 0)


def falling(T, t=BEGUN):
    """Return the speed at t of which at T, by the formula, nothing is left."""
    return math.sin(t) - math.sin(T) + A * (T - t)


# hits, in two variables


def test_a_hit_is_refused_if_the_speed_may_vanish():
    """The errors of the speed are larger than the speed."""
    f = flight(-1, 2)
    _, near, _ = upcoming(AHEAD, f)
    slowest = q.ends(hit(AHEAD, f, near).s)[0]
    hit(AHEAD, flight(-1, 2, errors=(0.1 * slowest, 0.0)), near)
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        hit(AHEAD, flight(-1, 2, errors=(1.1 * slowest, 0.0)), near)


def test_a_hit_is_refused_if_its_time_is_not_certain():
    """The error of the place is not small beside the square of the speed: it may not take place."""
    f = flight(-1, 2)
    _, near, _ = upcoming(AHEAD, f)
    square = q.ends(hit(AHEAD, f, near).s)[0] ** 2
    known = hit(AHEAD, flight(-1, 2, errors=(0.0, square / 6)), near)
    assert known.e_all == pytest.approx(2 * math.sqrt(square) / 6, rel=1e-6)
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        hit(AHEAD, flight(-1, 2, errors=(0.0, square / 5)), near)


def test_a_hit_is_refused_if_it_may_be_at_times_far_apart():
    """Within three is allowed, and no more."""
    f = flight(-1, 8)
    _, near, _ = upcoming(BACK, f)
    ends = hit(BACK, flight(-1, 8, errors=(0.0, 5.6)), near).ends
    assert 2.5 < ends[1] - ends[0] < 3
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        hit(BACK, flight(-1, 8, errors=(0.0, 6.4)), near)


@pytest.mark.parametrize("y", [AHEAD, BACK, LINES])
def test_a_hit_is_refused_if_it_may_be_before_the_start(y):
    """A slow time, or it may be the one before, lies between; else it is after the start."""
    slow, e = y.slow(0)
    for low, start, certain in (
        (slow + e / 2, slow + 0.1, False),
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
    for y, f in ((AHEAD, flight(-1, 50)), (LINES, path(-1, 50))):
        y.moving(f, 60)
        with pytest.raises(Rejected, match="a flight is too long"):
            y.moving(f, 80)


def test_a_flight_is_refused_if_the_mass_may_stop():
    """At the next slow time it nearly does, or does; in either number of variables."""
    for left, moves in ((0.1, True), (-0.1, False), (1e-16, False)):
        s = falling(SLOW) + left
        for moving in (
            lambda s=s: AHEAD.moving(flight(-20, s, BEGUN), 6),
            lambda s=s: LINES.moving(path(-20, s, BEGUN), 6),
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
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        stop(AHEAD, f._replace(errors=(square / 3, 0.0), R=(square / 3, 0.0)), T, 1)


def bouncing():
    """Return speed and time of a stop that the formula forgets: it stops again, an arc later."""
    s = falling(SLOW) - 0.05
    f = flight(-20, s, BEGUN)
    return s, stopping(AHEAD, f, 9.2)[0]


def test_a_stop_is_refused_in_another_arc():
    """By the formula the mass stops in the first arc and in the second; and in the second only."""
    s, T = bouncing()
    with pytest.raises(Rejected, match="a stop may be in another arc"):
        stop(AHEAD, flight(-20, s, BEGUN), T, 1)
    with pytest.raises(Rejected, match="the mass may stop, or not"):
        stop(AHEAD, flight(-20, s, BEGUN), T, 2)
    f = flight(-20, s + 0.1, BEGUN)
    later = stopping(AHEAD, f, T)[0]
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


@pytest.mark.parametrize(("y", "flown"), [(AHEAD, flight), (LINES, path)])
def test_an_event_is_not_looked_for_where_its_slope_is_not_positive(y, flown):
    """A hit of a mass that moves back, a stop while the speed grows."""
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        hitting(y, flown(-1, -2), 0.1)
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        stopping(y, flown(-1, 2), 0.1)


# in one variable


@pytest.mark.parametrize("models", [line, q])
def test_an_event_is_refused_if_its_time_is_not_certain(models):
    """What is left of p or s, or how the slope varies, is too much."""
    root = models.root
    one, known = (line.constant(1.0), line.constant(1.0, 0.4))
    if models is q:
        one, known = q.model(one=1.0), q.model(0.4, one=1.0)
    assert root(one, 1.2, 0.1, 0.2) == pytest.approx((0.2, 0.4))
    assert root(known, 1.2, 0.0, 0.0) == pytest.approx((0, 0))
    for slope, left, K in (
        (one, 0.3, 1.2),
        (known, 0.2, 1.2),
        (models.widened(known, 0.7), 0.0, 1.2),
        (models.scaled(one, -1.0), 0.0, 1.2),
    ):
        with pytest.raises(Rejected, match="the time of an event is not certain"):
            root(slope, K, 0.0, left)


def test_functions_are_known_to_vanish_only_close_by():
    """In the norm of functions, up to a distance of 1, and where slopes vary little."""
    for slope, left in ((line.constant(1.0), 0.6), (line.constant(1.0, 0.6), 0.0)):
        with pytest.raises(Rejected, match="the time of an event is not certain"):
            line.root(slope, 0.0, 0.0, left)


def test_a_path_hits_forwards(monkeypatch):
    """By the formula the mass comes back from behind the wall: that is no hit."""
    f = path(-0.1, 1, BEGUN)

    def ahead(t):
        d = t - BEGUN
        return -math.cos(t) - A * d * d / 2 + f.A[0][0] * d + f.B[0][0]

    low, high = 2.0, 4.0
    assert ahead(low) > 0 > ahead(high)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if ahead(middle) > 0 else (low, middle)
    assert low < SLOW
    monkeypatch.setattr(events, "hitting", lambda *_: (low, line.constant(0.0)))
    with pytest.raises(Rejected, match="the time of an event is not certain"):
        hit(LINES, f, low)


@pytest.mark.parametrize("border", [math.pi - THETA, math.pi + THETA])
def test_a_path_sticks_or_turns(border):
    """What stops at a border does either; so does what stops next to it, less well known."""

    def stopped(T, error=0.0):
        e = stop(LINES, path(-9, falling(T), BEGUN, (error, 0.0)), T, 1)
        return paths.stuck(LINES, e, e.p[1])

    outwards = math.copysign(0.01, border - math.pi)
    assert stopped(border - outwards) is None
    assert stopped(border + outwards) is not None
    for T, error in ((border, 0.0), (border - outwards, 0.01), (border + outwards, 0.01)):
        with pytest.raises(Rejected, match="a stick or a turn"):
            stopped(T, error)


def test_a_path_stops_in_its_arc():
    """Not in another one, nor before it begins."""
    s, T = bouncing()
    with pytest.raises(Rejected, match="a stop may be in another arc"):
        stop(LINES, path(-20, s, BEGUN), T, 1)
    with pytest.raises(Rejected, match="the mass may stop, or not"):
        stop(LINES, path(-20, s, BEGUN), T, 2)
    f = path(-20, s + 0.1, BEGUN)
    assert stop(LINES, f, T, 2).ends[0] > SLOW
    for k in (1, 3):
        with pytest.raises(Rejected, match="a stop may be in another arc"):
            stop(LINES, f, T, k)
    f = path(-5, falling(2.3), BEGUN)
    stop(LINES, f._replace(begun=(BEGUN, SLOW - 0.1)), 2.3, 1)
    with pytest.raises(Rejected, match="a flight may begin after the arc of a stop"):
        stop(LINES, f._replace(begun=(BEGUN, SLOW + 0.1)), 2.3, 1)


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
    for y, f, zero in (
        (LINES, path(-5, s, 0.1), line.constant(0.0)),
        (AHEAD, flight(-5, s, 0.1), q.model()),
    ):
        monkeypatch.setattr(events, "stopping", lambda *_, zero=zero: (T, zero))
        with pytest.raises(Rejected, match="the time of an event is not certain"):
            stop(y, f, T, 1)
