"""Compiled: which parallelograms the image of one lies across, by halving boxes of it.

What a covering is, and how it is seen on a box: `cap.checker.coverings.covering`, whose own text
decides in the end.  Bounds are asked for with a little `ROOM`, and with `MOST` boxes, fewer than
there: so that what is found here holds there.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.parallelograms.planar import Columns, Planar, image
from cap.areas.rings.half_periods import Floats
from cap.sets.compiled import PROBE, compiled, kernel, require_ieee, rounds_to_nearest
from cap.sets.doubles import Interval, enclosing, is_finite, lower, magnitude, upper

MOST = 2900  # boxes for all coverings of one set, or by one edge
SMALL = 2.0**-8  # boxes on which the map is not seen to be defined are halved down to this
ROOM = 2.0**-40
TORN = 2  # on no side
NUMBERS = 10  # of a set: centre, the axes a and b, the rows of the inverse

Bools = NDArray[np.bool_]


class Box(NamedTuple):
    """Points with p in [p0, p1] and q in [q0, q1]."""

    p0: float
    p1: float
    q0: float
    q1: float


class Seen(NamedTuple):
    """The image of the middle of a box, the derivative times both axes, half the sides."""

    x: Interval
    v: Interval
    columns: Columns
    p: float
    q: float


class Task(NamedTuple):
    """A map, and sets: `numbers` (NUMBERS, 2) of the source, (N, NUMBERS, 2) of targets."""

    kind: int
    constants: Floats
    source: Floats
    targets: Floats


class Stack(NamedTuple):
    """Boxes (M, 4) that wait, and (M, N) for which targets nothing is decided there."""

    boxes: Floats
    undecided: Bools


def numbers(given: Sequence[Fraction]) -> Floats:
    """Return what is computed with of a set (cx, cy, ax, ay, bx, by): intervals (NUMBERS, 2)."""
    _, _, ax, ay, bx, by = given
    determinant = ax * by - ay * bx
    inverse = (by / determinant, -bx / determinant, -ay / determinant, ax / determinant)
    return np.array([(x.mid, x.rad) for x in map(enclosing, (*given, *inverse))])


@kernel
def _number(of: Floats, n: int) -> Any:
    return Interval(of[n, 0], of[n, 1])


@kernel
def _seen(task: Task, box: Box) -> Any:
    """Return what is known on a box of a set; with NaN unless the map is certainly defined."""
    p, q = 0.5 * (box.p0 + box.p1), 0.5 * (box.q0 + box.q1)  # exactly, as boxes are halved
    P, Q = Interval(p, 0.5 * (box.p1 - box.p0)), Interval(q, 0.5 * (box.q1 - box.q0))
    cx, cv = _number(task.source, 0), _number(task.source, 1)
    ax, av = _number(task.source, 2), _number(task.source, 3)
    bx, bv = _number(task.source, 4), _number(task.source, 5)
    axes = Columns(ax, av, bx, bv)
    x, v = cx + ax * p + bx * q, cv + av * p + bv * q
    x, v, _ = image(task.kind, task.constants, x, v, axes)
    X, V = cx + ax * P + bx * Q, cv + av * P + bv * Q
    _, _, columns = image(task.kind, task.constants, X, V, axes)
    return Seen(x, v, columns, P.rad, Q.rad)


@kernel
def _is_defined(z: Seen) -> bool:
    return is_finite(z.x) and is_finite(z.columns.x0)


@kernel
def _coordinate(z: Seen, target: Floats, row: int) -> Any:
    """Return P (row 6) or Q (row 8) on a box, and what p and q add to its radius."""
    m, n = _number(target, row), _number(target, row + 1)
    x, v = z.x - _number(target, 0), z.v - _number(target, 1)
    by_p = (m * z.columns.x0 + n * z.columns.v0) * Interval(0.0, z.p)
    by_q = (m * z.columns.x1 + n * z.columns.v1) * Interval(0.0, z.q)
    return m * x + n * v + by_p + by_q, by_p.rad, by_q.rad


@kernel
def _beyond(P: Interval) -> int:
    """Return 1 if P > 1, -1 if P < -1, 0 if that is not certain."""
    if lower(P) > 1.0 + ROOM:
        return 1
    return -1 if upper(P) < -1.0 - ROOM else 0


@kernel
def _begin(stack: Stack, box: Box) -> None:
    """Write the first box; nothing is decided."""
    stack.boxes[0, 0], stack.boxes[0, 1], stack.boxes[0, 2], stack.boxes[0, 3] = box
    for j in range(stack.undecided.shape[1]):
        stack.undecided[0, j] = True


@kernel
def _box(stack: Stack, n: int) -> Any:
    return Box(stack.boxes[n, 0], stack.boxes[n, 1], stack.boxes[n, 2], stack.boxes[n, 3])


@kernel
def _halve(stack: Stack, n: int, along_p: bool) -> None:
    """Write the halves of the box at the place n there, and at n + 1."""
    for k in range(4):
        stack.boxes[n + 1, k] = stack.boxes[n, k]
    first = 0 if along_p else 2
    middle = 0.5 * (stack.boxes[n, first] + stack.boxes[n, first + 1])
    stack.boxes[n, first + 1] = stack.boxes[n + 1, first] = middle
    for j in range(stack.undecided.shape[1]):
        stack.undecided[n + 1, j] = stack.undecided[n, j]


@kernel
def _look_beyond(task: Task, z: Seen, undecided: Bools, sides: Any) -> int:
    """Write on which sides the image of a part of an edge lies; return how often one looked."""
    count = 0
    for j in range(len(sides)):
        if undecided[j]:
            count += 1
            side = _beyond(_coordinate(z, task.targets[j], 6)[0])
            if side != 0:
                undecided[j] = False
                sides[j] = side if sides[j] in (0, side) else TORN
    return count


@kernel
def _sides(task: Task, p: float, sides: Any, stack: Stack) -> int:
    """Write on which sides of targets the image of an edge lies, `TORN` if on both.

    Return the number of boxes, of each target, or minus it where it is too large.
    """
    count, n = 0, 1
    _begin(stack, Box(p, p, -1.0, 1.0))
    for j in range(len(sides)):
        sides[j] = 0
    while n > 0:
        n -= 1
        box, undecided = _box(stack, n), stack.undecided[n]
        z = _seen(task, box)
        for j in range(len(sides)):
            undecided[j] = undecided[j] and sides[j] != TORN
        if _is_defined(z):
            count += _look_beyond(task, z, undecided, sides)
        elif box.q1 - box.q0 > SMALL:
            count += 1
        else:
            return -count - 1
        if count > MOST:
            return -count
        if undecided.any():
            _halve(stack, n, False)
            n += 2
    return count


@kernel
def _look_across(task: Task, z: Seen, undecided: Bools) -> bool:
    """Write what is decided on a box; return whether it is better halved along p."""
    first, along_p = True, True
    for j in range(len(undecided)):
        if undecided[j]:
            Q, by_p, by_q = _coordinate(z, task.targets[j], 8)
            P, also_p, also_q = _coordinate(z, task.targets[j], 6)
            undecided[j] = not (_beyond(P) != 0 or magnitude(Q) < 1.0 - ROOM)
            if undecided[j] and first:
                first, along_p = False, by_p + also_p >= by_q + also_q
    return along_p


def _covered(task: Task, held: Bools, sides: Any, stack: Stack) -> int:
    """Write which targets are covered; return the number of boxes, or minus it if too large."""
    count = 0
    for p, row in ((-1.0, 0), (1.0, 1)):
        more = _sides(task, p, sides[row], stack)
        if more < 0:
            return more - count
        count += more
    _begin(stack, Box(-1.0, 1.0, -1.0, 1.0))
    for j in range(len(held)):
        held[j] = sides[0, j] == -sides[1, j] and sides[0, j] != TORN
        stack.undecided[0, j] = held[j]
    n = 1 if held.any() else 0
    while n > 0:
        n -= 1
        count += 1
        box, undecided = _box(stack, n), stack.undecided[n]
        wide, high = box.p1 - box.p0, box.q1 - box.q0
        z, along_p = _seen(task, box), wide >= high
        if _is_defined(z):
            along_p = _look_across(task, z, undecided)
        elif not min(wide, high) > SMALL:
            return -count
        if count > MOST:
            return -count
        if undecided.any():
            _halve(stack, n, along_p)
            n += 2
    return count


_COVERED = compiled(_covered)
_ROUNDS = compiled(rounds_to_nearest)


class Engine:
    """A map; ``boxes`` is how many were looked at."""

    def __init__(self, g: Planar) -> None:
        require_ieee(bool(_ROUNDS(PROBE)))
        self.g, self.boxes = g, 0

    def covered(self, source: Floats, targets: Floats) -> Bools:
        """Return which of the targets a set covers.

        Sets are given by their `numbers`, targets (N, NUMBERS, 2).
        """
        held = np.zeros(len(targets), bool)
        if not self._run(source, targets, held):
            for k in range(len(targets)):
                one = held[k : k + 1]
                one[0] = self._run(source, targets[k : k + 1], one) and one[0]
        return held

    def _run(self, source: Floats, targets: Floats, held: Bools) -> bool:
        """Write which targets are covered; return whether few enough boxes decided it."""
        count = len(targets)
        sides = np.zeros((2, count), np.int64)
        stack = Stack(np.empty((MOST + 2, 4)), np.empty((MOST + 2, count), bool))
        found = _COVERED(Task(*self.g, source, targets), held, sides, stack)
        self.boxes += abs(found)
        return bool(found >= 0)
