"""Periodic orbits of one's own system: certificates that the checker accepts, and refusals."""

import json
import math
from fractions import Fraction
from pathlib import Path

import models
import pytest
from checker.altered import schema
from own_systems import CASES, certificate

import cap
from cap.certificate.report import theorem
from cap.certificate.writer import dumps
from cap.checker.verdict import check, words
from cap.errors import BadInput, NotProved
from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs.contacts import prove
from cap.system.files import read
from cap.system.model import Guard, Mode, System
from cap.system.polynomial import ONE, variables

x, v, cos, pi = variables("x v cos pi")
STOP = [Contact("fly", "stop", "fly")]


def ends(pair):
    """Return the ends of a claim."""
    return tuple(map(Fraction, pair))


@pytest.mark.parametrize("name", CASES)
def test_accepted(name):
    """The checker follows from the system in the certificate alone, and says its steps."""
    steps = list[str]()
    given = certificate(name)
    accepted = check(dumps(given).encode(), steps.append)
    assert len(steps) == 4 + ("basin" in given["claims"])
    told = words(accepted)
    for mode, part in given["parameters"]["modes"].items():
        assert f"mode '{mode}': " in told
        assert all(f"('{guard}', at 0 " in told for guard in part["guards"])
    assert "Krawczyk" in theorem(given)


def test_the_same_bytes_again():
    """The certificate that is kept is proved again, but for its provenance; the schema fits it."""
    kept = json.loads(Path("tests/certificates/own/contacts.json").read_text("utf-8"))
    new = certificate("spring")
    assert dumps({**new, "provenance": {}}) == dumps({**kept, "provenance": {}})
    schema().validate(kept)
    kept["parameters"]["modes"]["__import__"] = kept["parameters"]["modes"]["fly"]
    assert not schema().is_valid(kept)


def test_the_interface():
    """A file is verified from Python, and told in one line."""
    proved = cap.verify_certificate("tests/certificates/own/contacts.json")
    assert repr(proved) == "<Verified: contacts of a system with the state ('x', 'v')>"
    assert proved.sentence.startswith("the system with the state (x, v)")


def test_the_sentence_of_a_spring():
    """Equations, guard and reset are printed as they are in the data."""
    said = words(check(dumps(certificate("spring")).encode(), lambda _: None))
    assert said.startswith(
        "the system with the state (x, v), omega = 27/10; mode 'fly': x' = v, "
        "v' = cos(omega t) - 1/10 v - x, while 1/10 - x > 0 "
        "('stop', at 0 v becomes -9/10 v, mode 'fly'); has an orbit of period 1 x 2 pi/omega"
    )


def test_the_ball_is_that_of_the_closed_form():
    """It hits where cos t = pi (1 - e)/((1 + e) A); the determinant is e²."""
    claims = certificate("ball")["claims"]
    lower, upper = ends(claims["times"][0])
    assert lower <= Fraction(math.acos(math.pi / 3.6)) <= upper
    lower, upper = ends(claims["symmetric"][1])
    assert lower <= Fraction(1, 4) <= upper


@pytest.mark.parametrize(("name", "stored"), [("elliptic", "trace"), ("two masses", None)])
def test_claims_overlap_those_of_the_stored_certificates(name, stored):
    """Times, and the trace, are those that the theorems of one mass and of two claim."""
    claims = certificate(name)["claims"]
    path = {"elliptic": "elliptic", "two masses": "particles"}[name]
    known = json.loads(Path(f"certificates/{path}.json").read_text("utf-8"))["claims"]
    pairs = list(zip(claims["times"], known["hit_times"], strict=True))
    if stored:
        pairs.append((claims["symmetric"][0], known[stored]))
    for ours, theirs in pairs:
        (a, b), (c, d) = ends(ours), ends(theirs)
        assert max(a, c) <= min(b, d)


def test_no_orbit_is_refused():
    """What meets the wall in between is refused with the leg and the guard."""
    system = models.spring(Fraction(27, 10), Fraction(9, 10), Fraction(1, 20), Fraction(1, 10))
    with pytest.raises(NotProved, match="leg 1: the guard 'stop' is negative"):
        prove(Itinerary(system, STOP), [0.3, 0.1, 0.5])


def test_what_a_certificate_cannot_hold():
    """A frequency with pi squared or 1/pi, a high degree: refused in one line."""
    stop = Guard(1 - x, ("fly",), {"v": -(v**7)})
    with pytest.raises(BadInput, match="the reset at stop of fly has more than 40 terms, or"):
        prove(Itinerary(System(("x", "v"), ONE, {"fly": _fly(stop)}), STOP), [1, 1, 1])
    stop = Guard(1 - x, ("fly",), {"v": -v})
    with pytest.raises(BadInput, match="the frequency is neither rational nor that times pi"):
        prove(Itinerary(System(("x", "v"), pi * pi, {"fly": _fly(stop)}), STOP), [1, 1, 1])


def test_the_billiard():
    """Pi in the frequency, and a reset that divides: Church and Fortin's first orbit of a table."""
    system = read("examples/billiard.py")
    t, x, v, w = 0.85201211, 1.421469821, 2.699873969, -1.61604321
    s, y, u, z = 1.241059515, -0.22802519, -4.23983039, -4.07646981
    heights = [1.8 * q * q + 1.5 * math.sin(2 * math.pi * r) for q, r in ((x, t), (y, s))]
    hits = [Contact("fly", "table", "fly")] * 2
    guess = [t, x, heights[0], v, w, s, y, heights[1], u, z]
    accepted = check(dumps(prove(Itinerary(system, hits), guess)).encode(), lambda _: None)
    said = words(accepted)
    assert "omega = 2 pi" in said
    assert "/(1 + 324/25 x x)" in said
    assert "2 of the 4 outside the unit circle" in said or "none on it" in said


def _fly(stop):
    return Mode({"x": v, "v": cos}, {"stop": stop})
