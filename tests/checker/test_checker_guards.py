"""Guards of flights: what has no sense before the launch, spreads of times, underflow."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

from cap.areas.folded import mirrored
from cap.areas.folded import paths as compiled_paths
from cap.checker.folded import numbers
from cap.checker.kernel import line
from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.strips.arc import Arc, Launches, _hit
from cap.checker.strips.stopping import stops_by

FRICTION = enclosing(Fraction(2, 5))


def launched(E, R, near=None):
    """Return a launch at t = 0, as an arc of no length."""
    none = Double(0.0)
    return Launches(Arc(none, none, Double(E), none, none), FRICTION, Double(R), near=near)


def test_a_hit_before_the_launch():
    """The formula of the flight comes to R at T = -2.83, where v > 0: that is no hit."""
    slow, R = 0.05**2 / 2, 0.2
    assert 0 < _hit(launched(0.7, R)).mid < 1
    for near in (-2.9, -2.83, -2.8):
        with pytest.raises(Rejected, match="a hit may be before its launch"):
            _hit(launched(slow, R, near))


def test_a_stop_before_the_launch():
    """At the minimum before the launch v < 0; but this launch hits."""
    launch = launched(0.3**2 / 2, 1.0)
    before, after = Double(-math.acos(0.4)), Double(math.pi)
    assert launch.velocity(before)[0].upper < 0
    assert _hit(launch).mid < 2
    assert not stops_by(launch, launch.all.t, before)
    far = launched(0.3**2 / 2, 8.0)
    assert stops_by(far, far.all.t, after)


def test_an_arccosine_that_is_wrong_hides_no_minimum(monkeypatch):
    """Which minima are looked at does not hang on the library, either."""
    exact = math.acos
    low = 2 * math.pi - exact(0.4)
    assert len(launched(0.7, 2.0).minima(low - 1e-4, low + 1e-4)) == 1
    monkeypatch.setattr("math.acos", lambda y: exact(y) + 1e-3)
    launch = Launches(
        Arc(*map(Double, (0.0, 0.0, 0.7, 0.0, 0.0))), enclosing(Fraction(2, 5)), Double(2.0)
    )
    with pytest.raises(Rejected):
        launch.minima(low - 1e-4, low + 1e-4)


@pytest.mark.parametrize(("half", "certain"), [(1.4, True), (1.6, False)])
def test_the_spread_of_the_times_of_an_event(half, certain):
    """Flights begin within 1.5 of [-pi, pi], as slow times before are not looked at."""
    T = (0.0, half, *[0.0] * (line.DEGREE - 1))
    given = 1.0, 0.0, (0.0, 0.0), 1.0
    h = compiled_paths.Happening(
        (*T, 0.0), *[(*[0.0] * (line.DEGREE + 2),)] * 3, 0.0, True, 0.0, 0.0, (0.0, 0.0)
    )
    assert compiled_paths.certain(h, *given).certain is certain


TINY = 2.0**-1074
SMALL = [
    ("times", (2.0**-600, 0.0), (2.0**-480, 0.0)),
    ("times", (2.0**-600, 2.0**-601), (-(2.0**-480), 2.0**-500)),
    ("times", (TINY, 0.0), (0.3, 0.0)),
    ("quotient", (2.0**-600, 0.0), (2.0**480, 0.0)),
    ("quotient", (TINY, 0.0), (2.0**-60, 2.0**-62)),
    ("quotient", (-TINY, TINY), (3.0, 1.0)),
]


@pytest.mark.parametrize("room", [numbers, mirrored], ids=["checker", "compiled"])
@pytest.mark.parametrize(("name", "x", "y"), SMALL)
def test_what_underflows_is_in_the_bound(room, name, x, y):
    """Products and quotients of the ends lie within the error, exactly."""
    m, e = map(Fraction, getattr(room, name)(x, y))
    for a in ends(x):
        for b in ends(y):
            exact = a * b if name == "times" else a / b
            assert abs(exact - m) <= e


def ends(x):
    """Return the ends of an interval, exactly."""
    return Fraction(x[0]) - Fraction(x[1]), Fraction(x[0]) + Fraction(x[1])
