"""The theorem ``island``: proved from the command line, at other parameters, and refused."""

import json
from fractions import Fraction

import pytest
from support import proving

from cap.errors import BadInput
from cap.floats.candidates import tori
from cap.flow.itinerary import itinerary
from cap.parameters import Parameters
from cap.proofs.rotation_choice import noble, rotation
from cap.sets import interval
from cap.tori.rotation import Quadratic
from cap.tori.states import Motion, covering


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ("--f", "11/20", "--rotation", "[0;2,1,...]"),
        ("--F", "3", "--omega", "2", "--f", "6/5", "--l", "-1/4", "--r", "5/4"),
    ],
)
def test_it_is_proved(capsys, tmp_path, words):
    """The usual curve; where the orbit is its own image; in other units."""
    path = tmp_path / "island.json"
    status, out, err = proving(capsys, "island", "--digits", "12", "--out", str(path), *words)
    assert (status, err) == (0, ""), out + err
    low, high = map(Fraction, json.loads(path.read_text())["claims"]["area"])
    assert 0 < low < high < low * Fraction(1000001, 1000000)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--e", "9/10"), "e = 1|elastic"),
        (("--mu", "1/10"), "mu = 0|elastic|viscous"),
        (("--rotation", "0.28"), "continued fraction"),
        (("--rotation", "[0;3,0,(1)]"), "quotient 0"),
        (("--rotation", "[1;3,(1)]"), "continued fraction"),
        (("--rotation", "[0;3,(1)]", "--largest"), "do not go together"),
    ],
)
def test_what_is_refused(capsys, words, why):
    """In a line, with a status."""
    status, out, err = proving(capsys, "island", *words)
    assert status != 0
    assert any(part in out + err for part in why.split("|")), out + err


def test_a_rotation_number_that_no_curve_has(capsys):
    """Not proved."""
    status, out, err = proving(capsys, "island", "--rotation", "[0;5,(1)]")
    assert status == 1
    assert "NOT PROVED" in out + err


def test_rotation_numbers_are_read():
    """With a period in parentheses, or dots."""
    assert rotation(["[0;3,1,(1)]"], "rotation") == Quadratic((3, 1), (1,))
    assert rotation(["[0; 3, 1, 6, 1, ...]"], "rotation") == Quadratic((3, 1, 6), (1,))
    assert rotation(["[0;(1,2)]"], "rotation") == Quadratic((1, 2), (1, 2))
    with pytest.raises(BadInput):
        rotation(["[0;3,1"], "rotation")


def test_noble_numbers():
    """In an interval; that far from rationals is taken."""
    q = noble(0.276, 0.277)
    assert q == Quadratic((3,), (1,))
    assert noble(0.5, 0.5 + 1e-15) is None


def test_states_are_followed():
    """Half a period in balls contains that of the flow, from points of a box."""
    with interval.workprec(96):
        motion = Motion.of(Fraction(2, 5), Fraction(1))
        axes = ((Fraction(1), Fraction(1, 3)), (Fraction(0), Fraction(1)))
        centre = Fraction("0.1"), Fraction("0.54")
        (z,) = covering(centre, axes, Fraction(1, 100), 1)
        after = motion.after(z)
    p = Parameters(Fraction(1), Fraction(1), Fraction(2, 5), Fraction(-1), Fraction(1))
    for a, b in ((0, 0), (1, 1), (-1, 1), (0.3, -0.7)):
        x, v = 0.1 + (a + b / 3) / 100, 0.54 + b / 100
        end = itinerary(p, x, v, 3.141592653589793).end
        assert after.range(0).contains(-end[0] * (1 + 1e-12)) or abs(after.range(0) + end[0]) < 1e-9
        assert after.range(1).contains(-end[1] * (1 + 1e-12)) or abs(after.range(1) + end[1]) < 1e-9


def test_the_float_map():
    """σσ has the elliptic fixed point of the paper."""
    at = tori.centre(2, tori.HalfPeriod(0.4, 1.0), (0.1, 0.54))
    assert abs(at.point[0] - 0.10027988984) < 1e-10
    assert abs(at.turns(0.03) - 0.282466) < 1e-5
