"""fig:bifurcation: the elliptic orbit over f, from the closed form, and where it is born."""

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cap.audit.comparison import Comparison, claim, number, proved, roughly
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
from cap.paper.figure import Figure, Result, Run, elliptic
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


def sweep(values: Floats) -> list[Step]:
    """Follow the orbit by Newton's method on Φ - 1, from each fixed point to the next f."""
    z, found = elliptic(), []
    for f in values.tolist():
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


def compute(run: Run) -> Result:
    """Follow both branches."""
    points = run.size(400, 60)
    marks = landmarks()
    birth = float(certified.pitchfork()["f"][0])
    last = asymmetry(float(marks.end[0]) / float(PAPER.F), RHO)
    delta = np.linspace(1e-4, last, points)
    pair, mirror = (
        np.array([(*_place(side * d), pair_member(d, RHO).trace) for d in delta.tolist()])
        for side in (-1, 1)
    )
    symmetric = []
    for alpha in np.linspace(0.30, 2 / math.pi - 1e-9, points).tolist():
        way, _ = symmetric_state(alpha, RHO, 1)
        member = symmetric_member(alpha, RHO, 1)
        symmetric.append((alpha * float(PAPER.F), _x(way), member.trace))
    values = np.linspace(0.40, FOLD - 0.001, run.size(25, 9))
    steps = sweep(values)
    data = Branches(pair, mirror, np.array(symmetric), birth, marks, steps, FOLD)
    return Result(tuple(_rows(data)), data)


def _place(delta: float) -> tuple[float, float]:
    alpha, way, _ = state(delta, RHO)
    return alpha * float(PAPER.F), _x(way)


def _x(way: float) -> float:
    return float(PAPER.r) - way * float(PAPER.F / PAPER.omega**2)


def _rows(data: Branches) -> list[Comparison]:
    own, marks = certified.pitchfork(), data.landmarks
    above = data.pair[data.pair[:, 0] >= 0.4]
    numbers = turn(data.pair[:, 2])
    on = [step for step in data.sweep if step.f > data.pitchfork]
    beyond = [f"f = {step.f:.4f}" for step in on if _is_symmetric(step)]
    quarter = marks.resonances["1/4"]
    sc = 4 * (2 + 2 - math.pi) / math.pi**2
    return [
        proved("f at which the branch ends", "0.467", own["f"],
               "no fold is there but the pitchfork, at a smaller f; Newton's sweep passes it and "
               "goes on along the symmetric orbit, which is elliptic there"),
        claim("what happens there", "a fold: the orbit meets a saddle",
              "a pitchfork: both orbits of the pair meet the symmetric one, elliptic for larger f "
              "(proved)", False,
              "orbits come in mirror pairs; the saddle for smaller f is the symmetric one"),
        claim("x_* on [0.4, f_fold)", "increases", _direction(above),
              _direction(above) == "increases", "it does not",
              note="of this orbit of the pair; of its mirror image it decreases"),
        claim("rotation number", "decreases to 0 at f_fold",
              f"decreases to 0 at {data.pitchfork:.6f}",
              bool((np.diff(numbers[numbers > 0]) > 0).all()), "it does not decrease everywhere"),
        claim("rotation number 1/4", "close to, but distinct",
              f"taken at f = {quarter[0][:14]} (proved)", False,
              "every value from 0 to 0.40 is taken once; the sweep's 25 values miss it"),
        *(_taken(name, marks.resonances[name]) for name in ("1/5", "1/6")),
        claim("Newton's method converges in the sweep", "< 20 iterations",
              f"{max(step.steps for step in data.sweep)} at most",
              max(step.steps for step in data.sweep) < 20, "damping, or a later start"),
        roughly(claim("the orbit tracked up to f = 0.466", "is on the elliptic branch",
              f"on the symmetric one at {', '.join(beyond)}" if beyond else "is on that branch",
              not beyond, "the pair has merged with the symmetric orbit before; whether the last "
              "of the paper's 25 values is so large is not said")),
        number("exponent of rotation number over distance from the end", "0.5", _exponent(),
               "", note="as at a pitchfork, where trace - 2 is linear in f; a fold has 1/4"),
        number("f_sc", "0.34790", sc, note="the formula; what ends near there is the pair, at "
               f"f = {marks.end[0][:12]}, where its speed vanishes (proved)"),
        claim("what happens at f_sc", "a fold of the symmetric branch with turns",
              "nothing: no root of eq:theta-eq is an orbit (theorem `symmetric`)", False,
              "its formula moves right where it hits the left wall: see docs/paper.md"),
        claim("twist at f = 0.4", "well separated from zero",
              f"a zero at f = {marks.twist:.12f}", abs(marks.twist - float(PAPER.f)) > 0.01,
              f"f = 0.4 is {marks.twist - float(PAPER.f):.2e} below: hence the small tau_1 at P_*"),
    ]  # fmt: skip


def _taken(name: str, pair: Pair) -> Comparison:
    return claim(
        f"rotation number {name}", "passed (dotted line)", f"at f = {pair[0][:14]} (proved)", True
    )


def _is_symmetric(step: Step) -> bool:
    way, _ = symmetric_state(step.f / float(PAPER.F), RHO, 1)
    return abs(step.x - _x(way)) < ASYMMETRIC


def _direction(rows: Floats) -> str:
    """Say how x changes with f; the rows descend in f."""
    change = -np.diff(rows[:, 1])
    return "increases" if (change > 0).all() else "decreases" if (change < 0).all() else "neither"


def _exponent() -> float:
    """Fit the rotation number near the birth of the pair."""
    delta = np.geomspace(1e-4, 1e-2, 12)
    birth = float(certified.pitchfork()["f"][0])
    members = [pair_member(d, RHO) for d in delta.tolist()]
    f = np.array([m.alpha for m in members]) * float(PAPER.F)
    numbers = turn(np.array([m.trace for m in members]))
    return float(np.polyfit(np.log(birth - f), np.log(numbers), 1)[0])


FIGURE = Figure("the branch of the elliptic orbit over f", compute, "one_one:over_f", (7.8, 4.4))
