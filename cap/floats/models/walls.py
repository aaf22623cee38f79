"""What the positions of a model can meet: walls, fixed or moving, as its guards say."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from cap.floats.models.identities import restitution
from cap.floats.models.spectrum import Floats, evaluated, number
from cap.system.model import Bounce, System
from cap.system.polynomial import COS, SIN, Polynomial, variable


class Wall(NamedTuple):
    """Where a guard c z + ... is zero: z = ``place`` (K,), given all else, at times or states.

    ``side``: 1 if z must be larger in the guard's mode, -1 if smaller; ``solid`` where something
    bounces there, else it passes through.
    """

    name: str
    variable: str
    side: int
    solid: bool
    place: Floats


def walls(
    system: System,
    t: Floats,
    states: Floats,
    *,
    modes: Collection[str] | None = None,
    fixed: bool = False,
) -> tuple[Wall, ...]:
    """Return the walls at times (K,) and states (K, n), each once, in these modes or in all.

    Only those that are the same for all states, if they must be ``fixed``.
    """
    omega = float(number(system.omega))
    values = dict(zip(system.state, states.T, strict=True))
    values |= {COS: np.cos(omega * t), SIN: np.sin(omega * t)}
    found: dict[tuple[str, Polynomial], Wall] = {}
    for mode, word, z, h in _guards(system):
        c = h.derivative(z)
        q = variable(z) - h / c
        if (fixed and q.variables & set(system.state)) or mode not in (modes or system.modes):
            continue
        place = np.broadcast_to(evaluated(q, values), t.shape).astype(float)
        side = 1 if float(number(c)) > 0 else -1
        solid = any(_bounces(system, mode, word, to) for to in system.guard(mode, word).to)
        known = found.get((z, q))
        if known is None or (solid and not known.solid):
            found[z, q] = Wall(word, z, side, solid, place)
    return tuple(found.values())


class Surface(NamedTuple):
    """Where a guard is zero at one time, in a plane of two positions: ``second`` over ``first``."""

    name: str
    first: Floats
    second: Floats


def surface(
    system: System, mode: str, word: str, time: float, plane: tuple[str, str], first: Floats
) -> Surface | None:
    """Return where a guard is zero in a plane at a time, None if it does not tell that."""
    h = system.guard(mode, word).value
    c, omega = h.derivative(plane[1]), float(number(system.omega))
    if not _is_simple(c):
        return None
    q = variable(plane[1]) - h / c
    if q.variables - {plane[0], COS, SIN}:
        return None
    values = {plane[0]: first, COS: np.cos(omega * time), SIN: np.sin(omega * time)}
    return Surface(word, first, np.broadcast_to(evaluated(q, values), first.shape).astype(float))


def _guards(system: System) -> list[tuple[str, str, str, Polynomial]]:
    """Return mode, name, variable and value of each guard that can be solved for a variable."""
    listed = []
    for name, mode in system.modes.items():
        for word, guard in mode.guards.items():
            h = guard.value
            z = next((z for z in _ordered(system) if _is_simple(h.derivative(z))), None)
            if z is not None:
                listed.append((name, word, z, h))
    return listed


def _ordered(system: System) -> list[str]:
    """Return the positions before the velocities."""
    return sorted(system.state, key=lambda z: system.velocity_of(z) is None)


def _is_simple(q: Polynomial) -> bool:
    """Return whether a slope is a number with an inverse."""
    return bool(q) and q.is_number and len(q.terms) == 1


def _bounces(system: System, mode: str, word: str, to: str) -> bool:
    """Return whether a position is turned round at an event."""
    guard = system.guard(mode, word)
    h = guard.value
    if not any(h.derivative(z) and system.velocity_of(z) for z in system.state):
        return False
    if isinstance(guard.reset, Bounce):
        return True
    e = restitution(system, mode, word, to)
    return e is not None and e >= 0
