"""Turns forwards: what is bounded is what orbits in floats do, where sets of places are combs."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from cap.areas.folded.next_event import HIT, NOTHING, next_event, place_at, speed_at
from cap.checker.attracting.segment import Strip
from cap.checker.folded import ahead, slopes
from cap.checker.folded.ahead import (
    FATES,
    PARTS,
    Outlook,
    at_wall,
    found,
    over,
    over_places,
)
from cap.checker.folded.basins import Basins, Row, bounds_of
from cap.checker.folded.events import after, event
from cap.checker.folded.motion import Direction
from cap.checker.folded.regions import UNIT, leaves
from cap.checker.folded.stops import all_stops, along, turns
from cap.checker.folded.table import ATTRACTOR, SEGMENT
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.rejection import Rejected
from checker.mixed_small import even, parted
from checker.test_checker_stops import SYSTEMS, value

NOWHERE = Basins()
SLOW = 1e-3  # hits in floats that are taken to end in a rest


class Comb:
    """Places x without a fate: x/width modulo 1 in [0, part)."""

    def __init__(self, width, part):
        self.width, self.part = width, part

    def before(self, x):
        """Return how much of [0, x] has none, for x of both signs."""
        n = math.floor(x / self.width)
        return self.width * (n * self.part + min(x / self.width - n, self.part))

    def missing(self, ends, _fate):
        """Return how much of an interval has none."""
        return self.before(ends[1]) - self.before(ends[0])

    def holds(self, x):
        """Return whether a place has none."""
        return x / self.width % 1 < self.part

    def fate(self, _ends):
        """Return that no interval has a fate."""
        return 0


def outlook(p, fates, basins=NOWHERE):
    """Return what is ahead, with these fates of places."""
    return Outlook(Direction(p, forwards=True), fates, basins)


def parts(p, halvings, cuts, step):
    """Give regions of turns."""
    tree = even(halvings, cuts, 1)
    for n, leaf in enumerate(leaves(tree, all_stops(Direction(p)))):
        if n % step == step // 2:
            yield leaf.region


def point(y, region, x, z):
    """Return the place and the time of a turn, forwards."""
    middle, half = along(region)
    low, high = (UNIT * sum(e * z**k for k, e in enumerate(edge)) for edge in region[:2])
    return (low + high) / 2 + x * (high - low) / 2, -y.rest[0] * (middle + half * z)


def release(y, place, time):
    """Return the distance to the wall ahead after the next stick, or NaN after a slow hit."""
    W, p, s, t = y.width[0], place, 0.0, time
    for _ in range(40):
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(y.a, math.pi - y.theta[0], A, B, t, t)
        if kind == NOTHING:
            return math.nan
        s, p = speed_at(T, y.a, A, t), place_at(T, y.a, A, B, t)
        if kind == HIT:
            if s < SLOW:
                return math.nan
            p = -W
        elif math.cos(T) > y.a:
            return W + p if math.sin(T) > 0 else -p
        else:
            p, s = -W - p, 0.0
        t = (T + math.pi) % (2 * math.pi)
    return math.nan


def sampled(y, region, rng, count=60):
    """Give places of releases, nearly evenly from the area of a region."""
    for _ in range(count):
        x, z = rng.uniform(-1, 1, 2)
        yield (x, z), release(y, *point(y, region, x, z))


@pytest.mark.parametrize("name", SYSTEMS)
def test_no_more_is_lost_than_is_said(name):
    """For combs of places, fine and coarse; and for most regions, not much less."""
    p, rng, close = SYSTEMS[name], np.random.default_rng(4), []
    y = Direction(p, forwards=True)
    for width in (0.3, 3e-3):
        comb = Comb(width, 0.3)
        o = outlook(p, comb)
        for region in parts(p, 5, 6, 23):
            area, missing = found(o, region)
            if not missing[0] < area:
                continue
            density = turns(y, region).density
            bad = total = 0.0
            for (x, z), place in sampled(y, region, rng):
                weight = value(density, x, z)[0]
                assert not math.isnan(place)
                bad, total = bad + weight * comb.holds(place), total + weight
            assert bad / total < missing[0] / area + 0.25
            close.append((bad / total, missing[0] / area))
    truth, said = np.mean(close, axis=0)
    assert len(close) > 12
    assert truth * 0.95 < said < 2 * truth


def test_all_places_are_within_the_bounds():
    """Of each region, if all its orbits stick and none was at a border before."""
    p, rng, compared = SYSTEMS["paper"], np.random.default_rng(5), 0
    seen = []

    class Seen(Comb):
        """Places of which it is noted where they are looked for."""

        def missing(self, ends, _fate):
            """Note an interval."""
            seen.append(ends)
            return 0.0

    o = outlook(p, Seen(1.0, 1.0))
    for region in parts(p, 6, 6, 37):
        seen.clear()
        if found(o, region).missing[0] > 0 or not seen:
            continue
        for _, x in sampled(o.y, region, rng, 20):
            assert any(low - 1e-9 < x < high + 1e-9 for low, high in seen)
            compared += 1
    assert compared > 500


@pytest.mark.parametrize("name", SYSTEMS)
def test_derivatives_are_those_of_orbits(name):
    """By the place of the start, of A and B after each event: as differences in floats."""
    p, rng, compared = SYSTEMS[name], np.random.default_rng(6), 0
    y = Direction(p, forwards=True)
    for region in parts(p, 5, 5, 31):
        f, g = turns(y, region).flight, slopes.BEGIN
        x, z = rng.uniform(-0.9, 0.9, 2)
        place, time = point(y, region, x, z)
        one, other = states(y, place - 1e-6, time), states(y, place + 1e-6, time)
        for _ in range(5):
            try:
                e = event(y, f)
                if e.p and q.ends(e.cos)[1] > y.a - 1e-3:
                    break
                g, f = slopes.after(y, g, e), after(y, f, e)
            except Rejected:
                break
            s, q_ = next(one), next(other)
            low, high = (on(each, f.ref, y.a) for each in (s, q_))
            for model, a, b in zip(g, low, high, strict=True):
                assert abs(value(model, x, z)[0] - (b - a) / 2e-6) < model[q.LAST] + 2e-3
            compared += 1
    assert compared > 30


def states(y, p, t):
    """Give the places, speeds and times after the events of an orbit from rest."""
    W, s = y.width[0], 0.0
    while True:
        A, B = s - math.sin(t), p + math.cos(t)
        kind, T = next_event(y.a, math.pi - y.theta[0], A, B, t, t)
        s, p = speed_at(T, y.a, A, t), place_at(T, y.a, A, B, t)
        p, s = (-W, s) if kind == HIT else (-W - p, 0.0)
        t = (T + 2 * math.pi) % (2 * math.pi) - math.pi
        yield p, s, t


def on(state, ref, a):
    """Return A and B of the flight with a state, for this ref."""
    p, s, t = state
    t += 2 * math.pi * round((ref - t) / 2 / math.pi)
    A = s - math.sin(t) - a * (t - ref)
    return A, p + math.cos(t) - a * (t - ref) ** 2 / 2 - A * (t - ref)


def test_what_rests_at_the_wall():
    """All of it has the fate of places next to the wall behind, or nothing is known."""

    class Wall(Comb):
        """Places next to the wall behind go to the segment."""

        def fate(self, ends):
            """Return that fate, if all are there."""
            return SEGMENT if ends[0] > 1.999 else 0

    p = SYSTEMS["paper"]
    assert at_wall(outlook(p, Wall(1.0, 0.0)), 0.0005) == [math.inf, 0.0, 0.0]
    assert at_wall(outlook(p, Wall(1.0, 0.0)), 0.005) == [math.inf] * 3
    assert at_wall(outlook(p, Comb(1.0, 0.0)), 0.0) == [math.inf] * 3


def test_slow_hits(monkeypatch):
    """Whatever is said to rest at the wall is not followed any further."""
    p = SYSTEMS["paper"]
    o = outlook(p, Comb(1.0, 0.0))
    known = [(part, found(o, part).missing) for part in parts(p, 5, 5, 41)]
    monkeypatch.setattr(ahead, "height", lambda _y, _ends, _speed: 0.0)
    now = [found(o, part).missing for part, missing in known if missing[0] == 0]
    assert 0 < now.count((math.inf,) * 3) < len(now)


def test_a_delayed_stick():
    """What turns just before the arc of sticks ends near its place, as is said of z."""
    p = SYSTEMS["paper"]
    y = Direction(p, forwards=True)
    W, b = y.width[0], math.pi + y.rest[0]
    for z in (0.04, 0.02, 0.005):
        place, T = -0.7, b - z
        x = release(y, -W - place, (T + math.pi) % (2 * math.pi))  # folded after the turn
        assert 0.7 < x < 0.7 + z**3


def test_models_in_a_strip():
    """All states are in it, or not: in each direction."""
    rows = Row(1.0, 0.0, -1.5, -0.5), Row(0.0, 1.0, 0.2, 0.4), Row(1.0, 2.0, -0.9, 0.1)
    strip = Strip(rows)
    p, s = q.model(one=-1.0, X=0.1), q.model(one=0.3, Y=0.05)
    assert strip.contains(bounds_of(q, p, s))
    for wrong in (
        (q.model(one=-1.0, X=0.6), s),
        (p, q.model(one=0.3, Y=0.2)),
        (p, q.model(0.2, one=0.3)),
        (q.model(one=-0.55), q.model(one=0.35, Y=0.01)),
        (q.model(one=-1.45), q.model(one=0.25, Y=0.01)),
    ):
        assert not strip.contains(bounds_of(q, *wrong))


def test_models_over_parts():
    """Bounds over parts of Y contain all values there."""
    rng = np.random.default_rng(8)
    for _ in range(50):
        x = (*(rng.normal(size=q.LAST) * 0.3).tolist(), 0.01)
        for k, (low, high) in enumerate(over(x)):
            for _ in range(10):
                at = value(x, rng.uniform(-1, 1), (2 * (k + rng.random()) / PARTS) - 1)[0]
                assert low <= at - 0.01
                assert at + 0.01 <= high


def test_nothing_is_lost_over_no_places():
    """Else it is infinite, if places may not be one-to-one."""
    assert over_places(0.0, -1.0) == 0
    assert over_places(0.1, -1.0) == math.inf
    assert over_places(0.1, 0.0) == math.inf
    assert over_places(0.1, 0.5) == pytest.approx(0.2 * 2 / PARTS)


def test_fates_are_three():
    """In the order of the shares."""
    assert FATES == (ATTRACTOR, SEGMENT, ATTRACTOR | SEGMENT)


def test_trees_of_parts():
    """After each region that is followed back comes the tree of its parts."""
    y = Direction(SYSTEMS["paper"])
    tree = parted(1, 1, 5, (1, 0))
    found_ = list(leaves(tree, all_stops(y), parted=True))
    assert [len(leaf.parts) for leaf in found_] == [2] * 4
    assert all(leaf.flights == 5 for leaf in found_)
    assert all(leaf.region.halves() == leaf.parts for leaf in found_)
    one = Fraction(sum(q.integral(turns(y, leaf.region).density) for leaf in found_))
    many = sum(q.integral(turns(y, part).density) for leaf in found_ for part in leaf.parts)
    assert float(one) == pytest.approx(many, rel=1e-3)
