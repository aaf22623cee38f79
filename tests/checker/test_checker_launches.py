"""The checker's sets of launches: single motions are in them, and each condition is needed."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from support import rounds, seeded
from systems import CASES

from cap.checker.flow import launches
from cap.checker.flow.launches import Window, phase
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.floats.engine import swarm
from cap.floats.search.orbits import from_hit_times
from cap.maps.launch_set import UNIT, Constants, LaunchSet, fly
from cap.maps.launch_window import window
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 80
ALMOST = 1e-9


def exactly(a, b=None):
    """Return an interval."""
    return Interval.enclosing(Fraction(a), Fraction(a if b is None else b), BITS)


def gap_of(alpha, rho):
    """Return a gap, of decimals."""
    return launches.Gap(exactly(Fraction(str(alpha))), exactly(Fraction(str(rho))))


def speed(alpha, t, u, x):
    """Return w in floats."""
    return u + math.sin(x) - math.sin(t) - alpha * (x - t)


def way(alpha, t, u, x):
    """Return y in floats."""
    return (u - math.sin(t)) * (x - t) - math.cos(x) + math.cos(t) - alpha * (x - t) ** 2 / 2


def root(g, low, high):
    """Return where a function changes its sign."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (g(middle) > 0) == (g(low) > 0) else (low, middle)
    return low


def hit(alpha, rho, t, u):
    """Return the next launch, folded, of a launch that hits within 2."""
    x = root(lambda x: way(alpha, t, u, x) - rho, t, t + 2)
    return x + math.pi, speed(alpha, t, u, x)


def holds(x, value):
    """Return whether an interval contains a float, almost."""
    return float(x.lower) - ALMOST <= value <= float(x.upper) + ALMOST


def test_values_and_maps():
    """Corners of boxes: ways and speeds, images, ways and speeds after these; and all is sharp."""
    random, alpha, rho = seeded(1), 0.4, 2
    gap = gap_of(alpha, rho)
    for _ in range(rounds(30)):
        t, u, half = (
            random.uniform(5.6, 6.2),
            random.uniform(2.2, 2.8),
            10 ** random.uniform(-4, -2),
        )
        n = launches.box(exactly(t - half, t + half), exactly(u - half, u + half), first=True)
        points = [(t + a * half, u + b * half) for a in (-1, 1) for b in (-1, 1)]
        for _ in range(2):
            check_values(gap, n, points, alpha)
            images = [hit(alpha, rho, *z) for z in points]
            times = [x - math.pi for x, _ in images]
            far = max(times) - min(times) + half
            ends = min(times) - far, max(times) + far, sum(times) / 4
            n = launches.flown(gap, n, Window(*(phase(exactly(x)) for x in ends)))
            for x, w in images:
                assert holds(n.all_t.x, x)
                assert holds(n.all_u, w)
            for side, k in ((n.all_t.x, 0), (n.all_u, 1)):
                values = [z[k] for z in images]
                width = max(values) - min(values)
                assert float(side.upper - side.lower) < 1.6 * width + 400 * half**2 + ALMOST
            points = images


def check_values(gap, n, points, alpha):
    """Check ways and speeds at some phase."""
    x = float(n.all_t.x.upper) + 0.7
    y, w = launches.way(gap, n, phase(exactly(x))), launches.speed(gap, n, phase(exactly(x)))
    for t, u in points:
        assert holds(y[1], way(alpha, t, u, x))
        assert holds(w[1], speed(alpha, t, u, x))


def falling_back(alpha, t, u):
    """Return a gap that a launch just reaches, and when its speed vanishes."""
    stop = root(lambda x: speed(alpha, t, u, x), t + 0.5, 2 * math.pi - math.acos(alpha))
    return way(alpha, t, u, stop) - 1e-3, stop


@pytest.mark.parametrize("later", [0.3, 0.8])
def test_a_hit_that_the_formula_forgets(later):
    """It hits before a, and by the formula comes back: before the next slow phase, or after."""
    alpha, t, u = 0.4, 2.6, 1.35
    rho, stop = falling_back(alpha, t, u)
    slow = 2 * math.pi - math.acos(alpha)
    a = stop + 0.2 if later < 0.5 else slow + 0.1
    assert way(alpha, t, u, a) < rho
    assert t < stop < slow
    assert (a > slow) == (later > 0.5)
    gap, n = gap_of(alpha, rho), launches.box(exactly(t), exactly(u), first=True)
    assert launches.none_before(gap, n, phase(exactly(stop - 0.2)))
    assert not launches.none_before(gap, n, phase(exactly(a)))


def test_some_may_hit_before():
    """Not said of a box if one of its launches hits before."""
    gap, t = gap_of(0.4, 2), exactly(Fraction("5.9"))
    n = launches.box(t, exactly(1, 2), first=True)
    early, late = (phase(exactly(Fraction(x))) for x in ("6.5", "7.1"))
    assert launches.none_before(gap, n, early)
    assert way(0.4, 5.9, 1, 7.1) < 2 < way(0.4, 5.9, 2, 7.1)
    assert not launches.none_before(gap, n, late)


