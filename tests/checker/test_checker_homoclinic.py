"""The theorem ``homoclinic``: cones, crossings, and certificates that lie."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.maps.cones import Cones
from cap.checker.maps.homoclinic import Orbit
from cap.checker.theorems.homoclinic import Homoclinic
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.tampered import survivors

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

PATH = Path(__file__).parents[2] / "certificates/homoclinic.json"
BITS = 128


def first_point():
    """Return the stored certificate with its first point only."""
    whole = json.loads(PATH.read_text("utf-8"))
    for part, key in (("claims", "points"), ("hints", "orbits")):
        whole[part][key] = whole[part][key][:1]
    return whole


STORED = first_point()
FIXED = tuple(key for key in STORED["claims"] if key not in ("points", "multipliers"))


def hint(*path_and_value):
    """Return the certificate with another hint."""
    return changed(STORED, "hints", *path_and_value)


def test_it_is_verified():
    """The schema describes it; its line says what was proved, and names what is cited."""
    fits_the_schema(STORED)
    steps = verify(STORED)
    assert sum("cross transversely" in step for step in steps) == 1
    line = words(read(encode(STORED)))
    for part in ("at an angle in [25.81237736", "Smale-Birkhoff", "some iterate of Phi"):
        assert part in line


def test_every_number_of_a_point():
    """No end of a point, of its angle, or of a multiplier can be moved."""
    assert survivors(STORED, FIXED) == []


def test_points_that_are_none():
    """The saddle is no homoclinic point, a point is not two, and each needs an orbit of its own."""
    (point,), (orbit,) = STORED["claims"]["points"], STORED["hints"]["orbits"]
    twice = changed(STORED, "claims", "points", [point, point])
    rejected(twice, "not every point has its orbit")
    rejected(changed(twice, "hints", "orbits", [orbit, orbit]), "may be P\\*, or another point")
    saddle = point | {z: STORED["claims"][z] for z in ("x", "v")}
    rejected(changed(STORED, "claims", "points", [saddle]), "does not contain")
    theorem = Homoclinic(read(encode(changed(STORED, "claims", "points", [saddle]))), print)
    place = [Interval.enclosing(*theorem.claims[z][:2], BITS) for z in ("x", "v")]
    with pytest.raises(Rejected, match="may be P"):
        theorem.apart(place)


@pytest.mark.parametrize("z", ["x", "v"])
def test_points_that_differ_in_one_coordinate(z):
    """They are two, whichever it is."""
    (point,) = STORED["claims"]["points"]
    other = point | {z: [str(Fraction(end) + Fraction(1, 10)) for end in point[z]]}
    given = read(encode(changed(STORED, "claims", "points", [point, other])))
    steps = []
    theorem = Homoclinic(given, steps.append)
    place = [Interval.enclosing(*theorem.claims[y][:2], BITS) for y in ("x", "v")]
    theorem.apart(place)
    assert steps == ["the points are not P*, and differ from each other"]


def test_hints_that_prove_nothing():
    """Starts, frames, reaches, slopes and windows that do not serve."""
    (orbit,), frame = STORED["hints"]["orbits"], STORED["hints"]["frame"]
    low, high = map(Fraction, orbit["start"])
    for start, why in (
        ([low, low], "empty or contains 0"),
        ([-low, low] if low > 0 else [high, -high], "empty or contains 0"),
        ([high + 1, high + 2], "beyond the reach"),
        ([high, 2 * high - low], "may not cross"),
    ):
        rejected(hint("orbits", 0, "start", list(map(str, start))), why)
    hits, k = orbit["hit_times"], int(orbit["periods"])
    rejected(hint("orbits", 0, "periods", str(len(hits))), "ends before its point")
    rejected(hint("orbits", 0, "periods", str(k + 1)), "does not contain")
    rejected(hint("orbits", 0, "hit_times", hits[: k + 2]), "beyond the reach of the stable curve")
    dropped = [*hits[:5], hits[5][:1], *hits[6:]]
    rejected(hint("orbits", 0, "hit_times", dropped), "velocity may vanish between")
    rejected(hint("frame", [row[::-1] for row in frame]), "may not be mapped into itself")
    rejected(hint("frame", [frame[0], frame[0]]), "singular")
    rejected(hint("reach", "0"), "reach is not positive")
    rejected(hint("reach", "0.00001"), "unstable cone may not be mapped into itself")
    for slope in ("0", "1", "-1", "2"):
        rejected(hint("slope", slope), "slope is not between 0 and 1")
    rejected(hint("slope", "0.000000000000001"), "unstable cone may not be mapped into itself")


def test_work_is_bounded():
    """So many periods with so many bits are not computed."""
    (orbit,) = STORED["hints"]["orbits"]
    longer = hint("orbits", 0, "hit_times", orbit["hit_times"] * 3)
    rejected(changed(longer, "hints", "bits", "2000"), "too much")


def interval(low, high=None):
    """Return an interval of two decimals."""
    return Interval.enclosing(Fraction(low), Fraction(low if high is None else high), BITS)


def cones(jacobian, slope="0.5"):
    """Prove the cones for a map with this enclosure of its derivative, in the frame 1."""
    zero, one = interval("0"), interval("1")
    (a, b), (c, d) = ([interval(*entry) for entry in row] for row in jacobian)
    known = [{(1, 0): a, (0, 1): b}, {(1, 0): c, (0, 1): d}]
    phi = SimpleNamespace(over=lambda *_: SimpleNamespace(x=known[0], v=known[1]))
    found = Cones((zero, zero), ((one, zero), (zero, one)), Fraction(1), Fraction(slope))
    found.prove(phi)
    return found


@pytest.mark.parametrize(
    ("jacobian", "why"),
    [
        (((["3"], ["0"]), (["1.7"], ["0.3"])), "unstable cone may not be mapped"),
        (((["1.05"], ["0.1", "0.2"]), (["0"], ["0.01"])), "unstable cone may not be stretched"),
        (((["3"], ["1.7"]), (["0"], ["0.3"])), "stable cone may not be pulled back"),
        (((["3"], ["0"]), (["0.2"], ["0.95"])), "stable cone may not be contracted"),
        (((["-1", "3"], ["0"]), (["0"], ["0.3"])), "unstable cone may not be mapped"),
    ],
)
def test_each_condition_of_the_cones(jacobian, why):
    """A linear map that breaks one condition is refused by it; signs do not matter."""
    with pytest.raises(Rejected, match=why):
        cones(jacobian)
    for sign in ("", "-"):
        cones((([f"{sign}3"], ["0.1"]), (["0.2"], [f"{sign}0.3"])))


def crossing(last, flat=False):
    """Decide whether an orbit crosses whose last state this is: M c + (P, Q) in the frame 1.

    Where it is ``flat`` c has no part w: else a curve that crosses is steep.
    """
    zero, one = interval("0"), interval("1")
    frame = (one, zero), (zero, one)
    orbit = object.__new__(Orbit)
    orbit.cones = Cones((zero, zero), frame, Fraction(1), Fraction(1, 10))
    orbit.start, orbit.inward = (Fraction(1), Fraction(3, 2)), (zero, zero)
    carried, point = last
    M = tuple(tuple(map(interval, row)) for row in carried)
    orbit.places = [SimpleNamespace(frame=frame, carried=M, errors=(zero, zero), point=point)]
    if flat:
        orbit._combinations = lambda part: (interval(*part), zero)
    orbit.crosses()


def test_each_condition_of_a_crossing():
    """Too far along the stable curve, on one side of it, or not steep enough."""
    steep, at = (("4", "0"), ("0", "0.1")), (interval("-5"), interval("0.5"))
    crossing((steep, at))
    crossing(((("-4", "0"), ("0", "0.1")), (interval("5"), interval("0.5"))))
    with pytest.raises(Rejected, match="beyond the reach of the stable curve"):
        crossing((steep, (at[0], interval("1.5"))))
    for side in ("-3.9", "-6.1"):
        with pytest.raises(Rejected, match="may not cross"):
            crossing((steep, (interval(side), at[1])))
    with pytest.raises(Rejected, match="may touch"):
        crossing(((("4", "50"), ("0", "0.1")), at), flat=True)


def test_a_point_that_is_not_among_its_states():
    """The mean value theorem needs a box that contains both."""
    zero, one = interval("0"), interval("1")
    frame = (one, zero), (zero, one)
    orbit = object.__new__(Orbit)
    orbit.cones = Cones((zero, zero), frame, Fraction(1), Fraction(1, 10))
    orbit.start, orbit.inward = (Fraction(-1), Fraction(1)), (zero, zero)
    orbit._place((zero, zero), frame, frame, (one, zero))
    with pytest.raises(Rejected, match="not among its states"):
        orbit._place((zero, zero), frame, frame, (interval("2"), zero))
