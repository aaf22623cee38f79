"""Sets of launches, followed from wall to wall: motions that never stop are enclosed."""

import math
from collections import Counter
from dataclasses import replace
from fractions import Fraction

import pytest
from support import rounds, seeded
from systems import CASES

from cap.floats.engine import swarm
from cap.floats.search.orbits import from_hit_times
from cap.maps import inventory
from cap.maps.launch_set import UNIT, Constants, LaunchSet, fly, is_smooth
from cap.maps.launch_window import window
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

ALMOST = 1e-8


def found(p):
    """Return orbits whose velocity never vanishes, found in floats."""
    return [orbit for orbits in from_hit_times(p) for orbit in orbits]


def drawn(random):
    """Return α and G."""
    alpha = random.choice((Fraction(2, 5), Fraction(1, 20), Fraction(9, 10), Fraction(3, 5)))
    return alpha, Fraction(random.choice((2, 2, 1, 5)), random.choice((1, 1, 2)))


def following(p, t, u):
    """Return the next launch (t, u), folded, of one in floats; None if it stops before."""
    for event in swarm.itinerary(p, (1e-13, u), 3, t):
        if event.time > t + 1e-9:
            hits = event.word == "hit r" and event.after < 0
            return (event.time + math.pi, -event.after) if hits else None
    return None


def contains(x, value):
    """Return whether a ball contains a float, almost."""
    return float(x.lower()) - ALMOST <= value <= float(x.upper()) + ALMOST


def test_flights_are_enclosed():
    """Random boxes, several flights: hits are in the windows, launches in the sets."""
    random, seen = seeded(1), Counter()
    for _ in range(rounds(150)):
        alpha, G = drawn(random)
        p = replace(PAPER, f=alpha, l=Fraction(0), r=G)
        t, u = random.uniform(0, 6.3), random.uniform(0, 3)
        half = 10.0 ** random.uniform(-5, -0.7)
        points = [(t + a * half, max(u + b * half, 1e-9)) for a in (-1, 0.3, 1) for b in (-1, 0, 1)]
        with interval.workprec(64):
            system = Constants.of(interval.ball(alpha), interval.ball(G))
            sides = (Ball(t, half), interval.hull(Ball(max(u - half, 0)), Ball(u + half)))
            now = LaunchSet.of_box(*sides, own=True)
            cap = interval.upper(sides[0]) + 3 * system.pi
            for _ in range(3):
                hits = window(system, now, cap)
                if hits is None:
                    seen["none"] += 1
                    break
                smooth = hits.a < hits.b and is_smooth(system, now, hits)
                hits = hits if smooth else hits._replace(m=None)
                after = None if hits.b <= hits.a else fly(system, now, hits)
                images = [image and following(p, *image) for image in points]
                late = float(cap.lower())
                images = [z if z and z[0] - math.pi <= late else None for z in images]
                seen["smooth" if smooth else "stops" if after is None else "box"] += 1
                check(hits, after, images)
                if after is None:
                    break
                points, now, cap = [z for z in images if z], after, cap + system.pi
    assert min(seen["smooth"], seen["stops"], seen["box"]) > 20
    assert seen["none"] < 0.3 * sum(seen.values())


def check(hits, after, images):
    """Check the images of launches; None are those that stop, or hit too late."""
    for image in images:
        if image is not None:
            x, u = image
            assert after is not None
            assert hits.a / UNIT - ALMOST <= x - math.pi <= hits.b / UNIT + ALMOST
            assert contains(after.hull[0].x, x)
            assert contains(after.hull[1], u)


def test_derivatives():
    """Differences of images are in the derivative times those of the launches."""
    random, p = seeded(2), replace(PAPER, l=Fraction(0), r=Fraction(2))
    for _ in range(rounds(20)):
        t, u, h = random.uniform(5.5, 6.3), random.uniform(0.8, 2), 1e-4
        with interval.workprec(64):
            system = Constants.of(interval.ball(Fraction(2, 5)), Ball(2))
            now = LaunchSet.of_box(Ball(t, h), Ball(u, h), own=True)
            for _ in range(2):
                hits = window(system, now, Ball(40))
                assert is_smooth(system, now, hits)
                now = fly(system, now, hits)
            rows = [[(float(q.lower()), float(q.upper())) for q in row] for row in now.matrix]
        first, shifted = (following(p, *following(p, *z)) for z in ((t, u), (t + h, u)))
        for (low, high), a, b in zip((row[0] for row in rows), first, shifted, strict=True):
            assert low * h - ALMOST <= b - a <= high * h + ALMOST


@pytest.mark.parametrize("p", [p for p, hits in CASES if hits > 2 and p.f])
def test_orbits_with_several_hits_are_not_excluded(p):
    """A box around their slowest launch is not empty, however small."""
    orbits = [orbit for orbit in found(p) if len(orbit.hit_times) > 2]
    assert orbits
    for orbit in orbits[:3]:
        events = swarm.itinerary(p, (orbit.x, orbit.v), 1)
        hits = [event for event in events if event.word.startswith("hit")]
        slowest = min(hits, key=lambda e: abs(e.after))
        t = slowest.time * float(p.omega) + (math.pi if slowest.word == "hit r" else 0)
        u = abs(slowest.after) * float(p.omega / p.F)
        with interval.workprec(64):
            rho = p.R * p.omega**2 / p.F
            system = Constants.of(interval.ball(p.f / p.F), interval.ball(rho))
            for half in (1e-2, 1e-4, 1e-6):
                centre = LaunchSet.of_box(Ball(t % math.tau, half), Ball(u, half), own=True)
                assert inventory.proved_empty(system, centre) is None


@pytest.mark.slow
def test_bounds():
    """The orbits found in floats are slower, and have fewer hits."""
    for p, hits in CASES:
        if p.f:
            with interval.workprec(64):
                system = Constants.of(
                    interval.ball(p.f / p.F), interval.ball(p.R * p.omega**2 / p.F)
                )
                limits = inventory.bounds(system)
            assert 2 * limits.hits >= hits
            for orbit in found(p):
                assert abs(orbit.v) < float(limits.speed) * float(p.F / p.omega)
