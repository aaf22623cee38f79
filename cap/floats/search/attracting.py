"""Attracting cycles of Φ, as Newton's method finds them: what seems to be periodic may not be."""

import math

import numpy as np

from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters

SAME = 1e-4  # states of one cycle, in units of R and Rω
NEAR = 1e-3  # in the same units: a cycle is so near to an orbit that comes to it
STEPS, LAST = 8, 1e-10  # of Newton's method at most; the size of the last one, in the same units
ROUNDING = 1e-9  # a multiplier so near to 1 in modulus may be that of an elliptic orbit


def attracting(p: Parameters, state: Floats, period: int) -> Floats | None:
    """Return the states (n, 2) of the attracting cycle near one that seems to have a period.

    Of the divisors of that, n is the first for which Newton's method leads to a cycle nearby with
    multipliers below 1 in modulus; None if it does so for none.
    """
    for n in (n for n in range(1, period + 1) if period % n == 0):
        first = _newton(p, state, n)
        if first is not None:
            return np.asarray(swarm.follow(p, [first], n, every=True).states[0, :-1])
    return None


def growth(p: Parameters, cycle: Floats) -> float:
    """Return the larger exponent of a cycle (n, 2), per time: -inf if its multipliers are 0."""
    largest = _largest(swarm.follow(p, cycle[:1], len(cycle), derivative=True))
    time = len(cycle) * 2 * math.pi / float(p.omega)
    return math.log(largest) / time if largest else -math.inf


def first_alike(p: Parameters, cycles: list[Floats | None]) -> list[int]:
    """Return for each cycle the place of the first one that is the same; None is like no other."""
    unit = np.array([float(p.R), float(p.R * p.omega)])
    first = list[int]()
    for k, cycle in enumerate(cycles):
        same = (
            j
            for j, other in enumerate(cycles[:k])
            if cycle is not None and other is not None and len(cycle) == len(other)
            if (np.abs(cycle - other[0]) < SAME * unit).all(axis=1).any()
        )
        first.append(next(same, k))
    return first


def _newton(p: Parameters, state: Floats, n: int) -> Floats | None:
    """Return the state of an attracting cycle to which Newton's method leads, if it is near."""
    unit, z = np.array([float(p.R), float(p.R * p.omega)]), np.array(state)
    for _ in range(STEPS):
        path = swarm.follow(p, [z], n, derivative=True)
        if path.monodromy is None or not np.isfinite(path.monodromy).all():
            return None
        defect = path.states[0] - z
        step = np.linalg.lstsq(np.eye(2) - path.monodromy[0], defect, rcond=None)[0]
        if (np.abs(np.stack([step, defect])) < LAST * unit).all():
            return z if _largest(path) < 1 - ROUNDING else None
        z = z + step
        if not (np.abs(z - state) < NEAR * unit).all():
            return None
    return None


def _largest(path: swarm.Swarm) -> float:
    """Return the larger modulus of the multipliers of one orbit."""
    return float(np.abs(np.linalg.eigvals(path.derivatives[0])).max())
