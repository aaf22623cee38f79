"""The form of certificates of ``periodic``, and the theorem in words."""

from __future__ import annotations

import copy
from fractions import Fraction

import pytest

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected
from checker.forge_hybrid import PERIODIC, valid

pytestmark = pytest.mark.usefixtures("orbits_computed_once")


@pytest.fixture(scope="module")
def forged():
    """Return a valid certificate of each orbit."""
    return {name: valid(name) for name in PERIODIC}


def test_impossible_parameters(forged):
    """e = 0, e > 1, mu < 0, a missing mu, and e in a certificate without losses are refused."""
    certificate = forged["viscous"]
    rejected(changed(certificate, "parameters", "e", "0"), "0 < e")
    rejected(changed(certificate, "parameters", "e", "1.1"), "e <= 1")
    rejected(changed(certificate, "parameters", "mu", "-1/5"), "mu >= 0")
    without = copy.deepcopy(certificate)
    del without["parameters"]["mu"]
    rejected(without, "missing")


def test_losses_do_not_belong_to_the_old_theorems(good):
    """The parameters of ``elliptic`` are the five of the format."""
    rejected(changed(good, "parameters", good["parameters"] | {"e": "1", "mu": "0"}), "unknown")


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("claims", "itinerary", 0), "hit", "none of"),
        (("claims", "itinerary"), "hit r", "not a list"),
        (("claims", "period"), "0", "between 1 and 16"),
        (("claims", "period"), "17", "between 1 and 16"),
        (("claims", "period"), ["1"], "string"),
        (("claims", "type"), "sink", "none of"),
        (("claims", "type"), {}, "none of"),
        (("claims", "multipliers"), [["0", "1"]], "list of 2"),
        (("claims", "multipliers", 0), {"re": ["0", "1"]}, "missing"),
        (("claims", "turning_factors"), [], "list of 2"),
        (("hints", "events"), [["0", "1"]] * 65, "list of 1 to 64"),
        (("hints", "events"), [], "list of 1 to 64"),
        (("hints", "bits"), "4097", "between 64 and 4096"),
        (("hints", "order"), "3", "unknown"),
        (("claims",), [], "not an object"),
        (("cites",), [], "cites"),
    ],
    ids=str,
)
def test_the_form(forged, path, value, why):
    """Other words, counts and shapes are refused before anything is computed."""
    rejected(changed(forged["focus"], *path, value), why)


def test_a_basin_belongs_to_what_attracts(forged):
    """A sink without a basin, and a saddle with one, do not have the form."""
    without = copy.deepcopy(forged["focus"])
    del without["claims"]["basin"]
    rejected(without, "missing")
    claims = forged["saddle"]["claims"] | {"basin": forged["focus"]["claims"]["basin"]}
    rejected(forged["saddle"] | {"claims": claims}, "unknown")


@pytest.mark.parametrize("name", PERIODIC)
def test_words_and_macros(forged, name):
    """One line states itinerary, type and determinant; box and basin are not rounded."""
    certificate = read(encode(forged[name]))
    line = words(certificate)
    claims = forged[name]["claims"]
    assert "\n" not in line
    assert ", ".join(claims["itinerary"]) in line
    assert claims["type"] in line
    assert ("determinant 1" in line) == (name == "elliptic")
    assert ("determinant 0 " in line) == (claims["type"] == "superstable")
    assert ("ellipse" in line) == ("basin" in claims)
    printed = list(macros(certificate, "a", 5))
    assert f"\\newcommand{{\\capABoxX}}{{[{', '.join(claims['box']['x'])}]}}" in printed
    if "basin" in claims:
        kappa = Fraction(claims["basin"]["contraction"])
        assert f"\\newcommand{{\\capABasinContraction}}{{{kappa}}}" in printed


def test_the_schema(forged):
    """The JSON Schema describes these certificates exactly."""
    for certificate in forged.values():
        fits_the_schema(certificate)
