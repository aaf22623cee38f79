"""A model that is explored: its file, the values of its parameters, and its flow in doubles."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import Any

import numpy as np

from cap.errors import BadInput
from cap.floats.findings import Data
from cap.floats.models.engine import Engine
from cap.floats.models.spectrum import Floats, number
from cap.system.files import Loaded, load
from cap.system.model import System

SEEDS, SOON, SETTLING, LATE = 200, 2, 60, 20  # states all over; periods that are looked at
SCALES = 0.3, 1.0, 3.0  # of states all over


@dataclass(frozen=True)
class Subject:
    """A model from a file, and what floats follow of it."""

    loaded: Loaded

    def at(self, name: str, value: Fraction) -> Subject:
        """Return the model with another value of a parameter."""
        if name not in self.loaded.values:
            known = self.loaded.settings() or "none"
            raise BadInput(f"no parameter {name}: the model has {known.replace(',', ', ')}")
        return Subject(load(self.loaded.path, {**self.loaded.values, name: value}))

    @property
    def system(self) -> System:
        """The system at the values of the parameters."""
        return self.loaded.system

    @cached_property
    def engine(self) -> Engine:
        """Its flow; `BadInput` if floats do not follow it."""
        return Engine(self.system)

    @cached_property
    def period(self) -> float:
        """The period of the clock."""
        return 2 * pi / float(number(self.system.omega))

    def words(self, *, but: tuple[str, ...] = ()) -> str:
        """Return the options that name the model on a command line."""
        settings = self.loaded.settings(but=but)
        file = shlex.quote(self.loaded.path)
        return f"--model {file}" + (f" --set {settings}" if settings else "")

    def positions(self) -> tuple[str, ...]:
        """Return the variables that have a velocity; all if none has."""
        found = tuple(z for z in self.system.state if self.system.velocity_of(z))
        return found or self.system.state

    def plane(self) -> tuple[str, str]:
        """Return the two variables of its pictures: a position, and its velocity."""
        first, *others = self.positions()
        speed = self.system.velocity_of(first) or next(iter(others), first)
        return first, speed

    def planes(self) -> tuple[tuple[str, str], ...]:
        """Return a plane for each position, with its velocity."""
        pairs = [(z, self.system.velocity_of(z)) for z in self.positions()]
        found = tuple((z, v) for z, v in pairs if v)
        return found[:4] or (self.plane(),)

    def named(self, names: tuple[str, ...]) -> tuple[str, str]:
        """Return two variables; refuse other names."""
        for name in names:
            if name not in self.system.state:
                raise BadInput(f"no variable {name}: the state is {', '.join(self.system.state)}")
        if names[0] == names[1]:
            raise BadInput(f"--plane is of two variables: {names[0]} is one")
        return names[0], names[1]

    def ranges(self, box: tuple[float, ...] | None) -> Floats:
        """Return the ranges (n, 2) that a box names, or those of `box`."""
        if box is None:
            return self.box
        names = self.system.state
        if len(box) != 2 * len(names):
            listed = ", ".join(f"{z} from, {z} to" for z in names)
            raise BadInput(f"--box takes {2 * len(names)} numbers, {listed}: {len(box)} given")
        found = np.array(box, dtype=float).reshape(-1, 2)
        for name, (low, high) in zip(names, found, strict=True):
            if not low <= high:
                raise BadInput(f"--box: {name} from {low:g} to {high:g} is no range")
        return found

    def seeds(self, count: int, box: Floats | None = None, seed: int = 0) -> Floats:
        """Return states in a box (n, 2), or on several scales, that lie in a mode."""
        random, n = np.random.default_rng(seed), len(self.system.state)
        drawn = np.empty((0, n))
        for _ in range(50):
            if box is None:
                scale = random.choice(SCALES, size=(4 * count, 1))
                more = scale * random.normal(size=(4 * count, n))
            else:
                more = random.uniform(box[:, 0], box[:, 1], size=(4 * count, n))
            drawn = np.vstack([drawn, more[self.starting(more)]])
            if len(drawn) >= count:
                return drawn[:count]
        if not len(drawn):
            raise BadInput("no state of the box lies in a mode: give another --box or --state")
        return np.resize(drawn, (count, n))

    def starting(self, states: Floats) -> Floats:
        """Return whether each state lies in a mode in which an orbit may begin."""
        inside = self.engine.inside(states) & self.engine.free[:, np.newaxis]
        return np.asarray(inside.any(axis=0))

    @cached_property
    def box(self) -> Floats:
        """Ranges (n, 2) of the states: of orbits from all over, soon and after a while; a rim."""
        path = self.engine.follow(self.seeds(SEEDS), periods=SETTLING + LATE, every=True).path
        whole = np.isfinite(path).all(axis=(1, 2))
        late = path[whole, SETTLING:] if whole.any() else path
        low, high = self._spread(late)
        early = self._spread(path[:, :SOON])
        low, high = np.minimum(low, early[0]), np.maximum(high, early[1])
        rim = 0.1 * (high - low) + 1e-3 * (1e-3 + np.maximum(np.abs(low), np.abs(high)))
        return np.stack([low - rim, high + rim], axis=1)

    def _spread(self, path: Floats) -> tuple[Floats, Floats]:
        """Return between which numbers nearly all states lie."""
        states = path.reshape(-1, len(self.system.state))
        states = states[np.isfinite(states).all(axis=1)]
        if not len(states):
            raise BadInput("every orbit from anywhere is lost in a period: give --box, or --state")
        low, high = np.percentile(states, [2, 98], axis=0)
        return low, high


@dataclass(frozen=True, kw_only=True)
class OfModel(Data):
    """What was found of a model, its file: the ``values``, the ``state``, the period T.

    ``autonomous``: the clock occurs nowhere, so T says nothing.
    """

    model: str
    values: dict[str, Fraction]
    state: tuple[str, ...]
    period: float
    autonomous: bool
    varies: str = ""

    def given(self) -> dict[str, str]:
        """Return the parameters that do not vary."""
        fixed = {name: str(q) for name, q in self.values.items() if name != self.varies}
        return {"model": self.model, **fixed}

    def described(self) -> str:
        """Return the model and its parameters for a line of text."""
        return ", ".join([self.model, *(f"{k} = {q}" for k, q in [*self.given().items()][1:])])


def about(subject: Subject, varies: str = "") -> dict[str, Any]:
    """Return the fields of `OfModel`."""
    loaded = subject.loaded
    return {
        "model": loaded.path,
        "values": dict(loaded.values),
        "state": subject.system.state,
        "period": subject.period,
        "autonomous": subject.system.autonomous,
        "varies": varies,
    }


def command(subject: Subject, periods: int, state: Floats, mode: str) -> str:
    """Return the command that proves the orbit near that of a state at t = 0."""
    period = f" --period {periods}" if periods > 1 else ""
    size = 1e-15 * float(np.abs(state).max())
    numbers = " ".join(f"{q:.15g}" if abs(q) > size else "0" for q in state)
    return (
        f"python -m cap.prove periodic {subject.words()}{period} --orbit {numbers} "
        f"--mode {shlex.quote(mode)}"
    )
