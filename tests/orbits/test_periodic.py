"""Periodic orbits by contacts: those of the stroboscopic route, and of systems of a few lines."""

import json
import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import models
import pytest

from cap.errors import BadInput, NotProved
from cap.flow.strobe import oscillator as special
from cap.maps import fixed_point
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import prove
from cap.parameters import PAPER
from cap.sets import interval, matrix
from cap.system.friction import oscillator
from cap.system.masses import masses

HITS = [Contact("right", "wall", "left"), Contact("left", "wall", "right")]
GUESS = [1.0992, 1.0, 0.9931, 3.5161, -1.0, -1.28298]
TABLE = [Contact("fly", "table", "fly")]
STOP = [Contact("fly", "stop", "fly")]
ROW = (  # of Church and Fortin, a = 1.8, e = 0.75, E = 1.5: t, x, v, w just before two impacts
    (0.85201211, 1.421469821, 2.699873969, -1.61604321),
    (1.241059515, -0.22802519, -4.23983039, -4.07646981),
)


def test_the_elliptic_orbit_is_that_of_the_stroboscopic_map():
    """Hit times and trace overlap those of the special flow, and are known to 20 digits."""
    orbit = prove(Itinerary(oscillator(PAPER), HITS), GUESS, 15)
    start = fixed_point.Start.non_sticking(0.10028, 0.54194, (1.0992, 3.5161))
    with interval.workprec(120):
        other = fixed_point.prove(special(PAPER), start, 15)
        assert orbit.trace.overlaps(matrix.trace(other.orbit.monodromy))
        for (t, (_, v)), event in zip(orbit.contacts, other.orbit.events, strict=True):
            assert t.overlaps(event.time)
            assert t.rad() < 1e-22
            assert v.rad() < 1e-22
        assert orbit.trace.rad() < 1e-20
        assert orbit.symmetric[1].contains(1)
    assert {(reason.guard, reason.lemma) for reason in orbit.reasons} == {
        ("wall", "M"),
        ("stop", "C"),
    }


def test_a_ball_on_a_table():
    """Of period one it hits where cos t = g pi (1 - e)/((1 + e) A); the determinant is e²."""
    orbit = prove(Itinerary(models.ball(), TABLE), [0.51, 0.58, -3.14], 12)
    [(t, _)] = orbit.contacts
    assert math.isclose(math.cos(t), math.pi / 3.6, rel_tol=1e-12)
    assert orbit.symmetric[1].contains(0.25)
    assert [reason.lemma for reason in orbit.reasons] == ["B"]
    assert orbit.reasons[0].cuts


def test_a_spring_with_damping():
    """The determinant is e² times what the damping leaves of an area, exp(-2 d T)."""
    omega, e, d = Fraction(27, 10), Fraction(9, 10), Fraction(1, 20)
    system = models.spring(omega, e, d, Fraction(1, 10))
    orbit = prove(Itinerary(system, STOP), [1.0, 0.1, 1.0], 12)
    det = float(e * e) * math.exp(-2 * float(d) * 2 * math.pi / float(omega))
    assert math.isclose(orbit.symmetric[1], det, rel_tol=1e-12)
    with pytest.raises(NotProved, match="leg 1: the guard 'stop' is negative") as refused:
        prove(Itinerary(system, STOP), [0.3, 0.1, 0.5], 12)  # it meets the wall in between
    assert refused.value.sets["h"] < -0.09


def test_a_billiard_with_four_variables():
    """The published row is near a proved orbit; the product of the multipliers is e^4."""
    z = [
        q for t, x, v, w in ROW for q in (t, x, 1.8 * x**2 + 1.5 * math.sin(2 * math.pi * t), v, w)
    ]
    system = models.parabola(Fraction(9, 5), Fraction(3, 4), Fraction(3, 2))
    orbit = prove(Itinerary(system, TABLE * 2), z, 12)
    for (t, (x, _, v, w)), row in zip(orbit.contacts, ROW, strict=True):
        assert all(abs(float(a) - b) < 1e-7 for a, b in zip((t, x, v, w), row, strict=True))
    assert orbit.symmetric[3].contains(0.75**4)


def two_masses():
    """Return the system, contacts and guess of the stored certificate of two masses."""
    data = json.loads(Path("certificates/particles.json").read_text("utf-8"))
    words, centre = data["claims"]["itinerary"], data["hints"]["centre"]
    p = replace(PAPER, f=Fraction(data["parameters"]["f"]))
    rows, names = [], {"hit r": "hit r", "hit l": "hit l"}
    for word, event in zip(words, centre, strict=True):
        t, x, *v = map(float, event)
        place = {"hit r": (x, 1.0), "hit l": (-1.0, x)}.get(word, (x, x))
        rows.append((names.get(word, "meet 1 2"), [t, *place, *v]))
    modes = ["".join("+" if v > 0 else "-" for v in z[3:]) for _, z in rows]
    contacts = [
        Contact(mode, name, to)
        for mode, (name, _), to in zip(modes, rows, modes[1:] + modes[:1], strict=True)
    ]
    system = masses(p, [Fraction(m) for m in data["parameters"]["masses"]])
    return data, Itinerary(system, contacts), [q for _, z in rows for q in z]


def test_two_masses():
    """The times are those of the certificate; the multipliers come in pairs of product one."""
    data, itinerary, z = two_masses()
    orbit = prove(itinerary, z, 12)
    for (t, _), (lower, upper) in zip(orbit.contacts, data["claims"]["hit_times"], strict=True):
        assert interval.ends(t)[0] < Fraction(upper)
        assert Fraction(lower) < interval.ends(t)[1]
    first, _, third, last = orbit.symmetric
    assert last.contains(1)
    assert first.overlaps(third)
    assert {reason.lemma for reason in orbit.reasons if reason.guard.startswith("hit")} == {"M"}


def test_refusals():
    """What is no itinerary, no guess or no isolated orbit is refused with one line."""
    system = oscillator(PAPER)
    for contacts, message in (
        ([], "has a contact"),
        ([Contact("right", "roof", "left")], "no guard roof"),
        ([Contact("right", "wall", "right")], "does not lead"),
        ([Contact("right", "wall", "left")], "in another mode"),
    ):
        with pytest.raises(BadInput, match=message):
            Itinerary(system, contacts)
    with pytest.raises(BadInput, match="6 numbers"):
        prove(Itinerary(system, HITS), [1.0])
    flat = models.parabola(Fraction(0), Fraction(1, 2), Fraction(1))  # the place x is free
    with pytest.raises(NotProved, match="singular"):
        prove(Itinerary(flat, TABLE), [0.24, 0.3, 0.99, 0.0, -5.0])
