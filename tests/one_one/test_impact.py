"""The closed form of the orbits with one hit of each wall, against orbits followed in mpmath."""

import math
from fractions import Fraction

import pytest
import reference
from mpmath import mp, mpf, workdps
from reference import System, Turns
from support import holds, number, rounds, seeded

from cap.flow.itinerary import itinerary
from cap.one_one.closed_form import asymmetric, symmetric
from cap.parameters import Parameters
from cap.sets import interval, matrix
from cap.sets.interval import Ball

BITS = 260
EXACT = 1e-40


def ball(q):
    """Return a ball that contains a rational."""
    return interval.ball(Fraction(q))


def middle(x):
    """Return the middle of a ball in mpmath."""
    return number(interval.midpoint(x))


def system(orbit, F=1, omega=1, l=-1):
    """Return the oscillator in mpmath that has an orbit of this ρ and α."""
    F, w, l = mpf(F), mpf(omega), mpf(l)
    return System(F, w, F * middle(orbit.alpha), l, l + middle(orbit.rho) * F / w**2)


def first_hit(orbit):
    """Return ωt1 in [0, 2π)."""
    (sin, cos), _ = orbit.phases
    return mp.atan2(middle(sin), middle(cos)) % (2 * mp.pi)


def state(orbit, s):
    """Return (x, v) of the orbit at t = 0, followed from its hit of the right wall."""
    u1, _ = orbit.speeds
    start = first_hit(orbit) / s.w
    return reference.flow(s, s.r, -middle(u1) * s.F / s.w, start=start, end=s.T).end


def check(orbit, s, error=EXACT):
    """Check hits, speeds, least speed, period and trace of a genuine orbit; all that is claimed."""
    x, v = state(orbit, s)
    path = reference.flow(s, x, v)
    speed = s.F / s.w
    for ours, theirs in zip((x, v), path.end, strict=True):
        assert abs(ours - theirs) < error
    t1 = first_hit(orbit) / s.w
    d1, _ = orbit.durations
    t2 = (t1 + middle(d1) / s.w) % s.T
    hits = sorted([(t1, orbit.speeds[0]), (t2, orbit.speeds[1])], key=lambda pair: pair[0])
    assert len(path.hits) == 2
    for (time, u), hit, before in zip(hits, path.hits, path.velocities, strict=True):
        assert abs(time - hit) < error
        assert abs(middle(u) * speed - abs(before)) < error
    (a, _), (_, d) = reference.jacobian(s, x, v)
    assert abs(a + d - middle(orbit.trace())) < 1e-22
    return path.least / speed


def pairs(count, seed):
    """Give random (δ, orbit) with positive least speed, over thin balls."""
    random, found = seeded(seed), 0
    while found < rounds(count):
        rho = Fraction(random.randint(71, 293), 100)
        delta = Fraction(random.randint(1, 150), 100) * random.choice([1, 1, Fraction(1, 100)])
        orbit = asymmetric(ball(delta), ball(rho))
        if orbit.alpha > 0.01 and all(u > 0 for u in (*orbit.slowest(), *orbit.speeds)):
            found += 1
            yield delta, orbit


@pytest.mark.slow
def test_asymmetric_orbits():
    """Random ones, and their mirror images, are T-periodic orbits with the numbers told."""
    with interval.workprec(BITS), workdps(60):
        for delta, orbit in pairs(12, 1):
            for sign in (1, -1):
                this = asymmetric(ball(sign * delta), orbit.rho)
                least = check(this, system(this))
                slow = this.slowest()[0 if sign > 0 else 1]
                assert abs(least - middle(slow)) < EXACT


def test_symmetric_orbits():
    """Both branches; the least speed is that of the local minimum, if there is one, or at hits."""
    random, found = seeded(2), {(1, True): 0, (1, False): 0, (-1, True): 0, (-1, False): 0}
    with interval.workprec(BITS), workdps(60):
        while min(found[key] for key in found if key != (1, False)) < rounds(3):
            sign = random.choice([1, -1])
            rho, alpha = Fraction(random.randint(10, 600), 100), random.randint(1, 636)
            orbit = symmetric(ball(Fraction(alpha, 1000)), ball(rho), sign)
            delay = orbit.delays()[0]
            least = orbit.slowest()[0] if delay > 0 else orbit.mean_speed
            if least > 0 and orbit.mean_speed > 0:
                found[sign, bool(delay > 0)] += 1
                assert abs(check(orbit, system(orbit)) - middle(least)) < EXACT
    assert not found[1, False]


