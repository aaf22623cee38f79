"""Rows of orbits in time, each beside its phase plane or its portrait; one orbit alone."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase

from cap.floats.diagnostics.trajectory import Trajectory
from cap.floats.findings import Floats
from cap.pictures import times
from cap.pictures.style import BLUE, SKY, UNITS, dots, framed, legend, parameters

if TYPE_CHECKING:
    from cap.paper.rows import Row, Rows


def rows(data: "Rows", figure: FigureBase) -> None:
    """Draw each orbit x(t), with the forcing, beside its phase plane or portrait."""
    shown = data.rows
    axes = figure.subplots(len(shown), 2, squeeze=False, width_ratios=[2.2, 1])
    handles: dict[str, Artist] = {}
    for k, (row, (left, right)) in enumerate(zip(shown, axes, strict=True)):
        if data.forcing:
            _forcing(left, row.orbit)
        times.position(left, row.orbit)
        if row.portrait is None:
            times.plane(right, row.orbit)
        else:
            _portrait(right, row.portrait)
        if any(each.portrait is not None for each in shown):
            right.set_title(_kind(row), loc="left")
        left.set_title(row.title, loc="left")
        for each in (left, right):
            each.set_xlabel(each.get_xlabel() if k == len(shown) - 1 else "")
        left.set_ylabel("$x$  [length]")
        right.set_ylabel(r"$\dot x$  [length / time]")
        for each in (left, right):
            found, labels = each.get_legend_handles_labels()
            handles |= dict(zip(labels, found, strict=True))
    figure.legend(handles=list(handles.values()), loc="outside lower center", ncols=8,
                  columnspacing=1.2)  # fmt: skip
    given = parameters(shown[0].orbit.parameters, but=data.but)
    figure.suptitle(f"{data.heading}\n{given}", fontsize=10)


def _kind(row: "Row") -> str:
    many = "" if row.portrait is None else f"{len(row.portrait)} iterates of $\\Phi$"
    return (many or "phase plane") + row.words


def _forcing(axes: Axes, orbit: Trajectory) -> None:
    """Draw the forcing, to fit between the walls."""
    p = orbit.parameters
    t = np.linspace(0, orbit.t[-1], 1000)
    middle, half = float(p.l + p.r) / 2, 0.8 * float(p.R) / 2
    axes.plot(t / orbit.period, middle + half * np.cos(float(p.omega) * t), color=SKY, lw=0.8,
              alpha=0.6, label=r"forcing $F\cos\omega t$ (scaled)")  # fmt: skip


def _portrait(axes: Axes, states: Floats) -> None:
    size = 16.0 if np.ptp(states, axis=0).max() < 1e-6 else 1.5
    dots(axes, states, BLUE, size)
    framed(axes, states.min(axis=0), states.max(axis=0), 0.15, 0.002)
    axes.locator_params(nbins=4)
    axes.set_xlabel(UNITS["x"])


def orbit(data: Trajectory, figure: FigureBase) -> None:
    """Draw one orbit in time and in the plane."""
    axes = figure.subplots(1, 2)
    times.position(axes[0], data)
    times.plane(axes[1], data)
    legend(axes[1], figure, 8)
    given = parameters(data.parameters)
    figure.suptitle(f"The elliptic orbit that never turns\n{given}", fontsize=10)
