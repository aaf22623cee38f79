"""The float search: known orbits, closed forms, symmetries, balances."""

import math
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from systems import CASES, FRICTIONS, SHIFTED

from cap.errors import BadInput
from cap.floats.search import periodic
from cap.floats.search.border import margins
from cap.floats.search.periodic import Guess
from cap.flow.itinerary import itinerary, oscillator
from cap.flow.model import Moment
from cap.parameters import PAPER


def symmetric(p, branch):
    """Return hit time, speed at hits and trace of the orbit with x(t + T/2) = l + r - x(t)."""
    F, omega, f, R = (float(q) for q in (p.F, p.omega, p.f, p.R))
    s = math.pi * f / (2 * F)
    c = branch * math.sqrt(1 - s * s)
    k = 2 * math.pi**2 * F * c / (R * omega**2 + 2 * F * c)
    u = omega / math.pi * (R + 2 * F * c / omega**2)
    return math.atan2(s, c) / omega, u, (2 - k) ** 2 - 2


def followed(p, guess):
    """Return the orbit of a guess over one period."""
    return itinerary(p, guess.x, guess.v, 2 * math.pi / float(p.omega))


def test_the_four_orbits_of_the_paper():
    """Kinds, states, traces, hit times and least speed are the known ones."""
    strong, p_star, saddle, mirror = periodic.orbits(PAPER, 2)
    assert [g.kind for g in (strong, p_star, saddle, mirror)] == [
        "saddle",
        "elliptic",
        "saddle",
        "elliptic",
    ]
    assert (p_star.x, p_star.v) == pytest.approx(
        (0.1002798898441954, 0.5419433067664584), abs=1e-13
    )
    assert p_star.hit_times == pytest.approx((1.0991729107, 3.5160904414), abs=1e-10)
    assert p_star.trace == pytest.approx(-0.46028683457, abs=1e-10)
    assert (mirror.x, mirror.v) == pytest.approx((0.55916325, 1.06697003), abs=1e-8)
    assert (saddle.x, saddle.v) == pytest.approx((0.34352606, 0.7753195), abs=1e-7)
    assert saddle.trace == pytest.approx(3.37548, abs=1e-5)
    assert strong.trace == pytest.approx(1336.0452, abs=1e-3)
    assert strong.least_speed == pytest.approx(0.1413575, abs=1e-6)


@pytest.mark.parametrize(("p", "hits"), CASES)
def test_orbits_are_genuine_periodic_and_different(p, hits):
    """Followed by the flow, each closes up with the hits, trace and least speed of its guess."""
    found = periodic.orbits(p, hits)
    assert found
    o = oscillator(p)
    for g in found:
        orbit, margin = followed(p, g), margins(p, (g.x, g.v), 1)
        assert {word.split()[0] for word in orbit.words} == {"hit"}
        assert [event.time for event in orbit.events] == pytest.approx(g.hit_times, abs=1e-10)
        assert orbit.end == pytest.approx((g.x, g.v), abs=1e-10)
        assert sum(orbit.monodromy[k][k] for k in range(2)) == pytest.approx(g.trace, rel=1e-8)
        least = min(margin.least_speed, margin.hit_speed) * float(p.R * p.omega)
        assert least == pytest.approx(g.least_speed, abs=1e-10)
        assert len(g.hit_times) == hits
        assert 0 < g.hit_times[0] < g.hit_times[-1] < o.T
    states = [(g.x, g.v) for g in found]
    assert all(a < b and math.dist(a, b) > 1e-6 for a, b in pairwise(states))


@pytest.mark.parametrize("p", [*(replace(PAPER, f=f) for f in FRICTIONS), SHIFTED])
@pytest.mark.parametrize("branch", [1, -1])
def test_symmetric_orbit_in_closed_form(p, branch):
    """Exactly one orbit found has the hit time, speed and trace of each symmetric solution."""
    t, u, trace = symmetric(p, branch)
    half = math.pi / float(p.omega)
    (found,) = [
        g for g in periodic.orbits(p, 2) if g.hit_times == pytest.approx((t, t + half), abs=1e-11)
    ]
    assert [abs(e.velocity) for e in followed(p, found).events] == pytest.approx([u, u], abs=1e-10)
    assert found.trace == pytest.approx(trace, rel=1e-9, abs=1e-9)


