"""Compiled: a region of turns followed forwards to the stick, and which of it has a fate.

*Units* and folding are those of `cap.areas.folded.backward`, with a < 0: friction brakes.  A mass
that turns at (q, tau), backwards in time, starts from rest at the same q at t = -tau.  So a region
is followed with time reversed.  Its measure is that of the backward flow, with the density cos t +
|a|.  With the flight goes its derivative in q (`cap.areas.folded.slopes`).
"""

import math
from typing import NamedTuple

from cap.areas.folded.backward import Constants, Flight
from cap.areas.folded.fates import (
    ENDS,
    LOST,
    PARTS,
    Ahead,
    Missing,
    Share,
    added,
    reached,
    resting,
    stopped,
    without,
)
from cap.areas.folded.mirrored import after_hit, after_turn
from cap.areas.folded.next_event import HIT
from cap.areas.folded.polynomials import UP
from cap.areas.folded.regions import Region, known, launched, next_of, spread
from cap.areas.folded.rests import height
from cap.areas.folded.slopes import after_the_hit, after_the_turn, at_start
from cap.checker.folded.table import NONE
from cap.sets.compiled import kernel


class Fated(NamedTuple):
    """Lower bounds of the measures with each fate, and by what they may be less than could be.

    And the ranges of A and B at last, by X and by Y alone.
    """

    attractor: float
    segment: float
    either: float
    excess: float
    across: float
    along: float


@kernel
def _densest(y: Constants, r: Region) -> float:
    """Return a bound of cos t + |a| over the times of a region."""
    nearest = max(0.0, abs(r.middle) - r.half)
    return (math.cos(nearest) - y.a) * UP + 1e-12


@kernel
def _left(f: Flight, mu: float, lost: Missing) -> Fated:
    """Return what is left of a measure."""
    across, along = spread(f)
    all_but = mu * (1 - 1e-12)
    return Fated(
        max(0.0, all_but - lost.attractor),
        max(0.0, all_but - lost.segment),
        max(0.0, all_but - lost.either),
        min(lost.excess, mu),
        across,
        along,
    )


@kernel
def foreseen(s: Ahead, r: Region, mu: float, flights: int, size: float) -> Fated:
    """Follow a region, of the measure mu, forwards to the stick, if it is certain what happens."""
    y, share = s.flow, Share(mu, 2 * r.half / PARTS * _densest(s.flow, r) * UP)
    f, _density, _wide = launched(y, r)
    g, lost, rested = at_start(), Missing(0.0, 0.0, 0.0, 0.0), True
    for _ in range(flights):
        if not known(f, size):
            break
        kind, event = next_of(y, f)
        if event.why != 0:
            break
        fate = reached(s, f, event.ends[0], rested and kind != HIT)
        if fate != NONE:
            return _left(f, mu, added(lost, without(fate, mu)))
        rested = kind != HIT
        if kind == HIT:
            low = height(s.rests, event.ends, event.most)
            if low >= 0:
                return _left(f, mu, added(lost, resting(s.known, low, mu)))
            g, f = after_the_hit(y, f, g, event), after_hit(y, f, event)
            continue
        then, more = stopped(s, f, g, event, share)
        lost = added(lost, more)
        if then == ENDS:
            return _left(f, mu, lost)
        if then == LOST:
            break
        g, f = after_the_turn(y, g, event), after_turn(y, f, event)
    across, along = spread(f)
    return Fated(0.0, 0.0, 0.0, mu, across, along)
