"""A periodic orbit of a model followed over a parameter, by pseudo-arclength, and its bifurcations.

Labels: ``fold``; ``flip``, a multiplier -1; ``branch point``, where branches cross;
``Neimark-Sacker``, a pair on the unit circle; ``events change``, a graze or a stick;
``an event at t = 0``, where the branch is not followed through; ``end``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import Closed, closing_near, settled
from cap.floats.models.family import Family, Station
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about
from cap.floats.models.trajectory import SETTLING, given_start
from cap.runner import Runner

FIRST, LEAST, MOST = 0.01, 1e-6, 0.03  # lengths of steps, in units of the ranges
LOCATED, HALVINGS = 1e-9, 40  # length within which a bifurcation is located
EDGE = 1e-3  # of the time, from its ends to an event that is there where a branch ends


@dataclass(frozen=True)
class ModelSpecial:
    """Where a bifurcation is, or the events of the orbit change."""

    label: str
    value: float
    state: Floats
    multipliers: NDArray[np.complex128]


@dataclass(frozen=True, kw_only=True)
class ModelBranch(OfModel):
    """Orbits of period ``periods`` T over a parameter: value (K,), states (K, n) at t = 0.

    ``multipliers`` (K, n); ``stable`` (K,); ``itinerary`` (K,) changes where the events do.
    """

    parameter: str
    periods: int
    value: Floats
    states: Floats
    multipliers: NDArray[np.complex128]
    stable: NDArray[np.bool_]
    itinerary: NDArray[np.int64]
    special: tuple[ModelSpecial, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return a row for each orbit."""
        sizes = {f"multiplier {k + 1}": q for k, q in enumerate(np.abs(self.multipliers).T)}
        states = dict(zip(self.state, self.states.T, strict=True))
        return {self.parameter: self.value, **states, **sizes, "stable": self.stable}

    def lines(self) -> list[str]:
        """Return the range of the branch, and its special points."""
        head = (
            f"orbit of period {self.periods} T of {self.described()}, followed over "
            f"{self.parameter} = {self.value.min():.8g} .. {self.value.max():.8g}"
        )
        rows = [
            f"  {self.parameter} = {each.value:<12.8g} {each.label:<16} "
            + ", ".join(f"{z} = {q:.8g}" for z, q in zip(self.state, each.state, strict=True))
            for each in self.special
        ]
        return [head, *rows]


def continuation(  # noqa: PLR0913 (the options of the command)
    subject: Subject,
    *,
    parameter: str | None = None,
    range: tuple[Fraction, ...] | None = None,  # noqa: A002 (the option's name)
    state: tuple[float, ...] | None = None,
    mode: str | None = None,
    points: int = 300,
    runner: Runner | None = None,
) -> ModelBranch:
    """Follow an orbit both ways within a range.

    It is the one near a state, or to which that leads; of no state one at which others end.
    """
    runner = runner or Runner()
    if parameter is None or range is None:
        raise BadInput("say what varies, between which values: --parameter NAME --range A B")
    if subject.system.autonomous:
        raise BadInput(
            "without a clock the period is unknown; floats follow no such orbit over a parameter: "
            "`cap.prove branch --model` proves the curve"
        )
    low, high = map(float, range)
    subject.at(parameter, range[0])  # it is a parameter
    value = float(subject.loaded.values[parameter])
    if not low <= value <= high or low == high:
        raise BadInput(f"{parameter} = {value:g} is not in the range from {low:g} to {high:g}")
    closed = _begun(subject, state, mode)
    size = np.maximum(np.ptp(subject.box, axis=1) / 2, np.abs(closed.start.state).max() / 10)
    unit = np.append(size, high - low)
    family = Family(subject, parameter, closed.count, closed.start.mode, unit)
    y = np.append(closed.start.state, value) / unit
    first = family.station(y, np.append(np.zeros(len(size)), 1.0))
    limits = low / unit[-1], high / unit[-1]
    ways = [_followed(family, first, side, limits, points, runner) for side in (1, -1)]
    curve = [*ways[1][0][::-1], first, *ways[0][0]]
    special = sorted([*ways[0][1], *ways[1][1]], key=lambda each: each.value)
    return _branch(subject, family, curve, special, complete=not runner.interrupted)


def _begun(subject: Subject, state: tuple[float, ...] | None, mode: str | None) -> Closed:
    """Return the orbit that is followed."""
    start = settled(subject, SETTLING) if state is None else given_start(subject, state, mode, None)
    closed = closing_near(subject, start)
    if closed is None and state is not None:
        closed = closing_near(subject, given_start(subject, state, mode, SETTLING))
    if closed is None:
        raise BadInput(
            f"no orbit closes near that state, nor where it leads in {SETTLING} periods: "
            "`search` and `attractor` list states of orbits"
        )
    if closed.rests:
        raise BadInput(
            "contacts accumulate on the orbit to which that state leads, or it has none: such a "
            "one is not followed; `search` lists others"
        )
    return closed


