"""Helpers of the tests of the complete flow: certified orbits in windows that they find."""

from dataclasses import replace
from fractions import Fraction

from attempts import box
from support import holds

from cap.flow.event import BALLS, Expected
from cap.flow.itinerary import itinerary
from cap.flow.strobe import State, follow, oscillator
from cap.flow.windows import windows_for
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 160
HEAVY = replace(PAPER, f=Fraction(9, 10))
SOFT = replace(PAPER, e=Fraction(3, 5))
OILY = replace(PAPER, mu=Fraction(1, 5), e=Fraction(9, 10))
NARROW = replace(OILY, f=Fraction(1, 5), l=Fraction(1), r=Fraction(7, 5))
BRISK = replace(SOFT, F=Fraction(2), omega=Fraction(3), f=Fraction(4, 5), r=Fraction(-1, 3))

FIRM = replace(PAPER, e=Fraction(3, 10), mu=Fraction(1, 10))

MIXED = {  # parameters, x, v, start, end: the itinerary is in `test_itinerary`
    "turns": (PAPER, "0", "1/10", 0, 7),
    "stick": (PAPER, "-1/2", "-3/10", 0, 6),
    "stick after a hit": (PAPER, "0", "7/10", 0, 9),
    "heavy": (HEAVY, "1/2", "-4/5", 0, 9),
    "soft": (SOFT, "-1/2", "2", 0, 8),
    "capture r": (SOFT, "1/5", "6/5", 4, 12),
    "capture l": (OILY, "-3/5", "-7/10", 1, 10),
    "capture after a stick": (PAPER, "9/10", "2/5", 4, 13),
    "all but hits of l": (FIRM, "3/10", "7/5", 3, 12),
    "viscous": (OILY, "1/4", "-3/2", 0, 7),
    "narrow": (NARROW, "6/5", "1/2", 0, "7/2"),
    "brisk": (BRISK, "-3/4", "-2", 0, 5),
    "long after": (OILY, "1/4", "3/2", 1000, 1006),
    "long before": (SOFT, "1/4", "-3/2", -50, -44),
}


def moment(osc, t):
    """Return the moment at an exact time or a ball."""
    return osc.moment(t if isinstance(t, Ball) else interval.ball(Fraction(t)))


def expected(path):
    """Return the events of a float path with windows that are points."""
    return tuple(Expected(e.word, interval.ball(Fraction(e.time))) for e in path.events)


def starting(osc, state, start=0, *, wall=0, radius=0, kind=BALLS):
    """Return the `State` of a box of half-width ``radius``; a zero velocity and a wall are exact.

    At a wall x is the wall, whatever was given.
    """
    x, v = box(state, kind, radius)
    return State(
        moment(osc, start),
        osc.wall(wall) if wall else x,
        v if state[1] else Ball(0),
        wall,
    )


def certified(p, state, end, *, start=0, wall=0, radius=0, kind=BALLS):  # noqa: PLR0913
    """Return (float path, itinerary with windows, certified orbit), all from one state or box."""
    state, start, end = tuple(map(Fraction, state)), Fraction(start), Fraction(end)
    path = itinerary(p, *map(float, state), float(end), start=float(start), wall=wall)
    osc = oscillator(p)
    begin = starting(osc, state, start, wall=wall, radius=radius, kind=kind)

    def attempt(events):
        return follow(osc, begin, events, moment(osc, end), kind)

    return path, *windows_for(attempt, expected(path), kind.bound)


def exactly(p, state, start, end, events, *, wall=0):
    """Return the orbit of one state, to 100 digits, with the events in these windows."""
    with interval.workprec(400):
        osc = oscillator(p)
        return follow(osc, starting(osc, state, start, wall=wall), events, moment(osc, end), BALLS)


def point_orbit(name):
    """Return (parameters, state, start, end, windows) of one of `MIXED`, over the point."""
    p, x, v, start, end = MIXED[name]
    state = Fraction(x), Fraction(v)
    with interval.workprec(BITS):
        _, events, _ = certified(p, state, end, start=start, radius=Fraction(1, 10**12))
    return p, state, Fraction(start), Fraction(end), events


def agree(orbit, path, error, kind=BALLS):
    """Check that the enclosures of an orbit contain a path in floats, up to ``error``.

    A float capture has only the end of a window, by which the hits have accumulated.
    """
    assert tuple(event.word for event in orbit.events) == path.words
    for event, happening in zip(orbit.events, path.events, strict=True):
        if event.word.startswith("capture"):
            assert float(kind.bound(event.time).lower()) < happening.time
        else:
            assert holds(kind.bound(event.time), happening.time, error)
            assert holds(kind.bound(event.velocity), happening.velocity, error)
    for ball, value in zip(orbit.end, path.end, strict=True):
        assert holds(kind.bound(ball), value, error)
    for row, values in zip(orbit.monodromy, path.monodromy, strict=True):
        for entry, value in zip(row, values, strict=True):
            assert holds(kind.bound(entry + Ball(0)), value, error * 1000 * (1 + int(abs(value))))
