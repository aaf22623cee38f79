"""The sentences of prover and checker say what was shown and no more."""

from __future__ import annotations

import json
import math
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from checker.altered import changed, encode, rejected
from checker.forge_capture import forge_capture
from checker.forge_hybrid import valid
from checker.forge_impact import PAPER, forge_symmetric
from checker.test_checker_capture import CASES

from cap.certificate import report
from cap.checker.flow.capture import captures
from cap.checker.flow.events import in_order
from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import enclosure
from cap.checker.verdict import check, words
from cap.explore.commands import COMMANDS
from cap.floats.candidates import Request
from cap.floats.engine import swarm
from cap.paper.figure import figure, labels
from cap.parameters import Parameters
from cap.proofs.census import census
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted

WITHOUT_ROOTS = PAPER | {"f": "3/10"}
ROOT = Path(__file__).parents[2]
STORED = ROOT / "certificates"


def stored(name):
    """Return a stored certificate."""
    return json.loads((STORED / f"{name}.json").read_text("utf-8"))


def told(certificate):
    """Return the theorem in the words of the checker and in those of the prover."""
    return words(read(encode(certificate))), report.theorem(certificate)


@pytest.fixture(scope="module")
def backwards():
    """Return the certificate of an elliptic orbit around which Theta < 0 < tau_1."""
    p = Parameters(*map(Fraction, ("1", "1", "0", "-1", "9/5")))
    proof = THEOREMS["elliptic"]
    start = proof.search(Request("elliptic", p, (-0.2286, 1.6332))).candidates[0].start
    return accepted(proof, Setting(p, start, 12, options={"order": 5}))


def parameters(certificate):
    """Return the parameters of a certificate."""
    return Parameters(**{k: Fraction(q) for k, q in certificate["parameters"].items()})


# the normal form


@pytest.mark.parametrize("name", ["elliptic", "elliptic-2", "backwards"])
def test_the_normal_form_is_stated_with_its_signs(name, backwards):
    """The signed angle, the twist, the area form: in both sentences, as claimed."""
    certificate = backwards if name == "backwards" else stored(name)
    claims = certificate["claims"]
    checker, prover = told(certificate)
    for key in ("rotation_angle", "rotation_number", "twist", "twist_action"):
        assert f"[{', '.join(claims[key])}]" in checker
    assert "with Theta in [" + claims["rotation_angle"][0] in checker
    assert "|Theta|/(2 pi) in [" + claims["rotation_number"][0] in checker
    assert "tau_1 in [" + claims["twist"][0] in checker
    for part in ("dx^dv = (i/2) dz^dz^-", "from x to v", "exp(i (Theta + tau_1 |z|^2))"):
        assert part in checker
        assert part in " ".join(prover.split())
    assert "Theta, from x to v" in prover
    assert "rotation number |Theta|/2pi" in prover


def test_the_angle_is_that_of_the_orbits(backwards):
    """At Theta < 0 < tau_1 orbits turn from v to x, and the more slowly the farther out."""
    claims = backwards["claims"]
    angle, twist = (float(claims[key][0]) for key in ("rotation_angle", "twist"))
    assert angle < 0 < twist
    centre = np.array([float(claims["x"][0]), float(claims["v"][0])])
    starts = centre + np.array([[1e-4, 0], [1e-2, 0]])
    seen = swarm.follow(parameters(backwards), starts, 2000, every=True).states - centre
    plane = seen[..., 0] + 1j * seen[..., 1]
    turns = np.angle(plane[:, 1:] / plane[:, :-1]).mean(axis=1)
    assert turns[0] == pytest.approx(angle, abs=2e-3)
    size = 1e-4 * float(claims["jacobian"][1][0][0]) / math.sin(angle)  # |z|^2 = p^2 dx^2
    assert turns[1] == pytest.approx(angle + twist * size, abs=2e-3)
    assert angle < turns[0] + 5e-3 < turns[1] < 0


def test_the_other_sign_is_refused(backwards):
    """The angle of the opposite turn, and the opposite twist."""
    check(encode(backwards), lambda _step: None)
    for key in ("rotation_angle", "twist"):
        lower, upper = (str(-Fraction(end)) for end in backwards["claims"][key])
        rejected(changed(backwards, "claims", key, [upper, lower]), f"{key} does not contain")


# captures


CAPTURED = {
    "periodic": lambda: valid("captured"),
    "once": lambda: forge_capture(**CASES["at once"]),
    "twice": lambda: forge_capture(**CASES["left"]),
}


@pytest.mark.parametrize("name", CAPTURED)
def test_what_a_capture_stands_for_is_said_once(name):
    """In both sentences, in a period and until a release, with one capture and with two."""
    certificate = CAPTURED[name]()
    named = [w for w in certificate["claims"]["itinerary"] if w.startswith("capture")]
    assert len(named) == {"periodic": 2, "once": 1, "twice": 2}[name]
    for sentence in map(" ".join, map(str.split, told(certificate))):
        assert sentence.count(captures(named)) == 1
        assert "exactly these events" in sentence
        assert "infinitely many hits of this wall" in sentence


def test_without_a_capture_nothing_is_said_of_it():
    """The words stand where they are needed only."""
    assert captures(["hit r", "turn right", "stick", "release left"]) == ""
    assert not any("infinitely" in sentence for sentence in told(stored("periodic-1")))


