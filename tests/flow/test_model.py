"""The mechanics: flights solve the equation, hits reflect, saltations are derivatives."""

import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest
from support import rounds, seeded, width

from cap.flow import itinerary as floats
from cap.flow.strobe import oscillator
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.sets.jet import Jet

SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7, 3), Fraction(-1))
SLOW = Parameters(Fraction(1, 2), Fraction(2, 7), Fraction(1, 3), Fraction(3), Fraction(5))
FREE = replace(PAPER, f=Fraction(0))
NEARLY_STUCK = replace(PAPER, f=Fraction(999, 1000))
SOFT = replace(SHIFTED, e=Fraction(3, 4))
OILY = replace(PAPER, mu=Fraction(1, 3), e=Fraction(9, 10))
HONEY = replace(SHIFTED, mu=Fraction(5), e=Fraction(1, 7))
HARDLY = replace(SLOW, mu=Fraction(1, 10**9))
CASES = [PAPER, SHIFTED, SLOW, FREE, NEARLY_STUCK, SOFT, OILY, HONEY, HARDLY]


def random_flight(random, osc):
    """Return a random flight, to either side."""
    x, v, t = (random.uniform(-3, 3) for _ in range(3))
    return osc.launch(random.choice([-1, 1]), osc.moment(t), x, v)


def state(osc, flight, t):
    """Return position and velocity of a flight."""
    moment = osc.moment(t)
    return osc.position(flight, moment), osc.velocity(flight, moment)


@pytest.mark.parametrize("p", CASES)
def test_constants(p):
    """Each is what its name says."""
    osc = floats.oscillator(p)
    F, w, f, mu = float(p.F), float(p.omega), float(p.f), float(p.mu)
    assert (osc.F, osc.omega, osc.f, osc.l, osc.r) == (F, w, f, float(p.l), float(p.r))
    assert (osc.e, osc.mu, osc.viscous) == (float(p.e), mu, mu > 0)
    assert pytest.approx(2 * math.pi / w) == osc.T
    assert (osc.F_v, osc.F_x) == pytest.approx((F * w / (w**2 + mu**2), F / (w**2 + mu**2)))
    assert (osc.wall(1), osc.wall(-1)) == (osc.r, osc.l)
    assert (osc.drag(1), osc.drag(-1)) == (f, -f)


@pytest.mark.parametrize("p", CASES)
def test_flights_solve_the_equation(p):
    """x' = v and v' = F cos ωt - s f - μv, by divided differences, before the start and after."""
    random, osc = seeded(1), floats.oscillator(p)
    for _ in range(rounds(50)):
        flight, h = random_flight(random, osc), 1e-4
        t = flight.t + random.uniform(-1, 1.5) * min(osc.T, 2 / (osc.mu + 1e-9))
        (x0, v0), (_, v), (x1, v1) = (state(osc, flight, t + k * h) for k in (-1, 0, 1))
        acceleration = osc.F * math.cos(osc.omega * t) - flight.s * osc.f - osc.mu * v
        size = 1e-6 * max(1, osc.mu**2 * abs(v))
        assert osc.acceleration(flight, osc.moment(t)) == pytest.approx(acceleration)
        assert (x1 - x0) / (2 * h) == pytest.approx(v, abs=size)
        assert (v1 - v0) / (2 * h) == pytest.approx(acceleration, abs=size * max(1, osc.mu))


@pytest.mark.parametrize("p", CASES)
def test_launch(p):
    """A flight has the state that it was launched in; from any of its states it is the same."""
    random, osc = seeded(2), floats.oscillator(p)
    for _ in range(rounds(20)):
        x, v, t, d = (random.uniform(-3, 3) for _ in range(4))
        flight = osc.launch(random.choice([-1, 1]), osc.moment(t), x, v)
        assert state(osc, flight, t) == pytest.approx((x, v), abs=1e-12)
        again = osc.launch(flight.s, osc.moment(t + abs(d)), *state(osc, flight, t + abs(d)))
        for later in (t + 2, t + 3):
            expected = state(osc, flight, later)
            assert state(osc, again, later) == pytest.approx(expected, rel=1e-6, abs=1e-7)


