"""Exponents of attractors: per time, of multipliers or with their errors."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.diagnostics import attractor, lyapunov
from cap.floats.words import with_error
from cap.parameters import PAPER


@pytest.mark.parametrize("scale", [1, 3])
def test_the_exponent_of_a_sink_is_that_of_its_multipliers(scale):
    """The focus of F = 3: half the logarithm of its determinant, per time, whatever the unit."""
    p = replace(PAPER, F=Fraction(3 * scale**2), f=PAPER.f * scale**2, omega=Fraction(scale))
    box = (0.40, 0.41, -0.68 * scale, -0.66 * scale)
    (found,) = attractor.attractors(p, box=box, points=2, transient=200).found
    determinant = 0.578451874378091507  # certified: certificates/periodic-1.json
    assert found.exponent == pytest.approx(scale * math.log(determinant) / (4 * math.pi), abs=1e-9)
    assert math.isnan(found.error)
    assert f"exponent {found.exponent:.6g} per time" in found.line()


def test_a_slow_sink_is_not_called_chaotic():
    """Just after its period has doubled: orbits settle slowly; mirror images agree."""
    p = replace(PAPER, F=Fraction("1.5293"))
    found = attractor.attractors(p, points=10).found
    assert "chaotic" not in {each.kind for each in found}
    doubled = [each for each in found if each.kind == "period 2"]
    assert len(doubled) == 2
    for each in doubled:
        assert each.exponent == pytest.approx(-0.00058935, rel=1e-3)
        assert len(each.states) == 2


def test_the_error_of_a_chaotic_exponent():
    """A longer run of other orbits agrees within a few errors, and is several errors from 0."""
    box = (-0.9, 0.0, -0.5, 0.5)
    found = attractor.attractors(PAPER, box=box, points=6, transient=200).found[0]
    assert found.kind == "chaotic"
    assert 0 < 10 * found.error < found.exponent
    long = lyapunov.exponents(PAPER, np.array([[0.0, 0.1]]), 20_000).exponents[0, -1, 0]
    assert found.exponent == pytest.approx(long, abs=5 * found.error)
    value, _, error = found.line().partition("exponent ")[2].partition(" per time")[0].split()
    assert float(value) == pytest.approx(found.exponent, abs=float(error))


def test_a_number_shows_what_its_error_leaves():
    """Two digits of the error, and no more of the number."""
    assert with_error(0.0373812, 0.00062) == "0.03738 +- 0.00062"
    assert with_error(-12.3456, 3.2) == "-12.3 +- 3.2"
    assert with_error(123.456, 45) == "123 +- 45"
    assert with_error(-0.2004117, math.nan) == "-0.200412"
    assert with_error(-math.inf, math.nan) == "-inf"
    assert with_error(0.5, 0.0) == "0.5"


def test_exponents_are_printed_with_their_change():
    """Those of one orbit, from the last half of it."""
    findings = lyapunov.lyapunov(PAPER, orbits=1, periods=1000)
    head, row = findings.lines()
    assert "per time" in head
    assert row.count("+-") == 2
    value, error = (float(word) for word in row.split(": ")[1].split(",")[0].split(" +- "))
    half = np.searchsorted(findings.after, 500)
    last = findings.exponents[0, [half, -1], 0]
    assert value == pytest.approx(last[1], abs=error)
    assert error == pytest.approx(abs(last[1] - last[0]), rel=0.1)
