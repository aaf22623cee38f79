"""Capture: infinitely many hits of a wall in a finite time."""

import math
from dataclasses import dataclass

import numpy as np

from cap.errors import BadInput
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.engine.swarm import Event
from cap.floats.findings import Findings, Floats, State
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

PATIENCE = 100  # periods
NEAR = 0.01  # distance from the wall of the default start, in units of R


@dataclass(frozen=True, kw_only=True)
class Chatter(Findings):
    """The hits (K,) of one wall before the first capture: times, and the speeds after them.

    ``end`` is the time at which they accumulate.  ``ratio`` is what the speeds' ratio tends to:
    e sqrt((a - f)/(a + f)), a the force to the wall at that time.  ``orbit`` is one trajectory.
    """

    wall: float
    times: Floats
    speeds: Floats
    end: float
    ratio: float
    orbit: tuple[Trajectory, ...]

    def columns(self) -> dict[str, Floats]:
        """Return one row for each hit."""
        return {"t": self.times, "speed": self.speeds, "left": self.end - self.times}

    def lines(self) -> list[str]:
        """Return how the speeds fall."""
        last = self.speeds[-1] / self.speeds[-2] if len(self.speeds) > 1 else math.nan
        return [
            f"capture at the wall {self.wall:.6g} at {described(self.parameters)}",
            f"  {len(self.times)} hits computed, from t = {self.times[0]:.10g}, speed "
            f"{self.speeds[0]:.6g}, to speed {self.speeds[-1]:.3g}",
            f"  they accumulate at t = {self.end:.12g}",
            f"  ratio of speeds: last {last:.8g}, limit {self.ratio:.8g}",
        ]


def chatter(
    p: Parameters,
    *,
    orbit: State | None = None,
    periods: float = PATIENCE,
    runner: Runner | None = None,
) -> Chatter:
    """Follow a state up to its first capture; without one, a mass at rest near the right wall."""
    state = orbit or (float(p.r) - NEAR * float(p.R), 0.0)
    events = swarm.itinerary(p, state, periods)
    ends = [k for k, event in enumerate(events) if event.word.startswith("capture")]
    if not ends:
        raise BadInput(
            f"no capture within {periods:.6g} periods from ({state[0]:.8g}, {state[1]:.8g})"
        )
    capture = events[ends[0]]
    hits = _bounces(events[: ends[0]], capture)
    if not hits:
        raise BadInput("the mass is captured without a bounce: it comes to the wall at rest")
    T = 2 * math.pi / float(p.omega)
    a = abs(float(p.F) * math.cos(float(p.omega) * capture.time))
    f = float(p.f)
    shown = capture.time / T + 0.02
    return Chatter(
        parameters=p,
        wall=capture.x,
        times=np.array([hit.time for hit in hits]),
        speeds=np.array([abs(hit.after) for hit in hits]),
        end=capture.time,
        ratio=float(p.e) * math.sqrt(max(0.0, a - f) / (a + f)),
        orbit=(trajectory(p, orbit=state, exactly=True, periods=shown, runner=runner),),
    )


def _bounces(events: tuple[Event, ...], capture: Event) -> list[Event]:
    """Return the last hits of the wall of the capture with nothing but turns between them."""
    word, found = capture.word.replace("capture", "hit"), []
    for event in reversed(events):
        if event.word == word:
            found.append(event)
        elif not event.word.startswith("turn"):
            break
    return found[::-1]
