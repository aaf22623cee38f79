"""The release map for a picture: its graph with an orbit on it, or its orbits over a parameter."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.engine.events import HIT, TURN
from cap.floats.engine.releases import Images, images
from cap.floats.findings import Findings, Floats
from cap.floats.search.release_cycles import settled
from cap.floats.variation import value_of, varied
from cap.floats.words import described
from cap.parameters import Parameters
from cap.release.trap import critical_points, trap
from cap.runner import Runner

TRANSIENT = 60  # iterates
STARTS = 4  # orbits for each value of a parameter
SAME = 1e-4  # of R: iterates so close may be the same
COBWEB = 60  # steps
PIECES = 8
NO_TRAP = np.full(3, np.nan)
FIELDS: tuple[tuple[str, tuple[int, ...], type], ...] = (
    ("value", (), float),
    ("slope", (), float),
    ("half_periods", (), int),
    ("counts", (9,), int),
)
NEAR = 0.05  # of the parameter, to both sides, if no range is given


@dataclass(frozen=True, kw_only=True)
class ReleaseMap(Findings):
    """G at places x (N,): see `cap.floats.engine.releases.Images`.

    ``branch`` (N,) numbers branches, ``hits`` (N,) and ``turns`` (N,) count events up to the next
    release.

    ``orbit`` (M,) are iterates of one place, ``late`` (K,) those of several after a transient.
    ``interval`` (2,) is one that G maps into itself with one turning point ``critical``; nan if
    none was found.
    """

    x: Floats
    value: Floats
    slope: Floats
    half_periods: NDArray[np.int64]
    hits: NDArray[np.int64]
    turns: NDArray[np.int64]
    branch: NDArray[np.int64]
    orbit: Floats
    late: Floats
    interval: Floats
    critical: float

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the graph."""
        return {
            "x": self.x,
            "G": self.value,
            "slope": self.slope,
            "half_periods": self.half_periods,
            "hits": self.hits,
            "turns": self.turns,
            "branch": self.branch,
        }

    def lines(self) -> list[str]:
        """Return what was found."""
        low, high = self.interval
        lost = float(np.isnan(self.value).mean())
        trapped = (
            f"  mapped into itself with one itinerary: [{low:.6g}, {high:.6g}], G' = 0 at "
            f"{self.critical:.10g}"
            if np.isfinite(low)
            else "  no interval was found that is mapped into itself with one itinerary, one turn"
        )
        return [
            f"release map at {described(self.parameters)}: {len(self.x)} places",
            f"  {self.branch.max() + 1} branches seen; no next release found from {lost:.2%}",
            trapped,
        ]


