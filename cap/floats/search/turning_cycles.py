"""Attracting cycles that turn and never stick, in floats: proofs start there, nothing is proved."""

import numpy as np

from cap.floats.diagnostics.attractor import LONGEST, SAME, Attractor, attractors
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.floats.search.request import Turning
from cap.parameters import Parameters

POINTS, TRANSIENT = 20, 400  # seeds per side, and periods before a cycle is looked for


def turning_cycles(p: Parameters) -> list[Turning]:
    """Return the states at t = 0 of attracting cycles and of their mirror images."""
    found: list[Turning] = []
    unit = np.array([float(p.R), float(p.R * p.omega)])
    for each in attractors(p, points=POINTS, transient=TRANSIENT, periods=2 * LONGEST).found:
        if each.period and each.turns and not each.sticks and each.exponent < 0:
            for state in _states(p, each):
                known = (np.array([other.x, other.v]) for other in found)
                if not any((np.abs(state - other) < 10 * SAME * unit).all() for other in known):
                    found.append(_turning(p, state, each.period))
    return found


def _states(p: Parameters, cycle: Attractor) -> Floats:
    """Return the states (N, 2) of a cycle at t = 0, and those of its image."""
    later = swarm.follow(p, cycle.states, 0.5).states
    return np.concatenate([cycle.states, [float(p.l + p.r), 0.0] - later])


def _turning(p: Parameters, state: Floats, period: int) -> Turning:
    """Return a state with the derivative after a period of its cycle."""
    monodromy = swarm.follow(p, [state], period, derivative=True).monodromy
    if monodromy is None:  # it was asked for
        raise TypeError
    (a, b), (c, d) = monodromy[0].tolist()
    return Turning(float(state[0]), float(state[1]), period, ((a, b), (c, d)))
