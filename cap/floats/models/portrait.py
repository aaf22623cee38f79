"""A stroboscopic portrait of a model: states of many orbits, once a period or after events."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.samples import samples, section
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about
from cap.floats.models.walls import Wall, walls
from cap.runner import Runner

MOST = 20_000_000  # numbers that are kept


@dataclass(frozen=True, kw_only=True)
class ModelPortrait(OfModel):
    """States (N, K, n) at t = 0, T, ...; ``rested`` (N,) whether contacts accumulated.

    ``planes`` are pairs of variables, ``walls`` those at t = 0; ``event`` names the section.
    """

    states: Floats
    rested: NDArray[np.bool_]
    planes: tuple[tuple[str, str], ...]
    walls: tuple[Wall, ...]
    event: str

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return a row for each state."""
        N, K, _ = self.states.shape
        columns = dict(zip(self.state, np.moveaxis(self.states, 2, 0), strict=True))
        return {"orbit": np.arange(N)[:, None], "period": np.arange(K)[None, :], **columns}

    def lines(self) -> list[str]:
        """Return how many orbits there are, and where."""
        N, K, _ = self.states.shape
        lost = int(np.isnan(self.states[:, -1]).any(axis=1).sum())
        when = f"after each {self.event}" if self.event else "once a period"
        ranges = [
            f"{z} from {np.nanmin(q):.6g} to {np.nanmax(q):.6g}"
            for z, q in zip(self.state, np.moveaxis(self.states, 2, 0), strict=True)
        ]
        rested = int(self.rested.sum())
        words = [f"{rested} had contacts that accumulate"] if rested else []
        words += [f"{lost} are lost before the end"] if lost else []
        return [
            f"portrait of {self.described()}: {N} orbits, {K} states of each, {when}",
            "  " + ", ".join(ranges),
            *(f"  {each}" for each in words),
        ]


def portrait(  # noqa: PLR0913 (the options of the command)
    subject: Subject,
    *,
    box: tuple[float, ...] | None = None,
    orbits: int = 60,
    transient: int = 0,
    periods: int = 400,
    plane: tuple[str, ...] | None = None,
    runner: Runner | None = None,
) -> ModelPortrait:
    """Return states of orbits from a box, after a transient."""
    runner = runner or Runner()
    n = len(subject.system.state)
    if orbits * periods * n > MOST:
        raise BadInput(f"too many states: {orbits} orbits x {periods} (at most {MOST // n})")
    planes = (subject.named(plane),) if plane else subject.planes()
    starts = subject.seeds(orbits, subject.ranges(box))
    modes = subject.engine.begun(starts)
    rested = np.zeros(orbits, dtype=bool)
    if transient:
        ends = subject.engine.follow(starts, modes, periods=transient)
        well = np.isfinite(ends.states).all(axis=1)
        starts, modes, rested = ends.states[well], ends.modes[well], ends.counts[well, -1] > 0
        if not well.any():
            raise BadInput(f"all orbits are lost within {transient} periods")
    runner.tell("portrait", None)
    found = samples(subject, starts, modes, periods)
    autonomous = subject.system.autonomous
    at = np.zeros(1), starts[:1]
    return ModelPortrait(
        **about(subject),
        states=found.states,
        rested=rested | (found.counts[:, -1] > 0),
        planes=planes,
        walls=() if autonomous else walls(subject.system, *at, fixed=True),
        event=subject.engine.words[section(subject)] if autonomous else "",
    )
