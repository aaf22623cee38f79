"""fig:hist-chatter: an orbit that comes to stick-slip, two neighbours, and a true accumulation."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from cap.floats.diagnostics.chatter import Chatter, chatter
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.paper import events
from cap.paper.certified import theorem
from cap.paper.figure import Found, Run
from cap.parameters import PAPER, at

WEAK, START = "0.55", (0.0, 1.5)
END = 12.0  # of the paper's panel (a), a time
STRONG = "1.2"
TWO: tuple[State, State] = ((-0.95, 0.95), (-0.95, 1.00))
NEAR_WALL = 0.99, 0.01  # a state that is captured


@dataclass(frozen=True)
class Panels:
    """The orbit of panel (a), those of panel (b), and one that is captured."""

    slow: Trajectory
    two: tuple[Trajectory, Trajectory]
    captured: Chatter


@cache
def data(_run: Run) -> Panels:
    """Follow the orbits of all panels."""
    slow = trajectory(at(F=WEAK), orbit=START, exactly=True, periods=END / (2 * math.pi))
    first, second = (trajectory(at(F=STRONG), orbit=z, exactly=True, periods=4) for z in TWO)
    return Panels(slow, (first, second), chatter(PAPER, orbit=NEAR_WALL))


def happened(run: Run) -> Found:
    """List the events of panel (a): the times of each kind, in order, and their numbers."""
    slow, times = data(run).slow, dict[str, list[float]]()
    for word, time in zip(map(str, slow.words), slow.times.tolist(), strict=True):
        times.setdefault(word if word.startswith("hit") else word.split()[0], []).append(time)
    return {"times": times, **events.counted(slow.words)}


def rests(_run: Run) -> Found:
    """Say where the orbit of panel (a) rests in the end."""
    seen = swarm.itinerary(at(F=WEAK), START, 40)
    before, here, last = [event.x for event in seen if event.word == "stick"][-3:]
    return {"last": last, "other": here, "drift": abs(last - before)}


def neighbour(run: Run, number: str) -> Found:
    """Count the events of an orbit of panel (b)."""
    return events.counted(data(run).two[int(number) - 1].words)


def grazing(run: Run) -> Found:
    """Find the speeds at which the orbits of panel (b) hit the right wall."""
    speeds = np.abs([orbit.before[orbit.words == "hit r"] for orbit in data(run).two])
    return {"least": speeds.min(), "most": speeds.max()}


def separation(run: Run) -> Found:
    """Follow the distance of the orbits of panel (b)."""
    first, second = (orbit.strobe for orbit in data(run).two)
    distance = np.hypot(*(first - second).T).tolist()
    shown = ", ".join(f"{each:.4f}" for each in distance)
    return {"distances": shown, "first": distance[0], "last": distance[-1]}


def gaps(run: Run) -> Found:
    """Find the shortest time between hits of the orbit that is captured."""
    F, f = float(PAPER.F), float(PAPER.f)
    shortest = np.diff(data(run).captured.times).min()
    return {"shortest": shortest, "stated": 2 * (F - f) / (F + f)}


def capture(run: Run) -> Found:
    """Prove that hits accumulate, and follow some."""
    caught = data(run).captured
    return {
        "near": NEAR_WALL,
        "end": theorem("capture", NEAR_WALL)["accumulation_time"][1],
        "hits": len(caught.times),
        "ratio": caught.speeds[-1] / caught.speeds[-2],
        "limit": caught.ratio,
    }
