"""The theorem ``island``: proved from the command line, at other parameters, and refused."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from support import proving

from cap.errors import BadInput
from cap.floats.candidates import tori
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER, Parameters
from cap.proofs.rotation_choice import noble, rotation
from cap.sets import interval
from cap.tori.rotation import Quadratic
from cap.tori.states import Motion, covering

STORED = Path(__file__).parents[2] / "certificates/island.json"


def claims_of(capsys, tmp_path, *words):
    """Prove the theorem from the command line, and return its claims."""
    path = tmp_path / "island.json"
    status, out, err = proving(capsys, "island", "--digits", "12", "--out", str(path), *words)
    assert status == 0, out + err
    return json.loads(path.read_text("utf-8"))["claims"]


@pytest.mark.slow
def test_where_the_orbit_is_its_own_image(capsys, tmp_path):
    """Half a period suffices, and there is one disk."""
    claims = claims_of(capsys, tmp_path, "--f", "11/20")
    assert (claims["map"], claims["disks"]) == ("sigma", "1")
    low, high = map(Fraction, claims["area"])
    assert 0 < low < high < low * Fraction(1000001, 1000000)


@pytest.mark.slow
def test_other_units(capsys, tmp_path):
    """The same motions in other units: areas are in units F²/ω³; the stored curve's is known."""
    system = ("--F", "3", "--omega", "2", "--f", "6/5", "--l", "-1/4", "--r", "5/4")
    claims = claims_of(capsys, tmp_path, *system)
    stored = json.loads(STORED.read_text("utf-8"))["claims"]
    assert claims["rotation_number"] == stored["rotation_number"]
    (a, b), (c, d) = (map(Fraction, each["area"]) for each in (claims, stored))
    assert a <= d * 9 / 8
    assert c * 9 / 8 <= b
    assert (claims["map"], claims["disks"]) == ("Phi", "2")


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


@pytest.mark.slow
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


def test_hits_in_floats():
    """The hit is the first time at the wall, also where the speed at it is small; or there is none.

    From (-0.0355, 0.446) Newton's method, begun with the time without forces, came to a later root.
    """
    sigma, rng = tori.HalfPeriod(0.4, 1.0), np.random.default_rng(4)
    t = np.linspace(0, np.pi, 4000)
    states = [(-0.03550552130434667, 0.44598521869259466)]
    states += rng.uniform((-1, 0.05), (1, 3), (300, 2)).tolist()
    for x, v in states:
        along = x + v * t + 1 - np.cos(t) - 0.2 * t**2
        speed = v + np.sin(t) - 0.4 * t
        beyond = np.flatnonzero((along >= 1) & (speed > 1e-2))
        hit = sigma.hit(x, v)
        if beyond.size:
            assert abs(hit - t[beyond[0]]) < 0.02
            assert v + np.sin(hit) - 0.4 * hit > 0
        elif along.max() < 1 - 1e-3:
            assert np.isnan(hit)


@pytest.mark.slow
def test_where_the_outermost_curve_is_looked_for():
    """Floats refuse no reach with which the stored curve is proved."""
    stored = json.loads(STORED.with_name("island-2.json").read_text())
    at = tori.of_orbit(PAPER, 0.1003, 0.5419)
    rows = tori.coefficients(at, (5 - 5**0.5) / 10, (0.0, tori.last_radius(at)))
    assert tori.never_stops(at, rows, float(Fraction(stored["hints"]["reach"])))
