"""The LaTeX export: every number printed is implied by the certificate."""

import re
from fractions import Fraction
from pathlib import Path

import pytest

from cap import verify
from cap.checker.verdict import check

STORED = Path(__file__).parents[2] / "certificates"


def macros(capsys, path, digits):
    """Return the macros printed for a file, name -> body."""
    assert verify.main(["--latex", "--latex-digits", str(digits), str(path)]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line[0] != "%"]
    found = dict(re.fullmatch(r"\\newcommand\{\\(\w+)\}\{(.*)\}", line).groups() for line in lines)
    assert len(found) == len(lines)
    return found


def interval(body):
    """Return the ends of a printed enclosure."""
    text, _, power = body.partition(r" \cdot 10^")
    scale = Fraction(10) ** int(power.strip("{}")) if power else 1
    return [Fraction(end) * scale for end in text.strip("[]").split(", ")]


def test_two_numbers_have_two_names(capsys):
    """As the distances from the resonances (1, 1) and (1, -1)."""
    printed = macros(capsys, STORED / "particles.json", 12)
    assert printed["capParticlesResonanceDistancesOneOne"].startswith("[0.4681")
    assert printed["capParticlesResonanceDistancesOneMinusOne"].startswith("[0.1034")


@pytest.mark.parametrize("digits", [2, 5, 12, 40])
def test_enclosures_are_rounded_outwards(capsys, digits):
    """What is printed contains what is claimed, with any number of digits."""
    path = STORED / "elliptic.json"
    printed = macros(capsys, path, digits)
    claims = check(path.read_bytes(), lambda _step: None).claims
    for name, claim in (
        ("capEllipticTrace", claims["trace"]),
        ("capEllipticX", claims["x"]),
        ("capEllipticTwist", claims["twist"]),
        ("capEllipticHigherTwistsOne", claims["higher_twists"][0]),
        ("capEllipticJacobianOneTwo", claims["jacobian"][0][1]),
    ):
        lower, upper = interval(printed[name])
        assert lower <= claim.lower <= claim.upper <= upper


@pytest.mark.parametrize("name", ["elliptic", "elliptic-2", "saddle", "saddle-2"])
def test_the_box_is_printed_as_it_is_claimed(capsys, name):
    """Uniqueness in a box says nothing of a larger box, nor a bound on a disk of a larger disk."""
    path = STORED / f"{name}.json"
    printed = macros(capsys, path, 2)
    claims = check(path.read_bytes(), lambda _step: None).claims
    boxes = {key: body for key, body in printed.items() if "Box" in key}
    assert sorted(map(interval, boxes.values())) == sorted(
        [claim.lower, claim.upper] for claim in claims["box"].values()
    )
    for key in (k for k in printed if k.endswith("RemainderRadius")):
        assert Fraction(printed[key]) == claims["remainder"]["radius"]
