"""Compiled: of an edge it is proved, in intervals of doubles, that all its motions stop or go out.

The proof is that of `cap.checker.tori.segments`; that a segment is outside of a ring is shown with
all edges of the ring: none meets a rectangle around the segment, and a ray from its middle crosses
an even number of them.
"""

import math
from typing import NamedTuple

from cap.areas.rings.half_periods import Floats, Laws, Strand, after, begins, reach
from cap.sets.compiled import compiled, kernel
from cap.sets.doubles import Interval, lower, upper

ROOM, FAR = 1 + 1e-9, 1.1  # segments are longer by so much, farther outside, and thicker:
THICK = 1e-15
MOST = 12  # pieces
LARGE = 0.02  # errors that are larger grow so fast that no other arithmetic agrees
ROUNDING = 1e-13  # more than all errors of a few products of numbers below 10


class Edge(NamedTuple):
    """An edge from (x, v) to (X, V)."""

    x: float
    v: float
    X: float
    V: float


@kernel
def piece(edge: Edge, k: int, count: int, e: float) -> Strand:
    """Return one of so many parts of an edge, in a sense of time."""
    half = 0.5 / count
    part = (2 * k + 1) * half
    x, v = edge.x + part * (edge.X - edge.x), edge.v + part * (edge.V - edge.v)
    h = half * ROOM
    return Strand(
        e * x, v, e * h * (edge.X - edge.x), h * (edge.V - edge.v), 1.0, 0.0, THICK, THICK
    )


@kernel
def is_outside(z: Strand, e: float, ring: Floats) -> bool:
    """Return whether all states of a strand are outside of a ring (N, 2)."""
    size = math.sqrt(z.dy * z.dy + z.dv * z.dv)
    a, b = z.dy / size, z.dv / size
    if not size > z.r1:
        a, b = z.p, z.q
    a *= e
    long = FAR * reach(z, e * a, b) + ROUNDING
    wide = FAR * reach(z, -e * b, a) + ROUNDING
    n = ring.shape[0]
    y, v = ring[n - 1, 0] - e * z.y, ring[n - 1, 1] - z.v
    p, q = a * y + b * v, a * v - b * y
    odd = False
    for i in range(n):
        y, v = ring[i, 0] - e * z.y, ring[i, 1] - z.v
        P, Q = a * y + b * v, a * v - b * y
        beside = min(p, P) > long or max(p, P) < -long or min(q, Q) > wide or max(q, Q) < -wide
        if not beside:
            bound = abs(Q - q) * long + abs(P - p) * wide + ROUNDING
            if not abs(p * Q - P * q) > bound:
                return False
        if (q <= 0) != (Q <= 0) and (p * Q - P * q > 0) == (q < Q):
            odd = not odd
        p, q = P, Q
    return not odd


@kernel
def goes_out(z: Strand, steps: int, given: Laws, e: float, ring: Floats, every: int) -> bool:
    """Return whether all motions of a strand certainly stop, or leave a ring if there is one.

    They leave it after a multiple of so many half periods.
    """
    if not begins(z, given, e):
        return False
    for _ in range(steps):
        z = after(z, given, e)
        if not (z.v > 0 and z.r1 + z.r2 < LARGE):
            return False
    if ring.size and steps % every == 0 and is_outside(z, e, ring):
        return True
    return upper(Interval(z.v, FAR * reach(z, 0.0, 1.0))) < lower(given.c)


@compiled
def pieces(edge: Edge, steps: int, given: Laws, sense: float, ring: Floats, every: int) -> int:
    """Return in how many equal pieces, 1, 2, 3, 4, 6, .., an edge is proved; 0 if in none."""
    count = 1
    while count <= MOST:
        k = 0
        while k < count:
            z = piece(edge, k, count, sense)
            if not goes_out(z, steps, given, sense, ring, every):
                break
            k += 1
        if k == count:
            return count
        count = count + 1 if count < 4 else count + count // 2 if count % 3 else count + count // 3
    return 0
