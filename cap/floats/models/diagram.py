"""A bifurcation diagram of a model: where orbits end over a parameter, and their exponents."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.attractor import ModelAttractors, attractors
from cap.floats.models.samples import exponents, least, samples
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel, Subject, about
from cap.runner import Runner

ORBITS, SHOWN, PERIODS = 8, 64, 200  # of each value: orbits, states shown, periods of exponents
SHIFT = Fraction(503, 1009)  # of values within their steps: no number of the model is 0 or 1 there
MOST = 4000  # values


@dataclass(frozen=True, kw_only=True)
class ModelDiagram(OfModel):
    """States (V, O, K, n) of orbits over the values (V,) of a parameter; nan where one is lost.

    ``exponent`` (V, O), the largest one per time; ``returns`` (V, O) the least period, 0: none;
    ``rested`` (V, O) whether contacts accumulated.
    """

    parameter: str
    value: Floats
    states: Floats
    exponent: Floats
    returns: NDArray[np.int64]
    rested: NDArray[np.bool_]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return a row for each state."""
        columns = dict(zip(self.state, np.moveaxis(self.states, 3, 0), strict=True))
        wide = {"exponent": self.exponent, "period": self.returns}
        wide = {name: q[:, :, None] for name, q in wide.items()}
        return {self.parameter: self.value[:, None, None], **wide, **columns}

    def lines(self) -> list[str]:
        """Return the windows in which all orbits have one period."""
        low, high = self.value[0], self.value[-1]
        head = f"attractors over {self.parameter} = {low:.6g} .. {high:.6g} of {self.described()}"
        return [head, *(f"  {row}" for row in self._windows())]

    def _windows(self) -> list[str]:
        """Return runs of values with the same periods, in words."""
        kinds = [
            (tuple(sorted({int(p) for p in row})), bool(rest.any()), bool((x > 1e-3).any()))
            for row, rest, x in zip(self.returns, self.rested, self.exponent, strict=True)
        ]
        cuts = [k for k in range(1, len(kinds)) if kinds[k] != kinds[k - 1]]
        rows = []
        for a, b in zip([0, *cuts], [*cuts, len(kinds)], strict=True):
            periods, rest, chaos = kinds[a]
            words = ", ".join(f"period {p}" if p else "no short period" for p in periods)
            words += ", contacts accumulate" if rest else ""
            words += ", a positive exponent" if chaos else ""
            last = f" .. {self.value[b - 1]:.5g}" if b - 1 > a else ""
            rows.append(f"{self.value[a]:.5g}{last}  {words}")
        long = len(rows) > 40
        return [*rows[:40], *([f"… {len(rows) - 40} more windows"] if long else [])]


def attractor(  # noqa: PLR0913 (the options of the command)
    subject: Subject,
    *,
    parameter: str | None = None,
    range: tuple[Fraction, ...] | None = None,  # noqa: A002 (the option's name)
    box: tuple[float, ...] | None = None,
    points: int | None = None,
    transient: int | None = None,
    plane: tuple[str, ...] | None = None,
    runner: Runner | None = None,
) -> ModelAttractors | ModelDiagram:
    """Return the attractors; over a range of a parameter a diagram of ``points`` values."""
    if (parameter is None) != (range is None):
        raise BadInput("--parameter NAME needs --range A B, and the other way round")
    if parameter is None or range is None:
        return attractors(
            subject, box=box, points=points or 400, transient=_or(transient, 1000), plane=plane,
            runner=runner)  # fmt: skip
    return diagram(
        subject, parameter, range, box=box, points=points or 300, transient=_or(transient, 300),
        runner=runner or Runner())  # fmt: skip


def _or(value: int | None, default: int) -> int:
    return default if value is None else value


def diagram(  # noqa: PLR0913
    subject: Subject,
    parameter: str,
    limits: tuple[Fraction, ...],
    *,
    box: tuple[float, ...] | None,
    points: int,
    transient: int,
    runner: Runner,
) -> ModelDiagram:
    """Return where orbits from the same box end, at values within the limits."""
    low, high = limits
    subject.at(parameter, low), subject.at(parameter, high)  # both must be possible
    if not low < high or points > MOST:
        raise BadInput(f"--range must be A < B, with at most {MOST} values: {low} {high}")
    values = [low + (k + SHIFT) * (high - low) / points for k in np.arange(points).tolist()]
    middle = subject.at(parameter, values[points // 2])
    ranges = middle.ranges(box)

    def settle(value: Fraction) -> tuple[Floats, Floats, NDArray[np.int64], NDArray[np.bool_]]:
        model = subject.at(parameter, value)
        return _settled(model, model.seeds(ORBITS, ranges), transient)

    done = runner.map(settle, values, "attractors")
    if not done:
        raise BadInput("interrupted before anything was done")
    states, exponent, returns, rested = (np.array(part) for part in zip(*done, strict=True))
    return ModelDiagram(
        **about(subject, parameter),
        complete=not runner.interrupted,
        parameter=parameter,
        value=np.array([float(value) for value in values[: len(done)]]),
        states=states,
        exponent=exponent,
        returns=returns,
        rested=rested,
    )


def _settled(
    subject: Subject, seeds: Floats, transient: int
) -> tuple[Floats, Floats, NDArray[np.int64], NDArray[np.bool_]]:
    """Return states, exponents, periods of orbits after a transient; if contacts accumulate."""
    engine = subject.engine
    late = engine.follow(seeds, engine.begun(seeds), periods=max(1, transient))
    found = samples(subject, late.states, late.modes, SHOWN)
    well = np.isfinite(found.ends).all(axis=1)
    exponent = np.full(len(seeds), np.nan)
    if well.any():
        exponent[well] = exponents(subject, found.ends[well], found.modes[well], PERIODS)[0][:, 0]
    scaled = (path / (1 + np.abs(path).max()) for path in found.states)
    returns = np.array([least(path, len(path) // 4) for path in scaled])
    return found.states, exponent, returns, found.counts[:, -1] > 0
