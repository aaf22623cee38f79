"""Flights and events of the checker, one function at a time."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf
from support import number, rational

from cap.checker.flow.hits import slope
from cap.checker.flow.mechanics import Mechanics, least
from checker.hybrid import Flow
from checker.parts import (
    Interval,
    Parameters,
    Rejected,
    Zero,
    rest_of,
    stick,
)
from checker.test_checker_events import BITS, STICKY, UNIT, mechanics, passage, point

F = Fraction
FREE = {"F": "1", "omega": "1", "f": "0", "l": "-30", "r": "30", "e": "1", "mu": "0"}


def over(low, high):
    """Return the enclosure of an interval."""
    return Interval.enclosing(F(low), F(high), BITS)


def test_the_least_of_some_numbers():
    """Of numbers in intervals, the least lies between the least lower and the least upper end."""
    for pieces in ([(1, 10), (2, 3)], [(2, 3), (1, 10)], [(2, 3), (4, 5)]):
        values = [Interval(*piece, 7) for piece in pieces]
        found = least(values)
        assert (found.lo, found.hi) == (min(a for a, _ in pieces), 3)
        assert found.bits == 7


@pytest.mark.parametrize(("t", "after"), [("4.6", False), ("4.8", True)])
def test_a_minimum_that_may_come_after_the_end(t, after):
    """v = 3/2 + sin t is least at 3 pi/2, if the end, of which little is known, comes later."""
    M = mechanics(FREE, "0", "1.5")
    flight, exact = M.launch(), M.moment(M.constant(point(t)))
    end = exact._replace(t=M.constant(over("4.5", "4.9")))
    found = M.least_speed(flight, end)
    with mp.workdps(40):
        last = rational(mpf("1.5") + mp.sin(mpf(t)))
    truth = F(1, 2) if after else last
    assert found.lower <= truth <= found.upper
    assert abs(found.lower - F(1, 2)) < F(1, 10**20)
    assert abs(found.upper - last) < F(1, 10**20)
    apart = M.least_speed(flight, exact)
    assert abs(apart.lower - truth) + abs(apart.upper - truth) < F(1, 10**20)
    sets = [point(0), over("1.4", "1.6")]
    free = Parameters(**{k: F(q) for k, q in FREE.items()})
    M = Mechanics(free, sets, [q.midpoint() for q in sets], 2)
    wide, tenth = (
        M.least_speed(M.launch(), end._replace(t=M.constant(over("4.5", "4.9")))),
        F(1, 10),
    )
    assert wide.lower <= truth - tenth < truth + tenth <= wide.upper
    assert abs(wide.lower - F(2, 5)) + abs(wide.upper - last - tenth) < F(1, 10**20)


@pytest.mark.parametrize("mu", ["0", "1/5", "7"])
@pytest.mark.parametrize("s", [1, -1])
def test_the_slope_at_an_event(mu, s):
    """Over an interval of times, v and v' contain their values, and are not far off."""
    parameters = UNIT | {"mu": mu, "omega": "3/2", "F": "2"}
    M = mechanics(parameters, "1/3", F(s, 2))
    arc = [q.centre for q in M.launch().arc]
    low, high = F(1, 4), F(1, 2)
    with mp.workdps(40):
        flow, start = Flow(parameters), (mpf(0), mpf(1) / 3, mpf(s) / 2)
        for a, b in ((low, high), (low, low)):
            zeros = (rest_of(M, s), Zero(*M.course(s), point(9)))
            values = [slope(M, arc, over(a, b), zero) for zero in zeros]
            for n in range(5):
                t = number(a + (b - a) * n / 4)
                v = flow.state(start, s, t)[1]
                exact = flow.force(t) - s * flow.f - flow.mu * v, v
                for value, truth in zip(values, exact, strict=True):
                    assert value.lower <= rational(truth) <= value.upper
            widths = [float(v.upper - v.lower) for v in values]
            assert max(widths) < (30 if a < b else 1e-30)


def test_a_release_before_the_stick():
    """cos t = -9/10 also at 2.69, but the mass sticks at 4.5, where |cos t| < 9/10 from 3.59 on."""
    far = STICKY | {"l": "-90", "r": "90"}
    late, early = [("4.4", "4.6")], ("2.6", "2.8")
    with pytest.raises(Rejected, match="no release to this side certainly follows"):
        passage(far, "0", "5.028", ["stick", "release left"], [*late, early])
    passage(far, "0", "5.028", ["stick", "release right"], [*late, ("5.8", "5.9")])


@pytest.mark.parametrize(("f", "omega"), [("9/10", "1"), ("9/10", "2"), ("9/10", "1/3")])
def test_how_long_a_stick_lasts_at_most(f, omega):
    """|F cos wt| < f for (pi - 2 arccos(f/F))/w: the rest after a stick is shorter."""
    parameters = STICKY | {"f": f, "omega": omega, "l": "-900", "r": "900"}
    with mp.workdps(40):
        w, k = number(F(omega)), number(F(f))
        v = k * mpf("1.66") / w - mp.sin(mpf("1.66")) / w  # it vanishes at w t = 1.66
        window = [(rational(mpf(t) / w)) for t in ("1.6", "1.7")]
        M = mechanics(parameters, "0", rational(v))
        event, rest = stick(M, M.launch(), "stick", window)
        assert abs(rational((mp.pi - 2 * mp.acos(k)) / w) - rest.longest.upper) < F(1, 10**30)
        assert abs(rational(mpf("1.66") / w) - event.moment.t.value.upper) < F(1, 10**30)
    assert rest.longest.width < 100
    assert rest.sides == (1, -1)
    assert rest.since is event.moment.t.value
