"""The twist of the paper's elliptic orbit: by another formula, and by experiment."""

import math
from fractions import Fraction

import mpmath
import pytest
import reference
from mpmath import mp, mpc, mpf
from support import holds, number, width

from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import oscillator
from cap.maps import normal_form
from cap.maps.fixed_point import prove
from cap.parameters import PAPER
from cap.sets import interval

BITS = 300


def cubic_formula(table):
    """Return e^{iΘ} and τ_1 of Taylor coefficients, by the formula of Neimark-Sacker theory.

    Kuznetsov, Elements of Applied Bifurcation Theory, (4.21); the scale of z as in `normal_form`.
    """
    (a, c), (_, d) = table[1, 0], table[0, 1]
    sin = mp.sign(c) * mp.sqrt(1 - ((a + d) / 2) ** 2)
    m = mpc((a + d) / 2, sin)
    p = mp.sqrt(c / sin)
    q = (m - a) * p / c
    # dx = (q z̄ - q̄ z)/2i, dv = p (z - z̄)/2i; g_jk / j!k! is the coefficient of z^j z̄^k
    dx, dv = (-mp.conj(q) / 2j, q / 2j), (p / 2j, -p / 2j)
    g = {}
    for (i, j), (fx, fv) in table.items():
        for chosen in range(2 ** (i + j)):
            bits = [chosen >> n & 1 for n in range(i + j)]
            weight = mp.fprod((dx if n < i else dv)[bit] for n, bit in enumerate(bits))
            key = (i + j - sum(bits), sum(bits))
            g[key] = g.get(key, 0) + (p * fx + q * fv) * weight
    g20, g11, g02, g21 = 2 * g[2, 0], g[1, 1], 2 * g[0, 2], 2 * g[2, 1]
    c1 = g20 * g11 * (mp.conj(m) - 3 + 2 * m) / (2 * (m * m - m) * (mp.conj(m) - 1))
    c1 += abs(g11) ** 2 / (1 - mp.conj(m)) + abs(g02) ** 2 / (2 * (m * m - mp.conj(m))) + g21 / 2
    assert abs((c1 / m).real) < mpf(10) ** -12
    return m, (c1 / m).imag


def paper_orbit(order, starts):
    """Return P*, its linear part and its twists to the order."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        point = prove(osc, starts["elliptic"], 60)
        jets = strobe_jet(osc, point.box, point.orbit, order)
        return point, normal_form.ellipticity(*jets), normal_form.twists(*jets)


def test_the_twist_of_the_paper(starts):
    """τ_1 by an independent formula from divided differences; τ_1 and τ_2 as known."""
    point, linear, (first, second) = paper_orbit(5, starts)
    with mpmath.workdps(reference.DIGITS):
        state = (number(interval.midpoint(c)) for c in point.box)
        table = reference.derivatives(reference.System.of(PAPER), *state, 3)
        multiplier, tau = cubic_formula(table)
        assert holds(first, tau, Fraction(1, 10**14))
        assert holds(linear.multiplier.real, multiplier.real, Fraction(1, 10**20))
        assert holds(linear.multiplier.imag, multiplier.imag, Fraction(1, 10**20))
    assert float(first) == pytest.approx(0.11347797703, abs=1e-11)
    assert float(second) == pytest.approx(-37869.179, abs=1e-3)
    assert max(map(width, (first, second))) < 1e-20


def rotation(linear, centre, radius, turns=2500):
    """Measure by weighted Birkhoff averages the mean turn and |z|² of an orbit, in floats."""
    system = reference.System.of(PAPER)
    p, q = float(linear.p), complex(float(linear.q.real), float(linear.q.imag))
    x0, v0 = (float(interval.midpoint(c)) for c in centre)
    dv = 0.0
    dx = radius / p
    total = angle = square = 0.0
    z = p * dx + q * dv
    for n in range(1, turns):
        dx, dv = deviation(system, (x0, v0), (dx, dv))
        after = p * dx + q * dv
        turn = math.atan2((after / z).imag, (after / z).real)
        t = n / turns
        weight = math.exp(-1 / (t * (1 - t)))
        total += weight
        angle += weight * turn
        square += weight * abs(z) ** 2
        z = after
    return angle / total, square / total


def deviation(system, centre, z):
    """Return Φ(centre + z) - centre in floats; the centre is a fixed point."""
    flight = reference.Flight(system, 1, 0.0, centre[0] + z[0], centre[1] + z[1]).floats()
    wall = {1: float(system.r), -1: float(system.l)}
    for guess in (1.0991729107122206, 3.516090441407105):
        t = guess
        for _ in range(6):
            t -= (flight.position(t, math) - wall[flight.s]) / flight.velocity(t, math)
        v = flight.velocity(t, math)
        flight = reference.Flight(flight.system, -flight.s, t, wall[flight.s], -v)
    end = 2 * math.pi
    return flight.position(end, math) - centre[0], flight.velocity(end, math) - centre[1]


def test_the_twist_is_what_an_experiment_sees(starts):
    """The mean turn on two orbits is Θ + τ_1 |w|² + τ_2 |w|⁴, within what floats show."""
    point, linear, (first, second) = paper_orbit(5, starts)
    for radius in (2.5e-4, 5e-4):
        turn, square = rotation(linear, point.box, radius)
        measured = (turn - float(linear.theta)) / square
        assert measured == pytest.approx(float(first) + float(second) * square, abs=2e-5)
