"""fig:bifurcation: the elliptic orbit over f, from the closed form, and where it is born."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import NamedTuple

import numpy as np

from cap.audit.means.stored import stored
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.one_one import (
    asymmetry,
    pair_member,
    state,
    symmetric_member,
    symmetric_state,
    turn,
)
from cap.paper.figure import Found, Run, elliptic
from cap.parameters import PAPER, at

Pair = tuple[str, str]  # decimals that enclose
RHO = float(PAPER.R * PAPER.omega**2 / PAPER.F)
FOLD = 0.467  # the paper's
MOST_STEPS = 40  # of Newton's method
ASYMMETRIC = 1e-6  # of x_*, against the symmetric orbit


class Landmarks(NamedTuple):
    """The f, proved, at which the pair is born, ends, takes rotation numbers, has no twist."""

    birth: Pair
    end: Pair
    resonances: dict[str, Pair]
    twist: Pair


class Step(NamedTuple):
    """A value of the paper's sweep: f, x, the rotation number, and the steps of Newton's method."""

    f: float
    x: float
    turn: float
    steps: int


@dataclass(frozen=True)
class Branches:
    """Orbits over f as rows (f, x, trace): the pair, the symmetric orbit; and the sweep."""

    pair: Floats
    mirror: Floats
    symmetric: Floats
    landmarks: Landmarks
    sweep: list[Step]
    fold: float  # the paper's


def landmarks() -> Landmarks:
    """Return what the theorem `branch` claims at the paper's parameters, from its certificate."""
    own = stored("branch.json").claims
    resonances = {str(each["ratio"]): each["f"].text for each in own["resonances"]}
    (zero,) = own["twist_zeros"]
    return Landmarks(own["f_start"].text, own["f_end"].text, resonances, zero.text)


@cache
def sweep(run: Run) -> list[Step]:
    """Follow the orbit by Newton's method on Φ - 1, from each fixed point to the next f."""
    z, found = elliptic(), []
    for f in np.linspace(0.40, FOLD - 0.001, run.size(25, 9)).tolist():
        z, trace, steps = _newton(f, z)
        found.append(Step(f, z[0], float(turn(trace)), steps))
    return found


def _newton(f: float, z: State) -> tuple[State, float, int]:
    p = at(f=str(Fraction(f)))
    point = np.array(z)
    for k in range(1, MOST_STEPS + 1):  # noqa: B007
        path = swarm.follow(p, [point], 1, derivative=True)
        jacobian = path.derivatives[0]
        step = np.linalg.solve(jacobian - np.eye(2), path.states[0] - point)
        point = point - step
        if np.abs(step).max() < 1e-11:
            break
    return (float(point[0]), float(point[1])), float(np.trace(jacobian)), k


@cache
def _pair(run: Run, side: int) -> Floats:
    """Return an orbit of the pair as rows (f, x, trace), f descending."""
    last = asymmetry(float(landmarks().end[0]) / float(PAPER.F), RHO)
    deltas = np.linspace(1e-4, last, run.size(400, 60)).tolist()
    return np.array([(*_place(side * delta), pair_member(delta, RHO).trace) for delta in deltas])


def _place(delta: float) -> tuple[float, float]:
    alpha, way, _ = state(delta, RHO)
    return alpha * float(PAPER.F), _x(way)


def _x(way: float) -> float:
    return float(PAPER.r) - way * float(PAPER.F / PAPER.omega**2)


def _symmetric(alpha: float) -> float:
    """Return x of the symmetric orbit."""
    return _x(symmetric_state(alpha, RHO, 1)[0])


def _birth() -> float:
    return float(landmarks().birth[0])


def data(run: Run) -> Branches:
    """Follow both branches."""
    alphas = np.linspace(0.30, 2 / math.pi - 1e-9, run.size(400, 60)).tolist()
    symmetric = [
        (alpha * float(PAPER.F), _symmetric(alpha), symmetric_member(alpha, RHO, 1).trace)
        for alpha in alphas
    ]
    pair, mirror = _pair(run, -1), _pair(run, 1)
    return Branches(pair, mirror, np.array(symmetric), landmarks(), sweep(run), FOLD)


def branch(run: Run) -> Found:
    """Say how x and the rotation number change along the branch."""
    pair = _pair(run, -1)
    numbers = turn(pair[:, 2])
    return {
        "direction": _direction(pair[pair[:, 0] >= 0.4]),
        "birth": _birth(),
        "decreases": (np.diff(numbers[numbers > 0]) > 0).all(),
        "exponent": _exponent(),
    }


def _direction(rows: Floats) -> str:
    """Say how x changes with f; the rows descend in f."""
    change = -np.diff(rows[:, 1])
    return "increases" if (change > 0).all() else "decreases" if (change < 0).all() else "neither"


def _exponent() -> float:
    """Fit the rotation number near the birth of the pair."""
    members = [pair_member(d, RHO) for d in np.geomspace(1e-4, 1e-2, 12).tolist()]
    f = np.array([m.alpha for m in members]) * float(PAPER.F)
    numbers = turn(np.array([m.trace for m in members]))
    return float(np.polyfit(np.log(_birth() - f), np.log(numbers), 1)[0])


def proved(_run: Run) -> Found:
    """Return what is proved of the pair."""
    birth, _, resonances, twist = landmarks()
    return {
        "birth": birth,
        "taken": {turn: place[0][:14] for turn, place in resonances.items()},
        "zero": twist,
        "above": float(twist[0]) - float(PAPER.f),
    }


def swept(run: Run) -> Found:
    """Say which orbit the sweep follows."""
    beyond = [f"f = {s.f:.4f}" for s in sweep(run) if s.f > _birth()
              and abs(s.x - _symmetric(s.f / float(PAPER.F))) < ASYMMETRIC]  # fmt: skip
    return {
        "steps": max(step.steps for step in sweep(run)),
        "beyond": f"on the symmetric one at {', '.join(beyond)}" if beyond else "is on that branch",
    }
