"""Where orbits of a model end: attractors of seeds, with their shares, exponents and basins."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import Closed, closing, first_start
from cap.floats.models.samples import Samples, exponents, least, samples
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about
from cap.floats.models.trajectory import flagged, proving, told
from cap.floats.models.walls import Wall, walls
from cap.floats.words import with_error
from cap.runner import Runner

LATE = 128  # periods in which an orbit is looked at: twice the longest period of a cycle
SAME = 1e-3  # states of one cycle, as a part of the ranges of all
CHAOTIC, CERTAIN = 2e-4, 3  # least exponent of chaos, per time, and in standard errors
ORBITS, PERIODS = 8, 400  # from which exponents are taken, and for how long
NONE, RESTS = -1, -1  # the label of an orbit that is lost; in place of a period
NEUTRAL, FEW = 1e-6, 8  # exponents, per time, of cycles in a continuum; as many are one
RARE = 1000  # a cycle to which one seed of so many comes, or less
TOLD = 12  # attractors that are listed
CONTINUUM = "a continuum"  # the first word of its kind
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

    @property
    def neutral(self) -> bool:
        """Whether it is a cycle all of whose multipliers are on the unit circle."""
        cycle = len(self.errors) and np.isnan(self.errors).all()
        return bool(cycle and np.abs(self.exponents).max() < NEUTRAL)

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
    """The attractors that seeds (N, n) end on; ``label`` (N,) is the place of each, -1: lost.

    ``lost``: how many of them, and why, in words.
    """

    seeds: Floats
    label: NDArray[np.int64]
    found: tuple[ModelAttractor, ...]
    lost: str
    planes: tuple[tuple[str, str], ...]
    walls: tuple[Wall, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the seeds and where they end."""
        return {**dict(zip(self.state, self.seeds.T, strict=True)), "attractor": self.label}

    def lines(self) -> list[str]:
        """Return the attractors."""
        head = f"attractors of {self.described()} from {len(self.label)} seeds"
        return [head, *listed(self.found, hints=True), *([f"  {self.lost}"] if self.lost else [])]


def listed(found: tuple[ModelAttractor, ...], *, hints: bool) -> list[str]:
    """Return the first attractors in words, with the hints of proofs or without; how many more."""
    rows = [
        f"  {' ' if n else k}  {line}"
        for k, each in enumerate(found[:TOLD], 1)
        for n, line in enumerate(each.lines() if hints else each.lines()[:1])
    ]
    rest = found[TOLD:]
    share = sum(each.share for each in rest)
    return [*rows, *([f"  … {len(rest)} more, of {share:.2%}"] if rest else [])]


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
    label, found, lost = ends_of(subject, seeds, transient)
    fixed = () if subject.system.autonomous else walls(
        subject.system, np.zeros(1), seeds[:1], fixed=True)  # fmt: skip
    return ModelAttractors(
        **about(subject), seeds=seeds, label=label, found=found, lost=lost, planes=planes,
        walls=fixed)  # fmt: skip


def ends_of(
    subject: Subject, seeds: Floats, transient: int, alike: NDArray[np.bool_] | None = None
) -> tuple[NDArray[np.int64], tuple[ModelAttractor, ...], str]:
    """Return the attractor (N,) of each seed, -1 if it is lost; the attractors; what was lost.

    Of the seeds that are ``alike`` (N,), which end together, one is followed.
    """
    if len(seeds) * LATE > MOST:
        raise BadInput(f"too many seeds: {len(seeds)} (at most {MOST // LATE})")
    engine, (followed, which) = subject.engine, _followed(len(seeds), alike)
    starts = seeds[followed]
    settled = engine.follow(starts, engine.begun(starts), periods=max(1, transient))
    well = np.asarray(np.isfinite(settled.states).all(axis=1))
    label = np.full(len(seeds), NONE)
    if not well.any():
        why = flagged(int(np.bitwise_or.reduce(settled.flags)))
        raise BadInput(f"all orbits are lost within {transient} periods: {why}")
    starts, modes = settled.states[well], settled.modes[well]
    late = samples(subject, starts, modes, LATE)
    rests = (late.counts.sum(axis=1) == 0) & ~engine.free[late.modes]
    own, marks = _labelled(late.states, rests)
    kept = well[which]
    again = (np.cumsum(well) - 1)[which[kept]]
    late, own = late.taken(again), own[again]
    found = _joined(_told(subject, late, own, marks, len(seeds)), late.states, len(seeds))
    for place, (members, _) in enumerate(found):
        label[np.flatnonzero(kept)[members]] = place
    flags = settled.flags[which]
    flags[kept] = late.flags
    return label, tuple(each for _, each in found), _lost(label, flags)