def test_the_last_of_two_captures_is_the_one_with_the_numbers():
    """Its wall, its time and its release."""
    certificate = CAPTURED["twice"]()
    claims = certificate["claims"]
    assert claims["itinerary"][-2:] == ["capture l", "release right"]
    checker, _ = told(certificate)
    assert (
        f"last capture accumulate at a time in [{', '.join(claims['accumulation_time'])}]"
        in checker
    )
    assert "towards the wall l" in checker
    assert f"the last release is at a time in [{', '.join(claims['release_time'])}]" in checker


def test_sane_bounds_on_captures():
    """A force not above f, times before the start, after the release, or out of order: refused."""
    certificate = CAPTURED["twice"]()
    claims = certificate["claims"]
    _, upper = claims["forcing"]
    rejected(changed(certificate, "claims", "forcing", ["0.4", upper]), "not above f")
    begin, end = claims["accumulation_time"]
    for value in (["0", end], [begin, "5.2"]):
        rejected(changed(certificate, "claims", "accumulation_time", value), "is not after")
    for n, (_, end) in enumerate(claims["event_times"]):
        early = changed(certificate, "claims", "event_times", n, ["-1", end])
        rejected(early, "is not after" if n else "may be negative")
    for n, (begin, _) in enumerate(claims["event_times"][:-1]):
        rejected(changed(certificate, "claims", "event_times", n, [begin, "9"]), "is not after|hit")
    periodic = CAPTURED["periodic"]()
    n = periodic["claims"]["itinerary"].index("capture l")
    for ends in (["0", "3.85"], ["3", "6"]):
        rejected(changed(periodic, "claims", "event_times", n, ends), "is not after")


def test_the_order_of_events():
    """Each after the one before; a capture may begin before its hit, and end after it only."""
    words = ["turn right", "hit r", "capture r", "release left"]
    good = [("0", "1"), ("2", "3"), ("3/2", "4"), ("5", "6")]
    bad = {
        0: [("-1", "1"), ("0", "2")],
        1: [("1", "3"), ("2", "9/2")],
        2: [("1", "4"), ("3/2", "5/2"), ("3/2", "5")],
        3: [("4", "6")],
    }

    def attempt(times):
        in_order(words, [enclosure(list(t), "t") for t in times])

    attempt(good)
    for n, changes in bad.items():
        for change in changes:
            with pytest.raises(Rejected, match=r"not after|its hit|negative"):
                attempt([*good[:n], change, *good[n + 1 :]])


# (1,1) orbits


def test_the_velocity_of_a_1_1_orbit_never_vanishes():
    """Wherever theorems are about them, in both sentences."""
    for name in ("symmetric", "pitchfork", "branch"):
        for sentence in told(stored(name)):
            assert "T-periodic, with a velocity that never vanishes and one hit" in sentence


@pytest.mark.parametrize(
    ("name", "f", "R", "stops"),
    [("periodic-9", "7/20", 1, 2), ("periodic-10", "3/20", 1, 4), ("periodic-11", "3/20", 2, 2)],
)
def test_other_orbits_have_one_hit_of_each_wall(name, f, R, stops):
    """Their velocity vanishes: the census does not know them."""
    certificate = stored(name)
    claims, p = certificate["claims"], parameters(certificate)
    assert (p.f, p.R, p.F, p.omega) == (Fraction(f), R, 1, 1)
    check(encode(certificate), lambda _step: None)
    kinds = [word.split()[0] for word in claims["itinerary"]]
    assert claims["period"] == "1"
    assert [w for w in claims["itinerary"] if w.startswith("hit")] == ["hit r", "hit l"]
    assert kinds.count("turn") + kinds.count("stick") == stops
    for member in census(p.f, p.R):
        assert abs(float(member.trace) - float(claims["trace"][0])) > 1


def test_the_page_about_the_format_has_each_table_once():
    """A merge can double a table, or leave it in the section of another theorem."""
    page = (STORED / "FORMAT.md").read_text(encoding="utf-8")
    marks = re.findall("<!-- .* of .* -->", page)
    assert len(marks) > 40
    assert len(set(marks)) == len(marks)


def test_one_hit_of_each_wall_is_never_all_that_is_said():
    """Where orbits are named by it, pages, summaries and titles say whether they turn."""
    pages = [ROOT / "README.md", ROOT / "docs/tutorial.md", STORED / "FORMAT.md"]
    texts = [text for page in pages for text in page.read_text(encoding="utf-8").split("\n\n")]
    texts += [theorem.summary for theorem in THEOREMS.values()]
    texts += [figure(label).title for label in labels()]
    texts += [line for command in COMMANDS.values() for line in (command.summary, command.more)]
    named = [text for text in texts if re.search("one hit of each wall|hits? each wall once", text)]
    assert len(named) > 6
    for text in named:
        assert re.search(r"velocity|\(1,1\)|turn", text), text


def test_roots_in_an_interval():
    """Without roots in (0, pi), it is said of (0, pi): for f = 3/10 there is one elsewhere."""
    certificate = forge_symmetric(WITHOUT_ROOTS)
    assert not certificate["claims"]["paper_roots"]
    for sentence in told(certificate):
        assert "no root in (0, pi)" in sentence
    theta = -2.5337

    def psi(t):
        return math.pi * math.sin(t) - 4 + 0.3 * (math.pi**2 / 2 - t * (math.pi - t))

    assert psi(theta - 1e-3) * psi(theta + 1e-3) < 0


def test_the_trace_on_a_branch():
    """The trace has its value at one f; no rotation number is said to be taken at one f."""
    for sentence in told(stored("branch")):
        assert "2 cos(2 pi p/q)" in sentence
        assert "lliptic orbit" in sentence
        assert "these rotation numbers" not in sentence