def _followed(
    family: Family,
    first: Station,
    side: int,
    limits: tuple[float, float],
    points: int,
    runner: Runner,
) -> tuple[list[Station], list[ModelSpecial]]:
    """Return the orbits on one side, and the special ones."""
    at = Station(first.y, side * first.tangent, first.multipliers, side * first.crossing,
                 first.words, first.slopes, first.nearest)  # fmt: skip
    way: list[Station] = []
    special: list[ModelSpecial] = []
    step = FIRST
    with runner.keeping():
        while len(way) < points:
            runner.tell("continuation", len(way) / points)
            following = family.corrected(at.y + step * at.tangent, at.tangent, at)
            if following is not None and following.tangent @ at.tangent < 0.7 and step > LEAST:
                following = None
            if following is None and step > LEAST:
                step /= 2
                continue
            if following is None:
                label = "an event at t = 0" if at.nearest < EDGE else "end"
                special.append(_special(family, label, at))
                break
            if not limits[0] <= following.y[-1] <= limits[1]:
                last = _at_limit(family, at, following, limits)
                special += _changes(family, at, last) if last else []
                way += [last] if last else []
                break
            special += _changes(family, at, following)
            way.append(following)
            at, step = following, min(1.3 * step, MOST)
        else:
            special.append(_special(family, f"followed no further: {points} points", at))
    return way, special


def _at_limit(
    family: Family, one: Station, other: Station, limits: tuple[float, float]
) -> Station | None:
    """Return the orbit near the limit that lies between two neighbours."""
    rise = other.y[-1] - one.y[-1]
    part = (limits[int(rise > 0)] - one.y[-1]) / rise
    return _between(family, one, other, float(part) * (1 - LOCATED))


TESTS: dict[str, Callable[[Station], float]] = {
    "fold": lambda s: float(s.tangent[-1]),
    "flip": lambda s: s.flip,
    "branch point": lambda s: s.crossing,
    "Neimark-Sacker": lambda s: s.circle,
}


def _changes(family: Family, one: Station, other: Station) -> list[ModelSpecial]:
    """Return the special orbits between two neighbours."""
    found = []
    if one.words != other.words:
        found.append(_special(family, "events change", _border(family, one, other)))
    for label, test in TESTS.items():
        a, b = test(one), test(other)
        smooth = label != "Neimark-Sacker" or 1.0 not in (a, b)
        if a * b < 0 and smooth and one.words == other.words:
            found.append(_special(family, label, _located(family, one, other, test)))
    return found


def _between(family: Family, one: Station, other: Station, part: float) -> Station | None:
    """Return the orbit near a point of the chord."""
    chord = other.y - one.y
    return family.corrected(one.y + part * chord, chord / np.linalg.norm(chord), one)


def _located(
    family: Family, one: Station, other: Station, test: Callable[[Station], float]
) -> Station:
    """Return where a test is zero, by the rule of Illinois."""
    low, high, a, b = 0.0, 1.0, test(one), test(other)
    best = other
    for _ in np.arange(HALVINGS):
        part = (low * b - high * a) / (b - a)
        found = _between(family, one, other, part)
        if found is None:
            break
        best, value = found, test(found)
        if abs(value) < 1e-11 or high - low < LOCATED:
            break
        if value * b < 0:
            low, a = high, b
        else:
            a /= 2
        high, b = part, value
    return best


def _border(family: Family, one: Station, other: Station) -> Station:
    """Return the last orbit with the events of the first, by halves."""
    low, high, best = 0.0, 1.0, one
    for _ in np.arange(HALVINGS):
        if (high - low) * np.linalg.norm(other.y - one.y) < LOCATED:
            break
        found = _between(family, one, other, (low + high) / 2)
        if found is not None and found.words == one.words:
            low, best = (low + high) / 2, found
        else:
            high = (low + high) / 2
    return best


def _special(family: Family, label: str, station: Station) -> ModelSpecial:
    y = station.y * family.unit
    return ModelSpecial(label, float(y[-1]), y[:-1], station.multipliers)


def _branch(
    subject: Subject,
    family: Family,
    curve: list[Station],
    special: list[ModelSpecial],
    *,
    complete: bool,
) -> ModelBranch:
    """Return the branch as arrays."""
    y = np.array([station.y for station in curve]) * family.unit
    multipliers = np.array([station.multipliers for station in curve])
    changed = [a.words != b.words for a, b in pairwise(curve)]
    return ModelBranch(
        **about(subject, family.parameter),
        complete=complete,
        parameter=family.parameter,
        periods=family.count,
        value=y[:, -1],
        states=y[:, :-1],
        multipliers=multipliers,
        stable=np.abs(multipliers).max(axis=1) < 1,
        itinerary=np.concatenate([[0], np.cumsum(changed)]).astype(np.int64),
        special=tuple(special),
    )
