"""Families of periodic orbits: those that touch no wall may be shifted in x.

Far from the walls v obeys an equation without x, and the difference of two solutions never grows:
(v - u)' = -f (sgn v - sgn u) - μ (v - u).  If both have the period T and the mean 0, it is constant
and so 0.  So one velocity, as a function of time, is that of all T-periodic orbits that touch no
wall, and those of period nT are the same.  They exist where it covers less than R.
"""

from dataclasses import dataclass, replace

import numpy as np

from cap.errors import BadInput
from cap.floats.search.cycles import StroboscopicMap
from cap.flow.itinerary import Path
from cap.parameters import Parameters

ROOM = 100  # walls out of reach, in units of F/ω²; a free orbit covers at most 2
STEPS = 100
CLOSE = 1e-13  # the last change of v, in units of F/ω


@dataclass(frozen=True)
class Family:
    """T-periodic orbits that touch no wall: at t = 0 all x in (``low``, ``high``), and one v.

    ``stroke`` is the length that each covers, less than R; ``turns`` and ``sticks`` per period.
    """

    low: float
    high: float
    v: float
    stroke: float
    turns: int
    sticks: int

    def line(self) -> str:
        """Return it in words."""
        return (
            f"x in ({self.low:.6g}, {self.high:.6g}), v = {self.v:.6g} at t = 0; each covers "
            f"{self.stroke:.6g}; 0 hits, {self.turns} turns, {self.sticks} sticks"
        )


def families(p: Parameters) -> tuple[Family, ...]:
    """Return the family of T-periodic orbits that touch no wall, if they have room."""
    far = ROOM * p.F / p.omega**2
    path, v = _settled(StroboscopicMap(replace(p, l=-far, r=far)), float(p.F / p.omega))
    places = [0.0, *(event.x for event in path.events)]
    low, high = float(p.l) - min(places), float(p.r) - max(places)
    if not low < high:
        return ()
    kinds = [word.split()[0] for word in path.words]
    stroke = max(places) - min(places)
    return (Family(low, high, v, stroke, kinds.count("turn"), kinds.count("stick")),)


def _settled(free: StroboscopicMap, unit: float) -> tuple[Path, float]:
    """Return the periodic orbit from x = 0 between walls out of reach, and its v at t = 0.

    By Newton's method for v alone: a shift in x changes nothing.
    """
    v = 0.0
    for _ in range(STEPS):
        path = free.path((0.0, v))
        defect = np.array(free.defect(path, (0.0, v))) / [unit * free.T, unit]
        slope = np.array([path.monodromy[0][1] / free.T, path.monodromy[1][1] - 1])
        step = -float(slope @ defect / (slope @ slope)) * unit
        if abs(step) < CLOSE * unit:
            return path, v
        v += step
    raise BadInput("the free oscillation of the mass was not found: Newton's method fails")
