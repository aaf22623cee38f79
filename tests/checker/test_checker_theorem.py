"""The checker accepts true certificates, and rejects those of which the theorem is another."""

from __future__ import annotations

import copy
import time
from fractions import Fraction

import pytest
from mpmath import mp

from checker.altered import changed, decimal, rejected, verify
from checker.forge import ORBITS, PARAMETERS, forge
from checker.forge_impact import System
from checker.parts import Rejected

F = Fraction

SCALED = {
    "F": "3",
    "omega": "2",
    "f": "6/5",
    "l": "1/4",
    "r": "7/4",
}  # the orbit of ORBITS, times 3/4
SLOW_SADDLE = ("-0.791447819623894", "0.497920043724544")
SLOW = {"F": "1", "omega": "1", "f": "0.39", "l": "-1", "r": "1"}


@pytest.mark.parametrize(
    "options",
    [
        {"digits": 6},
        {"digits": 30, "order": 5},
        pytest.param({"digits": 60, "order": 7, "box_radius": "0.001"}, marks=pytest.mark.slow),
        {"digits": 12, "orbit": ORBITS["mirror"]},
        {"digits": 12, "box_radius": "0.01"},
        {"digits": 12, "theorem": "saddle", "box_radius": "0.004"},
        {"digits": 12, "parameters": SLOW, "orbit": ("0.0793", "0.5264")},
        {"digits": 12, "parameters": SCALED, "orbit": ("1.0752099", "0.812915")},
        {
            "digits": 12,
            "parameters": SCALED,
            "orbit": ("1.2576445", "1.162979"),
            "theorem": "saddle",
        },
        pytest.param({"digits": 150, "theorem": "saddle"}, marks=pytest.mark.slow),
    ],
    ids=str,
)
def test_accepts(options):
    """True statements at other digits, orders, boxes, orbits and parameters are verified."""
    assert len(verify(forge(**options))) >= 6


def test_an_elliptic_certificate_is_verified_in_bounded_time(good):
    """Ten seconds of processor time, well over ten times what it needs, bound the work."""
    start = time.process_time()
    verify(good)
    assert time.process_time() - start < 10


def test_the_saddle_that_hits_slowly():
    """The orbit with least speed 0.14 is verified, in a box that is small enough."""
    verify(forge("saddle", orbit=SLOW_SADDLE, box_radius="0.0000002", digits=10))


def test_a_flip_saddle():
    """Of the asymmetric pair beyond rotation number 1/2: both multipliers are negative."""
    walls = {"F": "1", "omega": "1", "l": "-7/10", "r": "7/10"}
    with mp.workdps(40):
        pair = System(walls).pair(mp.mpf("0.35"))
        f, *start = (mp.nstr(q, 20) for q in (pair.alpha, *pair.start))
    certificate = forge("saddle", parameters=walls | {"f": f}, orbit=start, digits=6)
    outer, inner = (F(ends[1]) for ends in certificate["claims"]["multipliers"])
    assert outer < -1 < inner < 0
    verify(certificate)


# other theorems


@pytest.mark.parametrize("name", ["F", "omega", "f", "l", "r"])
def test_other_parameters(good, name):
    """Each parameter changed by 1e-12 makes the certificate false."""
    value = Fraction(PARAMETERS[name]) + Fraction(1, 10**12)
    with pytest.raises(Rejected):
        verify(changed(good, "parameters", name, decimal(value)))


def test_a_saddle_is_not_elliptic(good, saddle):
    """The saddle's numbers in an elliptic certificate: the angle would be complex."""
    certificate = copy.deepcopy(good)
    for name in saddle["claims"].keys() & good["claims"].keys():
        certificate["claims"][name] = saddle["claims"][name]
    certificate["hints"] = saddle["hints"] | {"order": "3"}
    rejected(certificate, "square root")


def test_an_elliptic_point_is_no_saddle(good, saddle):
    """The elliptic orbit's numbers in a saddle's certificate: no real multiplier."""
    certificate = copy.deepcopy(saddle)
    for name in saddle["claims"].keys() & good["claims"].keys():
        certificate["claims"][name] = good["claims"][name]
    certificate["hints"] = {k: v for k, v in good["hints"].items() if k != "order"}
    rejected(certificate, "square root")


def test_too_few_bits(good):
    """With 64 bits for 30 digits the inclusion fails."""
    rejected(changed(good, "hints", "bits", "64"), "interior")
