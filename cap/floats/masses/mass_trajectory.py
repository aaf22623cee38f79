"""One orbit of N masses in time: their positions and velocities, and what happens."""

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from cap.errors import BadInput
from cap.floats.findings import Floats
from cap.floats.history import History, arrays
from cap.floats.masses.masses import OfMasses, checked, drawn, elliptic_orbit, meant, system_of
from cap.floats.masses.particles import Particles, Unresolved, follow
from cap.floats.models.trajectory import along
from cap.parameters import Parameters
from cap.runner import Runner

MOST_PERIODS = 200  # drawn


@dataclass(frozen=True, kw_only=True)
class MassTrajectory(OfMasses, History):
    """The orbit of N masses: x, v (K, N); ``before``, ``after`` (E, N); ``strobe`` (M, 2N).

    ``least_speed`` of all masses, 0 if one stops.
    """

    least_speed: float

    def columns(self) -> dict[str, Floats]:
        """Return time, positions and velocities."""
        sides = {"x": self.x, "v": self.v}
        named = {f"{k}_{i + 1}": z[:, i] for k, z in sides.items() for i in range(z.shape[1])}
        return {"t": self.t, **named}

    def lines(self) -> list[str]:
        """Return the events in their order."""
        head = f"orbit of {_state(self.strobe[0])} at {self.system}"
        stops = f"least speed {self.least_speed:.6g}" if self.least_speed else "a mass stops"
        return self.listed(head, _row, f"  ends at {_state(self.strobe[-1])}; {stops}")


def trajectory(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    masses: tuple[Fraction, ...],
    proportional: bool = False,
    state: tuple[float, ...] | None = None,
    exactly: bool = False,
    periods: float = 1,
    runner: Runner | None = None,  # noqa: ARG001 (as all commands: here there is nothing to share)
) -> MassTrajectory:
    """Return the orbit of a state; without one, that continued from equal masses, or a random one.

    Unless ``exactly``, a state is replaced by a T-periodic one near it.
    """
    system = system_of(p, masses, proportional)
    start = _start(system, state, exactly)
    n, T = len(masses), system.period
    if periods > MOST_PERIODS:
        raise BadInput(f"too many periods to be drawn: {periods:g} (at most {MOST_PERIODS})")
    try:
        path = follow(system, start[:n], start[n:], periods * T)
    except Unresolved as reason:
        raise BadInput(f"the orbit cannot be followed to its end: {reason}") from None
    legs, end = path.legs, periods * T
    samples = [along(legs, k, until, end) for k, until in enumerate(legs.end.tolist())]
    t, states = (np.concatenate(parts) for parts in zip(*samples, strict=True))
    strobe = [path.state(k * T) for k in range(math.floor(periods) + 1)]
    return MassTrajectory(
        parameters=p,
        masses=masses,
        proportional=proportional,
        period=T,
        t=t,
        x=states[:, :n],
        v=states[:, n:],
        strobe=np.array(strobe),
        least_speed=path.least_speed,
        **arrays(path.events, (n,)),
    )


def _start(system: Particles, state: tuple[float, ...] | None, exactly: bool) -> tuple[float, ...]:
    if state is not None:
        checked(system, state)
        return state if exactly else meant(system, state)
    found = elliptic_orbit(system)
    return found.state if found else tuple(drawn(system, 1, 0)[0].tolist())


def _row(t: float, word: str, x: float, before: Floats, after: Floats) -> str:
    return f"  t = {t:<14.10g} {word:<16} x = {x:< .8g}  v {_listed(before)} -> {_listed(after)}"


def _state(z: Floats) -> str:
    """Return a state in words."""
    n = len(z) // 2
    return f"x = ({_listed(z[:n])}), v = ({_listed(z[n:])})"


def _listed(values: Floats) -> str:
    return ", ".join(f"{value:.8g}" for value in values)
