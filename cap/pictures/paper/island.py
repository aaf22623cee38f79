"""The stroboscopic portrait around an elliptic orbit, its rotation numbers, its chains."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase

from cap.floats.diagnostics.rotation import SHAKY
from cap.pictures.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    parameters,
    star,
    stroboscopic,
)

if TYPE_CHECKING:
    from cap.paper.island import Island

MARKS = (("o", RED), ("s", GREEN), ("^", PURPLE), ("D", ORANGE), ("v", BLACK))  # of chains


def island(data: "Island", figure: FigureBase) -> None:
    """Draw the portrait and the rotation numbers."""
    axes = figure.subplots(1, 2, width_ratios=[1.25, 1])
    findings = data.portrait
    regular = np.flatnonzero(~findings.turned)
    for chosen, colour in (
        (findings.turned, "#BBBBBB"),
        (regular[::2], BLUE),
        (regular[1::2], SKY),
    ):
        own = findings.states[chosen].reshape(-1, 2)
        axes[0].scatter(*own.T, s=0.9, c=colour, lw=0, rasterized=True)
    star(axes[0], data.portrait.centre)
    for chain, (marker, colour) in zip(data.chains, MARKS, strict=False):
        axes[0].plot(*chain.states.T, marker, ms=3.5, mfc="white", mec=colour, mew=0.9, ls="none",
                     label=f"chain {chain.number}")  # fmt: skip
    x, v = data.portrait.centre or (0.0, 0.0)
    axes[0].set_xlim(x - 0.085, x + 0.085)
    axes[0].set_ylim(v - 0.05, v + 0.075)
    stroboscopic(axes[0])
    axes[0].plot([], [], ".", color=BLUE, label="never turns")
    axes[0].plot([], [], ".", color=GREY, label="turns or sticks")
    axes[0].legend(loc="upper left", handlelength=1.0)
    _staircase(axes[1], data)
    words = (
        f"Portrait around $P_*$, {findings.states.shape[1] - 1} periods, and its rotation numbers"
    )
    figure.suptitle(f"{words}\n{parameters(findings.parameters)}", fontsize=10)


def _staircase(axes: Axes, data: "Island") -> None:
    """Draw the rotation numbers on the ray, and those of the chains, also of such as it misses."""
    turns = data.rotation
    good = turns.quality < SHAKY
    axes.plot(turns.distance[~good], turns.rotation[~good], ".", ms=3, color=ORANGE,
              label="on no curve, or in a chain")  # fmt: skip
    axes.plot(turns.distance[good], turns.rotation[good], ".", ms=3, color=BLUE, label="on a curve")
    for chain in data.chains:
        level = float(chain.number)
        axes.axhline(level, color=GREY, ls=":", lw=0.8)
        axes.annotate(f"chain {chain.number}", (0.001, level), xytext=(0, 2), fontsize=8,
                      textcoords="offset points", color="#555555")  # fmt: skip
    axes.set_xlabel("distance from $P_*$ along $x$  [length]")
    axes.set_ylabel(r"rotation number $\Theta/2\pi$")
    axes.legend(loc="center left", bbox_to_anchor=(0.0, 0.62))
