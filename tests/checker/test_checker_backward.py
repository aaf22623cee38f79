"""The flow backwards from sticks: orbits in floats come back, areas are those of the images."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from cap.cells.listing import written
from cap.checker.folded.backward import System, upcoming
from cap.checker.folded.events import after, event
from cap.checker.folded.instants import hitting, stopping
from cap.checker.folded.regions import flights, leaves
from cap.checker.folded.sticks import (
    PARTS,
    all_sticks,
    at_event,
    backwards,
    flown,
    multiple,
    places_of,
    sticks,
)
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Parameters
from cap.floats import swarm
from cap.parameters import Parameters as Given
from checker.mixed_small import even

SYSTEMS = {
    "paper": Parameters(*map(Fraction, (1, 1, "2/5", -1, 1))),
    "other": Parameters(*map(Fraction, (3, 2, "4/3", "-1/2", "3/4"))),
    "weak": Parameters(*map(Fraction, (1, 1, "1/5", -1, 1))),
}
MIDDLES = np.linspace(-1, 1, 41)[1::2]


def value(p, x, y):
    """Return the polynomial of a model at points, and its derivatives."""
    X = [x**i for i in range(5)]
    Y = [y**j for j in range(5)]
    at = sum(c * X[i] * Y[j] for c, (i, j) in zip(p, q.MONOMIALS, strict=False))
    px = sum(c * i * X[i - 1] * Y[j] for c, (i, j) in zip(p, q.MONOMIALS, strict=False) if i)
    py = sum(c * j * X[i] * Y[j - 1] for c, (i, j) in zip(p, q.MONOMIALS, strict=False) if j)
    return at, px, py


def strobes(y, start, count=12):
    """Give the models (p, s) at the multiples of pi, their number, and the density then."""
    f = start.flight
    try:
        for _ in range(count):
            for k, _speeds, _most in flown(y, f):
                yield *y.at(f, multiple(y, k - f.passed)[0]), k - f.passed, f
            f = after(y, f, event(y, f))
    except Rejected:
        return


def regions(y):
    """Give starts of regions of both arcs."""
    for late in (False, True):
        for n, leaf in enumerate(leaves(even(4, 5, 12), all_sticks(y))):
            if n % 29 == 7:
                yield late, leaf.region, sticks(y, leaf.region, late=late)


@pytest.mark.parametrize("name", SYSTEMS)
def test_orbits_in_floats_come_back(name):
    """From a state at t = 0 the first release after a stick is at the place of the region."""
    p, compared = SYSTEMS[name], 0
    y, rng = System(p), np.random.default_rng(3)
    given, unit = Given(p.F, p.omega, p.f, p.l, p.r), float(p.F / p.omega**2)
    theta = math.acos(p.f / p.F)
    for late, region, start in regions(y):
        places = places_of(y, region, late=late)
        for place, speed, k, _f in strobes(y, start):
            x, z = rng.uniform(-1, 1, 2)
            a, v = value(place, x, z)[0] * unit, value(speed, x, z)[0] * unit * float(p.omega)
            state = (float(p.l) - a, v) if k % 2 else (float(p.r) + a, -v)
            if abs(v) > 4 * unit * float(p.omega):
                continue
            gap = released(given, state, theta) * float(p.omega**2 / p.F)
            low, high = places[int((z + 1) / 2 * PARTS)]
            assert low - 1e-6 < gap < high + 1e-6
            compared += 1
    assert compared > 40


def released(p, state, theta):
    """Return the distance to the wall ahead at the first release after a stick."""
    first = (math.pi - theta) / 2 / math.pi - 1e-9  # to the left
    found = swarm.follow(p, [state], first)
    for n in range(60):
        place, speed = found.states[0]
        if speed == 0:
            return float(p.r) - place if n % 2 else place - float(p.l)
        t0 = (first + n / 2) * 2 * math.pi / float(p.omega)
        found = swarm.follow(p, found.states, 0.5, t0)
    return math.nan


def test_polynomials_are_next_to_the_times_of_events():
    """What they leave of p or s falls by 32, nearly, with half the distance from the middle."""
    y, ratios = System(SYSTEMS["paper"]), {"hit": [], "stop": []}
    for _late, _, start in regions(y):
        for f in flown_from(y, start.flight, 6):
            kind, near, _k = upcoming(y, f)
            d = (hitting if kind == "hit" else stopping)(y, f, near)
            left = [abs(remains(y, f, kind, near, d, x)) for x in (0.2, 0.1)]
            if left[0] > 1e-10:
                ratios[kind].append(left[0] / left[1])
    assert min(map(len, ratios.values())) > 3
    assert all(20 < np.median(found) < 100 for found in ratios.values())


def flown_from(y, f, count):
    """Give so many flights, or as many as are certain."""
    for _ in range(count):
        yield f
        try:
            f = after(y, f, event(y, f))
        except Rejected:
            return


def remains(y, f, kind, near, d, x):
    """Return p or s at a point, at the time of a polynomial."""
    t = near + value(d, x, x)[0]
    D, A, B = t - f.ref, value(f.A, x, x)[0], value(f.B, x, x)[0]
    if kind == "hit":
        return D * (y.a * D / 2 + A) + B - math.cos(t)
    return math.sin(t) + y.a * D + A


@pytest.mark.parametrize("name", SYSTEMS)
def test_areas_are_those_of_the_images(name):
    """The density is the determinant of (p, s) in X and Y; its integral is a bound from below."""
    y, compared = System(SYSTEMS[name]), 0
    x, z = np.meshgrid(MIDDLES, MIDDLES)
    for _late, _, start in regions(y):
        for place, speed, _k, f in strobes(y, start):
            (_, px, py), (_, sx, sy) = value(place, x, z), value(speed, x, z)
            area = 4 * np.mean(np.abs(px * sy - py * sx))
            found = q.integral(f.density)
            if f.density[q.LAST] < 1e-3 * abs(f.density[0]) and max(f.errors) < 1e-5:
                assert found == pytest.approx(area, rel=1e-2)
                compared += 1
    assert compared > 20


def test_densities_only_grow():
    """So that of two the one before an event is the lesser."""
    y = System(SYSTEMS["paper"])
    for _late, _, start in regions(y):
        found = [q.ends(density)[0] for density, _ in backwards(y, start.flight, 6)]
        assert all(b >= a * (1 - 1e-9) for a, b in pairwise(found) if a > 0)


def test_each_multiple_of_pi_is_passed_once():
    """One after the other, none twice."""
    y = System(SYSTEMS["paper"])
    for _late, _, start in regions(y):
        strobes = (each for _, found in backwards(y, start.flight, 12) for each in found)
        passed = [each.number for each in strobes]
        assert passed == sorted(set(passed))


def test_products_and_functions_contain_their_values():
    """Models of random polynomials, at random points; also with large coefficients."""
    rng = np.random.default_rng(5)
    for _ in range(200):
        a, b = (
            (*(rng.normal(size=q.LAST) * 0.1 ** rng.uniform(0, 2)).tolist(), 1e-3 * rng.random())
            for _ in range(2)
        )
        a = (1 + 5 * rng.random(), *a[1:])
        x, z = rng.uniform(-1, 1, 2)
        u, w = value(a, x, z)[0], value(b, x, z)[0]
        cos, sin = q.trigonometric(b)
        pairs = [(q.product(a, b), u * w), (cos, math.cos(w)), (sin, math.sin(w))]
        pairs += [(q.total(a, b), u + w), (q.scaled(b, -2.5), -2.5 * w)]
        if q.size(q.with_constant(a, 0.0)) < 0.5 * a[0]:
            pairs.append((q.inverse(a), 1 / u))
        for p, truth in pairs:
            assert abs(value(p, x, z)[0] - truth) <= p[q.LAST]
            low, high = q.ends(p)
            assert low <= truth <= high


def test_an_integral_is_a_bound_from_below():
    """Of what may be a little less than the polynomial."""
    rng, t = np.random.default_rng(6), np.linspace(-1, 1, 402)[:-1] + 1 / 401
    x, z = np.meshgrid(t, t)
    for _ in range(5):
        p = (*rng.normal(size=q.LAST), 0.01)
        mean = 4 * float(np.mean(value(p, x, z)[0]))
        assert q.integral(p) == pytest.approx(mean - 0.04, abs=1e-3)


def test_parts_where_a_model_is_small():
    """What is said of a half plane is what there is; of bent models, nothing too large."""
    rng, t = np.random.default_rng(7), np.linspace(-1, 1, 402)[:-1] + 1 / 401
    x, z = np.meshgrid(t, t)
    for a, b in (
        (0.3, 0.2),
        (-0.2, 0.7),
        (0.5, 0.0),
        (0.0, -1e-20),
        (1e-9, 2.0),
        (0.0, 0.0),
        (1e-170, 1e-170),
    ):
        for v in np.linspace(-1.1, 1.1, 23):
            p = q.model(Y=a, X=b, one=0.01)
            truth = float(np.mean(value(p, x, z)[0] < v))
            assert q.part_below(p, v) == pytest.approx(truth, abs=4e-3)
    inside = []
    for _ in range(200):
        p = (*(rng.normal(size=q.LAST) * ([1] * 3 + [0.1] * 12)).tolist(), 0.01)
        v = rng.normal()
        found, truth = q.part_below(p, v), float(np.mean(value(p, x, z)[0] + 0.01 < v))
        assert found <= truth + 4e-3
        inside.append(found > 0.5 * truth > 0)
    assert sum(inside) > 50


def test_integrals_where_a_model_is_small():
    """Bounds from below of the integral, close for a density that varies little."""
    rng, t = np.random.default_rng(8), np.linspace(-1, 1, 402)[:-1] + 1 / 401
    x, z = np.meshgrid(t, t)
    for _ in range(100):
        p = (*(rng.normal(size=q.LAST) * ([1] * 3 + [0.003] * 12)).tolist(), 1e-4)
        density = (1.0, *(rng.normal(size=q.LAST - 1) * 0.003).tolist(), 0.0)
        v = rng.normal()
        truth = 4 * float(np.mean(value(density, x, z)[0] * (value(p, x, z)[0] + 1e-4 < v)))
        found = q.integral_below(density, p, v)
        assert truth - 0.25 < found <= truth + 0.02
    assert q.integral_below(density, q.model(one=1.0), 2.0) == q.integral(density)
    assert q.integral_below(density, q.model(one=1.0), 0.5) == 0


def test_areas_of_what_is_slower_than_a_speed():
    """In regions that are partly faster: the part of points, but for a little, and not more."""
    y, parts, t = System(SYSTEMS["paper"]), [], np.linspace(-1, 1, 202)[:-1] + 1 / 201
    x, z = np.meshgrid(t, t)
    for _late, _, start in regions(y):
        for f in flown_from(y, start.flight, 6):
            for strobe in flown(y, f):
                V = strobe.most[0]
                slow = value(strobe.most, x, z)[0] < V
                truth = 4 * np.mean(slow * value(f.density, x, z)[0])
                found = q.integral_below(f.density, strobe.most, V)
                assert found < truth * 1.02
                parts.append(found / truth)
    assert len(parts) > 20
    assert np.quantile(parts, 0.75) > 0.8


def test_speeds_at_events_are_bounded():
    """At a multiple of pi next to an event, before it or after it."""
    y, compared = System(SYSTEMS["paper"]), 0
    corners = [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
    for _late, _, start in regions(y):
        for f in flown_from(y, start.flight, 6):
            try:
                e = event(y, f)
                g = after(y, f, e)
            except Rejected:
                break
            for strobe in at_event(y, f, e, len(list(flown(y, f)))):
                t = (strobe.number - f.passed) * math.pi
                for a, b in corners:
                    T = e.near + value(e.d, a, b)[0]
                    if abs(T - t) < 1e-3:
                        continue
                    flight, time = (f, t) if t < T else (g, t - (g.passed - f.passed) * math.pi)
                    s = value(y.at(flight, time)[1], a, b)[0]
                    assert s < value(strobe.most, a, b)[0] + strobe.most[q.LAST] + 1e-9
                    compared += 1
    assert compared > 20


def test_flights_of_a_tree():
    """They are counted without its regions, and four more for each leaf."""
    tree = written([1, 2, 0, 0, 0, 5, 0, 12])
    assert flights(tree) == (3 + 4) + (10 + 4)
    y = System(SYSTEMS["paper"])
    assert [leaf.flights for leaf in leaves(tree, all_sticks(y))] == [3, 10]
