"""The theorem ``map_curve``: what is true is verified; each lie is noticed."""

import json
from fractions import Fraction
from math import pi
from pathlib import Path

import numpy as np
import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.fourier import Circle, Function
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.map_curve import MapCurve
from cap.checker.tori import values
from cap.checker.tori.values import extent
from cap.checker.verdict import words
from cap.command.outcome import seconds
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.tampered import malformed

ROOT = Path(__file__).parents[2]
GOOD = json.loads((ROOT / "tests/certificates/accept/map_curve_small.json").read_text("utf-8"))
CLAIMS, HINTS = GOOD["claims"], GOOD["hints"]
UNIT = 10 ** int(HINTS["places"])


def bumped(text, mode, by):
    """Return a polynomial with a real part of a coefficient changed."""
    parts = text.split(",")
    re, im = parts[mode].split(" ")
    parts[mode] = f"{int(re) + by} {im}"
    return ",".join(parts)


def test_it_is_verified():
    """All steps; the schema describes it; the sentence has the numbers claimed."""
    assert len(verify(GOOD)) == 6
    fits_the_schema(GOOD)
    said = words(read(encode(GOOD)))
    low, high = CLAIMS["bounds"]
    for part in (
        "the map (x, y) -> (3/10 sin(x) + x + y, 3/10 sin(x) + y) of the cylinder, x modulo 2 pi",
        "[0;1,(1)]",
        f"on it {low} <= y <= {high};",
        f"y < {low} to y > {high}",
    ):
        assert part in said


CURVE, FRAME = CLAIMS["curve"], HINTS["frame"]
LITTLE = UNIT // 10**4
LIES = {
    "x": ("claims", "curve", "first", bumped(CURVE["first"], 1, LITTLE), "y0|c4|twist"),
    "y": ("claims", "curve", "second", bumped(CURVE["second"], 0, LITTLE), "y0|c4|twist"),
    "the error": ("claims", "distance", "0." + 40 * "0" + "1", "farther"),
    "no error": ("claims", "distance", "0", "farther"),
    "rotation": ("claims", "rotation_number", "head", ["2"], "y0|c4|Diophantine"),
    "period": ("claims", "rotation_number", "period", ["2"], "y0|c4|Diophantine"),
    "Diophantine": ("claims", "diophantine", "0.39", "Diophantine"),
    "Diophantine zero": ("claims", "diophantine", "0", "not positive"),
    "a wrong lift": (
        "claims", "curve", "second", bumped(CURVE["second"], 0, round(2 * pi * UNIT)), "y0|c4|twist"
    ),
    "a frame": ("hints", "frame", "second", bumped(FRAME["second"], 0, 10**20), "1/2|y0"),
    "no reach": ("hints", "reach", "0", "reach is not"),
    "a small reach": ("hints", "reach", "1/" + 45 * "9", "y0|R.*r/4|contains zero|dT"),
    "a large reach": ("hints", "reach", "2", "larger than 1"),
    "rho": ("hints", "rho", "0", "rho"),
    "rho too large": ("hints", "rho", "1", "may|large"),
    "degree": ("hints", "degree", "8", "too many"),
    "work": ("hints", "places", "300", "between"),
}  # fmt: skip


@pytest.mark.parametrize("name", LIES)
def test_lies(name):
    """Each is rejected, by what it contradicts."""
    *path, value, why = LIES[name]
    rejected(changed(GOOD, *path, value), why)


def test_bounds_are_moved():
    """Both ends."""
    low, high = map(Fraction, CLAIMS["bounds"])
    rejected(changed(GOOD, "claims", "bounds", 0, str(low + Fraction(1, 10**6))), "below")
    rejected(changed(GOOD, "claims", "bounds", 1, str(high - Fraction(1, 10**6))), "above")
    assert len(verify(changed(GOOD, "claims", "bounds", ["3", "5"]))) == 6


