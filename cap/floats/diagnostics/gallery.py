"""A gallery of regimes: the attractor of most seeds at several forcings."""

from dataclasses import dataclass
from fractions import Fraction
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.diagnostics.attractor import Attractor, strongest
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.findings import Findings, Floats
from cap.floats.variation import varied
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

FORCINGS = (1.5, 3.0, 4.5, 6.0, 12.0, 50.0)
LEAST = 4  # forcing periods shown


@dataclass(frozen=True, kw_only=True)
class Gallery(Findings):
    """Orbits on attractors at the values (L,) of a parameter.

    ``trace`` and ``determinant`` (L,) are those of the monodromy over one period of the orbit, nan
    if it has none.
    """

    parameter: str
    values: Floats
    attractors: tuple[Attractor, ...]
    orbits: tuple[Trajectory, ...]
    trace: Floats
    determinant: Floats

    def varying(self) -> dict[str, Floats]:
        """Return the values of the parameter."""
        return {self.parameter: self.values}

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return one row for each value."""
        found = self.attractors
        return {
            self.parameter: self.values,
            "period": np.array([each.period for each in found]),
            "x": np.array([orbit.strobe[0, 0] for orbit in self.orbits]),
            "v": np.array([orbit.strobe[0, 1] for orbit in self.orbits]),
            "hits_r": np.array([each.hits[0] for each in found]),
            "hits_l": np.array([each.hits[1] for each in found]),
            "turns": np.array([each.turns for each in found]),
            "trace": self.trace,
            "determinant": self.determinant,
        }

    def lines(self) -> list[str]:
        """Return the attractors."""
        head = f"regimes at {described(self.parameters, self.varying())}"
        rows = zip(self.values, self.attractors, self.trace, self.determinant, strict=True)
        return [
            head,
            *(
                f"  {self.parameter} = {value:<6.6g} {each.line()}"
                + (f"; trace {trace:.5g}, det {det:.5g}" if isfinite(trace) else "")
                for value, each, trace, det in rows
            ),
        ]


def gallery(
    p: Parameters,
    *,
    parameter: str = "F",
    values: tuple[float | Fraction, ...] = FORCINGS,
    periods: float | None = None,
    runner: Runner | None = None,
) -> Gallery:
    """Return the orbit of the attractor of most seeds, over some periods, at each value.

    By default these are so many that the longest period found is seen, and at least four.
    """
    runner = runner or Runner()
    systems = [varied(p, parameter, value) for value in values]
    found = runner.map(strongest, systems, "gallery", processes=True)
    shown = periods or max([LEAST, *(each.period for each in found if each)])
    kept = [
        (float(value), *_regime(system, each, shown))
        for value, system, each in zip(values, systems, found, strict=False)
        if each
    ]
    if not kept and not runner.interrupted:
        raise BadInput("no orbit could be followed at any of the values: the mass is too fast")
    return Gallery(
        parameters=p,
        complete=not runner.interrupted,
        parameter=parameter,
        values=np.array([each[0] for each in kept]),
        attractors=tuple(each[1] for each in kept),
        orbits=tuple(each[2] for each in kept),
        trace=np.array([each[3] for each in kept]),
        determinant=np.array([each[4] for each in kept]),
    )


def _regime(
    p: Parameters, found: Attractor, periods: float
) -> tuple[Attractor, Trajectory, float, float]:
    """Return an attractor, its orbit, and trace and determinant of a cycle."""
    state = float(found.states[0, 0]), float(found.states[0, 1])
    orbit = trajectory(p, orbit=state, exactly=True, periods=periods)
    if not found.period:
        return found, orbit, np.nan, np.nan
    monodromy = swarm.follow(p, [state], found.period, derivative=True).monodromy
    (a, b), (c, d) = monodromy[0] if monodromy is not None else np.full((2, 2), np.nan)
    return found, orbit, float(a + d), float(a * d - b * c)
