"""The stroboscopic map backwards, for elastic walls and dry friction.

With y(τ) = x(-τ), y'' = F cos ωτ + f sgn y': friction becomes a push, and a flight can end but at a
wall or in a turn.  Many orbits end in one stick: that of the push is the one which did
not stick.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from cap.errors import BadInput
from cap.floats.engine import events
from cap.floats.engine.events import Log
from cap.floats.engine.flight import FULL_TURN, Constants
from cap.floats.findings import Floats
from cap.flow.words import WORDS
from cap.parameters import Parameters


def retrace(p: Parameters, states: ArrayLike, periods: int) -> Floats:
    """Return (N, 2) the states ``periods`` T before those given, which are at t = 0 mod T.

    nan for states that are lost, as in `cap.floats.engine.swarm`.
    """
    if not p.conserves:
        raise BadInput("orbits are followed backwards for e = 1 and mu = 0 only")
    given = np.asarray(states, dtype=float)
    length, speed = float(p.F / p.omega**2), float(p.F / p.omega)
    l, r = float(p.l), float(p.r)
    x, v = given.T
    right = r - x < x - l
    depth = np.where(right, r - x, x - l) / length
    rows = np.stack([-v / speed, np.where(right, 1.0, -1.0), depth], axis=-1)[:, None].copy()
    n, kinds = len(rows), len(WORDS)
    counts, first = np.zeros((n, kinds), dtype=np.int64), np.full((n, kinds), np.nan)
    log = Log(counts, first, np.zeros((n, 2), dtype=np.bool_), np.empty((0, 7)))
    ends = np.full(periods, FULL_TURN)
    events.follow(_pushed(p), ends, rows, np.empty((n, 0, 4)), log)
    velocity, wall, depth = rows[:, 0].T
    x = np.where(wall > 0, r - depth * length, l + depth * length)
    return np.stack([np.clip(x, l, r), -velocity * speed], axis=-1)


def _pushed(p: Parameters) -> Constants:
    """Return the system with negative friction; its slow and fast times follow from the ratio."""
    ratio = -float(p.f / p.F)
    arc = math.acos(ratio)
    knots = -arc, math.pi - arc, arc, math.pi + arc
    width = float(p.R * p.omega**2 / p.F)
    return Constants(ratio, 0.0, 1.0, width, 0.0, *(knot % FULL_TURN for knot in knots))
