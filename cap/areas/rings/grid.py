"""Compiled, in doubles: which points of a grid around an island have orbits that stop or go out.

It steers; nothing rests on it.  A ring is given here as radii at equal angles, in the axes in which
motions near the center turn.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.rings.half_periods import Floats, flown, turned
from cap.sets.compiled import compiled, kernel

Masks = NDArray[np.uint64]
FAR = 0.05  # images of cells, as parts of the island, that are larger say nothing
SLOW = 0.05  # slower orbits are not followed
TURN = 2 * math.pi


class Plane(NamedTuple):
    """alpha, a; the center; the inverse M⁻¹ of the axes there."""

    alpha: float
    a: float
    y: float
    v: float
    m00: float
    m01: float
    m10: float
    m11: float


class Course(NamedTuple):
    """How orbits are followed: so many half periods, in a sense of time; they are out below c.

    They are out of a ring after multiples of so many half periods.  A cell is so much of the way
    to the next points.
    """

    steps: int
    every: int
    sense: float
    c: float
    room: float


class Box(NamedTuple):
    """A parallelogram, by its half axes (y, v) and (Y, V)."""

    y: float
    v: float
    Y: float
    V: float


@kernel
def radius(first: float, second: float, ring: Floats) -> float:
    """Return how far a ring is from the center in the direction of a vector."""
    part = math.atan2(second, first) / TURN
    place = (part + 1.0 if part < 0 else part) * ring.size
    i = int(place)
    w = place - i
    result: float = ring[i % ring.size] * (1 - w) + ring[(i + 1) % ring.size] * w
    return result


@kernel
def outside(y: float, v: float, box: Box, at: Plane, ring: Floats) -> bool:
    """Return whether the parallelogram around a state, less the center, is outside of a ring."""
    first, second = at.m00 * y + at.m01 * v, at.m10 * y + at.m11 * v
    if not math.hypot(first, second) > radius(first, second, ring):
        return False
    for k in range(4):
        s, r = (1.0 if k & 1 else -1.0), (1.0 if k & 2 else -1.0)
        dy, dv = s * box.y + r * box.Y, s * box.v + r * box.V
        p, q = first + at.m00 * dy + at.m01 * dv, second + at.m10 * dy + at.m11 * dv
        if not math.hypot(p, q) > radius(p, q, ring):
            return False
    return True


@kernel
def mask(y: float, v: float, box: Box, course: Course, at: Plane, ring: Floats) -> np.uint64:
    """Return after which numbers of half periods a cell, of half axes ``box``, is out: as bits.

    Out of a ring, if there is one, or below the speed c.
    """
    found, e = np.uint64(0), course.sense
    y *= e
    ay, av, by, bv = e * box.y, box.v, e * box.Y, box.V
    for k in range(course.steps):
        z = flown(y, v, at.alpha, at.a, e)
        if not abs(z.y) < at.a:
            break
        ay, av = turned(ay, av, z)
        by, bv = turned(by, bv, z)
        y, v = z.y, z.v
        out = v + abs(av) + abs(bv) < course.c
        if not out and ring.size and (k + 1) % course.every == 0:
            image = Box(e * ay, av, e * by, bv)
            small = abs(ay) + abs(av) + abs(by) + abs(bv) < FAR
            out = small and outside(e * y - at.y, v - at.v, image, at, ring)
        if out:
            found |= np.uint64(1) << np.uint64(k)
        if not v > SLOW:
            break
    return found


@compiled
def masks(
    states: Floats, first: int, course: Course, at: Plane, ring: Floats, found: Masks
) -> None:
    """Write the masks (n, M) of n columns, from the ``first``, of a grid of states (N, M, 2)."""
    (columns, rows), room = found.shape, course.room
    for n in range(columns):
        i = first + n
        beside = states[(i + 1) % states.shape[0]]
        for j in range(rows):
            k = j + 1 if j + 1 < rows else j - 1
            x, v = states[i, j]
            box = Box(
                room * (beside[j, 0] - x),
                room * (beside[j, 1] - v),
                room * (states[i, k, 0] - x),
                room * (states[i, k, 1] - v),
            )
            found[n, j] = mask(x, v, box, course, at, ring)
