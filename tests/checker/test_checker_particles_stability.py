"""The theorem particles_stability: what is false is rejected; orbits from a box against floats."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from support import seeded

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.particles.mechanics import Mechanics
from cap.checker.particles.neighbours import Arc, Neighbours
from cap.checker.system.masses import MassParameters
from cap.floats.masses.particles import Particles, follow
from cap.parameters import Parameters
from checker import remembered
from checker.altered import changed, fits_the_schema, rejected, verify

STORED = Path(__file__).parents[2] / "certificates/particles_stability.json"
BITS = 160


@pytest.fixture(scope="module")
def stored():
    """Return the stored certificate."""
    return json.loads(STORED.read_text("utf-8"))


@pytest.fixture(scope="module")
def near(stored):
    """Return the orbits from a small box around the centre, to low order."""
    given = {k: Fraction(stored["parameters"][k]) for k in ("F", "omega", "f", "l", "r")}
    masses = tuple(map(Fraction, stored["parameters"]["masses"]))
    M = Mechanics(MassParameters(**given, masses=masses), BITS)
    c = [M.number(Fraction(q)) for q in stored["claims"]["centre"]]
    reach = Interval.enclosing(Fraction(-1, 10**4), Fraction(1, 10**4), BITS)
    return Neighbours(M, [q + reach for q in c], c, 3)


def windows(stored):
    """Return the windows of the certificate."""
    return [(Fraction(a), Fraction(b)) for a, b in stored["hints"]["windows"]]


def test_the_jacobian_is_that_of_the_orbit(stored, near):
    """At the centre, near P*, the jets have the derivative that is claimed, and the state again."""
    image = near.over(stored["claims"]["itinerary"], windows(stored))
    for q, row, c in zip(
        image, stored["claims"]["monodromy"], stored["claims"]["centre"], strict=True
    ):
        assert float(q.centre.constant.lower) == pytest.approx(float(Fraction(c)), abs=1e-12)
        for j, pair in enumerate(row):
            unit = tuple(int(i == j) for i in range(4))
            slope = q.centre.coefficients[unit]
            assert float(slope.lower) == pytest.approx(float(Fraction(pair[0])), abs=1e-9)


def test_orbits_in_floats_are_enclosed(stored, near):
    """From random states of the box, after one period."""
    random = seeded(7)
    image = near.over(stored["claims"]["itinerary"], windows(stored))
    p = {k: Fraction(stored["parameters"][k]) for k in ("F", "omega", "f", "l", "r")}
    system = Particles(Parameters(**p), tuple(map(Fraction, stored["parameters"]["masses"])))
    centre = np.array([float(Fraction(q)) for q in stored["claims"]["centre"]])
    for _ in range(10):
        z = centre + np.array([random.uniform(-1e-4, 1e-4) for _ in range(4)])
        end = follow(system, z[:2], z[2:], 2 * math.pi)
        assert end.words == tuple(stored["claims"]["itinerary"])
        for q, w in zip(image, (*end.x, *end.v), strict=True):
            assert float(q.value.lower) - 1e-9 < w < float(q.value.upper) + 1e-9


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("claims", "part"), "1", "not the smaller one"),
        (("claims", "periods"), "1/2", "not a positive integer"),
        (("claims", "axes", 1), ["0", "0", "0", "0"], "do not span"),
        (("claims", "centre", 0), "0.1007", "certainly in the inner"),
        (("hints", "windows", 0), ["0.5", "0.6"], "may be after its window"),
        (("hints", "windows", 0), ["0.62", "0.7"], "may be before its window"),
        (("hints", "windows", 0), ["0.7", "0.6"], "lower > upper"),
        (("hints", "powers", 0), ["0", "0", "0", "0"], "not in 1 .. 6"),
        (("hints", "powers", 0), ["0", "0", "0", "4"], "not a coefficient each"),
        (("hints", "order"), "7", "not between"),
    ],
)
def test_hints_and_claims_that_do_not_fit(stored, path, value, why):
    """Each for its reason, before the long computation."""
    rejected(changed(stored, *path, value), why)


@pytest.mark.parametrize(("gap", "meet"), [("29/100000", True), ("33/100000", False)])
def test_masses_that_meet_inside_a_flight(near, gap, meet):
    """Both move to the right, the second, lighter one slower for a while: apart at both ends."""
    gap, late = Fraction(gap), Fraction(-303, 50000)  # of the places, of the speeds
    point = [near.M.number(q) for q in (Fraction(0), gap, Fraction(1), 1 + late)]
    around = Neighbours(near.M, point, point, 1)
    x, v = around.states[:2], around.states[2:]
    arc = Arc(around.signs(v), around.instant(near.M.number(0)), x, v)
    end = around.instant(near.M.number(Fraction(1, 5)))
    after = around.at(arc, end)
    assert (after[0][1].value - after[0][0].value).is_positive()
    if meet:
        with pytest.raises(Rejected, match="meet"):
            around.quiet(arc, end, *after, met=False)
    else:
        around.quiet(arc, end, *after, met=False)


def test_a_box_that_is_too_large(near, stored):
    """From states so far away contacts leave their windows, or masses stop."""
    c = [q.midpoint() for q in (w.centre.constant for w in near.states)]
    reach = Interval.enclosing(Fraction(-1, 5), Fraction(1, 5), BITS)
    far = Neighbours(near.M, [q + reach for q in c], c, 2)
    with pytest.raises(Rejected):
        far.over(stored["claims"]["itinerary"], windows(stored))


def test_another_itinerary(near, stored):
    """A contact left out, or exchanged for another one, is noticed."""
    words, times = stored["claims"]["itinerary"], windows(stored)
    for wrong, at in ((words[1:], times[1:]), (words[:-1], times[:-1])):
        with pytest.raises(Rejected):
            near.over(wrong, at)
    with pytest.raises(Rejected):
        near.over(["hit l", *words[1:]], times)


@pytest.mark.slow
def test_it_is_accepted_and_no_more(stored):
    """With its steps; more periods, a larger ellipsoid, another polynomial are rejected."""
    with remembered.neighbours_followed_once():
        assert any("H does not grow" in step for step in verify(stored))
        fits_the_schema(stored)
        rejected(changed(stored, "claims", "periods", "9" * 40), "leave the ellipse before")
        rejected(changed(stored, "claims", "part", "0.999"), "leave the ellipse before")
        rejected(changed(stored, "hints", "integral", 0, "1.1"), "leave the ellipse before")
    axes = [[str(Fraction(q) * 2) for q in row] for row in stored["claims"]["axes"]]
    rejected(changed(stored, "claims", "axes", axes), "leave the ellipse before")
