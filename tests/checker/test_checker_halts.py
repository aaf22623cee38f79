"""``halts``: which stops are halts, and where the mass rests after them."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from cap.checker.flow.mechanics import Ends
from cap.checker.flow.stops import Event
from cap.checker.kernel.rejection import Rejected
from cap.checker.release import halts
from cap.checker.release.driven import DrivenMap, phases
from cap.checker.system.walls import Parameters

BITS = 96


def driven(f):
    """Return the mechanics at one f, near x = 0, F = w = 1, with walls at -1 and 1."""
    p = Parameters(*map(Fraction, (1, 1, 0, -1, 1)))
    theta = phases(p, (f, f), BITS)
    x = theta.integer(0)
    return DrivenMap(p, (), (), 3).mechanics([x, theta], [x, theta.midpoint()], 4)


def towards_a_stop(f, before, x=Fraction(0), s=-1):
    """Return a flight of direction s that stops this long before its force becomes too weak.

    In doubles; and a window for the stop.
    """
    M = driven(f)
    stop = 2 * math.pi + math.acos(f) - before + (0 if s < 0 else math.pi)
    start = stop - 0.4
    v = s * 0.4 * float(f) - (math.sin(stop) - math.sin(start))
    moment = M.moment(M.constant(M.number(Fraction(start))))
    flight = M.flight(s, moment, M.constant(M.number(x)), M.constant(M.number(Fraction(v))))
    return M, flight, (Fraction(stop) - Fraction(1, 100), Fraction(stop) + Fraction(1, 100))


def test_a_halt():
    """Shortly before, after a turn of a short time; or after that time, at once."""
    f = Fraction(9, 10)
    for before in (0.1, 0.3, -0.1, -0.3):
        for s, word in ((-1, "halt right"), (1, "halt left")):
            event, rest = halts.halt(*_called(f, before, s, word))
            assert event.word == word
            assert rest.sides == (s,)
            width = rest.x.value.upper - rest.x.value.lower
            assert width <= max(before, 0) ** 3 + 1e-6
            weak = 2 * math.pi + math.acos(f) + (0 if s < 0 else math.pi)
            assert rest.since.lower <= weak + max(0, -before) + 1e-6
            assert weak + abs(before) - 1e-6 <= rest.since.upper


def _called(f, before, s, word) -> tuple[object, object, str, Ends]:
    M, flight, window = towards_a_stop(f, before, s=s)
    return M, flight, word, window


def test_a_stop_before_the_force_is_strong_enough():
    """At f/F = 0.9 it exceeds f for less than pi/2 - theta: a mass that stops before it does may
    stick, and be released to the other side.
    """
    f = Fraction(9, 10)
    theta = math.acos(0.9)
    assert 2 * theta < 1 < math.pi / 2 - theta
    with pytest.raises(Rejected, match="may turn too long before"):
        halts.halt(*_called(f, 1.0, -1, "halt right"))
    halts.halt(*_called(f, 2 * theta - 0.05, -1, "halt right"))


def test_a_turn_that_may_last():
    """At f/F = 0.4 the force is not concave for so long."""
    with pytest.raises(Rejected, match="may turn too long before"):
        halts.halt(*_called(Fraction(2, 5), 0.5, -1, "halt right"))


def test_the_side():
    """A halt is to the side from which the mass comes; a mass at rest does not halt."""
    M, flight, window = towards_a_stop(Fraction(9, 10), 0.1)
    with pytest.raises(Rejected, match="to the side to which the mass moves"):
        halts.halt(M, flight, "halt left", window)
    rest = halts.halt(M, flight, "halt right", window)[1]
    with pytest.raises(Rejected, match="the mass rests"):
        halts.halt(M, rest, "halt right", window)


@pytest.mark.parametrize(
    ("after", "x", "why"),
    [
        (1.7, 0, "no halt is near"),
        (-1.7, 0, "no halt is near"),
        (1.2, 0, "after the end of an arc"),
        (-0.3, Fraction(999, 1000), "may reach the wall"),
    ],
)
def test_other_stops(monkeypatch, after, x, why):
    """A stop at another time, or next to the wall towards which a mass turns."""
    M, flight, window = towards_a_stop(Fraction(1, 2), 0.1)

    def stop(M, _flight, word, _window):
        t = M.constant(M.number(Fraction(2 * math.pi + math.acos(0.5) + after)))
        moment = M.moment(t)
        return Event(word, moment, moment.cos.value), M.constant(M.number(Fraction(x)))

    monkeypatch.setattr(halts, "stop", stop)
    with pytest.raises(Rejected, match=why):
        halts.halt(M, flight, "halt right", window)
