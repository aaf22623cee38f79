"""Schematic figures: the model, its cover, the plane and who turns in it, several masses."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import FancyArrowPatch, Rectangle

from cap.floats.findings import State
from cap.parameters import PAPER
from cap.pictures.states import fates
from cap.pictures.style import BLACK, BLUE, GREEN, GREY, RED, UNITS, parameters

if TYPE_CHECKING:
    from cap.paper.sketches import Decomposition, Lifted


def model(data: None, figure: FigureBase) -> None:
    """Draw the mass between the walls."""
    del data
    axes = _stage(figure)
    _body(axes, 0.0, 0.35, "$m = 1$")
    _arrow(axes, (-0.1, 0.62), (0.45, 0.62), r"$F\cos\omega t$", "blue")
    _arrow(axes, (0.3, -0.28), (-0.15, -0.28), r"$-f\,\mathrm{sgn}\,\dot x$", "red")
    _arrow(axes, (0.2, 0.22), (0.5, 0.22), r"$\dot x$", "green")
    _measure(axes, "$R = r - l$")
    figure.suptitle(f"The oscillator\n{parameters(PAPER)}", fontsize=10)


def _stage(figure: FigureBase) -> Axes:
    """Draw the floor and the walls."""
    axes = figure.subplots()
    axes.set_axis_off()
    for x, name in ((-1.0, "$l$"), (1.0, "$r$")):
        left = x - 0.12 if x < 0 else x
        axes.add_patch(Rectangle((left, -0.18), 0.12, 0.9, fc="#DDDDDD", ec="none", hatch="////"))
        axes.plot([x, x], [-0.18, 0.72], color="black", lw=1.2)
        axes.annotate(name, (x, -0.42), ha="center")
    axes.add_patch(Rectangle((-1, -0.2), 2, 0.05, fc="#DDDDDD", ec="none", hatch="////"))
    axes.plot([-1, 1], [-0.15, -0.15], color="black", lw=1.0)
    axes.annotate("$x$", (1.22, -0.42), ha="center")
    axes.annotate("", (1.18, -0.36), (-1.18, -0.36), arrowprops={"arrowstyle": "->", "lw": 0.7})
    axes.set_xlim(-1.3, 1.3)
    axes.set_ylim(-0.55, 1.0)
    axes.set_aspect("equal")
    return axes


def _body(axes: Axes, x: float, width: float, name: str) -> None:
    axes.add_patch(Rectangle((x - width / 2, -0.15), width, 0.3, fc="#CFE3F1", ec="black", lw=0.8))
    axes.annotate(name, (x, 0.0), ha="center", va="center", fontsize=9)


def _arrow(axes: Axes, begin: State, end: State, words: str, colour: str) -> None:
    own = {"blue": BLUE, "red": RED, "green": GREEN}[colour]
    axes.add_patch(
        FancyArrowPatch(begin, end, arrowstyle="-|>", mutation_scale=11, color=own, lw=1.3)
    )
    x, y = max(begin[0], end[0]), begin[1]
    axes.annotate(words, (x + 0.03, y), va="center", color=own, fontsize=9)


def _measure(axes: Axes, words: str) -> None:
    axes.annotate("", (1, 0.88), (-1, 0.88), arrowprops={"arrowstyle": "<->", "lw": 0.7})
    axes.annotate(words, (0, 0.88), ha="center", va="center", backgroundcolor="white")


def particles(data: None, figure: FigureBase) -> None:
    """Draw the particles."""
    del data
    axes = _stage(figure)
    for k, (x, width) in enumerate(((-0.7, 0.24), (-0.25, 0.34), (0.15, 0.2), (0.72, 0.3)), 1):
        _body(axes, x, width, f"$m_{k}$" if k < 4 else "$m_N$")
        axes.add_patch(FancyArrowPatch((x - 0.09, 0.32), (x + 0.13, 0.32), arrowstyle="-|>",
                       mutation_scale=9, color="#0072B2", lw=1.1))  # fmt: skip
    axes.annotate("…", (0.42, 0.0), ha="center", va="center", fontsize=13)
    axes.annotate(r"$F\cos\omega t$ on each", (0, 0.5), ha="center", color="#0072B2", fontsize=9)
    _measure(axes, "$R = r - l$")
    figure.suptitle(r"$N$ particles: $m_i\ddot x_i = F\cos\omega t - f\,\mathrm{sgn}\,\dot x_i$",
                    fontsize=10)  # fmt: skip


def cover(data: "Lifted", figure: FigureBase) -> None:
    """Draw the wave, the lift, and the orbit."""
    axes = figure.subplots(1, 3)
    axes[0].plot(*data.wave, color=BLUE)
    axes[0].set_xlabel("$q$")
    axes[0].set_ylabel(r"$\pi(q) = R\,W(q) + l$  [length]")
    t = data.orbit.t / data.orbit.period
    axes[1].plot(t, data.q, color=RED)
    for k in range(1, int(data.q[-1]) + 1):
        axes[1].axhline(k, color=GREY, ls=":", lw=0.7)
    axes[1].set_ylabel("$q(t)$")
    axes[2].plot(t, data.orbit.x, color="black", lw=0.9)
    for wall in (PAPER.l, PAPER.r):
        axes[2].axhline(float(wall), color=GREY, ls="--", lw=0.7)
    axes[2].set_ylabel(UNITS["x"])
    for each in axes[1:]:
        each.set_xlabel(UNITS["t"])
        each.set_xlim(0, 3)
    figure.suptitle(f"The cover, and the lift of the elliptic orbit\n{parameters(PAPER)}",
                    fontsize=10)  # fmt: skip


def decomposition(data: "Decomposition", figure: FigureBase) -> None:
    """Draw the plane."""
    axes = figure.subplots()
    fates(axes, data.basin)
    handles = list(axes.get_legend().legend_handles)  # type: ignore[union-attr]
    labels = [text.get_text() for text in axes.get_legend().get_texts()]  # type: ignore[union-attr]
    axes.get_legend().remove()  # type: ignore[union-attr]
    for each in data.islands:
        own = each.states[~each.turned].reshape(-1, 2)
        axes.scatter(own[:, 0], own[:, 1], s=0.3, c=BLUE, lw=0, rasterized=True)
    for kind, marker, colour in (("elliptic", "*", RED), ("saddle", "s", "white")):
        (line,) = axes.plot(*np.array(data.points[kind]).reshape(-1, 2).T, marker, ms=7, mfc=colour,
                            mec=BLACK, mew=0.7, ls="none")  # fmt: skip
        handles.append(line)
        labels.append(f"{kind} fixed point")
    for found in data.attractors:
        (line,) = axes.plot(*found.states[:500].T, ".", ms=1.6, color=GREEN)
    handles.append(line)
    labels.append("attractors")
    axes.set_xlim(data.basin.x[0], data.basin.x[-1])
    axes.set_ylim(data.basin.v[0], data.basin.v[-1])
    figure.legend(handles, labels, loc="outside lower center", ncols=3, markerscale=1.4)
    words = f"Who turns within {data.basin.periods} periods, and the islands"
    figure.suptitle(f"{words}\n{parameters(PAPER)}", fontsize=10)
