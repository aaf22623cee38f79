"""Polynomials that a map hardly changes: bounds against samples, the drift against the map."""

import cmath
import math
from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.errors import NotProved
from cap.flow.event import BALLS
from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import oscillator, strobe
from cap.maps import approximate_integral as integrals
from cap.maps import fixed_point, normal_form
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet, Space

START = Start.non_sticking(0.1003, 0.5419, (1.09917, 3.51609))
DEGREE, ORDER = 5, 8


@pytest.fixture(scope="module")
def found():
    """Return the oscillator, the fixed point, its linear part and H to some degree."""
    with interval.workprec(160):
        osc = oscillator(PAPER)
        point = fixed_point.prove(osc, START, 30)
        jets = strobe_jet(osc, point.box, point.orbit, DEGREE + 2)
        linear = normal_form.ellipticity(*jets)
        f = normal_form.complex_map(*jets, linear)
        return osc, point, linear, f, integrals.integral(f.truncated(DEGREE), linear)


def on_the_ellipse(found, radius):
    """Return an ellipse with H in its coordinates."""
    _, point, linear, _, H = found
    E = integrals.ellipse(linear, tuple(round(m, 12) for m in point.hint.centre), radius)
    return E, integrals.polynomial(H, linear, point.box, E, 30)


def windows(found):
    """Return the events of all orbits from a box around the ellipses."""
    osc, point = found[:2]
    return fixed_point.neighbourhood(osc, point, (Fraction(1, 200), Fraction(1, 200))).expected


def value(H, u):
    """Return H(u) in balls, term by term."""
    return interval.total(
        interval.ball(c) * u[0] ** i * u[1] ** j
        for (i, j), c in zip(H.space.exponents, H.coefficients, strict=True)
    )


def test_sizes_bound_polynomials_on_the_disk():
    """Of each degree, from above, and not by far."""
    random = seeded(1)
    space = Space(2, 7)
    for _ in range(rounds(20)):
        f = Jet(space, [Ball(random.uniform(-1, 1)) for _ in space.exponents])
        bounds = [float(q.mid()) for q in integrals.sizes(f)]
        for n in range(8):
            most = 0
            for k in range(100):
                a, b = math.cos(k / 16), math.sin(k / 16)
                terms = (float(f[i, n - i].mid()) * a**i * b ** (n - i) for i in range(n + 1))
                most = max(most, abs(math.fsum(terms)))
            assert most <= bounds[n] * (1 + 1e-12) <= 4 * most + 1e-12


def test_the_integral_is_the_square_of_the_radius_and_hardly_changes(found):
    """H = |z|² + O(|z|³), and H∘Φ - H = O(|z|^(d+1))."""
    _, _, _, f, H = found
    with interval.workprec(160):
        assert H[1, 1].real.contains(1)
        assert all(H[j, 2 - j].contains(0) for j in (0, 2))
        long = H.extended(DEGREE + 2)
        change = normal_form.substitute(long, (f, normal_form.conjugate(f))) - long
        sizes = [float(q.mid()) for q in integrals.moduli(change)]
        assert max(sizes[: DEGREE + 1]) < 1e-25
        assert sizes[DEGREE + 1] > 1


def test_the_drift_bounds_the_change(found):
    """On an ellipse, against Φ at points of it; and it is not much larger than the change."""
    osc = found[0]
    random = seeded(2)
    with interval.workprec(160):
        E, H = on_the_ellipse(found, 0.002)
        wide = windows(found)
        bound = integrals.drift(osc, wide, E, H, ORDER)
        most = 0.0
        for k in range(rounds(60)):
            w = cmath.rect(1 if k % 2 else random.random(), random.uniform(0, 7))
            u = interval.ball(Fraction(w.real)), interval.ball(Fraction(w.imag))
            state = tuple(
                interval.ball(c) + u[0] * interval.ball(a) + u[1] * interval.ball(b)
                for c, (a, b) in zip(E.centre, E.axes, strict=True)
            )
            end = strobe(osc, state, wide, BALLS).end
            change = abs(value(H, E.coordinates(end)) - value(H, u))
            assert not change > bound
            most = max(most, float(change.mid()))
        assert most > float(bound.upper()) / 5


def test_bounds_of_the_integral(found):
    """H is at most ``inner`` on the smaller ellipse, at least ``outer`` on the boundary."""
    osc = found[0]
    with interval.workprec(160):
        E, H = on_the_ellipse(found, 0.002)
        part = Fraction(4, 5)
        held = integrals.held(osc, windows(found), E, H, part, ORDER)
        values = []
        for k in range(100):
            u = [interval.ball(Fraction(q(k / 16))) for q in (math.cos, math.sin)]
            values.append([value(H, [q * s for q in u]) for s in (interval.ball(part), 1)])
        assert all(a < held.inner for a, _ in values)
        assert all(b > held.outer * (1 - Ball("1e-15")) for _, b in values)
        assert held.inner < Ball("0.7")
        assert held.outer > Ball("0.9")


def test_the_plan_is_the_largest_of_few(found):
    """More periods, a smaller ellipse; a limit is kept to; too many for any are refused."""
    growths = integrals.growths(found[3], found[4])
    inner = []
    for periods in (10**3, 10**5, 10**7):
        plan = integrals.plan(growths, Fraction(periods), 0.01)
        assert plan.radius <= 0.01
        assert 0 < plan.part < 1
        inner.append(plan.radius * plan.part)
    assert inner[0] > inner[1] > inner[2]
    assert integrals.plan(growths, Fraction(10**5), inner[1] / 2).radius <= inner[1] / 2
    with pytest.raises(NotProved, match="no ellipse is found"):
        integrals.plan(growths, Fraction(10**40), 0.01)