def test_symmetric_orbits_meet_at_a_universal_friction():
    """There are two orbits just below f/F = 2/π and none just above."""
    below, above = Fraction(6366, 10_000), Fraction(6367, 10_000)  # 2/π = 0.63661...
    assert len(periodic.orbits(replace(PAPER, f=below), 2)) == 2
    assert periodic.orbits(replace(PAPER, f=above), 2) == []


def test_the_pair_is_born_at_the_pitchfork():
    """There are four orbits just below the friction of the pitchfork and two just above."""
    ratio = 2 * 2 / (math.pi**2 - 4)
    pitchfork = Fraction(2 / math.pi * math.sqrt(1 - ratio**2))
    step = Fraction(1, 10_000)
    assert len(periodic.orbits(replace(PAPER, f=pitchfork - step), 2)) == 4
    assert len(periodic.orbits(replace(PAPER, f=pitchfork + step), 2)) == 2


@pytest.mark.parametrize(("p", "hits"), CASES)
def test_reflected_orbits_are_orbits(p, hits):
    """Each orbit's reflection, half a period later, is among those found, with the same trace."""
    found = periodic.orbits(p, hits)
    half = math.pi / float(p.omega)
    T = 2 * half
    for g in found:
        shifted = tuple(sorted((t + half) % T for t in g.hit_times))
        assert any(
            h.hit_times == pytest.approx(shifted, abs=1e-10)
            and h.trace == pytest.approx(g.trace, rel=1e-7)
            for h in found
        )


def test_the_reflected_orbit_needs_no_seed(monkeypatch):
    """From a seed near one orbit alone, the search finds its mirror image as well."""
    _, p_star, _, mirror = periodic.orbits(PAPER, 2)
    seed = np.array([p_star.hit_times])
    monkeypatch.setattr(periodic.lifted, "seeds", lambda _: seed)
    found = [(g.x, g.v) for g in periodic.orbits(PAPER, 2)]
    assert found[0] == pytest.approx((p_star.x, p_star.v), abs=1e-12)
    assert found[1] == pytest.approx((mirror.x, mirror.v), abs=1e-12)


def test_half_period_map_of_the_paper_maps_orbits_to_orbits():
    """(x, v) -> (-x(T/2), -v(T/2)); the flow from T/2 on is the flow from 0 for -F."""
    found = [(g.x, g.v) for g in periodic.orbits(PAPER, 2)]
    for g in periodic.orbits(PAPER, 2):
        o = oscillator(PAPER)
        flight = o.launch(1, o.moment(0.0), g.x, g.v)
        for t in g.hit_times:
            if t < math.pi:
                hit = o.moment(t)
                flight = o.reflect(flight, hit, o.velocity(flight, hit))
        half = Moment(math.pi, 0.0, -1.0)
        x, v = o.position(flight, half), o.velocity(flight, half)
        assert any((-x, -v) == pytest.approx(state, abs=1e-10) for state in found)


def test_only_two_ratios_matter():
    """PAPER in units of time 1/3 and length 2/9, shifted: α and ρ are the same."""
    rescaled = periodic.orbits(SHIFTED, 2)
    for g, h in zip(periodic.orbits(PAPER, 2), rescaled, strict=True):
        assert h.x == pytest.approx(-7 + (g.x + 1) * 2 / 9, abs=1e-12)
        assert h.v == pytest.approx(g.v * 2 / 3, abs=1e-12)
        assert h.hit_times == pytest.approx([t / 3 for t in g.hit_times], abs=1e-12)
        assert h.trace == pytest.approx(g.trace, rel=1e-9)
        assert h.least_speed == pytest.approx(g.least_speed * 2 / 3, abs=1e-12)


