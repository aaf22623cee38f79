"""fig:bifurcation: the elliptic orbit over f, from the closed form, and where it is born."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import NamedTuple

import numpy as np

from cap.certificate.writer import Pair
from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.one_one import (
    asymmetry,
    pair_member,
    root,
    state,
    symmetric_member,
    symmetric_state,
    turn,
    twist,
)
from cap.maps.fixed_point import Start
from cap.paper import certified
from cap.paper.figure import Found, Run, elliptic
from cap.paper.formulas import saddle_center
from cap.parameters import PAPER, at
from cap.proofs.branch_curve import Curve
from cap.proofs.fixed_point import Setting
from cap.proofs.one_one import Scale
from cap.proofs.pitchfork import lemma_2_parabolic
from cap.sets import interval

RHO = float(PAPER.R * PAPER.omega**2 / PAPER.F)
FOLD = 0.467  # the paper's
MOST_STEPS = 40  # of Newton's method
ASYMMETRIC = 1e-6  # of x_*, against the symmetric orbit


class Landmarks(NamedTuple):
    """Where the pair ends, and takes rotation numbers: f, proved; where its twist vanishes."""

    end: Pair
    resonances: dict[str, Pair]
    twist: float


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
    pitchfork: float
    landmarks: Landmarks
    sweep: list[Step]
    fold: float  # the paper's


@cache
def landmarks() -> Landmarks:
    """Prove where the pair ends and which rotation numbers it has; find where the twist is 0."""
    setting = Setting(PAPER, Start(0.0, 0.0, ()), certified.DIGITS)
    with interval.workprec(setting.bits):
        scale = Scale(setting)
        curve = Curve(scale, lemma_2_parabolic(scale).alpha)
        end, last = curve.end()
        if end is None:
            raise BadInput("the pair does not end")

        def force(ends: tuple[Fraction, Fraction]) -> Pair:
            return scale.force(interval.hull(*(curve.at(delta).alpha for delta in ends)))

        resonances = {str(q): force(ends) for q, ends in curve.resonances(last).items()}
        found = Landmarks(force(end), resonances, math.nan)
    zero = root(lambda d: twist(d, RHO), 0.35, 0.37)
    return found._replace(twist=pair_member(zero, RHO).alpha * float(PAPER.F))


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
        if path.monodromy is None:  # it was asked for
            raise TypeError
        jacobian = path.monodromy[0]
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
    return float(certified.theorem("pitchfork")["f"][0])


def data(run: Run) -> Branches:
    """Follow both branches."""
    alphas = np.linspace(0.30, 2 / math.pi - 1e-9, run.size(400, 60)).tolist()
    symmetric = [
        (alpha * float(PAPER.F), _symmetric(alpha), symmetric_member(alpha, RHO, 1).trace)
        for alpha in alphas
    ]
    pair, mirror = _pair(run, -1), _pair(run, 1)
    return Branches(pair, mirror, np.array(symmetric), _birth(), landmarks(), sweep(run), FOLD)


def birth(_run: Run) -> Found:
    """Prove where the branch ends."""
    return {"f": certified.theorem("pitchfork")["f"]}


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
    """Prove where the pair ends, beside the paper's formula, and takes rotation numbers."""
    marks = landmarks()
    return {
        "sc": saddle_center(2),
        "end": marks.end[0][:12],
        "taken": {turn: place[0][:14] for turn, place in marks.resonances.items()},
    }


def swept(run: Run) -> Found:
    """Say which orbit the sweep follows."""
    beyond = [f"f = {s.f:.4f}" for s in sweep(run) if s.f > _birth()
              and abs(s.x - _symmetric(s.f / float(PAPER.F))) < ASYMMETRIC]  # fmt: skip
    return {
        "steps": max(step.steps for step in sweep(run)),
        "beyond": f"on the symmetric one at {', '.join(beyond)}" if beyond else "is on that branch",
    }


def twist_vanishes(_run: Run) -> Found:
    """Find where the twist is 0."""
    zero = landmarks().twist
    above = zero - float(PAPER.f)
    return {"zero": zero, "above": above, "far": abs(above) > 0.01}
