"""Compiled: the fate of states that are in a basin of `cap.checker.folded.basins`."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.folded import lines, polynomials
from cap.areas.folded.backward import ROUND
from cap.areas.folded.lines import Line
from cap.areas.folded.polynomials import Model
from cap.checker.folded import basins
from cap.checker.folded.numbers import Pair
from cap.checker.folded.table import ATTRACTOR, NONE, SEGMENT
from cap.sets.compiled import kernel

ROOM = 0.98  # of 1: so the checker, with its bounds, finds states in an ellipse, too

Floats = NDArray[np.float64]


class Basins(NamedTuple):
    """The rows of strips (M, 3, 4), and of ellipses, and of those at odd times (N, 2, 4)."""

    strips: Floats
    ellipses: Floats
    odd: Floats


def compiled_basins(known: basins.Basins) -> Basins:
    """Return basins for what is compiled."""
    strips = np.array([strip.rows for strip in known.strips], np.float64)
    even, odd = (
        np.array([ellipse.rows for ellipse in ellipses], np.float64).reshape(-1, 2, 4)
        for ellipses in (known.ellipses, known.odd)
    )
    return Basins(strips.reshape(-1, 3, 4), even, odd)


@kernel
def anything(known: Basins, k: int) -> bool:
    """Return whether something is known at a multiple k pi."""
    if k % 2 == 1:
        return len(known.odd) > 0
    return len(known.strips) + len(known.ellipses) > 0


@kernel
def _in_strip(rows: Floats, first: Pair, second: Pair, third: Pair) -> bool:
    """Return whether bounds of a p + b s are in the rows of a strip."""
    inside = rows[0, 2] < first[0] and first[1] < rows[0, 3]
    inside = inside and rows[1, 2] < second[0] and second[1] < rows[1, 3]
    return bool(inside and rows[2, 2] < third[0] and third[1] < rows[2, 3])


@kernel
def _in_ellipse(rows: Floats, first: Pair, second: Pair) -> bool:
    """Return whether states with these bounds of a p + b s are in an ellipse."""
    u = 1 + max(rows[0, 2] - first[0], first[1] - rows[0, 3])
    w = 1 + max(rows[1, 2] - second[0], second[1] - rows[1, 3])
    return bool(u * u + w * w < ROOM)


@kernel
def _of_lines(row: Floats, p: Line, s: Line) -> Pair:
    """Return bounds of a p + b s."""
    a, b = row[0], row[1]
    u, w = lines.scaled(p, a, abs(a) * ROUND), lines.scaled(s, b, abs(b) * ROUND)
    return lines.ends(lines.total(u, w))


@kernel
def _of_models(row: Floats, p: Model, s: Model) -> Pair:
    """Return bounds of a p + b s."""
    a, b = row[0], row[1]
    u, w = polynomials.scaled(p, a, abs(a) * ROUND), polynomials.scaled(s, b, abs(b) * ROUND)
    return polynomials.ends(polynomials.total(u, w))


@kernel
def _fate(of: Callable[..., Pair], known: Basins, k: int, between: bool, p: Any, s: Any) -> int:
    """Return the fate of states at a multiple k pi, if it is known, or 0; ``of`` gives bounds."""
    if between and k % 2 == 0:
        for rows in known.strips:
            first, second = of(rows[0], p, s), of(rows[1], p, s)
            if _in_strip(rows, first, second, of(rows[2], p, s)):
                return SEGMENT
    for rows in known.odd if k % 2 == 1 else known.ellipses:
        if _in_ellipse(rows, of(rows[0], p, s), of(rows[1], p, s)):
            return ATTRACTOR
    return NONE


@kernel
def fate_of_lines(known: Basins, k: int, p: Line, s: Line) -> int:
    """Return the fate of the states of lines at a multiple k pi, if it is known, or 0."""
    return _fate(_of_lines, known, k, True, p, s)


@kernel
def fate_of(known: Basins, k: int, between: bool, p: Model, s: Model) -> int:
    """Return the fate of the states of models at a multiple k pi, if it is known, or 0.

    Strips are looked at between two stops.
    """
    return _fate(_of_models, known, k, between, p, s)