@pytest.mark.parametrize(("p", "hits"), CASES)
def test_forcing_balances_friction(p, hits):
    """Per period the work ∫ F cos ωt v dt is f N R, and Σ ± sin ωt_k = π f / F over the hits."""
    o = oscillator(p)
    for g in periodic.orbits(p, hits):
        s = 1 if g.v > 0 else -1
        signs = [s * (-1) ** k for k in range(hits)]  # of the velocity before each hit
        pull = sum(a * math.sin(o.omega * t) for a, t in zip(signs, g.hit_times, strict=True))
        assert pull == pytest.approx(math.pi * o.f / o.F, abs=1e-10)
        assert work(o, g) == pytest.approx(o.f * hits * (o.r - o.l), rel=1e-6, abs=1e-6)


def work(o, guess, steps=2000):
    """Return ∫ F cos ωt v dt over a period, by Simpson's rule on each flight."""
    total, flight = 0.0, o.launch(1 if guess.v > 0 else -1, o.moment(0.0), guess.x, guess.v)
    for a, b in pairwise([0.0, *guess.hit_times, o.T]):
        h = (b - a) / steps
        for k in range(steps + 1):
            moment = o.moment(a + k * h)
            weight = 1 if k in (0, steps) else 4 if k % 2 else 2
            total += weight * h / 3 * o.forcing(moment) * o.velocity(flight, moment)
        flight = o.reflect(flight, o.moment(b), o.velocity(flight, o.moment(b)))
    return total


def test_orbits_with_more_hits():
    """At a small friction there are orbits with six hits, none with four; smallest x first."""
    p = replace(PAPER, f=Fraction(1, 1000))
    found = {hits: periodic.orbits(p, hits) for hits in (2, 4, 6)}
    assert {hits: len(guesses) for hits, guesses in found.items()} == {2: 2, 4: 0, 6: 2}
    for hits, guesses in found.items():
        assert all(len(g.hit_times) == hits for g in guesses)
        assert [g.x for g in guesses] == sorted(g.x for g in guesses)


@pytest.mark.parametrize("rho", [10**3, 10**9, 10**30])
def test_far_walls_do_not_hide_the_orbits(rho):
    """Both symmetric orbits are found, as in closed form, with walls up to 10^30 apart."""
    p = replace(PAPER, l=Fraction(0), r=Fraction(rho))
    for branch, g in zip((-1, 1), periodic.orbits(p, 2), strict=True):
        t, _, trace = symmetric(p, branch)
        assert g.hit_times == pytest.approx((t, t + math.pi), abs=1e-9)
        assert g.trace == pytest.approx(trace, abs=1e-6)


def test_orbits_that_have_no_itinerary_or_are_not_isolated_are_left_out():
    """Without friction: hits at t = 0, and curves of orbits, are not results."""
    no_friction = replace(PAPER, f=Fraction(0))
    assert periodic.orbits(no_friction, 2) == []  # both symmetric orbits hit a wall at t = 0
    assert periodic.orbits(replace(no_friction, r=Fraction(10_000)), 4) == []


@pytest.mark.parametrize("hits", [-2, 0, 1, 3])
def test_hits_must_be_even(hits):
    """Odd numbers of hits, none and fewer are bad input: each wall is hit equally often."""
    with pytest.raises(BadInput):
        periodic.orbits(PAPER, hits)


def test_narrow_gap_has_no_orbits():
    """With walls 10^-30 apart the search ends, empty, without a warning."""
    p = replace(PAPER, f=Fraction(1, 10**30), l=Fraction(0), r=Fraction(1, 10**30))
    assert periodic.orbits(p, 2) == []


def test_kinds():
    """|trace| < 2 is elliptic; a trace below -2 is a saddle too."""
    for trace, kind in ((1.9, "elliptic"), (-2.1, "saddle")):
        assert Guess(0.0, 1.0, (), ((trace, -1.0), (1.0, 0.0)), 1.0).kind == kind


def test_import_is_light():
    """The float search does not load scipy."""
    code = "import sys, cap.floats.search.periodic; print('scipy' in sys.modules)"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.split() == ["False"]
