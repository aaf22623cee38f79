"""Compiled: many cells, period after period, each with all its branches."""

import math
from collections.abc import Callable
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from cap.boxes.doubleton import (
    Doubleton,
    Frame,
    box_of,
    carry,
    clear,
    derivative,
    frame_box,
    image,
    product,
    set_box,
)
from cap.boxes.flight import Matrix
from cap.boxes.motion import FLY, LOST, STOPPED, Motion
from cap.boxes.period import DEEPEST, Choices, World, advanced, follow_branch
from cap.boxes.targets import Targets, strobe_label
from cap.boxes.units import inner_box, place, speed_of
from cap.sets.compiled import PROBE, compiled, kernel, rounds_to_nearest, rows
from cap.sets.doubles import Interval, hull, is_finite, lower, magnitude, upper
from cap.sets.records import Record, assign

Floats = NDArray[np.float64]

ROOM = 48  # sets of a cell that may be alive at a strobe
SMOOTH, UNION, OPEN = 0, 1, 2
EVERY = (1 << STOPPED + 1) - 1

doubleton = rows(Doubleton)


Follow = Callable[[World, Targets, Floats, int, "Memory", "Result"], bool]


class Derivative(Record):
    """Matrices: a point matrix ((a, b), (c, d)), and the errors of its columns."""

    a: float
    b: float
    c: float
    d: float
    first: Frame
    second: Frame


class Cell(Record):
    """What is known of a cell so far; labels and words are those of the branches that have ended.

    ``motion`` and ``image`` are room.
    """

    label: int
    branches: int
    smooth: int
    surely: int
    possibly: int
    itinerary: int
    derivative: Derivative
    motion: Motion
    image: Doubleton


class Room(NamedTuple):
    """Memory for one cell: its sets now and next (rows are doubletons), and the choices."""

    now: Floats
    next: Floats
    choices: Choices


class Memory(NamedTuple):
    """All the memory that following cells, one after the other, needs; and `PROBE`."""

    room: Room
    cell: Cell
    probe: Floats


class Result(NamedTuple):
    """What is written of N cells; see `cap.boxes.flow.Images`."""

    verdict: NDArray[np.int8]
    label: NDArray[np.int64]
    periods: NDArray[np.int64]
    branches: NDArray[np.int64]
    alive: NDArray[np.int64]
    surely: NDArray[np.int64]
    possibly: NDArray[np.int64]
    itinerary: NDArray[np.int64]
    states: Floats
    derivative: Floats


def memory() -> Memory:
    """Return memory for cells."""
    taken, ways = (np.zeros(DEEPEST + 1, dtype=np.int64) for _ in range(2))
    now, following = (np.zeros((ROOM, Doubleton.SIZE)) for _ in range(2))
    return Memory(Room(now, following, Choices(taken, ways)), Cell(), PROBE)


@kernel
def _meet(x: Interval, y: Interval) -> bool:
    return upper(x) >= lower(y) and upper(y) >= lower(x)


@kernel
def _keep(table: Floats, count: int, d: Doubleton) -> int:
    """Add a set to the table, or join it to one that it meets; return how many there are.

    -1 if there is no room, or the set is not bounded.
    """
    x, v = box_of(d)
    if not (is_finite(x) and is_finite(v)):
        return -1
    for k in range(count):
        other = doubleton(table, k)
        X, V = box_of(other)
        if other.kind == d.kind and other.side == d.side and _meet(x, X) and _meet(v, V):
            set_box(other, d.kind, d.side, hull(x, X), hull(v, V))
            other.surely = other.surely & d.surely
            other.possibly = other.possibly | d.possibly
            return count
    if count == len(table):
        return -1
    assign(doubleton(table, count), d)
    return count + 1


@kernel
def _carry_column(errors: Frame, A: Matrix, x: float, v: float, rad_x: float, rad_v: float) -> None:
    """Replace the errors of a column (x, v) by those of its image under A, known up to a box."""
    far, fast = frame_box(errors)
    dx, dv = magnitude(Interval(abs(x), far)), magnitude(Interval(abs(v), fast))
    more_x, more_v = rad_x + (A.a.rad * dx + A.b.rad * dv), rad_v + (A.c.rad * dx + A.d.rad * dv)
    carry(errors, A, magnitude(Interval(more_x, 0.0)), magnitude(Interval(more_v, 0.0)))


@kernel
def chain(m: Derivative, A: Matrix) -> None:
    """Replace a derivative by that of the composition with a map of derivative A."""
    new = product(A, m.a, m.b, m.c, m.d)
    _carry_column(m.first, A, m.a, m.c, new.a.rad, new.c.rad)
    _carry_column(m.second, A, m.b, m.d, new.b.rad, new.d.rad)
    m.a, m.b, m.c, m.d = new.a.mid, new.b.mid, new.c.mid, new.d.mid


@kernel
def _note(cell: Cell, alone: bool) -> None:
    """Note one branch more, the motion of the cell."""
    n = cell.motion
    cell.branches = cell.branches + 1
    if not (alone and cell.smooth != 0 and n.certain != 0):
        cell.smooth, cell.itinerary = 0, -1
        return
    chain(cell.derivative, derivative(n))
    cell.itinerary = n.itinerary


