"""Adaptive subdivision of an interval into cells, on one core, many, or a cluster.

A cell is examined; where the verdict is `UNDECIDED` it is halved, unless it is small already.  A
verdict does not depend on what else is examined, nor on how the runner does it.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from threading import Lock
from typing import NamedTuple

from cap.runner import Plan, Runner

UNDECIDED = "?"
_LOCK = Lock()


class Cell(NamedTuple):
    """The interval [lower, upper]."""

    lower: Fraction
    upper: Fraction

    def halves(self) -> tuple["Cell", "Cell"]:
        """Return two cells that make up this one, meeting at a short decimal near the middle."""
        scale = Fraction(100)
        while (self.upper - self.lower) * scale < 1000:
            scale *= 10
        middle = Fraction(round((self.lower + self.upper) / 2 * scale)) / scale
        return Cell(self.lower, middle), Cell(middle, self.upper)


Examine = Callable[[Cell], str]


def cells_between(ends: Sequence[Fraction]) -> list[Cell]:
    """Return the cells between consecutive ends."""
    return [Cell(a, b) for a, b in pairwise(ends)]


def subdivide(
    examine: Examine, cells: Sequence[Cell], smallest: Fraction, runner: Runner, key: str = ""
) -> list[tuple[Cell, str]]:
    """Return cells that make up those given, in order, each with its verdict.

    Undecided cells are shorter than 2 ``smallest``.  ``examine`` must be picklable for executors
    that are other processes; what it raises is raised.  ``key`` tells the journal what is examined.
    """

    def halves(cell: Cell, verdict: str) -> Sequence[Cell]:
        large = cell.upper - cell.lower >= 2 * smallest
        return cell.halves() if verdict == UNDECIDED and large else ()

    verdicts: dict[Cell, str] = {}
    left = len(cells)
    runner.tell(f"0 cells decided; {left} to be examined", None)
    plan = Plan[Cell, str](key=key, name=_name, more=halves)
    for cell, verdict in runner.run(partial(_alone, examine), cells, plan):
        parts = halves(cell, verdict)
        left += len(parts) - 1
        if not parts:
            verdicts[cell] = verdict
        runner.tell(f"{len(verdicts)} cells decided; {left} to be examined", None)
    if runner.interrupted:
        raise KeyboardInterrupt
    return sorted(verdicts.items())


def _name(cell: Cell) -> str:
    return f"{cell.lower} {cell.upper}"


def _alone(examine: Examine, cell: Cell) -> str:
    """Examine one cell at a time in a process: its threads share the precision of balls."""
    with _LOCK:
        return examine(cell)
