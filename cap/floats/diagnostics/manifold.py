"""Stable and unstable manifolds of a saddle of Φ, and their intersections: homoclinic points."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.engine.reversal import retrace
from cap.floats.findings import Findings, Floats, State
from cap.floats.search import orbits, periodic
from cap.floats.search.fixed_point import fixed_point, polished
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

START = 1e-6  # distance from the saddle at which a manifold begins, in units of R and Rω
MOST = 30_000  # points of a branch
FIRST = 200  # points of a fundamental domain to begin with
NOTHING = 1e-12  # a multiplier so small is 0: the orbit sticks
WEAK = 1e-6  # a multiplier so near 1 moves nothing
PAIRS = 2_000_000  # of segments, at a time

Places = NDArray[np.int64]
Map = Callable[[Floats, int], Floats]


class Crossings(NamedTuple):
    """Points (H, 2) at which two curves cross, and the angles (H,) in degrees."""

    points: Floats
    angles: Floats


@dataclass(frozen=True, kw_only=True)
class Manifolds(Findings):
    """The manifolds (K, 2) of a saddle as curves; rows of nan part their pieces.

    ``homoclinic`` (H, 2) are crossings, as exact as the curves' spacing; ``angles`` (H,) in
    degrees, in the plane in which R and Rω have the length 1.
    """

    saddle: State
    multipliers: tuple[float, float]
    unstable: Floats
    stable: Floats
    homoclinic: Floats
    angles: Floats

    def columns(self) -> dict[str, Floats]:
        """Return the points of W^u, W^s and the homoclinic ones: ``kind`` 1, -1, 0."""
        parts = (self.unstable, 1.0), (self.stable, -1.0), (self.homoclinic, 0.0)
        kind = np.concatenate([np.full(len(points), k) for points, k in parts])
        points = np.concatenate([points for points, _ in parts])
        return {"kind": kind, "x": points[:, 0], "v": points[:, 1]}

    def lines(self) -> list[str]:
        """Return the multipliers and the number of crossings."""
        (x, v), (large, small) = self.saddle, self.multipliers
        angles = np.sort(self.angles)
        points = [int(np.isfinite(each[:, 0]).sum()) for each in (self.unstable, self.stable)]
        shown = f", angles from {angles[0]:.3g} to {angles[-1]:.3g} degrees" if len(angles) else ""
        return [
            f"saddle ({x:.10g}, {v:.10g}) at {described(self.parameters)}",
            f"  multipliers {large:.8g} and {small:.8g}",
            f"  {points[0]} points of the unstable, {points[1]} of the stable one",
            f"  {len(self.homoclinic)} homoclinic points{shown}",
        ]


def manifolds(
    p: Parameters,
    *,
    orbit: State | None = None,
    length: float = 4.0,
    spacing: float = 0.005,
    periods: int = 40,
    runner: Runner | None = None,
) -> Manifolds:
    """Grow the four branches up to a ``length`` in units of R and Rω, or for some ``periods``.

    Points are at most ``spacing`` apart, in the same units, as far as `MOST` points reach.  The
    unstable manifold is cut where orbits stick, which many do at once.
    """
    runner = runner or Runner()
    if not p.conserves:
        raise BadInput("the stable manifold is grown for e = 1 and mu = 0 only")
    state = _saddle(p, orbit)
    scale = np.array([float(p.R), float(p.R * p.omega)])
    values, vectors = _eigen(p, state, scale)

    def forward(points: Floats, times: int) -> Floats:
        found = swarm.follow(p, points * scale, times)
        found.states[found.stuck | found.captured] = np.nan
        return np.asarray(found.states / scale)

    def backward(points: Floats, times: int) -> Floats:
        return np.asarray(retrace(p, points * scale, times) / scale)

    maps: tuple[Map, Map] = forward, backward

    def grown(side: tuple[int, int]) -> tuple[int, Floats]:
        k, sign = side
        stretch = values[0] if k == 0 else 1 / values[1]
        begin = np.array(state) / scale, sign * vectors[:, k]
        return k, _branch(maps[k], begin, stretch, (length, spacing, periods))

    curves = runner.map(grown, [(0, 1), (0, -1), (1, 1), (1, -1)], "manifolds")
    unstable, stable = (_joined([part for j, part in curves if j == k]) for k in (0, 1))
    found = crossings(unstable, stable)
    away = np.hypot(*(found.points - np.array(state) / scale).T) > 10 * START
    return Manifolds(
        parameters=p,
        complete=not runner.interrupted,
        saddle=state,
        multipliers=(float(values[0]), float(values[1])),
        unstable=unstable * scale,
        stable=stable * scale,
        homoclinic=found.points[away] * scale,
        angles=found.angles[away],
    )


def _saddle(p: Parameters, orbit: State | None) -> State:
    """Return the fixed point near a state, or the weakest saddle that is found, polished."""
    if orbit is not None:
        return fixed_point(p, orbit)
    found = periodic.orbits(p, 2)
    saddles = [(abs(g.trace), (g.x, g.v)) for g in found if g.kind == "saddle"] or [
        (abs(c.trace), (c.x, c.v))
        for c in orbits.search(p).isolated
        if c.kind(conserves=True).endswith("saddle") and abs(c.determinant) > NOTHING
    ]
    if not saddles:
        raise BadInput("no saddle was found: give a state near one with --orbit")
    return polished(p, min(saddles)[1])


def _eigen(p: Parameters, state: State, scale: Floats) -> tuple[Floats, Floats]:
    """Return the multipliers, the larger first, and their unit vectors, as columns, scaled."""
    found = swarm.follow(p, [state], 1, derivative=True).monodromy
    if found is None or not np.isfinite(found).all():
        raise BadInput("the saddle hits a wall with speed 0: it has no manifolds")
    values, vectors = np.linalg.eig(found[0] / scale[:, None] * scale)
    order = np.argsort(-np.abs(values))
    if not (np.isreal(values).all() and abs(values[order[1]]) > NOTHING):
        raise BadInput("no saddle with two manifolds: its multipliers are not real, or one is 0")
    if not abs(values[order[0]]) > 1 + WEAK > 1 - WEAK > abs(values[order[1]]):
        shown = " and ".join(f"{values[k]:.6g}" for k in order)
        raise BadInput(f"no saddle, or too weak a one: its multipliers are {shown}")
    return np.real(values[order]), np.real(vectors[:, order])


def _branch(
    image: Map, begin: tuple[Floats, Floats], stretch: float, limits: tuple[float, float, int]
) -> Floats:
    """Return one side of a manifold, from a fundamental domain and its images.

    The domain is P + δ |λ|^τ e, 0 <= τ <= 1; if λ < 0 every second image is on this side.
    """
    (centre, direction), (length, spacing, periods) = begin, limits
    step = 1 if stretch > 0 else 2
    rate = math.log(abs(stretch)) * step
    tau, grown, parts = np.linspace(0, 1, FIRST), 0.0, []

    def at(tau: Floats, times: int) -> Floats:
        start = centre + START * np.exp(rate * tau)[:, None] * direction
        return image(start, times) if times else start

    for times in range(0, periods + 1, step):
        tau, points = _refined(tau, lambda tau, times=times: at(tau, times), spacing)  # type: ignore[misc]
        gaps = np.hypot(*np.diff(points, axis=0).T)
        parts.append(np.where(np.append(gaps, 0)[:, None] > 5 * spacing, np.nan, points))
        grown += float(np.nansum(gaps))
        if grown > length or not np.isfinite(points).any() or sum(map(len, parts)) >= MOST:
            break
    return np.concatenate(parts)


def _refined(tau: Floats, at: Callable[[Floats], Floats], spacing: float) -> tuple[Floats, Floats]:
    """Return parameters and points such that neighbours are near, as far as `MOST` reach."""
    points = at(tau)
    for _ in range(40):
        gaps = np.hypot(*np.diff(points, axis=0).T)
        edge = np.isnan(points[1:, 0]) != np.isnan(points[:-1, 0])
        far = np.flatnonzero(((gaps > spacing) | edge) & (np.diff(tau) > 1e-9))
        if not len(far) or len(tau) + len(far) > MOST:
            break
        middle = (tau[far] + tau[far + 1]) / 2
        tau = np.insert(tau, far + 1, middle)
        points = np.insert(points, far + 1, at(middle), axis=0)
    return tau, points


def _joined(parts: list[Floats]) -> Floats:
    """Return curves as one, with rows of nan between them."""
    rows = [row for part in parts for row in (part, np.full((1, 2), np.nan))]
    return np.concatenate(rows)[:-1] if rows else np.empty((0, 2))


def crossings(first: Floats, second: Floats) -> Crossings:
    """Return where two polygons (N, 2), (M, 2) cross; rows of nan part their pieces."""
    a, b = (np.stack([curve[:-1], curve[1:]], axis=1) for curve in (first, second))
    a, b = (each[np.isfinite(each).all(axis=(1, 2))] for each in (a, b))
    if not len(a) or not len(b):
        return Crossings(np.empty((0, 2)), np.empty(0))
    found = [_met(a[i], b[j]) for i, j in _neighbours(a, b)]
    return Crossings(*(np.concatenate(each) for each in zip(*found, strict=True)))


def _met(a: Floats, b: Floats) -> Crossings:
    """Return where the segments of pairs (N, 2, 2), (N, 2, 2) cross."""
    p, d = a[:, 0], a[:, 1] - a[:, 0]
    q, e = b[:, 0], b[:, 1] - b[:, 0]
    cross = d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        w = q - p
        s = (w[:, 0] * e[:, 1] - w[:, 1] * e[:, 0]) / cross
        t = (w[:, 0] * d[:, 1] - w[:, 1] * d[:, 0]) / cross
        meet = (s >= 0) & (s < 1) & (t >= 0) & (t < 1)
        angle = np.degrees(np.arctan2(np.abs(cross), np.abs((d * e).sum(axis=1))))
    return Crossings((p + s[:, None] * d)[meet], angle[meet])


def _neighbours(a: Floats, b: Floats) -> Iterator[tuple[Places, Places]]:
    """Give the pairs of segments that may meet: their middles are in neighbouring cells."""
    cell = max(float(np.abs(each[:, 1] - each[:, 0]).max()) for each in (a, b)) * 1.01
    low = np.minimum(a.min(axis=(0, 1)), b.min(axis=(0, 1)))
    places = [np.floor((each.mean(axis=1) - low) / cell).astype(np.int64) + 1 for each in (a, b)]
    width = max(int(place[:, 1].max()) for place in places) + 3
    keys = [place[:, 0] * width + place[:, 1] for place in places]
    order = np.argsort(keys[1], kind="stable")
    for shift in [dx * width + dy for dx in (-1, 0, 1) for dy in (-1, 0, 1)]:
        start = np.searchsorted(keys[1][order], keys[0] + shift, "left")
        count = np.searchsorted(keys[1][order], keys[0] + shift, "right") - start
        before = np.cumsum(count) - count
        for own in np.split(np.arange(len(a)), np.flatnonzero(np.diff(before // PAIRS)) + 1):
            i, many = np.repeat(own, count[own]), count[own]
            inner = np.arange(len(i)) - np.repeat(before[own] - before[own[0]], many)
            yield i, order[np.repeat(start[own], many) + inner]
