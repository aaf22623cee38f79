"""Unimodal pieces of the release map: their cells, their critical point, its itinerary."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from cap.errors import BadInput, NotProved
from cap.flow.event import BALLS
from cap.flow.model import Oscillator
from cap.flow.windows import Itinerary
from cap.parameters import Parameters
from cap.release.cell import Cell, cell
from cap.release.jet import release_jet
from cap.release.passage import foreseen, image, passage, windows
from cap.sets import interval
from cap.sets.interval import Ball

PIECES = 24  # at least, of an interval
FINEST = 2**12  # at most


@dataclass(frozen=True)
class Critical:
    """The critical point lies in [lower, upper]; ``turn`` is 1 at a minimum, -1 at a maximum."""

    lower: Fraction
    upper: Fraction
    turn: int

    @property
    def ball(self) -> Ball:
        """A ball that contains [lower, upper]."""
        return interval.hull(interval.ball(self.lower), interval.ball(self.upper))


def cover(osc: Oscillator[Any], p: Parameters, lower: Fraction, upper: Fraction) -> list[Cell]:
    """Return cells that cover [lower, upper], on each of which all releases have one
    itinerary, and G' or G'' has one sign.

    Raises `NotProved` if one stays undecided.
    """
    cuts = [lower + (upper - lower) * k / PIECES for k in range(PIECES + 1)]
    found: list[Cell] = []
    for a, b in pairwise(cuts):
        found += _decided(osc, p, (a, b), (upper - lower) / FINEST)
    return found


def _decided(
    osc: Oscillator[Any], p: Parameters, ends: tuple[Fraction, Fraction], finest: Fraction
) -> list[Cell]:
    a, b = ends
    try:
        expected = nearby(p, float((a + b) / 2))
        found = cell(osc, a, b, expected)
        if not _sign(found.slope):
            found = cell(osc, a, b, expected, curved=True)
        if _sign(found.slope) or _sign(found.curve):
            return [found]
        failure = NotProved("cells", "the release map may turn", {"x": [float(a), float(b)]})
    except NotProved as undecided:
        failure = undecided
    if b - a < finest:
        raise failure
    middle = (a + b) / 2
    left = _decided(osc, p, (a, middle), finest)
    return left + _decided(osc, p, (middle, b), finest)


def nearby(p: Parameters, x: float) -> Itinerary:
    """Return the events foreseen of a place; raise `NotProved` if floats foresee none."""
    try:
        return foreseen(p, x)[0]
    except BadInput as error:
        raise NotProved("release map", str(error)) from None


def _sign(x: Ball | None) -> int:
    """Return the sign of all numbers in a ball, or 0."""
    return 0 if x is None else int(x > 0) - int(x < 0)


def turning(cells: list[Cell]) -> int:
    """Prove that G has one critical point on the cells: return 1 for a minimum, -1 for a maximum.

    From left to right: cells where G' has the one sign, cells where G'' has the other, so that G'
    is monotone on their union, cells where G' has the other.
    """
    slopes = [_sign(each.slope) for each in cells]
    flat = [n for n, sign in enumerate(slopes) if not sign]
    if not flat or flat != list(range(flat[0], flat[-1] + 1)) or slopes[0] == slopes[-1]:
        raise NotProved("unimodal", "there may be no critical point, or several")
    turn = slopes[-1]
    before, after = set(slopes[: flat[0]]), set(slopes[flat[-1] + 1 :])
    bent = {_sign(cells[n].curve) for n in flat}
    if not (before == {-turn} and after == bent == {turn}):
        raise NotProved("unimodal", "there may be several critical points")
    return turn


def critical(
    osc: Oscillator[Any], near: float, expected: Itinerary, turn: int, places: int
) -> Critical:
    """Return an enclosure of the critical point near a float, to ``places`` bits or half of those
    with which one works.

    Newton's method on G' = 0; then G' has opposite signs at both ends.
    """
    half = max(places, interval.working_bits() // 2)
    m = Ball(near)
    for _ in range(half.bit_length() + 2):
        slope, curve = slopes_at(osc, m, expected)
        m = interval.point(m - slope / curve)
    grid = 2**half
    middle = Fraction(round(interval.rational(m) * grid), grid)
    lower, upper = middle - Fraction(16, grid), middle + Fraction(16, grid)
    signs = [turn * slopes_at(osc, interval.ball(end), expected)[0] for end in (lower, upper)]
    if not (signs[0] < 0 < signs[1]):
        raise NotProved("critical point", "it is not certain where G' vanishes", {"G'": signs})
    return Critical(lower, upper, turn)


def slopes_at(osc: Oscillator[Any], m: Ball, expected: Itinerary) -> tuple[Ball, Ball]:
    """Return enclosures of G' and G'' over a small ball."""
    proved = passage(osc, m, windows(osc, m, expected, BALLS), BALLS)
    jet = release_jet(osc, m, proved.events, 2)
    return jet[(1,)], 2 * jet[(2,)]


def kneading_sequence(
    osc: Oscillator[Any], p: Parameters, c: Critical, expected: Itinerary
) -> Iterator[str]:
    """Yield the branches of G(c), G²(c), ..., as long as they are certain.

    R is the branch on which G decreases, L that on which it increases.
    """
    falling, rising = ("R", "L") if c.turn > 0 else ("L", "R")  # to the left of c, to the right
    point = c.ball
    x = image(osc, point, expected)[0]
    while x < point or x > point:
        yield falling if x < point else rising
        try:
            x = image(osc, x, nearby(p, float(x.mid())))[0]
        except NotProved:
            return