def _followed(
    count: int, alike: NDArray[np.bool_] | None
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return which seeds are followed, and for each seed (N,) its place among these."""
    rows = np.arange(count)
    if alike is None or not alike.any():
        return rows, rows
    follows = ~alike
    follows[np.argmax(alike)] = True
    which = np.cumsum(follows) - 1
    which[alike] = which[np.argmax(alike)]
    return np.flatnonzero(follows), which


def _lost(label: NDArray[np.int64], flags: NDArray[np.int64]) -> str:
    """Return how many orbits were lost, and why."""
    lost = label == NONE
    why = flagged(int(np.bitwise_or.reduce(flags[lost], initial=0)))
    return f"{lost.sum()} were lost{': ' if why else ''}{why}" if lost.any() else ""


class _Ended(NamedTuple):
    """The orbits that end on an attractor, its mark, and what is told if it was looked at."""

    members: NDArray[np.int64]
    mark: int
    found: ModelAttractor | None


def _told(
    subject: Subject, late: Samples, own: NDArray[np.int64], marks: list[int], seeds: int
) -> list[_Ended]:
    """Return the attractors, those of most orbits first.

    Where several cycles of a period were neutral, one to which few orbits came is not looked at.
    """
    told, neutral = list[_Ended](), Counter[int]()
    for k in sorted(range(len(marks)), key=lambda k: (-(own == k).sum(), k)):
        members, mark, found = np.flatnonzero(own == k), marks[k], None
        if len(members) > max(1, seeds // RARE) or neutral[mark] < FEW:
            starts = late.ends[members[:ORBITS]], late.modes[members[:ORBITS]]
            events = late.counts[members].mean(axis=0)
            told_of = events, len(members) / seeds
            found = _attractor(subject, mark, late.states[members], starts, told_of)
            neutral[mark] += found.neutral
        told.append(_Ended(members, mark, found))
    return told


def _joined(
    told: list[_Ended], states: Floats, seeds: int
) -> list[tuple[NDArray[np.int64], ModelAttractor]]:
    """Return orbits and attractors, many neutral cycles of a period as one continuum."""
    separate, joined = list[tuple[NDArray[np.int64], ModelAttractor]](), dict[int, list[_Ended]]()
    for each in told:
        if each.found is None or each.found.neutral:
            joined.setdefault(each.mark, []).append(each)
        else:
            separate.append((each.members, each.found))
    for mark, cycles in joined.items():
        if len(cycles) < FEW:
            separate += [(c.members, c.found) for c in cycles if c.found]
            continue
        first = next(c.found for c in cycles if c.found)
        members = np.concatenate([c.members for c in cycles])
        shown = np.concatenate([states[c.members[0], -mark:] for c in cycles])
        separate.append((members, replace(
            first, kind=f"{CONTINUUM} of {first.kind.partition(',')[0]}", states=shown,
            events=f"{len(cycles)} cycles met", share=len(members) / seeds,
            hints=(f"of one of them {first.hints[0]}",),
        )))  # fmt: skip
    return sorted(separate, key=lambda each: -len(each[0]))


class _Cycles:
    """Cycles of a period that were met: ``states`` (K, period, n), with room for more; labels."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.states, self.labels = np.empty((1, *shape)), list[int]()

    def same(self, state: Floats) -> int | None:
        """Return the label of the first cycle that has a state, if there is one."""
        near = np.abs(self.states[: len(self.labels)] - state).max(axis=2) < SAME
        met = near.any(axis=1)
        return self.labels[int(np.argmax(met))] if met.any() else None

    def add(self, cycle: Floats, label: int) -> None:
        """Keep a cycle."""
        if len(self.labels) == len(self.states):
            self.states = np.concatenate([self.states, np.empty_like(self.states)])
        self.states[len(self.labels)] = cycle
        self.labels.append(label)


def _labelled(states: Floats, rests: NDArray[np.bool_]) -> tuple[NDArray[np.int64], list[int]]:
    """Return a label for each orbit (N, K, n), and the period of each label, 0: none, `RESTS`.

    Orbits that come back are on one cycle if they share a state.  Those that rest are told
    together, and so are those that do not come back.
    """
    size = np.nanmax(np.abs(states), axis=(0, 1)) + 1e-9
    label, periods = np.full(len(states), NONE), list[int]()
    others, cycles = dict[int, int](), dict[int, _Cycles]()
    for i, path in enumerate(states / size):
        if np.isnan(path[-1]).any():
            continue
        period = RESTS if rests[i] else least(path, len(path) // 2)
        if period <= 0:
            at = others.setdefault(period, len(periods))
        else:
            known = cycles.setdefault(period, _Cycles((period, path.shape[1])))
            met = known.same(path[-period])
            at = len(periods) if met is None else met
            if met is None:
                known.add(path[-period:], at)
        if at == len(periods):
            periods.append(period)
        label[i] = at
    return label, periods


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
