"""The theorem about the share of a rectangle of states from which a system comes to rest in time.

The parameters are the system; the guard h names the mode of rest R (``given``).

1. *The wall.*  What ``capture`` proves of h, h' = L h, hits and R.  Besides, D has no other guard,
   a hit leads to D, the state has two variables, h depends on one of them, h' on the other.
   P = -L h' = m + c cos wt + d sin wt depends on the clock alone, an identity, and each guard of R,
   where h = h' = 0, is P times a positive number.
2. *Cells.*  The rectangle is cut in cells, halves of halves.  From all states of some of them
   infinitely many hits accumulate before T, from all of others h > 0 at T after finitely many
   (``fates``).  Where hits accumulate P > 0, so all guards of R are positive: it is in R.
3. *Shares.*  h and h' are affine in one variable each, so cells are boxes of (h, h'), and their
   shares of the area are powers of 1/2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, ClassVar, NamedTuple

from cap.checker.kernel.angles import of
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import MAX_SIZE, number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import Field, Table, region
from cap.checker.kernel.theorem import BITS
from cap.checker.resting.fates import FLIES, RESTS, UNKNOWN, Fates
from cap.checker.resting.pull import Pull, Wave
from cap.checker.system.capture import NONE, Modes, Numbers, Wall
from cap.checker.system.given import STATES, told
from cap.checker.system.model import COS, PI, SIN
from cap.checker.system.own import OwnSystem
from cap.checker.system.polynomial import Polynomial

MOST_BITS, LONGEST = 1024, 500  # LONGEST: omega (T - t_0), at most
TREE, DEPTH = 1_000_000, 48
WORK = 10_000_000  # cells times steps of the grid of times
A_SECOND = 1000  # cells, about
AT_ONCE = 100  # cells of one task
FOLLOWED = "{} cells are followed"

Place = tuple[float, float, float, float]


class Side(NamedTuple):
    """A coordinate, h or h': ``base`` + x ``span``, x in [0, 1] on the rectangle."""

    base: Double
    span: Double

    def ends(self, a: float, b: float) -> tuple[float, float]:
        """Return bounds of it for x in [a, b]."""
        one, other = self.base + self.span * a, self.base + self.span * b
        return min(one.lower, other.lower), max(one.upper, other.upper)


class Rectangle(NamedTuple):
    """The sides h and h', and what becomes of cells."""

    height: Side
    rate: Side
    fates: Fates

    def confirm(self, cells: list[tuple[str, Place]]) -> None:
        """Prove that the cells have these fates."""
        for letter, (a, b, c, d) in cells:
            h = self.height.ends(a, b)
            need(h[0] >= 0, "h may be negative in a cell")
            found = self.fates.of(h, self.rate.ends(c, d))
            need(found == letter, f"a cell is not seen to {_VERBS[letter]}")


