"""The search for strips in rounds, each in narrower columns, step by step, kept in a journal.

It steers, in doubles: what comes out is to be proved.
"""

from __future__ import annotations

import base64
import io
import zipfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from cap.areas.strips import strips
from cap.areas.strips.cover import Integers
from cap.areas.strips.fit import UNIT, Grain
from cap.areas.strips.strips import Family, New, World
from cap.errors import BadInput
from cap.runner import Plan, Runner

Begin = Callable[[World], Family]
"""Returns the columns of a world without cells."""


class Round(NamedTuple):
    """How many flights are followed, how fine strips are looked for; then columns that lose more
    than ``loss`` for each of their cells are cut, if it is not 0.
    """

    flights: int
    grain: Grain
    loss: float


class Step(NamedTuple):
    """A step of a round: forward or backward cells of a level or, after all of them, the cuts."""

    round: int
    level: int
    backward: bool

    def __str__(self) -> str:
        side = "backward" if self.backward else "forward"
        return f"round {self.round + 1}, level {self.level}, {side}"


@dataclass(frozen=True)
class Rounds:
    """Rounds, and the width of the narrowest columns."""

    each: tuple[Round, ...]
    finest: float

    def found(self, world: World, begin: Begin, runner: Runner) -> tuple[World, Family]:
        """Return the world with its columns cut, and the cells of the last round.

        Raises `BadInput` for a journal about something else.
        """
        search = _Search(self, world, begin, runner)
        plan = Plan[Step, New](
            key=f"{world} {self}", encode=_encoded, decode=_decoded, more=search.after
        )
        steps = replace(runner, jobs=1, executor=None, whole=True)
        for _ in steps.run(search.done, [Step(0, 1, False)], plan):
            pass
        return search.world, search.family


class _Search:
    """How far a search has come."""

    def __init__(self, rounds: Rounds, world: World, begin: Begin, runner: Runner) -> None:
        self.rounds, self.world, self.begin, self.runner = rounds, world, begin, runner
        self.family = begin(world)

    def done(self, step: Step) -> New:
        """Do a step."""
        flights, grain, loss = self.rounds.each[step.round]
        if step.level > flights:
            parts = strips.lossy(self.family, flights, loss, self.rounds.finest, self.runner)
            return New(parts, np.zeros((0, 6)))
        return strips.grown(self._pair(step), step.level, grain, self.runner)

    def after(self, step: Step, new: New) -> list[Step]:
        """Note what a step has found, and return the next one."""
        flights, _, loss = self.rounds.each[step.round]
        if step.level > flights:
            self.world = self.world.cut(_meant(new.number, self.world, (1, 4)))
            self.family = self.begin(self.world)
            return [Step(step.round + 1, 1, False)]
        _meant(new.number, self.world, (0, strips.MOST))
        one, two = self._pair(step)
        one = strips.joined(one, new, step.level)
        self.family = (two, one) if step.backward else (one, two)
        if not step.backward:
            return [step._replace(backward=True)]
        words = f"round {step.round + 1} of {len(self.rounds.each)}, flights followed"
        self.runner.tell(words, self.part(step))
        return [Step(step.round, step.level + 1, False)] if step.level < flights or loss else []

    def part(self, step: Step) -> float:
        """Return which part of the time of all rounds is over, if each takes twice the one before,
        as columns are cut.
        """
        rounds = self.rounds.each
        now = (1 << step.round) * (1 + step.level / rounds[step.round].flights)
        return (now - 1) / ((1 << len(rounds)) - 1)

    def _pair(self, step: Step) -> Family:
        """Return the columns to which a step adds cells, and the other ones."""
        one, two = self.family
        return (two, one) if step.backward else (one, two)


def _meant(number: Integers, world: World, limits: tuple[int, int]) -> Integers:
    """Return numbers of columns; raise `BadInput` if a journal cannot mean them."""
    low, high = limits
    if number.shape != (len(world.lines) - 1,) or number.min() < low or number.max() > high:
        raise BadInput("the journal is damaged: remove it")
    return number


def _encoded(new: New) -> str:
    """Return what a step has found as a string."""
    file = io.BytesIO()
    np.savez_compressed(file, number=new.number, units=np.rint(new.cells.T / UNIT).astype(np.int64))
    return base64.b64encode(file.getvalue()).decode("ascii")


def _decoded(text: str) -> New:
    """Return what was found; raise `BadInput` for what cannot be that."""
    with suppress(ValueError, KeyError, OSError, EOFError, zipfile.BadZipFile):
        with np.load(io.BytesIO(base64.b64decode(text)), allow_pickle=False) as arrays:
            number, units = arrays["number"], arrays["units"]
        if number.dtype == units.dtype == np.int64 and units.shape in ((6, number.sum()), (6, 0)):
            return New(number, units.T * UNIT)
    raise BadInput("the journal is damaged: remove it")
