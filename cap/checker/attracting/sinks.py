"""Sinks that turn: ellipses of states at the time 0 that the flow contracts.

Let Q be the states z = (p, s) at the time 0, or pi folded, with |W (z - c)| <= 1 in the Euclidean
norm, and P z the state of the orbit of z after n half periods, folded.  Q is cut into parts, which
are followed with their derivatives (`cap.checker.folded.slopes`): the events are hits with s > 0
and transversal turns, no two at the same time, so P is continuously differentiable around each
state of Q.  Let |W DP W^-1| <= k on Q, and |W (P c - c)| < 1 - k.  As Q is convex, P contracts it
in the norm |W z|, and takes it into its inside.  So P has exactly one fixed point in Q, and P^m z
tends to it for each z in Q.  The orbits from Q converge to the one from there, which is periodic,
or to its image by the symmetry, up to shifts of the time by multiples of T.

That orbit hits a wall: else, as its state is inside Q, it could be moved a little, and would be
another periodic orbit from Q.  Parts may have different events: where they meet, P is the same.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.attracting.part import Part as Claimed
from cap.checker.folded.ahead import sticking
from cap.checker.folded.basins import Basins, Bounds, Row, bounds_of, rounded
from cap.checker.folded.events import after, event
from cap.checker.folded.flights import Flight
from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import TURN, UP, Pair, times
from cap.checker.folded.slopes import Slopes
from cap.checker.folded.slopes import after as slopes_after
from cap.checker.folded.units import Units
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.polynomials import Model
from cap.checker.kernel.reading import MAX_SIZE, number
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Many, Whole

MOST_SINKS, MOST_HALVES = 16, 64
_MOST_SIZE = MAX_SIZE**3  # of lengths and speeds, products of parameters

_EVENTS = 256
_DEEPEST, _MOST = 5, 300  # quarterings of a square, and parts that are followed
_EXACT = (1.0, 0.0, 0.0, 1.0)  # how errors of (A, B) are carried, at first

Vector = tuple[Fraction, Fraction]


class Sinks(Claimed):
    """Ellipses of states."""

    CLAIM = Many(
        {"x": number, "v": number, "matrix": [[number] * 2] * 2, "halves": Whole(1, MOST_HALVES)},
        1,
        MOST_SINKS,
    )

    @classmethod
    def limit(cls, hints: dict[str, Any], claim: Any) -> None:  # noqa: ARG003
        """Bound the sizes of numbers."""
        for sink in claim:
            sizes = map(abs, (sink["x"], sink["v"], *sink["matrix"][0], *sink["matrix"][1]))
            need(max(sizes) <= _MOST_SIZE, "a number of a sink is larger than 10^90")

    def prove(self, known: Basins) -> None:  # noqa: ARG002
        """Prove that the flow contracts the ellipses."""
        y = Direction(self.theorem.p, forwards=True)
        for claim in self.claim:
            sink(self.scale, claim).contract(y)
            self.theorem.step("the flow takes an ellipse of states into itself, and contracts it")

    def basins(self) -> Basins:
        """Return the ellipses."""
        sinks = [sink(self.scale, claim) for claim in self.claim]
        even, odd = (tuple(z.ellipse() for z in sinks if z.odd is side) for side in (False, True))
        return Basins((), even, odd)

    def words(self) -> Iterator[str]:
        """Give the periodic orbits."""
        for claim in self.claim:
            rows = [", ".join(map(decimal, row)) for row in claim["matrix"]]
            yield _SINK.format(decimal(claim["x"]), decimal(claim["v"]), *rows)


def sink(units: Units, claim: dict[str, Any]) -> Sink:
    """Return a sink, of which nothing is proved yet: p = x - r, or l - x mirrored, at pi."""
    x, v = units.length(Fraction(1)), units.speed(Fraction(1))
    first, second = ((a / x, b / v) for a, b in claim["matrix"])
    left = claim["v"] < 0
    place = units.p.l - claim["x"] if left else claim["x"] - units.p.r
    centre = units.length(place), units.speed(abs(claim["v"]))
    return Sink(centre, (first, second), claim["halves"], left)


class Ellipse(NamedTuple):
    """The states with |u| < 1, u_k how far a p + b s is from the middle of a row: to a sink.

    That is low + 1 = high - 1, low and high rounded to the safe side.
    """

    rows: tuple[Row, Row]

    def contains(self, bounds: Bounds) -> bool:
        """Return whether some states are in it."""
        return self.radius(bounds) < 1

    def radius(self, bounds: Bounds) -> float:
        """Return a bound of |u| for some states."""
        return math.hypot(*(distance(row, bounds) for row in self.rows)) * UP


class Part(NamedTuple):
    """The part i, j of [-1, 1]^2 cut into 2^n x 2^n."""

    i: int = 0
    j: int = 0
    n: int = 0

    def quarters(self) -> list[Part]:
        """Return the quarters."""
        need(self.n < _DEEPEST, "a sink is cut too often")
        both = (0, 1)
        return [Part(2 * self.i + i, 2 * self.j + j, self.n + 1) for i in both for j in both]

    def middle(self) -> tuple[Fraction, Fraction]:
        """Return the middle; half a side is 2^-n."""
        i, j = (Fraction(2 * k + 1, 2**self.n) - 1 for k in (self.i, self.j))
        return i, j

    def outside(self) -> bool:
        """Return whether it does not meet the disc of the radius 1."""
        near = (max(Fraction(0), abs(z) - Fraction(1, 2**self.n)) for z in self.middle())
        return sum(z * z for z in near) > 1


class Image(NamedTuple):
    """States and their derivatives along two sides, in the flight in which they are at a time."""

    flight: Flight
    slopes: tuple[Slopes, ...]
    time: Pair


class Sink(NamedTuple):
    """The ellipse of states (p, s) with this centre and these rows of W, at 0 or at pi."""

    centre: Vector
    W: tuple[Vector, Vector]
    halves: int
    odd: bool

    def ellipse(self) -> Ellipse:
        """Return the inside."""
        first, second = map(self.row, self.W)
        return Ellipse((first, second))

    def row(self, w: Vector) -> Row:
        """Return a row of W, with bounds 1 from its value at the centre."""
        c = w[0] * self.centre[0] + w[1] * self.centre[1]
        more = (abs(c) + 1) * Fraction(TURN)
        return Row(float(w[0]), float(w[1]), float(c - 1 + more), float(c + 1 - more))

    def sides(self) -> list[Vector]:
        """Return the columns of the inverse of W."""
        (a, b), (c, d) = self.W
        det = a * d - b * c
        need(det != 0, "the matrix of a sink is singular")
        return [(d / det, -c / det), (-b / det, a / det)]

    def contract(self, y: Direction) -> None:
        """Prove that the flow takes the ellipse into itself, and contracts it."""
        most = 1 - self.shift(y) - TURN
        todo, followed = [Part()], 0
        while todo:
            part, followed = todo.pop(), followed + 1
            need(followed <= _MOST, "a sink is cut into too many parts")
            if part.outside():
                continue
            try:
                need(self.factor(y, part) < most, "orbits may leave their sink")
            except Rejected:
                todo += part.quarters()

    def factor(self, y: Direction, part: Part) -> float:
        """Return a bound of |W DP W^-1| over a part."""
        f, slopes, (t, error) = self.image(y, part, Fraction(1, 2**part.n))
        d = q.moved(q.model(error, one=t), -f.ref, 0.0)
        sides = [bounds_of(q, q.total(q.product(d, g.A), g.B), g.A) for g in slopes]
        rows = [(rounded(row.a), rounded(row.b)) for row in self.ellipse().rows]
        return norm([[middle(side(*row)) for side in sides] for row in rows])

    def shift(self, y: Direction) -> float:
        """Return a bound of |W (P c - c)|."""
        f, _, (t, error) = self.image(y, Part(), Fraction(0))
        return self.ellipse().radius(bounds_of(q, *y.states(f, t, error)))

    def image(self, y: Direction, part: Part, size: Fraction) -> Image:
        """Return what is so far from the middle of a part after so many half periods."""
        sides = self.sides()
        f = launched(y, self.odd, *self.states(part.middle(), size, sides))
        slopes = tuple(Slopes(known(ds), known(dp)) for dp, ds in sides)
        for _ in range(_EVENTS):
            k, e = self.odd + self.halves - f.passed, event(y, f)
            t, error = y.multiple(k)
            if t + error < e.ends[0]:
                need(f.begun[1] < t - error and k % 2 == self.odd, "which orbits are in their sink")
                return Image(f, slopes, (t, error))
            if e.p is not None:
                sticks = sticking(y, e, q.ends(q.widened(e.cos, e.e_all)))
                need(not any(sticks), "the orbits from a sink may stick")
            slopes = tuple(slopes_after(y, g, e) for g in slopes)
            f = after(y, f, e)
        raise Rejected("there are too many events")

    def states(self, at: Vector, size: Fraction, sides: Sequence[Vector]) -> Iterator[Model]:
        """Give p and s within a distance of a place in [-1, 1]^2, in each direction."""
        for c, x, y in zip(self.centre, *sides, strict=True):
            one, X, Y = map(float, (c + at[0] * x + at[1] * y, size * x, size * y))
            yield q.model((abs(one) + abs(X) + abs(Y)) * TURN, one=one, X=X, Y=Y)


def launched(y: Direction, odd: bool, p: Model, s: Model) -> Flight:
    """Return the flight of states at 0 or pi: A = s - sin t, B = p + cos t, t = ref."""
    need(q.ends(p)[1] < 0 < q.ends(s)[0], "the states of a sink do not move to the wall ahead")
    need(-y.width[0] + y.width[1] < q.ends(p)[0], "a sink reaches behind a wall")
    t, error = y.multiple(int(odd))
    A, B = q.widened(s, 2 * error), q.moved(p, -1.0 if t else 1.0, error)
    errors = A[q.LAST], B[q.LAST]
    begun = t - 2 * error, t + 2 * error
    return Flight(begun, t, q.exact(A), q.exact(B), _EXACT, errors, errors, 1, 0)


def known(x: Fraction) -> Model:
    """Return the model of a number."""
    return q.model(abs(float(x)) * TURN, one=float(x))


def distance(row: Row, bounds: Bounds) -> float:
    """Return a bound of the distance from the middle of a row that is 2 wide."""
    low, high = bounds(rounded(row.a), rounded(row.b))
    return (1 + max(row.low - low, high - row.high)) * UP + TURN


def middle(ends: Pair) -> Pair:
    """Return the middle and the radius of an interval."""
    m = (ends[0] + ends[1]) / 2
    return m, max(ends[1] - m, m - ends[0]) * UP + abs(m) * TURN


def norm(rows: Sequence[Sequence[Pair]]) -> float:
    """Return a bound of the Euclidean norm of a matrix N.

    That is the root of the largest eigenvalue of N^T N, which is not less for larger entries.
    """
    (a, b), (c, d) = rows
    first, second, both = inner((a, c), (a, c)), inner((b, d), (b, d)), inner((a, c), (b, d))
    return math.sqrt((first + second) / 2 + math.hypot((first - second) / 2, both)) * UP


def inner(u: Sequence[Pair], v: Sequence[Pair]) -> float:
    """Return a bound of the size of an inner product."""
    (x, e), (z, f) = (times(a, b) for a, b in zip(u, v, strict=True))
    return (abs(x + z) + e + f + (abs(x) + abs(z)) * TURN) * UP


_SINK = (
    "a periodic orbit through a state (x, v) at t = 0 with |W (x - {}, v - {})| < 1 in the "
    "Euclidean norm, W = [[{}], [{}]], or to its image by S; up to S and shifts of the time by "
    "multiples of T it is the only periodic orbit through such a state"
)

PART = Sinks
