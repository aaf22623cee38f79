"""The theorem about capture: all orbits from a box come to rest at a wall, until a known time.

The events are those of ``itinerary``; the last two are the capture and the release, and the lemma
of ``capture`` is applied to the hit before them or, if there is none, to the box itself, of which
then only the interior counts: there the mass does not touch the wall.
"""

from __future__ import annotations

from typing import Any

from cap.checker.flow.capture import bounces, captures
from cap.checker.flow.events import WORDS, LossyMap, in_order, limit_events
from cap.checker.flow.itinerary import MAX_EVENTS
from cap.checker.flow.mechanics import Ends
from cap.checker.flow.stops import SIDES
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Word, bound, enclosure
from cap.checker.kernel.theorem import BITS
from cap.checker.maps.fixed_point import STATE, WINDOWS
from cap.checker.system.lossy import SYSTEM, WithLosses

_ORDER = 3  # of the jets over the box
_HORIZON = 16  # periods


class Capture(WithLosses):
    """All orbits from the interior of a box are captured."""

    # fmt: off
    HINTS = (
        BITS,
        Field("events", WINDOWS, "", "", "every orbit from the box has its k-th event in the k-th"),
    )
    CLAIMS = (
        Field("box", STATE, "", "", "the claims hold for every orbit from its interior at t = 0"),
        Field("wall", Word(("r", "l")), "", "", "the wall of the last capture"),
        Field("itinerary", Many(Word(WORDS), 1, MAX_EVENTS), "", "",
              "the events; the last two are the last capture and the release after it"),
        Field("event_times", Many(enclosure, 1, MAX_EVENTS), "itinerary", "t_k",
              "enclosures for all orbits of the box, in order"),
        Field("forcing", enclosure, "|F cos wt| in the last capture", r"|F\cos\omega t|",
              "the force towards the wall, above f"),
        Field("ratio", bound, "", "", "below 1: the speed after each hit of the last capture is at "
              "most so many times that after the one before"),
        Field("accumulation_time", enclosure, "hits of the last capture accumulate at",
              r"t_\infty", "there is no last hit"),
        Field("release_time", Quantity("omega^-1"), "last release at", r"t_{\mathrm{release}}",
              "from the accumulation until then the mass rests at the wall"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        limit_events(hints, claims)

    def prove(self) -> None:
        """Prove the theorem."""
        claims, p = self.claims, self.p
        box: list[Ends] = [claims["box"][z][:2] for z in ("x", "v")]
        need(all(low < high for low, high in box), "the box has no interior")
        need(p.l <= box[0][0] and box[0][1] <= p.r, "the box is not between the walls")
        words, side = claims["itinerary"], SIDES[claims["wall"]]
        last = [f"capture {claims['wall']}", f"release {'left' if side > 0 else 'right'}"]
        need(words[-2:] == last, "the itinerary does not end with the capture and the release")
        region = [Interval.enclosing(*z, self.hints["bits"]) for z in box]
        windows = [w[:2] for w in self.hints["events"]]
        phi = LossyMap(p, windows, words, _HORIZON)
        M = phi.mechanics(region, [z.midpoint() for z in region], _ORDER)
        start = M.launch() if len(words) > 2 else None
        events, _ = phi.follow(M, start)
        self.step(f"all orbits from the box have the itinerary: {', '.join(words)}")
        captured, released = events[-2:]
        ratio = bounces(M, events[-3] if start else None, words[-2], windows[-2]).ratio
        towards, times = captured.forcing * side, [e.moment.t.value for e in events]
        self.confirm(event_times=times, forcing=towards, accumulation_time=times[-2])
        self.confirm(release_time=released.moment.t.value)
        last_two = [claims["accumulation_time"], claims["release_time"]]
        in_order(words, claims["event_times"])
        in_order(words, [*claims["event_times"][:-2], *last_two])
        need(claims["forcing"].lower > p.f, "the forcing claimed is not above f")
        bound = claims["ratio"]
        need(bound < 1, "the ratio is not below 1")
        need(ratio.upper <= bound, "the ratio may be larger than claimed")
        self.step("the claims contain what is computed")

    def words(self) -> str:
        """Return the theorem in one line."""
        words, box = self.claims["itinerary"], self.claims["box"]
        return self.told(
            SYSTEM + _CAPTURE,
            box=" x ".join(str(box[z]) for z in ("x", "v")),
            itinerary=", ".join(words),
            captures=captures(words),
        )


_CAPTURE = (
    "every orbit that starts at t = 0 in the interior of {box} has at first exactly these events, "
    "in this order: {itinerary}{captures}; the hits of the last capture accumulate at a time in "
    "{accumulation_time}, while |F cos(omega t)|, the force towards the wall {wall}, is in "
    "{forcing}, above f; the speed after each of them is at most {ratio} times that after the one "
    "before; the last release is at a time in {release_time}"
)

THEOREM = Capture
