"""Homoclinic orbits of a saddle of Φ in floats: where from on the unstable curve they start.

The unstable curve is followed from a fundamental domain p = ±START |λ|^τ, 0 <= τ < 1, along the
unstable direction.  Where it comes back to the saddle and passes from one side of the stable
direction to the other, between two neighbours that are near, it has crossed the stable curve:
nearly, as that is curved; a proof mends it.
"""

from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix

START = 1e-5  # distance from the saddle, in units of the frame
NEAR = 0.1  # what counts as back at the saddle, in the same units
POINTS = 4000  # of each half of the fundamental domain
PERIODS = 40  # at most


class Excursion(NamedTuple):
    """A homoclinic orbit, nearly: it starts at P* + start u, and is back after ``periods``.

    u is the first column of the frame.
    """

    start: float
    periods: int


class Saddle(NamedTuple):
    """P*, its unstable and stable direction as columns, and the multiplier outside the circle."""

    state: Floats
    frame: Floats
    multiplier: float

    @classmethod
    def of(cls, box: Box, frame: Matrix[Fraction], multiplier: Ball) -> "Saddle":
        """Return the floats near what is proved."""
        state = np.array([float(z.mid()) for z in box])
        return cls(state, np.array(frame, dtype=float), float(multiplier.mid()))


def excursions(p: Parameters, saddle: Saddle, most: int) -> list[Excursion]:
    """Return up to ``most`` orbits, those that come back first; orbits that turn are left out."""
    tau = np.linspace(0, 1, POINTS, endpoint=False)
    half = START * abs(saddle.multiplier) ** tau
    starts, back = np.concatenate([-half[::-1], half]), np.linalg.inv(saddle.frame)
    states = saddle.state + starts[:, None] * saddle.frame[:, 0]
    alive, found = np.ones(len(starts), dtype=bool), list[Excursion]()
    away = np.zeros(len(starts), dtype=bool)
    for periods in range(1, PERIODS + 1):
        step = swarm.follow(p, states, 1)
        alive &= ~(step.stopped | step.lost)
        states = np.where(alive[:, None], step.states, np.nan)
        along = (states - saddle.state) @ back.T
        near = np.hypot(*along.T) < NEAR
        away |= np.hypot(*along.T) > 2 * NEAR
        passed = near[1:] & near[:-1] & (away[1:] & away[:-1])
        passed &= (along[1:, 0] > 0) != (along[:-1, 0] > 0)
        passed[POINTS - 1] = False  # between the two halves of the domain
        for k in np.flatnonzero(passed):
            a, b = along[k, 0], along[k + 1, 0]
            start = float(starts[k] + (starts[k + 1] - starts[k]) * a / (a - b))
            if all(abs(start - other.start) > 0.02 * abs(start) for other in found):
                found.append(Excursion(start, periods))
        if len(found) >= most or not alive.any():
            break
    return found[:most]
