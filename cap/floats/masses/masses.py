"""What explorations of N masses share: the system asked for, a state to begin with, N in words."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from cap.errors import BadInput
from cap.floats.findings import Findings, Floats
from cap.floats.masses.particle_orbits import (
    Continued,
    NotFound,
    fixed_point,
    from_equal_masses,
)
from cap.floats.masses.particles import Particles, Unresolved, follow
from cap.floats.words import described, short
from cap.parameters import Parameters
from cap.system.masses import MOST

NEAR = 1e-2  # of R and Rω: a periodic orbit so near a state is meant


@dataclass(frozen=True, kw_only=True)
class OfMasses(Findings):
    """Findings about these masses; ``proportional``: the friction is f m_i, not f."""

    masses: tuple[Fraction, ...]
    proportional: bool

    def given(self) -> dict[str, str]:
        """Return parameters and masses exactly."""
        law = {"friction": "f m"} if self.proportional else {}
        return super().given() | {"masses": " ".join(map(str, self.masses)), **law}

    @property
    def system(self) -> str:
        """The parameters and masses for a line of text."""
        law = ", friction f m" if self.proportional else ""
        masses = ", ".join(short(str(m)) for m in self.masses)
        return f"{described(self.parameters)}, m = ({masses}){law}"


def system_of(p: Parameters, masses: tuple[Fraction, ...], proportional: bool) -> Particles:
    """Return the system; `BadInput` for masses that are none, or too many."""
    if len(masses) > MOST:
        raise BadInput(f"too many masses: {len(masses)} (at most {MOST})")
    return Particles(p, masses, proportional)


def elliptic_orbit(system: Particles) -> Continued | None:
    """Return the orbit on which no mass stops, continued from two equal masses, or None.

    Of several the first that is elliptic in both planes, else the first.
    """
    first = None
    for found in from_equal_masses(system) if len(system.masses) == 2 else ():
        if isinstance(found, Continued):
            first = first or found
            if found.kind == "elliptic x elliptic":
                return found
    return first


def checked(system: Particles, state: tuple[float, ...]) -> tuple[Floats, Floats]:
    """Return positions and velocities; `BadInput` unless the orbit can begin there."""
    n = len(system.masses)
    if len(state) != 2 * n:
        raise BadInput(f"--state needs {2 * n} numbers: {n} positions, then {n} velocities")
    x, v = np.array(state[:n]), np.array(state[n:])
    try:
        follow(system, x.tolist(), v.tolist(), 1e-3 * system.period)
    except Unresolved as reason:
        raise BadInput(f"the orbit cannot be followed: {reason}") from None
    return x, v


def meant(system: Particles, state: tuple[float, ...]) -> tuple[float, ...]:
    """Return the T-periodic state on whose orbit no mass stops near a state, or the state."""
    checked(system, state)
    try:
        found, _ = fixed_point(system, state)
    except NotFound:
        return state
    p, n = system.parameters, len(system.masses)
    units = np.repeat([float(p.R), float(p.R * p.omega)], n)
    return tuple(found.tolist()) if (np.abs(found - state) < NEAR * units).all() else state


def drawn(system: Particles, count: int, seed: int) -> Floats:
    """Return random states (count, 2N): places anywhere, velocities up to 2F/(ωm) + Rω/2."""
    p, n, random = system.parameters, len(system.masses), np.random.default_rng(seed)
    x = np.sort(random.uniform(float(p.l), float(p.r), (count, n)), axis=1)
    tops = [2 * float(p.F / (p.omega * m)) + float(p.R * p.omega) / 2 for m in system.masses]
    v = random.uniform(-1, 1, (count, n)) * np.array(tops)
    return np.concatenate([x, v], axis=1)
