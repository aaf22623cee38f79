"""The portrait of a model of two variables that fills: many orbits, once a period of the clock."""

from collections.abc import Iterator

import numpy as np

from cap.errors import BadInput
from cap.explore.play.sea import (
    EMPTY,
    ENDS,
    FIRST_END,
    GREY,
    ORBITS,
    PALETTE,
    PERIODS,
    STEP,
    Raster,
)
from cap.floats.diagnostics.grid import Box
from cap.floats.findings import Floats, State
from cap.floats.models.attractor import CONTINUUM, ModelAttractor, ends_of
from cap.floats.models.subject import Subject

WANDERS = "no short period"
SEEDS, TRANSIENT = 150, 300  # orbits, and periods after which one is on its attractor


class OwnSea(Raster):
    """The portrait of a model, seen in a box (default: where the orbits go)."""

    def __init__(self, subject: Subject, box: Box | None = None) -> None:
        super().__init__()
        self.subject, self.order = subject, order(subject)
        ranges = subject.box if box is None else np.array(box).reshape(2, 2)[self.order]
        self.states = subject.seeds(SEEDS, ranges)
        self.modes = subject.engine.begun(self.states)
        label, self.ends, _ = ends_of(subject, self.states, TRANSIENT)
        self.colours = np.full(len(label), GREY, dtype=np.uint8)
        self.colours[label < 0] = EMPTY
        for k, end in enumerate(self.ends):
            own = np.flatnonzero(label == k)
            wanders = end.kind == WANDERS or end.kind.startswith(CONTINUUM)
            self.colours[own] = (
                2 + np.arange(len(own)) % len(ORBITS) if wanders else _colour(end, k)
            )
        (left, right), (low, high) = ranges[self.order]
        self.box = float(left), float(right), float(low), float(high)

    def _followed(self) -> Floats:
        """Return the next states (N, K, 2) of the orbits that are not lost."""
        found = self.subject.engine.follow(self.states, self.modes, periods=STEP, every=True)
        well = np.isfinite(found.states).all(axis=1)
        self.states, self.modes = found.states[well], found.modes[well]
        self.colours = self.colours[well]
        if not well.any():
            self.done = PERIODS
        return np.asarray(found.path[well][..., self.order])

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give a colour and words for each end that orbits have."""
        for k, end in enumerate(self.ends):
            yield PALETTE[_colour(end, k)], f"{end.share:.0%} {end.kind}: {end.events}"

    @property
    def first(self) -> State:
        """The state whose orbit is shown first: one of the largest end."""
        x, y = self.ends[0].states[0][self.order].tolist()
        return x, y

    def cycles(self) -> Iterator[tuple[Floats, str]]:
        """Give the states of each cycle that attracts, and its colour."""
        for k, end in enumerate(self.ends):
            if end.kind.startswith("period"):
                yield end.states[:, self.order], PALETTE[_colour(end, k)]


def order(subject: Subject) -> list[int]:
    """Return the places of the position and the velocity in the state."""
    return [subject.system.state.index(z) for z in subject.plane()]


def own_state(subject: Subject, point: State) -> tuple[float, ...]:
    """Return the state at a point of the plane of position and velocity."""
    at = dict(zip(subject.plane(), point, strict=True))
    return tuple(at[z] for z in subject.system.state)


def confirm(subject: Subject) -> None:
    """Raise `BadInput` unless the page is about such a model."""
    state = subject.system.state
    if len(state) != 2:
        raise BadInput(
            f"the page is about models of two variables: this one has {', '.join(state)} "
            "(cap.explore orbit and portrait draw it)"
        )
    if subject.system.autonomous:
        raise BadInput(
            "the page is about models with a clock: here nothing depends on cos or sin "
            "(cap.explore orbit and portrait draw it)"
        )


def _colour(end: ModelAttractor, place: int) -> int:
    """Return the colour of an end: that of a cycle, or of rest, by its place; else grey."""
    if end.kind == WANDERS:
        return 2
    return FIRST_END + place % len(ENDS) if end.kind.startswith(("period", "rests")) else GREY
