"""States of many orbits of a model, once a period; where there is no clock, after events."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import CLOSE, logged
from cap.floats.models.legs import Legs
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import Subject

BLOCKS = 10  # parts of the time, of which each has its exponents
EVENTS = 400_000  # of a log at a time


@dataclass(frozen=True)
class Samples:
    """States (N, K, n) of N orbits; nan after one is lost.  ``ends`` (N, n), in ``modes``.

    ``counts`` (N, W) of events, ``flags`` (N,), as in `cap.floats.models.engine.Ends`.
    """

    states: Floats
    ends: Floats
    modes: NDArray[np.int64]
    counts: NDArray[np.int64]
    flags: NDArray[np.int64]

    def taken(self, rows: NDArray[np.int64]) -> Samples:
        """Return those of some orbits, in this order; one may come again."""
        return Samples(*(getattr(self, each.name)[rows] for each in fields(self)))


def section(subject: Subject) -> int:
    """Return the event after which orbits without a clock are looked at: one that some have."""
    ends = subject.engine.follow(subject.seeds(64, subject.box), periods=10)
    happened = np.flatnonzero(ends.counts[:, :-1].sum(axis=0))
    if not len(happened):
        raise BadInput("no event happens to any orbit: there is nothing to look at")
    return int(happened[0])


def samples(subject: Subject, states: Floats, modes: NDArray[np.int64], count: int) -> Samples:
    """Return so many states of each orbit."""
    engine = subject.engine
    if not subject.system.autonomous:
        ends = engine.follow(states, modes, periods=count, every=True)
        return Samples(ends.path, ends.states, ends.modes, ends.counts, ends.flags)
    word, n = section(subject), states.shape[1]
    periods = 2 * count
    ends = logged(engine, states, modes, periods)
    found = np.full((len(states), count, n), np.nan)
    own = ends.log[ends.log[:, 2] == word]
    for o in range(len(states)):
        part = own[own[:, 0] == o][:count, 4:]
        found[o, : len(part)] = part
        found[o, len(part) :] = ends.states[o]  # no event follows
    return Samples(found, ends.states, ends.modes, ends.counts, ends.flags)


def least(path: Floats, looked: int, close: float = CLOSE) -> int:
    """Return the least period after which the last so many states of a path are there again; 0.

    The path (K, n) is scaled; it has twice as many states at least.
    """
    for period in range(1, looked + 1):
        if np.abs(path[-looked:] - path[-looked - period : -period]).max() < close:
            return period
    return 0


def exponents(
    subject: Subject, states: Floats, modes: NDArray[np.int64], periods: int
) -> tuple[Floats, Floats]:
    """Return the Lyapunov exponents (N, n), per time, the largest first, and standard errors.

    By the saltation matrices of all events, orthonormalised once a period; -inf where a direction
    is lost for ever, as where something rests.
    """
    step = max(1, EVENTS // (8 * len(states)))
    N, n = states.shape
    Q = np.tile(np.eye(n), (N, 1, 1))
    grown = np.zeros((N, periods, n))
    for first in range(0, periods, step):
        part = min(step, periods - first)
        ends = logged(subject.engine, states, modes, part)
        legs = Legs.of(subject.engine, states, modes, ends, part * subject.period)
        Q = _stretched(legs, Q, grown[:, first : first + part], subject.period)
        states, modes = ends.states, ends.modes
    with np.errstate(invalid="ignore"):
        blocks = np.array_split(grown, min(BLOCKS, periods), axis=1)
        means = np.stack([block.mean(axis=1) for block in blocks]) / subject.period
        error = means.std(axis=0, ddof=1) / math.sqrt(len(means)) if len(means) > 1 else means[0]
        return grown.mean(axis=1) / subject.period, error


def _stretched(legs: Legs, Q: Floats, grown: Floats, period: float) -> Floats:
    """Add what each period stretches to ``grown`` (N, P, n); return the directions at the end."""
    derivatives, number = legs.derivatives(), legs.numbered()
    last = grown.shape[1] - 1
    when = np.minimum(np.floor(legs.end / period + 1e-9).astype(int), last)
    order = np.argsort(number, kind="stable")
    cuts = np.searchsorted(number[order], np.arange(number.max() + 2))
    for begin, end in pairwise(cuts.tolist()):
        own = order[begin:end]
        orbit = legs.orbit[own]
        directions, R = np.linalg.qr(derivatives[own] @ Q[orbit])
        Q[orbit] = directions
        with np.errstate(divide="ignore"):
            sizes = np.log(np.abs(np.diagonal(R, axis1=1, axis2=2)))
        grown[orbit, when[own]] += sizes
    return Q