@kernel
def _reach(cell: Cell, label: int, surely: int, possibly: int) -> None:
    """Note that a branch ends with a label."""
    cell.label, cell.smooth = cell.label | label, 0
    cell.surely, cell.possibly = cell.surely & surely, cell.possibly | possibly


@kernel
def _span(world: World, targets: Targets, room: Room, count: int, cell: Cell) -> int:
    """Follow all sets of a cell through a span; return how many there are then, -1 if too many."""
    alive, n = 0, cell.motion
    for k in range(count):
        source, depth = doubleton(room.now, k), 0
        while True:
            depth, label = follow_branch(world, targets, source, n, room.choices, depth)
            _note(cell, count == 1 and depth == 0)
            surely, possibly = source.surely | n.words, source.possibly | n.words | n.maybe
            if label != 0:
                _reach(cell, label, surely, possibly)
            elif n.kind == LOST:
                return -1
            else:
                image(n, world.system, source, cell.image)
                cell.image.surely, cell.image.possibly = surely, possibly
                alive = _keep(room.next, alive, cell.image)
                if alive < 0:
                    return -1
            depth = advanced(room.choices, depth)
            if depth == 0:
                break
    return _strobe(world, targets, room, alive, cell)


@kernel
def _strobe(world: World, targets: Targets, room: Room, alive: int, cell: Cell) -> int:
    """Make the next sets the present ones, but for those in a region that is a target."""
    count = 0
    for k in range(alive):
        d = doubleton(room.next, k)
        label = strobe_label(targets, world.units, d)
        if label != 0:
            _reach(cell, label, d.surely, d.possibly)
        else:
            assign(doubleton(room.now, count), d)
            count += 1
    return count


@kernel
def _begin(world: World, box: Floats, room: Room, cell: Cell) -> int:
    """Write the set of a cell; return how many sets there are: 1, or -1 if it is no box."""
    x, v = inner_box(world.units, (box[0], box[1]), (box[2], box[3]))
    d, m = doubleton(room.now, 0), cell.derivative
    set_box(d, FLY, 0.0, x, v)
    d.surely, d.possibly = 0, 0
    m.a, m.b, m.c, m.d = 1.0, 0.0, 0.0, 1.0
    clear(m.first)
    clear(m.second)
    cell.label, cell.branches, cell.smooth = 0, 0, 1
    cell.surely, cell.possibly, cell.itinerary = EVERY, 0, -1
    return 1 if is_finite(x) and is_finite(v) else -1


@kernel
def _write_states(world: World, table: Floats, count: int, states: Floats) -> None:
    """Write a box that contains all sets."""
    states[0], states[1], states[2], states[3] = math.inf, -math.inf, math.inf, -math.inf
    for k in range(count):
        x, v = box_of(doubleton(table, k))
        x, v = place(world.units, x), speed_of(world.units, v)
        states[0], states[1] = min(states[0], lower(x)), max(states[1], upper(x))
        states[2], states[3] = min(states[2], lower(v)), max(states[3], upper(v))


@kernel
def _write_derivative(world: World, m: Derivative, entries: Floats) -> None:
    """Write the lower and upper ends of the derivative's entries, row by row."""
    (p, r), (q, s) = frame_box(m.first), frame_box(m.second)
    rate = world.units.speed / world.units.length
    matrix = Interval(m.a, p), Interval(m.b, q) / rate, Interval(m.c, r) * rate, Interval(m.d, s)
    for j, entry in enumerate(matrix):
        entries[2 * j], entries[2 * j + 1] = lower(entry), upper(entry)


@kernel
def _write(world: World, room: Room, i: int, count: int, cell: Cell, out: Result) -> None:
    """Write what is known of the i-th cell, which has ``count`` sets left."""
    surely, possibly = cell.surely, cell.possibly
    for k in range(count):
        d = doubleton(room.now, k)
        surely, possibly = surely & d.surely, possibly | d.possibly
    smooth = cell.smooth != 0 and count == 1
    out.verdict[i] = SMOOTH if smooth else UNION if count >= 0 else OPEN
    out.label[i], out.branches[i], out.alive[i] = cell.label, cell.branches, count
    out.surely[i], out.possibly[i] = (surely, possibly) if count >= 0 else (0, EVERY)
    out.itinerary[i] = cell.itinerary if smooth else -1
    out.states[i], out.derivative[i] = math.nan, math.nan
    if count > 0:
        _write_states(world, room.now, count, out.states[i])
    if smooth:
        _write_derivative(world, cell.derivative, out.derivative[i])


def _compiled() -> Follow:
    @compiled
    def follow(world, targets, boxes, periods, memory, out):  # type: ignore[no-untyped-def]
        """Follow cells; see `FOLLOW`."""
        room, cell, probe = memory
        if not rounds_to_nearest(probe):
            return False
        for i in range(len(boxes)):
            count, k = _begin(world, boxes[i], room, cell), 0
            while k < periods and count > 0:
                count = _span(world, targets, room, count, cell)
                k += 1
            out.periods[i] = k
            _write(world, room, i, count, cell, out)
        return True

    return cast(Follow, follow)


FOLLOW = _compiled()
"""Follow the cells ``boxes`` (N, 4), rows (x low, x high, v low, v high), for some periods.

(world, targets, boxes, periods, memory, out) -> whether the processor rounds as it should.
"""
