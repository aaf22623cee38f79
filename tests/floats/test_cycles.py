"""The search for periodic orbits with any events, in floats."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from cap.errors import BadInput
from cap.floats import candidates
from cap.floats.candidates import Request
from cap.floats.search.cycles import StroboscopicMap, near
from cap.floats.search.orbits import search
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER, Parameters

TABLE = {  # of the paper, at f = 2/5: F and x, v, trace, determinant
    "3/2": [(0.6276, -0.1184, -1.324, 0.578)],
    "3": [(0.4064, -0.6708, -0.968, 0.578), (0.1992, -1.4002, 11.765, 0.555)],
    "9/2": [(0.2156, -0.8293, -0.520, 0.559)],
    "6": [(0.0267, -0.4816, -0.665, 0.538)],
}
ATTRACTING = ("sink focus", "sink node", "superstable", "elliptic")
FOUND = {}


def at(force):
    """Return the paper's parameters with another forcing."""
    return replace(PAPER, F=Fraction(force))


def found(force, periods=1):
    """Return the orbits found, once for each forcing and period."""
    key = Fraction(force), periods
    if key not in FOUND:
        FOUND[key] = search(at(force), periods)
    return FOUND[key].isolated


def mirrored(p, cycle):
    """Return the state at t = 0 of the orbit that is the mirror image half a period later."""
    x, v = itinerary(p, cycle.x, cycle.v, math.pi / float(p.omega)).end
    return float(p.l + p.r) - x, -v


def distance(p, z, cycle):
    """Return the distance of a state from an orbit's in natural units."""
    return StroboscopicMap(p).size((z[0] - cycle.x, z[1] - cycle.v))


@pytest.mark.slow
@pytest.mark.parametrize("force", TABLE)
def test_the_paper_s_orbits_are_found(force):
    """Their states, traces and determinants."""
    for x, v, trace, det in TABLE[force]:
        same = [
            c
            for c in found(force)
            if abs(c.x - x) < 1e-4 and abs(c.v - v) < 1e-4 and abs(c.trace - trace) < 1e-3
        ]
        assert len(same) == 1
        assert abs(same[0].determinant - det) < 1e-3
        assert same[0].kind(conserves=True) == ("sink focus" if trace < 2 else "saddle")


def test_the_paper_s_four_orbits_are_found():
    """At F = 1 two elliptic orbits and two saddles, and nothing else."""
    kinds = [c.kind(conserves=True) for c in found("1")]
    assert sorted(kinds) == ["elliptic", "elliptic", "saddle", "saddle"]
    assert [round(c.x, 4) for c in found("1")] == [-0.7914, 0.1003, 0.3435, 0.5592]


@pytest.mark.slow
@pytest.mark.parametrize(("force", "periods"), [*((f, 1) for f in ("1", *TABLE)), ("1", 2)])
def test_they_are_what_they_are_said_to_be(force, periods):
    """Periodic, in order, no two the same, of least period n; events within n periods."""
    p, every = at(force), found(force, periods)
    end = periods * 2 * math.pi
    assert every
    assert [(c.x, c.v) for c in every] == sorted((c.x, c.v) for c in every)
    for k, c in enumerate(every):
        path = itinerary(p, c.x, c.v, end)
        assert distance(p, path.end, c) < 1e-8 * (1 + abs(c.trace))
        assert c.path.words == path.words
        times = [event.time for event in path.events]
        assert [t for _, t in c.events] == pytest.approx(times, abs=1e-10 * (1 + abs(c.trace)))
        assert all(0 < time < end for _, time in c.events)
        assert all(distance(p, (c.x, c.v), other) > 1e-7 for other in every[:k])
        for n in range(1, periods):
            assert distance(p, itinerary(p, c.x, c.v, 2 * math.pi * n).end, c) > 1e-3


@pytest.mark.slow
@pytest.mark.parametrize(("force", "periods"), [*((f, 1) for f in ("1", *TABLE)), ("1", 2)])
def test_closed_under_the_symmetry(force, periods):
    """With each orbit its mirror image half a period later is found, with its numbers."""
    p = at(force)
    for c in found(force, periods):
        z, close = mirrored(p, c), 1e-7 * (1 + abs(c.trace))
        near_it = [d for d in found(force, periods) if distance(p, z, d) < close]
        other = min(near_it, key=lambda d: distance(p, z, d))
        assert abs(other.trace - c.trace) < 1e-5 * (1 + abs(c.trace)) ** 2
        assert abs(other.determinant - c.determinant) < 1e-5 * (1 + abs(c.trace))
        assert len(other.events) == len(c.events)


def test_the_images_of_a_period_two_orbit_are_one_orbit():
    """Φ exchanges its two states; near() finds the second one too."""
    for c in found("1", 2):
        if abs(c.trace) < 10:
            x, v = itinerary(PAPER, c.x, c.v, 2 * math.pi).end
            other = near(PAPER, x, v, 2)
            assert distance(PAPER, (x, v), other) < 1e-5
            assert abs(other.trace - c.trace) < 1e-4


