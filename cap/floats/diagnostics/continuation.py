"""Continuation of periodic orbits in a parameter, by pseudo-arclength, with their bifurcations.

Labels: ``fold``, ``flip`` (a multiplier -1: the period doubles, a branch of twice the period
begins), ``pitchfork`` (branches cross at an orbit that is its own mirror image), ``branch point``
(at another), ``grazing`` and ``sticking border`` (the itinerary changes:
`cap.floats.search.border`; "…, fold" if the branch turns back there), ``end`` with what is near,
``followed no further`` where all ``points`` are used.
"""

import itertools
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.arclength import FIRST, MOST, Change, CurveFollower, DoubledFollower
from cap.floats.search.curve import FixedPoints, Station
from cap.floats.search.cycles import near
from cap.floats.search.fixed_point import elliptic_point, fixed_point, polished
from cap.floats.variation import VARIABLE, value_of
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

LONGEST = 16  # period of the orbits that are followed, in units of T


@dataclass(frozen=True)
class Special:
    """A bifurcation or a border: where, on which branch, of which period."""

    label: str
    value: float
    x: float
    v: float
    trace: float
    branch: int
    period: int


@dataclass(frozen=True)
class Branch:
    """A curve of orbits of period n T, n = ``period``: arrays (N,) along it; ``hits`` and ``turns``
    in n periods, ``itinerary`` a number that changes where the itinerary does, or where a hit
    passes t = 0.

    ``stable``: elliptic or a sink.  Margins as in `cap.floats.search.border`, in natural units.
    """

    value: Floats
    x: Floats
    v: Floats
    trace: Floats
    determinant: Floats
    stable: NDArray[np.bool_]
    least_speed: Floats
    hit_speed: Floats
    hits: NDArray[np.int64]
    turns: NDArray[np.int64]
    itinerary: NDArray[np.int64]
    period: int


