"""The theorem about capture in the system that a certificate holds: it rests after chatter.

The parameters are the system; the guard that is hit names the mode of rest (``given``).

1. *The wall* h, and h' = L h: identities of resets and modes (``capture``).
2. *Pieces.*  The box is cut in pieces, and parts without states that are meant.  First hits of a
   piece are followed, if there are any in its hints (``first_hits``).  From the last one followed,
   or from the start, until a time t_d: bounds of h'' where 0 <= h <= H_B, |h'| <= q_B, and other
   guards, modes and variables.
3. *The lemma* of ``chatter``, from a hit, or from h <= delta, |h'| <= u: some hits one at a time,
   under bounds that hold until each has happened, then all: they accumulate until t_d.  Before the
   first one h >= h_0 - u s - a s^2/2, s the time since t_0, -h'' <= a: it is not before t_0 + 2
   h_0/(u + sqrt(u^2 + 2 a h_0)).
4. *The rest*: h = h' = 0 in R, whose guards are positive from then on until a time, or over one
   period of the clock where they depend on it alone, and so for ever.  Where one of them would be
   negative, R has been left before.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from typing import Any, ClassVar, NamedTuple

from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Table, Whole, Word, bound, enclosure, region
from cap.checker.kernel.theorem import BITS
from cap.checker.system.capture import Known, Modes, Near, Numbers, Wall
from cap.checker.system.chatter import Entry, States, chatter, first_hit, next_hit
from cap.checker.system.first_hits import first_hits
from cap.checker.system.given import STATES, told
from cap.checker.system.model import CLOCK, PI
from cap.checker.system.own import OwnSystem

MOST_BITS, CUTS, LONG = 1024, 1000, 10**6  # LONG: times, at most
BOUNCES = 64
WORK = 100_000  # pieces of flights
PIECES, TREE, HITS, DEPTH = 2000, 8000, 16, 40
PIECE = {
    "hits": Many(enclosure, 0, HITS),
    "until": Many(number, 1, BOUNCES),
    "height": number,
    "speed": number,
    "others": Named(region, STATES),
}

Box = dict[str, tuple[Fraction, Fraction]]


class Hits(NamedTuple):
    """So many hits have happened: a bound of the speed of the last one, and of its time."""

    speed: Interval
    latest: Fraction
    number: int


class ContactCapture(OwnSystem):
    """All motions from a box of states rest after infinitely many hits."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("tree", text, "", "", "how the box is cut, in order: a digit k halves a part in its "
              "k-th variable, from 0 on; . is a piece, - a part without states that are meant"),
        Field("pieces", Many(PIECE, 1, PIECES), "", "", "for each piece the windows of the hits "
              "that are followed; upper bounds of the times of some more hits, and last of that of "
              "their accumulation; from the last one followed on, upper bounds of h and |h'|, and "
              "a box that the other variables, those which h and h' do not give, do not leave"),
        Field("state", Named(number, STATES), "", "",
              "one of the box at which all guards of the mode are positive"),
        Field("cuts", Many(number, 0, CUTS), "", "",
              "cuts of the time of rest: on each piece the guards of rest are seen to be positive"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("start", number, "", "t_0", "the time at which the motions are in the box"),
        Field("mode", name, "", "", "the mode in which they are: falling or rising"),
        Field("box", Named(region, STATES), "", "",
              "of the state: its states are meant at which the guards of the mode are positive"),
        Field("falling", name, "", "", "the mode whose guard h is hit"),
        Field("guard", name, "", "h", "this guard"),
        Field("rising", name, "", "", "the mode after a hit"),
        Field("restitution", number, "", "e", "a hit makes h' to -e h', 0 < e <= 1"),
        Field("followed", Whole(0, HITS + BOUNCES), "", "",
              "of so many first hits no ratio is claimed"),
        Field("ratio", bound, "", "k",
              "below 1: of two hits in a row |h'| just before the later one is at most so many "
              "times that just before the other"),
        Field("accumulation_time", enclosure, "hits accumulate at", r"t_\infty",
              "in time; there is no last hit"),
        Field("rests_until", Maybe(number), "", "",
              "from the accumulation on it rests at least until then; not with for_ever"),
        Field("released_by", Maybe(number), "", "", "it does not rest so long"),
        Field("for_ever", Maybe(Word(("yes",))), "", "", "it rests for all times"),
    )
    # fmt: on
    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the times and the work."""
        need(hints["bits"] <= MOST_BITS, f"more than {MOST_BITS} bits")
        one = ("rests_until" in claims) != ("for_ever" in claims)
        need(one, "not one of claims.rests_until and claims.for_ever")
        last = "released_by" not in claims or "rests_until" in claims
        need(last, "claims.released_by without claims.rests_until")
        accumulated = claims["accumulation_time"]
        times = [claims["start"], accumulated.lower, accumulated.upper, *hints["cuts"]]
        for piece in hints["pieces"]:
            times += [*piece["until"], *(t for window in piece["hits"] for t in window[:2])]
        need(len(hints["tree"]) <= TREE, f"hints.tree is longer than {TREE} letters")
        times += [claims[key] for key in ("rests_until", "released_by") if key in claims]
        need(all(abs(t) <= LONG for t in times), f"a time is larger than {LONG}")
        need(claims["start"] <= accumulated.lower, "hits accumulate before they begin")

    def prove(self) -> None:
        """Prove the theorem."""
        claims, hints = self.claims, self.hints
        modes = Modes(claims["falling"], claims["guard"], claims["rising"])
        e = claims["restitution"]
        need(0 < e <= 1, "0 < e <= 1 does not hold")
        self.wall = Wall(self.p, modes, e)
        need(claims["mode"] in modes[::2], "the motions begin in another mode than these two")
        self.step(f"a hit makes h' to -e h', and h = h' = 0 stays in '{self.wall.rest}'")
        self.begun(Numbers(self.wall, hints["bits"]))
        need(claims["ratio"] < 1, "the ratio is not below 1")
        boxes = list(self.boxes())
        need(len(boxes) == len(hints["pieces"]), "hints.tree has not as many pieces as are given")
        self.left = WORK
        guards = self.wall.rested().values()
        self.alone = all(q.variables <= {*CLOCK, PI} for q in guards)
        near = [self.captured(*each) for each in zip(boxes, hints["pieces"], strict=True)]
        self.step("until hits accumulate no other guard is met, and no other mode is open")
        self.step("infinitely many hits accumulate in time, their speeds fall by the ratio claimed")
        for each in near[:1] if self.alone else near:
            self.rested(each)
        self.step("the guards of the mode of rest are positive as long as claimed")
        if "released_by" in claims:
            need(all(map(self.is_released, near)), "it may rest longer than claimed")
            self.step("one of them is negative later")

    def enclosed(self, q: Any) -> Interval:
        """Return an enclosure of a set claimed."""
        return Interval.enclosing(q.lower, q.upper, self.hints["bits"])

    def begun(self, numbers: Numbers) -> None:
        """Prove that the box has states that are meant."""
        box, t, state = self.claims["box"], self.claims["start"], self.hints["state"]
        need(box.keys() == {*self.p.state}, "claims.box is not one of the state")
        need(state.keys() == box.keys(), "hints.state is not a state")
        inside = all(box[z].lower <= c <= box[z].upper for z, c in state.items())
        need(inside, "hints.state is not in the box")
        at = numbers.values({z: self.number(c) for z, c in state.items()} | numbers.clock((t, t)))
        guards = self.p.modes[self.claims["mode"]].guards.values()
        meant = all(at.of(g.value).is_positive() for g in guards)
        need(meant, "a guard of the mode may not be positive at hints.state")

    def boxes(self) -> Iterator[Box]:
        """Give the pieces of the box; of the other parts it is proved that no state is meant."""
        claimed, tree = self.claims["box"], self.hints["tree"]
        waiting: list[tuple[Box, int]] = [({z: claimed[z][:2] for z in self.p.state}, 0)]
        for letter in tree:
            need(bool(waiting), "hints.tree goes on after its last part")
            box, depth = waiting.pop()
            if letter == ".":
                yield box
            elif letter == "-":
                self.confirm_empty(box)
            else:
                need(letter in "01234567"[: len(box)], "hints.tree has another letter")
                need(depth < DEPTH, "a piece is halved too often")
                z = self.p.state[int(letter)]
                a, b = box[z]
                m = (a + b) / 2
                waiting += [(box | {z: ends}, depth + 1) for ends in ((m, b), (a, m))]
        need(not waiting, "hints.tree ends before its last part")

    def confirm_empty(self, box: Box) -> None:
        """Prove that a guard of the mode is positive nowhere in a part."""
        numbers, t = Numbers(self.wall, self.hints["bits"]), self.claims["start"]
        values = numbers.values(self.state(box) | numbers.clock((t, t)))
        guards = self.p.modes[self.claims["mode"]].guards.values()
        empty = any(values.of(g.value).hi <= 0 for g in guards)
        need(empty, "a part of the box that is left out may have states that are meant")

    def state(self, box: Box) -> dict[str, Interval]:
        """Return enclosures of the state."""
        return {z: Interval.enclosing(*ends, self.hints["bits"]) for z, ends in box.items()}

    def captured(self, box: Box, piece: dict[str, Any]) -> Near:
        """Prove that from a piece hits accumulate in time; return numbers near the wall."""
        claims, wall = self.claims, self.wall
        start, until = claims["start"], piece["until"]
        need(
            until[-1] <= claims["accumulation_time"].upper,
            "the hits may accumulate later than claimed",
        )
        others = {z: self.enclosed(q) for z, q in piece["others"].items()}
        need(others.keys() == {*wall.others}, "the others of a piece are not the other variables")
        inside = States(self.number(piece["height"]), self.number(piece["speed"]))
        near = Near(wall, self.hints["bits"], inside, others)
        state, windows = self.state(box), [window[:2] for window in piece["hits"]]
        count = len(windows)
        begin: Known = state
        times = start, start
        if count:
            need(claims["mode"] == wall.modes.falling, "hits are followed from the falling mode")
            need(count <= max(1, claims["followed"]), "more hits are followed than claimed")
            e = claims["restitution"]
            hit = first_hits(near, start, state, e, windows, self.left)
            self.left -= hit.pieces
            begin, times = hit.others, windows[-1]
        first, last = times[0], max(until[-1], self.last())
        need(first < until[0], "hits accumulate before they begin")
        need(all(a < b for a, b in pairwise(until)), "the times of a piece are not in order")
        near.confirm_others(begin, near.clock((first, last)), last - first)
        near.confirm_alone(near.clock((first, until[-1])))
        if count:
            reached, early = Hits(_high(hit.rate.magnitude()), times[1], count), first
        else:
            reached, early = self.fallen(near, state, until[0])
        self.chattered(near, reached, first, until[0 if count else 1 :])
        low = claims["accumulation_time"].lower
        need(low <= early, "the hits may accumulate earlier than claimed")
        return near

    def fallen(
        self, near: Near, state: dict[str, Interval], until: Fraction
    ) -> tuple[Hits, Fraction]:
        """Prove that there is a first hit until then; return it, and a time before it."""
        start, wall = self.claims["start"], self.wall
        at = near.values(state | near.clock((start, start)))
        h, rate = at.of(wall.h), at.of(wall.rate)
        need(h.lo >= 0 or wall.is_above(self.claims["mode"]), "h may be negative in the box")
        need(h.hi > 0, "a piece has no states that are meant")
        clock = near.clock((start, until))
        entry = Entry(_high(rate.magnitude()), _high(h))
        found = first_hit(entry, near.inside, near.pull(clock))
        late, early = start + found.time.upper, self.fall(h, rate, near.strongest(clock)).lower
        need(late <= until, "a hit may be later than its bound")
        return Hits(found.speed, late, 1), start + early

    def chattered(self, near: Near, reached: Hits, first: Fraction, until: list[Fraction]) -> None:
        """Prove that hits follow, one until each time but the last, and accumulate until that."""
        e, (speed, at, count) = self.number(self.claims["restitution"]), reached
        need(bool(until), "there is no time until which hits accumulate")
        for t in until[:-1]:
            found = next_hit(speed, near.inside, near.pull(near.clock((first, t))), e)
            speed, at, count = found.speed, at + found.time.upper, count + 1
            need(at <= t, "a hit may be later than its bound")
            if count > self.claims["followed"]:
                self.bounded(found.ratio)
        pull = near.pull(near.clock((first, until[-1])))
        chatters = chatter(Entry(speed), near.inside, pull, e)
        need(at + chatters.time.upper <= until[-1], "the hits may accumulate later than claimed")
        self.bounded(chatters.ratio)

    def bounded(self, ratio: Interval) -> None:
        """Prove that a ratio is as claimed."""
        need(ratio.upper <= self.claims["ratio"], "the ratio may be larger than claimed")

    def last(self) -> Fraction:
        """Return the latest time at which the other variables matter.

        They matter to the rest only if its guards do not depend on the clock alone.
        """
        claims = self.claims
        accumulated: Fraction = claims["accumulation_time"].upper
        if self.alone:
            return accumulated
        rests = claims.get("released_by", claims.get("rests_until", accumulated))
        return Fraction(max(accumulated, rests))

    def fall(self, h: Interval, rate: Interval, strongest: Interval) -> Interval:
        """Return a lower bound of the time until the first hit."""
        least, fast = (Interval(x, x, h.bits) for x in (max(h.lo, 0), max(-rate.lo, 0)))
        if not least.is_positive():
            return least
        return least * 2 / (fast + (fast.square() + strongest * least * 2).sqrt())

    def rested(self, near: Near) -> None:
        """Prove that it rests so long."""
        claims, first = self.claims, self.claims["accumulation_time"].lower
        if "for_ever" in claims:
            need(self.alone, "a guard of the mode of rest depends on other variables")
            until = first + (near.pi * 2 / near.omega).upper
        else:
            until = claims["rests_until"]
            need(until >= claims["accumulation_time"].upper, "it rests before hits accumulate")
        cuts = [first, *self.hints["cuts"], until]
        need(all(a < b for a, b in pairwise(cuts)), "cuts are not in order")
        need(claims.get("released_by", until) >= until, "it is released before its rest is over")
        near.confirm_held(cuts)

    def is_released(self, near: Near) -> bool:
        """Return whether a guard of the mode of rest is negative at the time of release."""
        t = self.claims["released_by"]
        return any((-near.rested(q, t)).is_positive() for q in self.wall.rested().values())

    def mode_of_rest(self) -> str:
        """Return the mode of rest."""
        return str(self.p.modes[self.claims["falling"]].guards[self.claims["guard"]].rest)

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        stays = (
            "for ever"
            if "for_ever" in claims
            else f"at least until t = {decimal(claims['rests_until'])}"
        )
        if "released_by" in claims:
            stays += f", and it leaves this mode before t = {decimal(claims['released_by'])}"
        numbers = {key: decimal(claims[key]) for key in ("start", "restitution", "ratio")}
        return _CAPTURE.format_map(
            claims
            | numbers
            | {
                "system": told(self.p),
                "state": ", ".join(self.p.state),
                "box": " x ".join(str(claims["box"][z]) for z in self.p.state),
                "since": f", but for the first {n}," if (n := claims["followed"]) else "",
                "turns": _TURNS.format_map(claims) if claims["rising"] != claims["falling"] else "",
                "rest": self.mode_of_rest(),
                "stays": stays,
            }
        )


def _high(x: Interval) -> Interval:
    """Return the upper end."""
    return Interval(x.hi, x.hi, x.bits)


_CAPTURE = (
    "the system with the {system}; with h the guard '{guard}' of '{falling}' and h' its derivative "
    "along a motion, every motion that at t = {start} is in the mode '{mode}', all guards of which "
    "are positive, with ({state}) in {box}, meets h = 0 with h' < 0 infinitely often, at times "
    "that accumulate at one in {accumulation_time}, and until then nothing else{turns}; at each of "
    "these hits h' becomes -{restitution} h', and{since} |h'| just before it is at most {ratio} "
    "times that just before the hit before it; from their accumulation on it is in the mode "
    "'{rest}', with h = h' = 0, {stays}"
)
_TURNS = " but changes from '{rising}' to '{falling}' where h' = 0"

THEOREM = ContactCapture
