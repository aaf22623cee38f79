"""The certified flow through hits, turns, sticks, captures and releases: what it encloses."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import oracle_flow
import pytest
from flows import (
    BITS,
    MIXED,
    agree,
    certified,
    exactly,
    moment,
    point_orbit,
    starting,
)
from mpmath import workdps
from support import between, holds, inside, rational, rounds, seeded, width

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.itinerary import itinerary
from cap.flow.model import Constants
from cap.flow.strobe import State, follow, of_constants, oscillator, strobe
from cap.flow.windows import windows_for
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.sets.interval import Ball

NAMES = pytest.mark.parametrize("name", MIXED)
KINDS = pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
SIDES = {"r": "right", "l": "left"}
MIRROR = {"r": "l", "l": "r", "right": "left", "left": "right"}


def mirrored(word):
    """Return the word of the mirror image of an event."""
    verb, _, side = word.partition(" ")
    return f"{verb} {MIRROR[side]}" if side else verb


def quantities(orbit, bound):
    """Return all that an orbit encloses, as balls."""
    captured = [e for e in orbit.events if e.word.startswith("capture")]
    events = [q for e in orbit.events if e not in captured for q in (e.time, e.velocity, e.cos)]
    return [bound(q + Ball(0)) for q in (*events, *orbit.end, *sum(orbit.monodromy, ()))]


def over_sets(constants, state, start, end, events):
    """Return the windows and the orbit of one state for all oscillators with these constants."""
    osc = of_constants(constants)

    def attempt(itinerary):
        return follow(osc, starting(osc, state, start), itinerary, moment(osc, end), BALLS)

    return windows_for(attempt, events, BALLS.bound)


def encloses(coarse, fine):
    """Check that balls contain finer ones, up to the 400 bits of these."""
    for ball, value in zip(coarse, fine, strict=True):
        assert holds(ball, interval.midpoint(value), Fraction(1, 10**90))
        assert width(value) < 1e-85


@NAMES
@KINDS
@pytest.mark.parametrize("radius", ["0", "1e-9", "1e-4"])
def test_containment(name, kind, radius):
    """Random states of the box and its corners: in floats, and to 100 digits, all is enclosed."""
    p, x, v, start, end = MIXED[name]
    x, v, r, random = Fraction(x), Fraction(v), Fraction(radius), seeded(name + radius)
    with interval.workprec(BITS):
        try:
            _, events, orbit = certified(p, (x, v), end, start=start, radius=r, kind=kind)
        except NotProved:
            assert r == Fraction("1e-4")
            assert kind is BALLS or name == "long before"
            return
        corner = x + random.choice([-r, r]), v + random.choice([-r, r])
        for state in [corner] + [(inside(random, x, r), inside(random, v, r))] * rounds(1):
            times = map(float, (*state, Fraction(end)))
            agree(orbit, itinerary(p, *times, start=float(start)), Fraction(1, 10**8), kind)
            fine = exactly(p, state, start, end, events)
            with interval.workprec(400):
                encloses(quantities(orbit, kind.bound), quantities(fine, BALLS.bound))
        assert r or max(map(width, quantities(orbit, kind.bound))) < 1e-15


@NAMES
def test_against_the_oracle(name):
    """A random state of a box, by the flow in mpmath: its events, its end, its accumulated hits."""
    p, x, v, start, end = MIXED[name]
    x, v, r, random = Fraction(x), Fraction(v), Fraction(1, 10**9), seeded(name)
    with interval.workprec(BITS), workdps(28):
        state = inside(random, x, r), inside(random, v, r)
        exact, last = oracle_flow.orbit(p, start, *state, Fraction(end))
        for kind in (BALLS, TAYLOR_MODELS):
            _, _, orbit = certified(p, (x, v), end, start=start, radius=r, kind=kind)
            left = iter(exact)
            for event in orbit.events:
                true, captured = next(left), event.word.startswith("capture")
                while captured and true.word != event.word:
                    assert true.word in (f"turn {SIDES[event.word[-1]]}", f"hit {event.word[-1]}")
                    true = next(left)
                assert true.word == event.word
                error = Fraction(1, 10**12 if captured else 10**22)
                assert holds(kind.bound(event.time), rational(true.time), error)
                assert captured or holds(kind.bound(event.velocity), true.before, error)
            assert next(left, None) is None
            for ball, value in zip(orbit.end, last, strict=True):
                assert holds(kind.bound(ball), value, Fraction(1, 10**22))


@NAMES
def test_monodromy_against_divided_differences(name):
    """To 25 digits, through every kind of event; its rank is what sticking and captures leave."""
    p, (x, v), start, end, events = point_orbit(name)
    matrix, h = exactly(p, (x, v), start, end, events).monodromy, Fraction(1, 10**30)
    with interval.workprec(400):
        for j, (dx, dv) in enumerate(((h, 0), (0, h))):
            plus = exactly(p, (x + dx, v + dv), start, end, events).end
            minus = exactly(p, (x - dx, v - dv), start, end, events).end
            for i in (0, 1):
                quotient = interval.midpoint((plus[i] - minus[i]) / interval.ball(2 * h))
                assert holds(matrix[i][j] + Ball(0), quotient, Fraction(1, 10**25))
        determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0]
        words = {event.word.split()[0] for event in events}
        if words & {"stick", "capture"}:
            assert (determinant + Ball(0)).is_zero() or determinant.contains(0)
        elif p.conserves and words == {"hit"}:
            assert holds(determinant, 1)
        else:
            hits = sum(event.word.startswith("hit") for event in events)
            factors = [
                interval.ball(p.e) ** (2 * hits),
                (-interval.ball(p.mu * (end - start))).exp(),
            ]
            for event in exactly(p, (x, v), start, end, events).events:
                if event.word.startswith("turn"):
                    pull = abs(interval.ball(p.F) * event.cos)
                    factors.append((pull - interval.ball(p.f)) / (pull + interval.ball(p.f)))
            product = Ball(1)
            for factor in factors:
                product = product * factor
            assert determinant.overlaps(product)
            assert width(determinant) < 1e-60


@NAMES
def test_semigroup(name):
    """To some time, and from there on, is the same as at once: splits between all events."""
    p, state, start, end, events = point_orbit(name)
    whole = exactly(p, state, start, end, events)
    times = [start, *(interval.midpoint(event.window) for event in events), end]
    with interval.workprec(400):
        osc = oscillator(p)
        for k in range(len(times) - 1):
            split = (times[k] + 2 * times[k + 1]) / 3
            if k < len(events) and events[k].word.startswith("capture"):
                continue  # its window may be cut by the split
            first = follow(osc, starting(osc, state, start), events[:k], moment(osc, split), BALLS)
            resting = (first.end[1] + Ball(0)).is_zero()
            walls = [e.word for e in events[:k] if e.word.startswith("capture")]
            wall = {"r": 1, "l": -1}[walls[-1][-1]] if resting and walls else 0
            middle = State(moment(osc, split), *first.end, wall)
            second = follow(osc, middle, events[k:], moment(osc, end), BALLS)
            for a, b in zip(second.end, whole.end, strict=True):
                assert (a + Ball(0)).overlaps(b + Ball(0))
                assert width(a + Ball(0)) < 1e-60
            (a, b), (c, d) = second.monodromy
            for j in (0, 1):
                p1, q1 = first.monodromy[0][j], first.monodromy[1][j]
                assert (a * p1 + b * q1 + Ball(0)).overlaps(whole.monodromy[0][j] + Ball(0))
                assert (c * p1 + d * q1 + Ball(0)).overlaps(whole.monodromy[1][j] + Ball(0))


@NAMES
def test_mirror_symmetry(name):
    """(x, v, t) -> (l + r - x, -v, t + T/2) maps orbits to orbits, word by word."""
    p, (x, v), start, end, events = point_orbit(name)
    with interval.workprec(400):
        osc = oscillator(p)
        half = osc.T / 2
        other = State(
            osc.moment(interval.ball(start) + half), interval.ball(p.l + p.r - x), interval.ball(-v)
        )
        shifted = [Expected(mirrored(e.word), e.window + half) for e in events]
        image = follow(osc, other, shifted, osc.moment(interval.ball(end) + half), BALLS)
        orbit = exactly(p, (x, v), start, end, events)
        assert image.s == -orbit.s
        assert (osc.l + osc.r - image.end[0]).overlaps(orbit.end[0] + Ball(0))
        assert (-image.end[1] + Ball(0)).overlaps(orbit.end[1] + Ball(0))
        for a, b in zip(sum(image.monodromy, ()), sum(orbit.monodromy, ()), strict=True):
            assert (a + Ball(0)).overlaps(b + Ball(0))


@NAMES
def test_only_the_ratios_matter(name):
    """f/F, R ω²/F, μ/ω and e: in other units, and elsewhere, the same orbit."""
    p, (x, v), start, end, events = point_orbit(name)
    length, rate, shift = Fraction(7, 3), Fraction(5, 2), Fraction(-11)
    force = length * rate**2
    q = Parameters(
        p.F * force,
        p.omega * rate,
        p.f * force,
        shift + length * p.l,
        shift + length * p.r,
        p.e,
        p.mu * rate,
    )
    with interval.workprec(400):
        scaled = [Expected(e.word, e.window / interval.ball(rate)) for e in events]
        state = shift + length * x, length * rate * v
        image = exactly(q, state, start / rate, end / rate, scaled)
        orbit = exactly(p, (x, v), start, end, events)
        size, fast = interval.ball(length), interval.ball(length * rate)
        assert ((image.end[0] - interval.ball(shift)) / size).overlaps(orbit.end[0] + Ball(0))
        assert (image.end[1] / fast + Ball(0)).overlaps(orbit.end[1] + Ball(0))
        (a, b), (c, d) = image.monodromy
        unit = interval.ball(rate)
        pairs = zip((a, b * unit, c / unit, d), sum(orbit.monodromy, ()), strict=True)
        assert all((one + Ball(0)).overlaps(two + Ball(0)) for one, two in pairs)


def test_several_periods():
    """`strobe` over n periods is `strobe` n times; the flight of a fast mass may last several."""
    p = replace(PAPER, l=Fraction(-400), r=Fraction(400))
    with interval.workprec(BITS):
        osc = oscillator(p)
        state = interval.ball(Fraction(-300)), interval.ball(Fraction(30))
        whole = strobe(osc, state, (), BALLS, 3)
        for _ in range(3):
            state = strobe(osc, state, (), BALLS).end
        assert all(a.overlaps(b) for a, b in zip(state, whole.end, strict=True))
        period = interval.midpoint(osc.T)
        with pytest.raises(NotProved, match="may vanish"):  # 2 π f n exceeds the speed
            strobe(osc, (interval.ball(Fraction(-300)), Ball(7)), (), BALLS, 5)
        wall = itinerary(p, 300.0, 30.0, float(5 * period)).events[0]
        events = (Expected("hit r", interval.around(Fraction(wall.time), Fraction(1, 100))),)
        assert len(strobe(osc, (Ball(300), Ball(30)), events, BALLS, 5).hits) == 1


@pytest.mark.parametrize("name", ["turns", "stick after a hit", "soft", "capture r"])
def test_small_viscosity(name):
    """The orbits with μ -> 0 tend to that without, and one enclosure over [0, m] holds them all."""
    base, x, v, start, end = MIXED[name]
    base, state = replace(base, mu=Fraction(0)), (Fraction(x), Fraction(v))
    start, end, m = Fraction(start), Fraction(end), Fraction(1, 10**6)
    with interval.workprec(BITS):
        _, events, _ = certified(base, state, end, start=start)
        constants = Constants.of(base, interval.ball)._replace(mu=between(0, m))
        events, thick = over_sets(constants, state, start, end, events)
        limit, distances = exactly(base, state, start, end, events), []
        for k in range(6):
            mu = m / 10**k
            orbit = exactly(replace(base, mu=mu), state, start, end, events)
            with interval.workprec(400):
                encloses(quantities(thick, BALLS.bound), quantities(orbit, BALLS.bound))
            apart = abs(orbit.end[0] - limit.end[0]) + abs(orbit.end[1] - limit.end[1])
            distances.append(float(apart + Ball(0)))
        assert interval.subset(limit.end[0] + Ball(0), thick.end[0] + Ball(0))
        for far, near in pairwise(distances):
            assert 9.5 < far / near < 10.5


def test_all_constants_may_be_sets():
    """With every constant a ball, the orbits of random parameters in them are enclosed."""
    p, state, start, end, events = point_orbit("viscous")
    random, r = seeded(3), Fraction(1, 10**9)
    with interval.workprec(BITS):
        names = ("F", "omega", "f", "l", "r", "e", "mu")
        constants = (interval.around(getattr(p, n), r) for n in names)
        events, thick = over_sets(Constants(*constants), state, start, end, events)
        for _ in range(rounds(5)):
            values = {n: inside(random, getattr(p, n), r) for n in names}
            q = Parameters(**values)
            fine = exactly(q, state, start, end, events)
            with interval.workprec(400):
                encloses(quantities(thick, BALLS.bound), quantities(fine, BALLS.bound))