@dataclass(frozen=True, kw_only=True)
class Continuation(Findings):
    """Branches of periodic orbits over a parameter, and their special points.

    The first is of period n T, n = ``periods``; from flips on, others are of twice the period, ...
    """

    parameter: str
    periods: int
    branches: tuple[Branch, ...]
    special: tuple[Special, ...]

    def varying(self) -> dict[str, Floats]:
        """Return the values at which there is an orbit."""
        return {self.parameter: np.concatenate([branch.value for branch in self.branches])}

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return one row for each point of each branch."""
        joined = {
            name: np.concatenate([getattr(branch, name) for branch in self.branches])
            for name in Branch.__dataclass_fields__
            if name != "period"
        }
        sizes = [len(b.value) for b in self.branches]
        number = np.repeat(np.arange(len(self.branches)), sizes)
        period = np.repeat([b.period for b in self.branches], sizes)
        return {"branch": number, "period": period, self.parameter: joined.pop("value"), **joined}

    def lines(self) -> list[str]:
        """Return the special points."""
        periods = ", ".join(str(branch.period) for branch in self.branches)
        head = (
            f"{len(self.branches)} branches, of period {periods}, over {self.parameter} at "
            f"{described(self.parameters, self.varying())}"
        )
        rows = [
            f"  branch {each.branch + 1}  {self.parameter} = {each.value:<14.10g} {each.label:<22} "
            f"x = {each.x:< .8g}, v = {each.v:< .8g}, trace {each.trace:.6g}"
            for each in self.special
        ]
        return [head, *rows]


def continuation(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    orbit: State | None = None,
    parameter: str = "f",
    range: tuple[float, ...] | None = None,  # noqa: A002 (the option's name)
    period: int = 1,
    points: int = 1000,
    branches: int = 3,
    runner: Runner | None = None,
) -> Continuation:
    """Follow the orbit near ``orbit``, or the first elliptic one, both ways within a range.

    ``points`` at most, each way; at branch points the crossing branch is followed too, and at flips
    that of twice the period, as long as there are no more than ``branches``.
    """
    runner = runner or Runner()
    state = _start(p, orbit, period)
    family = FixedPoints(p, parameter, period)
    low, high = range or _range(p, parameter)
    if not low <= value_of(p, parameter) <= high:
        raise BadInput(
            f"{parameter} = {value_of(p, parameter):.6g} is not in [{low:.6g}, {high:.6g}]"
        )
    follower = CurveFollower(family, (low / family.unit[2], high / family.unit[2]), points, runner)
    start = family.station(family.point(state), np.array([0.0, 0.0, 1.0]))
    seeds = [_Seed(follower, start)]
    curves: list[tuple[FixedPoints, list[Station]]] = []
    special: list[Special] = []
    while seeds and len(curves) < branches and not runner.interrupted:
        seed = seeds.pop(0)
        if any(_is_on(seed.station.y, curve) for _, curve in curves):
            continue
        curve, changes = seed.follower.both_ways(seed.station)
        changes = [change for change in changes if not seed.is_born_at(change)]
        special += [_special(seed.follower.family, change, len(curves)) for change in changes]
        curves.append((seed.follower.family, curve))
        seeds += [new for change in changes for new in _crossing(seed.follower, change)]
        seeds += [new for change in changes for new in _doubled(seed.follower, change)]
    return Continuation(
        parameters=p,
        complete=not runner.interrupted,
        parameter=parameter,
        periods=period,
        branches=tuple(_branch(*each) for each in curves),
        special=_distinct(special),
    )


@dataclass(frozen=True)
class _Seed:
    """Where a branch is to be followed from; of a doubled one, the point of its birth, too."""

    follower: CurveFollower
    station: Station
    born: Floats | None = None

    def is_born_at(self, change: Change) -> bool:
        """Return whether a change is the flip where the branch crosses that of half its period."""
        if self.born is None:
            return False
        return bool(np.linalg.norm(change.station.y - self.born) < FIRST)


def _crossing(follower: CurveFollower, change: Change) -> list[_Seed]:
    """Return where the branch may be followed that crosses at a branch point."""
    if change.label not in ("pitchfork", "branch point"):
        return []
    return [_Seed(follower, station) for station in follower.switched(change.station)]


def _doubled(follower: CurveFollower, change: Change) -> list[_Seed]:
    """Return where the branch of twice the period may be followed that begins at a flip."""
    family = follower.family
    if change.label != "flip" or 2 * family.periods > LONGEST:
        return []
    twice = replace(family, periods=2 * family.periods)
    doubled = DoubledFollower(twice, follower.limits, follower.points, follower.runner)
    return [
        _Seed(doubled, station, change.station.y) for station in doubled.switched(change.station)
    ]


def _start(p: Parameters, orbit: State | None, period: int) -> State:
    if orbit is None:
        found = elliptic_point(p)
        if found is None or period > 1:
            raise BadInput("say which orbit is to be followed: --orbit X V")
        return found
    if period == 1:
        return fixed_point(p, orbit)
    cycle = near(p, *orbit, period)
    return polished(p, (cycle.x, cycle.v), period)


def _range(p: Parameters, name: str) -> tuple[float, float]:
    """Return the range in which a parameter is followed by default."""
    if name not in VARIABLE:
        raise BadInput(f"no such parameter: {name!r} (one of {', '.join(VARIABLE)})")
    value = value_of(p, name)
    limits = {
        "f": (0.0, float(p.F)),
        "F": (float(p.f), 5 * value),
        "e": (0.0, 1.0),
        "mu": (0.0, 1.0),
    }
    return limits.get(name, (value / 4, value * 4))


def _is_on(y: Floats, curve: list[Station]) -> bool:
    """Return whether a point is on a curve that is known."""
    points = np.array([station.y for station in curve])
    a, d = points[:-1], np.diff(points, axis=0)
    t = np.clip(((y - a) * d).sum(axis=1) / np.maximum((d * d).sum(axis=1), 1e-300), 0, 1)
    distance = np.linalg.norm(y - a - t[:, None] * d, axis=1)
    return bool(len(distance) and distance.min() < FIRST / 10)


def _special(family: FixedPoints, change: Change, branch: int) -> Special:
    x, v, value = (change.station.y * family.unit).tolist()
    return Special(change.label, value, x, v, change.station.trace, branch, family.periods)


def _distinct(special: list[Special]) -> tuple[Special, ...]:
    """Return them in the order of the parameter; a branch point is on both of its branches."""
    kept: list[Special] = []
    for each in sorted(special, key=lambda s: (s.value, s.branch)):
        same = (
            (each.label, each.x, each.v) == (k.label, k.x, k.v)
            or (
                each.label == k.label
                and max(abs(each.x - k.x), abs(each.v - k.v), abs(each.value - k.value)) < 1e-4
            )
            for k in kept
        )
        if not any(same):
            kept.append(each)
    return tuple(kept)


def _branch(family: FixedPoints, curve: list[Station]) -> Branch:
    y = np.array([station.y for station in curve]) * family.unit
    trace = np.array([s.trace for s in curve])
    det = np.array([s.determinant for s in curve])
    words = [s.margins.words for s in curve]
    speed = float(family.p.R * family.p.omega)
    return Branch(
        value=y[:, 2],
        x=y[:, 0],
        v=y[:, 1],
        trace=trace,
        determinant=det,
        stable=np.abs(trace) < 1 + det,
        least_speed=speed * np.array([s.margins.least_speed for s in curve]),
        hit_speed=speed * np.array([s.margins.hit_speed for s in curve]),
        hits=np.array([sum(w.startswith("hit") for w in each) for each in words]),
        turns=np.array([sum(w.startswith("turn") for w in each) for each in words]),
        itinerary=_numbered(curve),
        period=family.periods,
    )


def _numbered(curve: list[Station]) -> NDArray[np.int64]:
    """Return for each station how often the itinerary has changed, or the state has jumped."""
    change = [
        a.margins.words != b.margins.words or bool(np.linalg.norm(b.y - a.y) > 2 * MOST)
        for a, b in itertools.pairwise(curve)
    ]
    return np.concatenate([[0], np.cumsum(change)]).astype(np.int64)