@pytest.mark.parametrize("p", [p for p, hits in CASES if hits > 2])
def test_orbits_with_several_hits(p):
    """No windows prove that a box around their slowest launch is empty: they close."""
    found = [orbit for orbits in from_hit_times(p) for orbit in orbits]
    orbit = next(orbit for orbit in found if len(orbit.hit_times) > 2)
    hits = [e for e in swarm.itinerary(p, (orbit.x, orbit.v), 1) if e.word.startswith("hit")]
    slowest = min(hits, key=lambda e: abs(e.after))
    t = (slowest.time * float(p.omega) + math.pi * (slowest.word == "hit r")) % math.tau
    u, half = abs(slowest.after) * float(p.omega / p.F), 1e-5
    alpha, rho = p.f / p.F, p.R * p.omega**2 / p.F
    windows = []
    with interval.workprec(64):
        system = Constants.of(interval.ball(alpha), interval.ball(rho))
        now = LaunchSet.of_box(Ball(t, half), Ball(u, half), own=True)
        for k in range(len(hits) + 2):
            windows.append(window(system, now, Ball(t + math.pi * (k + 3))))
            now = fly(system, now, windows[-1])
    gap = launches.Gap(exactly(alpha), exactly(rho))
    sides = exactly(t - half, t + half), exactly(u - half, u + half)
    told = [Window(*(phase(exactly(Fraction(k, UNIT))) for k in each)) for each in windows]
    with pytest.raises(Rejected, match="may close"):
        launches.empty(gap, *sides, told)


def test_fall_that_ends_at_a():
    """At a slow phase itself nothing is said."""
    gap = gap_of(0.4, 2)
    n, at = launches.box(exactly(5), exactly(1), first=True), gap.slow(1).x
    with pytest.raises(Rejected, match="may end"):
        launches.none_before(gap, n, phase(at))


def test_over():
    """Not if some launch comes later, or some neither hits nor stops."""
    gap = gap_of(0.4, 2)
    later = launches.box(exactly(Fraction("5.8"), 6), exactly(0, Fraction("0.05")), first=True)
    b = phase(exactly(Fraction("5.5")))
    assert launches.speed(gap, later, b)[1].hi < 0
    assert not launches.over(gap, later, b)
    t, b = exactly(Fraction("2.6")), phase(exactly(Fraction("3.2")))
    for u, ends in (("0.2", True), ("4", True), ("1.2", False), ("0.2 1.5", False), ("3 5", False)):
        low, *high = map(Fraction, u.split())
        n = launches.box(t, exactly(low, *high), first=True)
        assert launches.over(gap, n, b) is ends, u


def test_smooth_only_if_all_hit():
    """A window that tells so is refused where some do not reach the wall, or w may vanish."""
    gap, t = gap_of(0.4, 2), exactly(Fraction("5.9"))
    n = launches.box(t, exactly(Fraction("1.4"), Fraction("1.6")), first=True)
    early = Window(*(phase(exactly(Fraction(x))) for x in ("6.5", "6.9", "6.8")))
    with pytest.raises(Rejected, match="not all may hit"):
        launches.flown(gap, n, early)
    gap = gap_of(0.1, 2)  # here the formula comes back, and arrives in the end
    slow = launches.box(exactly(Fraction("2.6")), exactly(Fraction("1.3")), first=True)
    wide = Window(*(phase(exactly(Fraction(x))) for x in ("3", "8", "6")))
    with pytest.raises(Rejected, match="transverse"):
        launches.flown(gap, slow, wide)
    found = launches.flown(gap, slow, wide._replace(m=None))
    assert found.all_u.lo == 0 < found.all_u.hi
    assert not found.first


def test_too_late_is_a_period():
    """A flight that takes more than half a period is not too late."""
    gap = gap_of(0.1, 8)
    t, u = exactly(5), exactly(1)
    b = phase(exactly(Fraction("8.8")))
    with pytest.raises(Rejected, match="after its window"):
        launches.empty(gap, t, u, [Window(b, b, None)])


def test_excluded():
    """A linear map with its zero in the box, or not."""
    reach = exactly(Fraction(1, 10)), exactly(Fraction(1, 5))
    J = (exactly(2, Fraction("2.01")), exactly(1)), (exactly(-1), exactly(3, Fraction("3.01")))

    def at(x, y):
        return exactly(Fraction(-(2 * x + y))), exactly(Fraction(x - 3 * y))

    vague = (exactly(-1, 3), exactly(0)), (exactly(0), exactly(-1, 3))
    assert not launches.excluded(vague, (exactly(0), exactly(0)), reach)
    for x, y, out in (
        ("0.09", "0.19", False),
        ("-0.09", "-0.19", False),
        ("0.12", "0", True),
        ("-0.12", "0", True),
        ("0", "0.22", True),
        ("0", "-0.22", True),
    ):
        assert launches.excluded(J, at(Fraction(x), Fraction(y)), reach) is out, (x, y)
    singular = (exactly(1), exactly(1)), (exactly(1), exactly(1))
    assert not launches.excluded(singular, (exactly(5), exactly(5)), reach)


def test_no_flight_left():
    """Windows that prove nothing are not enough."""
    gap, t, u = gap_of(0.4, 2), exactly(Fraction("5.9")), exactly(Fraction("1.5"))
    with pytest.raises(Rejected, match="not proved"):
        launches.empty(gap, t, u, [])
