"""Chains of islands around an elliptic fixed point: elliptic orbits of period qT that never turn.

They are searched for with Newton's method on Φ^q from seeds in the island; others may exist.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from cap.floats.diagnostics.rotation import linear
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.search import newton
from cap.parameters import Parameters

LONGEST = 0.01  # step of Newton's method, in units of R and Rω: an island is small
CENTRE = 1e-3  # distance from the fixed point, in the same units, that an orbit of a chain keeps
NEAR = 0.05  # difference of rotation numbers from that at the fixed point


@dataclass(frozen=True)
class Chain:
    """An elliptic orbit (q, 2) that turns ``number`` = p/q times around the centre per period."""

    number: Fraction
    states: Floats
    trace: float


def chains(p: Parameters, centre: State, seeds: Floats, largest: int) -> list[Chain]:
    """Return one orbit of each chain found with q <= ``largest``, by descending p/q.

    Only q are tried for which a p/q lies within `NEAR` of the rotation number at the centre.
    """
    turn, frame = linear(p, centre)
    inverse = np.asarray(np.linalg.inv(frame), dtype=float)
    found: dict[Fraction, Chain] = {}
    for q in range(2, largest + 1):
        if not any(math.gcd(k, q) == 1 and abs(k / q - turn) < NEAR for k in range(1, q)):
            continue
        states = newton.reached(p, q, seeds, LONGEST)
        for chain in _elliptic(p, np.array(centre), states, q, (turn, inverse)):
            found.setdefault(chain.number, chain)
    return [found[number] for number in sorted(found, reverse=True)]


def _elliptic(
    p: Parameters, centre: Floats, states: Floats, q: int, turned: tuple[float, Floats]
) -> list[Chain]:
    """Return the elliptic orbits among those of period qT through states (N, 2)."""
    if not len(states):
        return []
    whole = swarm.follow(p, states, q, derivative=True)
    trace = np.trace(whole.derivatives, axis1=1, axis2=2)
    keeps = (np.abs(trace) < 2) & ~whole.stopped
    orbits = swarm.follow(p, states[keeps], q, every=True).states
    guess, inverse = turned
    plane = (orbits - centre) @ inverse.T
    z = plane[..., 0] + 1j * plane[..., 1]
    steps = z[:, 1:] * z[:, :-1].conj() * np.exp(-2j * np.pi * guess)  # half a turn at most
    turns = np.angle(steps).sum(axis=1) / (2 * np.pi) + q * guess
    far = np.abs(orbits - centre).max(axis=(1, 2)) > CENTRE * float(p.R)
    return [
        Chain(Fraction(k, q), orbit[:-1], float(t))
        for k, orbit, t, ok in zip(np.rint(turns).astype(int).tolist(), orbits, trace[keeps], far,
                                   strict=True)
        if ok and math.gcd(k, q) == 1
    ]  # fmt: skip
