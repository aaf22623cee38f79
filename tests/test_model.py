"""The mechanics: flights solve the equation, hits reflect, saltations are derivatives."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from support import rounds, seeded, width

from cap import interval
from cap.flow import oscillator, over
from cap.jet import Jet
from cap.model import Flight, Functions, Oscillator
from cap.parameters import PAPER, Parameters

SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7, 3), Fraction(-1))
SLOW = Parameters(Fraction(1, 2), Fraction(2, 7), Fraction(1, 3), Fraction(3), Fraction(5))
FREE = replace(PAPER, f=Fraction(0))
NEARLY_STUCK = replace(PAPER, f=Fraction(999, 1000))
CASES = [PAPER, SHIFTED, SLOW, FREE, NEARLY_STUCK]


def floats(p):
    """Return the oscillator over plain floats."""

    def sin_cos(angle):
        return math.sin(angle), math.cos(angle)

    return Oscillator.build(p, Functions(float, math.pi, sin_cos, math.acos, math.sqrt))


def random_flight(random, osc):
    """Return a random flight, to either side."""
    s = random.choice([-1, 1])
    return Flight(s, osc.drag(s), random.uniform(-3, 3), random.uniform(-3, 3))


def state(osc, flight, t):
    """Return position and velocity of a flight."""
    sin, cos = osc.phase(t)
    return osc.position(flight, t, cos), osc.velocity(flight, t, sin)


@pytest.mark.parametrize("p", CASES)
def test_constants(p):
    """Each is what its name says."""
    osc = floats(p)
    F, w, f = float(p.F), float(p.omega), float(p.f)
    assert (osc.F, osc.omega, osc.f, osc.l, osc.r) == (F, w, f, float(p.l), float(p.r))
    assert pytest.approx(2 * math.pi / w) == osc.T
    assert (osc.F_v, osc.F_x) == pytest.approx((F / w, F / w**2))
    assert (osc.wall(1), osc.wall(-1)) == (osc.r, osc.l)
    assert (osc.drag(1), osc.drag(-1)) == (f, -f)


@pytest.mark.parametrize("p", CASES)
def test_flights_solve_the_equation(p):
    """x' = v and v' = F cos ωt - s f, by divided differences."""
    random, osc = seeded(1), floats(p)
    for _ in range(rounds(50)):
        flight, t, h = random_flight(random, osc), random.uniform(-1, 1.5) * osc.T, 1e-4
        (x0, v0), (_, v), (x1, v1) = (state(osc, flight, t + k * h) for k in (-1, 0, 1))
        acceleration = osc.F * math.cos(osc.omega * t) - flight.s * osc.f
        assert (x1 - x0) / (2 * h) == pytest.approx(v, abs=1e-6)
        assert (v1 - v0) / (2 * h) == pytest.approx(acceleration, abs=1e-6)


@pytest.mark.parametrize("p", CASES)
def test_start_and_end(p):
    """A flight starts in its state at t = 0 and its end is its state at t = T."""
    random, osc = seeded(2), floats(p)
    for _ in range(rounds(20)):
        x, v, s = random.uniform(-3, 3), random.uniform(-3, 3), random.choice([-1, 1])
        flight = osc.start(s, x, v)
        assert (flight.s, flight.drag) == (s, osc.drag(s))
        assert state(osc, flight, 0.0) == pytest.approx((x, v), abs=1e-12)
        assert osc.end(flight) == pytest.approx(state(osc, flight, osc.T), abs=1e-9)


@pytest.mark.parametrize("p", CASES)
def test_reflection(p):
    """The new flight is at the wall ahead with the velocity reversed, and friction turned."""
    random, osc = seeded(3), floats(p)
    for _ in range(rounds(50)):
        old, t = random_flight(random, osc), random.uniform(0, 1) * osc.T
        new = osc.reflect(old, t, *osc.phase(t))
        (_, before), (x, after) = state(osc, old, t), state(osc, new, t)
        assert (new.s, new.drag) == (-old.s, osc.drag(-old.s))
        assert x == pytest.approx(osc.wall(old.s), abs=1e-9)
        assert after == pytest.approx(-before, abs=1e-9)


@pytest.mark.parametrize("p", CASES)
@pytest.mark.parametrize("s", [1, -1])
def test_slowest(p, s):
    """On any part of [0, T] the least s v is at an end or at ``slowest``: against a fine grid."""
    random, osc = seeded(4), floats(p)
    for _ in range(rounds(8)):
        flight = replace(random_flight(random, osc), s=s, drag=osc.drag(s))
        when, least = osc.slowest(flight)
        assert 0 < when < osc.T
        assert s * state(osc, flight, when)[1] == pytest.approx(least, abs=1e-9)
        a, b = sorted(random.uniform(0, 1) * osc.T for _ in range(2))
        for start, end in ((0.0, osc.T), (a, b), (a, osc.T), (0.0, b), (when, b), (a, when)):
            times = [start + (end - start) * k / 1000 for k in range(1001)]
            speeds = [s * state(osc, flight, t)[1] for t in times]
            inside = min(start, end) < when < max(start, end)
            claimed = min(speeds[0], speeds[-1], least if inside else math.inf)
            assert min(speeds) >= claimed - 1e-12
            assert min(speeds) == pytest.approx(claimed, abs=osc.F * osc.T * 1e-5)


def flown(osc, s, z, start, end):
    """Return the state at ``end`` of a flight from state z at ``start``."""
    x, v = z
    sin, cos = osc.phase(start)
    a = v - osc.F_v * sin + osc.drag(s) * start
    b = x - a * start + osc.F_x * cos + osc.drag(s) * start**2 / 2
    return state(osc, Flight(s, osc.drag(s), a, b), end)


def through_a_hit(osc, s, z, start, end):
    """Fly from ``start`` past one hit of the wall ahead to ``end``; hand-made, by bisection."""
    a, b = start, end
    for _ in range(200):
        t = (a + b) / 2
        if s * (flown(osc, s, z, start, t)[0] - osc.wall(s)) > 0:
            b = t
        else:
            a = t
    _, v = flown(osc, s, z, start, b)
    return flown(osc, -s, (osc.wall(s), -v), b, end), b, v


@pytest.mark.parametrize("p", CASES)
@pytest.mark.parametrize("s", [1, -1])
def test_saltation_against_divided_differences(p, s):
    """Flight, hit, flight: kick and drift give the derivative of the hand-made flow."""
    random, osc = seeded(5), floats(p)
    for _ in range(rounds(10)):
        start = random.uniform(0, 0.8) * osc.T
        fast = 3 * osc.F_v + (2 + osc.f * osc.T)
        d = random.uniform(0.05, 0.1) * osc.T
        z = osc.wall(s) - s * fast * d / 3, s * fast
        end = start + d
        (_, _), hit, v = through_a_hit(osc, s, z, start, end)
        assert start < hit < end
        salt = osc.saltation(v, osc.phase(hit)[1])
        identity = (1.0, 0.0), (0.0, 1.0)
        m = osc.drift(osc.kick(identity, hit - start, salt), end - hit)
        h = 1e-5
        for j in (0, 1):
            ahead, behind = list(z), list(z)
            ahead[j] += h
            behind[j] -= h
            plus, _, _ = through_a_hit(osc, s, ahead, start, end)
            minus, _, _ = through_a_hit(osc, s, behind, start, end)
            for i in (0, 1):
                difference = (plus[i] - minus[i]) / (2 * h)
                assert m[i][j] == pytest.approx(difference, rel=1e-5, abs=1e-5)


def test_kick_and_drift_are_matrix_products():
    """Over fractions, exactly."""
    random, osc = seeded(6), floats(PAPER)
    for _ in range(rounds(20)):
        a, b, c, d, duration, salt = (Fraction(random.randint(-9, 9), 7) for _ in range(6))
        m = (a, b), (c, d)
        drifted = (a + duration * c, b + duration * d), (c, d)
        (p, q), (r, t) = drifted
        assert osc.drift(m, duration) == drifted
        assert osc.kick(m, duration, salt) == ((-p, -q), (salt * p - r, salt * q - t))


def test_the_same_code_runs_on_jets():
    """Jets of a flight and of a reflection have the derivatives of nested differences."""
    with interval.workprec(100):
        balls = oscillator(SHIFTED)
        jets = over(balls, Jet)
        point = tuple(interval.ball(Fraction(n, 7)) for n in (-12, 9, 2))
        x, v, t = Jet.variables(point, 2)
        flight = jets.start(1, x, v)
        sin, cos = jets.phase(t)
        after = jets.reflect(flight, t, sin, cos)
        outcome = [jets.position(flight, t, cos), jets.velocity(flight, t, sin), after.A, after.B]
    osc = floats(SHIFTED)

    def direct(values):
        x, v, t = values
        flight = osc.start(1, x, v)
        sin, cos = osc.phase(t)
        after = osc.reflect(flight, t, sin, cos)
        return [*state(osc, flight, t), after.A, after.B]

    middle, h = [-12 / 7, 9 / 7, 2 / 7], 1e-4

    def shifted(*steps):
        return direct([m + h * s for m, s in zip(middle, steps, strict=True)])

    unit = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    for n, jet in enumerate(outcome):
        assert float(jet[0, 0, 0]) == pytest.approx(shifted(0, 0, 0)[n])
        for i, e in enumerate(unit):
            down = tuple(-k for k in e)
            slope = (shifted(*e)[n] - shifted(*down)[n]) / (2 * h)
            assert float(jet[e]) == pytest.approx(slope, abs=1e-6)
            bend = shifted(*e)[n] + shifted(*down)[n] - 2 * shifted(0, 0, 0)[n]
            assert float(jet[tuple(2 * k for k in e)]) == pytest.approx(bend / 2 / h**2, abs=1e-5)
            for g in unit[i + 1 :]:
                both = tuple(a + b for a, b in zip(e, g, strict=True))
                apart = tuple(a - b for a, b in zip(e, g, strict=True))
                mixed = (
                    shifted(*both)[n]
                    + shifted(*(-k for k in both))[n]
                    - shifted(*apart)[n]
                    - shifted(*(-k for k in apart))[n]
                )
                assert float(jet[both]) == pytest.approx(mixed / 4 / h**2, abs=1e-5)


@pytest.mark.parametrize("p", CASES)
def test_ball_constants_contain_the_exact_ones(p):
    """And the ball flight contains the float flight, within rounding."""
    random, osc = seeded(7), floats(p)
    with interval.workprec(100):
        balls = oscillator(p)
        for name in ("F", "omega", "f", "l", "r"):
            lower, upper = interval.ends(getattr(balls, name))
            assert lower <= getattr(p, name) <= upper
        for name in ("T", "F_v", "F_x", "slow_right", "slow_left", "dip"):
            assert float(getattr(balls, name)) == pytest.approx(getattr(osc, name), rel=1e-14)
            assert width(getattr(balls, name)) < 1e-25
        for _ in range(rounds(10)):
            flight, t = random_flight(random, osc), random.uniform(0, 1) * osc.T
            exact = replace(
                flight,
                drag=balls.drag(flight.s),
                A=interval.ball(Fraction(flight.A)),
                B=interval.ball(Fraction(flight.B)),
            )
            results = state(balls, exact, interval.ball(Fraction(t)))
            for ball, number in zip(results, state(osc, flight, t), strict=True):
                assert float(ball) == pytest.approx(number, abs=1e-11)
                assert width(ball) < 1e-22
