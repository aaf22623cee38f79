"""The theorem about the chaotic attractor: an interval of releases, and the entropy of its map.

*The release map.*  A mass that rests between the walls is released to the right when F cos wt = f
increases, to the left half a period before and after.  The flow commutes with (x, v, t) -> (l + r -
x, -v, t + T/2).  So let x be the place of a release to the right, and G(x) the place of the next
release, mirrored if that is to the left; G takes a whole number n of half-periods.

*Cells.*  An interval I = [a, b] is cut into cells.  On each, ``itinerary.follow`` proves the events
of all its releases up to the next one, which is the last and only one among them, the same on all
cells; G is the place of the last stick, an analytic function of x; jets in x alone, in mean value
form, enclose G' and G''.  From left to right these are known, for a minimum:

    cells     first    some after them    the last
    known     G' < 0       G'' > 0         G' > 0

and for a maximum with the other signs.  G' has opposite signs at the ends of ``critical``, and on
the middle cells it is strictly monotone: so G has one critical point c in I, between these ends.  G
is monotone on both sides of c: if G(a), G(b) and G(c) lie inside I, so does G(I).

*Kneading.*  Let R be the branch of G on which it decreases, L that on which it increases (so it is
as for a map with a maximum, which G or x -> -G(-x) is).  The kneading sequence of G is the sequence
of the branches on which G(c), G^2(c), ... lie; they are enclosed in mean value form, and each is
certainly on one side of c.

*Entropy.*  In the order of ``kneading``, the sequence of G lies between those of the tent maps with
the slopes exp of the ends of ``entropy``, for all slopes in their enclosures (Lemmas 5, 6).

*The flow.*  G' is not zero but at c, so no event is a capture, after which the state is constant:
the itinerary is as in ``releases``, and the entropy per period is 2h/n.

*Positive entropy.*  Then some G^N has a horseshoe: two intervals each of which it maps over both
[Misiurewicz], disjoint for some N [Block, Coppel].  So there is an x = G^3N(x) with x and G^N(x) in
the one and G^2N(x) in the other, of period 3 under G^N.  Hence G^N has periodic points of all least
periods q, and an uncountable scrambled set: any two of its points come close to each other again
and again, but do not stay so [Li, Yorke, Theorem 1].  Under G such a point has a least period of q
or more, so there are infinitely many; and the set is scrambled, too.

*The basin.*  All orbits from a box at t = 0 have the events claimed, up to a release in I.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from typing import Any, ClassVar, NamedTuple

from cap.checker.flow.events import WORDS, LossyMap
from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.exponential import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import (
    Field,
    Many,
    Quantity,
    Table,
    Whole,
    Word,
    enclosure,
    region,
)
from cap.checker.kernel.theorem import BITS, MAX_BITS
from cap.checker.maps.fixed_point import STATE
from cap.checker.release.cited import ENTROPY
from cap.checker.release.kneading import doubling, order, tent
from cap.checker.release.releases import next_release
from cap.checker.system.lossy import SYSTEM, WithLosses

_ORDER = 4  # of the jets over cells and over the box
_HORIZON = 17  # periods
_MAX_EVENTS, _MAX_CELLS, _MAX_SYMBOLS = 32, 512, 8192
_MAX_WORK = 5 << 22
_WINDOWS = Many(enclosure, 2, _MAX_EVENTS)


def _cost(bits: int) -> int:
    """Return about how long an event takes in an image at this precision."""
    return 1024 + bits + bits**2 // 256 + bits**3 // (1 << 20)


class Cell(NamedTuple):
    """A cell [lower, upper], the windows of its events, and the signs of G' and G'' on it, or 0."""

    lower: Fraction
    upper: Fraction
    windows: list[Ends]
    slope: int
    curve: int