def test_orbits_that_would_stop():
    """Where a least speed of the formula is negative the mass turns or stops on the way."""
    with interval.workprec(BITS), workdps(60):
        for orbit in (
            symmetric(ball("0.6"), ball("0.5"), 1),
            symmetric(ball("0.62"), ball("0.4"), -1),
            asymmetric(ball("0.6"), ball(2)),
            asymmetric(ball("-0.6"), ball(2)),
            asymmetric(ball("0.1"), ball("0.5")),
        ):
            ways = zip(orbit.slowest(), orbit.delays(), orbit.durations, strict=True)
            assert any(u < 0 < delay < end for u, delay, end in ways)
            s, start = system(orbit), first_hit(orbit)
            with pytest.raises(Turns):
                reference.flow(s, s.r, -middle(orbit.speeds[0]), start=start, end=start + s.T)


@pytest.mark.parametrize(("F", "omega", "l"), [(3, "1/2", 7), ("1/10", 5, "-2/3"), (40, 9, 0)])
def test_scaling(F, omega, l):
    """The formulas in units of 1/ω, F/ω² and F/ω hold for all F, ω and walls of the same ρ."""
    with interval.workprec(BITS), workdps(60):
        scales = [number(Fraction(q)) for q in (F, omega, l)]
        for delta, orbit in pairs(1, 3):
            least = check(orbit, system(orbit, *scales))
            assert abs(least - middle(orbit.slowest()[0])) < EXACT
            assert delta
        orbit = symmetric(ball("0.4"), ball("2.5"), -1)
        check(orbit, system(orbit, *scales))


def test_the_float_itinerary():
    """At the parameters of the prover: the events, periodicity and trace, by
    `cap.flow.itinerary`."""
    with interval.workprec(BITS), workdps(40):
        for delta, orbit in pairs(10, 4):
            for this in (orbit, asymmetric(ball(-delta), orbit.rho)):
                alpha, rho = (interval.midpoint(x) for x in (this.alpha, this.rho))
                p = Parameters(Fraction(1), Fraction(1), alpha, -rho / 2, rho / 2)
                t1, (u1, u2) = float(first_hit(this)), (float(u) for u in this.speeds)
                before = t1 + 0.01
                path = itinerary(p, float(p.r), -u1, before, start=t1, wall=1)
                assert not path.events
                round_trip = itinerary(p, *path.end, before + 2 * math.pi, start=before)
                assert round_trip.words == ("hit l", "hit r")
                left, right = round_trip.events
                assert left.time == pytest.approx(t1 + math.pi + 2 * float(this.delta))
                assert right.time == pytest.approx(t1 + 2 * math.pi)
                assert (left.velocity, right.velocity) == pytest.approx((-u2, u1))
                assert round_trip.end == pytest.approx(path.end)
                trace = matrix.trace(round_trip.monodromy)
                assert trace == pytest.approx(float(this.trace()), rel=1e-6, abs=1e-6)


def equations(orbit):
    """Return the defects of the three equations of `cap.one_one.closed_form`."""
    pi, delta = interval.pi(), orbit.delta + Ball(0)
    sin, cos = delta.sin_cos()
    return (
        2 * orbit.cos_phi * cos - pi * orbit.alpha,
        orbit.mean_speed * delta - pi / 2 * orbit.S * sin,
        pi * orbit.mean_speed - 2 * orbit.S * (cos + delta * sin) - orbit.rho,
        orbit.cos_phi * orbit.cos_phi + orbit.S * orbit.S - 1,
    )