class ContactBasin(OwnSystem):
    """So much of a rectangle of states rests before a time, and so much does not."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("tree", text, "", "", "how the rectangle is cut, in order: 0 halves a part across "
              "the side of h, 1 across that of h'; r is a cell whose motions rest, f one whose "
              "motions fly, - a part of which nothing is claimed"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("start", number, "", "t_0", "the time at which the motions are in the rectangle"),
        Field("until", number, "", "T", "the time until which they are followed"),
        Field("mode", name, "", "", "the mode in which they are"),
        Field("guard", name, "", "h", "its guard, which they hit"),
        Field("restitution", number, "", "e", "a hit makes h' to -e h', 0 < e <= 1"),
        Field("box", Named(region, STATES), "", "", "the rectangle of states"),
        Field("resting", number, "", "", "at least this share of its area comes "
              "to rest before T, after infinitely many hits"),
        Field("flying", number, "", "", "at least this share is in the mode, with "
              "h > 0, at T, after finitely many hits"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the work."""
        tree = hints["tree"]
        need(hints["bits"] <= MOST_BITS, f"more than {MOST_BITS} bits")
        need(len(tree) <= TREE, f"hints.tree is longer than {TREE} letters")
        need(claims["start"] < claims["until"], "claims.until is not after claims.start")
        ends = [x for side in claims["box"].values() for x in side[:2]]
        moderate = max(map(abs, [*ends, claims["start"], claims["until"]])) <= MAX_SIZE
        need(moderate, "a number of the claims is larger than 10^30")

    def seconds(self) -> int:
        """Return about how long the cells take."""
        tree = self.hints["tree"]
        return int(tree.count(RESTS) + tree.count(FLIES)) // (A_SECOND * self.jobs)

    @in_doubles()
    def prove(self) -> None:
        """Prove the theorem."""
        claims, hints = self.claims, self.hints
        e = claims["restitution"]
        need(0 < e <= 1, "0 < e <= 1 does not hold")
        self.wall = Wall(self.p, Modes(claims["mode"], claims["guard"], claims["mode"]), e)
        pull = self.pull()
        self.step("a hit makes h' to -e h', and nothing else happens; -h'' depends on the clock")
        self.numbers = Numbers(self.wall, hints["bits"])
        rectangle = Rectangle(
            self.side(self.wall.h), self.side(self.wall.rate), self.fates(pull, e)
        )
        cells = list(self.cells())
        steps = len(cells) * rectangle.fates.pull.steps
        need(steps <= WORK, f"cells times steps are more than {WORK}")
        words = FOLLOWED.format(len(cells))
        work = Work(self.jobs, self.tell, {words: 1.0})
        tasks = [cells[k : k + AT_ONCE] for k in range(0, len(cells), AT_ONCE)]
        work(rectangle.confirm, tasks, words, lambda task: len(task) / len(cells))
        counts = [sum(letter == kind for letter, _ in cells) for kind in (RESTS, FLIES)]
        self.step(f"from {counts[0]} cells hits accumulate in time, from {counts[1]} they do not")
        for kind, share in ((RESTS, claims["resting"]), (FLIES, claims["flying"])):
            found = sum((_share(place) for letter, place in cells if letter == kind), Fraction(0))
            need(share <= found, f"the cells that {_VERBS[kind]} are a smaller share than claimed")
        self.step("they are as large a share of the rectangle as claimed")

    def pull(self) -> Polynomial:
        """Return P; prove that it depends on the clock alone, and that nothing else happens."""
        model, wall = self.p, self.wall
        mode = self.claims["mode"]
        need(model.modes[mode].guards.keys() == {self.claims["guard"]}, "the mode has other guards")
        need(wall.event.to == (mode,), "a hit leads to another mode")
        need(len(model.state) == 2, "the state has not two variables")
        pull: Polynomial = -model.lie(mode, wall.rate)
        slopes = [pull.derivative(z) for z in (COS, SIN)]
        alone = pull.variables <= {COS, SIN, PI} and all(q.variables <= {PI} for q in slopes)
        need(alone and bool(pull.terms), "-h'' is not m + c cos + d sin, with numbers m, c, d")
        monomial, leading = next(iter(pull.terms.items()))
        for key, guard in model.modes[wall.rest].guards.items():
            q = wall.at(guard.value, NONE)
            k = q.terms.get(monomial, Fraction(0)) / leading
            held = k > 0 and q == pull * k
            need(held, f"{key} of {wall.rest} is not -h'' times a positive number")
        return pull

    def side(self, q: Polynomial) -> Side:
        """Return the side of h, or of h'; it depends on a variable of its own."""
        t, box = self.claims["start"], self.claims["box"]
        need(box.keys() == {*self.p.state}, "claims.box is not one of the state")
        names = [z for z in self.p.state if q.derivative(z).terms]
        need(len(names) == 1, "h or h' depends on both variables")
        z, slope = names[0], q.derivative(names[0]).number
        a, b = box[z].lower, box[z].upper
        need(a < b, "the rectangle has no area")
        rest = self.numbers.values(self.numbers.clock((t, t))).of(q.without((z,)))
        base = rest + Interval.enclosing(slope * a, slope * a, rest.bits)
        return Side(_double(base), enclosing(slope * (b - a)))

    def fates(self, pull: Polynomial, e: Fraction) -> Fates:
        """Return what decides the fates of cells."""
        t, until = self.claims["start"], self.claims["until"] - self.claims["start"]
        clock, numbers = self.numbers.clock((t, t)), self.numbers.values({})
        mean = numbers.of(pull.without((COS, SIN)))
        c, d = (numbers.of(pull.derivative(z)) for z in (COS, SIN))
        wave = mean, c * clock[COS] + d * clock[SIN], d * clock[COS] - c * clock[SIN]
        omega = self.numbers.omega
        need(omega.upper * until <= LONGEST, f"omega (T - t_0) is more than {LONGEST}")
        early, late = _beside(until)
        grid = Pull(Wave(*map(_double, (*wave, omega))), late)
        return Fates(grid, enclosing(e), early, late)

    def cells(self) -> Iterator[tuple[str, Place]]:
        """Give the cells with their letters: ends of x for h, and for h'."""
        waiting: list[tuple[Place, int]] = [((0.0, 1.0, 0.0, 1.0), 0)]
        for letter in self.hints["tree"]:
            need(bool(waiting), "hints.tree goes on after its last part")
            (a, b, c, d), depth = waiting.pop()
            if letter in (RESTS, FLIES):
                yield letter, (a, b, c, d)
            elif letter != UNKNOWN:
                need(letter in "01", "hints.tree has another letter")
                need(depth < DEPTH, "a part is halved too often")
                m, n = 0.5 * (a + b), 0.5 * (c + d)
                first = (a, m, c, d) if letter == "0" else (a, b, c, n)
                second = (m, b, c, d) if letter == "0" else (a, b, n, d)
                waiting += [(second, depth + 1), (first, depth + 1)]
        need(not waiting, "hints.tree ends before its last part")

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        numbers = {key: decimal(claims[key]) for key in _NUMBERS}
        rest = self.p.modes[claims["mode"]].guards[claims["guard"]].rest
        box = " x ".join(str(claims["box"][z]) for z in self.p.state)
        state = ", ".join(self.p.state)
        return _BASIN.format_map(
            claims | numbers | {"system": told(self.p), "rest": rest, "box": box, "state": state}
        )


