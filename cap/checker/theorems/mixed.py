"""The theorem about the mixed dynamics: which share of the states goes where.

*Three fates* of the orbits from the states (x, v) with l < x < r, |v| < V at t = 0, in a system
without losses but friction:

    attractor   the orbit, or its image by (x, v, t) -> (l + r - x, -v, t + T/2), comes to be
                released in I (`cap.checker.attracting.attractor`): it tends to the orbits released
                in A, the intersection of all G^k(I); or it comes to be released in a cycle of
                intervals that attracts (`cap.checker.attracting.cycles`), or comes to the ellipse
                of a sink (`cap.checker.attracting.sinks`) at a multiple of T: it tends to a
                periodic orbit
    segment     it converges to a T-periodic orbit that touches no wall
                (`cap.checker.attracting.segment`)
    stops       its velocity vanishes at least once

The first two exclude each other, since an orbit of the first kind sticks or, as that of a sink hits
a wall, hits again and again, and one of the second does neither in the end.  Not all of I, cycles,
sinks and the segment need be claimed: what nothing is claimed of has no fate, and the file that is
about it is not loaded.

*Places.*  After a stick the state is known but for the place of the release; folded by the symmetry
(x, v, t) -> (l + r - x, -v, t + T/2), it is the distance to the wall ahead.  Places are divided by
a tree of halvings; parts of them are followed to their next release, as functions of one variable
with a derivative.  A part has a fate if all its next releases are in an interval of that fate, or
all its orbits are in the basin of the segment or in a sink before; of other parts the measure is
bounded that has not the fate (`cap.checker.folded.masses`).

*Stops.*  A state that stops is what becomes of its first stop backwards in time, after so many half
periods (`cap.checker.folded.stops`).  First stops, by place and time, are cut into regions, which
are followed back, as long as nothing stops; so the areas at t = 0 are those of the stops, counted
as often as half periods pass.  No state is counted twice: by its orbit it determines its first stop
and the number of half periods until then; regions do not overlap; and for each of them a number is
counted once at most, as the numbers increase from flight to flight.

*Fates.*  At some stops the mass sticks: they have the fate of the place.  At the others it turns:
parts of the regions are followed forwards, until they stick, or are in the basin of the segment or
in a sink; it is bounded how much of them has not the fate (`cap.checker.folded.ahead`).  What is
not counted is undecided.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import chain, pairwise
from typing import Any, ClassVar

from cap.checker import attracting
from cap.checker.folded.ahead import Outlook
from cap.checker.folded.areas import Areas, of_sticks, of_turns
from cap.checker.folded.basins import Basins
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import Direction, Releases
from cap.checker.folded.numbers import Pair
from cap.checker.folded.regions import USUAL, Leaf, leaves
from cap.checker.folded.regions import flights as cost
from cap.checker.folded.stops import EARLY, LATE, all_stops
from cap.checker.folded.tree import LETTERS, followed, nodes
from cap.checker.folded.units import Units, below
from cap.checker.kernel.citation import Citation
from cap.checker.kernel.later import Later
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import MAX_SIZE, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import Field, Whole, enclosure, region
from cap.checker.kernel.theorem import BITS, Certificate
from cap.checker.system.lossy import SYSTEM
from cap.checker.system.walls import BetweenWalls, Parameters

MOST_FLIGHTS = 1 << 25
_MOST_SIZE = MAX_SIZE**3  # of speeds, products of parameters
SIDES = {LATE: "late", EARLY: "early"}
_PLACE = 15  # flights take as long as a place that is followed

Map = Callable[..., Sequence[Any]]
"""Does tasks, by function, tasks, the words for it, and the weight of a task."""


def claimed(name: str) -> Maybe:
    """Return the shape of what may be claimed to attract."""
    return Maybe(Later(lambda: attracting.load(name).CLAIM))


class Mixed(BetweenWalls):
    """The shares of the states that tend to the attractor, to the segment, or stop."""

    p: Parameters
    PARTS: ClassVar[dict[str, str]] = {
        name: f"{attracting.__name__}.{name}" for name in attracting.NAMES
    }
    # fmt: off
    HINTS = (
        BITS,
        Field("attractor", Maybe(Later(lambda: attracting.load("attractor").HINTS)), "", "",
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
        Field("attractor", claimed("attractor"), "", "", "as for the theorem attractor"),
        Field("cycles", claimed("cycles"), "", "",
              "intervals of places, each of which G, the next place of release, mirrored if that "
              "is to the left, takes into the next one of its cycle, the last one into the first; "
              "around the cycle it is a contraction"),
        Field("sinks", claimed("sinks"), "", "",
              "ellipses of states z at t = 0, |matrix (z - (x, v))| <= 1 in the Euclidean norm, "
              "that the flow over so many halves of T, mirrored if they are odd, takes into "
              "themselves, and contracts in this norm"),
        Field("segment", claimed("segment"), "", "", "as for the theorem segment"),
    )
    # fmt: on

    @classmethod
    def cited(cls, claims: Container[str]) -> list[Citation]:
        """Return what is cited of what attracts."""
        kinds = map(attracting.load, filter(claims.__contains__, attracting.NAMES))
        return [citation for kind in kinds for citation in kind.CITES]

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound sizes, and the time: the pieces of places, and the flights backwards."""
        V = claims["box"]["v"].upper
        need(V <= _MOST_SIZE and V * _MOST_SIZE >= 1, "V is not between 10^-90 and 10^90")
        need(("attractor" in hints) is ("attractor" in claims), "an attractor without its hints")
        for name in filter(claims.__contains__, attracting.NAMES):
            attracting.load(name).limit(hints, claims[name])
        trees = hints["stops"]
        total = sum(cost(trees[name], parted=name == "turns") for name in trees)
        need(total <= MOST_FLIGHTS, "there are too many flights")
        nodes(hints["places"]["tree"])

    def __init__(self, certificate: Certificate, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        self.scale = Units(self.p)
        self.attract = {
            name: attracting.load(name)(self, self.claims[name])
            for name in attracting.NAMES
            if name in self.claims
        }

    @in_doubles()
    def prove(self) -> None:
        """Prove the theorem."""
        self.box()
        self.tell("what attracts", 0.0)
        known = self.basins()
        for part in self.attract.values():
            part.prove(known)
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
        y, V = Direction(self.p), below(self.region()[1])
        for side, name in SIDES.items():
            areas = partial(of_sticks, y, places, V, side)
            yield from work(areas, self.leaves(y, name), BACK.format(name), Leaf.work)
        self.step("the states are counted that stick at their first stop")
        areas = partial(of_turns, y, self.outlook(places), V)
        yield from work(areas, self.leaves(y, "turns"), TURNS, Leaf.work)
        self.step("the states are counted that turn at their first stop")

    def parts(self, counted: Iterable[Areas]) -> tuple[Fraction, ...]:
        """Return the parts of the area for the fates, for either of them, and of all that stops."""
        W, V = self.region()
        sums = (
            sum(map(Fraction, found), Fraction()) for found in zip(Areas(), *counted, strict=True)
        )
        return tuple(area / (2 * W * V) for area in sums)

    def box(self) -> None:
        """Check that the box is all between the walls, and as fast to the left as to the right."""
        x, v = self.claims["box"]["x"], self.claims["box"]["v"]
        need((x.lower, x.upper) == (self.p.l, self.p.r), "the box is not from wall to wall")
        need(v.upper > 0 and v.lower == -v.upper, "the box is not from -V to V")

    def basins(self) -> Basins:
        """Return what is claimed of the basins of the segment and of the sinks."""
        found = [part.basins() for part in self.attract.values()]
        return Basins(*(tuple(chain(*each)) for each in zip(Basins(), *found, strict=True)))

    def places(self, work: Map) -> Places:
        """Return what is known of all distances to the wall ahead."""
        hints, width = self.hints["places"], self.scale.width()
        step = partial(followed, Releases(self.p), self.basins(), width)
        parts = work(step, nodes(hints["tree"]), PLACES, lambda _node: _PLACE)
        pieces = [piece for found in parts for piece in found]
        return Places(self.kept(), width, hints["level"], pieces)

    def kept(self) -> list[Pair]:
        """Return the distances to the wall ahead of I, and of the cycles."""
        intervals = chain(*(part.kept() for part in self.attract.values()))
        found = [self.scale.distances(each).inner for each in intervals]
        need(all(a < b for a, b in found), "an interval of places is too short")
        apart = all(b < c for (_, b), (c, _) in pairwise(sorted(found)))
        need(apart, "the intervals of places are not apart")
        return found

    def region(self) -> tuple[Fraction, Fraction]:
        """Return W and V of the box, in the units of the flow."""
        return self.scale.length(self.R), self.scale.speed(self.claims["box"]["v"].upper)

    def leaves(self, y: Direction, name: str) -> Iterator[Leaf]:
        """Give the regions of stops of a kind; of turns with their parts."""
        return leaves(self.hints["stops"][name], all_stops(y), parted=name == "turns")

    def outlook(self, places: Places) -> Outlook:
        """Return what tells what becomes of turns."""
        return Outlook(Direction(self.p, forwards=True), places, self.basins())

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
        fates = [*self.attracted(), *self.to_the_segment()]
        return self.told(
            SYSTEM + _WORDS,
            V=V,
            area=2 * self.R * V,
            part=part,
            fates="".join(f"{fate}; " for fate in fates),
            included=", these included" if fates else "",
            area_0=self.claims["never_stopping_area"].text[1],
        )

    def attracted(self) -> Iterator[str]:
        """Give the part that is attracted, in words, if there is some."""
        part = self.claims["shares"]["attractor"]
        to = list(chain(*(each.words() for each in self.attract.values())))
        if to and part.lower > 0:
            yield f"at least the part {part.text[0]} is attracted to {', or to '.join(to)}"

    def to_the_segment(self) -> Iterator[str]:
        """Give the parts of what goes to the segment, and of either, if there are some."""
        part = self.claims["shares"]
        if "segment" in self.claims and part["segment"].lower > 0:
            yield _TO_THE_SEGMENT.format(part["segment"].text[0])
            if part["attractor"].lower > 0:
                yield f"at least the part {part['either'].text[0]} does one of both"


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
_TO_THE_SEGMENT = (
    "at least the part {} converges to an orbit of the segment of T-periodic orbits that touch no "
    "wall"
)

THEOREM = Mixed
