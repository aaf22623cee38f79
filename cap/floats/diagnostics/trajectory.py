"""One orbit in time: its position and velocity, and its events."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.engine.swarm import Event
from cap.floats.findings import Floats, State
from cap.floats.history import History, arrays
from cap.floats.search import cycles
from cap.floats.search.fixed_point import elliptic_point
from cap.floats.words import described
from cap.flow.itinerary import oscillator
from cap.flow.model import Oscillator
from cap.parameters import Parameters
from cap.runner import Runner

SAMPLES = 400  # in a period …
MOST_SAMPLES = 400_000  # … or fewer in many
MOST_EVENTS = 200_000


@dataclass(frozen=True, kw_only=True)
class Trajectory(History):
    """The orbit of one mass: x, v (K,); ``before``, ``after`` (E,); ``strobe`` (M, 2)."""

    def columns(self) -> dict[str, Floats]:
        """Return time, position and velocity."""
        return {"t": self.t, "x": self.x, "v": self.v}

    def counts(self) -> dict[str, int]:
        """Return how often each kind of event happened."""
        kinds = [str(word).split()[0] for word in self.words]
        return {kind: kinds.count(kind) for kind in dict.fromkeys(kinds)}

    def lines(self) -> list[str]:
        """Return the events in their order."""
        x, v = self.strobe[0]
        head = f"orbit of (x, v) = ({x:.10g}, {v:.10g}) at {described(self.parameters)}"
        row = "  t = {:<14.10g} {:<14} x = {:< .8g}  v {:.8g} -> {:.8g}".format
        x, v = self.strobe[-1]
        return self.listed(head, row, f"  ends at ({x:.10g}, {v:.10g})")


def trajectory(
    p: Parameters,
    *,
    orbit: State | None = None,
    exactly: bool = False,
    periods: float = 1,
    runner: Runner | None = None,  # noqa: ARG001 (as all commands: here there is nothing to share)
) -> Trajectory:
    """Return the orbit of a state; without one, that of the first elliptic fixed point, or (0, 1).

    Unless ``exactly``, a state is replaced by the periodic orbit to which Newton's method leads
    from it, if that is within 1/100 of R and Rω.
    """
    x, v = _start(p, orbit, exactly)
    state = float(x), float(v)
    events = swarm.itinerary(p, state, periods)
    if len(events) > MOST_EVENTS:
        raise BadInput(f"more than {MOST_EVENTS} events: follow it for fewer periods")
    T = 2 * math.pi / float(p.omega)
    ends = swarm.follow(p, [state], periods, every=True)
    if ends.lost[0]:
        raise BadInput(f"no orbit starts at {state}: x must lie between the walls, v not be huge")
    samples = np.array(list(_samples(p, state, events, periods * T)))
    return Trajectory(
        parameters=p,
        period=T,
        t=samples[:, 0],
        x=samples[:, 1],
        v=samples[:, 2],
        strobe=ends.states[0],
        **arrays(events),
    )


def _start(p: Parameters, orbit: State | None, exactly: bool) -> State:
    if orbit is None:
        return elliptic_point(p) or ((float(p.l + p.r) / 2), float(p.F / p.omega))
    if exactly:
        return orbit
    try:
        cycle = cycles.near(p, *orbit)
    except BadInput:
        return orbit
    near = 1e-2 * float(p.R), 1e-2 * float(p.R * p.omega)
    close = abs(cycle.x - orbit[0]) < near[0] and abs(cycle.v - orbit[1]) < near[1]
    return (cycle.x, cycle.v) if close else orbit


def _samples(
    p: Parameters, state: State, events: tuple[Event, ...], end: float
) -> Iterator[tuple[float, float, float]]:
    """Give (t, x, v) along the flights and rests, their ends included."""
    o, t, (x, v) = oscillator(p), 0.0, state
    rate = min(SAMPLES / o.T, MOST_SAMPLES / end)
    sign = (v > 0) - (v < 0)
    for event in (*events, Event(end, "", math.nan, math.nan, math.nan)):
        yield from _between(o, (t, x, v), sign, event.time, rate)
        if event.word:
            t, x, v = event.time, event.x, event.after
            yield t, x, event.before
            yield t, x, v
            sign = _direction(event)


def _direction(event: Event) -> int:
    """Return the sign of the velocity after an event, 0 at rest."""
    kind, _, side = event.word.partition(" ")
    if kind in ("turn", "release"):
        return 1 if side == "right" else -1
    if kind == "hit":
        return -1 if side == "r" else 1
    return 0


def _between(
    o: Oscillator[float], start: tuple[float, float, float], sign: int, end: float, rate: float
) -> Iterator[tuple[float, float, float]]:
    """Give samples of one flight or rest, ``rate`` of them per unit of time."""
    t, x, v = start
    count = max(16, math.ceil(rate * (end - t)))
    yield start
    if sign == 0:
        yield end, x, 0.0
        return
    flight = o.launch(sign, o.moment(t), x, v)
    for k in range(1, count + 1):
        moment = o.moment(t + (end - t) * k / count)
        place = min(max(o.position(flight, moment), o.l), o.r)
        yield moment.t, place, o.velocity(flight, moment)
