"""The theorem about the mixed dynamics: which share of the states goes where.

*Three fates* of the orbits from the states (x, v) with l < x < r, |v| < V at t = 0, in a system
without losses but friction:

    attractor   the orbit, or its image by (x, v, t) -> (l + r - x, -v, t + T/2), comes to be
                released in I (``attractor``): it tends to the orbits released in A, the
                intersection of all G^k(I); or it comes to be released in a cycle of intervals that
                attracts (`cap.checker.folded.cycles`), or comes to the ellipse of a sink
                (`cap.checker.folded.sinks`) at a multiple of T: it tends to a periodic orbit
    segment     it converges to a T-periodic orbit that touches no wall (``segment``)
    stops       its velocity vanishes at least once

The first two exclude each other, since an orbit of the first kind sticks or, as that of a sink hits
a wall, hits again and again, and one of the second does neither in the end.  Not all of I, cycles,
sinks and the segment need be claimed: what nothing is claimed of has no fate.

*Places.*  After a stick the state is known but for the place of the release; folded by the symmetry
(x, v, t) -> (l + r - x, -v, t + T/2), it is the distance to the wall ahead.  Places are divided by
a tree of halvings; parts of them are followed to their next release, as functions of one variable
with a derivative.  A part has a fate if all its next releases are in an interval of that fate, or
all its orbits are in the basin of the segment or in a sink before; of other parts the measure is
bounded that has not the fate (`cap.checker.folded.masses`).

*Stops.*  A state that stops is what becomes of its first stop backwards in time, after so many half
periods (`cap.checker.folded.stops`).  First stops, by place and time, are cut into regions, which
are followed back, as long as nothing stops; so the areas at t = 0 are those of the stops, counted
as often as half periods pass.  At some stops the mass sticks: they have the fate of the place.  At
the others it turns: parts of the regions are followed forwards, until they stick, or are in the
basin of the segment or in a sink; it is bounded how much of them has not the fate
(`cap.checker.folded.ahead`).  What is not counted is undecided.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

from cap.checker.folded import flights
from cap.checker.folded.ahead import Outlook
from cap.checker.folded.areas import Areas, of_sticks, of_turns
from cap.checker.folded.basins import Basins, Row, Strip
from cap.checker.folded.cycles import Distances, contract
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import System
from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import roof
from cap.checker.folded.regions import USUAL, Leaf, leaves
from cap.checker.folded.regions import flights as cost
from cap.checker.folded.sinks import Sink
from cap.checker.folded.stops import EARLY, LATE, all_stops
from cap.checker.folded.tree import LETTERS, followed, nodes
from cap.checker.kernel.citation import Citation
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import MAX_SIZE, number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import (
    Enclosure,
    Field,
    Many,
    Maybe,
    Whole,
    enclosure,
    region,
)
from cap.checker.kernel.shapes import Table as Fields
from cap.checker.kernel.theorem import BITS, Certificate
from cap.checker.system.walls import SYSTEM, BetweenWalls, Parameters
from cap.checker.theorems.attractor import Attractor
from cap.checker.theorems.segment import Segment

MOST_FLIGHTS = 1 << 25
_MOST_CYCLES, _LONGEST = 16, 32
_MOST_SIZE = MAX_SIZE**3  # of lengths and speeds, products of parameters
MOST_SINKS, MOST_HALVES = 16, 64
SIDES = {LATE: "late", EARLY: "early"}
_PLACE = 15  # flights take as long as a place that is followed

Map = Callable[..., Sequence[Any]]
"""Does tasks, by function, tasks, the words for it, and the weight of a task."""


def shapes(table: Fields) -> dict[str, Any]:
    """Return the shape of the values of a table."""
    return {field.name: field.shape for field in table}


def named(theorem: type[BetweenWalls]) -> str:
    """Return the name of a theorem, and of the claims about it."""
    return theorem.__name__.lower()


def where_claimed(citation: Citation) -> Citation:
    """Return what is cited for an attractor, if one is claimed."""
    only, found = "only where ", list[dict[str, Any]]()
    for known in citation["hypotheses"]:
        statement, by = known["statement"], [f"attractor.{name}" for name in known["by"]]
        link = " and " if statement.startswith(only) else ": "
        statement = f"{only}`attractor` is claimed{link}{statement.removeprefix(only)}"
        found.append({**known, "statement": statement, "by": by})
    return citation | {"hypotheses": found}


class Mixed(BetweenWalls):
    """The shares of the states that tend to the attractor, to the segment, or stop."""

    p: Parameters
    # fmt: off
    HINTS = (
        BITS,
        Field("attractor", Maybe(shapes(Attractor.HINTS)), "", "",
              "as for the theorem attractor, if `attractor` is claimed"),
        Field("places", {"level": Whole(6, 24), "tree": Letters(LETTERS, 1 << 18)}, "", "",
              "the tree of places that are followed: 2 for a node that is halved, then its halves; "
              "1 followed; 0 not; parts of them are halved down to this level of the tree"),
        Field("stops", {"late": text, "early": text, "turns": text}, "", "",
              "the regions of first stops: of sticks in the second and in the first half of their "
              "arc, and of turns with their parts, as trees"),
    )
    CLAIMS = (
        Field("box", {"x": region, "v": region}, "", "", "all x between the walls, |v| up to V"),
        Field("shares", {"attractor": enclosure, "segment": enclosure, "either": enclosure,
                         "stops": enclosure, "undecided": enclosure}, "share", "s",
              "parts of the area of the box: of the states that tend to the orbits released in A, "
              "to those of the cycles or of the sinks, or to images of these by (x, v, t) -> (l "
              "+ r - x, -v, t + T/2), that converge to an orbit of the segment, that do one of "
              "both, that stop at least once, and of those of which nothing is shown"),
        Field("never_stopping_area", enclosure, "area that never stops", "A_0",
              "of the states in the box whose velocity never vanishes"),
        Field("attractor", Maybe(shapes(Attractor.CLAIMS)), "", "", "as for the theorem attractor"),
        Field("cycles", Maybe(Many(Many(region, 1, _LONGEST), 1, _MOST_CYCLES)), "", "",
              "intervals of places, each of which G, the next place of release, mirrored if that "
              "is to the left, takes into the next one of its cycle, the last one into the first; "
              "around the cycle it is a contraction"),
        Field("sinks", Maybe(Many({"x": number, "v": number, "matrix": [[number] * 2] * 2,
                                   "halves": Whole(1, MOST_HALVES)}, 1, MOST_SINKS)), "", "",
              "ellipses of states z at t = 0, |matrix (z - (x, v))| <= 1 in the Euclidean norm, "
              "that the flow over so many halves of T, mirrored if they are odd, takes into "
              "themselves, and contracts in this norm"),
        Field("segment", Maybe(shapes(Segment.CLAIMS)), "", "", "as for the theorem segment"),
    )
    CITES = tuple(map(where_claimed, Attractor.CITES))
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound sizes, and the time: the pieces of places, and the flights backwards."""
        V, sinks = claims["box"]["v"].upper, claims.get("sinks", [])
        need(V <= _MOST_SIZE and V * _MOST_SIZE >= 1, "V is not between 10^-90 and 10^90")
        for sink in sinks:
            sizes = map(abs, (sink["x"], sink["v"], *sink["matrix"][0], *sink["matrix"][1]))
            need(max(sizes) <= _MOST_SIZE, "a number of a sink is larger than 10^90")
        need(("attractor" in hints) is ("attractor" in claims), "an attractor without its hints")
        if "attractor" in claims:
            Attractor.limit(hints["attractor"], claims["attractor"])
        trees = hints["stops"]
        total = sum(cost(trees[name], parted=name == "turns") for name in trees)
        need(total <= MOST_FLIGHTS, "there are too many flights")
        nodes(hints["places"]["tree"])

    @in_doubles()
    def prove(self) -> None:
        """Prove the theorem."""
        self.box()
        self.tell("what attracts", 0.0)
        for theorem in (Attractor, Segment):
            if named(theorem) in self.claims:
                self.lemma(theorem)
        self.sinks()
        self.cycles()
        work = Work(self.jobs, self.tell, self.phases())
        places = self.places(work)
        self.step("the fates of releases are known, by intervals of places")
        self.sums(self.parts(self.counted(work, places)))
        self.step("the shares follow from the areas")

    def phases(self) -> dict[str, float]:
        """Return what takes long, in words, and how long it may take."""
        tree, stops = self.hints["places"]["tree"], self.hints["stops"]
        followed = {BACK.format(name): float(cost(stops[name])) for name in SIDES.values()}
        turns = {TURNS: float(cost(stops["turns"], parted=True, ahead=USUAL))}
        return {PLACES: float(_PLACE * len(nodes(tree)))} | followed | turns

    def counted(self, work: Map, places: Places) -> Iterator[Areas]:
        """Give the areas of the states, by regions of their first stops."""
        y, V = System(self.p), below(self.region()[1])
        for side, name in SIDES.items():
            areas = partial(of_sticks, y, places, V, side)
            yield from work(areas, self.sticks(y, side), BACK.format(name), Leaf.work)
        self.step("the states are counted that stick at their first stop")
        areas = partial(of_turns, y, self.outlook(places), V)
        yield from work(areas, self.turns(y), TURNS, Leaf.work)
        self.step("the states are counted that turn at their first stop")

    def parts(self, counted: Iterable[Areas]) -> tuple[Fraction, ...]:
        """Return the parts of the area for the fates, for either of them, and of all that stops."""
        W, V = self.region()
        sums = (
            sum(map(Fraction, found), Fraction()) for found in zip(Areas(), *counted, strict=True)
        )
        return tuple(area / (2 * W * V) for area in sums)

    def lemma(self, theorem: type[BetweenWalls]) -> None:
        """Prove the theorem on which this one stands."""
        name = named(theorem)
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

    def basins(self) -> Basins:
        """Return what is known of the basins of the segment and of the sinks."""
        strips = (self.strip(),) if "segment" in self.claims else ()
        sinks = [self.sink(claim) for claim in self.claims.get("sinks", [])]
        even, odd = (tuple(z.ellipse() for z in sinks if z.odd is side) for side in (False, True))
        return Basins(strips, even, odd)

    def strip(self) -> Strip:
        """Return a part of the basin of the segment.

        That is x and x + k (v - u) in (left, right), |v - u| < d for the u in a pair, if D(w) <= k
        w for 0 <= w <= d; p = x - r.
        """
        claims = self.claims["segment"]
        d, (a, b) = claims["basin"]["speed"], claims["basin"]["drift"]
        slow, fast = (self.speed(u) for u in claims["v"][:2])
        left, right = self.length(claims["left"].upper), self.length(claims["right"].lower)
        edge, k = self.length(self.p.r), Fraction(above((a + b * d) * self.omega))
        d = self.speed(d) * (1 - Fraction(1, 10**9))
        rows = (
            Row(1.0, 0.0, above(left - edge), below(right - edge)),
            Row(0.0, 1.0, above(fast - d), below(slow + d)),
            Row(1.0, float(k), above(left - edge + k * fast), below(right - edge + k * slow)),
        )
        return Strip(rows)

    def sink(self, claim: dict[str, Any]) -> Sink:
        """Return a sink, of which nothing is proved yet: p = x - r, or l - x mirrored, at pi."""
        x, v = self.length(Fraction(1)), self.speed(Fraction(1))
        first, second = ((a / x, b / v) for a, b in claim["matrix"])
        left = claim["v"] < 0
        place = self.p.l - claim["x"] if left else claim["x"] - self.p.r
        centre = self.length(place), self.speed(abs(claim["v"]))
        return Sink(centre, (first, second), claim["halves"], left)

    def sinks(self) -> None:
        """Prove that the flow contracts the sinks."""
        y = System(self.p, forwards=True)
        for claim in self.claims.get("sinks", []):
            self.sink(claim).contract(y)
            self.step("the flow takes an ellipse of states into itself, and contracts it")

    def places(self, work: Map) -> Places:
        """Return what is known of all distances to the wall ahead."""
        hints, width = self.hints["places"], self.width()
        step = partial(followed, self.p, self.basins(), width)
        parts = work(step, nodes(hints["tree"]), PLACES, lambda _node: _PLACE)
        pieces = [piece for found in parts for piece in found]
        return Places(self.kept(), width, hints["level"], pieces)

    def width(self) -> float:
        """Return the largest distance to the wall ahead, or a little more."""
        return roof(self.length(self.R))

    def kept(self) -> list[Pair]:
        """Return the distances to the wall ahead of I, and of the cycles."""
        found = [self.distances(z).inner for cycle in self.claims.get("cycles", []) for z in cycle]
        if "attractor" in self.claims:
            found.append(self.distances(self.claims["attractor"]["interval"]).inner)
        need(all(a < b for a, b in found), "an interval of places is too short")
        apart = all(b < c for (_, b), (c, _) in pairwise(sorted(found)))
        need(apart, "the intervals of places are not apart")
        return found

    def cycles(self) -> None:
        """Prove that the release map contracts the cycles."""
        y, basins = flights.System(self.p), self.basins()
        for cycle in self.claims.get("cycles", []):
            contract(y, basins, [self.distances(interval) for interval in cycle])
            self.step("the release map takes a cycle of intervals into itself, and contracts it")

    def distances(self, places: Enclosure) -> Distances:
        """Return the distances to the wall ahead of an interval of places."""
        a, b = places[:2]
        need(self.p.l < a < b < self.p.r, "an interval of places is not between the walls")
        low, high = self.length(self.p.r - b), self.length(self.p.r - a)
        return Distances((below(low), above(high)), (above(low), below(high)))

    def region(self) -> tuple[Fraction, Fraction]:
        """Return W and V of the box, in the units of the flow."""
        return self.length(self.R), self.speed(self.claims["box"]["v"].upper)

    def sticks(self, y: System, side: int) -> Iterator[Leaf]:
        """Give the regions of late or early sticks."""
        return leaves(self.hints["stops"][SIDES[side]], all_stops(y))

    def turns(self, y: System) -> Iterator[Leaf]:
        """Give the regions of turns, with their parts."""
        return leaves(self.hints["stops"]["turns"], all_stops(y), parted=True)

    def outlook(self, places: Places) -> Outlook:
        """Return what tells what becomes of turns."""
        forwards = System(self.p, forwards=True), flights.System(self.p)
        return Outlook(*forwards, places, self.basins())

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
        losses = {"e": "1", "mu": "0"}
        fates = [*self.attracted(), *self.to_the_segment()]
        return self.told(
            SYSTEM + _WORDS,
            V=V,
            area=2 * self.R * V,
            part=part,
            fates="".join(f"{fate}; " for fate in fates),
            included=", these included" if fates else "",
            area_0=self.claims["never_stopping_area"].text[1],
            **losses,
        )

    def attracted(self) -> Iterator[str]:
        """Give the part that is attracted, in words, if there is some."""
        part, to = self.claims["shares"]["attractor"], list[str]()
        if "attractor" in self.claims:
            claims = self.claims["attractor"]
            to.append(_CHAOTIC.format(claims["interval"], claims["entropy"]))
        for cycle in self.claims.get("cycles", []):
            to.append(_PERIODIC.format(" and then in ".join(map(str, cycle))))
        for sink in self.claims.get("sinks", []):
            rows = [", ".join(map(decimal, row)) for row in sink["matrix"]]
            to.append(_SINK.format(decimal(sink["x"]), decimal(sink["v"]), *rows))
        if to and part.lower > 0:
            yield f"at least the part {part.text[0]} is attracted to {', or to '.join(to)}"

    def to_the_segment(self) -> Iterator[str]:
        """Give the parts of what goes to the segment, and of either, if there are some."""
        part = self.claims["shares"]
        if "segment" in self.claims and part["segment"].lower > 0:
            yield _TO_THE_SEGMENT.format(part["segment"].text[0])
            if part["attractor"].lower > 0:
                yield f"at least the part {part['either'].text[0]} does one of both"


