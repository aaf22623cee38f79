"""One span of time, from one strobe to the next: every branch of a set, none dropped.

At an undecided event one continuation is chosen, and the number of those not yet chosen is noted;
the set is followed again from the beginning until all have been.  So a branch needs no room.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.boxes.begin import begin
from cap.boxes.doubleton import Doubleton
from cap.boxes.flight import Constants, Instant, Moment, NearSystem, launch, seen
from cap.boxes.motion import FLY, NEAR, REST, WALL, Motion, lose
from cap.boxes.near import approach, linger
from cap.boxes.rest import capture_after_hit, release
from cap.boxes.scout import HIT, STOP, scout
from cap.boxes.targets import Targets, event_label
from cap.boxes.transverse import arrive, hit, stop
from cap.boxes.union import branch
from cap.boxes.units import Units
from cap.sets.compiled import kernel
from cap.sets.records import Record

MOST_EVENTS = 100  # of a branch, in a span
DEEPEST = 24  # undecided events of a branch, in a span


class World(Record):
    """What is the same for all cells: the constants, the span of time, the units."""

    system: Constants
    near: NearSystem
    start: Instant
    end: Instant
    units: Units


class Choices(NamedTuple):
    """At the undecided events of a branch: which continuation is taken, and of how many."""

    taken: NDArray[np.int64]
    ways: NDArray[np.int64]


@kernel
def _moment(at: Instant) -> Moment:
    return Moment(at.t, at.sin, at.cos)


@kernel
def _smooth(world: World, n: Motion) -> bool:
    """Prove and pass the next event, if all motions have it and depend smoothly on their state."""
    y, sign, near, centre = world.system, n.flight.sign, n.near, n.centre
    if n.bounced != 0 and capture_after_hit(y, n, _moment(world.end)):
        return True
    end = seen(sign, _moment(world.end))
    at = Moment(centre.t.mid, centre.sin.mid, centre.cos.mid)
    launch(near, sign, at, centre.speed.mid, centre.gap.mid)
    event, time = scout(world.near, near, Moment(end.t.mid, end.sin.mid, end.cos.mid))
    if event == HIT:
        return hit(y, n, time, end)
    if event == STOP:
        return stop(y, n, time, end)
    return arrive(y, n, end)


@kernel
def pass_event(world: World, n: Motion, choice: int) -> int:
    """Pass the next event, in the way of this number; return how many ways there may be."""
    if n.kind == NEAR:
        return linger(world.system, n, _moment(world.end), choice)
    if n.kind != FLY:
        return release(world.system, n, _moment(world.end), choice)
    if _smooth(world, n) or approach(world.system, n, _moment(world.end)):
        return 1
    return branch(world.system, n, seen(n.flight.sign, _moment(world.end)), choice)


@kernel
def follow_branch(
    world: World, targets: Targets, d: Doubleton, n: Motion, choices: Choices, depth: int
) -> tuple[int, int]:
    """Follow one branch of a set to the end of a span, or to a target: the motions ``n``.

    Return the number of its choices, and the label of the target or 0.  The first ``depth`` choices
    are given, the others are the first of their kind.
    """
    known, depth, label = depth, 0, 0
    start, choice = _moment(world.start), choices.taken[0] if known > 0 else 0
    count = begin(world.system, n, d, start, choice)
    for _ in range(MOST_EVENTS):
        if count > 1:
            choices.taken[depth], choices.ways[depth] = choice, count
            depth += 1
        if n.ended != 0 or depth >= DEEPEST:
            break
        rested = n.kind in (REST, WALL)
        choice = choices.taken[depth] if depth < known else 0
        count = pass_event(world, n, choice)
        label = event_label(targets, world.units, world.system, n, rested and n.kind == FLY)
        if label != 0:
            n.ended = 1
    if n.ended == 0:
        lose(n)
    return depth, label


@kernel
def advanced(choices: Choices, depth: int) -> int:
    """Choose the next branch; return how many of its choices are given, 0 if there is none."""
    while depth > 0:
        choices.taken[depth - 1] += 1
        if choices.taken[depth - 1] < choices.ways[depth - 1]:
            return depth
        depth -= 1
    return 0
