"""Whether an orbit of a model closes: after which time, with which multipliers.

With a clock an orbit is looked at once a period of it.  Where it occurs nowhere, it is looked at
after events of one kind: its period is unknown.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.engine import Ends, Engine
from cap.floats.models.legs import Legs
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import Subject

LONGEST = 64  # of the periods, or of the events of one kind, after which an orbit may close
FEW = 4  # of them, after which a state may be rough
CLOSE, ROUGHLY = 1e-5, 1e-2  # of what comes back, and of what is given, as a part of its size
EXACT, FAR, STEPS = 1e-11, 3e-2, 20  # of Newton's iteration
LINES = 2000  # of a log, for each orbit and period; more are asked for where they do not do


class Start(NamedTuple):
    """A state at t = 0, and its mode."""

    state: Floats
    mode: int

    @property
    def states(self) -> Floats:
        """The state as a row."""
        return self.state[np.newaxis]

    @property
    def modes(self) -> NDArray[np.int64]:
        """The mode as an array."""
        return np.array([self.mode])


@dataclass(frozen=True)
class Closed:
    """An orbit that closes after ``count`` periods of the clock, or events, and a ``time``."""

    start: Start
    count: int
    time: float
    multipliers: NDArray[np.complex128]
    rests: bool = False  # infinitely many contacts accumulate, or there is none

    @property
    def attracts(self) -> bool:
        """Whether all multipliers are inside the unit circle."""
        return bool(np.abs(self.multipliers).max() < 1 - 1e-6)

    def shown(self) -> str:
        """Return the multipliers in words."""
        real = [f"{x.real:.6g}" for x in self.multipliers if not x.imag]
        pairs = [f"{x.real:.6g} +- {x.imag:.6g} i" for x in self.multipliers if x.imag > 0]
        word = "attracts" if self.attracts else "does not attract"
        return f"multipliers {', '.join([*real, *pairs])}: it {word}"


def logged(
    engine: Engine, states: Floats, modes: NDArray[np.int64], periods: int, phase: float = 0.0
) -> Ends:
    """Follow orbits, and list all of their events."""
    room = max(LINES, 8 * len(states) * periods)
    while True:
        ends = engine.follow(states, modes, periods=periods, phase=phase, log=room)
        if len(ends.log) < room:
            return ends
        room *= 4


def closing(
    subject: Subject, start: Start, near: float = CLOSE, longest: int = LONGEST
) -> Closed | None:
    """Return the closed orbit to which Newton's method leads from one that nearly closes."""
    returns = _sectional if subject.system.autonomous else _periodic
    count = _count(subject, start, near, longest)
    if not count:
        return None
    state = start.state
    for _ in range(STEPS):
        found = returns(subject, Start(state, start.mode), count)
        if found is None:
            return None
        end, derivative, time, rests = found
        values = np.linalg.eigvals(derivative)
        gap = end - state
        if np.abs(gap).max() < EXACT * (1 + np.abs(state).max()):
            values = _sorted(subject, values)
            return Closed(Start(state, start.mode), count, time, values, rests)
        try:
            state = state + np.linalg.solve(np.eye(len(state)) - derivative, gap)
        except np.linalg.LinAlgError:
            return None
        if not np.abs(state - start.state).max() < FAR * (1 + np.abs(start.state).max()):
            return None
    return None


def closing_near(subject: Subject, start: Start) -> Closed | None:
    """Return the closed orbit that is meant by a state: after few returns a rough one will do."""
    return closing(subject, start, ROUGHLY, FEW) or closing(subject, start)


def _sorted(subject: Subject, values: NDArray[Any]) -> NDArray[np.complex128]:
    """Return the multipliers, the largest first; without a clock one 0 is that of the section."""
    ordered = values.astype(np.complex128)[np.argsort(-np.abs(values), kind="stable")]
    return ordered[:-1] if subject.system.autonomous else ordered