class Attractor(WithLosses):
    """The interval, its unimodal map, and its entropy."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("cell_bits", Whole(64, MAX_BITS), "", "", "precision for the cells and the basin"),
        Field("critical", enclosure, "", "", "in I; G' has opposite signs at its ends"),
        Field("cells", Many({"to": number, "events": _WINDOWS}, 1, _MAX_CELLS), "", "",
              "they follow each other from one end of I to the other; each ends at `to`; a time "
              "window for each word, from the beginning of the period of the release"),
        Field("basin_events", _WINDOWS, "", "", "time windows of the events from the basin"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("interval", region, "I", "I", "G maps it into its interior"),
        Field("itinerary", Many(Word(WORDS), 2, _MAX_EVENTS), "", "",
              "the events of every release from I, up to the next release, the last word"),
        Field("half_periods", Whole(1, 32), "", "", "n: the time that G takes on I, in T/2"),
        Field("turn", Word(("minimum", "maximum")), "", "",
              "what G has at its one critical point in I; on both sides it is strictly monotone"),
        Field("critical_point", Quantity("R"), "critical point", "c", "where G' vanishes"),
        Field("critical_value", Quantity("R"), "its value", "G(c)", "the first image"),
        Field("kneading", Letters("RL", _MAX_SYMBOLS), "", "",
              "the branches of G(c), G^2(c), ..: R where G decreases, L where it increases"),
        Field("entropy", Quantity(), "topological entropy of G on I", "h", "at least 0"),
        Field("entropy_per_period", Quantity(), "the same per period T", "h_T", "2 h/n"),
        Field("basin", STATE, "", "",
              "every orbit from it at t = 0 comes to be released in I, or to the left in its "
              "mirror image"),
    )
    # fmt: on
    CITES = ENTROPY

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: a unit takes one to two microseconds, a cell as long as two images."""
        events = len(claims["itinerary"])
        lists = [hints["basin_events"], *(each["events"] for each in hints["cells"])]
        need(all(len(each) == events for each in lists), f"windows are not lists of {events}")
        symbols, cells = len(claims["kneading"]), len(hints["cells"])
        work = events * (_cost(hints["bits"]) * symbols + 2 * _cost(hints["cell_bits"]) * cells)
        need(work <= _MAX_WORK, f"bits, symbols and cells are too much: {work} > {_MAX_WORK}")

    def prove(self) -> None:
        """Prove the theorem."""
        need(self.p.f > 0, "0 < f does not hold")
        self.cells = list(self.covered())
        self.step(f"all releases from I have the itinerary: {', '.join(self.claims['itinerary'])}")
        self.unimodal()
        c = self.critical_point()
        self.step("the release map has one critical point in I")
        x = self.into_itself(c)
        self.step("the release map takes I into its interior")
        self.kneading(c, x)
        self.step("the critical point has the kneading sequence claimed")
        self.entropy()
        self.step("the kneading sequence lies between those of the tent maps")
        self.basin()
        self.step("all orbits from the box come to be released in I")

    # the release map

    def phi(self, windows: Sequence[Ends]) -> LossyMap:
        """Return the flow along the itinerary, with a window for each event."""
        return LossyMap(self.p, windows, self.claims["itinerary"], _HORIZON)

    def image(self, x: Interval, windows: Sequence[Ends], order: int) -> Centred:
        """Return G over a set of places, as a jet in x."""
        M = self.phi(windows).mechanics([x], [x.midpoint()], order)
        first, *later = M.minima[1]
        start = M.flight(1, first, M.variables[0], M.constant(x.integer(0)))
        start = start._replace(minima=later, at_rest=True)
        place, taken = next_release(M, self.phi(windows), start)
        need(taken == self.claims["half_periods"], "the release map takes another time")
        return place

    def windows(self, x: Interval) -> list[Ends]:
        """Return the hulls of the windows of the cells that meet an interval."""
        met = [c.windows for c in self.cells if c.lower <= x.upper and x.lower <= c.upper]
        need(bool(met), "an image of the critical point is not in I")
        return [
            (min(w[0] for w in each), max(w[1] for w in each)) for each in zip(*met, strict=True)
        ]

    def coarse(self, lower: Fraction, upper: Fraction) -> Interval:
        """Return an interval of places at the precision for cells."""
        return Interval.enclosing(lower, upper, self.hints["cell_bits"])

    # the proof, step by step

    def covered(self) -> Iterator[Cell]:
        """Yield the cells, which follow each other from one end of I to the other."""
        a, b = self.claims["interval"][:2]
        need(self.p.l < a < b < self.p.r, "the interval is not between the walls")
        for hint in self.hints["cells"]:
            lower, upper, windows = a, hint["to"], [w[:2] for w in hint["events"]]
            need(lower < upper <= b, "the cells are not in order, or leave the interval")
            yield self.cell(lower, upper, windows)
            a = upper
        need(a == b, "the cells do not cover the interval")

    def cell(self, lower: Fraction, upper: Fraction, windows: list[Ends]) -> Cell:
        """Prove that all releases from a cell have the itinerary; return the cell."""
        G = self.image(self.coarse(lower, upper), windows, _ORDER)
        return Cell(lower, upper, windows, sign(G[(1,)]), sign(G[(2,)]))

    def unimodal(self) -> None:
        """Prove that G' has one sign on the first cells, then G'' the other, then G' that."""
        turn, flat = self.turn, [n for n, c in enumerate(self.cells) if not c.slope]
        need(bool(flat), "no cell has a critical point")
        first, last = flat[0], flat[-1]
        before, after = self.cells[:first], self.cells[last + 1 :]
        outer = all(c.slope == -turn for c in before) and all(c.slope == turn for c in after)
        need(outer, "the release map may turn elsewhere")
        inner = all(c.curve == turn for c in self.cells[first : last + 1])
        need(inner, "the derivative of the release map may not be monotone where it vanishes")

    @property
    def turn(self) -> int:
        """1 if G has a minimum, -1 if it has a maximum."""
        return 1 if self.claims["turn"] == "minimum" else -1

    def critical_point(self) -> Interval:
        """Return an enclosure of the critical point."""
        low, high = self.hints["critical"][:2]
        a, b = self.claims["interval"][:2]
        need(a < low < high < b, "the critical point is not in I")
        for end, side in ((low, -1), (high, 1)):
            x = self.number(end)
            slope = self.image(x, self.windows(x), 2)[(1,)] * self.turn
            need((slope * side).is_positive(), "the derivative may not change its sign at c")
        c = Interval.enclosing(low, high, self.hints["bits"])
        self.confirm(critical_point=c)
        return c

    def into_itself(self, c: Interval) -> Interval:
        """Prove that G takes I into its interior; return an enclosure of G(c)."""
        a, b = self.claims["interval"][:2]
        value = self.image(c, self.windows(c), 1).value
        edges = [self.coarse(end, end) for end in (a, b)]
        for y in (value, *(self.image(x, self.windows(x), 1).value for x in edges)):
            need(y.lies_inside(a, b), "the release map may not take I into its interior")
        self.confirm(critical_value=value)
        return value

    def kneading(self, c: Interval, x: Interval) -> Interval:
        """Prove that the images of the critical point lie on the branches claimed.

        Return an enclosure of the last one.
        """
        symbols = self.claims["kneading"]
        for n, symbol in enumerate(symbols, 1):
            if n > 1:
                x = self.image(x, self.windows(x), 1).value
            holds = self.lies_on(symbol, x, c)
            need(holds, f"symbol {n} of the kneading sequence may be another one")
        return x

    def lies_on(self, symbol: str, x: Interval, c: Interval) -> bool:
        """Return whether all places certainly lie on this branch."""
        left = "R" if self.turn > 0 else "L"  # the branch to the left of c
        return x.is_before(c) if symbol == left else c.is_before(x)

    def symbols(self) -> Iterable[str]:
        """Return the kneading sequence, as far as it is known."""
        symbols: str = self.claims["kneading"]
        return symbols

    def entropy(self) -> None:
        """Prove the bounds of the entropy, and those per period that follow."""
        claim = self.claims["entropy"]
        need(claim.lower >= 0, "the entropy claimed is negative")
        if claim.lower > 0:
            larger = order(self.symbols(), self.tent(claim.lower)) > 0
            need(larger, "the entropy may be below its lower bound")
        if claim.upper == 0:
            need(order(self.symbols(), doubling()) < 0, "the entropy may be positive")
        else:
            smaller = order(self.symbols(), self.tent(claim.upper)) < 0
            need(smaller, "the entropy may be above its upper bound")
        self.narrow("entropy", claim)
        each, n = self.claims["entropy_per_period"], self.claims["half_periods"]
        within = each.lower <= 2 * claim.lower / n and 2 * claim.upper / n <= each.upper
        need(within, "the entropy per period does not contain 2/n times that of G")
        self.narrow("entropy_per_period", each)

    def tent(self, logarithm: Fraction) -> Iterator[str]:
        """Return the kneading sequence of the tent maps of the slope with this logarithm."""
        return tent(phi(0, self.number(logarithm)))

    def basin(self) -> None:
        """Prove that all orbits from the box claimed come to be released in I."""
        box = [self.claims["basin"][z][:2] for z in ("x", "v")]
        need(all(low < high for low, high in box), "the box has no interior")
        self.box(box, [w[:2] for w in self.hints["basin_events"]])

    def box(self, box: Sequence[Ends], windows: Sequence[Ends]) -> None:
        """Prove that all orbits from a box come to be released in I."""
        area = [self.coarse(*z) for z in box]
        M = self.phi(windows).mechanics(area, [z.midpoint() for z in area], _ORDER)
        place = next_release(M, self.phi(windows), M.launch())[0].value
        inside = place.lies_in(*self.claims["interval"][:2])
        need(inside, "the releases of orbits from the box may not lie in I")

    def words(self) -> str:
        """Return the theorem in one line."""
        lower, upper = self.claims["entropy"][:2]
        x, v = self.claims["basin"]["x"], self.claims["basin"]["v"]
        area = decimal((x.upper - x.lower) * (v.upper - v.lower))
        chaos = _CHAOS if lower > 0 else _NO_CHAOS if upper == 0 else ""
        more = {"events": ", ".join(self.claims["itinerary"]), "x": x, "v": v, "area": area}
        return self.told(SYSTEM + _MAP + self.about(chaos) + _BASIN, **more, kneading=self.known())

    def known(self) -> str:
        """Return the kneading sequence for people."""
        return "".join(self.symbols())

    def about(self, chaos: str) -> str:
        """Return what is said, and not said, of the orbits in I."""
        return chaos + _NOT_CLAIMED if chaos == _CHAOS else chaos


