"""The guards of ``conservative``: flights that are not certain, edges, minima before a launch."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import pytest
from support import rounds, seeded

from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.strips import arc, images, landing
from cap.checker.strips.arc import Arc, Launches, everywhere, least
from cap.checker.strips.ceiling import Flight, Flights
from cap.checker.strips.images import image
from cap.checker.strips.landing import Place
from cap.checker.strips.patches import Patch, Spread
from cap.checker.strips.stopping import stops_by
from cap.checker.strips.strips import World
from checker.altered import changed, rejected

NONE = Double(0.0)
F, R = enclosing(Fraction(2, 5)), Double(2.0)
WEAK = enclosing(Fraction(1, 10))  # here a mass that stops may come back by the formula, and arrive
FILE = Path(__file__).parents[1] / "certificates/accept/conservative_by_three_flights.json"
UNIT = 2**24


def launched(t, u, f=F, dt=0.0):
    """Return launches at one speed, nearly."""
    return Launches(Arc(Double(t), Double(dt), Double(u * u / 2), NONE, NONE), f, R)


def flight(t, u, f=0.4):
    """Return the speed and the place of a launch as functions of time, by the formula."""
    sin, cos = math.sin(t), math.cos(t)

    def v(T):
        return u + math.sin(T) - sin - f * (T - t)

    def x(T):
        return (u - sin) * (T - t) + cos - math.cos(T) - f * (T - t) ** 2 / 2

    return v, x


def guessing(monkeypatch, T):
    """Let Newton's method find this time."""
    monkeypatch.setattr(arc, "_guess", lambda *_: T)


def test_a_guess_of_a_hit_needs_no_trust(monkeypatch):
    """Next to the hit it is accepted, and the hit enclosed; else it is refused."""
    T = launched(3.9, 1.2).hit.T.mid
    v, x = flight(3.9, 1.2)
    assert abs(x(T) - 2) < 1e-12
    assert 0.1 < v(T) < 1.5
    for off in (1e-6, -1e-6, 1e-3):
        guessing(monkeypatch, T + off)
        found = launched(3.9, 1.2).hit.T
        assert found.lower < T < found.upper
    for off in (0.3, -0.3):
        guessing(monkeypatch, T + off)
        with pytest.raises(Rejected, match="the time of a hit is not certain"):
            assert launched(3.9, 1.2).hit


def test_a_hit_has_speed(monkeypatch):
    """A time at which the mass has turned, by the formula, is refused."""
    v, x = flight(2.6, 1.3, 0.1)
    guessing(monkeypatch, 4.6)
    assert v(4.6) < -0.1
    assert x(4.6) < 1.9
    with pytest.raises(Rejected, match="a wall may be reached without speed"):
        assert launched(2.6, 1.3, WEAK).hit


def test_no_hit_of_an_arc_is_without_speed(monkeypatch):
    """What is known of the speeds of all hits is positive."""
    found = launched(3.9, 1.2)
    T, T1 = found.hit.T, found.hit.T1
    images._window(found, T, T1)
    for V in (Double(0.1, 0.2), Double(-1.0, 0.1)):
        monkeypatch.setattr(found, "speed", lambda *_, V=V: V)
        with pytest.raises(Rejected, match="a wall may be reached without speed"):
            images._window(found, T, T1)


def test_what_stops_does_not_hit_later(monkeypatch):
    """By the formula it arrives in the end; no arc and no patch of these reaches the wall."""
    v, x = flight(2.6, 1.3, 0.1)
    low, high = 2 * math.pi - math.acos(0.1), 9.0
    assert v(low) < 0 < v(high)
    assert x(low) < 2 < x(high)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if x(middle) < 2 else (low, middle)
    guessing(monkeypatch, low)
    one = launched(2.6, 1.3, WEAK)
    assert one.hit.T.lower <= low <= one.hit.T.upper
    with pytest.raises(Rejected, match="a flight may stop"):
        image(one)
    with pytest.raises(Rejected, match="a flight may stop"):
        Spread(Patch(one.arc, one.arc._replace(e=one.arc.e + 1e-12)), WEAK, R)


def test_a_flight_does_not_halt_before_its_launch():
    """At a slow time before it the speed would be negative: that is none of the flight."""
    flights, slow = Flights(WEAK, R), 2 * math.pi - math.acos(0.1)
    for t, halts in ((slow + 0.2, False), (slow - 0.2, True)):
        v, _ = flight(t, 0.01, 0.1)
        assert v(slow) < 0
        known = Flight(Double(t), Double(slow + 0.5), Double(0.01), NONE, NONE, NONE)
        assert flights.halts(known) is halts
    known = Flight(Double(slow - 0.2), Double(slow - 0.1), Double(0.01), NONE, NONE, NONE)
    assert not flights.halts(known)


