"""Many orbits of N masses, once in a period: in processes, in pieces."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.floats.findings import Floats
from cap.floats.masses.particles import Particles, engine, mode, told
from cap.floats.models.closing import logged
from cap.runner import Runner

PIECE = 4000  # periods at a time
KINDS = ("hit", "meet", "turn", "stick", "release")
STOPS = slice(KINDS.index("turn"), len(KINDS))


@dataclass(frozen=True)
class Ends:
    """States (M, K, 2N) of M orbits at t = 0, T, …, nan from where one cannot be followed.

    ``counts`` (M, K - 1, `KINDS`): how often each kind of event happens in each period.
    ``stopped`` (M, K - 1): a mass turned or rested in that period.
    """

    states: Floats
    counts: NDArray[np.int64]
    stopped: NDArray[np.bool_]


@dataclass(frozen=True)
class Seeds:
    """Follows seeds for some periods, and keeps the last ``kept`` + 1 states (None: all)."""

    system: Particles
    periods: int
    kept: int | None = None

    @property
    def shown(self) -> int:
        """How many periods are kept."""
        return self.periods if self.kept is None else self.kept

    def none(self, count: int) -> Ends:
        """Return the ends of so many seeds that are not followed."""
        shape = count, self.shown
        return Ends(
            np.full((count, self.shown + 1, 2 * len(self.system.masses)), np.nan),
            np.zeros((*shape, len(KINDS)), dtype=np.int64),
            np.zeros(shape, dtype=np.bool_),
        )

    def __call__(self, seeds: Floats) -> Ends:
        """Return the ends of some seeds (M, 2N)."""
        flow, found, n = engine(self.system), self.none(len(seeds)), len(self.system.masses)
        kinds, rests = _kinds(flow.words, flow.modes), np.array(["0" in m for m in flow.modes])
        states, at = seeds, np.array([flow.modes.index(mode(self.system, z[n:])) for z in seeds])
        skipped = self.periods - self.shown
        if not skipped:
            found.states[:, 0] = states
        for k in range(1 - skipped, self.shown + 1):
            alive = np.flatnonzero(np.isfinite(states).all(axis=1))
            ends = logged(flow, states[alive], at[alive], 1)
            states, at = np.full_like(seeds, np.nan), at.copy()
            states[alive], at[alive] = ends.states, ends.modes
            if k >= 0:
                found.states[:, k] = states
            if k > 0:
                orbit, word, to = ends.log[:, [0, 2, 3]].astype(int).T
                np.add.at(found.counts[:, k - 1], (alive[orbit], kinds[word, to]), 1)
                stops = found.counts[:, k - 1, STOPS].any(axis=1)
                found.stopped[:, k - 1] = rests[at] | stops
        return found


def _kinds(words: tuple[str, ...], modes: tuple[str, ...]) -> NDArray[np.int64]:
    """Return the place in `KINDS` of each event that leads to each mode."""
    real = [word for word in words if word != "capture"]
    return np.array([[KINDS.index(told(word, m).split()[0]) for m in modes] for word in real])


def swarm(seeds: Seeds, starts: Floats, runner: Runner, words: str) -> Ends:
    """Return the ends of all seeds; after an interrupt, nan for those that are not done."""
    size = max(1, PIECE // seeds.periods)
    pieces = [starts[k : k + size] for k in range(0, len(starts), size)]
    done = runner.map(seeds, pieces, words, processes=True)
    parts = [*done, seeds.none(len(starts) - sum(len(part.states) for part in done))]
    return Ends(
        np.concatenate([part.states for part in parts]),
        np.concatenate([part.counts for part in parts]),
        np.concatenate([part.stopped for part in parts]),
    )
