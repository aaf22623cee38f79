"""The map from the time of a release to that of the next, in doubles: a table over a period.

A release is a contact that gives the state after it by its time (`cap.system.release`).  What is
found here is where the map has the same contacts, and what its orbits come to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import nan

import numpy as np
from numpy.typing import NDArray

from cap.floats.models.engine import Engine
from cap.floats.models.spectrum import Floats, evaluated, number
from cap.orbits.itinerary import Contact
from cap.system.model import System
from cap.system.polynomial import COS, PI, SIN
from cap.system.release import Release, releases

GRID = 600  # releases in a period of the clock
LONG, LOG = 24, 96  # periods and events in which the next release is looked for
AT_ONCE = 1e-9  # events sooner after a release belong to it
SEEDS, SETTLING, KEPT, LONGEST = 50, 400, 400, 8  # orbits, steps, and rounds of one that closes
SAME = 1e-6  # of a period
JUMP = 12.0  # slopes that are no jumps


Following = tuple[tuple[Contact, ...], list[float]]


class Table:
    """Releases over a period, each with the contacts that follow."""

    def __init__(self, engine: Engine, release: Release) -> None:
        self.engine, self.release = engine, release
        self.omega = float(number(release.system.omega))
        self.period = 2 * np.pi / self.omega
        self.falling = release.system.lie(release.mode, release.value)
        self.first = Contact(release.mode, release.guard, release.to)

    def state(self, t: float) -> dict[str, float] | None:
        """Return the state after a release at a time, or nothing if none is then."""
        system, angle = self.release.system, self.omega * t
        known = dict.fromkeys(system.state, 0.0) | {COS: np.cos(angle), SIN: np.sin(angle)}
        known[self.release.fixed] = evaluated(self.release.place, known)
        top = {z: evaluated(q.numerator, known) for z, q in self.release.reset.items()}
        bottom = {z: evaluated(q.denominator, known) for z, q in self.release.reset.items()}
        after = {z: top[z] / bottom[z] for z in system.state}
        told = self.falling.variables <= {self.release.fixed, COS, SIN, PI}
        return None if told and evaluated(self.falling, known) >= 0 else after

    def after(self, t: float) -> Following | None:
        """Return the contacts from a release on, and the times of those that follow, or nothing."""
        state, first = self.state(t), self.first
        if state is None:
            return None
        start, angle = [[*state.values()]], self.omega * t
        ends = self.engine.follow(start, [first.to], periods=LONG, phase=angle, log=LOG)
        mode, listed, times = first.to, [first], list[float]()
        for _, time, word, to, *_ in ends.log:
            name, then = self.engine.words[int(word)], self.engine.modes[int(to)]
            contact, mode = Contact(mode, name, then), then
            if time < AT_ONCE:
                continue
            if name == self.engine.words[-1]:
                return None
            times.append(t + float(time))
            if contact == first:
                return tuple(listed), times
            listed.append(contact)
        return None

    def rows(self) -> Iterator[tuple[tuple[Contact, ...], Floats, Floats]]:
        """Yield what is continuous: the contacts, times of releases, and those of what follows."""
        grid: Floats = np.arange(2.0 * GRID) * (self.period / GRID)
        one = [self.after(t) for t in grid[:GRID].tolist()]
        found = one + [row and (row[0], [t + self.period for t in row[1]]) for row in one]
        breaks = [k for k, (a, b) in enumerate(pairwise(found)) if self._parted(a, b)]
        for low, high in pairwise(breaks or [-1, len(found) - 1]):
            part, row = found[low + 1 : high + 1], found[low + 1]
            if row and len(part) > 2 and low + 1 < GRID:
                at = grid[low + 1 : high + 1]
                yield row[0], at, np.array([each[1] for each in part if each])

    def _parted(self, one: Following | None, other: Following | None) -> bool:
        """Return whether the map is not the same at two neighbours, or jumps between them."""
        if one is None or other is None or one[0] != other[0]:
            return True
        return abs(one[1][-1] - other[1][-1]) > JUMP * self.period / GRID


@dataclass(frozen=True)
class Stay:
    """Orbits of G(t) = F(t) - n T that stay: they come to the interval ``ends``.

    The ``rounds`` are those after which an orbit that attracts closes: the contacts, and n, are
    those of all of them.  ``within`` is where G has these contacts, in a table with ``images``.
    """

    table: Table
    contacts: tuple[Contact, ...]
    periods: int
    rounds: int
    ends: tuple[float, float]
    within: Floats
    images: Floats

    def times(self, t: float) -> list[float]:
        """Return the times of the contacts after a release; none if they are others."""
        found, shift = list[float](), self.periods // self.rounds * self.table.period
        for k in range(self.rounds):
            row = self.table.after(t)
            if row is None or row[0] * self.rounds != self.contacts:
                return []
            found += [x + k * shift for x in row[1]]
            t = row[1][-1] - shift
        return found

    def map(self, t: float) -> float:
        """Return G(t); nan if it is not defined."""
        times = self.times(t)
        return times[-1] - self.periods * self.table.period if times else nan

    @property
    def closes(self) -> bool:
        """Whether the orbits come to one that closes."""
        return self.ends[1] - self.ends[0] < SAME * self.table.period


def stays(system: System, tell: Callable[[str], None]) -> Iterator[Stay]:
    """Yield where orbits of the maps from release to release stay; `BadInput` if there are none."""
    found = releases(system)
    tell("compiling the system")
    engine = Engine(system)
    tell("following releases of a period")
    for release in found:
        table = Table(engine, release)
        for contacts, at, times in table.rows():
            last, T = times[:, -1], table.period
            for n in range(1, int((last.max() - at[0]) / T) + 1):
                stay = _stay(table, contacts, n, at, last - n * T)
                if stay:
                    yield stay


def _stay(
    table: Table, contacts: tuple[Contact, ...], n: int, at: Floats, images: Floats
) -> Stay | None:
    """Return where orbits of a map stay, given by a table."""
    t = _iterated(np.linspace(at[0], at[-1], SEEDS), at, images, SETTLING)
    if not len(t):
        return None
    for k in range(1, LONGEST + 1):
        image = _iterated(t[:1], at, images, k)
        if len(image) and abs(image[0] - t[0]) < SAME * table.period:
            within, over = at, at
            for _ in range(k):
                over = np.interp(over, at, images, left=np.nan, right=np.nan)
            inside = np.isfinite(over)
            inside &= _joined(inside, int(np.searchsorted(at, t[0])))
            within, over = at[inside], over[inside]
            ends = float(t[0]), float(t[0])
            return (
                Stay(table, contacts * k, n * k, k, ends, within, over) if len(over) > 2 else None
            )
    orbit = [t]
    for _ in range(KEPT):
        orbit.append(_iterated(orbit[-1], at, images, 1))
    met = np.concatenate(orbit)
    low, high = float(met.min()), float(met.max())
    return Stay(table, contacts, n, 1, (low, high), at, images)


def _iterated(t: Floats, at: Floats, images: Floats, count: int) -> Floats:
    """Return the images of those times that stay in the table."""
    for _ in range(count):
        t = np.interp(t, at, images, left=np.nan, right=np.nan)
        t = t[np.isfinite(t)]
    return t


def _joined(inside: NDArray[np.bool_], k: int) -> NDArray[np.bool_]:
    """Return which places are joined to the k-th by places inside."""
    breaks = np.flatnonzero(~inside)
    low = breaks[breaks < k].max(initial=-1)
    high = breaks[breaks >= k].min(initial=len(inside))
    found = np.zeros(len(inside), dtype=bool)
    found[low + 1 : high] = True
    return found
