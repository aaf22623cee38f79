"""The float flow over one period, against small steps, differences and closed forms."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from cap.errors import BadInput
from cap.floats.engine import flow
from cap.flow.itinerary import oscillator, root
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


def small_steps(p, x, v, steps=20_000):
    """Return (x, v) at t = T by small steps in which the acceleration is taken at the middle."""
    F, omega, f, l, r = (float(q) for q in (p.F, p.omega, p.f, p.l, p.r))
    h = 2 * math.pi / omega / steps
    for k in range(steps):
        a = F * math.cos(omega * (k + 0.5) * h) - math.copysign(f, v)
        x, v = x + h * v + h * h * a / 2, v + h * a
        if not l < x < r:
            x = 2 * (l if x < l else r) - x
            rest = abs(x - (l if v < 0 else r)) / abs(v)  # since the hit, in which friction flips
            v = -v + 2 * rest * F * math.cos(omega * (k + 0.5) * h)
    return x, v


@pytest.mark.parametrize(("p", "x", "v"), GENUINE)
def test_end_agrees_with_small_steps(p, x, v):
    """(x, v) at T is that of 20 000 small steps, to 1e-5."""
    end = flow.one_period(oscillator(p), x, v).end
    assert end == pytest.approx(small_steps(p, x, v), abs=1e-5)


@pytest.mark.parametrize(("p", "x", "v"), GENUINE)
def test_hits_lie_on_alternating_walls(p, x, v):
    """Velocities at the hits alternate in sign, times increase, the least speed is the least."""
    orbit = flow.one_period(oscillator(p), x, v)
    signs = [math.copysign(1, u) for u in orbit.hit_velocities]
    assert signs == [math.copysign(1, v) * (-1) ** k for k in range(len(signs))]
    times = (0.0, *orbit.hit_times, 2 * math.pi / p.omega)
    assert list(times) == sorted(times)
    assert 0 < orbit.least_speed <= min(abs(u) for u in (v, *orbit.hit_velocities))


@pytest.mark.parametrize(("p", "x", "v"), GENUINE)
def test_monodromy_is_the_derivative(p, x, v):
    """Each entry is the central difference quotient of the end state, to six digits."""
    o, h = oscillator(p), 1e-6
    columns = [
        (flow.one_period(o, x + dx, v + dv).end, flow.one_period(o, x - dx, v - dv).end)
        for dx, dv in ((h, 0.0), (0.0, h))
    ]
    m = flow.one_period(o, x, v).monodromy
    for i in range(2):
        for j, (plus, minus) in enumerate(columns):
            assert m[i][j] == pytest.approx((plus[i] - minus[i]) / (2 * h), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(("p", "x", "v"), GENUINE)
def test_area_is_preserved(p, x, v):
    """The determinant of the monodromy is 1, whatever the friction and the hits."""
    assert determinant(flow.one_period(oscillator(p), x, v).monodromy) == pytest.approx(1)


def test_least_speed_is_reached_inside_a_flight():
    """Without a hit, end and least speed are those of the formula, the latter at cos t = f/F."""
    p = replace(PAPER, r=Fraction(100))  # one flight, no hit: v = 10 + sin t - 0.4 t
    slow = 2 * math.pi - math.acos(0.4)
    orbit = flow.one_period(oscillator(p), 0.0, 10.0)
    assert orbit.hit_times == ()
    assert orbit.least_speed == pytest.approx(10 + math.sin(slow) - 0.4 * slow, abs=1e-14)
    assert orbit.end == pytest.approx((20 * math.pi - 0.8 * math.pi**2, 10 - 0.8 * math.pi))


def test_turning_is_reported_at_its_time():
    """A turn on the first flight is reported at the zero of v, to 1e-15."""
    with pytest.raises(flow.Turns) as turns:
        flow.one_period(oscillator(PAPER), 0.0, -0.1)
    t = turns.value.time  # on this flight v = -0.1 + sin t + 0.4 t
    assert math.sin(t) + 0.4 * t == pytest.approx(0.1, abs=1e-15)


def test_turning_after_a_hit_is_reported():
    """A turn on a later flight is reported too, at a time after the hit."""
    with pytest.raises(flow.Turns) as turns:
        flow.one_period(oscillator(PAPER), 0.9, 0.3)
    assert 0.2 < turns.value.time < 2 * math.pi


def test_the_first_of_two_turnings_is_reported_although_a_hit_follows():
    """v vanishes twice before the next hit: the first zero counts; the formal flow goes on."""
    p = replace(PAPER, f=Fraction(1, 10), r=Fraction(2))
    o = oscillator(p)
    with pytest.raises(flow.Turns) as turns:
        flow.one_period(o, 0.0, -0.5)
    t = turns.value.time  # on this flight v = -0.5 + sin t + 0.1 t, up to its first zero
    assert math.sin(t) + 0.1 * t == pytest.approx(0.5, abs=1e-15)
    assert t < 1
    formal = flow.one_period(o, 0.0, -0.5, formal=True)
    assert formal.least_speed < 0
    assert formal.hit_velocities[0] < 0  # it went right, came back, and hit the left wall


def test_formal_flow_of_a_genuine_orbit_is_the_flow():
    """Where nothing turns, ``formal`` changes no bit of the result."""
    for p, x, v in GENUINE:
        o = oscillator(p)
        assert flow.one_period(o, x, v, formal=True) == flow.one_period(o, x, v)


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
        flow.one_period(oscillator(PAPER), x, v)
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
