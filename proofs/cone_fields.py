"""Slopes and units of cones along the edges of a graph, in floats: what they are fitted to.

An edge from i to j has a matrix B of which the sizes of the entries are known: |B11| at least, the
others at most.  Wanted are slopes L and units u, w of the vertices with

    |B21| + L_i |B22| < L_j (|B11| - L_i |B12|),

    (|B11| - L_i |B12|) u_i/u_j >= s > 1,        (|B22| + |B21|/L_i) w_i/w_j <= 1/s.

*Slopes.*  The least ones are limits of L_j = max (|B21| + L_i |B22|)/(|B11| - L_i |B12|), the
largest ones those of the inverse matrices.  In log L the first condition is convex, so their
geometric means will do.  *Units.*  The logarithms are shortest distances in the graph; they exist
if there is no cycle whose length is negative.  The checker confirms what comes out, or refuses it.
"""

from typing import NamedTuple

import numpy as np

from cap.maps.graphs import Flags, Floats, Places

LEAST, LARGEST = 1e-6, 1e6  # slopes
ROOM = 1.0001  # of slopes
STEPS, CLOSE = 2000, 1e-9
RATES = 2.0, 1.5, 1.2, 1.1, 1.05, 1.02, 1.01, 1.005, 1.002  # s, the first for which units exist


class Sizes(NamedTuple):
    """|B11| at least, |B12|, |B21|, |B22| at most, for each edge."""

    along: Floats
    aside: Floats
    bent: Floats
    across: Floats


class Field(NamedTuple):
    """Slopes and units of all vertices, and at which edges they fail."""

    slopes: Floats
    u: Floats
    w: Floats
    bad: Flags


def fitted(sizes: Sizes, source: Places, target: Places, count: int) -> Field:
    """Return slopes and units for the largest s of those tried."""
    least = _slopes(sizes, source, target, count)
    turned = sizes._replace(aside=sizes.bent, bent=sizes.aside)
    slopes = np.sqrt(least / _slopes(turned, target, source, count))
    grown = sizes.along - slopes[source] * sizes.aside
    left = sizes.across + sizes.bent / slopes[source]
    bad = left * slopes[source] >= slopes[target] * grown
    u, short = _units(grown, source, target, count)
    w, long = _units(1 / np.maximum(left, LEAST), source, target, count)
    return Field(slopes, u, 1 / w, bad | short | long)


def _slopes(sizes: Sizes, source: Places, target: Places, count: int) -> Floats:
    """Return the least slopes of cones that are mapped into cones, or `LARGEST`."""
    slopes = np.full(count, LEAST)
    for _ in range(STEPS):
        before = slopes[source]
        grown = np.maximum(sizes.along - sizes.aside * before, 0)
        steep = ROOM * (sizes.bent + sizes.across * before) / np.maximum(grown, 1 / LARGEST**2)
        after = slopes.copy()
        np.maximum.at(after, target, np.minimum(steep, LARGEST))
        if np.allclose(after, slopes, rtol=CLOSE, atol=0):
            break
        slopes = after
    return slopes


def _units(factors: Floats, source: Places, target: Places, count: int) -> tuple[Floats, Flags]:
    """Return units u with factor u_source/u_target >= s, and at which edges that fails."""
    logs = np.log(np.maximum(factors, LEAST))
    for rate in RATES:
        lengths, u = logs - np.log(rate), np.zeros(count)
        for _ in range(count + 1):
            after = u.copy()
            np.minimum.at(after, target, u[source] + lengths)
            if np.array_equal(after, u):
                break
            u = after
        bad = u[source] + lengths < u[target]
        if not bad.any():
            break
    return np.exp(np.maximum(u, np.log(LEAST))), np.asarray(bad)
