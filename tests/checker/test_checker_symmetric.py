"""The theorems ``symmetric`` and ``pitchfork``."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.kernel.theorem import Theorem
from cap.checker.maps.non_sticking import KRAWCZYK
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.forge_impact import PAPER, WALLS, forge_pitchfork, forge_symmetric
from checker.tampered import accepted, malformed, survivors

SYSTEMS = {
    "paper": PAPER,
    "both genuine, elliptic": PAPER | {"f": "1/2"},
    "minus not genuine": PAPER | {"f": "3/5", "l": "-3/8", "r": "3/8"},
    "minus does not hit": PAPER | {"f": "1/10", "l": "-1/5", "r": "1/5"},
    "much friction": PAPER | {"f": "7/10"},
    "no roots of the paper": PAPER | {"l": "-2", "r": "2"},
    "wide": PAPER | {"l": "-20", "r": "20", "f": "1/10"},
    "other units": {"F": "3", "omega": "2", "f": "6/5", "l": "1/4", "r": "7/4"},
    "speeds increase after the hits": PAPER | {"f": "3/5"},
}


@pytest.fixture(scope="module")
def symmetric():
    """Return a valid certificate."""
    return forge_symmetric()


@pytest.fixture(scope="module")
def pitchfork():
    """Return a valid certificate."""
    return forge_pitchfork()


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("digits", [6, 40])
def test_symmetric_orbits(name, digits):
    """All cases of what exists are verified, and described by the schema."""
    certificate = forge_symmetric(SYSTEMS[name], digits)
    assert len(verify(certificate)) == 5
    fits_the_schema(certificate)


def test_the_cases_are_all_there():
    """Orbits that are genuine, elliptic, not genuine, not there; values and roots that are none."""
    made = {name: forge_symmetric(p, 6)["claims"] for name, p in SYSTEMS.items()}
    assert made["both genuine, elliptic"]["branches"]["plus"]["type"] == "elliptic"
    assert made["minus not genuine"]["branches"]["minus"]["genuine"] == "no"
    assert made["minus does not hit"]["branches"]["minus"] == "none"
    assert made["much friction"]["branches"] == {"plus": "none", "minus": "none"}
    assert made["wide"]["pitchfork"] == made["wide"]["minus_identity"] == "none"
    assert made["no roots of the paper"]["paper_roots"] == []
    assert len(made["paper"]["paper_roots"]) == 2


def test_pitchfork(pitchfork):
    """Also with other digits and in other units."""
    verify(pitchfork)
    fits_the_schema(pitchfork)
    for digits in (6, 40):
        verify(forge_pitchfork(digits=digits))
    for walls in ({"F": "3", "omega": "2", "l": "1/4", "r": "7/4"}, WALLS | {"r": "1/2"}):
        verify(forge_pitchfork(walls, 10))
    rejected(forge_pitchfork(WALLS | {"r": "-1/2"}, 10), "least speed is not positive")


@pytest.mark.parametrize("name", ["paper", "minus not genuine"])
def test_every_number_of_symmetric(name):
    """No enclosure can be moved or widened."""
    assert survivors(forge_symmetric(SYSTEMS[name], 10)) == []


def test_every_number_of_pitchfork(pitchfork):
    """No enclosure can be moved or widened."""
    assert survivors(pitchfork) == []


def test_what_is_malformed(symmetric, pitchfork):
    """Fields missing, added, of another type are noticed when read, or later; but the roots of the
    paper's equation need not be claimed."""
    for certificate in (symmetric, pitchfork):
        bad = [altered for _, altered in malformed(certificate)]
        assert len(bad) > 500
        fine = [altered for altered in bad if accepted(altered)]
        without = [altered for altered in fine if "paper_roots" not in altered["claims"]]
        assert len(fine) == len(without) == (certificate is symmetric)


@pytest.mark.parametrize("name", ["F", "omega", "f", "l", "r"])
def test_other_parameters(symmetric, pitchfork, name):
    """The claims hold at no other parameters."""
    for certificate in (symmetric, pitchfork):
        if name in certificate["parameters"]:
            value = Fraction(certificate["parameters"][name]) + Fraction(1, 10**12)
            assert not accepted(changed(certificate, "parameters", name, str(value)))


def test_parameters_are_strict(symmetric, pitchfork):
    """No f where all f are meant, f > 0 where it is given, no losses."""
    rejected(changed(symmetric, "parameters", "f", "0"), "0 < f")
    rejected(changed(symmetric, "parameters", "f", "1"), "f < F")
    for name in ("f", "e", "mu"):
        rejected(changed(pitchfork, "parameters", name, "1/5"), "missing or unknown")
    rejected(changed(symmetric, "parameters", "e", "1"), "missing or unknown")
    rejected(changed(pitchfork, "parameters", "l", "1"), "l < r")
    for certificate in (symmetric, pitchfork):
        for cites in (["x"], "", {}, [KRAWCZYK]):
            rejected(changed(certificate, "cites", cites), "cites is not the checker's own list")
    rejected(changed(symmetric, "hints", "bits", "63"), "bits")


