"""Many orbits of N masses, once in a period: in processes, in pieces."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.findings import Floats
from cap.floats.masses.particle_orbits import period
from cap.floats.masses.particles import Particles, Unresolved, follow
from cap.runner import Runner

PIECE = 200  # periods at a time
KINDS = ("hit", "meet", "turn", "stick", "release")


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
    """Follows a seed for some periods, and keeps the last ``kept`` + 1 states (None: all)."""

    system: Particles
    periods: int
    kept: int | None = None

    @property
    def shown(self) -> int:
        """How many periods are kept."""
        return self.periods if self.kept is None else self.kept

    def __call__(self, seeds: Floats) -> Ends:
        """Return the ends of some seeds (M, 2N)."""
        parts = [self.one(seed) for seed in seeds]
        return Ends(*(np.array(each) for each in zip(*parts, strict=True)))

    def one(self, seed: Floats) -> tuple[Floats, NDArray[np.int64], NDArray[np.bool_]]:
        """Return the states, counts and stops of one seed."""
        n, T, skipped = len(self.system.masses), period(self.system), self.periods - self.shown
        states = np.full((self.shown + 1, 2 * n), np.nan)
        counts = np.zeros((self.shown, len(KINDS)), dtype=np.int64)
        stopped = np.zeros(self.shown, dtype=np.bool_)
        z = seed
        for k in range(-skipped, self.shown + 1):
            if k >= 0:
                states[k] = z
            if k == self.shown:
                break
            try:  # the time begins anew in each period: it is periodic
                path = follow(self.system, z[:n].tolist(), z[n:].tolist(), T)
            except (BadInput, Unresolved):
                break
            z = np.array([*path.x, *path.v])
            if k >= 0:
                found = Counter(word.split()[0] for word in path.words)
                counts[k] = [found[kind] for kind in KINDS]
                stopped[k] = path.least_speed == 0
        return states, counts, stopped


def swarm(seeds: Seeds, starts: Floats, runner: Runner, words: str) -> Ends:
    """Return the ends of all seeds; after an interrupt, nan for those that are not done."""
    size = max(1, PIECE // seeds.periods)
    pieces = [starts[k : k + size] for k in range(0, len(starts), size)]
    done = runner.map(seeds, pieces, words, processes=True)
    missing = len(starts) - sum(len(part.states) for part in done)
    shape = missing, seeds.shown
    none = Ends(
        np.full((missing, seeds.shown + 1, starts.shape[1]), np.nan),
        np.zeros((*shape, len(KINDS)), dtype=np.int64),
        np.zeros(shape, dtype=np.bool_),
    )
    parts = [*done, none]
    return Ends(
        np.concatenate([part.states for part in parts]),
        np.concatenate([part.counts for part in parts]),
        np.concatenate([part.stopped for part in parts]),
    )