def sign(x: Interval) -> int:
    """Return the sign of all numbers in an interval, or 0."""
    return int(x.is_positive()) - int((-x).is_positive())


_MAP = (
    "with T = 2 pi/omega, "
    "let G take the place x at which a mass that has stuck is released to the right to the place "
    "of its next release, a release to the left mirrored by x -> l + r - x with half a period; G "
    "takes I = {interval} into its interior, all releases from I have exactly these events up to "
    "the next release, {half_periods} half-periods later: {events}; on I G has one critical "
    "point, a {turn}, in {critical_point}, with the value in {critical_value}; the branches "
    "on which its first images lie, R where G decreases, L where it increases, are {kneading}; "
    "hence (Milnor-Thurston) the topological entropy of G on I is in {entropy}; and where (wall, "
    "v) before a hit and (wall, -e v) after it count as one state, that of the map over one "
    "period, from one time of releases to the right to the next, is in {entropy_per_period} on the "
    "set of the states at these times of the orbits released in A, the intersection of all G^k(I), "
    "and of their images by (x, v, t) -> (l + r - x, -v, t + T/2)"
)
_CHAOS = (
    "; as it is positive, an iterate of G has a horseshoe (Misiurewicz), so a point of period 3; "
    "so (Li-Yorke) G has periodic points of infinitely many periods and an uncountable scrambled "
    "set"
)
_NOT_CLAIMED = (
    "; it is not claimed that no periodic orbit attracts, nor that there is an invariant density"
)
_NO_CHAOS = "; so G has no horseshoe, nor has an iterate of it"
_BASIN = (
    "; every orbit from {x} x {v} at t = 0, a box of the area {area}, comes to be released in I, "
    "or to the left in the mirror image of I: it tends to the orbits released in A and their images"
)

THEOREM = Attractor
