"""The flow backwards from stops: orbits in floats come back, areas are those of the images."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from cap.areas.folded.next_event import HIT, next_event, place_at, speed_at
from cap.areas.listing import written
from cap.checker.folded.events import after, event
from cap.checker.folded.instants import hitting, stopping
from cap.checker.folded.motion import Direction, upcoming
from cap.checker.folded.regions import CUT, UNIT, Region, flights, leaves
from cap.checker.folded.stops import (
    EARLY,
    LATE,
    PARTS,
    across,
    all_stops,
    at_hit,
    backwards,
    flown,
    places_of,
    sticks,
    turns,
)
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters
from cap.floats.engine import swarm
from cap.parameters import Parameters as Given
from checker.mixed_small import even

SYSTEMS = {
    "paper": Parameters(*map(Fraction, (1, 1, "2/5", -1, 1))),
    "other": Parameters(*map(Fraction, (3, 2, "4/3", "-1/2", "3/4"))),
    "weak": Parameters(*map(Fraction, (1, 1, "1/5", -1, 1))),
}
FAST = 3.0
MIDDLES = np.linspace(-1, 1, 41)[1::2]


def value(p, x, y):
    """Return the polynomial of a model at points, and its derivatives."""
    X = [x**i for i in range(5)]
    Y = [y**j for j in range(5)]
    at = sum(c * X[i] * Y[j] for c, (i, j) in zip(p, q.MONOMIALS, strict=False))
    px = sum(c * i * X[i - 1] * Y[j] for c, (i, j) in zip(p, q.MONOMIALS, strict=False) if i)
    py = sum(c * j * X[i] * Y[j - 1] for c, (i, j) in zip(p, q.MONOMIALS, strict=False) if j)
    return at, px, py


def grid(n):
    """Return the monomials of a model at n * n points: the values of one are ``model[:LAST] @``."""
    t = np.linspace(-1, 1, n + 1)[:-1] + 1 / n
    x, z = np.meshgrid(t, t)
    return np.array([(x**i * z**j).ravel() for i, j in q.MONOMIALS])


def regions(y):
    """Give starts of regions of stops: 0 for turns or the side, the region and the start.

    Early sticks are soon after a stop, but for those soon after a hit: these are given.
    """
    for kind in (LATE, 0):
        for n, leaf in enumerate(leaves(even(4, 5, 12), all_stops(y))):
            if n % 29 == 7:
                yield (
                    kind,
                    leaf.region,
                    sticks(y, kind, leaf.region) if kind else turns(y, leaf.region),
                )
    for n, leaf in enumerate(leaves(even(6, 9, 12), all_stops(y))):
        if n % 512 > 496 and n // 512 % 3 == 1:
            yield EARLY, leaf.region, sticks(y, EARLY, leaf.region)


def strobes(y, start, count=12, error=math.inf):
    """Give the models (p, s) at the multiples of pi, their number, and the flight then.

    What is known less well is left out: orbits in floats from there are others.
    """
    for f, strobe in backwards(y, start.flight, count, FAST):
        k = strobe.number - f.passed
        if f.begun[1] < k * math.pi and max(f.errors) < error:
            yield *y.at(f, y.multiple(k)[0]), k, f


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
def test_orbits_in_floats_come_back(name):
    """From a state at t = 0 the first stop is that of the region, at its place and time."""
    p, compared = SYSTEMS[name], {LATE: 0, EARLY: 0, 0: 0}
    y, ahead, rng = Direction(p), Direction(p, forwards=True), np.random.default_rng(3)
    for kind, region, start in regions(y):
        f0, long = start.flight, time_of(kind, y, region)
        for place, speed, k, _f in strobes(y, start, error=1e-5 if kind == EARLY else 1e-3):
            x, z = rng.uniform(-1, 1, 2)
            a, s = value(place, x, z)[0], value(speed, x, z)[0]
            if s < 0 or not -y.width[0] < a < 0:
                continue  # a hit was before
            q, time = stop(ahead, -y.width[0] - a, s, -k * math.pi + math.pi)
            assert math.cos(time - f0.ref - long * z) > 1 - 1e-6
            assert abs(q - value(across(region)[0], x, z)[0]) < 1e-3
            compared[kind] += 1
    assert min(compared[LATE], compared[0]) > 12
    assert compared[EARLY] > (0 if name == "weak" else 15)  # there few are not after a stop


def time_of(kind, y, region):
    """Return how long half of the times of a region are."""
    half = y.pi[0] / 2 - y.rest[0] if kind else y.rest[0]
    return half * 0.5**region.n


def stop(y, p, s, t):
    """Return where and when a mass stops first, as it begins backwards."""
    W = y.width[0]
    for _ in range(60):
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(y.a, math.pi - y.theta[0], A, B, t, t)
        s, p = speed_at(T, y.a, A, t), place_at(T, y.a, A, B, t)
        if kind != HIT:
            return -W - p, -T - math.pi
        p, t = -W, (T + math.pi) % (2 * math.pi)
    return math.nan, math.nan


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
def test_releases_in_floats_are_where_they_are_said_to_be(name):
    """From a state at t = 0 the first release after a stick is at the place of the region."""
    p, compared = SYSTEMS[name], {LATE: 0, EARLY: 0}
    y, rng = Direction(p), np.random.default_rng(3)
    given, unit = Given(p.F, p.omega, p.f, p.l, p.r), float(p.F / p.omega**2)
    theta = math.acos(p.f / p.F)
    for kind, region, start in regions(y):
        places = places_of(y, kind, region)
        for place, speed, k, _f in (
            strobes(y, start, error=1e-5 if kind == EARLY else math.inf) if kind else ()
        ):
            x, z = rng.uniform(-1, 1, 2)
            a, v = value(place, x, z)[0] * unit, value(speed, x, z)[0] * unit * float(p.omega)
            state = (float(p.l) - a, v) if k % 2 else (float(p.r) + a, -v)
            if not float(p.l) < state[0] < float(p.r) or v < 0 or abs(v) > 4 * unit * p.omega:
                continue
            gap = released(given, state, theta) * float(p.omega**2 / p.F)
            low, high = places[int((z + 1) / 2 * PARTS)]
            assert low - 1e-6 < gap < high + 1e-6
            compared[kind] += 1
    assert compared[LATE] > 10
    assert compared[EARLY] > (0 if name == "weak" else 10)


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
    y, ratios = Direction(SYSTEMS["paper"]), {"hit": [], "stop": []}
    for _kind, _, start in regions(y):
        for f in flown_from(y, start.flight, 6):
            kind, near, _k = upcoming(y, f)
            near, d = (hitting if kind == "hit" else stopping)(y, f, near)
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
            e = event(y, f)
            if e.p:
                return
            f = after(y, f, e)
        except Rejected:
            return


def remains(y, f, kind, near, d, x):
    """Return p or s at a point, at the time of a polynomial."""
    t = near + value(d, x, x)[0]
    D, A, B = t - f.ref, value(f.A, x, x)[0], value(f.B, x, x)[0]
    if kind == "hit":
        return D * (y.a * D / 2 + A) + B - math.cos(t)
    return math.sin(t) + y.a * D + A


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
def test_areas_are_those_of_the_images(name):
    """The density is the determinant of (p, s) in X and Y; its integral is a bound from below."""
    y, compared = Direction(SYSTEMS[name]), 0
    x, z = np.meshgrid(MIDDLES, MIDDLES)
    for _kind, _, start in regions(y):
        for place, speed, _k, f in strobes(y, start):
            (_, px, py), (_, sx, sy) = value(place, x, z), value(speed, x, z)
            area = 4 * np.mean(np.abs(px * sy - py * sx))
            found = q.integral(start.density)
            if start.density[q.LAST] < 1e-3 * abs(start.density[0]) and max(f.errors) < 1e-5:
                assert found == pytest.approx(area, rel=1e-2)
                compared += 1
    assert compared > 20


def test_each_multiple_of_pi_is_passed_once():
    """One after the other, none twice."""
    y = Direction(SYSTEMS["paper"])
    for _kind, _, start in regions(y):
        passed = [strobe.number for _, strobe in backwards(y, start.flight, 12, FAST)]
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


@pytest.mark.slow
def test_parts_where_a_model_is_small():
    """What is said of a half plane is what there is; of bent models, nothing too large."""
    rng, points = np.random.default_rng(7), grid(401)
    for a, b in (
        (0.3, 0.2),
        (-0.2, 0.7),
        (0.5, 0.0),
        (0.0, -1e-20),
        (1e-9, 2.0),
        (0.0, 0.0),
        (1e-170, 1e-170),
    ):
        p = q.model(Y=a, X=b, one=0.01)
        values = p[: q.LAST] @ points
        for v in np.linspace(-1.1, 1.1, 23):
            truth = float(np.mean(values < v))
            assert q.part_below(p, v) == pytest.approx(truth, abs=4e-3)
    inside = []
    for _ in range(200):
        p = (*(rng.normal(size=q.LAST) * ([1] * 3 + [0.1] * 12)).tolist(), 0.01)
        v = rng.normal()
        found, truth = q.part_below(p, v), float(np.mean(p[: q.LAST] @ points + 0.01 < v))
        assert found <= truth + 4e-3
        inside.append(found > 0.5 * truth > 0)
    assert sum(inside) > 50


def test_integrals_where_a_model_is_small():
    """Bounds from below of the integral, close for a density that varies little."""
    rng, points = np.random.default_rng(8), grid(401)
    for _ in range(100):
        p = (*(rng.normal(size=q.LAST) * ([1] * 3 + [0.003] * 12)).tolist(), 1e-4)
        density = (1.0, *(rng.normal(size=q.LAST - 1) * 0.003).tolist(), 0.0)
        v = rng.normal()
        there = p[: q.LAST] @ points + 1e-4 < v
        truth = 4 * float(np.mean(density[: q.LAST] @ points * there))
        found = q.integral_below(density, p, v)
        assert truth - 0.25 < found <= truth + 0.02
    assert q.integral_below(density, q.model(one=1.0), 2.0) == q.integral(density)
    assert q.integral_below(density, q.model(one=1.0), 0.5) == 0


def test_areas_of_what_is_slower_than_a_speed():
    """In regions that are partly faster: the part of points, but for a little, and not more."""
    y, parts, points = Direction(SYSTEMS["paper"]), [], grid(201)
    for _kind, _, start in regions(y):
        for f in flown_from(y, start.flight, 6):
            for strobe in flown(y, f, FAST):
                V = strobe.excess[0]
                slow = strobe.excess[: q.LAST] @ points < V
                truth = 4 * np.mean(slow * (start.density[: q.LAST] @ points))
                found = q.integral_below(start.density, strobe.excess, V)
                assert found < truth * 1.02
                parts.append(found / truth)
    assert len(parts) > 20
    assert np.quantile(parts, 0.75) > 0.8


def test_speeds_at_events_are_bounded():
    """At a multiple of pi next to an event, before it or after it."""
    y, compared = Direction(SYSTEMS["paper"]), 0
    corners = [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
    for _kind, _, start in regions(y):
        for f in flown_from(y, start.flight, 6):
            try:
                e = event(y, f)
                g = after(y, f, e)
            except Rejected:
                break
            for strobe in at_hit(y, f, e, len(list(flown(y, f, FAST))), FAST) if not e.p else ():
                t = (strobe.number - f.passed) * math.pi
                for a, b in corners:
                    T = e.near + value(e.d, a, b)[0]
                    if abs(T - t) < 1e-3:
                        continue
                    flight, time = (f, t) if t < T else (g, t - (g.passed - f.passed) * math.pi)
                    s = value(y.at(flight, time)[1], a, b)[0]
                    most = value(strobe.excess, a, b)[0] + strobe.excess[q.LAST] + FAST
                    assert s < most + 1e-9
                    compared += 1
    assert compared > 20


@pytest.mark.parametrize(("drag", "low", "high"), [("2/5", -0.16, -0.012), ("1/5", -0.13, -0.012)])
def test_what_is_behind_a_stop_is_not_counted(drag, low, high):
    """Of a region that hits before and after t = 0 a part would stop between."""
    y = Direction(Parameters(*map(Fraction, (1, 1, drag, -1, 1))))
    z = math.floor((1 - 0.5 / y.rest[0]) / 2 * 2**12)
    edges = ((round(q_ / UNIT / CUT) * CUT, 0, 0) for q_ in (low, high))
    f = turns(y, Region(*edges, z, 12)).flight
    e = event(y, f)
    assert not e.p
    assert e.ends[0] < 0 < e.ends[1]
    assert not list(flown(y, f, FAST))
    assert not at_hit(y, f, e, 0, FAST)
    ahead = [speed_after(y, f.ref, place) for place in np.linspace(low, high, 99)[1:-1]]
    assert min(ahead) < 0 < max(ahead)


def speed_after(y, t, p):
    """Return the least speed from the first hit until t = 0, backwards from rest; or that then."""
    A, B = -math.sin(t), p + math.cos(t)
    kind, T = next_event(y.a, math.pi - y.theta[0], A, B, t, t)
    s = speed_at(T, y.a, A, t)
    assert kind == HIT
    times = np.linspace(min(T, 0.0), 0.0, 50)
    return min(s - (np.sin(times) - math.sin(T)) + y.a * (times - T)) if T < 0 else s


def test_flights_of_a_tree():
    """They are counted without its regions, and four more for each leaf; parts forwards as 36."""
    tree = written([1, 2, 0, 0, 0, 5, 0, 12])
    assert flights(tree) == (3 + 4) + (10 + 4)
    y = Direction(SYSTEMS["paper"])
    assert [leaf.flights for leaf in leaves(tree, all_stops(y))] == [3, 10]
    assert flights(written([1, 12, 1, 3, 3, 0]), parted=True) == 14 + 2 * 36
