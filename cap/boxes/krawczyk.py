"""Compiled: fixed points of Φ, one per box, at parameters that may differ from box to box.

Krawczyk's operator, as in `cap.maps.krawczyk`: for a box Z = m + [-r, r] and any matrix C,

    K(Z) - m = -C (Φ(m) - m) + (1 - C (Φ'(Z) - 1)) [-r, r].

If that lies in the interior of [-r, r], Φ has exactly one fixed point in Z, and it lies in K(Z).
"""

from collections.abc import Callable
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from cap.boxes.doubleton import derivative, set_box
from cap.boxes.flight import Matrix
from cap.boxes.follow import Cell, Memory
from cap.boxes.motion import FLY
from cap.boxes.period import World, follow_branch
from cap.boxes.targets import Targets
from cap.boxes.units import inner_box, place, speed_of
from cap.sets.circular import PI, TURN, acos
from cap.sets.compiled import compiled, kernel, rounds_to_nearest
from cap.sets.doubles import (
    Interval,
    between,
    lower,
    magnitude,
    sqrt,
    upper,
)

Floats = NDArray[np.float64]


class Found(NamedTuple):
    """What is written of N boxes; see `cap.boxes.existence.FixedPoints`."""

    proved: NDArray[np.bool_]
    itinerary: NDArray[np.int64]
    boxes: Floats
    trace: Floats
    rotation: Floats


Search = Callable[[World, Targets, Floats, Floats, Memory, Found], bool]


@kernel
def _with_friction(world: World, alpha: Interval) -> None:
    """Write the constants that depend on α = f/F."""
    y, near = world.system, world.near
    y.alpha, y.arc = alpha, acos(alpha)
    y.sine = sqrt((1.0 - alpha) * (1.0 + alpha))
    y.slow_right, y.slow_left = TURN - y.arc, PI - y.arc
    near.alpha, near.arc, near.sine = alpha.mid, y.arc.mid, y.sine.mid
    near.slow_right, near.slow_left = y.slow_right.mid, y.slow_left.mid


@kernel
def _inverse(A: Matrix) -> tuple[float, float, float, float]:
    """Return nearly the inverse of A - 1: it needs no trust."""
    a, b, c, d = A.a.mid - 1, A.b.mid, A.c.mid, A.d.mid - 1
    det = a * d - b * c
    return d / det, -b / det, -c / det, a / det


@kernel
def _contracted(
    A: Matrix, defect: tuple[Interval, Interval], r: tuple[float, float]
) -> tuple[Interval, Interval]:
    """Return K(Z) - m, from Φ'(Z) and Φ(m) - m."""
    p, q, s, t = _inverse(A)
    a, b, c, d = A.a - 1.0, A.b, A.c, A.d - 1.0
    x, v = Interval(0.0, r[0]), Interval(0.0, r[1])
    first = (1.0 - (p * a + q * c)) * x - (p * b + q * d) * v
    second = (1.0 - (s * b + t * d)) * v - (s * a + t * c) * x
    return first - (p * defect[0] + q * defect[1]), second - (s * defect[0] + t * defect[1])


@kernel
def _rotation(trace: Interval) -> Interval:
    """Return Θ/2π in (0, 1/2) with trace = 2 cos Θ; NaN unless |trace| < 2 is certain."""
    return acos(0.5 * trace) / TURN


@kernel
def _search(world: World, targets: Targets, box: Floats, cell: Cell, memory: Memory) -> bool:
    """Follow a box; return whether all of it is mapped by one smooth map."""
    x, v = inner_box(world.units, (box[0], box[1]), (box[2], box[3]))
    d, n = cell.image, cell.motion
    set_box(d, FLY, 0.0, x, v)
    depth, _ = follow_branch(world, targets, d, n, memory.room.choices, 0)
    return depth == 0 and n.kind == FLY and n.certain != 0


@kernel
def _write(world: World, box: Floats, cell: Cell, i: int, out: Found) -> None:
    """Write what Krawczyk's operator proves of a box that has been followed."""
    d, n = cell.image, cell.motion
    A, own = derivative(n), n.centre
    right = n.flight.sign > 0
    x = -own.gap if right else own.gap - world.system.width
    v = own.speed if right else -own.speed
    defect = x - d.x, v - d.v
    kx, kv = _contracted(A, defect, (d.p, d.w))
    x, v = place(world.units, kx + d.x), speed_of(world.units, kv + d.v)
    out.boxes[i, 0], out.boxes[i, 1] = lower(x), upper(x)
    out.boxes[i, 2], out.boxes[i, 3] = lower(v), upper(v)
    inside = magnitude(kx) < d.p and magnitude(kv) < d.w
    in_x = box[0] < out.boxes[i, 0] and out.boxes[i, 1] < box[1]
    out.proved[i] = inside and in_x and box[2] < out.boxes[i, 2] and out.boxes[i, 3] < box[3]
    trace = A.a + A.d
    rotation = _rotation(trace)
    out.trace[i, 0], out.trace[i, 1] = lower(trace), upper(trace)
    out.rotation[i, 0], out.rotation[i, 1] = lower(rotation), upper(rotation)
    out.itinerary[i] = n.itinerary


def _compiled() -> Search:
    @compiled
    def search(world, targets, boxes, frictions, memory, out):  # type: ignore[no-untyped-def]
        """Prove fixed points; see `SEARCH`."""
        if not rounds_to_nearest(memory.probe):
            return False
        cell = memory.cell
        for i in range(len(boxes)):
            if len(frictions) > 0:
                _with_friction(world, between(frictions[i, 0], frictions[i, 1]))
            if _search(world, targets, boxes[i], cell, memory):
                _write(world, boxes[i], cell, i, out)
        return True

    return cast(Search, search)


SEARCH = _compiled()
"""Prove fixed points of Φ in ``boxes`` (N, 4), at the values (N, 2) of α, or at that of the world.

(world, targets, boxes, frictions, memory, out) -> whether the processor rounds as it should.
"""
