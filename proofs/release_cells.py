"""Cells of an interval of releases, on each of which the checker follows the contacts.

Nothing is proved here: cells are made smaller until the checker succeeds.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.release_cells import Cell, cell
from cap.checker.system.releases import Releases
from cap.errors import NotProved
from cap.floats import candidates
from cap.proofs.release_ends import aligned, near

CELLS = 64  # at first, where an orbit attracts
SMALLEST = Fraction(1, 1 << 12)  # the least cell that is halved, as a part of I
PADS = (Fraction(1), Fraction(4))  # of windows, as parts of the range of the times
FLAT = 20  # the range is taken to be at least such a part of the length of the cell
LEAST = Fraction(1, 10**7)  # of a period: the least room at the ends of a window
Windows = list[tuple[Fraction, Fraction]]
Placed = tuple[Cell, Windows]  # and the windows of its contacts, in decimals


def cells(stay: candidates.Stay, given: Releases, a: Fraction, b: Fraction) -> Iterator[Placed]:
    """Yield the cells, from left to right; those that are too large are halved."""
    least = near(float((b - a) * SMALLEST))
    for c, d in ((a, a + least), (b - least, b)):  # where a proof fails most often
        try:
            _cell(stay, given, c, d)
        except Rejected as reason:
            raise _uncertain(c, reason) from None
    if stay.closes:
        ends = [near(float(a + (b - a) * k / CELLS)) for k in range(CELLS + 1)]
    else:
        ends = aligned(stay, given, a, b)
    waiting = [*pairwise(ends)][::-1]
    while waiting:
        c, d = waiting.pop()
        try:
            yield _cell(stay, given, c, d)
        except Rejected as reason:
            if d - c < (b - a) * SMALLEST:
                raise _uncertain(c, reason) from None
            m = near(float((c + d) / 2))
            waiting += [(m, d), (c, m)]


def _uncertain(t: Fraction, reason: Rejected) -> NotProved:
    where = f"near the time {float(t):.8g} the next contact is not certain"
    return NotProved("releases", f"{where}: {reason}")


def _cell(stay: candidates.Stay, given: Releases, c: Fraction, d: Fraction) -> Placed:
    """Return the cell [c, d]; raise `Rejected` if it is too large."""
    rows = [stay.times(float(t)) for t in (c, (c + d) / 2, d)]
    if not all(rows):
        raise Rejected("the contacts are others")
    why = Rejected("no windows are tried")
    least = LEAST * Fraction(given.period.upper)
    for pad in PADS:
        windows = Windows()
        for times in zip(*rows, strict=True):
            low, high = near(min(times)), near(max(times))
            room = near(float(max(high - low, (d - c) / FLAT) * pad + least))
            windows.append((low - room, high + room))
        try:
            return _enclosed(stay, given, c, d, windows)
        except Rejected as reason:
            why = reason
    raise why


def _enclosed(
    stay: candidates.Stay,
    given: Releases,
    c: Fraction,
    d: Fraction,
    windows: Windows,
) -> Placed:
    """Return the cell with these windows."""
    boxes = [Interval.enclosing(*w, given.bits) for w in windows]
    found = cell(given, stay.periods, (c, d), boxes)
    if not (found.laps or stay.closes):
        raise Rejected("the map may turn more than once")
    return found, windows
