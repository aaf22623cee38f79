"""The theorems ``particles`` and ``particles_saddle``: certificates that lie are rejected."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, leaves, rejected, verify
from checker.tampered import accepted, malformed, moved

pytestmark = pytest.mark.usefixtures("contacts_computed_once")

STORED = Path(__file__).parents[2] / "certificates"
TINY = Fraction(1, 10**9)
LATER = range(1, 32)  # items of lists
HIDDEN = "cap.checker.kernel.theorem.Theorem.compare"


def stored(name):
    """Return a stored certificate."""
    return json.loads((STORED / name).read_text("utf-8"))


@pytest.fixture(scope="module", params=["particles.json", "particles_saddle.json"])
def orbit(request):
    """Return a certificate of each theorem."""
    return stored(request.param)


@pytest.fixture(scope="module")
def tori():
    """Return the certificate at f = 91/200."""
    return stored("particles.json")


@pytest.fixture(scope="module")
def saddle():
    """Return the certificate at f = 2/5."""
    return stored("particles_saddle.json")


def shifted(text, by):
    """Return a number, moved."""
    return str(Fraction(text) + by)


def test_they_are_verified(orbit):
    """Step by step; the schema describes them; the line says what was proved and no more."""
    steps = verify(orbit)
    assert len(steps) == (8 if orbit["theorem"] == "particles" else 6)
    fits_the_schema(orbit)
    certificate = read(encode(orbit))
    line = words(certificate)
    assert "one and only one orbit of period T = 2 pi/omega on which no mass ever stops" in line
    assert "hit r, meet 1 2, hit r, meet 1 2, hit l, meet 1 2, hit l, meet 1 2" in line
    if orbit["theorem"] == "particles":
        assert "do not enclose anything" in line
        assert "does not say that P* is stable" in line
    else:
        assert line.endswith("is unstable")
    assert any("capAReducedTraces" in macro for macro in macros(certificate, "a", 6))


def test_the_second_orbit_is_verified():
    """At f = 2/5 with walls at -11/10 and 11/10."""
    verify(stored("particles-2.json"))


def test_every_number(orbit):
    """No enclosure can be moved or widened; the box neither, out of its place."""
    for path, pair in leaves(orbit["claims"]):
        low, high = map(Fraction, pair) if path[0] not in ("itinerary", "krein_signs") else (0, 0)
        if path[0] == "box":
            far = 10 * (high - low)
            tries = [[low - far, high - far], [low + far, high + far]]
            if path[-1] != "x":  # G is affine in the coordinate: there all orbits are one
                tries.append([low - 9, high + 9])
        else:
            tries = moved(pair) if high else ()
        for ends in tries:
            value = [str(end) for end in ends]
            assert not accepted(changed(orbit, "claims", *path, value)), (path, value)


def test_every_parameter(orbit):
    """The claims hold at no other parameters."""
    for name, value in orbit["parameters"].items():
        if name != "masses":
            assert not accepted(changed(orbit, "parameters", name, shifted(value, TINY))), name
    for n, mass in enumerate(orbit["parameters"]["masses"]):
        bad = changed(orbit, "parameters", "masses", n, shifted(mass, TINY))
        assert not accepted(bad)
    swapped = orbit["parameters"]["masses"][::-1]
    rejected(changed(orbit, "parameters", "masses", swapped), "K does not lie")


def test_parameters_of_no_such_system(orbit):
    """Two masses, both positive; one friction force; f < F."""
    for masses in (["1"], ["1", "1", "1"], "1", [], {}):
        rejected(changed(orbit, "parameters", "masses", masses), "not a list of 2")
    for mass in ("0", "-9/10"):
        rejected(changed(orbit, "parameters", "masses", 1, mass), "a mass is not positive")
    for mass in ("1" + "0" * 31, "1/1" + "0" * 31):
        rejected(changed(orbit, "parameters", "masses", 1, mass), "between 10")
    rejected(changed(orbit, "parameters", "f", ["2/5", "1/2"]), "not a string")
    rejected(changed(orbit, "parameters", "f", "1"), "f < F")


def test_words_claimed(orbit, tori):
    """No contact can be another one, none can be left out or exchanged; Krein signs neither."""
    itinerary = orbit["claims"]["itinerary"]
    for n, word in enumerate(itinerary):
        for other in {"hit l", "hit r", "meet 1 2"} - {word}:
            assert not accepted(changed(orbit, "claims", "itinerary", n, other)), (n, other)
    turned = [*itinerary[1:], itinerary[0]]
    assert not accepted(changed(orbit, "claims", "itinerary", turned))
    rejected(changed(orbit, "claims", "itinerary", itinerary[:-1]), "not a list of 7")
    for n in (0, 1):
        rejected(changed(tori, "claims", "krein_signs", n, "+"), r"theta is not \+")


def test_lists_of_other_lengths(orbit):
    """As many boxes, times, speeds, centres, rows as contacts."""
    for name in ("box", "hit_times", "closing_speeds"):
        fewer = orbit["claims"][name][:-1]
        rejected(changed(orbit, "claims", name, fewer), f"claims.{name} is not a list of 8")
    rejected(changed(orbit, "hints", "centre", orbit["hints"]["centre"][:-1]), "hints.centre is")
    rows = orbit["hints"]["preconditioner"]
    rejected(changed(orbit, "hints", "preconditioner", rows[:-1]), "32 rows and columns")
    rejected(changed(orbit, "hints", "preconditioner", 5, rows[5][:-1]), "32 rows and columns")


def test_hints(orbit):
    """A hint may be bad, then nothing is proved; it is never believed."""
    for k in range(8):
        for n in range(4):
            path = "hints", "centre", k, n
            off = shifted(orbit["hints"]["centre"][k][n], Fraction(1, 1000))
            rejected(changed(orbit, *path, off), "K does not lie")
    rejected(changed(orbit, "hints", "centre", 0, 0, "0.1"), "centre is not in the box")
    for radius in ("0", "-1"):
        rejected(changed(orbit, "hints", "radius", radius), "radius is not positive")
    rejected(changed(orbit, "hints", "radius", "1"), "S is not in the box")
    rejected(changed(orbit, "hints", "radius", "1/1" + "0" * 60), "K does not lie")
    zeros = [["0"] * 32 for _ in range(32)]
    rejected(changed(orbit, "hints", "preconditioner", zeros), "K does not lie")
    for row in range(32):
        other = [shifted(c, 1) for c in orbit["hints"]["preconditioner"][row]]
        rejected(changed(orbit, "hints", "preconditioner", row, other), "K does not lie")
    assert not accepted(changed(orbit, "hints", "bits", "64"))
    assert not accepted(changed(orbit, "digits", "200"))


def test_what_is_cited(orbit):
    """Neither theorems nor hypotheses can be dropped."""
    for n in (0, 1):
        cites = orbit["cites"][:n] + orbit["cites"][n + 1 :]
        rejected(changed(orbit, "cites", cites), "own list")
        fewer = orbit["cites"][n]["hypotheses"][1:]
        rejected(changed(orbit, "cites", n, "hypotheses", fewer), "own list")


def test_what_is_malformed(saddle):
    """Fields missing, added, of another type are noticed: of lists, in the first item."""
    few = {**saddle, "hints": saddle["hints"] | {"preconditioner": [], "centre": []}}
    bad = [altered for path, altered in malformed(few) if not any(n in path[2:-1] for n in LATER)]
    assert len(bad) > 500
    for altered in bad:
        hints = altered.get("hints")
        for name in ("preconditioner", "centre"):
            if isinstance(hints, dict) and hints.get(name) == []:
                hints[name] = saddle["hints"][name]
        assert not accepted(altered)


def test_the_other_theorem(tori, saddle):
    """An elliptic orbit is no saddle, nor the converse, whatever is claimed."""
    more = {k: v for k, v in tori["claims"].items() if k not in saddle["claims"]}
    claims = {**saddle["claims"], **more}
    claims.pop("multipliers"), claims.pop("rotation_number")
    lie = {**saddle, "theorem": "particles", "claims": claims, "cites": tori["cites"]}
    rejected(lie, r"not in \(-2, 2\)")
    last = {k: saddle["claims"][k] for k in ("multipliers", "rotation_number")}
    claims = {k: v for k, v in tori["claims"].items() if k in saddle["claims"]} | last
    lie = {**tori, "theorem": "particles_saddle", "claims": claims, "cites": saddle["cites"]}
    rejected(lie, "neither reduced trace")


def test_conclusions_from_claims(tori, saddle, monkeypatch):
    """What is concluded is concluded from the numbers claimed, also if nothing is compared."""
    monkeypatch.setattr(HIDDEN, lambda *_: None)
    verify(tori)
    verify(saddle)

    def lie(certificate, *change, why):
        rejected(changed(certificate, "claims", *change), why)

    one = ["0", "1"]
    for orbit in (tori, saddle):
        lie(orbit, "hit_times", 0, one, why="may be before 0")
        lie(orbit, "hit_times", 3, orbit["claims"]["hit_times"][2], why="not increasing")
        lie(orbit, "hit_times", 7, ["6.2", "6.2831853072"], why="not before T")
        lie(orbit, "closing_speeds", 4, one, why="closing_speeds are not all")
        lie(orbit, "least_speeds", 1, one, why="least_speeds are not all")
        turned = orbit["claims"]["reduced_traces"][::-1]
        lie(orbit, "reduced_traces", turned, why="not in order")
    low, high = tori["claims"]["reduced_traces"]
    lie(tori, "reduced_traces", [["1.9", "2"], high], why=r"not in \(-2, 2\)")
    lie(tori, "reduced_traces", [low, ["-2", "-1"]], why=r"not in \(-2, 2\)")
    for ends in (["0.5", "0.9"], ["0.6", "1"], ["0.1", "0.2"]):
        lie(tori, "theta", 0, ends, why="theta is not -")
    plus = changed(tori, "claims", "krein_signs", 0, "+")
    verify(changed(plus, "claims", "theta", 0, ["0.1", "0.2"]))
    for ends in (["0", "0.2"], ["0.1", "0.5"]):
        lie(plus, "theta", 0, ends, why=r"theta is not \+")
    for name in ("0,1", "1,-3", "4,0"):
        lie(tori, "resonance_distances", name, one, why="distance is not positive")
    lie(tori, "twist_matrix", 0, 1, ["1", "2"], why="not symmetric")
    for ends in (["-1", "0"], one, ["-1", "1"]):
        lie(tori, "twist_determinant", ends, why="does not exclude 0")
    high, low = saddle["claims"]["reduced_traces"]
    lie(saddle, "reduced_traces", [high, ["-2.3", "-2"]], why="neither reduced trace")
    lie(saddle, "reduced_traces", [["-1", "2"], low], why=r"certainly in \(-2, 2\)")
    lie(saddle, "multipliers", 0, ["-1.7", "-1"], why="may lie in the unit circle")
    lie(saddle, "multipliers", 1, ["-1", "-0.5"], why="may lie outside")
    for ends in (["0", "0.4"], ["0.1", "0.5"]):
        lie(saddle, "rotation_number", ends, why=r"not in \(0, 1/2\)")
