"""Theorem particles_stability: orbits in floats from the ellipsoid; refusals."""

import math

import numpy as np
import pytest

import cap
from cap.errors import BadInput
from cap.floats.masses.particles import Particles, follow

THEOREM = "particles_stability"
OPTIONS = {"masses": "1,9/10", "f": "91/200"}


@pytest.mark.slow
def test_orbits_stay_in_the_ellipsoid():
    """From the boundary of the inner one, for what floats can follow; nobody stops."""
    proved = cap.prove_theorem(THEOREM, periods=10**5, digits=15, **OPTIONS)
    A = np.array([[float(q) for q in row] for row in proved.claims["axes"]])
    c = np.array([float(q) for q in proved.claims["centre"]])
    p = cap.parameters.Parameters(*(proved.parameters[k] for k in ("F", "omega", "f", "l", "r")))
    system = Particles(p, proved.parameters["masses"])
    random = np.random.default_rng(1)
    for _ in range(5):
        u = random.normal(size=4)
        z = c + A @ (u / np.linalg.norm(u) * float(proved.claims["part"]))
        for _ in range(60):
            path = follow(system, z[:2], z[2:], 2 * math.pi)
            z = np.array([*path.x, *path.v])
            assert path.least_speed > 0
            assert np.linalg.norm(np.linalg.solve(A, z - c)) < 1


@pytest.mark.parametrize(
    ("options", "phrase"),
    [
        ({}, "--masses"),
        ({"masses": "1,9/10", "periods": 0}, "--periods must be an integer"),
        ({"masses": "1,9/10", "e": "9/10"}, "e"),
    ],
)
def test_bad_input(options, phrase):
    """Each in a line that names what is wrong."""
    with pytest.raises(BadInput, match=phrase):
        cap.prove_theorem(THEOREM, **options)
