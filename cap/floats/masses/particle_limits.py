"""Where an orbit of two masses loses its ellipticity, and where a mass stops, in floats.

Hints for the proof of `particles_limits`, not rigorous.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction

from cap.floats.masses.particle_orbits import (
    Continued,
    NotFound,
    fixed_point,
    from_equal_masses,
    reduced_traces,
)
from cap.floats.masses.particles import Particles, Path

STEP = Fraction(1, 100)  # of the mass
NEAR = Fraction(1, 10**7)


@dataclass(frozen=True)
class Near:
    """An orbit: the second mass, the state at t = 0, a period."""

    mass: Fraction
    state: tuple[float, ...]
    path: Path

    @property
    def elliptic(self) -> bool:
        """Whether both pairs of multipliers are on the unit circle."""
        return all(not z.imag and abs(z) < 2 for z in reduced_traces(self.path.monodromy))


def limits(system: Particles) -> tuple[Near, Near]:
    """Make the second of two equal masses lighter; return the last elliptic orbit, and the last.

    Raises `NotFound`, also if the orbit does not begin as an elliptic one.
    """
    mass = system.masses[0]
    lighter = replace(system, masses=(mass, mass * (1 - STEP)))
    for found in from_equal_masses(lighter):
        if isinstance(found, Continued) and found.kind == "elliptic x elliptic":
            start = Near(lighter.masses[1], found.state, found.path)
            flip = _last(system, start, lambda near: near.elliptic)
            return flip, _last(system, flip, lambda _near: True)
    raise NotFound("no elliptic orbit of two masses, one a little lighter, was found")


def _last(system: Particles, near: Near, holds: Callable[[Near], bool]) -> Near:
    """Return the last orbit, as the mass falls, for which something holds, up to `NEAR`."""
    step = STEP
    while step > NEAR:
        following = _lighter(system, near, step)
        if following and holds(following):
            near = following
        else:
            step /= 2
    return near


def _lighter(system: Particles, near: Near, step: Fraction) -> Near | None:
    """Return the orbit for a lighter mass; None if it is not found or has other events."""
    mass = near.mass - step * system.masses[0]
    if mass <= 0:
        return None
    try:
        z, path = fixed_point(replace(system, masses=(system.masses[0], mass)), near.state)
    except NotFound:
        return None
    return Near(mass, tuple(z.tolist()), path) if path.words == near.path.words else None
