"""Rings around an island, one inside the other: motions from them stop, or leave the one before.

A ring goes through points of a grid: rays from the center, and on each points between a curve on
which orbits stay and the ring before.  Links between them whose ends go out after as many half
periods are likely to do so; of all rings of such links the one is taken with the least area inside.
A link that is not proved is given up, and the ring sought again.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from cap.areas.rings.grid import Course, Masks, Plane, masks
from cap.areas.rings.half_periods import Floats, Laws, laws
from cap.areas.rings.path import JUMP, Integers, link, ring
from cap.areas.rings.proved import Edge, pieces
from cap.errors import NotProved
from cap.runner import Runner

COLUMNS, ROWS = 2048, 300
FIRST, LATER = 40, 60  # half periods, for the first ring and for others
ROOM = 0.5  # the part of a cell that goes out with its point
BEYOND = 0.65, 1.0, 1.5, 2.5  # how far out of the curve the first ring is looked for
CLOSE = 0.01  # how far out of the ring before another one is
TILT = 1e-2
BLOCK = 64  # columns in a task
BITS = 64  # of a mask
TRIES = 200
WORTH = 0.99  # a ring inside another one has at most this part of its area
UNIT = Fraction(1, 10**9)

Way = tuple[int, int]
"""Half periods, backward if negative, and pieces."""


class Ring(NamedTuple):
    """Vertices as offsets from the center in units 10^-9, with the way of each edge."""

    offsets: list[tuple[int, int]]
    ways: list[Way]

    @property
    def area(self) -> Fraction:
        """The area inside, exactly."""
        pairs = pairwise([*self.offsets, self.offsets[0]])
        return sum(a * d - b * c for (a, b), (c, d) in pairs) * UNIT**2 / 2

    @property
    def words(self) -> str:
        """The vertices as they are written."""
        return ",".join(f"{x} {v}" for x, v in self.offsets)

    @property
    def flights(self) -> str:
        """The ways of the edges as they are written."""
        return ",".join(f"{steps} {pieces}" for steps, pieces in self.ways)


class Island(NamedTuple):
    """Where rings are looked for: laws; the center; half periods; axes there, and a curve.

    ``curve``: radii of a curve on which orbits stay, in these axes, at equal angles.
    """

    alpha: Fraction
    a: Fraction
    centre: tuple[Fraction, Fraction]
    halves: int
    axes: Floats
    curve: Floats


@dataclass
class Level:
    """A grid, inside of a ring (None: of all), with its links and those that are proved."""

    island: Island
    radii: Floats
    forward: Masks
    backward: Masks
    states: Floats
    proved: dict[tuple[int, int, int], Way] = field(default_factory=dict)

    def ring(self, edges: Floats, most: float) -> tuple[Integers, list[Way]] | None:
        """Return the rows of the least ring that is proved, with ways; ``edges`` of that before.

        None if there is none of so little size: with each link given up rings only grow.
        """
        area = self.radii**2
        links = np.zeros((*area.shape, 2 * JUMP + 1), np.bool_)
        link(self.forward, self.backward, JUMP, links)
        prove = partial(self._way, laws(self.island.alpha, self.island.a), edges)
        for _ in range(TRIES):
            rows = ring(area, links, TILT)
            if rows is None or _size(self.radii[np.arange(len(rows)), rows]) > most:
                return None
            places = [*zip(range(len(rows)), rows, np.roll(rows, -1) - rows + JUMP, strict=True)]
            keys = [(int(i), int(j), int(m)) for i, j, m in places]
            for key in keys:
                if key not in self.proved:
                    self.proved[key] = prove(key)
                if not self.proved[key][1]:
                    links[key] = False
            if all(self.proved[key][1] for key in keys):
                return rows, [self.proved[key] for key in keys]
        return None

    def _way(self, given: Laws, edges: Floats, key: tuple[int, int, int]) -> Way:
        """Return how a link is proved, in the fewest half periods of all its pieces."""
        i, j, m = key
        n, k = (i + 1) % len(self.states), j + m - JUMP
        edge = Edge(*self.states[i, j].tolist(), *self.states[n, k].tolist())
        both = int(self.forward[i, j] & self.forward[n, k])
        back = int(self.backward[i, j] & self.backward[n, k])
        ways = [
            (s, e) for s in range(1, 65) for e, bits in ((1, both), (-1, back)) if bits >> s - 1 & 1
        ]
        best, least = (0, 0), math.inf
        for steps, e in ways:
            if steps >= least:
                break
            count = pieces(edge, steps, given, float(e), edges, self.island.halves)
            if count and steps * count < least:
                best, least = (e * steps, count), steps * count
        return best


def rings(island: Island, runner: Runner, tell: Callable[[str], None]) -> list[Ring]:
    """Return rings, each inside of the one before, as long as this is worth it."""
    found: list[Ring] = []
    before: Floats | None = None  # radii of the last ring
    edges, most = np.zeros((0, 2)), math.inf
    outers = [island.curve * (1 + beyond) for beyond in BEYOND]
    while outers:
        name = f"ring {len(found) + 1}"
        level = grid(island, outers.pop(0), before, runner, f"{name}: orbits are followed")
        tell(f"{name}: edges are proved")
        proved = level.ring(edges, most)
        if proved is None:
            continue
        rows, ways = proved
        found.append(_ring(level, rows, ways))
        tell(f"{name}: the area inside is {float(found[-1].area):.6g} F²/ω³")
        before = level.radii[np.arange(len(rows)), rows]
        edges = level.states[np.arange(len(rows)), rows]
        most, outers = WORTH * _size(before), [before * (1 + CLOSE)]
    if not found:
        raise NotProved("Lemma 2", "no ring around P* was found from which all motions stop")
    return found


def grid(island: Island, outer: Floats, before: Floats | None, runner: Runner, words: str) -> Level:
    """Return the grid up to ``outer``, with what stops, or is out of a ring, after which times."""
    part = np.linspace(0, 1, ROWS)
    radii = island.curve[:, None] + (outer - island.curve)[:, None] * part
    angle = 2 * math.pi * np.arange(COLUMNS) / COLUMNS
    away = np.stack([radii * np.cos(angle)[:, None], radii * np.sin(angle)[:, None]], axis=-1)
    centre = np.array([float(z) for z in island.centre])
    unit = float(UNIT)
    states = np.round(away @ island.axes.T / unit) * unit + centre
    inverse = np.linalg.inv(island.axes)
    alpha, a = float(island.alpha), float(island.a)
    at = Plane(alpha, a, *centre.tolist(), *inverse.ravel().tolist())
    b = math.acos(alpha)
    c = math.sin(b) - alpha * b
    out = np.zeros(0) if before is None else before
    steps = FIRST if before is None else LATER
    found = np.zeros((2, COLUMNS, ROWS), np.uint64)
    tasks = [(s, k) for s in (0, 1) for k in range(0, COLUMNS, BLOCK)]

    def follow(task: tuple[int, int]) -> None:
        s, k = task
        course = Course(steps, island.halves, 1.0 - 2 * s, c, ROOM)
        masks(states, k, course, at, out, found[s, k : k + BLOCK])

    runner.map(follow, tasks, words)
    return Level(island, radii, found[0], found[1], states)


def _size(radii: Floats) -> float:
    """Return the area inside a ring of radii at equal angles, in some unit."""
    return float(radii @ np.roll(radii, -1))


def _ring(level: Level, rows: Integers, ways: list[Way]) -> Ring:
    """Return a ring as it is written: it begins with the first vertex above the axis."""
    states = level.states[np.arange(len(rows)), rows]
    centre = np.array([float(z) for z in level.island.centre])
    away = np.round((states - centre) / float(UNIT)).astype(np.int64)
    below = away[:, 1] < 0
    begin = int(np.flatnonzero(~below & np.roll(below, 1))[0])
    offsets = [(int(x), int(v)) for x, v in np.roll(away, -begin, axis=0)]
    return Ring(offsets, [*ways[begin:], *ways[:begin]])
