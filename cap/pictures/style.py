"""One look for all pictures: colours that the colour-blind can tell apart, axes with units."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from importlib import import_module
from typing import Any

import matplotlib as mpl
import numpy as np
from cycler import cycler
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure, FigureBase
from matplotlib.image import AxesImage
from matplotlib.patches import Patch
from numpy.typing import ArrayLike, NDArray

from cap.floats.findings import Findings, Floats
from cap.floats.words import ends, short
from cap.parameters import PAPER, Parameters

# Okabe and Ito's palette
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, YELLOW, BLACK, GREY = "#CC79A7", "#56B4E9", "#F0E442", "#000000", "#999999"
CYCLE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK, YELLOW)
PALE, DARK = "#DDDDDD", "#777777"
_POWER = re.compile(r"(?<=\d)e\+?(-?)0*(\d+)")  # in a float
_TIMES = r" \\cdot 10^{\1\2}"
DENSE = 5000  # points above which they are drawn as pixels

SYMBOLS = {"F": "F", "omega": r"\omega", "f": "f", "R": "R", "e": "e", "mu": r"\mu"}
UNITS = {  # of what the axes show: a mass of 1, length and time in the units of the parameters
    "x": r"position $x$  [length]",
    "v": r"velocity $\dot x$  [length / time]",
    "t": r"time $t/T$  [forcing periods]",
}

_RC: Any = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9.5,
    "axes.titlesize": 9.5,
    "axes.linewidth": 0.6,
    "axes.prop_cycle": cycler(color=CYCLE),
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.0,
    "image.interpolation": "nearest",
    "savefig.dpi": "figure",
}


@contextmanager
def style() -> Iterator[None]:
    """Draw in this look."""
    with mpl.rc_context(_RC):
        yield


def blank(size: tuple[float, float], dpi: float = 200) -> Figure:
    """Return an empty figure of a size in inches."""
    figure = Figure(figsize=size, dpi=dpi, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def drawn(name: str, data: Any, size: tuple[float, float], dpi: float = 200) -> Figure:
    """Return the picture of data by a function ``module:function`` of `cap.pictures`."""
    module, function = name.split(":")
    draw = getattr(import_module(f"cap.pictures.{module}"), function)
    figure = blank(size, dpi)
    with style():
        draw(data, figure)
        figure.draw_without_rendering()
    return figure


def title(figure: FigureBase, findings: Findings, words: str) -> None:
    """Write what is shown, at which parameters."""
    rest = "" if findings.complete else "  (interrupted)"
    shown = parameters(findings.parameters, varying=findings.varying())
    figure.suptitle(f"{words}{rest}\n{shown}", fontsize=10)


def parameters(
    p: Parameters,
    *,
    but: tuple[str, ...] = (),
    varying: Mapping[str, ArrayLike] | None = None,
) -> str:
    """Return the parameters as a formula; those that vary with the least and largest value.

    Those of losses only if there are any; some may be left out.
    """
    paper, varying = PAPER.strings(), varying or {}
    values = {**p.strings(), "R": str(p.R)}
    names = [n for n in ("F", "omega", "f", "R") if n not in but]
    names += [n for n in ("e", "mu") if (n in varying or values[n] != paper[n]) and n not in but]
    known = {n: r"\ldots ".join(ends(varying[n])) for n in names if n in varying}
    known |= {n: _formula(values[n]) for n in names if n not in varying}
    formula = r",\ ".join(f"{SYMBOLS[n]} = {known[n]}" for n in names)
    return f"${_POWER.sub(_TIMES, formula)}$"


def _formula(number: str) -> str:
    """Return an exact number as a decimal if it is a short one, else as it is or rounded."""
    q = Fraction(number)
    decimal = f"{float(q):.6g}"
    return decimal if Fraction(decimal) == q or "/" not in number else short(number)


def undone(axes: Axes, label: str = "not computed") -> list[Artist]:
    """Hatch what nothing is drawn over, and return what a legend says of it."""
    look: Any = {"fc": "white", "ec": "#BBBBBB", "hatch": "////", "lw": 0.0}
    axes.patch.set(**look)
    return [Patch(**look, label=label)]


def stroboscopic(axes: Axes) -> None:
    """Label the axes of the state plane at t = 0 mod T."""
    axes.set_xlabel(UNITS["x"])
    axes.set_ylabel(UNITS["v"] + r" at $t \equiv 0$ mod $T$")


def star(axes: Axes, state: tuple[float, float] | None, label: str | None = "$P_*$") -> None:
    """Mark a fixed point."""
    if state is not None:
        axes.plot(*state, "*", ms=9, mfc=RED, mec="white", mew=0.6, ls="none", label=label)


def legend(axes: Axes, figure: FigureBase, columns: int = 4) -> None:
    """Explain the marks of some axes below the figure."""
    figure.legend(
        *axes.get_legend_handles_labels(), loc="outside lower center", ncols=max(1, columns)
    )


def walls(axes: Axes, p: Parameters, *, over_time: bool = True) -> None:
    """Draw both walls, over the time or in the plane of states."""
    for wall in (p.l, p.r):
        line = axes.axhline if over_time else axes.axvline
        line(float(wall), color=GREY, ls="--", lw=0.7)


def framed(axes: Axes, low: ArrayLike, high: ArrayLike, part: float, least: float = 1e-12) -> None:
    """Show a rectangle, from one corner to the other, and a rim that is a part of it."""
    corners = np.array([low, high], dtype=float)
    rim = np.maximum(part * (corners[1] - corners[0]), least)
    (left, down), (right, up) = corners + np.outer([-1, 1], rim)
    axes.set(xlim=(left, right), ylim=(down, up))


def cells(axes: Axes, x: Floats, y: Floats, values: NDArray[np.generic], **look: Any) -> AxesImage:
    """Draw a value at each point of a grid as a cell around it."""
    dx, dy = (float(a[1] - a[0]) / 2 for a in (x, y))
    extent = (float(x[0]) - dx, float(x[-1]) + dx, float(y[0]) - dy, float(y[-1]) + dy)
    return axes.imshow(values, origin="lower", extent=extent, aspect="auto", **look)


def dots(axes: Axes, points: Floats, colour: str, size: float) -> None:
    """Draw points (N, 2); many of them as pixels."""
    x, y = points.T
    axes.scatter(x, y, s=size, c=colour, lw=0, rasterized=len(points) > DENSE)
