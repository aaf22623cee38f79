"""How far a periodic orbit is from a change of its itinerary, in natural units.

Grazing: a hit whose speed, or a turn whose distance from a wall, goes to 0.  Sticking border: a
least speed between events that goes to 0, or the force that is left at a turn, |F cos ωt| - f, or
missing at a stick.
"""

import math
from dataclasses import dataclass

from cap.floats.engine import swarm
from cap.floats.engine.swarm import Event
from cap.floats.findings import State
from cap.flow.itinerary import oscillator
from cap.flow.model import Oscillator
from cap.parameters import Parameters

GRAZING, STICKING = "grazing", "sticking border"


@dataclass(frozen=True)
class Margins:
    """The itinerary, up to its beginning, and the margins; inf where nothing can change."""

    words: tuple[str, ...]
    hit_speed: float
    turn_distance: float
    least_speed: float
    force: float

    @property
    def nearest(self) -> tuple[float, str]:
        """The least margin, and what happens where it vanishes."""
        grazing = min(self.hit_speed, self.turn_distance)
        sticking = min(self.least_speed, self.force)
        return min((grazing, GRAZING), (sticking, STICKING))


def margins(p: Parameters, state: State, periods: int) -> Margins:
    """Return the margins of a periodic orbit through ``state`` at t = 0."""
    events = swarm.itinerary(p, state, periods)
    o = oscillator(p)
    speed, length, force = float(p.R * p.omega), float(p.R), float(p.F)
    hits = [abs(e.before) for e in events if e.word.startswith("hit")]
    turns = [min(e.x - o.l, o.r - e.x) for e in events if e.word.startswith("turn")]
    left = [abs(abs(o.forcing(o.moment(e.time))) - o.f) for e in events
            if e.word.split()[0] in ("turn", "stick")]  # fmt: skip
    slow = list(_slow_speeds(o, state, events, periods * o.T))
    return Margins(
        _cyclic(_without_bounces(events)),
        min(hits, default=math.inf) / speed,
        min(turns, default=math.inf) / length,
        min(slow, default=math.inf) / speed,
        min(left, default=math.inf) / force,
    )


def _slow_speeds(
    o: Oscillator[float], state: State, events: tuple[Event, ...], end: float
) -> list[float]:
    """Return the local minima of the speed on the flights."""
    found = []
    t, x, v = 0.0, *state
    for event in (*events, Event(end, "", math.nan, 0.0, 0.0)):
        s = _sign(v, event.before)
        if s:
            flight = o.launch(s, o.moment(t), x, v)
            k = math.ceil((t - o.slow(s, 0).t) / o.T)
            while (slow := o.slow(s, k)).t < event.time:
                found.append(s * o.velocity(flight, slow))
                k += 1
        t, x, v = event.time, event.x, event.after
        if event.word.startswith(("turn", "release")):
            v = math.copysign(1e-300, 1 if event.word.endswith("right") else -1)
    return found


def _sign(after: float, before: float) -> int:
    """Return the sign of a flight from the velocities at its ends; at rest both are 0."""
    v = after or before
    return (v > 0) - (v < 0)


def _without_bounces(events: tuple[Event, ...]) -> tuple[str, ...]:
    """Return the words but for the hits and turns that lead, in any number, to a capture."""
    words: list[str] = []
    for event in events:
        if event.word.startswith("capture"):
            hit = event.word.replace("capture", "hit")
            while words and (words[-1] == hit or words[-1].startswith("turn")):
                words.pop()
        words.append(event.word)
    return tuple(words)


def _cyclic(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return the first of all rotations: an event may pass t = 0 without a bifurcation."""
    return min((words[k:] + words[:k] for k in range(len(words))), default=())
