"""Periodic orbits of two masses in floats, continued from equal masses."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.masses.particle_orbits import (
    Continued,
    NotFound,
    continued,
    fixed_point,
    reduced_traces,
)
from cap.floats.masses.particles import Particles
from cap.parameters import PAPER

PAIR = (0.1003, 0.5592, 0.5419, 1.0670)  # the elliptic orbits of one mass: x, x, v, v


EQUAL = Particles(PAPER, (Fraction(1), Fraction(1)))


def reached(f, lighter):
    """Return the orbit at a friction and a second mass, continued from equal masses at f = 2/5."""
    other = replace(EQUAL, parameters=replace(PAPER, f=f))
    z, _ = continued(EQUAL, other, PAIR)
    return continued(other, replace(other, masses=(Fraction(1), lighter)), z)[1]


def test_equal_masses():
    """A pair of orbits of one mass, both with the trace of the elliptic one."""
    z, path = fixed_point(EQUAL, PAIR)
    assert z == pytest.approx(PAIR, abs=1e-4)
    assert path.least_speed == pytest.approx(0.08914, abs=1e-5)
    assert reduced_traces(path.monodromy) == pytest.approx((-0.460287, -0.460287), abs=1e-5)
    assert Continued((), tuple(z), path).kind == "close to a double pair"


def test_an_elliptic_orbit_at_unequal_masses():
    """At m = (1, 9/10), f = 91/200 nobody stops, and both pairs are on the unit circle."""
    path = reached(Fraction(91, 200), Fraction(9, 10))
    right, left = ("hit r", "meet 1 2"), ("hit l", "meet 1 2")
    assert path.words == (*right, *right, *left, *left)
    assert path.least_speed > 0.1
    M = np.diag([1, 0.9])
    J = np.block([[0 * M, -M], [M, 0 * M]])
    assert path.monodromy.T @ J @ path.monodromy == pytest.approx(J, abs=1e-10)
    high, low = reduced_traces(path.monodromy)
    assert high.imag == low.imag == 0
    assert -2 < low.real < high.real < 2


def test_at_the_papers_parameters_it_is_not_elliptic():
    """At f = 2/5, walls -1 and 1, m = (1, 9/10) one pair of multipliers is real and negative."""
    path = reached(PAPER.f, Fraction(9, 10))
    high, low = reduced_traces(path.monodromy)
    assert high.imag == low.imag == 0
    assert low.real < -2 < high.real < 2


def test_not_found():
    """No orbit to begin with, none at a mass three times as large: nothing is returned."""
    with pytest.raises(NotFound):
        fixed_point(EQUAL, (-0.5, 0.5, 0.1, -0.1))
    with pytest.raises(NotFound, match=r"before m = 1, 1\.0"):
        continued(EQUAL, replace(EQUAL, masses=(Fraction(1), Fraction(3))), PAIR)