def test_the_equations():
    """They hold, of both kinds; (sin, cos) of the hits are those of φ + π/2 - δ, φ + 3π/2 + δ."""
    random = seeded(5)
    with interval.workprec(BITS):
        for _ in range(rounds(20)):
            rho = ball(Fraction(random.randint(10, 290), 100))
            alpha = ball(Fraction(random.randint(1, 636), 1000))
            orbits = [symmetric(alpha, rho, sign) for sign in (1, -1)]
            orbits.append(asymmetric(ball(Fraction(random.randint(-20, 20), 100)), rho))
            for orbit in orbits:
                if not orbit.alpha.is_finite():
                    continue
                for defect in equations(orbit):
                    assert defect.contains(0)
                    assert defect.rad() < 1e-60
                phi = -orbit.S.asin()
                pi, delta = interval.pi(), orbit.delta
                times = phi + pi / 2 - delta, phi + 3 * pi / 2 + delta
                for time, pair in zip(times, orbit.phases, strict=True):
                    for one, other in zip(time.sin_cos(), pair, strict=True):
                        assert one.overlaps(other)
                        assert other.rad() < 1e-60


def test_the_mirror_pair():
    """δ and -δ: the same f and trace, the speeds and minima of the two flights exchanged."""
    with interval.workprec(BITS):
        for delta, orbit in pairs(6, 6):
            other = asymmetric(ball(-delta), orbit.rho)
            for one, two in (
                (orbit.alpha, other.alpha),
                (orbit.trace(), other.trace()),
                *zip(orbit.speeds, other.speeds[::-1], strict=True),
                *zip(orbit.slowest(), other.slowest()[::-1], strict=True),
                *zip(orbit.delays(), other.delays()[::-1], strict=True),
                *zip(orbit.durations, other.durations[::-1], strict=True),
            ):
                assert (one - two).contains(0)
                assert (one - two).rad() < 1e-60


def test_at_the_birth():
    """At δ = 0 the asymmetric orbit is the symmetric one with k = 4, and the trace is 2."""
    with interval.workprec(BITS):
        for rho in ("1/2", 1, 2, "2.9", "2.9348"):
            born = asymmetric(Ball(0), ball(rho))
            same = symmetric(born.alpha, ball(rho), 1)
            for name in ("S", "cos_phi", "mean_speed"):
                assert getattr(born, name).overlaps(getattr(same, name))
            for orbit in (born, same):
                assert (orbit.trace() - 2).contains(0)
                assert orbit.trace().rad() < 1e-50


def test_over_balls():
    """Over a range of δ the values enclose those at its points."""
    random = seeded(7)
    with interval.workprec(BITS):
        for delta, orbit in pairs(5, 7):
            radius = delta / 1000
            wide = asymmetric(interval.around(delta, radius), orbit.rho)
            inner = delta + radius * Fraction(random.randint(-9, 9), 9)
            thin = asymmetric(ball(inner), orbit.rho)
            for whole, part in (
                (wide.alpha, thin.alpha),
                (wide.trace(), thin.trace()),
                *zip(wide.slowest(), thin.slowest(), strict=True),
                *zip(wide.speeds, thin.speeds, strict=True),
            ):
                assert whole.is_finite()
                assert holds(whole, interval.midpoint(part))


def test_where_there_is_no_orbit():
    """S > 1, or α > 2/π, gives nothing finite."""
    with interval.workprec(BITS):
        for delta, rho in (("0.2", "2.9348"), ("1.5", 1), (0, 3), (0, "2.9349"), ("1/1000", 4)):
            orbit = asymmetric(ball(delta), ball(rho))
            assert not orbit.alpha.is_finite()
            assert not orbit.trace().is_finite()
            assert not any(u.is_finite() for u in orbit.slowest())
        assert not symmetric(ball("0.6367"), ball(2), 1).S.is_finite()


def test_one_pair_for_each_friction():
    """As δ grows S grows and α falls to 0, at any ρ: the claims of `cap.one_one.closed_form` on
    G."""
    with interval.workprec(BITS):
        for rho in ("1/100", "1/2", 1, 2, "2.9", "2.93"):
            before = asymmetric(Ball(0), ball(rho))
            for k in range(1, 157):
                orbit = asymmetric(ball(Fraction(k, 100)), ball(rho))
                if not orbit.alpha.is_finite():
                    assert before.alpha < 0.2
                    break
                assert orbit.S > before.S
                assert orbit.alpha < before.alpha
                before = orbit
        near = (interval.pi() ** 2 - 4) / 2 - ball(Fraction(1, 10**12))
        assert 0 < asymmetric(Ball(0), near).alpha < Ball(1) / 10**6
