"""Random cells at random parameters, and what the float flow says of states of theirs."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
from random_orbits import parameters

from cap.floats.engine import swarm
from cap.parameters import PAPER

DAMPED = replace(PAPER, e=Fraction(7, 10), mu=Fraction(1, 10))
SHIFTED = replace(PAPER, F=Fraction(2), omega=Fraction(3), f=Fraction(4, 5), r=Fraction(-1, 3))
ALMOST = 1e-7  # of the natural units: what floats may differ by, where nothing is near a border


def system(random):
    """Return random parameters; those of the paper are among them."""
    return random.choice((PAPER, DAMPED, SHIFTED)) if random.random() < 0.3 else parameters(random)


def cells(random, p, count, width):
    """Return cells of about this width, relative to the gap and the speed of the forcing."""
    speed, found = float(p.F / p.omega), []
    for _ in range(count):
        x = float(p.l) + float(p.R) * random.uniform(0.01, 0.99)
        v = speed * random.uniform(-2.5, 2.5)
        far, fast = (width * random.uniform(0.1, 1) * unit for unit in (float(p.R), speed))
        found.append((x, x + far, v, v + fast))
    return np.array(found)


def states(random, p, cell, count):
    """Return states of a cell between the walls, corners among them."""
    (x, X, v, V), found = cell, []
    x, X = max(x, float(p.l)), min(X, float(p.r))
    for _ in range(count):
        parts = [random.choice((0.0, 1.0, random.random())) for _ in "xv"]
        found.append((x + parts[0] * (X - x), v + parts[1] * (V - v)))
    found = np.array(found)
    eps = 1e-9 * float(p.R)
    found[:, 0] = np.clip(found[:, 0], float(p.l) + eps, float(p.r) - eps)
    return found


def followed(p, points, periods):
    """Return the float orbits, and which of them are neither lost nor near a border of events."""
    orbits = swarm.follow(p, points, periods, derivative=True)
    return orbits, ~(orbits.lost | orbits.grazing) & np.isfinite(orbits.states).all(axis=1)
