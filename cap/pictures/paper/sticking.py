"""An orbit that comes to stick-slip, two neighbours, and hits that accumulate."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase

from cap.floats.diagnostics.chatter import Chatter
from cap.floats.diagnostics.trajectory import Trajectory
from cap.pictures import times
from cap.pictures.style import BLUE, GREY, ORANGE, RED, UNITS, walls

if TYPE_CHECKING:
    from cap.paper.sticking import Panels


def sticking(data: "Panels", figure: FigureBase) -> None:
    """Draw the three panels."""
    axes = figure.subplot_mosaic([["a", "a"], ["b", "c"]], width_ratios=[1.15, 1])
    times.position(axes["a"], data.slow)
    axes["a"].set_title(f"(a) $F = {_force(data.slow)}$, from $(0, 1.5)$", loc="left")
    axes["a"].legend(ncols=3, loc="upper right")
    _shadow(axes["b"], data)
    _accumulation(axes["c"], data.captured)
    figure.suptitle("Sticking, neighbours, and hits that accumulate\n"
                    r"$\omega = 1,\ f = 0.4,\ R = 2$", fontsize=10)  # fmt: skip


def _force(orbit: Trajectory) -> str:
    return f"{float(orbit.parameters.F):g}"


def _shadow(axes: Axes, data: "Panels") -> None:
    for orbit, colour in zip(data.two, (BLUE, ORANGE), strict=True):
        label = rf"$v_0 = {orbit.v[0]:g}$"
        axes.plot(orbit.x, orbit.v, color=colour, lw=0.8, label=label)
    walls(axes, data.slow.parameters, over_time=False)
    axes.axhline(0, color=GREY, lw=0.5)
    axes.set_xlabel(UNITS["x"])
    axes.set_ylabel(UNITS["v"])
    axes.set_title(f"(b) $F = {_force(data.two[0])}$, from $x_0 = -0.95$, $4T$", loc="left")
    axes.legend(loc="center", bbox_to_anchor=(0.8, 0.45))


def _accumulation(axes: Axes, caught: Chatter) -> None:
    k = np.arange(1, len(caught.times) + 1)
    axes.semilogy(k, caught.speeds, "o", ms=3.5, mfc="white", mec=BLUE, label="speed after hit $k$")
    left = np.maximum(caught.end - caught.times, 1e-16)
    axes.semilogy(k, left, "s", ms=3, mfc="white", mec=RED, label=r"$t_\infty - t_k$")
    axes.set_xlabel("hit $k$ of the right wall")
    axes.set_ylabel("[length / time], [time]")
    axes.set_title(f"(c) $F = 1$, from $(0.99, 0.01)$: $t_\\infty = {caught.end:.5f}$", loc="left")
    axes.legend(loc="lower left")
