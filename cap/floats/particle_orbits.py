"""T-periodic orbits of N masses in floats: Newton's method, and continuation in the system.

Hints for a proof, not rigorous.  Two equal masses move as two masses alone that exchange their
names when they meet; so a pair of orbits of one mass is an orbit to start from.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from cap.errors import BadInput
from cap.floats.particles import Floats, Particles, Path, Unresolved, follow

STEPS = 20
CLOSE = 1e-12  # of Newton's steps, beside the size of the state


class NotFound(Exception):
    """Newton's method does not converge to a T-periodic orbit on which no mass stops."""


def period(system: Particles) -> float:
    """Return T = 2π/ω."""
    return 2 * math.pi / float(system.parameters.omega)


def fixed_point(system: Particles, state: Sequence[float]) -> tuple[Floats, Path]:
    """Return the state (x, v) at t = 0 of a T-periodic orbit near ``state``, and the orbit.

    Raises `NotFound`.
    """
    z, n, T = np.array(state, dtype=np.float64), len(system.masses), period(system)
    for _ in range(STEPS):
        try:
            path = follow(system, z[:n].tolist(), z[n:].tolist(), T)
            miss = np.array([*path.x, *path.v]) - z
            move = np.linalg.solve(path.monodromy - np.eye(2 * n), miss)
        except (BadInput, Unresolved, np.linalg.LinAlgError) as reason:
            raise NotFound(f"Newton's method leads astray: {reason}") from None
        if np.abs(move).max() < CLOSE * (1 + np.abs(z).max()) and path.least_speed > 0:
            return z, path
        z = z - move
    raise NotFound("Newton's method does not converge to an orbit on which no mass stops")


def continued(systems: Iterable[Particles], state: Sequence[float]) -> tuple[Floats, Path]:
    """Return the `fixed_point` of the last system, each found from that of the system before.

    Raises `NotFound`, also if on the way the itinerary changes.
    """
    z, path, words = np.array(state, dtype=np.float64), None, None
    for system in systems:
        z, path = fixed_point(system, z.tolist())
        if path.words != (words or path.words):
            raise NotFound(f"the itinerary changes: {path.words}")
        words = path.words
    if path is None:
        raise NotFound("there is no system to continue to")
    return z, path


def reduced_traces(monodromy: Floats) -> tuple[complex, complex]:
    """Return z = λ + 1/λ of the multipliers λ of two masses: of a palindromic polynomial.

    With a = tr D and b = (a² - tr D²)/2 they are (a ± sqrt(a² - 4b + 8))/2; both real, different
    and in (-2, 2): two pairs on the unit circle.
    """
    a = float(np.trace(monodromy))
    b = (a * a - float(np.trace(monodromy @ monodromy))) / 2
    root = complex(a * a - 4 * b + 8) ** 0.5
    return (a + root) / 2, (a - root) / 2