def _beside(q: Fraction) -> tuple[float, float]:
    """Return a double that is at most a number, and one that is at least that."""
    x = float(q)
    below, above = math.nextafter(x, -math.inf), math.nextafter(x, math.inf)
    return (x if Fraction(x) <= q else below), (x if Fraction(x) >= q else above)


def _double(x: Interval) -> Double:
    """Return an interval of doubles that contains one."""
    return Double(*of(x))


def _share(place: Place) -> Fraction:
    """Return the share of the area that a cell has."""
    a, b, c, d = place
    return Fraction(b - a) * Fraction(d - c)


_VERBS = {RESTS: "rest in time", FLIES: "fly at the end"}
_NUMBERS = "start", "until", "restitution", "resting", "flying"
_BASIN = (
    "the system with the {system}; with h the guard '{guard}' of '{mode}' and h' its derivative "
    "along a motion, of the states ({state}) in {box} at t = {start} in the mode '{mode}', by "
    "their area, at least the part {resting} comes to rest before t = {until}: h = 0 is met "
    "infinitely often, h' becomes -{restitution} h' each time, these hits accumulate before t = "
    "{until}, and the motion is then in the mode '{rest}', with h = h' = 0; and at least the part "
    "{flying} does not: it meets h = 0 finitely often until t = {until}, and is in the mode "
    "'{mode}' then, with h > 0"
)

THEOREM = ContactBasin
