"""Adaptive subdivision of an interval into cells, on one core, many, or a cluster.

A cell is examined; where the verdict is `UNDECIDED` it is halved, unless it is small already.  Any
executor of `concurrent.futures` serves.  Verdicts are written to a journal as they come, so that an
interrupted run goes on where it was; a verdict does not depend on what else is examined.
"""

import json
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from threading import Lock
from typing import NamedTuple

from cap.command.console import quoted
from cap.errors import BadInput
from cap.sets import interval

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
Verdicts = dict[Cell, str]


@dataclass(frozen=True)
class Workers:
    """How cells are examined: on which executor (None: here), with which journal, telling whom."""

    executor: Executor | None = None
    journal: Path | None = None
    progress: Callable[[str], None] = field(default=lambda _: None)


def cells_between(ends: Sequence[Fraction]) -> list[Cell]:
    """Return the cells between consecutive ends."""
    return [Cell(a, b) for a, b in pairwise(ends)]


def subdivide(
    examine: Examine, cells: Sequence[Cell], smallest: Fraction, workers: Workers, key: str = ""
) -> list[tuple[Cell, str]]:
    """Return cells that make up those given, in order, each with its verdict.

    Undecided cells are shorter than 2 ``smallest``.  ``examine`` must be picklable for executors
    that are other processes; what it raises is raised.  ``key`` tells the journal what is examined.
    """
    with _journal(workers.journal, key) as (known, write):
        verdicts: Verdicts = {}
        pending = list(cells)
        while pending:
            fresh = [cell for cell in pending if cell not in known]
            examined = _examined(examine, fresh, workers.executor)
            for number, (cell, verdict) in enumerate(examined, start=1):
                known[cell] = verdict
                write(cell, verdict)
                left = len(fresh) - number
                workers.progress(f"{len(verdicts)} cells decided; {left} of {len(fresh)} in work")
            halves: list[Cell] = []
            for cell in pending:
                if known[cell] == UNDECIDED and cell.upper - cell.lower >= 2 * smallest:
                    halves += cell.halves()
                else:
                    verdicts[cell] = known[cell]
            pending = halves
    return sorted(verdicts.items())


def _examined(
    examine: Examine, cells: Sequence[Cell], executor: Executor | None
) -> Iterator[tuple[Cell, str]]:
    """Give cells and verdicts as they come; if interrupted, cancel what has not begun."""
    if executor is None:
        yield from ((cell, examine(cell)) for cell in cells)
        return
    futures: dict[Future[str], Cell] = {
        executor.submit(_alone, examine, cell): cell for cell in cells
    }
    try:
        waiting = set(futures)
        while waiting:
            done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                yield futures[future], future.result()
    finally:
        for future in futures:
            future.cancel()


def _alone(examine: Examine, cell: Cell) -> str:
    """Examine one cell at a time in a process: its threads share the precision of balls."""
    with _LOCK:
        return examine(cell)


@contextmanager
def _journal(path: Path | None, key: str) -> Iterator[tuple[Verdicts, Callable[[Cell, str], None]]]:
    """Give the verdicts known, and a function that records one more."""
    if path is None:
        yield {}, lambda _cell, _verdict: None
        return
    with _usable(path):
        known = _read(path, key)
        file = path.open("a", encoding="ascii")
        if not path.stat().st_size:
            file.write(_header(key))

    def write(cell: Cell, verdict: str) -> None:
        with _usable(path):
            file.write(json.dumps([str(cell.lower), str(cell.upper), verdict]) + "\n")
            file.flush()

    try:
        yield known, write
    finally:
        with suppress(OSError):  # all that was written has been flushed
            file.close()


@contextmanager
def _usable(path: Path) -> Iterator[None]:
    """Turn an error of the file into one line; what `subdivide` examines may raise its own."""
    try:
        yield
    except OSError as error:
        raise BadInput(f"cannot use the journal {quoted(path)}: {error.strerror}") from None


def _header(key: str) -> str:
    return json.dumps({"cells of": key}) + "\n"


def _read(path: Path, key: str) -> Verdicts:
    """Return the verdicts of a journal; a last line that was cut short is removed."""
    if not path.exists():
        return {}
    if not path.is_file():
        raise BadInput(f"the journal {quoted(path)} is no regular file")
    text, header = path.read_text(encoding="ascii", errors="replace"), _header(key)
    whole = text[: text.rfind("\n") + 1]
    if not (whole.startswith(header) or (not whole and header.startswith(text))):
        why = "is no journal, or one about something else: give another file"
        raise BadInput(f"{quoted(path)} {why}")
    try:
        known = dict(map(_verdict, whole.splitlines()[1:]))
    except (ValueError, TypeError, ArithmeticError, RecursionError):
        raise BadInput(f"the journal {quoted(path)} is damaged: remove it") from None
    if whole != text:
        path.write_text(whole, encoding="ascii")
    return known


def _verdict(line: str) -> tuple[Cell, str]:
    """Return what a line of a journal says."""
    lower, upper, verdict = json.loads(line)
    if not all(isinstance(word, str) for word in (lower, upper, verdict)):
        raise TypeError(line)
    return Cell(interval.stated(lower), interval.stated(upper)), verdict
