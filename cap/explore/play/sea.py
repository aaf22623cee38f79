"""The portrait that fills: many orbits, seen once in a period, on a raster of what is looked at.

A point of the raster has the colour of the last orbit that came by.  The orbits start all over the
part that is looked at, and near the elliptic orbit, if one is found.
"""

from abc import abstractmethod
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics.attractor import Attractor, settle, sort
from cap.floats.diagnostics.grid import Box, grid, whole
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.search.fixed_point import elliptic_point
from cap.parameters import Parameters
from cap.pictures.style import BLUE, GREEN, ORANGE, PURPLE, RED, SKY

SIDE = 320  # pixels
SEEDS = 14  # per side
NEAR = 60  # orbits near the elliptic one
MARGIN = 0.05  # around what is visited
REACH = 1 / 12  # of those near it, in units of R and Rω
TRANSIENT, SETTLED = 500, 128  # periods after which an orbit is on its attractor, and those seen
PERIODS, STEP = 3000, 10  # until the portrait is full, and at a time
ORBITS = (BLUE, GREEN, PURPLE, ORANGE, SKY)  # of orbits that never stop, where areas are kept
ENDS = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY)  # of attractors, the largest share first
EMPTY, GREY = 0, 1
PALETTE = ("#FFFFFF", "#888888", *ORBITS, *ENDS)
FIRST_END = 2 + len(ORBITS)
GOLDEN = 2.399963229728653


class Raster:
    """Pixels of a box, in the colours of the orbits that came by last.

    ``box``: what is looked at; ``colours`` (N,): those of the orbits.
    """

    box: Box
    colours: NDArray[np.uint8]

    def __init__(self) -> None:
        self.raster = np.zeros((SIDE, SIDE), dtype=np.uint8)
        self.done = 0

    @property
    def full(self) -> bool:
        """Whether it has been filled for long enough."""
        return self.done >= PERIODS

    def fill(self) -> None:
        """Follow all orbits a little further."""
        self._mark(self._followed())
        self.done += STEP

    @abstractmethod
    def _followed(self) -> Floats:
        """Return the next states (N, K, 2) of all orbits."""

    @abstractmethod
    def lines(self) -> Iterator[tuple[str, str]]:
        """Give a colour and words for each end that orbits have."""

    @property
    @abstractmethod
    def first(self) -> State:
        """The state whose orbit is shown first."""

    @abstractmethod
    def cycles(self) -> Iterator[tuple[Floats, str]]:
        """Give the states of each cycle that attracts, and its colour."""

    def marks(self) -> tuple[list[float], list[float], list[str]]:
        """Return the states of the cycles that attract, and their colours."""
        every = [(*state, colour) for states, colour in self.cycles() for state in states.tolist()]
        return [x for x, _, _ in every], [y for _, y, _ in every], [colour for *_, colour in every]

    def _mark(self, states: Floats) -> None:
        """Colour the pixels of states (N, K, 2); what is outside the box is left out."""
        left, right, low, high = self.box
        colour = np.broadcast_to(self.colours[:, None], states.shape[:2])
        with np.errstate(invalid="ignore"):
            a = (states[..., 0] - left) / (right - left) * SIDE
            b = (states[..., 1] - low) / (high - low) * SIDE
            inside = (a >= 0) & (a <= SIDE) & (b >= 0) & (b <= SIDE)
        i, j = (np.minimum(z[inside].astype(int), SIDE - 1) for z in (b, a))
        self.raster[i, j] = colour[inside]


class Sea(Raster):
    """The portrait at some parameters, seen in a box (default: where the orbits go)."""

    def __init__(self, p: Parameters, box: Box | None = None) -> None:
        super().__init__()
        self.p, self.centre = p, elliptic_point(p)
        self.states = _seeds(p, box or whole(p), self.centre)
        settled = settle(p, self.states, TRANSIENT, SETTLED)
        label, self.ends = sort(p, [settled])
        self.colours = _coloured(label, self.ends)
        self.box = box or _visited(p, settled.states)

    def _followed(self) -> Floats:
        """Return the next states (N, K, 2) of all orbits."""
        found = swarm.follow(self.p, self.states, STEP, every=True).states
        self.states = found[:, -1]
        return found[:, 1:]

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give a colour and words for each end that orbits have."""
        for k, end in enumerate(self.ends):
            r, l = end.hits
            told = f"{end.kind}: hits {r:.3g} right, {l:.3g} left, {end.turns:.3g} turns, "
            yield PALETTE[_colour_of_end(end, k)], f"{told}{end.sticks:.3g} sticks per T"

    @property
    def first(self) -> State:
        """The state whose orbit is shown first: the elliptic one, or one of the largest end."""
        if self.centre is not None or not self.ends:
            return self.centre or (float(self.p.l + self.p.r) / 2, 0.0)
        x, v = self.ends[0].states[0].tolist()
        return x, v

    def cycles(self) -> Iterator[tuple[Floats, str]]:
        """Give the states of each cycle that attracts, and its colour."""
        for k, end in enumerate(self.ends):
            if end.period:
                yield end.states, PALETTE[_colour_of_end(end, k)]


def _seeds(p: Parameters, box: Box, centre: State | None) -> Floats:
    """Return states all over a box, and on a spiral around the centre if there is one."""
    left, right, low, high = box
    between = max(left, float(p.l)), min(right, float(p.r)), low, high
    if not between[0] < between[1]:
        between = whole(p)
    cells = grid(p, between, SEEDS)
    states = cells.states(slice(0, cells.count))
    if centre is None:
        return states
    k = np.arange(NEAR)
    r, angle = REACH * np.sqrt((k + 0.5) / NEAR), GOLDEN * k
    x = np.clip(centre[0] + float(p.R) * r * np.cos(angle), float(p.l), float(p.r))
    v = centre[1] + float(p.R * p.omega) * r * np.sin(angle)
    return np.concatenate([states, np.stack([x, v], axis=-1)])


def _visited(p: Parameters, states: Floats) -> Box:
    """Return the box of all places, and of the velocities of states (N, K, 2) and some more."""
    left, right, low, high = whole(p)
    v = states[..., 1]
    v = v[np.isfinite(v)]
    if not len(v):
        return left, right, low, high
    more = MARGIN * (float(v.max() - v.min()) + float(p.R * p.omega))
    return left, right, float(v.min()) - more, float(v.max()) + more


def _coloured(label: NDArray[np.int64], ends: tuple[Attractor, ...]) -> NDArray[np.uint8]:
    """Return the colour (N,) of each orbit, by where it ends."""
    colours = np.full(len(label), GREY, dtype=np.uint8)
    for k, end in enumerate(ends):
        own = np.flatnonzero(label == k)
        if end.kind == "never turns":
            colours[own] = 2 + np.arange(len(own)) % len(ORBITS)
        else:
            colours[own] = _colour_of_end(end, k)
    return colours


def _colour_of_end(end: Attractor, place: int) -> int:
    """Return the colour of an end: that of a cycle by its place, grey for what has no period."""
    if end.kind == "never turns":
        return 2
    return FIRST_END + place % len(ENDS) if end.period else GREY
