"""Where orbits of a model end: attractors of seeds, with their shares, exponents and basins."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import CLOSE, Closed, closing, first_start
from cap.floats.models.samples import exponents, samples
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about
from cap.floats.models.trajectory import proving, told
from cap.floats.models.walls import Wall, walls
from cap.floats.words import with_error
from cap.runner import Runner

LATE = 128  # periods in which an orbit is looked at: twice the longest period of a cycle
SAME = 1e-3  # states of one cycle, as a part of the ranges of all
CHAOTIC, CERTAIN = 2e-4, 3  # least exponent of chaos, per time, and in standard errors
ORBITS, PERIODS = 8, 400  # from which exponents are taken, and for how long
NONE, RESTS = -1, -1  # the label of an orbit that is lost; in place of a period
MOST = 5_000_000  # states times periods that are kept


@dataclass(frozen=True)
class ModelAttractor:
    """An attractor: ``kind`` in words, its share of the seeds, events a period, sampled states.

    ``exponents`` (n,) per time with their ``errors``, nan for a cycle.  ``hints`` of a proof.
    """

    kind: str
    share: float
    events: str
    states: Floats
    exponents: Floats
    errors: Floats
    hints: tuple[str, ...]

    def lines(self) -> list[str]:
        """Return it in words."""
        pairs = zip(self.exponents, self.errors, strict=True)
        rates = ", ".join(with_error(float(x), float(e)) for x, e in pairs)
        size = float(np.abs(self.states).max())
        through = ", ".join(told(float(q), size, 8) for q in self.states[0])
        told_rates = f"; exponents {rates} per time" if rates else ""
        first = f"{self.share:7.2%}  {self.kind}: {self.events}{told_rates}"
        return [f"{first}; through ({through})", *(f"         {hint}" for hint in self.hints)]


@dataclass(frozen=True, kw_only=True)
class ModelAttractors(OfModel):
    """The attractors that seeds (N, n) end on; ``label`` (N,) is the place of each, -1: lost."""

    seeds: Floats
    label: NDArray[np.int64]
    found: tuple[ModelAttractor, ...]
    planes: tuple[tuple[str, str], ...]
    walls: tuple[Wall, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the seeds and where they end."""
        return {**dict(zip(self.state, self.seeds.T, strict=True)), "attractor": self.label}

    def lines(self) -> list[str]:
        """Return the attractors."""
        head = f"attractors of {self.described()} from {len(self.label)} seeds"
        rows = [row for k, each in enumerate(self.found, 1) for row in _numbered(k, each.lines())]
        lost = int((self.label == NONE).sum())
        return [head, *rows, *([f"  {lost} seeds were lost"] if lost else [])]


def _numbered(k: int, lines: list[str]) -> list[str]:
    return [f"  {k if n == 0 else ' '}  {line}" for n, line in enumerate(lines)]


def attractors(
    subject: Subject,
    *,
    box: tuple[float, ...] | None = None,
    points: int = 400,
    transient: int = 1000,
    plane: tuple[str, ...] | None = None,
    runner: Runner | None = None,
) -> ModelAttractors:
    """Follow seeds of a box, and tell their attractors apart."""
    runner = runner or Runner()
    seeds = subject.seeds(points, subject.ranges(box))
    planes = (subject.named(plane),) if plane else subject.planes()
    runner.tell("attractors", None)
    label, found = ends_of(subject, seeds, transient)
    fixed = () if subject.system.autonomous else walls(
        subject.system, np.zeros(1), seeds[:1], fixed=True)  # fmt: skip
    return ModelAttractors(
        **about(subject), seeds=seeds, label=label, found=found, planes=planes, walls=fixed
    )


