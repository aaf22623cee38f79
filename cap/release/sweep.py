"""Cells of places, in intervals of doubles, halved until all masses of each have one itinerary."""

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cap.boxes.motion import HIT_L, HIT_R
from cap.boxes.release import passages
from cap.boxes.results import MOVING, SETTLED, UNDECIDED, Floats, Passages
from cap.parameters import Parameters
from cap.release.rows import Kind, Row, clipped, shortened
from cap.runner import Runner

FIRST = 512  # cells
LEVELS = 44  # halvings
CLOSE = 1e-4  # of R: G is known as well as that where the events near a wall are not known,
FAR, NARROW = 1e-2, 2.0**-18  # of R: or only as well as that on cells as narrow as this
SHARE = 8  # a gap may have this part of what may be left, divided by the number of gaps
STUBBORN = 64  # cells in a row that stay undecided: where they are small doubles do not suffice
SMALL = 2.0**-24  # of R
CHUNK = 20_000  # cells


def swept(p: Parameters, periods: int, allowed: Fraction, runner: Runner) -> list[Row]:
    """Return rows, in order; the cells left undecided are about as long as is ``allowed``, or
    doubles do not suffice."""
    cells, rows = _first(p), list[Row]()
    for _ in range(LEVELS):
        found = _passages(p, cells, periods, runner)
        open_ = _undecided(found, cells, float(p.R))
        rows += _rows(p, cells[~open_], found, np.flatnonzero(~open_))
        cells = cells[open_]
        left = float((cells[:, 1] - cells[:, 0]).sum())
        runner.tell(f"releases: {len(rows)} cells; {left / float(p.R):.1e} of R undecided", None)
        cells = _promising(cells, float(allowed), SMALL * float(p.R))
        if left <= float(allowed) / SHARE or not len(cells):
            break
        cells = _halves(cells)
    return sorted(rows)


def _first(p: Parameters) -> Floats:
    """Return cells that make up [l, r], but for less than the next doubles to its ends."""
    ends = [float(p.l + p.R * k / FIRST) for k in range(FIRST + 1)]
    if ends[0] < p.l:
        ends[0] = float(np.nextafter(ends[0], np.inf))
    if ends[-1] > p.r:
        ends[-1] = float(np.nextafter(ends[-1], -np.inf))
    return np.column_stack([ends[:-1], ends[1:]])


def _passages(p: Parameters, cells: Floats, periods: int, runner: Runner) -> Passages:
    """Follow cells, some at a time."""
    parts = np.array_split(cells, max(1, -(-len(cells) // CHUNK)))
    done = runner.map(lambda part: passages(p, part, periods), parts, "")
    if len(done) < len(parts):
        raise KeyboardInterrupt
    names = Passages.__slots__
    return Passages(*(np.concatenate([getattr(part, name) for part in done]) for name in names))


def _undecided(found: Passages, cells: Floats, R: float) -> NDArray[np.bool_]:
    """Return which cells are not decided."""
    narrow = cells[:, 1] - cells[:, 0] < NARROW * R
    wide = found.value[:, 1] - found.value[:, 0] > np.where(narrow, FAR, CLOSE) * R
    both = found.maybe & (1 << HIT_R | 1 << HIT_L) == 1 << HIT_R | 1 << HIT_L
    unclear = (found.verdict == SETTLED) & (wide | both)
    return np.asarray((found.verdict == UNDECIDED) | unclear)


def _promising(cells: Floats, allowed: float, small: float) -> Floats:
    """Return the cells to be halved.

    Not those that are small enough, nor those in a row in which doubles do not suffice.
    """
    cells = cells[np.argsort(cells[:, 0])]
    breaks = np.flatnonzero(cells[1:, 0] != cells[:-1, 1]) + 1
    runs = np.split(np.arange(len(cells)), breaks) if len(cells) else []
    enough = allowed / (SHARE * max(1, len(runs)))
    keep = [
        run
        for run in runs
        if cells[run[-1], 1] - cells[run[0], 0] > enough
        and not (len(run) > STUBBORN and cells[run[0], 1] - cells[run[0], 0] < small)
    ]
    return cells[np.concatenate(keep)] if keep else cells[:0]


def _halves(cells: Floats) -> Floats:
    middle = cells[:, 0] + (cells[:, 1] - cells[:, 0]) / 2
    inner = (cells[:, 0] < middle) & (middle < cells[:, 1])
    cells, middle = cells[inner], middle[inner]
    return np.concatenate(
        [np.column_stack([cells[:, 0], middle]), np.column_stack([middle, cells[:, 1]])]
    )


def _rows(p: Parameters, cells: Floats, found: Passages, which: NDArray[np.intp]) -> list[Row]:
    """Return the rows of the cells that are decided."""
    kinds: dict[tuple[bytes, int, int, int], Kind] = {}
    rows = []
    for (lower, upper), k in zip(cells.tolist(), which.tolist(), strict=True):
        verdict, maybe = int(found.verdict[k]), int(found.maybe[k])
        key = found.events[k].tobytes(), verdict, maybe, int(found.half_periods[k])
        if key not in kinds:
            kinds[key] = _kind(found.words(k), verdict, maybe), key[3]
        value, slope = found.value[k].tolist(), found.slope[k].tolist()
        rows.append(Row(lower, upper, kinds[key], clipped(p, tuple(value)), tuple(slope)))
    return rows


def _kind(words: tuple[str, ...], verdict: int, maybe: int) -> tuple[str, ...]:
    if verdict == MOVING:
        return words
    side = "r" if maybe >> HIT_R & 1 else "l"
    return shortened(words, side if verdict == SETTLED else "")
