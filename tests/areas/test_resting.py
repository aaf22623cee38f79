"""Cells of states that rest in time or fly: integrals in balls, fates beside orbits in floats."""

import math
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from support import rounds, seeded

from cap.areas.resting import fates, flights
from cap.areas.resting.fates import FLIES, RESTS, Sides, fate
from cap.areas.resting.pull import Pull, extremes, pull, sums, table
from cap.areas.resting.sweep import DEEPEST, sweep
from cap.floats.models.engine import Engine
from cap.sets import doubles, interval
from cap.sets.doubles import Interval, between, upper
from cap.system.files import read

BOX = (0.0, 2.0), (-2.0, 2.0)
A, END = Fraction(3, 10), 6.0


def exact(x):
    """Return a double as an interval."""
    return Interval(float(x), 0.0)


def pulled(mean=1.0, cos=0.0, sin=-0.3, omega=1.0, end=END):
    """Return a pull with e = 1/2; that of the ball's table, if nothing is said."""
    per = Interval(1 / omega, math.ulp(1 / omega))
    return Pull(*map(exact, (mean, cos, sin, omega)), per, exact(0.5), end, end)


def ball_of(x):
    """Return an interval as a ball."""
    return interval.around(Fraction(x.mid), Fraction(x.rad))


def test_sums_contain_the_integrals():
    """I and J, in balls by their formulas, and P, at random times for random pulls."""
    random = seeded(30)
    for _ in range(rounds(1000)):
        mean, cos, sin = (random.uniform(-2, 2) for _ in range(3))
        omega, s = random.uniform(0.1, 4), random.uniform(0, 50)
        p = pulled(mean, cos, sin, omega)
        with interval.workprec(200):
            m, c, d, w, t = (interval.ball(Fraction(x)) for x in (mean, cos, sin, omega, s))
            S, C = (w * t).sin_cos()
            first = m * t + (c * S + d * (1 - C)) / w
            second = m * t * t / 2 + (c * (1 - C) + d * (w * t - S)) / w**2
            for found, value in zip(sums(p, s), (first, second), strict=True):
                assert interval.subset(value, ball_of(found))
                assert found.rad < 1e-11
            assert interval.subset(m + c * C + d * S, ball_of(pull(p, exact(s))))


def test_the_grid_contains_the_pull():
    """Its bounds over times hold at each time between."""
    p, random = pulled(1.0, 0.4, -0.9, 1.3), seeded(31)
    grid = table(p)
    for _ in range(rounds(500)):
        a, b = sorted(random.uniform(0, END) for _ in range(2))
        low, high = extremes(grid, a, b)
        t = random.uniform(a, b)
        assert low <= 1.0 + 0.4 * math.cos(1.3 * t) - 0.9 * math.sin(1.3 * t) <= high
    assert math.isnan(extremes(grid, 1.0, 2 * END)[0])


@cache
def engine():
    """Return the float engine of the ball."""
    return Engine(read("examples/ball.py", {"A": A}))


def fallen(states):
    """Return which of the states rest before the end, and which have h > 0 then, in floats."""
    found = engine().follow(states, ["fly"] * len(states), log=200 * len(states))
    rested, last = np.full(len(states), np.inf), np.full(len(states), -np.inf)
    capture = engine().words.index("capture")
    for k, t, which, *_ in found.log:
        if which == capture:
            rested[int(k)] = min(rested[int(k)], t)
        elif t < END:
            last[int(k)] = t
    return rested < END, rested


def sides():
    """Return the rectangle BOX at t = 0, where h = y, h' = v - A."""
    (a, b), (c, d) = BOX
    below = doubles.enclosing(Fraction(c) - A)
    return Sides(exact(a), exact(b - a), below, exact(d - c))


def test_a_cell_rests_or_flies():
    """A few cells, each followed in Python."""
    p = pulled()
    grid = table(p)
    for y, v, known in (
        (0.5, 0.0, RESTS),
        (1.0, 0.4, RESTS),
        (1.8, 1.9, FLIES),
        (1.9, -1.9, FLIES),
    ):
        here = between(y, y + 0.01), between(v - 0.3, v - 0.29)
        assert fate(p, grid, *here) == known
    assert fate(p, grid, between(0.5, 1.5), between(-1.0, 1.0)) <= 0


def test_a_hit_where_the_table_falls_away():
    """The pull is below zero there; the flight in floats comes to zero in the window."""
    p = pulled(sin=-1.2)
    hit = flights.first_hit(
        p, table(p), fates._begun(between(1.926, 1.927), between(-1.56, -1.559))
    )
    assert hit.found == flights.HITS
    assert upper(hit.pull) < 0

    def h(s, y, v):
        return y + v * s - s * s / 2 - 1.2 * (math.sin(s) - s)

    for y in (1.926, 1.927):
        assert h(hit.a, y, -1.56) > 0 > h(hit.b, y, -1.559)