def above(x: Fraction) -> float:
    """Return a double that is not less."""
    a = float(x)
    return a if Fraction(a) >= x else math.nextafter(a, math.inf)


def below(x: Fraction) -> float:
    """Return a double that is not more."""
    return -above(-x)


# what is done
PLACES = "places are followed to their release"
BACK = "{} sticks are followed back"
TURNS = "turns are followed back and forwards"

_WORDS = (
    "with T = 2 pi/omega and S the symmetry (x, v, t) -> (l + r - x, -v, t + T/2), of the states "
    "(x, v) between the walls with |v| < {V} at t = 0, of area {area}, {fates}at least the part "
    "{part[stops].text[0]} stops at least once{included}; of the part {part[undecided].text[1]} at "
    "most nothing is shown, so the states in the box that never stop have an area of at most "
    "{area_0}"
)
_CHAOTIC = (
    "the orbits released in A, or to their images by S, A the intersection of all G^k(I) for the "
    "release map G (from a release to the right to the next release, mirrored if that is to the "
    "left) on I = {}, of topological entropy in {}"
)
_PERIODIC = (
    "a periodic orbit that sticks and is released again and again in {} (releases to the left "
    "mirrored), or to its image by S; up to S and shifts of the time by multiples of T no other "
    "periodic orbit is released so"
)
_SINK = (
    "a periodic orbit through a state (x, v) at t = 0 with |W (x - {}, v - {})| < 1 in the "
    "Euclidean norm, W = [[{}], [{}]], or to its image by S; up to S and shifts of the time by "
    "multiples of T it is the only periodic orbit through such a state"
)
_TO_THE_SEGMENT = (
    "at least the part {} converges to an orbit of the segment of T-periodic orbits that touch no "
    "wall"
)

THEOREM = Mixed
