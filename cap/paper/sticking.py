"""fig:hist-chatter: an orbit that comes to stick-slip, two neighbours, and a true accumulation."""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np

from cap.audit.comparison import Comparison, claim, count, number, taken_from
from cap.floats.diagnostics.chatter import Chatter, chatter
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.paper.certified import theorem
from cap.paper.figure import Figure, Result, Run
from cap.parameters import PAPER, at

WEAK, START = "0.55", (0.0, 1.5)
END = 12.0  # of the paper's panel (a), a time
STRONG = "1.2"
TWO: tuple[State, State] = ((-0.95, 0.95), (-0.95, 1.00))
NEAR_WALL = 0.99, 0.01  # a state that is captured
TIMES = ("5.53", "7.85", "8.67", "10.99", "11.81")
"""Of the releases and onsets of sticking after the first onset."""


@dataclass(frozen=True)
class Panels:
    """The orbit of panel (a), those of panel (b), and one that is captured."""

    slow: Trajectory
    two: tuple[Trajectory, Trajectory]
    distance: tuple[float, ...]
    captured: Chatter


def compute(run: Run) -> Result:
    """Follow the orbits of both panels."""
    del run
    slow = trajectory(at(F=WEAK), orbit=START, exactly=True, periods=END / (2 * math.pi))
    two = tuple(trajectory(at(F=STRONG), orbit=each, exactly=True, periods=4) for each in TWO)
    strobes = [orbit.strobe for orbit in two]
    distance = tuple(np.hypot(*(strobes[0] - strobes[1]).T).tolist())
    caught = chatter(PAPER, orbit=NEAR_WALL)
    data = Panels(slow, (two[0], two[1]), distance, caught)
    return Result((*_slow(slow), *_two(data), *_captured(caught)), data)


def _slow(orbit: Trajectory) -> list[Comparison]:
    """Compare the events of panel (a)."""
    words, times = [str(word) for word in orbit.words], orbit.times.tolist()
    counts = Counter(word.split()[0] for word in words)
    later = [t for w, t in zip(words, times, strict=True) if w.startswith(("stick", "release"))]
    found = {kind: times[words.index(kind)] for kind in ("hit r", "hit l", "stick")}
    found["turn"] = times[[w.startswith("turn") for w in words].index(True)]
    long = swarm.itinerary(at(F=WEAK), START, 40)
    rests = [event.x for event in long if event.word == "stick"][-3:]
    return [
        number("(a) hit of the right wall, t", "0.65", found["hit r"]),
        number("(a) hit of the left wall, t", "2.54", found["hit l"]),
        number("(a) turn, t", "3.45", found["turn"]),
        number("(a) first onset of sticking, t", "4.28", found["stick"]),
        *(number(f"(a) {_kind(words, times, t)} after {before:.2f}, t", printed, t)
          for printed, before, t in zip(TIMES, later, later[1:], strict=False)),
        count("(a) right hits up to t = 12", 1, words.count("hit r")),
        count("(a) left hits up to t = 12", 1, words.count("hit l")),
        count("(a) turns up to t = 12", 1, counts["turn"]),
        count("(a) onsets of sticking up to t = 12", 3, counts["stick"]),
        count("(a) releases up to t = 12", 3, counts["release"]),
        number("(a) impulse bound 2F/pi", "0.350", 2 * float(WEAK) / math.pi),
        claim("(a) then", "a slowly drifting equilibrium",
              f"T-periodic stick-slip between x = {rests[-1]:.5f} and {rests[-2]:.5f}, drift "
              f"{abs(rests[-1] - rests[-3]):.0e}", abs(rests[-1] - rests[-3]) > 1e-6,
              "the two slips of a period are equal and opposite, by symmetry"),
        claim("(a) amplitude after t = 3", "decays", "constant from the second onset on",
              abs(rests[-1] - rests[-3]) > 1e-6, "as above"),
    ]  # fmt: skip


def _kind(words: list[str], times: list[float], t: float) -> str:
    return "onset of sticking" if words[times.index(t)] == "stick" else "release"


def _two(data: Panels) -> list[Comparison]:
    """Compare panel (b)."""
    rows = []
    for orbit, (_, v) in zip(data.two, TWO, strict=True):
        words = Counter(str(word) for word in orbit.words)
        kinds = Counter(str(word).split()[0] for word in orbit.words)
        found = f"{words['hit r']} right, {words['hit l']} left, {kinds['turn']} turns"
        rows.append(
            claim(f"(b) from (-0.95, {v:g}) in 4 T", "4 right, 4 left, 4 turns", found,
                  found == "4 right, 4 left, 4 turns",
                  note=f"and {kinds['stick']} sticks, which the paper does not count")
        )  # fmt: skip
    hits = [abs(b) for orbit in data.two for w, b in zip(orbit.words, orbit.before, strict=True)
            if w == "hit r"]  # fmt: skip
    rows += [
        claim("(b) grazing at the right wall", "the orbits pass close to it",
              f"they hit it at speeds {min(hits):.3f} to {max(hits):.3f}", min(hits) < 0.1,
              "no hit is near grazing, and no orbit turns near the wall"),
        claim("(b) the two orbits", "separate macroscopically, by a square root",
              "distances at t = 0, T, …, 4T: " + ", ".join(f"{d:.4f}" for d in data.distance),
              data.distance[-1] > data.distance[0],
              "they approach each other: both tend to one attractor, superstable as it sticks"),
    ]  # fmt: skip
    return rows


def _captured(caught: Chatter) -> list[Comparison]:
    """Compare the claim that impacts do not accumulate."""
    box = theorem("capture", NEAR_WALL)
    F, f = float(PAPER.F), float(PAPER.f)
    least, shortest = 2 * (F - f) / (F + f), float(np.diff(caught.times).min())
    return [
        *taken_from("ssec:conclusion-summary", [
            claim("time between events", f"at least 2(F - f)/(F + f) = {least:.4f}",
                  f"{shortest:.1e} between hits", shortest >= least, "a capture: see below")]),
        claim("accumulation of impacts (the paper's parameters)", "ruled out for almost all states",
              f"on an open box around {NEAR_WALL} (proved): infinitely many hits before "
              f"t = {float(box['accumulation_time'][1]):.4f}", False,
              "Theorem wellposed (Step 4) takes hits to be a distance R apart; at a wall they are "
              f"not. Here {len(caught.times)} hits are followed, ratio of speeds "
              f"{caught.speeds[-1] / caught.speeds[-2]:.5f}, limit {caught.ratio:.5f}"),
    ]  # fmt: skip


FIGURE = Figure("sticking, grazing, and accumulation", compute, "sticking:sticking", (7.8, 6.0))