@dataclass(frozen=True, kw_only=True)
class ReleaseOrbits(Findings):
    """Late iterates ``late`` (K, M) of the release map over a parameter with ``values`` (K,).

    ``exponent`` (K,): the mean of log|G'| along them; negative in windows of attracting cycles.
    ``period`` (K,): that of the attracting cycles near which all of them are, at most half the
    number of iterates (see `cap.floats.search.release_cycles.settled`), 0 if none was found.
    """

    parameter: str
    values: Floats
    late: Floats
    exponent: Floats
    period: NDArray[np.int64]

    def windows(self) -> list[tuple[float, float, int]]:
        """Return runs of two or more values with one period: their ends, and the period."""
        cuts = np.flatnonzero(np.diff(self.period)) + 1
        runs = [run for run in np.split(np.arange(len(self.period)), cuts) if len(run) > 1]
        ends = [(run[0], run[-1]) for run in runs if self.period[run[0]]]
        return [
            (float(self.values[a]), float(self.values[b]), int(self.period[a])) for a, b in ends
        ]

    def varying(self) -> dict[str, Floats]:
        """Return the values of the parameter."""
        return {self.parameter: self.values}

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the iterates."""
        return {
            self.parameter: self.values[:, None],
            "exponent": self.exponent[:, None],
            "period": self.period[:, None],
            "x": self.late,
        }

    def lines(self) -> list[str]:
        """Return how often the exponent is positive."""
        positive = int((self.exponent > 0).sum())
        return [
            f"orbits of the release map over {self.parameter} at "
            f"{described(self.parameters, self.varying())}: {len(self.values)} values",
            f"  mean of log |G'| positive at {positive} of them",
            *(f"  window of period {p} seen: {a:.6g} .. {b:.6g}" for a, b, p in self.windows()),
        ]


def release(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    points: int | None = None,
    start: tuple[float, ...] | None = None,
    parameter: str | None = None,
    range: tuple[float, ...] | None = None,  # noqa: A002 (the option)
    iterates: int = 40,
    runner: Runner | None = None,
) -> ReleaseMap | ReleaseOrbits:
    """Return the graph of the release map, or its late iterates over a parameter."""
    runner = runner or Runner()
    if not p.f:
        raise BadInput("without friction no mass sticks: f > 0 is needed")
    if parameter is None:
        if range:
            raise BadInput("--range is that of a --parameter")
        return graph(p, points or 4000, start, iterates, runner)
    values = np.linspace(*_limits(p, parameter, range), points or 400)
    return over(p, parameter, values, iterates, runner)


def graph(
    p: Parameters, points: int, start: tuple[float, ...] | None, iterates: int, runner: Runner
) -> ReleaseMap:
    """Return the release map at places between the walls."""
    l, R = float(p.l), float(p.R)
    x = l + R * (np.arange(points) + 0.5) / points
    first = start[0] if start else l + 0.3 * R
    if not l < first < l + R:
        raise BadInput(f"--start must lie between the walls: {first:.6g}")
    parts = runner.map(lambda piece: images(p, piece), np.array_split(x, PIECES), "release map")
    found = _joined(parts, points)
    tasks: list[Callable[[], Floats]] = [
        lambda: _orbit(p, first, COBWEB),
        lambda: late(p, iterates)[0],
        lambda: _trap(p),
    ]
    more = [] if runner.interrupted else runner.map(_called, tasks, "its orbits")
    orbit, settled, trapped = more if len(more) == 3 else (np.array([first]), np.empty(0), NO_TRAP)
    return ReleaseMap(
        parameters=p,
        complete=not runner.interrupted,
        x=x,
        value=found.value,
        slope=found.slope,
        half_periods=found.half_periods,
        hits=found.counts[:, HIT : HIT + 2].sum(axis=1),
        turns=found.counts[:, TURN : TURN + 2].sum(axis=1),
        branch=_branches(found),
        orbit=orbit,
        late=settled,
        interval=trapped[:2],
        critical=float(trapped[2]),
    )


def _called(task: Callable[[], Floats]) -> Floats:
    return task()


def _joined(parts: list[Images], points: int) -> Images:
    """Return the images of all pieces that are done; of the rest there are none."""
    done = [
        np.concatenate([getattr(part, name) for part in parts] or [np.empty((0, *shape), kind)])
        for name, shape, kind in FIELDS
    ]
    rest = points - len(done[0])
    fill = (np.nan, np.nan, 0, 0)
    padded = [
        np.concatenate([each, np.full((rest, *each.shape[1:]), value, dtype=each.dtype)])
        for each, value in zip(done, fill, strict=True)
    ]
    return Images(*padded)


def _branches(found: Images) -> NDArray[np.int64]:
    """Return a number for each run of places with the same events, as far as their counts tell."""
    kinds = np.column_stack([found.half_periods, found.counts])
    change = (kinds[1:] != kinds[:-1]).any(axis=1)
    return np.concatenate([[0], np.cumsum(change)])


def _orbit(p: Parameters, x: float, steps: int) -> Floats:
    places = [x]
    for _ in np.arange(steps):
        places.append(float(images(p, places[-1:]).value[0]))
    return np.array(places)


def late(p: Parameters, iterates: int) -> tuple[Floats, float]:
    """Return late iterates (`STARTS` * iterates,) and the mean of log|G'| along them."""
    x = float(p.l) + float(p.R) * (np.arange(STARTS) + 0.5) / STARTS
    seen, growth = [], []
    for n in np.arange(TRANSIENT + iterates):
        found = images(p, x)
        if n >= TRANSIENT:
            seen.append(x)
            growth.append(found.slope)
        x = found.value
    with np.errstate(divide="ignore"):
        logs = np.log(np.abs(np.concatenate(growth)))
    known = logs[~np.isnan(logs)]
    return np.concatenate(seen), float(known.mean()) if len(known) else np.nan


def _late(p: Parameters, iterates: int) -> tuple[Floats, float, int]:
    """Return late iterates, the mean of log|G'|, and the period of the cycles that they are on."""
    found, growth = late(p, iterates)
    return found, growth, settled(p, found.reshape(iterates, STARTS), SAME)


def _trap(p: Parameters) -> Floats:
    """Return the ends of an interval and its critical point, nan if none is found."""
    for c in critical_points(p):
        try:
            found = trap(p, c)
        except BadInput:
            continue
        return np.array([float(found.lower), float(found.upper), c])
    return NO_TRAP


def _limits(p: Parameters, name: str, given: tuple[float, ...] | None) -> tuple[float, float]:
    value = value_of(p, name)
    low, high = given or (value * (1 - NEAR), value * (1 + NEAR))
    if not low < high:
        raise BadInput(f"--range must be increasing: {low:.6g}, {high:.6g}")
    for end in (low, high):
        varied(p, name, end)
    return low, high


def over(p: Parameters, name: str, values: Floats, iterates: int, runner: Runner) -> ReleaseOrbits:
    """Return late iterates over a parameter."""
    tasks = values.tolist()
    found = runner.map(lambda value: _late(varied(p, name, value), iterates), tasks, "releases")
    places = np.full((len(values), STARTS * iterates), np.nan)
    exponent, period = np.full(len(values), np.nan), np.zeros(len(values), dtype=np.int64)
    for k, each in enumerate(found):
        places[k], exponent[k], period[k] = each
    return ReleaseOrbits(
        parameters=p,
        complete=not runner.interrupted,
        parameter=name,
        values=values,
        late=places,
        exponent=exponent,
        period=period,
    )
