"""The hits of lifted orbits, against the flow with all events; and changes of sign."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from cap.errors import BadInput
from cap.floats.engine import flow
from cap.flow.itinerary import itinerary, oscillator, root
from cap.parameters import PAPER, Parameters
from cap.sets.matrix import determinant

OTHER = Parameters(Fraction(2), Fraction(3), Fraction(1, 2), Fraction(3), Fraction(4))
GENUINE = [  # states whose orbits never turn within a period
    (PAPER, 0.1002798898441954, 0.5419433067664584),
    (PAPER, 0.3, 0.8),
    (PAPER, -0.5, 2.5),
    (PAPER, 0.2, -3.0),
    (OTHER, 3.5, 3.0),
    (OTHER, 3.25, -4.0),
]


@pytest.mark.parametrize(("p", "x", "v"), GENUINE)
def test_an_orbit_that_never_stops_is_its_lift(p, x, v):
    """Its hits are those of the flow with all events, and so is the derivative made of them."""
    o = oscillator(p)
    path = itinerary(p, x, v, o.T)
    assert {word.split()[0] for word in path.words} == {"hit"}
    times = [event.time for event in path.events]
    assert flow.hit_times(o, x, v) == pytest.approx(times, abs=1e-12)
    monodromy = flow.monodromy(o, [(event.time, event.velocity) for event in path.events])
    for row, other in zip(monodromy, path.monodromy, strict=True):
        assert row == pytest.approx(other, rel=1e-9)
    assert determinant(monodromy) == pytest.approx(1)


def test_the_lift_goes_on_where_the_velocity_vanishes():
    """v vanishes twice before the next hit: it goes right, comes back, and hits on the left."""
    p = replace(PAPER, f=Fraction(1, 10), r=Fraction(2))
    o = oscillator(p)
    first, *_ = flow.hit_times(o, 0.0, -0.5)
    at = lambda t: 1 - math.cos(t) - 0.5 * t + t * t / 20  # noqa: E731
    assert at(first) == pytest.approx(-1, abs=1e-12)
    assert max(at(k * first / 100) for k in range(100)) > 0.1
    assert itinerary(p, 0.0, -0.5, o.T).words[0] == "turn right"


@pytest.mark.parametrize(
    ("x", "v"),
    [
        (1.0, 0.5),
        (-1.0, 0.5),
        (7.0, 1.0),
        (0.0, 0.0),
        (math.nan, 1.0),
        (0.0, math.nan),
        (0.0, math.inf),
        (0.0, 1e6),
        (0.0, -1e300),
    ],
)
def test_states_that_cannot_be_followed_are_bad_input(x, v):
    """At or beyond a wall, at rest, not finite, or too fast: refused in one line."""
    with pytest.raises(BadInput) as error:
        flow.hit_times(oscillator(PAPER), x, v)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("g", "a", "b", "zero"),
    [
        (lambda t: (t * t - 2, 2 * t), 0.0, 2.0, math.sqrt(2)),
        (lambda t: (2 - t * t, -2 * t), 0.0, 2.0, math.sqrt(2)),
        (lambda t: (t**3, 3 * t * t), -1.0, 2.0, 0.0),
        (lambda t: (math.atan(50 * t - 5), 50 / (1 + (50 * t - 5) ** 2)), -3.0, 7.0, 0.1),
        (lambda t: (t - 1, 1.0), 1.0, 3.0, 1.0),
        (lambda t: (t - 3, 1.0), 1.0, 3.0, 3.0),
        (lambda t: (t - 0.25, 0.0), 0.0, 1.0, 0.25),
    ],
)
def test_root(g, a, b, zero):
    """Zeros inside and at the ends, rising and falling, triple, steep, and with a false slope."""
    assert root(g, a, b) == pytest.approx(zero, abs=2e-15)