def spread():
    """Return a patch, mapped."""
    low = Arc(Double(3.9), Double(1e-5), Double(0.7), Double(1e-5), NONE)
    return Spread(Patch(low, low._replace(e=Double(0.70001))), F, R).roughly(NONE)


@pytest.mark.parametrize("side", [1, -1])
def test_a_bent_edge_along_a_patch_decides_nothing(side):
    """Its slope counts everywhere in the column, and as far beyond as orbits may be apart."""
    found = spread()
    found.wait = width = 1 / 64
    place = Place(found.low, (0, width), found.wait)
    along = abs(found.rate.mid) / (2 * found.wait + width)  # 2 c x has this slope at the end
    bend = along * width * width / 4 * UNIT * UNIT
    assert found.rate.rad < 0.01 * abs(found.rate.mid)
    edge = UNIT // 2, 0, side * round(0.97 * bend / UNIT)
    assert abs(found.gain(edge, place)) < 0.05 * abs(found.rate.mid)
    for more in (1.03, 1.3):
        with pytest.raises(Rejected, match="an edge may be met along a patch"):
            found.gain((UNIT // 2, 0, side * round(more * bend / UNIT)), place)


@pytest.mark.parametrize("r", [1.5, -1.5, 1.9, -1.1])
def test_a_line_beyond_an_arc_is_not_crossed_more_sharply(r):
    """No part of the arc is near it."""
    found = image(launched(3.9, 1.2, dt=0.002))
    line = found.T[0].mid + r * found.dT.mid
    rough = found.crossing(line)
    assert rough.lower > 1 or rough.upper < -1
    assert found.sharp_crossing(line) is rough


def test_a_speed_is_not_negative(monkeypatch):
    """Its square is large enough; but nothing has at most this speed."""
    certificate = json.loads(FILE.read_text("utf-8"))
    monkeypatch.setattr("cap.checker.theorems.conservative.descends", lambda *_: 0)
    monkeypatch.setattr(World, "prove", lambda *_: None)
    speed = certificate["claims"]["speed"]
    rejected(changed(certificate, "claims", "speed", f"-{speed}"), "the speed may be larger")


@pytest.mark.parametrize(
    "radii",
    [(0.1, 0.01, 0.02, 0.02, 0.03), *(tuple(0.02 * (k == n) for k in range(5)) for n in range(5))],
)
def test_all_launches_of_arcs_with_intervals_of_coefficients(radii):
    """Time, speed and its derivatives, at all places of arcs between two."""
    random, middles = seeded(12), (3.9, 0.0, 0.7, 0.0, 0.0)
    t, dt, e, e1, e2 = zip(middles, radii, strict=True)
    whole = everywhere(Arc(*(Double(*z) for z in (t, dt, e, e1, e2))))
    for _ in range(rounds(300)):
        s, *parts = (random.choice((-1, 1, random.uniform(-1, 1))) for _ in range(6))
        T, T1, E, E1, E2 = (m + r * z for (m, r), z in zip((t, dt, e, e1, e2), parts, strict=True))
        u = math.sqrt(2 * (E + s * (E1 + s * E2)))
        du = (E1 + 2 * s * E2) / u
        at = T + s * T1
        truth = at, math.cos(at), math.sin(at), u, du, (2 * E2 - du * du) / u
        for found, value in zip(whole, truth, strict=True):
            assert found.lower - 1e-12 <= value <= found.upper + 1e-12


@pytest.mark.parametrize("side", [1, -1])
def test_the_part_of_an_arc_that_may_meet_a_column(side):
    """All of it, if T' may vanish; else what lies beyond no line, as far as that is known."""

    def part(low, high, slope):
        arc_there = SimpleNamespace(dT=Double(side * slope, 0.1), times=Double(0.0, 1.0))
        return landing._part(arc_there, lambda line: Double(side * line, 0.125), low, high)

    assert part(-0.1, 0.1, 0.05) == part(-0.1, 0.1, 0.2) == (-1.0, 1.0)
    assert part(-2.0, 2.0, 1.0) == (-1.0, 1.0)
    for low, high, first, last in (
        (-0.5, 2.0, -0.625, 1.0),
        (-2.0, 0.5, -1.0, 0.625),
        (-0.5, 0.25, -0.625, 0.375),
    ):
        expected = (first, last) if side > 0 else (-last, -first)
        assert part(low, high, 1.0) == pytest.approx(expected, abs=1e-12)
    assert part(-3.0, -2.0, 1.0) is part(2.0, 3.0, 1.0) is None


@pytest.mark.parametrize("k", range(3))
def test_what_may_be_negative_is_not_positive(k):
    """The radius of value, slope or bend counts, and no more than it does."""
    for radius, holds in ((0.09, True), (0.11, False)):
        z = [Double(0.1), NONE, NONE]
        z[k] = Double(z[k].mid, radius * (2 if k == 2 else 1))
        assert landing.positive(tuple(z), (-1.0, 1.0)) is holds
        assert (least(tuple(z)) > 0) is holds


def test_flights_by_their_times():
    """The speeds at both ends are those with which the distance is flown in this time."""
    random, flights = seeded(13), Flights(F, R)
    for _ in range(rounds(50)):
        t, d = random.uniform(0, 6.3), random.uniform(0.5, 6)
        found = flights.of(Double(t), Double(d))
        v, x = flight(t, found.u.mid)
        assert x(t + d) == pytest.approx(2, abs=1e-9)
        assert found.T.mid == pytest.approx(t + d)
        assert found.V.mid == pytest.approx(v(t + d), abs=1e-9)
        assert found.sum.mid == pytest.approx(found.V.mid + found.u.mid, abs=1e-9)
        assert found.difference.mid == pytest.approx(found.V.mid - found.u.mid, abs=1e-9)


def test_derivatives_along_an_arc():
    """Of speed and place at a fixed time: the first at its middle, the second everywhere."""
    random, step = seeded(14), 1e-3
    for _ in range(rounds(30)):
        ends = (3, 5), (-0.02, 0.02), (0.5, 0.9), (-0.05, 0.05), (-0.01, 0.01)
        drawn = [random.uniform(*each) for each in ends]
        launches, T = Launches(Arc(*map(Double, drawn)), F, R), drawn[0] + 2.3

        def at(s, k, drawn=drawn, T=T):
            t, dt, e, e1, e2 = drawn
            return flight(t + dt * s, math.sqrt(2 * (e + s * (e1 + s * e2))))[k](T)

        for k, found in enumerate((launches.velocity(Double(T)), launches.place(Double(T)))):
            assert found[0].mid == pytest.approx(at(0, k), abs=1e-12)
            assert found[0].rad + found[1].rad < 1e-12
            assert found[1].mid == pytest.approx((at(step, k) - at(-step, k)) / 2 / step, abs=1e-7)
            for s in (-1, -0.4, 0, 1):
                bend = (at(s + step, k) - 2 * at(s, k) + at(s - step, k)) / step**2
                assert found[2].lower - 1e-6 <= bend <= found[2].upper + 1e-6


@pytest.mark.parametrize(("slowest", "stops"), [(-0.1, True), (-1.0, False)])
def test_how_far_a_mass_falls_back(slowest, stops):
    """It may hit, and fall back by its least speed since, as long as it has moved."""
    zero, T = Double(0.0), Double(2.0)
    launches = SimpleNamespace(
        R=R,
        all=SimpleNamespace(t=zero),
        near=SimpleNamespace(t=zero),
        minima=lambda low, high: [Double(1.0)] if low <= 1 <= high else [],
        velocity=lambda at: (Double(-1e-3 if at is T else slowest), zero, zero),
        place=lambda _: (Double(0.5), zero, zero),
    )
    assert stops_by(launches, zero, T) is stops


def test_energies_contain_those_of_all_coefficients():
    """Each of which is known up to a radius; and little more."""
    for radii in ((0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1), (0.01, 0.02, 0.03)):
        coefficients = [Double(m, r) for m, r in zip((0.7, 0.02, -0.01), radii, strict=True)]
        for part in ((-1.0, 1.0), (0.5, 1.0), (-1.0, -0.25)):
            least, most = Place.energies(SimpleNamespace(E=coefficients), *part)
            values = [
                e + r * (e1 + r * e2 / 2)
                for e, e1, e2 in product(*((z.mid - z.rad, z.mid + z.rad) for z in coefficients))
                for r in part
            ]
            assert least <= min(values) <= least + 0.05 + sum(radii)
            assert max(values) <= most <= max(values) + 0.05 + sum(radii)