def ends_of(
    subject: Subject, seeds: Floats, transient: int
) -> tuple[NDArray[np.int64], tuple[ModelAttractor, ...]]:
    """Return the attractor (N,) of each seed, -1 if it is lost, and the attractors."""
    if len(seeds) * LATE > MOST:
        raise BadInput(f"too many seeds: {len(seeds)} (at most {MOST // LATE})")
    engine = subject.engine
    settled = engine.follow(seeds, engine.begun(seeds), periods=max(1, transient))
    well = np.isfinite(settled.states).all(axis=1)
    label = np.full(len(seeds), NONE)
    if not well.any():
        raise BadInput(f"all orbits are lost within {transient} periods")
    starts, modes = settled.states[well], settled.modes[well]
    late = samples(subject, starts, modes, LATE)
    rests = (late.counts.sum(axis=1) == 0) & ~engine.free[late.modes]
    own, marks = _labelled(late.states, rests)
    order = sorted(range(len(marks)), key=lambda k: (-(own == k).sum(), k))
    place = np.array([order.index(k) for k in range(len(marks))] + [NONE])
    label[well] = place[own]
    found = []
    for k in order:
        members = np.flatnonzero(own == k)
        starts_of = late.ends[members[:ORBITS]], late.modes[members[:ORBITS]]
        events = late.counts[members].mean(axis=0)
        share = len(members) / len(seeds)
        found.append(
            _attractor(subject, marks[k], late.states[members], starts_of, (events, share))
        )
    return label, tuple(found)


def _labelled(states: Floats, rests: NDArray[np.bool_]) -> tuple[NDArray[np.int64], list[int]]:
    """Return a label for each orbit (N, K, n), and the period of each label, 0: none, `RESTS`.

    Orbits that come back are on one cycle if they share a state.  Those that rest are told
    together, and so are those that do not come back.
    """
    size = np.nanmax(np.abs(states), axis=(0, 1)) + 1e-9
    label, periods, known = np.full(len(states), NONE), list[int](), list[Floats]()
    for i, path in enumerate(states / size):
        if np.isnan(path[-1]).any():
            continue
        period = RESTS if rests[i] else _least(path)
        state = path[-period:] if period > 0 else path[-1:]
        at = next(
            (k for k, (p, c) in enumerate(zip(periods, known, strict=True))
             if p == period and (p <= 0 or _shares(c, state))), len(periods))  # fmt: skip
        if at == len(periods):
            periods.append(period)
            known.append(state)
        label[i] = at
    return label, periods


def _shares(one: Floats, other: Floats) -> bool:
    """Return whether two cycles share a state."""
    return bool((np.abs(one - other[0]).max(axis=1) < SAME).any())


def _least(path: Floats) -> int:
    """Return the least period after which the second half of a path (K, n) is where it was; 0."""
    half = len(path) // 2
    for period in range(1, half + 1):
        if np.abs(path[half:] - path[half - period : -period]).max() < CLOSE:
            return period
    return 0


def _attractor(
    subject: Subject,
    period: int,
    states: Floats,
    starts: tuple[Floats, NDArray[np.int64]],
    told: tuple[Floats, float],
) -> ModelAttractor:
    """Return an attractor, given its orbits: states (M, K, n), and starts for more."""
    counts, share = told
    autonomous = subject.system.autonomous
    events = ", ".join(
        f"{q / LATE / (2 if autonomous else 1):.4g} {word}"
        for word, q in zip(subject.engine.words, counts, strict=True)
        if q
    )
    events = f"{events} per {'2 pi' if autonomous else 'T'}" if events else "no events"
    n, closed = states.shape[2], None
    if period == RESTS:
        return ModelAttractor("rests", share, events, states[0, -1:], np.empty(0), np.empty(0), ())
    if period:
        closed = closing(subject, first_start(subject, *starts))
    if closed:
        with np.errstate(divide="ignore"):
            rates = np.log(np.abs(closed.multipliers)) / closed.time
        return ModelAttractor(
            _kind(subject, closed), share, events, states[0, -period:], rates,
            np.full(len(rates), math.nan), (closed.shown(), *proving(subject, closed)),
        )  # fmt: skip
    rates, errors = exponents(subject, *starts, PERIODS)
    mean, error = rates.mean(axis=0), errors.mean(axis=0) / math.sqrt(len(rates))
    chaotic = mean[0] > max(CHAOTIC, CERTAIN * error[0])
    kind = f"comes back after {period} T" if period else "chaotic" if chaotic else "no short period"
    return ModelAttractor(kind, share, events, states.reshape(-1, n)[-20_000:], mean, error, ())


def _kind(subject: Subject, closed: Closed) -> str:
    """Return the kind of a cycle in words."""
    what = f"period {closed.time:.10g}" if subject.system.autonomous else (
        f"period {closed.count} T")  # fmt: skip
    return what if closed.attracts else f"{what}, which does not attract"
