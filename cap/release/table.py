"""The release map on all of [l, r]: its branches, proved, and the places that are left over.

A place is in a branch if the events up to the next release are known, or those of all the periods
looked at, in which there is none.  Cells are halved until they are in a branch: first in intervals
of doubles (`cap.boxes.release`), then, where these do not suffice, in balls.  What is left over are
gaps between branches, about the places where the events change (`cap.release.border`).

Near a wall the events change infinitely often: where captures begin, the number of hits before the
mass comes to rest has no bound.  There a branch has the word `settle r` or `settle l` for hits and
turns near the wall, finitely or infinitely many, after which all masses rest at it or near it.
"""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from cap.errors import BadInput, NotProved
from cap.flow.strobe import oscillator
from cap.parameters import Parameters
from cap.release import remainder
from cap.release.cell import cell
from cap.release.remainder import outward, refined
from cap.release.rows import Row, gaps_between, turned
from cap.release.sweep import swept
from cap.release.unimodal import nearby
from cap.runner import Runner
from cap.sets import interval

PERIODS = 4


@dataclass(frozen=True)
class Branch:
    """Releases to the right from all places of [lower, upper] have the events of ``itinerary``.

    The last one is the next release, ``half_periods`` T/2 later; 0: there is none in the periods
    looked at.  The ``rows`` are the cells of which it is made, in order, each with G and G'.
    """

    itinerary: tuple[str, ...]
    half_periods: int
    rows: tuple[Row, ...]

    @property
    def lower(self) -> Fraction:
        """The lower end."""
        return Fraction(self.rows[0].lower)

    @property
    def upper(self) -> Fraction:
        """The upper end."""
        return Fraction(self.rows[-1].upper)

    @property
    def length(self) -> Fraction:
        """Its length."""
        return self.upper - self.lower

    @property
    def value(self) -> tuple[float, float]:
        """Ends of an enclosure of G on the branch; NaN without a release."""
        return min(row.value[0] for row in self.rows), max(row.value[1] for row in self.rows)

    @property
    def words(self) -> str:
        """The itinerary in one string."""
        return ", ".join(self.itinerary)


@dataclass(frozen=True)
class Table:
    """The release map at parameters, for so many ``periods``.

    ``branches``, in order.  ``gaps``: closed intervals with all places of [l, r] in no branch.
    """

    parameters: Parameters
    periods: int
    branches: tuple[Branch, ...]
    gaps: tuple[tuple[Fraction, Fraction], ...]

    @property
    def undecided(self) -> Fraction:
        """The sum of the lengths of the gaps."""
        return sum((b - a for a, b in self.gaps), Fraction(0))

    @property
    def moving(self) -> Fraction:
        """The length of the branches without a release in the periods looked at."""
        return sum((b.length for b in self.branches if not b.half_periods), Fraction(0))

    def at(self, x: Fraction) -> Branch | None:
        """Return the branch with this place, if it is in one."""
        k = bisect_right(self.branches, x, key=lambda branch: branch.lower) - 1
        return self.branches[k] if k >= 0 and x <= self.branches[k].upper else None


def table(
    p: Parameters,
    periods: int = PERIODS,
    undecided: Fraction = Fraction(1, 10**6),
    runner: Runner | None = None,
) -> Table:
    """Return the branches of the release map.

    Cells are halved until less than this part of R is ``undecided``, as far as that succeeds: the
    table tells what is left.  Raises `BadInput` without friction.
    """
    if not p.f:
        raise BadInput("without friction no mass sticks: f > 0 is needed")
    if not 0 < undecided < 1:
        raise BadInput(f"the part that may stay undecided must be between 0 and 1: {undecided}")
    rows = swept(p, periods, undecided * p.R, runner or Runner(whole=True))
    rows = refined(p, rows, periods, undecided * p.R)
    return Table(p, periods, tuple(branches_of(rows)), tuple(gaps_between(p, rows)))


def curve(p: Parameters, row: Row) -> tuple[float, float]:
    """Return the ends of an enclosure of G'' on a cell of a branch with a release.

    Raises `NotProved` where Taylor models do not follow the cell: where captures begin, and close
    to the ends of branches.
    """
    with interval.workprec(remainder.BITS):
        ends = Fraction(row.lower), Fraction(row.upper)
        found = cell(oscillator(p), *ends, nearby(p, float(sum(ends)) / 2), curved=True)
    if found.curve is None:
        raise NotProved("cell", "the second derivative is not known")
    return outward(found.curve)


class Unfolded(NamedTuple):
    """A branch of releases to one side, and where the next release is; neither is mirrored.

    ``value`` are the ends of an enclosure of that place, None if it is not known.
    """

    lower: Fraction
    upper: Fraction
    itinerary: tuple[str, ...]
    half_periods: int
    value: tuple[Fraction, Fraction] | None


def unfolded(found: Table, side: str) -> list[Unfolded]:
    """Return the branches of releases to the ``side``, right or left."""
    total = found.parameters.l + found.parameters.r

    def image(ends: tuple[Fraction, Fraction], *, mirror: bool) -> tuple[Fraction, Fraction]:
        return (total - ends[1], total - ends[0]) if mirror else ends

    done, left = [], side == "left"
    for branch in found.branches[:: -1 if left else 1]:
        n, value = branch.half_periods, None
        if n:
            low, high = branch.value
            value = image((Fraction(low), Fraction(high)), mirror=left != (n % 2 == 1))
        words = turned(branch.itinerary) if left else branch.itinerary
        ends = image((branch.lower, branch.upper), mirror=left)
        done.append(Unfolded(*ends, words, n, value))
    return done


def branches_of(rows: Sequence[Row]) -> Iterator[Branch]:
    """Join neighbouring rows with the same events."""
    part: list[Row] = []
    for row in rows:
        if part and not (part[-1].upper == row.lower and part[-1].kind == row.kind):
            yield Branch(*part[0].kind, tuple(part))
            part = []
        part.append(row)
    if part:
        yield Branch(*part[0].kind, tuple(part))