def test_points_beside_orbits_in_floats():
    """Of a fast table: nearly all states that rest in floats are seen to rest, and no others."""
    end = 16.0
    p = pulled(sin=-1.2, end=end)
    grid, random = table(p), seeded(33)
    states = [(random.uniform(0.01, 4), random.uniform(-4, 4)) for _ in range(rounds(60))]
    log = Engine(read("examples/ball.py", {"A": Fraction(6, 5)})).follow(
        np.array(states), ["fly"] * len(states), periods=3, log=400 * len(states)
    )
    rested = {int(k) for k, t, which, *_ in log.log if which == 2 and t < end}
    seen = set()
    for k, (y, v) in enumerate(states):
        known = fate(p, grid, between(y, y), between(v - 1.2, v - 1.2))
        assert known != (FLIES if k in rested else RESTS)
        seen |= {k} if known == RESTS else set()
    assert len(seen) > 0.9 * len(rested) > 10


def leaves(tree):
    """Give the letters of a tree with the ends of their parts."""
    waiting = [(0.0, 1.0, 0.0, 1.0)]
    for letter in tree:
        a, b, c, d = waiting.pop()
        if letter == "0":
            waiting += [((a + b) / 2, b, c, d), (a, (a + b) / 2, c, d)]
        elif letter == "1":
            waiting += [(a, b, (c + d) / 2, d), (a, b, c, (c + d) / 2)]
        else:
            yield letter, (a, b, c, d)
    assert not waiting


@pytest.mark.slow
def test_cells_beside_orbits_in_floats():
    """Of a sweep, random states of each cell rest, or fly, as the cell says; shares add up."""
    swept = sweep(pulled(), sides(), 4000)
    cells = [(letter, place) for letter, place in leaves(swept.tree) if letter != "-"]
    random, (low, high), (down, up) = seeded(32), *BOX
    states, known = [], []
    for letter, (a, b, c, d) in cells:
        for _ in range(rounds(5)):
            y, v = random.uniform(a, b), random.uniform(c, d)
            states.append((low + y * (high - low), down + v * (up - down)))
            known.append(letter == "r")
    rested, when = fallen(np.array(states))
    sure = np.abs(when - END) > 1e-6
    assert (rested == np.array(known))[sure].all()
    assert {letter for letter, _ in cells} == {"r", "f"}
    for letter, units in (("r", swept.rests), ("f", swept.flies)):
        area = sum((b - a) * (d - c) for kind, (a, b, c, d) in cells if kind == letter)
        assert area == units / 2**DEEPEST
    assert swept.rests / 2**DEEPEST > 0.55
    assert swept.flies / 2**DEEPEST > 0.1


def test_a_derivative():
    """The change of the state after a hit by the state before, beside differences."""
    p = pulled(1.0, 0.2, -0.3)
    grid = table(p)

    def image(y, v, b=None):
        cell = fates._begun(between(y, y), between(v, v))
        hit = flights.first_hit(p, grid, cell)
        found = fates.landed(p, hit, b or hit.b + 0.1)
        return np.array([x.mid for x in found]), hit

    y, v, h = 0.7, 0.2, 1e-5
    centre, hit = image(y, v)
    b = hit.b + 0.1
    wide = hit._replace(b=b)  # any window that contains the hit will do
    found = fates.change(p, wide, hit.speed, 0.0)
    columns = [(image(*at, b)[0] - centre) / h for at in ((y + h, v), (y, v + h))]
    matrix = np.array(columns).T.ravel()
    exactly = fates.change(p, hit, hit.speed, 0.0)
    for value, inside in zip(matrix, found, strict=True):
        assert abs(value - inside.mid) <= inside.rad + 1e-3
    turned = np.array([x.mid for x in exactly]).reshape(2, 2)
    later = np.array([[1, 0.1], [0, 1]]) @ turned
    assert np.allclose(later.ravel(), matrix, atol=1e-3)


def test_hits_accumulate_before_the_end():
    """A bounce that begins at the end is not over then, however short it is: a sum is rounded."""
    p = pulled()
    grid = table(p)
    assert fates._over(p, grid, 5.0, 5.5, 1e-20, 1e-19)
    assert fates._over(p, grid, 5.0, math.nextafter(END, 0), 1e-20, 1e-19)
    assert not fates._over(p, grid, 5.0, END, 1e-20, 1e-19)
    assert all(x * fates.LATER >= math.nextafter(x, 7) for x in (1e-3, 1.0, math.nextafter(2, 0)))
