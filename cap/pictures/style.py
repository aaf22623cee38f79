"""One look for all pictures: colours that the colour-blind can tell apart, axes with units."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from importlib import import_module
from typing import Any

import matplotlib as mpl
from cycler import cycler
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure, FigureBase
from matplotlib.patches import Patch
from numpy.typing import ArrayLike

from cap.floats.findings import Findings
from cap.floats.words import ends, short
from cap.parameters import PAPER, Parameters

# Okabe and Ito's palette
BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, YELLOW, BLACK, GREY = "#CC79A7", "#56B4E9", "#F0E442", "#000000", "#999999"
CYCLE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY, BLACK, YELLOW)
PALE, DARK = "#DDDDDD", "#777777"

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
    return "$" + r",\ ".join(f"{SYMBOLS[n]} = {known[n]}" for n in names) + "$"


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
