"""The theorem from above: polygons around an elliptic point that no state of a kind lies on.

Units F = omega = 1, x measured from the middle between the walls at -a and a.  Let e = 1, mu = 0, 0
< f < F, alpha = f/F.  N is the set of the states at t = 0 from which the velocity never vanishes,
neither forward nor backward in time; (w, v) and (w, -v) at a wall w are one state, before and after
a hit.  So the flow over any time is continuous on N.  G is sigma, half a period and the symmetry
(x, v, t) -> (-x, -v, t + pi), or G = sigma sigma = Phi; it maps N onto N, one to one.

1. *The center*: G has a fixed point P*, and it is in N (``tori.centre``).  Let N_0 be the connected
   component of N that contains P*.  G(N_0) and G^-1(N_0) are connected subsets of N with P*: so
   G(N_0) = N_0.
2. *Rings*: polygons R_1, R_2, ... between the walls, each simple, with P* inside (``tori.rings``).
   It is shown one after the other that N_0 does not meet R_j; as N_0 is connected, it lies inside.
   - R_1: all motions from states on it stop, forward or backward (``tori.segments``).
   - R_(j+1): let z be on it.  Either its motion stops, or G^n(z), for an n with a sign, lies
     outside of R_j, where there is no state of N_0 = G^n(N_0).
3. *Area*: N_0, which is closed in N, lies inside the last ring.  So does every connected set of
   such states that contains P*: each invariant disk around P* from which no motion stops.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.doubles import enclosing
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import Field, Many, Quantity, Word, bound
from cap.checker.kernel.theorem import BITS
from cap.checker.system.lossy import SYSTEM
from cap.checker.system.walls import BetweenWalls
from cap.checker.tori.centre import HINTS as CENTRE
from cap.checker.tori.centre import fixed_point
from cap.checker.tori.half_period import Motion
from cap.checker.tori.rings import Ring, offsets
from cap.checker.tori.segments import Segment, Sense, Vector

MAX_RINGS = 16
MAX_WORK = 4 * 10**6  # half periods of segments
MAX_BITS = 512
FLIGHT = "-?[1-9][0-9]? [1-9][0-9]?"
FLIGHTS = re.compile(f"{FLIGHT}(,{FLIGHT})*")
EDGES = 32  # in a task


class Flight(NamedTuple):
    """How an edge is followed: so many half periods, backward if negative, in so many pieces."""

    steps: int
    pieces: int

    @property
    def work(self) -> int:
        """The half periods of all pieces."""
        return abs(self.steps) * self.pieces


class Edges(NamedTuple):
    """Some edges of a ring, their flights, and what they must be outside of; None: they stop."""

    ends: list[tuple[Vector, Vector]]
    flights: list[Flight]
    outside: Ring | None

    @property
    def work(self) -> int:
        """The half periods of all."""
        return sum(flight.work for flight in self.flights)


class Followed(NamedTuple):
    """Follows edges: from all of their states motions stop, or leave."""

    alpha: Fraction
    a: Fraction
    halves: int

    def edges(self, task: Edges) -> None:
        """Prove it for some edges, or reject."""
        senses = {sign: Sense(self.alpha, self.a, sign) for sign in (1.0, -1.0)}
        for ends, flight in zip(task.ends, task.flights, strict=True):
            sense = senses[1.0 if flight.steps > 0 else -1.0]
            for z in pieces(*ends, flight.pieces, sense.sign):
                self.follow(sense, z, flight, task.outside)

    def follow(self, sense: Sense, z: Segment, flight: Flight, outside: Ring | None) -> None:
        """Prove it for a segment."""
        sense.begin(z)
        for _ in range(abs(flight.steps)):
            z = sense.after(z)
        if outside is not None and flight.steps % self.halves == 0:
            need(outside.excludes(z, sense.sign) or sense.stopped(z), _STAYS)
        else:
            need(sense.stopped(z), "a motion may not stop")


def pieces(first: Vector, second: Vector, count: int, sign: float) -> list[Segment]:
    """Return segments that cover an edge, as states in a sense of time."""
    (x, v), (X, V) = first, second
    ends = [
        ((x + (X - x) * part) * sign, v + (V - v) * part)
        for part in (enclosing(Fraction(k, count)) for k in range(count + 1))
    ]
    return [Segment.between(*both) for both in pairwise(ends)]


class Converse(BetweenWalls):
    """Rings around an elliptic point."""

    # fmt: off
    HINTS = (
        BITS,
        *CENTRE,
        Field("flights", Many(text, 1, MAX_RINGS), "", "", "for each edge of each ring: it is "
              "followed for so many half periods, backward if negative, in so many pieces: steps "
              "pieces, steps pieces, ..."),
    )
    CLAIMS = (
        Field("map", Word(("sigma", "Phi")), "", "", "sigma: half a period and the symmetry; Phi"),
        Field("x", Quantity("R"), "x", "x", "P*"),
        Field("v", Quantity("R omega"), "v", "v", "P*"),
        Field("rings", Many(text, 1, MAX_RINGS), "", "", "polygons around the point middle: "
              "vertices, in units 10^-9 F/omega^2 and 10^-9 F/omega from there: x v, x v, ..."),
        Field("area", bound, "", "", "an upper bound of the area inside the last ring"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        need(hints["bits"] <= MAX_BITS, f"more than {MAX_BITS} bits")
        need(len(hints["flights"]) == len(claims["rings"]), "there are not flights for each ring")
        total = sum(flight.work for words in hints["flights"] for flight in flights(words))
        need(total <= MAX_WORK, f"there are more than {MAX_WORK} half periods")

    def __init__(self, certificate: Any, step: Callable[[str], None]) -> None:
        super().__init__(certificate, step)
        self.halves = 2 if self.claims["map"] == "Phi" else 1
        self.laws = self.p.f / self.p.F, self.R * self.p.omega**2 / self.p.F / 2

    @in_doubles()
    def prove(self) -> None:
        """Prove the theorem."""
        need(self.p.f > 0, "0 < f does not hold")
        self.centre()
        rings = self.rings()
        tasks = self.tasks(rings)
        sizes = {_FOLLOWED.format(n): float(_work(each)) for n, each in tasks.items()}
        work, follow = Work(self.jobs, self.tell, sizes), Followed(*self.laws, self.halves).edges
        for n, each in tasks.items():
            work(follow, each, _FOLLOWED.format(n), lambda task: task.work)
            self.step(f"ring {n}: {_HOW[n > 1]} ({sum(len(t.ends) for t in each)} edges)")
        self.area(rings[-1])

    def centre(self) -> None:
        """Prove that there is a fixed point in a rectangle, and compare it."""
        found = fixed_point(Motion(*self.laws, self.hints["bits"]), self.halves, self.hints)
        length, speed = (self.number(self.p.F / self.p.omega**k) for k in (2, 1))
        base = self.number((self.p.l + self.p.r) / 2)
        self.confirm(x=base + found.x * length, v=found.v * speed)
        self.step("P* is a fixed point, at the place claimed")

    def rings(self) -> list[Ring]:
        """Return the rings; P* is inside of each."""
        middle, radius = self.hints["middle"], self.hints["radius"]
        rings = [Ring((middle[0], middle[1]), offsets(words)) for words in self.claims["rings"]]
        need(all(ring.surrounds(radius) for ring in rings), "P* may not be inside of a ring")
        self.step(f"P* is inside of {len(rings)} rings")
        return rings

    def tasks(self, rings: list[Ring]) -> dict[int, list[Edges]]:
        """Return what is to be proved of each ring, some edges at a time."""
        found = dict[int, list[Edges]]()
        before: Ring | None = None
        for n, (ring, words) in enumerate(zip(rings, self.hints["flights"], strict=True), 1):
            edges, how = ring.edges(), flights(words)
            need(len(edges) == len(how), "there is not one flight for each edge")
            cuts = range(0, len(edges), EDGES)
            found[n] = [Edges(edges[k : k + EDGES], how[k : k + EDGES], before) for k in cuts]
            before = ring
        return found

    def area(self, last: Ring) -> None:
        """Compare the area inside the last ring with what is claimed."""
        size = last.area * self.p.F**2 / self.p.omega**3
        need(size <= self.claims["area"], "the area inside the last ring is larger")
        self.step("the area inside the last ring is at most the one claimed")

    def words(self) -> str:
        """Return the theorem in one line."""
        every = _PHI if self.claims["map"] == "Phi" else _SIGMA
        return self.told(SYSTEM + _INSIDE, every=every, area=decimal(self.claims["area"]))


def _work(tasks: list[Edges]) -> int:
    return sum(task.work for task in tasks)


def flights(words: str) -> list[Flight]:
    """Return how the edges of a ring are followed."""
    need(FLIGHTS.fullmatch(words) is not None, "the flights of a ring are no list of them")
    return [Flight(*map(int, part.split(" "))) for part in words.split(",")]


_STAYS = "a motion may neither stop nor leave the ring before"
_FOLLOWED = "ring {}: its edges are followed"
_HOW = ("all motions from it stop", "all motions from it stop, or leave the ring before")
_PHI = "the map Phi over a period 2 pi/omega from t = 0"
_SIGMA = (
    "the map sigma over half a period pi/omega from t = 0, followed by (x, v) -> (l + r - x, -v)"
)
_INSIDE = (
    "{every} has a fixed point P*, x in {x}, v in {v}, whose motion never stops; every connected "
    "set of states at t = 0 that contains P*, and from which the velocity never vanishes, forward "
    "or backward in time, lies inside the last polygon of the certificate, and so in an open set "
    "of area at most {area}: no invariant disk around P* from which no motion stops is larger"
)

THEOREM = Converse
