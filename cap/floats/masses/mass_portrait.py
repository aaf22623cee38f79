"""Stroboscopic portraits of N masses: the island of an orbit, and where other orbits end."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.errors import BadInput
from cap.floats.findings import Floats
from cap.floats.masses.mass_swarm import Seeds, swarm
from cap.floats.masses.masses import OfMasses, drawn, elliptic_orbit, meant, system_of
from cap.floats.masses.particles import Particles
from cap.parameters import Parameters
from cap.runner import Runner

MOST = 200_000  # orbits x periods


@dataclass(frozen=True, kw_only=True)
class MassPortrait(OfMasses):
    """The states (M, K, 2N) of M orbits at t = 0, T, …, nan where one cannot be followed.

    ``stopped`` (M,): a mass turns or rests at some time.  ``near`` (M,): it begins near ``centre``,
    a T-periodic orbit on which no mass stops, or None; the others begin anywhere.
    """

    states: Floats
    stopped: NDArray[np.bool_]
    near: NDArray[np.bool_]
    centre: tuple[float, ...] | None

    @property
    def never(self) -> NDArray[np.bool_]:
        """The orbits on which no mass stops, of those that were followed to their end."""
        return np.asarray(~self.stopped & np.isfinite(self.states).all(axis=(1, 2)))

    def columns(self) -> dict[str, ArrayLike]:
        """Return one row for each orbit and period."""
        orbit, time = np.indices(self.states.shape[:2])
        n = self.states.shape[2] // 2
        named = {f"{'xv'[k // n]}_{k % n + 1}": self.states[..., k] for k in range(2 * n)}
        return {"orbit": orbit, "period": time, **named, "stopped": self.stopped[:, None]}

    def lines(self) -> list[str]:
        """Return how many orbits never stop, of those near the periodic orbit and of the others."""
        count, periods = self.states.shape[0], self.states.shape[1] - 1
        followed = np.isfinite(self.states).all(axis=(1, 2))
        rows = [f"stroboscopic portrait at {self.system}: {count} orbits, {periods} periods"]
        if self.centre:
            rows.append(f"  around ({', '.join(f'{z:.10g}' for z in self.centre)})")
        for chosen, words in ((self.near, "that begin near it"), (~self.near, "from anywhere")):
            if chosen.any():
                never = int((chosen & self.never).sum())
                rows.append(f"  on {never} of the {int(chosen.sum())} orbits {words} no mass stops")
        lost = int((~followed).sum())
        return [*rows, *([f"  {lost} are lost (contacts accumulate), or not done"] if lost else [])]


def portrait(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    masses: tuple[Fraction, ...],
    proportional: bool = False,
    state: tuple[float, ...] | None = None,
    radius: float | None = None,
    orbits: int = 40,
    periods: int = 100,
    runner: Runner | None = None,
) -> MassPortrait:
    """Follow orbits from a ball around a T-periodic orbit, and as many from anywhere.

    The ball has the radius ``radius`` (default 1/250) in units of R and Rω.
    """
    runner = runner or Runner()
    if orbits * (periods + 1) > MOST:
        raise BadInput(f"too many points: {orbits} orbits x {periods} periods (at most {MOST})")
    system = system_of(p, masses, proportional)
    centre = _centre(system, state)
    others = orbits // 2 if centre else orbits
    starts = drawn(system, others, 1)
    if centre:
        starts = np.concatenate([_ball(system, centre, radius or 1 / 250, orbits - others), starts])
    found = swarm(Seeds(system, periods), starts, runner, "portrait")
    return MassPortrait(
        parameters=p,
        complete=not runner.interrupted,
        masses=masses,
        proportional=proportional,
        states=found.states,
        stopped=np.asarray(found.stopped.any(axis=1)),
        near=np.arange(len(starts)) < len(starts) - others,
        centre=centre,
    )


def _centre(system: Particles, state: tuple[float, ...] | None) -> tuple[float, ...] | None:
    if state is not None:
        return meant(system, state)
    found = elliptic_orbit(system)
    return found.state if found else None


def _ball(system: Particles, centre: tuple[float, ...], radius: float, count: int) -> Floats:
    """Return points in a ball, evenly, in units of R and Rω."""
    p, n, random = system.parameters, len(system.masses), np.random.default_rng(2)
    direction = random.normal(size=(count, 2 * n))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    reach = radius * ((np.arange(count) + 0.5) / count) ** (1 / (2 * n))
    units = np.repeat([float(p.R), float(p.R * p.omega)], n)
    points = np.array(centre) + reach[:, None] * direction * units
    walls = float(p.l), float(p.r)
    inside = np.diff(points[:, :n], prepend=walls[0], append=walls[1]).min(axis=1) > 0
    if not inside.any():
        raise BadInput("the radius is too large: no orbit starts between the walls")
    return np.asarray(points[inside])