def test_extent():
    """All values are in it, and it is not much larger; what is 0 at all places is seen, too."""
    theorem = MapCurve(read(encode(GOOD)), lambda _: None)
    u = theorem.pair(CLAIMS["curve"], 1)[1]
    modes = [complex(a / UNIT, b / UNIT) for a, b in u.coefficients]
    theta = np.linspace(0, 2 * np.pi, 5000)
    there = modes[0].real + 2 * sum(
        (c * np.exp(1j * k * theta)).real for k, c in enumerate(modes) if k
    )
    low, high = extent(u)
    assert there.min() - 0.01 < low <= there.min()
    assert there.max() <= high < there.max() + 0.01
    between = Function(Circle(300, Fraction(1, 10), 30), [(0, 0)] * 256 + [(0, 10**30)], 0)
    low, high = extent(between)  # 2 sin(256 theta), 0 at all places
    assert low < -2
    assert high > 2


def test_no_place_is_left_out(monkeypatch):
    """Of 16 places: a peak, or a pit, at one of them, all but 0 at the others."""
    monkeypatch.setattr(values, "PLACES", 16)
    circle = Circle(7, Fraction(1, 10), 30)
    for place in range(16):
        turns = [(-1) ** place * np.exp(-2j * np.pi * k * place / 16) / 16 for k in range(8)]
        parts = [(round(z.real * 10**30), round(z.imag * 10**30)) for z in turns]
        parts[0] = parts[0][0], 0
        low, high = extent(Function(circle, parts, 0))
        assert max(high, -low) > 15 / 16  # what is added between two places is less than 0.7


def image(first, second):
    """Return the certificate of another map."""
    return changed(GOOD, "parameters", "image", {"x": first, "y": second})


X, Y, KICK = ["1", "x"], ["1", "y"], ["3/10", "sin"]


def test_maps():
    """That of the certificate, written otherwise; another one; what is no such map."""
    torus = {k: v for k, v in GOOD["parameters"].items() if k != "torus"}
    assert len(verify(GOOD | {"parameters": torus})) == 6
    near = [f"{Fraction(3, 10) + Fraction(1, 10**9)}", "sin"]
    rejected(image([X, Y, near], [Y, near]), "y0|c4|farther")
    rejected(image([X, ["2", "y"], ["3/5", "sin"]], [Y, KICK]), "y0|c4|farther|twist")
    rejected(image([X, ["-1", "y"], ["-3/10", "sin"]], [Y, KICK]), "y0|c4|farther|twist|may")
    rejected(image([X, Y, ["1"], KICK], [Y, KICK]), "y0|c4|farther|twist")
    rejected(image([X, KICK], [Y, KICK]), "b y")
    rejected(image([X], [Y, KICK]), "not twist")
    drift = ["1/1000000000"]
    rejected(image([X, Y, KICK, drift], [Y, KICK, drift]), "mean of the kick")
    terms = [["1", *["cos"] * a, *["sin"] * b] for b in (1, 3, 5) for a in range(7 - b)]
    rejected(image([X, Y, *terms], [Y, *terms]), "factors")


@pytest.mark.parametrize("part", ["999/1000", "999999999/1000000000"])
def test_a_map_that_contracts_a_little(part):
    """Its determinant is not 1: y' = part y + q(x), x' = x + y', or x' = x + y + q(x)."""
    for first in ([X, [part, "y"], KICK], [X, Y, KICK]):
        given = {"state": ["x", "y"], "image": {"x": first, "y": [[part, "y"], KICK]}}
        rejected(GOOD | {"parameters": given}, "not kicked by a function of x")


def test_the_time():
    """It is bounded, and said before."""
    assert seconds(encode(GOOD)) == 0
    large = changed(changed(GOOD, "hints", "degree", "20000"), "hints", "places", "60")
    assert seconds(encode(large)) > 50
    rejected(changed(large, "hints", "places", "99"), "degree times places")


def test_what_is_malformed():
    """Fields missing, added, of another type; what has the form of numbers is tested above."""
    survived = [where for where, bad in malformed(GOOD) if not refused(bad)]
    others = [
        w
        for w in survived
        if w[-1] != ["2", "1"] and "rotation_number" not in w and w[0] != "parameters"
    ]
    assert others == []


def refused(certificate):
    """Return whether a certificate is refused when it is read, or its polynomials are."""
    try:
        given = MapCurve(read(encode(certificate)), lambda _: None)
        given.pair(given.claims["curve"], 1)
        given.pair(given.hints["frame"], 1)
    except Rejected:
        return True
    return False
