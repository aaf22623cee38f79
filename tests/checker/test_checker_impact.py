"""(1,1) orbits in closed form, and their twist, against integration of the flow."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.one_one import closed_form as impact
from cap.checker.one_one.pairs import over_cells, over_intervals, slowest
from cap.checker.one_one.taylor_model import TaylorModel
from cap.checker.one_one.twist import period_map, regularised_twist
from checker.forge import Flow, _mp, _twists
from checker.forge_impact import PAPER, WALLS, System, lowest
from checker.parts import steepness

BITS = 160
SCALED = {"F": "3", "omega": "2", "l": "1/4", "r": "7/4"}


def number(q):
    """Return a thin interval."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def near(value, expected, error="1e-30"):
    """Return whether an interval is short and near a number of mpmath."""
    middle = _mp((value.lower + value.upper) / 2)
    return value.width < 2 ** (BITS // 2) and abs(middle - expected) < mpf(error)


@pytest.mark.parametrize("delta", ["0.1", "0.36", "0.47"])
@pytest.mark.parametrize("walls", [WALLS, SCALED], ids=["paper", "scaled"])
def test_a_pair_is_a_periodic_orbit(walls, delta):
    """The flow, by Newton's method on the hits, closes up after a period with this trace."""
    with mp.workdps(60):
        system, rho = System(walls), number(Fraction(2))
        pair = over_intervals(rho).at(number(delta))
        orbit = system.pair(_mp(delta))
        flow = Flow(walls | {"f": "1"})
        flow.f = orbit.alpha * system.F
        x, v = orbit.start
        hits, speeds, (X, V) = flow.period_map(x, v, 1)
        assert abs(X.coefficients[0, 0] - x) + abs(V.coefficients[0, 0] - v) < mpf(10) ** -40
        assert near(pair.trace.constant, X.coefficients[1, 0] + V.coefficients[0, 1])
        assert near(pair.alpha.constant, orbit.alpha)
        for u, speed in zip(pair.speeds, speeds, strict=True):
            assert near(u.constant * number(Fraction(walls["F"]) / Fraction(walls["omega"])), speed)
        for (cos, sin), t in zip(pair.hits, hits, strict=True):
            t_0 = t.coefficients[0, 0] * system.omega
            assert near(cos.constant, mp.cos(t_0))
            assert near(sin.constant, mp.sin(t_0))
        assert near(slowest(pair), flow.slowest / system.speed)


@pytest.mark.parametrize("delta", ["0.1", "0.2", "0.34", "0.38", "0.45"])
def test_the_twist_is_that_of_the_normal_form(delta):
    """N = (1 + trace) tau_1, with tau_1 from the map of (x, v) and the general normal form."""
    with mp.workdps(50):
        pairs = over_intervals(number(2))
        N = regularised_twist(pairs, pairs.at(number(delta)))
        orbit = System(WALLS).pair(_mp(delta))
        flow = Flow(PAPER)
        flow.f = orbit.alpha
        jets = flow.period_map(*orbit.start, 3)[2]
        tau = _twists(jets, 3, 150)[0]
        assert near(N, (1 + orbit.trace) * tau, "1e-20")


def test_the_twist_of_the_paper_orbit():
    """At f = 2/5 the twist is +0.1134779770."""
    with mp.workdps(40):
        system = System(WALLS)
        delta = mp.findroot(lambda d: system.pair(d).alpha - mpf(2) / 5, 0.3623)
        q = Fraction(int(mp.nint(mp.ldexp(delta, 120))), 2**120)
        pairs = over_intervals(number(2))
        pair = pairs.at(number(q))
        tau = regularised_twist(pairs, pair) / (pair.trace.constant + 1)
        assert near(tau, mpf("0.1134779770"), "1e-10")


def test_the_map_preserves_area():
    """The Jacobian in E and t has the determinant 1 and the trace of the closed form."""
    pairs = over_intervals(number(2))
    pair = pairs.at(number("0.3"))
    E, t = period_map(pairs, pair)
    (a, b), (c, d) = ((w.coefficients[1, 0], w.coefficients[0, 1]) for w in (E, t))
    one = a * d - b * c
    assert one.lower <= 1 <= one.upper
    (a + d).intersection(pair.trace.constant)
    assert near(one, 1)


@pytest.mark.parametrize("ends", [("1/10", "11/100"), ("36/100", "37/100"), ("45/100", "46/100")])
def test_over_a_cell_everything_is_enclosed(ends):
    """Taylor models over a cell contain the values at its points, and are not much wider."""
    low, high = map(Fraction, ends)
    pairs = over_cells(number(2))
    over = pairs.at(TaylorModel.variable(low, high, BITS), 1)
    cell_twist = regularised_twist(pairs, over).range()
    thin, values = over_intervals(number(2)), []
    for k in range(5):
        pair = thin.at(number(low + (high - low) * k / 4), 1)
        for name in ("S", "C", "alpha", "W", "trace"):
            for power in ((0,), (1,)):
                value = getattr(pair, name).coefficients[power]
                range_ = getattr(over, name).coefficients[power].range()
                assert value.lies_in(range_.lower, range_.upper), name
        values.append(regularised_twist(thin, pair))
        assert values[-1].lies_in(cell_twist.lower, cell_twist.upper)
    spread = max(v.upper for v in values) - min(v.lower for v in values)
    assert cell_twist.upper - cell_twist.lower < 2 * spread


@pytest.mark.parametrize("delta", ["1/10", "3/10", "45/100"])
def test_the_slope_of_the_least_speed(delta):
    """L' over a short cell, against differences of the least speed of the flow."""
    half, q = Fraction(1, 10**9), Fraction(delta)
    pair = over_cells(number(2)).at(TaylorModel.variable(q - half, q + half, BITS), 1)
    slope, h = steepness(pair), mpf("1e-12")
    with mp.workdps(40):
        system = System(WALLS)
        low, high = (lowest(system.pair(_mp(delta) + side * h)) for side in (-1, 1))
        exact = (high - low) / (2 * h)
        assert abs(_mp(slope.lower) - exact) + abs(_mp(slope.upper) - exact) < mpf("1e-6")


@pytest.mark.parametrize("alpha", ["1/10", "2/5", "53/100", "6/10"])
@pytest.mark.parametrize("sign", [1, -1])
def test_symmetric_orbits(alpha, sign):
    """Speeds, times, state and k of both orbits, for small and large friction."""
    with mp.workdps(60):
        system = System(WALLS | {"r": "2"})
        orbit = system.symmetric(_mp(alpha), sign)
        found = impact.Symmetric.of(number(alpha), number(3), sign)
        assert near(found.hit_speed, orbit.W)
        assert near(found.t_1, orbit.t1)
        assert near(-found.k + 2, orbit.half_trace)
        x, v = orbit.start
        assert near(-found.start[0] + 2, x)
        assert near(found.start[1], v)
        assert near(found.slowest, orbit.least_speed)
        sampled = min(orbit.u(orbit.t1 + mp.pi * k / 300) for k in range(600))
        assert abs(orbit.least_speed - sampled) < mpf("0.001")


def test_births():
    """There are pairs below (pi^2 - 4)/2, half turns below pi^2 - 2; between, nothing is said."""
    assert impact.birth(number("2.93")) is not None
    assert impact.birth(number("2.94")) is None
    assert impact.half_turn(number("7.8")) is not None
    assert impact.half_turn(number("7.9")) is None
    undecided = (pi(BITS).square() - 4) / 2
    with pytest.raises(Rejected, match="not decided"):
        impact.birth(undecided)
