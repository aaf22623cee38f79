"""The folded flow contains orbits in floats, which know nothing of folding or models."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import pytest

from cap.checker.folded.fates import half
from cap.checker.folded.flights import System
from cap.checker.folded.follow import Box, Cut, Slow, Split, follow, slowest
from cap.checker.folded.places import across
from cap.checker.folded.stops import halt
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Parameters
from cap.floats import swarm
from cap.parameters import Parameters as Given

SYSTEMS = {
    "paper": Parameters(*map(Fraction, (1, 1, "2/5", -1, 1))),
    "other": Parameters(*map(Fraction, (3, 2, "4/3", "-1/2", "3/4"))),
    "weak": Parameters(*map(Fraction, (1, 1, "1/5", -1, 1))),
}


def released(p, x, v):
    """Return the distances to the wall ahead at the first releases after sticks, in floats.

    Several: a stick just before a release is none for a box in which others do not stop.
    """
    given = Given(p.F, p.omega, p.f, p.l, p.r)
    scale = float(p.omega**2 / p.F)
    first = (math.pi - math.acos(p.f / p.F)) / 2 / math.pi - 1e-9  # to the left
    found, gaps = swarm.follow(given, [(x, v)], first), []
    for n in range(24):
        place, speed = found.states[0]
        if speed == 0:
            gaps.append(scale * (float(p.r) - place if n % 2 else place - float(p.l)))
        t0 = (first + n / 2) * 2 * math.pi / float(p.omega)
        found = swarm.follow(given, found.states, 0.5, t0)
    return gaps


def ends_at(part, x, y):
    """Give the models of the release at a point, with where it is; None for what is not known."""
    end = part.end
    if isinstance(end, Cut):
        z = (x, y)[end.along]
        inner = 2 * z + (1 if z < 0 else -1)
        return ends_at(
            end.lower if z < 0 else end.upper, *((x, inner) if end.along else (inner, y))
        )
    if isinstance(end, Split):
        level = value(end.level, x, y)
        if abs(level) <= end.level[6]:
            return None
        if level < 0:
            return ends_at(end.below, x, y)
        return None if isinstance(end.above, Slow) else ends_at(end.above, x, y)
    return None if end is None else (end, x, y)


def value(p, x, y):
    """Return the polynomial of a model."""
    return p[0] + p[1] * x + p[2] * y + p[3] * x * x + p[4] * x * y + p[5] * y * y


@pytest.mark.parametrize("name", SYSTEMS)
def test_releases_of_orbits_in_floats(name):
    """Many orbits through hits, turns, sticks, captures, from boxes of several sizes."""
    p, compared = SYSTEMS[name], 0
    rng = random.Random(5)  # noqa: S311
    y, length, speed = System(p), float(p.omega**2 / p.F), float(p.omega / p.F)
    for n in range(60):
        size = (0.03, 0.01, 0.001)[n % 3] * float(p.r - p.l)
        x, v = rng.uniform(float(p.l), float(p.r) - size), rng.uniform(-1.5, 1.5)
        if v < 0 < v + size:
            continue
        left = v < 0
        X = across(((x - float(p.l)) * length, (x + size - float(p.l)) * length), 0)
        V = across((v * speed, (v + size) * speed), 1)
        ahead = q.scaled(X, -1.0) if left else q.moved(X, -y.width[0], y.width[1])
        f = y.launched(ahead, q.scaled(V, -1.0) if left else V, left)
        seen = follow(y, f, Box(4))
        for _ in range(4):
            a, b = rng.uniform(-1, 1), rng.uniform(-1, 1)
            found = ends_at(seen, a, b)
            if found is None:
                continue
            gaps = released(p, x + size * (a + 1) / 2, v + size * (b + 1) / 2)
            model, s, t = found
            assert min(abs(value(model, s, t) - gap) for gap in gaps[:4]) <= model[6] + 1e-7
            compared += 1
    assert compared > 40


def test_slow_hits_are_told_by_their_level():
    """Speeds between the bounds that the level gives, and never more than the largest."""
    slow = Slow(0.5, 2.0, 0.3, None)
    assert slowest(slow, (-1.0, 0.01)) == pytest.approx((0, math.sqrt(0.04)))
    assert slowest(slow, (0.01, 1.0)) == pytest.approx((math.sqrt(0.01), 0.3))


def test_halves_of_what_is_seen():
    """The halves of a box, cut or not, have what is seen of the box."""
    y = System(SYSTEMS["paper"])
    p = across((0.5, 0.6), 0)
    for cuts in (0, 3):
        seen = follow(y, y.rest(q.scaled(p, -1.0)), Box(cuts))
        for x in (-0.9, -0.3, 0.4, 0.8):
            whole, side = ends_at(seen, x, 0.0), 1.0 if x > 0 else -1.0
            part = ends_at(half(seen, 0, side), 2 * x - side, 0.0)
            if whole and part:
                assert value(*whole) == pytest.approx(value(*part), abs=1e-12)


def test_a_stop_is_not_before_the_start():
    """A zero of s in an arc is a stop only if all flights begin before the end of the arc."""
    y = System(SYSTEMS["paper"])
    theta = y.theta[0]
    T = -theta - 0.2
    models = q.constant(y.a * T - math.sin(T)), q.constant(-3.0)
    early = y.fresh((-theta - 0.3, -theta - 0.29), 0.0, *models)
    assert halt(y, early, T, 0).ends == pytest.approx((T, T))
    for last in (-theta, -theta + 0.1):
        with pytest.raises(Rejected, match="begin after the arc"):
            halt(y, early._replace(begun=(-theta - 0.3, last)), T, 0)


def test_without_friction_there_is_no_folded_flow():
    """And none with losses."""
    p = SYSTEMS["paper"]
    for other in (
        p._replace(f=Fraction(0)),
        p._replace(mu=Fraction(1)),
        p._replace(e=Fraction(1, 2)),
    ):
        with pytest.raises(Rejected, match="needs f > 0"):
            System(other)
