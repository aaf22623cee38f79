"""How many T-periodic orbits there are over F, by type."""

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import FigureBase
from matplotlib.ticker import MaxNLocator

from cap.floats.search.inventory import KINDS
from cap.parameters import PAPER
from cap.pictures.diagrams import TYPE_COLOURS
from cap.pictures.style import BLACK, ORANGE, RED, legend, parameters

if TYPE_CHECKING:
    from cap.paper.forcing import Counted


def forcing(data: "Counted", figure: FigureBase) -> None:
    """Draw the counts by type, and the paper's."""
    axes = figure.subplots()
    places = np.arange(len(data.forces), dtype=float)
    for shift, found, words in ((-0.21, data.paper, "paper"), (0.21, data.thorough, "")):
        below = np.zeros(len(places))
        for kind in KINDS:
            heights = np.array([sum(c.kind(conserves=True) == kind for c in o) for o in found])
            if heights.any() or not words:
                used = any(c.kind(conserves=True) == kind for o in data.thorough for c in o)
                axes.bar(places + shift, heights, 0.38, below, color=TYPE_COLOURS[kind], ec=BLACK,
                         lw=0.4, hatch="////" if words else None,
                         label=kind if used and not words else None)  # fmt: skip
                below += heights
        for place, total in zip(places, below, strict=True):
            axes.annotate(f"{total:.0f}", (place + shift, total), xytext=(0, 2), ha="center",
                          textcoords="offset points", fontsize=8)  # fmt: skip
    axes.set_xticks(places, [f"{float(F):g}" for F in data.forces])
    values = [float(F) for F in data.forces]
    for value, colour, line, words in (
        (math.pi * float(PAPER.f) / 2, RED, ":", r"$F = \pi f/2$: no (1,1) orbit below"),
        (data.fold, ORANGE, "--", r"$F_{\rm sc}$ of the paper: nothing happens"),
    ):
        inside = float(np.interp(value, values, places))
        place = inside if value > values[0] else places[0] - 0.5
        axes.axvline(place, color=colour, ls=line, lw=1.2, label=words)
    axes.set_ylim(0, 1.08 * max(len(found) for found in data.thorough))
    axes.set_xlim(-0.6, len(places) - 0.4)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_xlabel("$F$  [force] (not to scale)")
    axes.set_ylabel("$T$-periodic orbits found")
    axes.bar([0], [0], color="white", ec=BLACK, lw=0.4, hatch="////",
             label=f"hatched: {data.seeds} x {data.seeds} seeds, like the paper's")  # fmt: skip
    legend(axes, figure)
    figure.suptitle(f"$T$-periodic orbits over $F$\n{parameters(PAPER, but=('F',))}", fontsize=10)
