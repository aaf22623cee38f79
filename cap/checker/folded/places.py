"""The table of places of release, in rounds."""

from __future__ import annotations

from functools import cache

from cap.checker.folded.fates import Judge, Strip
from cap.checker.folded.flights import System
from cap.checker.folded.follow import Box, Seen, follow
from cap.checker.folded.numbers import TURN, Pair
from cap.checker.folded.table import Table, first_table
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.quadratic import Model
from cap.checker.kernel.theorem import Parameters

_ROUNDS = 16  # of releases, one after the other


@cache
def system(p: Parameters) -> System:
    """Return the constants at these parameters."""
    return System(p)


def across(ends: Pair, along: int) -> Model:
    """Return the model of a coordinate, from one end of an interval to the other."""
    mid, rad = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
    error = (abs(ends[0]) + abs(ends[1])) * TURN
    return (mid, 0.0, rad, 0.0, 0.0, 0.0, error) if along else (mid, rad, 0.0, 0.0, 0.0, 0.0, error)


def seen_from(p: Parameters, part: Pair, kept: Pair, cuts: int) -> Seen:
    """Return what is seen of the releases from some places, distances to the wall ahead.

    Nothing of those that are ``kept``.
    """
    y = system(p)
    if kept[0] <= part[0] and part[1] <= kept[1]:
        return Seen([], None, stops=True)
    return follow(y, y.rest(q.scaled(across(part, 0), -1.0)), Box(cuts))


def table_of(strip: Strip, kept: Pair, parts: list[tuple[Pair, Seen]], depth: int) -> Table:
    """Return the table of places: ``kept`` is attracted; ``parts`` are all other places, and more.

    Each round takes the fates of the next releases from the last one.
    """
    first = first_table(parts[-1][0][1], kept)
    table, known = first, dict[Pair, tuple[list[float], list[int]]]()
    for _ in range(_ROUNDS):
        judge, ends, fates = Judge(strip, table), [parts[0][0][0]], list[int]()
        for part, seen in parts:
            if part not in known or 0 in known[part][1]:
                known[part] = judged(judge, first, part, seen, depth)
            ends += known[part][0]
            fates += known[part][1]
        last, table = table, Table(ends, fates)
        if (last.ends, last.fates) == (table.ends, table.fates):
            break
    return table


def judged(
    judge: Judge, first: Table, part: Pair, seen: Seen, depth: int
) -> tuple[list[float], list[int]]:
    """Return the ends of the pieces of a part, but for its first end, and their fates."""
    if first.fate(part):
        return [part[1]], [first.fate(part)]
    ends, fates = list[float](), list[int]()
    judge.sort(judge.prepared(seen), part, depth, ends, fates)
    return ends, fates
