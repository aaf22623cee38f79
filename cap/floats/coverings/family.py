"""A family of parallelograms that cover each other: pieces of leaves, sized, and pruned."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cap.floats.coverings.leaves import Leaves
from cap.floats.coverings.planar import Floats, Planar, images
from cap.floats.coverings.saddles import Saddle
from cap.floats.coverings.sizes import Places, Sizes
from cap.maps.graphs import Flags, Part, fastest

ROUNDS = 200
MOST = 4.0  # times what is seen of a piece: its parallelogram reaches no farther
CUT = 0.25  # of the coverings that fail: so many are given up at once


class Family(NamedTuple):
    """Parallelograms (V, 6), coverings i -> j that seem to hold, and the growth of their graph."""

    sets: Floats
    source: Places
    target: Places
    growth: float


def family(
    g: Planar, saddle: Saddle, leaves: Leaves, tell: Callable[[str], None] = lambda _: None
) -> Family:
    """Return the family that the pieces of leaves lead to; it has no covering if none is found."""
    keys = list(leaves.pieces)
    number = {key: k for k, key in enumerate(keys)}
    pairs = [(number[key], number[to]) for key in keys for to in leaves.edges.get(key, [])]
    source, target = np.array(pairs, dtype=np.int64).reshape(-1, 2).T.copy()
    pieces = [leaves.pieces[key] for key in keys]
    frames = np.array([[*p.z, *p.T, *_stable(g, saddle, p.z, leaves.n + 2)] for p in pieces])
    seen = np.array([[p.low, p.high] for p in pieces])
    sizes = Sizes(g, frames, seen, MOST)
    sizes.limit(source, target)
    for k in range(ROUNDS):
        lost, scores = sizes.fitted(source, target)
        part = fastest(source, target, len(frames))
        kept = part.inside(source, target)
        failing = kept & ((lost > 0) | (scores > 0))
        tell(f"round {k + 1}: {kept.sum()} coverings, {failing.sum()} of them fail")
        if not failing.any():
            return _renumbered(sizes, source[kept], target[kept], part.growth)
        kept &= ~_given_up(part, lost * kept, scores * failing, source, target)
        source, target = source[kept], target[kept]
    return _renumbered(sizes, source[:0], target[:0], 0.0)


def _given_up(part: Part, lost: Places, scores: Floats, source: Places, target: Places) -> Flags:
    """Return which coverings are given up: the first ones that were lost, which the others follow.

    If none is lost, those that fail most, for the least flow.
    """
    if lost.any():
        worth = np.where(lost > 0, 1.0 / np.maximum(lost, 1), 0.0)
        number = np.count_nonzero(lost)
    else:
        worth = np.minimum(scores, 5.0) / (part.flow(source, target) + 0.1 / len(source))
        number = np.count_nonzero(scores > 0)
    given_up = np.zeros(len(source), dtype=bool)
    given_up[np.argsort(-worth)[: max(1, int(CUT * number))]] = True
    return given_up


def _stable(g: Planar, saddle: Saddle, z: Floats, steps: int) -> Floats:
    """Return the direction at z that the next steps contract, pulled back from the saddle's."""
    derivatives = []
    for _ in range(steps):
        x, y, *D = images(g, z[None])[0]
        if not np.isfinite(x):
            break
        derivatives.append(np.array(D).reshape(2, 2))
        z = np.array([x, y])
    e = saddle.stable
    for D in reversed(derivatives):
        e = np.linalg.solve(D, e)
        e = e / np.hypot(*e)
    return np.asarray(e)


def _renumbered(sizes: Sizes, source: Places, target: Places, growth: float) -> Family:
    chosen, places = np.unique(np.concatenate([source, target]), return_inverse=True)
    source, target = places[: len(source)], places[len(source) :]
    return Family(sizes.parallelograms(chosen), source, target, growth)
