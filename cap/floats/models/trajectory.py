"""One orbit of a model in time: its state, its events, and the walls that it meets."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import Closed, Start, closing_near, logged, settled
from cap.floats.models.engine import OUTSIDE, Ends
from cap.floats.models.legs import NONE, Legs
from cap.floats.models.source import MANY, NO_MODE, SIMULTANEOUS
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about, command
from cap.floats.models.walls import Surface, Wall, surface, walls
from cap.runner import Runner

SAMPLES, MOST_SAMPLES = 400, 200_000  # in a period, and of an orbit
MOST, SURFACES = 30, 12  # events told, and those at which walls are drawn
ROUNDING = 1e-9  # as a part of the largest number of a state
SETTLING, SHOWN = 400, 8  # periods before, and those shown of an orbit that does not close
FLAGS = {
    SIMULTANEOUS: "two events come at once: which is first is not decided",
    NO_MODE: "no mode fits after its last event",
    MANY: "too many events in a period: they accumulate, and no guard names a mode of rest",
    OUTSIDE: "the start is not in its mode: a guard is negative there",
}


@dataclass(frozen=True, kw_only=True)
class ModelOrbit(OfModel):
    """An orbit from t = 0: times (K,), states (K, n), and ``times`` (E,) of events.

    ``words`` are events, ``modes`` (E + 1,) those before each and at the end; ``before`` and
    ``after`` (E, n) the states at an event; ``strobe`` (M, n) those at t = 0, T, ...
    ``walls`` are what it can meet, each with its places (K,); ``surfaces`` what it meets in a plane
    of two positions.  ``closes`` in words.
    """

    t: Floats
    states: Floats
    words: NDArray[np.str_]
    times: Floats
    modes: NDArray[np.str_]
    before: Floats
    after: Floats
    strobe: Floats
    walls: tuple[Wall, ...]
    positions: tuple[str, ...]
    plane: tuple[str, str]
    surfaces: tuple[Surface, ...]
    closes: tuple[str, ...]
    flag: str = ""

    def columns(self) -> dict[str, Floats]:
        """Return time and state."""
        return {"t": self.t, **dict(zip(self.state, self.states.T, strict=True))}

    def lines(self) -> list[str]:
        """Return the events in their order, and whether the orbit closes."""
        head = f"orbit of {_values(self.state, self.strobe[0])} at {self.described()}"
        width = max(map(len, [*self.words, ""]))
        rows = [
            f"  t = {t:<13.10g} {word:<{width}}  {a} -> {b}  {self._jump(*jump)}"
            for t, word, a, b, *jump in zip(
                self.times,
                self.words,
                self.modes[:-1],
                self.modes[1:],
                self.before,
                self.after,
                strict=True,
            )
        ]
        rest = [f"  … {len(rows) - MOST} more events"] if len(rows) > MOST else []
        end = f"  ends at {_values(self.state, self.states[-1])}, in {self.modes[-1]}"
        flag = [f"  {self.flag}"] if self.flag else []
        return [head, *rows[:MOST], *rest, end, *flag, *self.closes]

    def _jump(self, before: Floats, after: Floats) -> str:
        """Return the state at an event; what jumps with both values."""
        size = float(np.abs(self.states).max())
        return ", ".join(
            f"{z} = {told(a, size)}" + ("" if same else f" -> {told(b, size)}")
            for z, a, b in zip(self.state, before, after, strict=True)
            for same in [abs(a - b) < ROUNDING * size]
        )


def orbit(  # noqa: PLR0913 (the options of the command)
    subject: Subject,
    *,
    state: tuple[float, ...] | None = None,
    mode: str | None = None,
    exactly: bool = False,
    transient: int | None = None,
    periods: int | None = None,
    plane: tuple[str, ...] | None = None,
    runner: Runner | None = None,  # noqa: ARG001 (as all commands: here there is nothing to share)
) -> ModelOrbit:
    """Return the orbit of a state, or one on which others end; it is closed if it nearly is."""
    start = given_start(subject, state, mode, transient)
    names = subject.named(plane) if plane else subject.plane()
    closed = None if exactly else closing_near(subject, start)
    start = closed.start if closed else start
    end = _shown(subject, closed, periods)
    whole = math.ceil(end / subject.period - 1e-9)
    ends = logged(subject.engine, start.states, start.modes, whole)
    return _found(subject, start, ends, end, closed, names)


def _shown(subject: Subject, closed: Closed | None, periods: int | None) -> float:
    """Return the time that is shown; without a clock its period is that of the closed orbit."""
    if closed and subject.system.autonomous:
        return closed.time * (periods or 1)
    return subject.period * (periods or (closed.count if closed else SHOWN))


def given_start(
    subject: Subject, state: tuple[float, ...] | None, mode: str | None, transient: int | None
) -> Start:
    """Return the state from which an orbit is shown."""
    if state is None:
        return settled(subject, SETTLING if transient is None else transient)
    names = subject.system.state
    if len(state) != len(names):
        raise BadInput(
            f"--state takes {len(names)} numbers, {', '.join(names)}: {len(state)} given"
        )
    begun = None if mode is None else [mode]
    ends = subject.engine.follow([state], begun, periods=max(1, transient or 1), log=1)
    begin = subject.engine.begun(np.array([state]), begun)
    if not transient:
        return Start(np.array(state, float), int(begin[0]))
    if np.isnan(ends.states).any():
        raise BadInput(
            f"the orbit is lost within {transient} periods: {flagged(int(ends.flags[0]))}"
        )
    return Start(ends.states[0], int(ends.modes[0]))


def flagged(flags: int) -> str:
    """Return what was not decided, in words."""
    return "; ".join(words for bit, words in FLAGS.items() if flags & bit)


def _found(
    subject: Subject,
    start: Start,
    ends: Ends,
    end: float,
    closed: Closed | None,
    plane: tuple[str, str],
) -> ModelOrbit:
    """Return the orbit with its samples."""
    engine = subject.engine
    legs = Legs.of(engine, start.states, start.modes, ends, end)
    kept = legs.begin < end - 1e-12
    count = int(kept.sum())
    samples = [along(legs, k, min(legs.end[k], end), end) for k in range(count)]
    t, states = (np.concatenate(parts) for parts in zip(*samples, strict=True))
    events = np.flatnonzero((legs.word[:count] != NONE) & (legs.end[:count] <= end + 1e-9))
    before = np.array([samples[k][1][-1] for k in events]).reshape(-1, states.shape[1])
    names = np.array([*engine.words, "none"])
    modes = np.array(engine.modes)
    last = legs.to[events[-1]] if len(events) else legs.mode[0]
    visited = modes[[*legs.mode[events], last]]
    strobe = [start.state]
    if not subject.system.autonomous:
        shown = round(end / subject.period)
        path = engine.follow(start.states, start.modes, periods=shown, every=True).path
        strobe += list(path[0])
    return ModelOrbit(
        **about(subject),
        t=t,
        states=states,
        words=names[legs.word[events]],
        times=legs.end[events],
        modes=visited,
        before=before,
        after=legs.state[np.minimum(events + 1, len(legs.state) - 1)],
        strobe=np.array(strobe),
        walls=walls(subject.system, t, states, modes=set(visited.tolist())),
        positions=subject.positions(),
        plane=plane,
        surfaces=_surfaces(legs, events, plane, states),
        closes=_closing(subject, closed),
        flag=flagged(int(ends.flags[0])),
    )


def _surfaces(
    legs: Legs, events: NDArray[np.int64], plane: tuple[str, str], states: Floats
) -> tuple[Surface, ...]:
    """Return what the orbit meets at its first events, in a plane of two positions."""
    system = legs.engine.system
    if not all(system.velocity_of(z) for z in plane):
        return ()
    x = states[:, system.state.index(plane[0])]
    rim = 0.1 * (x.max() - x.min()) + 1e-9
    across, found = np.linspace(x.min() - rim, x.max() + rim, 200), []
    for k in events[:SURFACES]:
        if legs.word[k] < len(legs.engine.words) - 1:
            mode, word = legs.engine.modes[legs.mode[k]], legs.engine.words[legs.word[k]]
            found.append(surface(system, mode, word, float(legs.end[k]), plane, across))
    return tuple(filter(None, found))


def along(legs: Legs, k: int, until: float, whole: float) -> tuple[Floats, Floats]:
    """Return times and states along one leg, its ends included."""
    begin = float(legs.begin[k])
    rate = min(SAMPLES, MOST_SAMPLES * (2 * np.pi / legs.omega) / whole) / (2 * np.pi / legs.omega)
    d = np.linspace(0, until - begin, max(2, int(np.ceil(rate * (until - begin))) + 1))
    return begin + d, legs.at(k, d)


def _closing(subject: Subject, closed: Closed | None) -> tuple[str, ...]:
    """Return the lines on a closed orbit: its period, its multipliers, how it is proved."""
    if closed is None:
        return ()
    clock = f"{closed.count} period{'s' * (closed.count > 1)} of the clock"
    after = f"t = {closed.time:.10g}" if subject.system.autonomous else clock
    return (f"it closes after {after}; {closed.shown()}", *proving(subject, closed))


def proving(subject: Subject, closed: Closed) -> tuple[str, ...]:
    """Return the command that proves an orbit, or its state where there is none."""
    mode = subject.engine.modes[closed.start.mode]
    if not closed.rests:
        count = 1 if subject.system.autonomous else closed.count
        return (command(subject, count, closed.start.state, mode),)
    state = " ".join(f"{q:.15g}" for q in closed.start.state)
    return (f"state at t = 0: {state}, mode {mode}",)


def _values(names: tuple[str, ...], state: Floats) -> str:
    size = float(np.abs(state).max())
    return ", ".join(f"{z} = {told(q, size)}" for z, q in zip(names, state, strict=True))


def told(value: float, size: float, digits: int = 10) -> str:
    """Return a number; what is only rounding, beside numbers of some size, is 0."""
    return f"{value:.{digits}g}" if abs(value) > 1e-3 * ROUNDING * size else "0"
