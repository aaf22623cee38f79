"""Two maps of states side by side: the paper's, and one of more states and periods."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import FigureBase

from cap.pictures.states import fates, index_map
from cap.pictures.style import parameters

if TYPE_CHECKING:
    from cap.floats.diagnostics.alignment import Alignment
    from cap.floats.diagnostics.fate import Fate
    from cap.paper.figure import Refined


def alignment(data: "Refined[Alignment]", figure: FigureBase) -> None:
    """Draw both maps."""
    axes = figure.subplots(1, 2, sharey=True)
    for each, findings in zip(axes, (data.paper, data.better), strict=True):
        image = index_map(each, findings)
        never = np.isfinite(findings.index).mean()
        states = f"{len(findings.x)} x {len(findings.v)} states, {findings.periods} periods"
        each.set_title(f"{states}: {never:.1%} never turn")
    axes[1].set_ylabel("")
    label = r"$\log_{10}$ SALI (grey: turns or sticks)"
    given = parameters(data.paper.parameters)
    figure.colorbar(image, ax=axes, label=label, extend="min")
    figure.suptitle(f"SALI around the elliptic orbit\n{given}", fontsize=10)


def basins(data: "Refined[Fate]", figure: FigureBase) -> None:
    """Draw both partitions."""
    axes = figure.subplots(1, 2, sharey=True)
    for each, basin in zip(axes, (data.paper, data.better), strict=True):
        fates(each, basin)
        grid = f"{len(basin.x)} x {len(basin.v)} states, {basin.periods} periods"
        each.set_xlabel(f"{each.get_xlabel()}\n{grid}")
        each.set_xlim(basin.x[0], basin.x[-1])
        each.set_ylim(basin.v[0], basin.v[-1])
    axes[1].set_ylabel("")
    given = parameters(data.paper.parameters)
    figure.suptitle(f"Who turns or sticks around $P_*$\n{given}", fontsize=10)