@pytest.mark.parametrize("p", CASES)
def test_reflection(p):
    """The new flight is at the wall ahead with -e times the velocity, and friction turned."""
    random, osc = seeded(3), floats.oscillator(p)
    for _ in range(rounds(50)):
        old = random_flight(random, osc)
        t = old.t + random.uniform(0, 1)
        before = osc.velocity(old, osc.moment(t))
        new = osc.reflect(old, osc.moment(t), before)
        assert new.s == -old.s
        x, after = state(osc, new, t)
        assert x == pytest.approx(osc.wall(old.s), abs=1e-9)
        assert after == pytest.approx(-float(p.e) * before, abs=1e-9)


@pytest.mark.parametrize("p", CASES)
@pytest.mark.parametrize("s", [1, -1])
def test_slow_moments(p, s):
    """Where exp(μt) s v has its minima, with the sine and cosine there: against a fine grid."""
    random, osc = seeded(4), floats.oscillator(p)
    for _ in range(rounds(8)):
        flight = random_flight(random, osc)._replace(s=s)

        def grown(t, flight=flight):
            return math.exp(osc.mu * (t - flight.t)) * s * osc.velocity(flight, osc.moment(t))

        slow = [osc.slow(s, k) for k in range(-3, 5)]
        assert 0 < slow[3].t < osc.T
        for moment in slow:
            angle = osc.omega * moment.t
            assert moment[1:] == pytest.approx((math.sin(angle), math.cos(angle)), abs=1e-12)
            assert s * osc.forcing(moment) == pytest.approx(osc.f)
            assert s * moment.sin < 0
        a = flight.t + random.uniform(0, 1) * osc.T
        for start, end in ((a, a + 1.7 * osc.T), (a, slow[4].t), (slow[3].t, slow[4].t)):
            low, high = sorted((start, end))
            values = [grown(low + (high - low) * k / 2000) for k in range(2001)]
            inside = [grown(m.t) for m in slow if low < m.t < high]
            claimed = min(values[0], values[-1], *inside)
            steep = max(abs(a - b) for a, b in pairwise(values))
            assert claimed - 1e-12 <= min(values) + 1e-12 * max(map(abs, values))
            assert min(values) <= claimed + steep


def through_a_hit(osc, s, z, start, end):
    """Fly from ``start`` past one hit of the wall ahead to ``end``; hand-made, by bisection."""
    flight, a, b = osc.launch(s, osc.moment(start), *z), start, end
    for _ in range(200):
        t = (a + b) / 2
        if s * (state(osc, flight, t)[0] - osc.wall(s)) > 0:
            b = t
        else:
            a = t
    _, v = state(osc, flight, b)
    after = osc.launch(-s, osc.moment(b), osc.wall(s), -osc.e * v)
    return state(osc, after, end), b, v


@pytest.mark.parametrize("p", CASES)
@pytest.mark.parametrize("s", [1, -1])
def test_saltation_against_divided_differences(p, s):
    """Flight, hit, flight: hit and drift give the derivative of the hand-made flow."""
    random, osc = seeded(5), floats.oscillator(p)
    speed = osc.F / osc.omega
    for _ in range(rounds(10)):
        start = random.uniform(0, 0.8) * osc.T
        fast = 3 * speed + (2 + osc.f * osc.T)
        d = random.uniform(0.05, 0.1) * min(osc.T, 1 / (osc.mu + 1e-9))
        z = osc.wall(s) - s * fast * d / 3, s * fast
        end = start + d
        (_, _), hit, v = through_a_hit(osc, s, z, start, end)
        assert start < hit < end
        salt = osc.saltation(s, v, osc.moment(hit).cos)
        identity = (1.0, 0.0), (0.0, 1.0)
        m = osc.drift(osc.hit(osc.drift(identity, hit - start), salt), end - hit)
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


