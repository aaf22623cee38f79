"""Basins of a model: which states of a plane end on which attractor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.attractor import ModelAttractor, ends_of, listed
from cap.floats.models.resting import resting
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about
from cap.floats.models.walls import Wall, walls
from cap.runner import Runner

OUTSIDE = -2  # the label of a state that lies in no mode


@dataclass(frozen=True, kw_only=True)
class ModelBasin(OfModel):
    """The attractor, by its place in ``found``, of the states (y_j, z_i): ``label`` (M, N).

    The other variables are those of ``fixed``.  -1: the orbit is lost; -2: no mode has the state.
    """

    plane: tuple[str, str]
    first: Floats
    second: Floats
    label: NDArray[np.int64]
    found: tuple[ModelAttractor, ...]
    lost: str
    fixed: dict[str, float]
    walls: tuple[Wall, ...]
    told: tuple[str, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the states and where they end."""
        y, z = self.plane
        return {y: self.first[None, :], z: self.second[:, None], "attractor": self.label}

    def lines(self) -> list[str]:
        """Return the shares of the attractors."""
        inside = int((self.label != OUTSIDE).sum())
        others = "".join(f", {z} = {q:.6g}" for z, q in self.fixed.items())
        head = (
            f"basins of {self.described()}: {inside} states of the plane ({', '.join(self.plane)})"
        )
        rows = listed(self.found, hints=False)
        return [head + others, *rows, *([f"  {self.lost}"] if self.lost else []), *self.told]


def basin(  # noqa: PLR0913 (the options of the command)
    subject: Subject,
    *,
    box: tuple[float, ...] | None = None,
    plane: tuple[str, ...] | None = None,
    state: tuple[float, ...] | None = None,
    points: int = 120,
    transient: int = 300,
    runner: Runner | None = None,
) -> ModelBasin:
    """Return where the states of a grid end; the other variables are those of ``state``."""
    runner = runner or Runner()
    names = subject.system.state
    pair = subject.named(plane) if plane else subject.plane()
    y, z = (names.index(name) for name in pair)
    ranges = subject.ranges(box)
    base = ranges.mean(axis=1) if state is None else np.array(state, dtype=float)
    if base.shape != (len(names),):
        raise BadInput(f"--state takes {len(names)} numbers, {', '.join(names)}")
    first, second = (np.linspace(ranges[k, 0], ranges[k, 1], points) for k in (y, z))
    states = np.tile(base, (points, points, 1))
    states[..., y], states[..., z] = first[None, :], second[:, None]
    flat = states.reshape(-1, len(names))
    inside = subject.starting(flat)
    if not inside.any():
        raise BadInput("no state of the grid lies in a mode: give another --box or --state")
    runner.tell("basins", None)
    label = np.full(len(flat), OUTSIDE)
    alike, told = resting(subject, flat[inside])
    label[inside], found, lost = ends_of(subject, flat[inside], transient, alike)
    return ModelBasin(
        **about(subject),
        plane=pair,
        first=first,
        second=second,
        label=label.reshape(points, points),
        found=found,
        lost=lost,
        fixed={n: float(q) for n, q in zip(names, base, strict=True) if n not in pair},
        walls=walls(subject.system, np.zeros(1), base[None], fixed=True),
        told=tuple(f"  {line}" for line in told),
    )
