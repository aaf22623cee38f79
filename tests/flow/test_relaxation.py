"""D = exp(-μd), h = (1 - D)/μ and k = (d - h)/μ, and their limits as μ -> 0, in every scalar."""

from fractions import Fraction

import mpmath
import pytest
from mpmath import mp
from support import (
    between,
    decimal_fraction,
    holds,
    inside,
    number,
    rounds,
    seeded,
    value_at,
    width,
)

from cap.flow import relaxation
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.taylor_model import Domain

RATES = [
    Fraction(0),
    Fraction(1, 10**30),
    Fraction(1, 10**6),
    Fraction(1, 3),
    Fraction(7),
    Fraction(400),
]


def exact(mu, d):
    """Return D, h and k by their integrals' series or closed forms, at the precision of mpmath."""
    mu, d = number(mu), number(d)
    if abs(mu * d) > 1:
        decay = mp.exp(-mu * d)
        return decay, (1 - decay) / mu, (d - (1 - decay) / mu) / mu
    terms = [(-mu) ** n * d**n / mp.factorial(n) for n in range(60)]
    h = mp.fsum(d * t / (n + 1) for n, t in enumerate(terms))
    k = mp.fsum(d * d * t / (n + 1) / (n + 2) for n, t in enumerate(terms))
    return mp.fsum(terms), h, k


@pytest.mark.parametrize("mu", RATES)
def test_floats(mu):
    """To fifteen digits, across the switch from series to closed form, for times of either sign."""
    with mpmath.workdps(50):
        for d in (0.0, 1e-300, 1e-8, 0.0999, 0.1, 0.1001, 0.29, 0.301, 1.0, 20.0, -0.05, -1.0):
            if abs(float(mu) * d) < 300:
                values = exact(mu, Fraction(d))
                for ours, true in zip(relaxation.of_floats(float(mu), d), values, strict=True):
                    assert ours == pytest.approx(float(true), rel=3e-14, abs=1e-320)


@pytest.mark.parametrize("mu", RATES)
def test_balls(mu):
    """Thin balls are sharp; thick ones, in μ and d, contain the values at random points."""
    random = seeded(str(mu))
    with mpmath.workdps(60), interval.workprec(150):
        for _ in range(rounds(20)):
            d, r = decimal_fraction(random) / 2, Fraction(1, random.choice([10, 1000, 10**9]))
            thin = relaxation.relax(interval.ball(mu), interval.ball(d))
            thick = relaxation.relax(between(mu, mu + r), interval.around(d, r))
            for ball, value in zip(thin, exact(mu, d), strict=True):
                assert holds(ball, value, abs(Fraction(int(abs(value)) + 1, 10**40)))
                assert width(ball) <= 1e-30 * (1 + abs(float(value)))
            for _ in range(4):
                inner = mu + r * Fraction(random.randint(0, 9), 9), inside(random, d, r)
                for ball, value in zip(thick, exact(*inner), strict=True):
                    assert holds(ball, value, Fraction(int(abs(value)) + 1, 10**40))


@pytest.mark.parametrize("mu", [(0, 0), (0, 2), ("1/3", "1/3"), (0, "1/10"), (5, 6)])
def test_jets_and_taylor_models(mu):
    """Over a box of times: jets against divided differences, models against random points."""
    low, high = map(Fraction, mu)
    random = seeded(str(mu))
    with mpmath.workdps(60), interval.workprec(150):
        rate, d, r = between(low, high), Fraction(3, 7), Fraction(1, 50)
        jets = relaxation.relax(rate, Jet.variables((interval.around(d, r),), 4)[0])
        for _ in range(rounds(5)):
            exact_mu = low + (high - low) * Fraction(random.randint(0, 9), 9)
            time = number(inside(random, d, r))
            for n in range(3):
                series = mp.taylor(lambda t, n=n, m=exact_mu: at(m, t)[n], time, 4)
                for k, value in enumerate(series):
                    assert holds(jets[n][(k,)] + Ball(0), value, Fraction(1, 10**8))
        (model,) = Domain((interval.ball(r),), 3).variables((interval.ball(d),))
        models = relaxation.relax(rate, model + model * model)
        for _ in range(rounds(10)):
            exact_mu = low + (high - low) * Fraction(random.randint(0, 9), 9)
            offset = inside(random, 0, r)
            values = exact(exact_mu, (d + offset) * (1 + d + offset))
            for got, value in zip(models, values, strict=True):
                assert holds(got.bound(), value, Fraction(1, 10**30))
                assert holds(value_at(got, (offset,)), value, Fraction(1, 10**30))
                assert low < high or width(got.remainder) < 1e-4


def test_the_rate_may_be_a_set_of_functions_too():
    """Taylor models in μ and d, μ = 0 inside: contain the values at random points."""
    random, r = seeded(5), Fraction(1, 20)
    with mpmath.workdps(60), interval.workprec(150):
        centre = Fraction(1, 20), Fraction(3, 2)
        mu, d = Domain((interval.ball(r),) * 2, 3).variables([interval.ball(c) for c in centre])
        models = relaxation.relax(mu, d)
        for _ in range(rounds(20)):
            point = inside(random, 0, r), inside(random, 0, r)
            values = exact(centre[0] + point[0], centre[1] + point[1])
            for model, value in zip(models, values, strict=True):
                assert holds(value_at(model, point), value, Fraction(1, 10**30))
                assert width(model.remainder) < 1e-3


def at(mu, t):
    """Return D, h and k at a time of mpmath."""
    rate = number(mu)
    if not mu:
        return mp.mpf(1), t, t * t / 2
    decay = mp.exp(-rate * t)
    return decay, (1 - decay) / rate, (t - (1 - decay) / rate) / rate


def test_nothing_is_certain_of_indeterminate_times():
    """NaN and infinite balls stay so."""
    for bad in (Ball("nan"), Ball(0, "inf")):
        assert not any(q.is_finite() for q in relaxation.relax(Ball(1), bad))
        assert not any(q.is_finite() for q in relaxation.relax(bad, Ball(1)))
