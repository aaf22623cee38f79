"""The theorem about capture in the system that a certificate holds: it rests after chatter.

The parameters are the system; the guard that is hit names the mode of rest (``given``).

1. *The wall* h, and h' = L h: identities of resets and modes (``capture``).
2. *The states* 0 <= h <= H_B, |h'| <= q_B until a time t_d, the upper end of ``accumulation_time``:
   bounds of h'', other guards, other modes, other variables.
3. *The lemma* of ``chatter``, from h <= delta, |h'| <= u, which hold for all states of the box: the
   hits accumulate until t_d.  Before the first hit h >= h_0 - u s - a s^2/2, s the time since t_0,
   -h'' <= a: so none is before t_0 + 2 h_0/(u + sqrt(u^2 + 2 a h_0)).
4. *The rest*: h = h' = 0 in R, whose guards are positive from then on until a time, or over one
   period of the clock where they depend on it alone, and so for ever.  Where one of them would be
   negative, R has been left before.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any, ClassVar

from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Maybe, Table, Word, bound, enclosure, region
from cap.checker.kernel.theorem import BITS, Theorem
from cap.checker.system.capture import Modes, Near, Wall
from cap.checker.system.chatter import Entry, States, chatter
from cap.checker.system.given import STATES, SYSTEM, model, told
from cap.checker.system.model import CLOCK, PI, Model

MOST_BITS, CUTS, LONG = 1024, 1000, 10**6  # LONG: times, at most


class ContactCapture(Theorem):
    """All motions from a box of states rest after infinitely many hits."""

    PARAMETERS: ClassVar[dict[str, Any]] = SYSTEM
    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("height", number, "", "H_B", "an upper bound of h"),
        Field("speed", number, "", "q_B", "an upper bound of |h'|"),
        Field("others", Named(region, STATES), "", "", "a box that the other variables, those "
              "which h and h' do not give, do not leave"),
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
    units = {}  # noqa: RUF012

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Model:
        """Return the system."""
        return model(given)

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
        others = {z: self.enclosed(q) for z, q in hints["others"].items()}
        need(others.keys() == {*self.wall.others}, "hints.others are not the other variables")
        inside = States(self.number(hints["height"]), self.number(hints["speed"]))
        near = Near(self.wall, hints["bits"], inside, others)
        begin = self.begun(near)
        self.captured(near, begin)
        self.rested(near)

    def enclosed(self, q: Any) -> Interval:
        """Return an enclosure of a set claimed."""
        return Interval.enclosing(q.lower, q.upper, self.hints["bits"])

    def begun(self, near: Near) -> dict[str, Interval]:
        """Return the box of states with the clock at the start; it has states that are meant."""
        box, t, state = self.claims["box"], self.claims["start"], self.hints["state"]
        need(box.keys() == {*self.p.state}, "claims.box is not one of the state")
        need(state.keys() == box.keys(), "hints.state is not a state")
        inside = all(box[z].lower <= c <= box[z].upper for z, c in state.items())
        need(inside, "hints.state is not in the box")
        clock = near.clock((t, t))
        at = near.values({z: self.number(c) for z, c in state.items()} | clock)
        guards = self.p.modes[self.claims["mode"]].guards.values()
        meant = all(at.of(g.value).is_positive() for g in guards)
        need(meant, "a guard of the mode may not be positive at hints.state")
        return {z: self.enclosed(q) for z, q in box.items()} | clock

    def captured(self, near: Near, begin: dict[str, Interval]) -> None:
        """Prove that hits accumulate in time."""
        claims, at = self.claims, near.values(begin)
        start, time = claims["start"], claims["accumulation_time"]
        h, rate = at.of(self.wall.h), at.of(self.wall.rate)
        clock, last = near.clock((start, time.upper)), self.last()
        near.confirm_others(begin, near.clock((start, last)), last - start)
        near.confirm_alone(clock)
        self.step("until then no other guard is met, and no other mode is open")
        need(h.lo >= 0 or self.wall.is_above(claims["mode"]), "h may be negative in the box")
        top, fast = (Interval(x.hi, x.hi, x.bits) for x in (h, rate.magnitude()))
        e = self.number(claims["restitution"])
        found = chatter(Entry(fast, top), near.inside, near.pull(clock), e)
        need(claims["ratio"] < 1, "the ratio is not below 1")
        need(found.ratio.upper <= claims["ratio"], "the ratio may be larger than claimed")
        late = start + found.time.upper
        need(late <= time.upper, "the hits may accumulate later than claimed")
        early = start + self.fall(h, rate, near.strongest(clock)).lower
        need(time.lower <= early, "the hits may accumulate earlier than claimed")
        self.step("infinitely many hits accumulate in time, their speeds fall by the ratio claimed")

    def last(self) -> Fraction:
        """Return the latest time at which the other variables matter."""
        claims = self.claims
        rests = claims.get("released_by", claims.get("rests_until", Fraction(-LONG)))
        return Fraction(max(claims["accumulation_time"].upper, rests))

    def fall(self, h: Interval, rate: Interval, strongest: Interval) -> Interval:
        """Return a lower bound of the time until the first hit."""
        least, fast = (Interval(x, x, h.bits) for x in (max(h.lo, 0), max(-rate.lo, 0)))
        if not least.is_positive():
            return least
        return least * 2 / (fast + (fast.square() + strongest * least * 2).sqrt())

    def rested(self, near: Near) -> None:
        """Prove that it rests so long, and not longer than claimed."""
        claims, first = self.claims, self.claims["accumulation_time"].lower
        if "for_ever" in claims:
            clock_alone = all(q.variables <= {*CLOCK, PI} for q in near.guards().values())
            need(clock_alone, "a guard of the mode of rest depends on other variables")
            until = first + (near.pi * 2 / near.omega).upper
        else:
            until = claims["rests_until"]
            need(until >= claims["accumulation_time"].upper, "it rests before hits accumulate")
        cuts = [first, *self.hints["cuts"], until]
        need(all(a < b for a, b in pairwise(cuts)), "cuts are not in order")
        last = claims.get("released_by", until)
        need(last >= until, "it is released before its rest is over")
        near.confirm_held(cuts)
        self.step("the guards of the mode of rest are positive as long as claimed")
        if "released_by" in claims:
            left = any((-near.rested(q, last)).is_positive() for q in near.guards().values())
            need(left, "it may rest longer than claimed")
            self.step("one of them is negative later")

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
                "turns": _TURNS.format_map(claims) if claims["rising"] != claims["falling"] else "",
                "rest": self.mode_of_rest(),
                "stays": stays,
            }
        )


_CAPTURE = (
    "the system with the {system}; with h the guard '{guard}' of '{falling}' and h' its derivative "
    "along a motion, every motion that at t = {start} is in the mode '{mode}', all guards of which "
    "are positive, with ({state}) in {box}, meets h = 0 with h' < 0 infinitely often, at times "
    "that accumulate at one in {accumulation_time}, and until then nothing else{turns}; at each of "
    "these hits h' becomes -{restitution} h', and |h'| just before it is at most {ratio} times "
    "that just before the hit before it; from their accumulation on it is in the mode '{rest}', "
    "with h = h' = 0, {stays}"
)
_TURNS = " but changes from '{rising}' to '{falling}' where h' = 0"

THEOREM = ContactCapture
