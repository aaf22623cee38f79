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
all its orbits are in the basin of a segment before.

*Leaves.*  The box is divided into rectangles, which share their edges.  Each is followed until its
orbits are released (``cap.checker.folded``): where it is undecided what happens next, a rectangle
is cut, or both possibilities are followed.  The place of the release is a quadratic polynomial of
(x, v) and an error; the rectangle is halved a number of times, and each part on which all places
have one fate is counted.  What is not counted is undecided.  So the shares are sums of dyadic
numbers.  The edges are sets of area zero.
"""

from __future__ import annotations

import math
import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from fractions import Fraction
from functools import partial
from typing import Any

from cap.checker.folded.fates import Judge, Strip
from cap.checker.folded.masses import Places
from cap.checker.folded.numbers import Pair
from cap.checker.folded.places import Leaf, shares
from cap.checker.folded.portions import roof
from cap.checker.folded.tree import LETTERS, followed, known, nodes
from cap.checker.kernel import quadratic as q
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Letters, Table, Whole, enclosure, region
from cap.checker.kernel.theorem import BITS, SYSTEM, WITHOUT_LOSSES, Certificate, Theorem
from cap.checker.theorems.attractor import Attractor
from cap.checker.theorems.segment import Segment

NOT = "-"  # a leaf that is not followed
_CUTS, _MOST_CUTS = "0123456789", 9
_MOST_LEAVES = 1 << 14
_MOST_FOLLOWED, _MOST_JUDGED = 1 << 20, 1 << 23  # pieces of leaves

Counts = tuple[int, int, int]
Work = Callable[..., Sequence[Any]]  # a map over tasks


def shapes(table: Table) -> dict[str, Any]:
    """Return the shape of the values of a table."""
    return {field.name: field.shape for field in table}


class Mixed(Theorem):
    """The shares of the states that tend to the attractor, to the segment, or stop."""

    PARAMETERS = WITHOUT_LOSSES
    # fmt: off
    HINTS = (
        BITS,
        Field("attractor", shapes(Attractor.HINTS), "", "", "as for the theorem attractor"),
        Field("places", {"level": Whole(6, 18), "tree": Letters(LETTERS, 1 << 18)}, "", "",
              "measures of places are counted in 2^level cells; the tree of places that are "
              "followed: 2 for a node that is halved, then its halves; 1 followed; 0 not"),
        Field("columns", Whole(1, 1024), "", "", "of leaves in the box"),
        Field("rows", Whole(2, 1024), "", "", "of leaves in the box, an even number"),
        Field("depth", Whole(0, 6), "", "", "a leaf is halved so many times more than it is cut, "
              "when it is judged"),
        Field("leaves", Letters(NOT + _CUTS, _MOST_LEAVES), "", "", "row by row from the lower "
              "left: how often a leaf is cut while its orbits are followed; - for not followed"),
    )
    CLAIMS = (
        Field("box", {"x": region, "v": region}, "", "", "all x between the walls, |v| up to V"),
        Field("shares", {"attractor": enclosure, "segment": enclosure, "stops": enclosure,
                         "undecided": enclosure}, "share", "s",
              "parts of the area of the box: of the states that tend to the orbits released in A, "
              "that converge to an orbit of the segment, that stop at least once, and of those of "
              "which nothing is shown"),
        Field("never_stopping_area", enclosure, "area that never stops", "A_0",
              "of the states in the box whose velocity never vanishes"),
        Field("attractor", shapes(Attractor.CLAIMS), "", "", "as for the theorem attractor"),
        Field("segment", shapes(Segment.CLAIMS), "", "", "as for the theorem segment"),
    )
    CITES = Attractor.CITES
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: the pieces into which places and leaves may be cut."""
        Attractor.limit(hints["attractor"], claims["attractor"])
        leaves = hints["leaves"]
        cells = int(hints["columns"]) * int(hints["rows"])
        need(len(leaves) == cells, "there are not as many leaves as columns times rows")
        cuts = sum(1 << int(cuts) for cuts in leaves if cuts != NOT)
        need(cuts << hints["depth"] <= _MOST_JUDGED, "there are too many pieces to judge")
        need(cuts <= _MOST_FOLLOWED, "there are too many pieces to follow")
        nodes(hints["places"]["tree"])

    def prove(self) -> None:
        """Prove the theorem."""
        self.box()
        for theorem in (Attractor, Segment):
            self.lemma(theorem)
        with self.workers() as work:
            judge = self.judge(work)
            self.step("the fates of releases are known, by intervals of places")
            counts = work(partial(shares, self.p, judge), self.leaves())
        self.sums(self.parts(counts, self.hints["leaves"]))
        self.step("the shares follow from the leaves of the box")

    def parts(self, counts: Sequence[Counts], leaves: str) -> tuple[Fraction, ...]:
        """Return the parts of the area that are attracted, go to the segment, or only stop."""
        cuts = [int(letter) for letter in leaves if letter != NOT]
        whole = len(leaves) << (_MOST_CUTS + self.hints["depth"])
        scaled = [[n << (_MOST_CUTS - k) for n in c] for c, k in zip(counts, cuts, strict=True)]
        return tuple(Fraction(sum(c[n] for c in scaled), whole) for n in range(3))

    def lemma(self, theorem: type[Theorem]) -> None:
        """Prove the theorem on which this one stands."""
        name = theorem.__name__.lower()
        hints = self.hints.get(name, self.hints)
        part = Certificate(name, self.p, self.certificate.digits, self.claims[name], hints)
        theorem(part, self.step).prove()

    @contextmanager
    def workers(self) -> Iterator[Work]:
        """Give a map in so many processes."""
        if self.jobs < 2:
            yield lambda f, tasks: [f(task) for task in tasks]
            return
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(self.jobs, context) as pool:
            yield lambda f, tasks: list(pool.map(f, tasks, chunksize=8))

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
        need(self.hints["rows"] % 2 == 0, "a row has both signs of v")

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
            q.rounded(self.length(self.p.r)),
        )

    def judge(self, work: Work) -> Judge:
        """Return what tells fates: the strip, and the table of all distances to the wall ahead."""
        return Judge(self.strip(), self.places(work).table)

    def places(self, work: Work) -> Places:
        """Return what is known of all distances to the wall ahead."""
        hints, width = self.hints["places"], self.width()
        step = partial(followed, self.p, self.strip(), width)
        return known(self.kept(), width, hints["level"], work(step, nodes(hints["tree"])))

    def width(self) -> float:
        """Return the largest distance to the wall ahead, or a little more."""
        return roof(self.length(self.R))

    def kept(self) -> Pair:
        """Return the distances to the wall ahead of I."""
        a, b = self.claims["attractor"]["interval"][:2]
        return above(self.length(self.p.r - b)), below(self.length(self.p.r - a))

    def leaves(self) -> Iterator[Leaf]:
        """Give the leaves that are followed."""
        V, columns, rows = self.claims["box"]["v"].upper, self.hints["columns"], self.hints["rows"]
        x = [float(self.length(self.R) * k / columns) for k in range(columns + 1)]
        v = [float(self.speed(V) * (2 * k - rows) / rows) for k in range(rows + 1)]
        for n, cuts in enumerate(self.hints["leaves"]):
            j, i = divmod(n, columns)
            if cuts != NOT:
                leaf = Leaf((x[i], x[i + 1]), (v[j], v[j + 1]))
                yield leaf.cut(int(cuts), self.hints["depth"])

    def sums(self, parts: Sequence[Fraction]) -> None:
        """Compare the claims with the sums over all leaves."""
        a, s, stops = parts
        known, one = a + s + stops, Fraction(1)
        found = {"attractor": (a, one - s), "segment": (s, one - a)}
        found |= {"stops": (known, one), "undecided": (Fraction(0), one - known)}
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
    "no wall; at least the part {part[stops].text[0]} stops at least once, these included; of the "
    "part {part[undecided].text[1]} at most nothing is shown, so the states in the box that never "
    "stop have an area of at most {area_0}"
)

THEOREM = Mixed