@pytest.mark.parametrize("p", CASES)
@pytest.mark.parametrize("s", [1, -1])
def test_turning_factor_against_divided_differences(p, s):
    """v before a turn becomes the factor times v after it; to first order x does not notice."""
    osc = floats.oscillator(p)
    turn = (0.1 if s < 0 else 0.1 + math.pi) / osc.omega
    factor = osc.turning_factor(s, osc.moment(turn).cos)
    pull = abs(osc.forcing(osc.moment(turn)))
    assert factor == pytest.approx((pull - osc.f) / (pull + osc.f))
    start, end = turn - 1e-4 / osc.omega, turn + 1e-4 / osc.omega
    back = osc.launch(s, osc.moment(turn), 0.0, 0.0)
    x, v = state(osc, back, start)
    assert s * v > 0

    def after(v):
        flight = osc.launch(s, osc.moment(start), x, v)
        rest = floats.root(lambda t: (osc.velocity(flight, osc.moment(t)), 0.0), start, end)
        place = state(osc, flight, rest)[0]
        return state(osc, osc.launch(-s, osc.moment(rest), place, 0.0), end)

    size = abs(v) / 10
    (x1, v1), (x0, v0) = after(v + size), after(v - size)
    assert (v1 - v0) / (2 * size) == pytest.approx(factor, rel=2e-2, abs=2e-3)
    assert (x1 - x0) / (2 * size) == pytest.approx(0, abs=1e-2 / osc.omega)


def test_hit_and_drift_are_matrix_products():
    """Over fractions, exactly."""
    random, osc = seeded(6), floats.oscillator(PAPER)
    for _ in range(rounds(20)):
        a, b, c, d, duration, salt, e = (Fraction(random.randint(-9, 9), 7) for _ in range(7))
        m = (a, b), (c, d)
        soft = replace(osc, e=e, elastic=False)
        assert osc.hit(m, salt) == ((-a, -b), (salt * a - c, salt * b - d))
        assert osc.drift(m, duration) == ((a + duration * c, b + duration * d), (c, d))
        assert soft.hit(m, salt) == ((-e * a, -e * b), (salt * a - e * c, salt * b - e * d))
        thick = replace(osc, viscous=True, relax=lambda _mu, d: (3 * d, 5 * d, None))
        h, decay = 5 * duration, 3 * duration
        assert thick.drift(m, duration) == ((a + h * c, b + h * d), (decay * c, decay * d))


@pytest.mark.parametrize("p", [SHIFTED, HONEY, OILY])
def test_the_same_code_runs_on_jets(p):
    """Jets of a flight and of a reflection have the derivatives of nested differences."""

    def outcome_of(osc, x, v, t):
        flight, moment = osc.launch(1, osc.moment(osc.F * 0), x, v), osc.moment(t)
        velocity = osc.velocity(flight, moment)
        after = osc.reflect(flight, moment, velocity)
        return [osc.position(flight, moment), velocity, after.x, after.v]

    with interval.workprec(100):
        point = tuple(interval.ball(Fraction(n, 7)) for n in (-12, 9, 2))
        outcome = outcome_of(oscillator(p), *Jet.variables(point, 2))
    osc = floats.oscillator(p)

    def direct(values):
        return outcome_of(osc, *values)

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
    random, osc = seeded(7), floats.oscillator(p)
    with interval.workprec(100):
        balls = oscillator(p)
        for name in ("F", "omega", "f", "l", "r", "e", "mu"):
            lower, upper = interval.ends(getattr(balls, name))
            assert lower <= getattr(p, name) <= upper
        for name in ("T", "F_v", "F_x", "slow_right", "slow_left", "ratio", "sine"):
            assert float(getattr(balls, name)) == pytest.approx(getattr(osc, name), rel=1e-14)
            assert width(getattr(balls, name)) < 1e-25
        for _ in range(rounds(10)):
            flight = random_flight(random, osc)
            t = flight.t + random.uniform(0, 1) * osc.T
            x, v, start = (interval.ball(Fraction(q)) for q in (flight.x, flight.v, flight.t))
            exact = flight._replace(x=x, v=v, t=start)
            results = state(balls, exact, interval.ball(Fraction(t)))
            for ball, number in zip(results, state(osc, flight, t), strict=True):
                assert float(ball) == pytest.approx(number, abs=1e-11)
                assert width(ball) < 1e-22
