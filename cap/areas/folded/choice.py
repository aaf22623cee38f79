"""Compiled: which nodes of a tree are followed for the most worth, at a price for each."""

import numpy as np
from numpy.typing import NDArray

from cap.areas.folded.trees import LEAF, Floats, Integers
from cap.sets.compiled import sources
from cap.sets.kept import kept

Mask = NDArray[np.bool_]


def _ends(kinds: Integers, past: Integers) -> None:
    """Write the first node after each and its parts: the second part comes after the first."""
    for n in range(len(kinds) - 1, -1, -1):
        past[n] = n + 1 if kinds[n] == LEAF else past[past[n + 1]]


def _choose(kinds: Integers, past: Integers, worths: Floats, price: float, chosen: Mask) -> None:
    """Write which nodes to follow; none is a part of another one."""
    most = np.empty(len(kinds) + 1)
    for n in range(len(kinds) - 1, -1, -1):
        chosen[n], most[n] = worths[n] > price, max(worths[n] - price, 0.0)
        if kinds[n] != LEAF:
            parts = most[n + 1] + most[past[n + 1]]
            if parts >= most[n]:
                chosen[n], most[n] = False, parts
    n = 0
    while n < len(kinds):
        after = past[n] if chosen[n] else n + 1
        for k in range(n + 1, after):
            chosen[k] = False
        n = after


ends = kept(_ends, sources())
choose = kept(_choose, sources())
