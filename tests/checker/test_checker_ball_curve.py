"""The theorem ``ball_curve``: what is true is verified; each lie is noticed."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.ball_curve import BallCurve
from cap.checker.verdict import words
from cap.command.outcome import seconds
from checker.altered import SMALL_LOSSES, changed, encode, fits_the_schema, rejected, verify
from checker.tampered import malformed

pytestmark = pytest.mark.usefixtures("impacts_computed_once")

ROOT = Path(__file__).parents[2]
GOOD = json.loads((ROOT / "tests/certificates/accept/ball_curve_small.json").read_text("utf-8"))
CLAIMS, HINTS = GOOD["claims"], GOOD["hints"]
CURVE, FLIGHT = CLAIMS["curve"], HINTS["flight"]
UNIT = 10 ** int(HINTS["places"])
LITTLE = UNIT // 10**4


def bumped(text, mode, by):
    """Return a polynomial with a real part of a coefficient changed."""
    parts = text.split(",")
    re, im = parts[mode].split(" ")
    parts[mode] = f"{int(re) + by} {im}"
    return ",".join(parts)


def test_it_is_verified():
    """All steps; the schema describes it; the sentence has the numbers claimed."""
    assert len(verify(GOOD)) == 7
    fits_the_schema(GOOD)
    said = words(read(encode(GOOD)))
    low, high = CLAIMS["speeds"]
    for part in (
        "y'' = -3",
        "1/30 sin(2 t)",
        "1 + alpha times",
        "[0;1,(1)]",
        f"if v < {low} after one impact, then v <= {high} after all",
        f"in {CLAIMS['rise']['impacts']} impacts",
        f"v <= {decimal(Fraction(CLAIMS['fall']['to']))} in {CLAIMS['fall']['impacts']}: so",
        f"max v lies in [{decimal(Fraction(CLAIMS['rise']['to']))}, {high}]",
        f"min v in [{low}, {decimal(Fraction(CLAIMS['fall']['to']))}]",
    ):
        assert part in said


LIES = {
    "t": ("claims", "curve", "first", bumped(CURVE["first"], 1, LITTLE), "y0|c4|twist"),
    "w": ("claims", "curve", "second", bumped(CURVE["second"], 0, LITTLE), "y0|c4|twist"),
    "the error": ("claims", "distance", "0." + 40 * "0" + "1", "farther"),
    "rotation": ("claims", "rotation_number", "head", ["2"], "y0|c4|Diophantine"),
    "Diophantine": ("claims", "diophantine", "0.39", "Diophantine"),
    "turns": ("claims", "turns", "2", "y0|c4|twist"),
    "no turns": ("claims", "turns", "0", "y0|c4|twist"),
    "frame": ("hints", "frame", "second", bumped(HINTS["frame"]["second"], 0, 10**20), "1/2|y0"),
    "no reach": ("hints", "reach", "0", "reach is not"),
    "a large reach": ("hints", "reach", "1", "contraction|larger than 1"),
    "speed": ("hints", "flight", "speed", bumped(FLIGHT["speed"], 0, UNIT), "contraction"),
    "negative": ("hints", "flight", "speed", "-1 0", "contraction"),
    "inverse": ("hints", "flight", "inverse", "0 0", "contraction"),
    "time": ("hints", "flight", "time", "0 0", "contraction"),
    "later": ("hints", "flight", "later", "0 0", "contraction"),
    "degree": ("hints", "degree", "8", "too many"),
    "few bits": ("hints", "bits", "64", "may take no time"),
    "another phase": ("claims", "rise", "phase", "1/3", "at the end may be lower"),
    "another start": ("claims", "rise", "speed", "4", "at the end may be lower"),
    "a start on the curve": ("claims", "rise", "speed", "38/5", "not start below"),
    "a start at rest": ("claims", "rise", "speed", "0", "not positive"),
    "fewer impacts": ("claims", "rise", "impacts", "3", "at the end may be lower"),
    "no rise": ("claims", "rise", "to", CLAIMS["rise"]["speed"], "not claimed to rise"),
    "from another phase": ("claims", "fall", "phase", "3", "at the end may be higher"),
    "from the curve": ("claims", "fall", "speed", "38/5", "not start above"),
    "in fewer": ("claims", "fall", "impacts", "3", "at the end may be higher"),
    "no fall": ("claims", "fall", "to", CLAIMS["fall"]["speed"], "not claimed to fall"),
}


@pytest.mark.parametrize("name", LIES)
def test_lies(name):
    """Each is rejected, by what it contradicts."""
    *path, value, why = LIES[name]
    rejected(changed(GOOD, *path, value), why)


def negated(text):
    """Return minus a polynomial."""
    pairs = (part.split(" ") for part in text.split(","))
    return ",".join(f"{-int(re)} {-int(im)}" for re, im in pairs)


def test_speeds_have_a_sign():
    """The other root of v² = 2w: the ball would be below the table."""
    flight = FLIGHT | {k: negated(FLIGHT[k]) for k in ("speed", "inverse")}
    rejected(changed(GOOD, "hints", "flight", flight), "may not be positive")


def test_the_curve_is_above_the_table(monkeypatch):
    """Where its lower bound is 0 or less, v is not known to be positive."""
    theorem = BallCurve(read(encode(GOOD)), lambda _: None)
    for low in (Fraction(0), Fraction(-1)):
        monkeypatch.setattr(theorem, "curve", lambda _, low=low: (low, Fraction(30)))
        with pytest.raises(Rejected, match="may not be positive on the curve"):
            theorem.prove()


def test_flights_take_time():
    """The root 0 of the height is none: its reciprocal of the slope is 1/v."""
    flight = FLIGHT | {"time": "0 0", "later": negated(FLIGHT["inverse"])}
    rejected(changed(GOOD, "hints", "flight", flight), "no time")


def test_bounds_are_moved():
    """Both ends."""
    low, high = map(Fraction, CLAIMS["speeds"])
    rejected(changed(GOOD, "claims", "speeds", 0, str(low + Fraction(1, 10**6))), "lower")
    rejected(changed(GOOD, "claims", "speeds", 1, str(high - Fraction(1, 10**6))), "higher")


@pytest.mark.parametrize(("side", "by", "why"), [("rise", 1, "lower"), ("fall", -1, "higher")])
def test_ends_are_moved(side, by, why):
    """A motion comes no nearer to the curve than it does."""
    farther = Fraction(CLAIMS[side]["to"]) + Fraction(by, 10**5)
    rejected(changed(GOOD, "claims", side, "to", str(farther)), f"at the end may be {why}")


@pytest.mark.parametrize(
    ("name", "value", "why"),
    [
        ("A", "1/31", "y0|c4|twist|farther|contraction"),
        ("omega", "2001/1000", "y0|c4|twist|farther|contraction"),
        ("g", "3001/1000", "y0|c4|twist|farther|contraction"),
        ("A", "0", "10"),
        ("A", "-1/30", "10"),
        ("g", "-3", "10"),
        ("A", "3/4", "A omega"),
        ("A", "1" + 31 * "0", "10"),
    ],
)
def test_other_balls(name, value, why):
    """Another ball; a table that falls faster than the ball; signs."""
    rejected(changed(GOOD, "parameters", name, value), why)


@pytest.mark.parametrize("loss", [{"e": "1"}, *SMALL_LOSSES])
def test_losses_are_no_parameters(loss):
    """What loses energy, be it a billionth at each impact, has no such curve."""
    rejected({**GOOD, "parameters": GOOD["parameters"] | loss}, "unknown fields")


def test_the_time():
    """It is said before."""
    assert seconds(encode(GOOD)) == 1
    large = changed(changed(GOOD, "hints", "degree", "20000"), "hints", "places", "60")
    assert seconds(encode(large)) > 50


def test_what_is_malformed():
    """Fields missing, added, of another type; what has the form of numbers is tested above."""
    survived = [where for where, bad in malformed(GOOD) if not refused(bad)]
    others = [w for w in survived if w[-1] != ["2", "1"] and "rotation_number" not in w]
    assert others == []


def refused(certificate):
    """Return whether a certificate is refused when it is read, or its polynomials are."""
    try:
        given = BallCurve(read(encode(certificate)), lambda _: None)
        for pair in (given.claims["curve"], given.hints["frame"]):
            given.pair(pair, 1)
        for name in ("speed", "time"):
            given.pair({"first": given.hints["flight"][name], "second": "0 0"}, 1)
        for name in ("inverse", "later"):
            given.pair({"first": given.hints["flight"][name], "second": "0 0"}, 1)
    except Rejected:
        return True
    return False
