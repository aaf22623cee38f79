"""Compiled, in doubles: where a strip of launches ends, in a column.

It steers; nothing rests on it.  A *strip* is what, in a gap between cells, flies into cells of one
link (`cap.areas.strips.links`).
"""

import math
from typing import NamedTuple

from cap.areas.strips.cover import BOTTOM, Cover, Floats, at, found, landed, link, time
from cap.areas.strips.hits import fly, pulled
from cap.sets.compiled import kernel

CLOSE = 1e-9  # how near the ends of strips are found


class Gap(NamedTuple):
    """The edges of a gap."""

    low: Floats
    high: Floats


class Begin(NamedTuple):
    """A launch, and when it hits."""

    t: float
    E: float
    T: float


@kernel
def end_of(cover: Cover, begin: Begin, to: int, step: float, limits: tuple[float, float]) -> float:
    """Return up to where, from E in the direction of ``step``, launches fly into cells of one link.

    By steps up to the first limit; it errs by the second.
    """
    t, E, T = begin
    bound, near = limits
    low, high, sign = E, E + step, 1.0 if step > 0 else -1.0
    for _ in range(60):
        if sign * (high - bound) >= 0:
            there, T = link(cover, t, bound, T)
            if there == to:
                return bound
            high = bound
            break
        there, T = link(cover, t, high, T)
        if there != to:
            break
        low, step = high, 1.7 * step
        high = low + step
    for _ in range(60):
        if abs(high - low) < near:
            break
        middle = 0.5 * (low + high)
        there, T = link(cover, t, middle, T)
        if there == to:
            low = middle
        else:
            high = middle
    return low


@kernel
def _slope(cover: Cover, t: float, E: float) -> float:
    """Return the slope of the strip in which a launch is: its flight turns it to that of a cell."""
    lines, y = cover.lines, cover.y
    T, V = fly(t, math.sqrt(2 * E), y[0], y[1])
    j, s, energy = landed(lines, T, V)
    if j < 0:
        return 0.0
    i, p = found(cover, j, s, energy, 0.0), cover.top[j]
    if i == BOTTOM:
        p = cover.bottom[j]
    elif i >= 0:
        p = cover.cells[i, :3]
    return pulled(t, E, T, V, y[0], (p[1] + 2 * s * p[2]) * 2 / (lines[j + 1] - lines[j]))


@kernel
def bounds(gap: Gap, s: float) -> tuple[float, float]:
    """Return between which energies a gap is, at a place."""
    return max(1e-9, at(gap.low, s)), at(gap.high, s)


@kernel
def followed(cover: Cover, j: int, gap: Gap, to: int, ends: Floats) -> bool:
    """Find the ends of a strip at s = -1, -1/2, 1/2, 1, from those in the middle, ``ends[2]``."""
    width, lines = ends[2, 1] - ends[2, 0], cover.lines
    for side in (-1, 1):
        low, high = ends[2, 0], ends[2, 1]
        s, step, node = 0.0, 0.5, 1
        for _ in range(60):
            move = min(step, 0.5 * node - s)
            t, new = time(lines, j, side * s), time(lines, j, side * (s + move))
            E = 0.5 * (low + high)
            there = E + (new - t) * _slope(cover, t, E)
            bottom, top = bounds(gap, side * (s + move))
            into, T = link(cover, new, there, math.inf)
            if not bottom <= there <= top or into != to:
                step *= 0.5
                if step < 1e-2:
                    return False
                continue
            s += move
            arrived = s >= 0.5 * node - 1e-12
            near, share = CLOSE if arrived else 0.02 * (high - low), 0.3 * (high - low)
            low, high = (
                end_of(cover, Begin(new, there, T), to, -share, (bottom, near)),
                end_of(cover, Begin(new, there, T), to, share, (top, near)),
            )
            if high - low < 0.02 * width:
                return False
            step *= 2
            if arrived:
                ends[2 + side * node, 0], ends[2 + side * node, 1] = low, high
                node += 1
                if node == 3:
                    break
        if node < 3:
            return False
    return True


@kernel
def touches(ends: Floats, gap: Gap, side: int) -> bool:
    """Return whether a strip goes up, or down, to the end of its gap."""
    for k in range(5):
        if abs(ends[k, side] - at(gap.low if side == 0 else gap.high, 0.5 * k - 1)) > 1e-12:
            return False
    return True
