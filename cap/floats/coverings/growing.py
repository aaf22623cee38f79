# ruff: noqa: PLR0913, PLR0917 (compiled functions take arrays, not records)
"""Coverings that are tried one after the other, while the sizes of parallelograms only grow.

Sizes that fit to the coverings so far are made larger for one more, before it and after it, as far
as that asks for more.  If a parallelogram becomes too large, or meets the end of the map, all is
put back, and the covering is given up.
"""

from typing import Any

import numpy as np
from numba.extending import register_jitable

from cap.floats.coverings.asking import MARGIN, asked
from cap.floats.coverings.planar import Floats, Planar, kept
from cap.maps.graphs import Flags, Places

STEPS = 3000  # a covering that takes more is given up
SPARE = 0.3  # of a margin that may be used up


@register_jitable
def _wait(queue: Any, tail: Any, held: Any, waits: Any, more: Any) -> Any:
    """Let coverings wait, if they are held; return the end of the queue."""
    for k in more:
        if held[k] and not waits[k]:
            waits[k], queue[tail] = True, k
            tail += 1
    return tail


@register_jitable
def _one_more(
    kind: Any, y: Any, frames: Any, U: Any, W: Any, most: Any, source: Any, target: Any,
    into: Any, first_in: Any, out: Any, first_out: Any, held: Any, one: Any, queue: Any, waits: Any,
) -> Any:  # fmt: skip
    """Make the sizes fit to one more covering; return whether that succeeds."""
    head, tail, good = 0, 1, True
    queue[0], held[one] = one, True
    while head < tail:
        k = queue[head]
        head += 1
        waits[k] = False
        i, j = source[k], target[k]
        known, a, b, c, d = asked(kind, y, frames, U, W, i, j, most[i])
        if not known or tail > STEPS:
            good = False
            break
        spare = SPARE * MARGIN * (b - a)
        if a < U[i, 0] - spare or b > U[i, 1] + spare:
            U[i, 0], U[i, 1] = min(a, U[i, 0]), max(b, U[i, 1])
            tail = _wait(queue, tail, held, waits, into[first_in[i] : first_in[i + 1]])
        margin = MARGIN * (d - c) + 1e-10
        spare = SPARE * margin
        if c - margin < W[j, 0] - spare or d + margin > W[j, 1] + spare:
            W[j, 0], W[j, 1] = min(c - margin, W[j, 0]), max(d + margin, W[j, 1])
            tail = _wait(queue, tail, held, waits, out[first_out[j] : first_out[j + 1]])
    waits[:] = False
    held[one] = good
    return good


def _grow(
    kind: Any, y: Any, frames: Any, U: Any, W: Any, most: Any, source: Any, target: Any,
    into: Any, first_in: Any, out: Any, first_out: Any, held: Any, order: Any,
) -> Any:  # fmt: skip
    """Try coverings in an order."""
    queue, waits = (
        np.zeros(STEPS + len(source), dtype=np.int64),
        np.zeros(len(source), dtype=np.bool_),
    )
    was_U, was_W = U.copy(), W.copy()
    for k in order:
        if _one_more(
            kind, y, frames, U, W, most, source, target,
            into, first_in, out, first_out, held, k, queue, waits,
        ):  # fmt: skip
            was_U[:], was_W[:] = U, W
        else:
            U[:], W[:] = was_U, was_W


_GROW = kept(_grow)


def grow(
    g: Planar, frames: Floats, sizes: tuple[Floats, Floats, Floats],
    coverings: tuple[Places, Places], held: Flags, order: Places,
) -> None:  # fmt: skip
    """Try coverings in an order: sizes and ``held`` become what fits to those that succeed."""
    source, target = coverings
    into, out = np.argsort(target, kind="stable"), np.argsort(source, kind="stable")
    every = np.arange(len(frames) + 1)
    _GROW(
        g.kind, g.constants, frames, *sizes, source, target,
        into, np.searchsorted(target[into], every), out, np.searchsorted(source[out], every),
        held, order,
    )  # fmt: skip