@pytest.mark.slow
def test_walls_and_units():
    """Shifted walls, and other units: the same orbits in them."""
    plain = found("3/2")
    shifted = search(replace(at("3/2"), l=Fraction(6), r=Fraction(8))).isolated
    assert [(round(c.x - 7, 6), round(c.v, 6)) for c in shifted] == [
        (round(c.x, 6), round(c.v, 6)) for c in plain
    ]
    p = Parameters(Fraction(12), Fraction(2), Fraction(16, 5), Fraction(-2), Fraction(2))
    units = [(c.x / 2, c.v / 4) for c in search(p).isolated]
    for c in plain:
        if c.kind(conserves=True) in ATTRACTING:
            assert any(abs(x - c.x) < 1e-6 and abs(v - c.v) < 1e-6 for x, v in units)


@pytest.mark.parametrize("force", ["3/2", "3", "6"])
def test_sinks_are_first_among_the_candidates(force, monkeypatch):
    """In the order of the types; one candidate, or all of them."""
    found(force)
    monkeypatch.setattr(candidates, "search", lambda *_: FOUND[Fraction(force), 1])
    first = candidates.cyclic(Request("periodic", at(force)))
    every = candidates.cyclic(Request("periodic", at(force), every=True))
    kinds = [line.split(", ")[2] for line in first.lines[1:]]
    assert kinds == sorted(kinds, key=candidates.TYPES.index)
    assert kinds[0].startswith("sink")
    assert len(first.candidates) == 1
    assert len(every.candidates) == len(kinds) == len(found(force))
    assert first.candidates[0] == every.candidates[0]
    assert f"Found {len(kinds)} isolated orbits of period T" in first.lines[0]
    start = first.candidates[0].start
    assert start.periods == 1
    assert start.events == near(at(force), start.x, start.v).events


def test_near():
    """From a state nearby to the orbit; with n also an orbit of a part of the period."""
    sink = near(at("3"), 0.4, -0.67)
    assert abs(sink.x - 0.4064418315) < 1e-8
    twice = near(at("3"), 0.4064, -0.6708, 2)
    assert abs(twice.x - sink.x) < 1e-7
    assert abs(twice.determinant - sink.determinant**2) < 1e-5
    assert not StroboscopicMap(at("3"), 2).is_primitive(twice)


@pytest.mark.parametrize(
    ("state", "reason"),
    [
        ((2.0, 1.0), "walls"),
        ((1.0, -1.0), "walls"),
        ((-1.5, 0.0), "walls"),
        ((math.nan, 0.0), "finite"),
        ((0.0, math.inf), "finite"),
        ((0.0, 1e9), "no periodic orbit"),
        ((0.0, 0.1), "no periodic orbit"),
    ],
    ids=str,
)
def test_near_refuses(state, reason):
    """States that are none, or from which Newton's method leads nowhere; in one line."""
    p = replace(PAPER, f=Fraction(9, 10)) if state == (0.0, 0.1) else PAPER
    with pytest.raises(BadInput) as caught:
        near(p, *state)
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)


def test_types_in_floats():
    """Exact determinants where the events say so; degenerate where nobody can tell."""
    sink = near(at("3"), 0.4064, -0.6708)
    assert sink.kind(conserves=False) == "sink focus"
    elliptic = near(PAPER, 0.1003, 0.5419)
    assert elliptic.kind(conserves=True) == "elliptic"
    stuck = near(at("3"), 0.9935, 0.343)
    assert stuck.kind(conserves=True) == stuck.kind(conserves=False) == "superstable"
    parabolic = replace(elliptic, path=replace(elliptic.path, monodromy=((1.0, 1.0), (0.0, 1.0))))
    assert parabolic.kind(conserves=True) == "degenerate"


def test_without_friction_a_turn_takes_nothing():
    """At f = 0 its factor is exactly 1: an orbit with turns is elliptic or a saddle, no sink."""
    p = replace(at("3"), f=Fraction(0))
    cycle = near(p, -0.893816, 1e-9)
    assert "turn" in {word.split()[0] for word, _ in cycle.events}
    assert cycle.kind(conserves=True) == "elliptic"
    assert "elliptic" in candidates._described(p, cycle)


@pytest.mark.slow
def test_nothing_is_found_where_nothing_is():
    """Walls out of reach: orbits come in families, none alone; the request says so in one line."""
    wide = replace(PAPER, f=Fraction(9, 10), l=Fraction(-1000), r=Fraction(1000))
    assert search(wide).isolated == ()
    with pytest.raises(BadInput, match="no isolated periodic orbit of period 1 T") as caught:
        candidates.cyclic(Request("periodic", wide))
    assert "family of orbits that touch no wall" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_search_that_cannot_succeed_ends_at_once():
    """Where a period has thousands of events: one line that says so."""
    with pytest.raises(BadInput, match="too many events in a period") as caught:
        candidates.cyclic(Request("periodic", replace(PAPER, F=Fraction(10**30))))
    assert "\n" not in str(caught.value)


def test_a_long_search_tells_how_far_it_is(monkeypatch):
    """Many events: fewer seeds; the parts grow to the whole."""
    monkeypatch.setattr("cap.floats.search.newton.MOST_FOLLOWED", 10_000)
    told = []
    slow = replace(PAPER, omega=Fraction(1, 20))
    with pytest.raises(BadInput, match="no isolated periodic orbit"):
        candidates.cyclic(Request("periodic", slow, progress=told.append))
    assert told[-1] == "searching: 100% done"
    assert len(set(told)) > 10