def test_orbits_claimed_not_to_exist(symmetric):
    """Neither can an orbit be denied, nor one be claimed that is not there."""
    claims = symmetric["claims"]
    rejected(changed(symmetric, "claims", "branches", "plus", "none"), "the formula gives an orbit")
    some = {"genuine": "no"} | {
        k: claims["branches"]["plus"][k] for k in ("hit_speed", "least_speed")
    }
    rejected(changed(symmetric, "claims", "branches", "plus", some), "is not negative")
    much = forge_symmetric(SYSTEMS["much friction"])
    orbit = claims["branches"]["plus"]
    rejected(changed(much, "claims", "branches", "plus", orbit), "there is no orbit")
    virtual = forge_symmetric(SYSTEMS["minus not genuine"])
    pair = virtual["claims"]["branches"]["minus"]
    genuine = orbit | {k: pair[k] for k in ("hit_speed", "least_speed")}
    assert not accepted(changed(virtual, "claims", "branches", "minus", genuine))
    rejected(changed(symmetric, "claims", "pitchfork", "none"), "against the claim")
    wide = forge_symmetric(SYSTEMS["wide"])
    rejected(changed(wide, "claims", "minus_identity", ["0", "1"]), "against the claim")


def test_types(symmetric):
    """A saddle is not elliptic, nor the converse."""
    path = "claims", "branches", "plus", "type"
    rejected(changed(symmetric, *path, "elliptic"), "is not that of the type claimed")
    elliptic = forge_symmetric(SYSTEMS["both genuine, elliptic"])
    rejected(changed(elliptic, *path, "saddle"), "is not that of the type claimed")
    rejected(changed(elliptic, *path, "focus"), "none of")


def test_a_trace_that_touches(symmetric, monkeypatch):
    """2 and -2 decide nothing."""
    monkeypatch.setattr(Theorem, "compare", lambda *_: None)
    for kind, trace, fine in (
        ("elliptic", ["-2", "0"], False),
        ("elliptic", ["0", "2"], False),
        ("elliptic", ["-1", "1"], True),
        ("saddle", ["2", "3"], False),
        ("saddle", ["-3", "-2"], False),
        ("saddle", ["-3", "-2.1"], True),
        ("saddle", ["2.1", "3"], True),
    ):
        certificate = changed(symmetric, "claims", "branches", "plus", "type", kind)
        certificate["claims"]["branches"]["plus"]["trace"] = trace
        if fine:
            verify(certificate)
        else:
            rejected(certificate, "branches.plus.trace")


def test_the_roots(symmetric):
    """One less, one more, in the other order, twice the same."""
    roots = symmetric["claims"]["paper_roots"]
    for wrong in ([], roots[:1], roots[::-1], roots[:1] * 2, roots[1:] * 2):
        assert not accepted(changed(symmetric, "claims", "paper_roots", wrong))
    rejected(changed(symmetric, "claims", "paper_roots", [*roots, roots[0]]), "0 to 2")
    none = forge_symmetric(SYSTEMS["no roots of the paper"])
    rejected(changed(none, "claims", "paper_roots", roots), "has 0 roots")


def test_no_pitchfork():
    """Walls too far apart: no pair is born."""
    pitchfork = forge_pitchfork(digits=6)
    rejected(changed(pitchfork, "parameters", "r", "2"), "no pair is born")


def test_words_and_macros(symmetric, pitchfork):
    """The line states what was proved; each number has its macro."""
    line = words(read(encode(symmetric)))
    for part in ("exactly two (1,1) orbits have", "'plus'", ": saddle", "exactly the two roots"):
        assert part in line
    for name, part in (
        ("minus not genuine", "it is no (1,1) orbit"),
        ("much friction", "exactly zero (1,1) orbits have"),
        ("wide", "is 2 nowhere"),
        ("no roots of the paper", "has no root"),
    ):
        certificate = check(encode(forge_symmetric(SYSTEMS[name], 8)), lambda _: None)
        assert part in words(certificate)
        assert list(macros(certificate, "a", 5))
    line = words(read(encode(pitchfork)))
    for part in ("0 < f < F", "for f < f_0 near f_0 both are elliptic"):
        assert part in line
    shown = list(macros(read(encode(pitchfork)), "a", 5))
    assert "\\newcommand{\\capACurvature}{[-0.48383, -0.48382]}" in shown
