"""A family of parallelograms that cover each other: pieces of leaves, sized by those that hold."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cap.floats.coverings.leaves import Leaves
from cap.floats.coverings.planar import Floats, Planar, images
from cap.floats.coverings.saddles import Saddle
from cap.floats.coverings.sizes import Sizes
from cap.maps.graphs import Places, fastest

MOST = 4.0  # times what is seen of a piece: its parallelogram reaches no farther


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
    inside = fastest(source, target, len(frames)).inside(source, target)
    source, target = source[inside], target[inside]
    flow = fastest(source, target, len(frames)).flow(source, target)
    tell(f"{len(source)} coverings are tried")
    kept = sizes.grown(source, target, np.argsort(-flow, kind="stable"))
    while kept.any():
        source, target = source[kept], target[kept]
        part = fastest(source, target, len(frames))
        kept = part.inside(source, target) & (sizes.scores(source, target) <= 0)
        tell(f"{np.count_nonzero(kept)} coverings of {len(kept)} seem to hold")
        if kept.all():
            return _renumbered(sizes, source, target, part.growth)
    return _renumbered(sizes, source[:0], target[:0], 0.0)


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
