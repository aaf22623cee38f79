"""The theorem about capture: all orbits from a box come to rest at a wall, until a known time.

The events are those of ``itinerary``; the last two are the capture and the release, and the lemma
of ``capture`` is applied to the hit before them or, if there is none, to the box itself, of which
then only the interior counts: there the mass does not touch the wall.
"""

from __future__ import annotations

from cap.checker.flow.capture import ratio
from cap.checker.flow.fixed_point import Proof, ends, in_order
from cap.checker.flow.itinerary import SIDES, follow
from cap.checker.flow.mechanics import Mechanics
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

_ORDER = 3  # of the jets over the box
_HORIZON = 16  # periods


class Capture(Proof):
    """All orbits from the interior of a box are captured."""

    def prove(self) -> None:
        """Prove the theorem."""
        claims, p = self.claims, self.p
        box = [ends(claims["box"][z]) for z in ("x", "v")]
        need(all(low < high for low, high in box), "the box has no interior")
        need(p.l <= box[0][0] and box[0][1] <= p.r, "the box is not between the walls")
        words, side = claims["itinerary"], SIDES[claims["wall"]]
        last = [f"capture {claims['wall']}", f"release {'left' if side > 0 else 'right'}"]
        need(words[-2:] == last, "the itinerary does not end with the capture and the release")
        region = [Interval.enclosing(*z, self.hints["bits"]) for z in box]
        M = Mechanics(p, region, [z.midpoint() for z in region], _ORDER, _HORIZON)
        windows = [ends(w) for w in self.hints["events"]]
        start = M.launch() if len(words) > 2 else None
        events, _ = follow(M, start, words, windows)
        self.step(f"all orbits from the box have the itinerary: {', '.join(words)}")
        captured, released = events[-2:]
        towards, times = captured.forcing * side, [e.moment.t.value for e in events]
        self.confirm("event_times", times, None)
        self.confirm("forcing", towards, None)
        self.confirm("accumulation_time", times[-2], None)
        self.confirm("release_time", released.moment.t.value, 1 / self.omega)
        last_two = [claims["accumulation_time"], claims["release_time"]]
        in_order(words, claims["event_times"])
        in_order(words, [*claims["event_times"][:-2], *last_two])
        need(claims["forcing"].lower > p.f, "the forcing claimed is not above f")
        bound = claims["ratio"]
        need(bound < 1, "the ratio is not below 1")
        need(ratio(M, towards).upper <= bound, "the ratio may be larger than claimed")
        self.step("the claims contain what is computed")
