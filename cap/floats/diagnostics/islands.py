"""How large the island around an elliptic orbit is, in floats.

On rays from P*, in axes in which the derivative at P* is a rotation, the motions of more and more
distant states are followed: what is nearer than the first that stops is counted.
"""

import math
from typing import NamedTuple

import numpy as np

from cap.errors import NotProved
from cap.floats.engine import swarm
from cap.floats.search import periodic, tori
from cap.parameters import Parameters

RAYS, PERIODS = 16, 200
RADII = np.geomspace(2e-4, 0.3, 90)  # in units F/ω² and F/ω


class Island(NamedTuple):
    """The map, of ``halves`` half periods, turns by so many turns at P*; the area around it."""

    halves: int
    turns: float
    area: float


def island(p: Parameters) -> Island | None:
    """Return the island of an elliptic orbit with one hit of each wall per period, if one is found.

    Of a pair of orbits, images of each other, the one with the smaller x.
    """
    elliptic = [guess for guess in periodic.orbits(p, 2) if guess.kind == "elliptic"]
    guess = min(elliptic, key=lambda guess: guess.x, default=None)
    if guess is None:
        return None
    try:
        at = tori.of_orbit(p, guess.x, guess.v)
    except NotProved:
        return None
    return Island(at.halves, at.angle / (2 * math.pi), area(p, at))


def area(p: Parameters, at: tori.Centre) -> float:
    """Return the area of what is nearer to P* than states that stop within `PERIODS` periods."""
    psi = 2 * math.pi * np.arange(RAYS) / RAYS
    rays = np.stack([np.cos(psi), np.sin(psi)], axis=-1) @ at.frame.T
    states = at.point + RADII[:, None, None] * rays
    scale = np.array([float(p.F / p.omega**2), float(p.F / p.omega)])
    states = states * scale + [float(p.l + p.r) / 2, 0]
    found = swarm.follow(p, states.reshape(-1, 2), PERIODS)
    stops = (found.stopped | found.lost).reshape(len(RADII), RAYS)
    first = np.where(stops.any(axis=0), stops.argmax(axis=0), len(RADII))
    reach = np.concatenate([[0.0], RADII])[first]
    return float(math.pi * np.mean(reach**2) * scale.prod())
