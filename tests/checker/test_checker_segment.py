"""The theorem ``segment``: the checker's closed forms, and certificates that lie."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from mpmath import mp, mpf

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.tampered import accepted, malformed, survivors

STORED = Path(__file__).parents[2] / "certificates"


@pytest.fixture(scope="module", params=["segment.json", "segment-2.json"])
def segment(request):
    """Return a stored certificate: without losses, and with both."""
    return json.loads((STORED / request.param).read_text("utf-8"))


def velocity(parameters):
    """Return t_0, F cos wt_0, v*(0), the place at 0 over that at t_0, and the stroke.

    The turn is found by Newton's method, the rest by quadrature: not by closed forms.
    """
    F, omega, f, mu = (mpf(Fraction(parameters[k]).numerator) /
                       Fraction(parameters[k]).denominator
                       for k in ("F", "omega", "f", "mu"))  # fmt: skip

    def v(t, start):
        def force(s):
            return mp.exp(-mu * (t - s)) * (F * mp.cos(omega * s) - f)

        return mp.quad(force, [start, t])

    half = mp.pi / omega
    start = mp.findroot(lambda t: v(t + half, t), -0.6 / omega)
    way = [mp.quad(lambda t: v(t, start), [start, end]) for end in (0, start + half)]
    return start, F * mp.cos(omega * start), v(mpf(0), start), *way


def test_against_quadrature(segment):
    """Turns, velocity, stroke and ends agree with the equation of motion, integrated."""
    parameters, claims = segment["parameters"], segment["claims"]
    with mp.workdps(25):
        start, force, v, below, stroke = velocity(parameters)
        l, r, f = (mpf(Fraction(parameters[k]).numerator) / Fraction(parameters[k]).denominator
                   for k in "lrf")  # fmt: skip
        T, mu = (
            2 * mp.pi,
            mpf(Fraction(parameters["mu"]).numerator) / Fraction(parameters["mu"]).denominator,
        )
        values = {
            "left": l + below,
            "right": r - stroke + below,
            "v": v,
            "stroke": stroke,
            "multipliers": mp.exp(-mu * T) * ((force - f) / (force + f)) ** 2,
            "turning_times": start + T,
        }
        for name, value in values.items():
            pair = claims[name] if isinstance(claims[name][0], str) else claims[name][1]
            assert abs(mpf(pair[0]) - value) < mpf(10) ** -18, name


def test_it_is_verified(segment):
    """In four steps; the schema describes it; the line says what was proved."""
    assert len(verify(segment)) == 5
    fits_the_schema(segment)
    certificate = read(encode(segment))
    line = words(certificate)
    for part in ("touch no wall", "not isolated", "an open set with an area in"):
        assert part in line
    assert any("capABasinArea" in macro for macro in macros(certificate, "a", 6))


def test_every_number(segment):
    """No enclosure can be moved or widened."""
    assert survivors(segment, {("basin", "drift")}) == []


def test_every_parameter(segment):
    """The claims hold at no other parameters, but with other restitution."""
    for name, value in segment["parameters"].items():
        other = str(Fraction(value) + Fraction(1, 10**12))
        if name == "e":
            verify(changed(segment, "parameters", name, "1/2"))
        else:
            assert not accepted(changed(segment, "parameters", name, other)), name


def test_what_is_malformed(segment):
    """Fields missing, added, of another type are noticed."""
    bad = [altered for _, altered in malformed(segment)]
    assert len(bad) > 300
    assert not any(accepted(altered) for altered in bad)


def test_the_basin(segment):
    """No larger speed, no smaller drift, no basin without interior."""
    path = "claims", "basin"
    speed = Fraction(segment["claims"]["basin"]["speed"])
    first, second = map(Fraction, segment["claims"]["basin"]["drift"])
    small = Fraction(1, 10**6)

    def lie(speed, first, second, why):
        basin = {"speed": str(speed), "drift": [str(first), str(second)]}
        rejected(changed(segment, *path, basin), why)

    lie(speed + small, first, second, "may reach a wall")
    lie(speed, first - small, second, "to first order")
    lie(speed, first, second - small, "larger than claimed$")
    lie(speed, first + 1, second, "may reach a wall")
    lie(0, first, second, "no interior")
    lie(-speed, first, second, "no interior")
    lie(100, first, second, "too fast for a period")
    lie(speed / 2, first, second, "basin_area")


def test_the_first_turn():
    """Where F is much larger than f the first turn limits the basin, not the period."""
    parameters = {"F": "1", "omega": "1", "f": "11/20", "l": "-40", "r": "40", "e": "1", "mu": "0"}
    stored = json.loads((STORED / "segment.json").read_text("utf-8"))
    rejected(stored | {"parameters": parameters}, "stick")


def test_it_may_stick(segment):
    """With more friction the orbit that touches no wall sticks: nothing is proved of it."""
    rejected(changed(segment, "parameters", "f", "54/100"), "may stick")
    rejected(changed(segment, "parameters", "f", "0"), "0 < f")
    rejected(changed(segment, "parameters", "r", "1/2"), "right does not contain")


def test_a_gap_too_small(segment, monkeypatch):
    """An orbit whose stroke may not fit is refused, whatever else is claimed."""
    monkeypatch.setattr("cap.checker.kernel.theorem.Theorem.compare", lambda *_: None)
    rejected(changed(segment, "claims", "stroke", ["2", "2"]), "as long as the gap")
    rejected(changed(segment, "claims", "left", ["0", "1"]), "as long as the gap")
    rejected(changed(segment, "claims", "multipliers", 0, ["0", "1"]), "exactly 1")
    rejected(changed(segment, "claims", "multipliers", 1, ["0", "1/2"]), r"not in \(0, 1\)")
    rejected(changed(segment, "claims", "multipliers", 1, ["1/2", "1"]), r"not in \(0, 1\)")
    rejected(changed(segment, "claims", "basin_area", ["0", "1"]), "not positive")
    rejected(changed(segment, "claims", "turning_times", 0, ["1/100", "1/100"]), "first turn")
