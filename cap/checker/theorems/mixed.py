"""The theorem about the mixed dynamics: which share of the states goes where.

*Three fates* of the orbits from the states (x, v) with l < x < r, |v| < V at t = 0, in a system
without losses but friction:

    attractor   the orbit, or its image by (x, v, t) -> (l + r - x, -v, t + T/2), comes to be
                released in I (``attractor``): it tends to the orbits released in A, the
                intersection of all G^k(I)
    segment     it converges to a T-periodic orbit that touches no wall (``segment``)
    stops       its velocity vanishes at least once

The first two exclude each other, since an orbit of the first kind sticks again and again, and one
of the second does not in the end; both of them stop.

*Places.*  After a stick the state is known but for the place of the release; folded by the symmetry
(x, v, t) -> (l + r - x, -v, t + T/2), it is the distance to the wall ahead.  Places are divided by
a tree of halvings; parts of them are followed to their next release, as functions of one variable
with a derivative.  A part has a fate if all its next releases are in an interval of that fate, or
all its orbits are in the basin of the segment before; of other parts the measure is bounded that
has not the fate (`cap.checker.folded.masses`).

*Stops.*  A state that stops is what becomes of its first stop backwards in time, after so many half
periods (`cap.checker.folded.stops`).  First stops, by place and time, are cut into regions, which
are followed back, as long as nothing stops; so the areas at t = 0 are those of the stops, counted
as often as half periods pass.  At some stops the mass sticks: they have the fate of the place.  At
the others it turns: parts of the regions are followed forwards, until they stick, or are in a strip
of states that go to the segment; it is bounded how much of them has not the fate
(`cap.checker.folded.ahead`).  What is not counted is undecided.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from cap.checker.folded import flights
from cap.checker.folded.ahead import Outlook
from cap.checker.folded.areas import Areas, of_sticks, of_turns
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import System
from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import roof
from cap.checker.folded.regions import Leaf, leaves
from cap.checker.folded.regions import flights as cost
from cap.checker.folded.stops import all_stops
from cap.checker.folded.strip import Strip
from cap.checker.folded.tree import LETTERS, followed, nodes
from cap.checker.kernel.angles import rounded
from cap.checker.kernel.processes import each
from cap.checker.kernel.reading import text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Letters, Whole, enclosure, region
from cap.checker.kernel.shapes import Table as Fields
from cap.checker.kernel.theorem import BITS, SYSTEM, WITHOUT_LOSSES, Certificate, Theorem
from cap.checker.theorems.attractor import Attractor
from cap.checker.theorems.segment import Segment

_MOST_FLIGHTS = 1 << 23

Work = Callable[..., Sequence[Any]]  # a map over tasks


def shapes(table: Fields) -> dict[str, Any]:
    """Return the shape of the values of a table."""
    return {field.name: field.shape for field in table}


class Mixed(Theorem):
    """The shares of the states that tend to the attractor, to the segment, or stop."""

    PARAMETERS = WITHOUT_LOSSES
    # fmt: off
    HINTS = (
        BITS,
        Field("attractor", shapes(Attractor.HINTS), "", "", "as for the theorem attractor"),
        Field("places", {"level": Whole(6, 24), "tree": Letters(LETTERS, 1 << 18)}, "", "",
              "the tree of places that are followed: 2 for a node that is halved, then its halves; "
              "1 followed; 0 not; parts of them are halved down to this level of the tree"),
        Field("stops", {"late": text, "turns": text}, "", "",
              "the regions of first stops: of sticks, and of turns with their parts, as trees"),
    )
    CLAIMS = (
        Field("box", {"x": region, "v": region}, "", "", "all x between the walls, |v| up to V"),
        Field("shares", {"attractor": enclosure, "segment": enclosure, "either": enclosure,
                         "stops": enclosure, "undecided": enclosure}, "share", "s",
              "parts of the area of the box: of the states that tend to the orbits released in A, "
              "that converge to an orbit of the segment, that do one of both, that stop at least "
              "once, and of those of which nothing is shown"),
        Field("never_stopping_area", enclosure, "area that never stops", "A_0",
              "of the states in the box whose velocity never vanishes"),
        Field("attractor", shapes(Attractor.CLAIMS), "", "", "as for the theorem attractor"),
        Field("segment", shapes(Segment.CLAIMS), "", "", "as for the theorem segment"),
    )
    CITES = Attractor.CITES
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: the pieces into which places may be cut, and the flights backwards."""
        Attractor.limit(hints["attractor"], claims["attractor"])
        trees = hints["stops"]
        total = cost(trees["late"]) + cost(trees["turns"], parted=True)
        need(total <= _MOST_FLIGHTS, "there are too many flights")
        nodes(hints["places"]["tree"])

    def prove(self) -> None:
        """Prove the theorem."""
        self.box()
        for theorem in (Attractor, Segment):
            self.lemma(theorem)
        work = partial(each, self.jobs)
        places = self.places(work)
        self.step("the fates of releases are known, by intervals of places")
        self.sums(self.parts(self.counted(work, places)))
        self.step("the shares follow from the areas")

    def counted(self, work: Work, places: Places) -> Iterator[Areas]:
        """Give the areas of the states, by regions of their first stops."""
        y, V = System(self.p), below(self.region()[1])
        yield from work(partial(of_sticks, y, places, V), self.sticks(y))
        self.step("the states are counted that stick at their first stop")
        yield from work(partial(of_turns, y, self.outlook(places), V), self.turns(y))
        self.step("the states are counted that turn at their first stop")

    def parts(self, counted: Iterable[Areas]) -> tuple[Fraction, ...]:
        """Return the parts of the area for the fates, for either of them, and of all that stops."""
        W, V = self.region()
        sums = (
            sum(map(Fraction, found), Fraction()) for found in zip(Areas(), *counted, strict=True)
        )
        return tuple(area / (2 * W * V) for area in sums)

    def lemma(self, theorem: type[Theorem]) -> None:
        """Prove the theorem on which this one stands."""
        name = theorem.__name__.lower()
        hints = self.hints.get(name, self.hints)
        part = Certificate(name, self.p, self.certificate.digits, self.claims[name], hints)
        theorem(part, self.step).prove()

    # the units of the flow: 1/omega and F/omega^2

    def length(self, x: Fraction) -> Fraction:
        """Return a length in the units of the flow."""
        return x * self.omega**2 / self.p.F

    def speed(self, v: Fraction) -> Fraction:
        """Return a speed in the units of the flow."""
        return v * self.omega / self.p.F

    def box(self) -> None:
        """Check that the box is all between the walls, and as fast to the left as to the right."""
        x, v = self.claims["box"]["x"], self.claims["box"]["v"]
        need((x.lower, x.upper) == (self.p.l, self.p.r), "the box is not from wall to wall")
        need(v.upper > 0 and v.lower == -v.upper, "the box is not from -V to V")

    def strip(self) -> Strip:
        """Return a part of the basin of the segment: D(u) <= k u for 0 <= u <= d."""
        claims = self.claims["segment"]
        d, (a, b) = claims["basin"]["speed"], claims["basin"]["drift"]
        return Strip(
            above(self.length(claims["left"].upper)),
            below(self.length(claims["right"].lower)),
            below(self.speed(claims["v"].lower)),
            above(self.speed(claims["v"].upper)),
            below(self.speed(d) * (1 - Fraction(1, 10**9))),
            above((a + b * d) * self.omega),
            rounded(self.length(self.p.r)),
        )

    def places(self, work: Work) -> Places:
        """Return what is known of all distances to the wall ahead."""
        hints, width = self.hints["places"], self.width()
        step = partial(followed, self.p, self.strip(), width)
        pieces = work(step, nodes(hints["tree"]))
        return Places(self.kept(), width, hints["level"], pieces)

    def width(self) -> float:
        """Return the largest distance to the wall ahead, or a little more."""
        return roof(self.length(self.R))

    def kept(self) -> Pair:
        """Return the distances to the wall ahead of I."""
        a, b = self.claims["attractor"]["interval"][:2]
        return above(self.length(self.p.r - b)), below(self.length(self.p.r - a))

    def region(self) -> tuple[Fraction, Fraction]:
        """Return W and V of the box, in the units of the flow."""
        return self.length(self.R), self.speed(self.claims["box"]["v"].upper)

    def sticks(self, y: System) -> Iterator[Leaf]:
        """Give the regions of sticks."""
        return leaves(self.hints["stops"]["late"], all_stops(y))

    def turns(self, y: System) -> Iterator[Leaf]:
        """Give the regions of turns, with their parts."""
        return leaves(self.hints["stops"]["turns"], all_stops(y), parted=True)

    def outlook(self, places: Places) -> Outlook:
        """Return what tells what becomes of turns."""
        forwards = System(self.p, forwards=True), flights.System(self.p)
        return Outlook(*forwards, places, self.strip())

    def sums(self, parts: Sequence[Fraction]) -> None:
        """Compare the claims with the parts of the area."""
        (a, s, either, known), one = parts, Fraction(1)
        need(max(a + s, either, known) <= one, "the shares are more than the whole")
        found = {"attractor": (a, one - s), "segment": (s, one - a)}
        found |= {"either": (max(a + s, either), one), "stops": (known, one)}
        found |= {"undecided": (Fraction(0), one - known)}
        area = 2 * self.R * self.claims["box"]["v"].upper
        for name, ends in found.items():
            self.contains(f"shares.{name}", self.claims["shares"][name], ends)
        never = self.claims["never_stopping_area"]
        self.contains("never_stopping_area", never, (Fraction(0), (one - known) * area))

    def contains(self, name: str, claim: Any, ends: tuple[Fraction, Fraction]) -> None:
        """Check that a claim contains an interval."""
        inside = claim.lower <= ends[0] and ends[1] <= claim.upper
        need(inside, f"{name} does not contain [{float(ends[0]):.6f}, {float(ends[1]):.6f}]")

    def words(self) -> str:
        """Return the theorem in one line."""
        V, part = self.claims["box"]["v"].upper, self.claims["shares"]
        claims = self.claims["attractor"]
        losses = {"e": "1", "mu": "0"}
        return self.told(
            SYSTEM + _WORDS,
            V=V,
            area=2 * self.R * V,
            part=part,
            interval=claims["interval"],
            entropy=claims["entropy"],
            area_0=self.claims["never_stopping_area"].text[1],
            **losses,
        )


def above(x: Fraction) -> float:
    """Return a double that is not less."""
    a = float(x)
    return a if Fraction(a) >= x else math.nextafter(a, math.inf)


def below(x: Fraction) -> float:
    """Return a double that is not more."""
    return -above(-x)


_WORDS = (
    "with T = 2 pi/omega, of the states (x, v) between the walls with |v| < {V} at t = 0, of area "
    "{area}, at least the part {part[attractor].text[0]} is attracted to the orbits released in A, "
    "or to their images by (x, v, t) -> (l + r - x, -v, t + T/2), A the intersection of all G^k(I) "
    "for the release map G (from a release to the right to the next release, mirrored if that is "
    "to the left) on I = {interval}, of topological entropy in {entropy}; at least the part "
    "{part[segment].text[0]} converges to an orbit of the segment of T-periodic orbits that touch "
    "no wall; at least the part {part[either].text[0]} does one of both; at least the part "
    "{part[stops].text[0]} stops at least once, these included; of the part "
    "{part[undecided].text[1]} at most nothing is shown, so the states in the box that never stop "
    "have an area of at most {area_0}"
)

THEOREM = Mixed