def _count(subject: Subject, start: Start, close: float, longest: int) -> int:
    """Return the least number of returns after which the orbit is nearly where it was, or 0."""
    engine, size = subject.engine, 1 + np.abs(start.state).max()
    if subject.system.autonomous:
        ends = logged(engine, start.states, start.modes, longest)
        states, modes = ends.log[:, 4:], ends.log[:, 3]
        near = (np.abs(states - start.state).max(axis=1) < close * size) & (modes == start.mode)
        near[: np.argmax(ends.log[:, 1] > 0)] = False
        if not near.any():
            return 0
        same = ends.log[: np.argmax(near) + 1, 2] == ends.log[np.argmax(near), 2]
        return int(same.sum())
    path = engine.follow(start.states, start.modes, periods=longest, every=True).path
    near = np.abs(path[0] - start.state).max(axis=1) < close * size
    return int(np.argmax(near)) + 1 if near.any() else 0


Returned = tuple[Floats, Floats, float, bool]


def _periodic(subject: Subject, start: Start, count: int) -> Returned | None:
    """Return the state after so many periods of the clock, and its derivative."""
    ends = logged(subject.engine, start.states, start.modes, count)
    if ends.flags[0] or ends.modes[0] != start.mode:
        return None
    time, rests = count * subject.period, bool(ends.counts[0, -1]) or not len(ends.log)
    legs = Legs.of(subject.engine, start.states, start.modes, ends, time)
    return ends.states[0], product(legs.derivatives()), time, rests


def _sectional(subject: Subject, start: Start, count: int) -> Returned | None:
    """Return the state after so many events of the kind that leads to the start's mode."""
    ends = logged(subject.engine, start.states, start.modes, LONGEST)
    words = subject.engine.words
    into = [
        w
        for w in dict.fromkeys(ends.log[ends.log[:, 3] == start.mode, 2].tolist())
        if words[int(w)] != "capture"
    ]
    if not into or ends.flags[0]:
        return None
    own = np.flatnonzero((ends.log[:, 2] == into[0]) & (ends.log[:, 1] > 1e-9))
    if len(own) < count:
        return None
    last = own[count - 1]
    legs = Legs.of(subject.engine, start.states, start.modes, ends, LONGEST * subject.period)
    derivative = product(legs.derivatives(sectional=True)[: last + 1])
    rests = bool((ends.log[: last + 1, 2] == len(words) - 1).any())
    return ends.log[last, 4:], derivative, float(ends.log[last, 1]), rests


def product(matrices: Floats) -> Floats:
    """Return the product of matrices (K, n, n), the first one acts first."""
    total = np.eye(matrices.shape[1])
    for matrix in matrices:
        total = matrix @ total
    return total


def settled(subject: Subject, periods: int, longest: int = LONGEST) -> Start:
    """Return a state to which some orbits have come: of those that come back soon, the soonest."""
    engine = subject.engine
    seeds = subject.seeds(64, subject.box, seed=1)
    ends = engine.follow(seeds, periods=periods)
    well = ends.flags == 0
    if not well.any():
        raise BadInput("no orbit from anywhere is followed to its end: give --state")
    states, modes = ends.states[well], ends.modes[well]
    if subject.system.autonomous:
        return first_start(subject, states, modes)
    path = engine.follow(states, modes, periods=longest, every=True).path
    near = np.abs(path - states[:, None]).max(axis=2) < CLOSE * (1 + np.abs(states).max())
    first = np.where(near.any(axis=1), near.argmax(axis=1), longest)
    rests = ends.counts[well, -1] > 0
    best = np.lexsort((rests, first))[0]
    return Start(states[best], int(modes[best]))


def first_start(subject: Subject, states: Floats, modes: NDArray[np.int64]) -> Start:
    """Return the first of some states; without a clock that just after an event that follows."""
    if not subject.system.autonomous:
        return Start(states[0], int(modes[0]))
    ends = logged(subject.engine, states, modes, 4)
    told = ends.log[ends.log[:, 2] < len(subject.engine.words) - 1]
    if not len(told):
        raise BadInput("no event happens after a while: everything rests, or flies forever")
    return Start(told[0, 4:], int(told[0, 3]))
