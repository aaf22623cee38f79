"""One orbit of N masses in time: their positions and velocities, and what happens."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from cap.errors import BadInput
from cap.floats.findings import Floats
from cap.floats.history import History, arrays
from cap.floats.masses.masses import OfMasses, checked, drawn, elliptic_orbit, meant, system_of
from cap.floats.masses.particle_orbits import period
from cap.floats.masses.particles import Event, Particles, Path, Unresolved, follow
from cap.parameters import Parameters
from cap.runner import Runner

SAMPLES = 300  # in a period
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
    n, T = len(masses), period(system)
    if periods > MOST_PERIODS:
        raise BadInput(f"too many periods to be drawn: {periods:g} (at most {MOST_PERIODS})")
    try:
        path = follow(system, start[:n], start[n:], periods * T)
        strobe = _strobe(system, start, math.floor(periods))
    except Unresolved as reason:
        raise BadInput(f"the orbit cannot be followed to its end: {reason}") from None
    samples = np.array(list(_samples(system, start, path, periods * T)))
    return MassTrajectory(
        parameters=p,
        masses=masses,
        proportional=proportional,
        period=T,
        t=samples[:, 0],
        x=samples[:, 1 : n + 1],
        v=samples[:, n + 1 :],
        strobe=strobe,
        least_speed=path.least_speed,
        **arrays(path.events, (n,)),
    )


def _start(system: Particles, state: tuple[float, ...] | None, exactly: bool) -> tuple[float, ...]:
    if state is not None:
        checked(system, state)
        return state if exactly else meant(system, state)
    found = elliptic_orbit(system)
    return found.state if found else tuple(drawn(system, 1, 0)[0].tolist())


def _strobe(system: Particles, state: tuple[float, ...], periods: int) -> Floats:
    """Return the states at t = 0, T, …"""
    n, T, states = len(system.masses), period(system), [state]
    for k in range(periods):
        path = follow(system, states[-1][:n], states[-1][n:], (k + 1) * T, k * T)
        states.append((*path.x, *path.v))
    return np.array(states)


def _samples(
    system: Particles, state: tuple[float, ...], path: Path, end: float
) -> Iterator[list[float]]:
    """Give (t, x, v) along flights and rests, their ends included."""
    n, o = len(system.masses), system.oscillators()[0]
    force = float(o.forcing(o.moment(0.0)))
    signs = [_sign(v) or _sign(force) * (abs(force) > system.oscillators()[i].f)
             for i, v in enumerate(state[n:])]  # fmt: skip
    t, x, v = 0.0, state[:n], state[n:]
    last = Event("", end, math.nan, (), (), ())
    for event in (*path.events, last):
        yield from _between(system, (t, x, v), signs, event.time)
        if event.word:
            t, x, v = event.time, event.positions, event.after
            yield [t, *x, *event.before]
            yield [t, *x, *v]
            signs = _signs(signs, event)


def _sign(v: float) -> int:
    return int(v > 0) - int(v < 0)


def _signs(signs: list[int], event: Event) -> list[int]:
    """Return the directions after an event; 0 at rest."""
    kind, *rest = event.word.split()
    if kind in ("hit", "meet"):
        return [_sign(v) for v in event.after]
    changed = {"stick": 0, "turn": 1, "release": 1}[kind]
    side = -1 if rest[-1] == "left" else 1
    return [changed * side if k == int(rest[0]) - 1 else s for k, s in enumerate(signs)]


def _between(
    system: Particles,
    start: tuple[float, Sequence[float], Sequence[float]],
    signs: Sequence[int],
    end: float,
) -> Iterator[list[float]]:
    """Give samples of the time between two events."""
    t, x, v = start
    oscillators = system.oscillators()
    moment = oscillators[0].moment(t)
    flights = [o.launch(s, moment, a, b) if s else None
               for o, s, a, b in zip(oscillators, signs, x, v, strict=True)]  # fmt: skip
    count = max(2, math.ceil(SAMPLES * (end - t) / period(system)))
    for k in range(count + 1):
        at = oscillators[0].moment(t + (end - t) * k / count)
        pairs = [(o.position(flight, at), o.velocity(flight, at)) if flight else (a, 0.0)
                 for o, flight, a in zip(oscillators, flights, x, strict=True)]  # fmt: skip
        yield [at.t, *(place for place, _ in pairs), *(speed for _, speed in pairs)]


def _row(t: float, word: str, x: float, before: Floats, after: Floats) -> str:
    return f"  t = {t:<14.10g} {word:<16} x = {x:< .8g}  v {_listed(before)} -> {_listed(after)}"


def _state(z: Floats) -> str:
    """Return a state in words."""
    n = len(z) // 2
    return f"x = ({_listed(z[:n])}), v = ({_listed(z[n:])})"


def _listed(values: Floats) -> str:
    return ", ".join(f"{value:.8g}" for value in values)
