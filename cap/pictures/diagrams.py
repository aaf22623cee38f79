"""Pictures over parameters: branches, maps, inventories."""

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from cap.floats.diagnostics.continuation import Branch, Continuation
from cap.floats.diagnostics.plane import OUTSIDE, UNDONE, Plane
from cap.floats.search.inventory import KINDS, PROVED, Inventory
from cap.pictures.style import (
    BLACK,
    BLUE,
    CYCLE,
    DARK,
    GREEN,
    GREY,
    ORANGE,
    PALE,
    PURPLE,
    RED,
    SKY,
    SYMBOLS,
    UNITS,
    YELLOW,
    cells,
    legend,
    stroboscopic,
    title,
    undone,
    walls,
)

MARKS = {  # of special points: marker, colour
    "fold": ("o", RED),
    "pitchfork": ("D", PURPLE),
    "branch point": ("X", BLACK),
    "flip": ("^", GREEN),
    "grazing": ("s", ORANGE),
    "sticking border": ("p", SKY),
    "end": ("|", BLACK),
    "followed no further": ("*", GREY),
}
TYPE_MARKS = dict(zip(KINDS, ("o", "s", "P", "*", "^", "v", "x"), strict=True))
TYPE_COLOURS = dict(zip(KINDS, (BLUE, SKY, PURPLE, GREEN, RED, ORANGE, GREY), strict=True))


def continuation(findings: Continuation, figure: FigureBase) -> None:
    """Draw the branches: positions above, traces below; unstable orbits dashed."""
    axes = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 1])
    for k, branch in enumerate(findings.branches):
        for name, each in (("x", axes[0]), ("trace", axes[1])):
            _line(each, branch, name, CYCLE[k % len(CYCLE)])
    for label, (marker, colour) in MARKS.items():
        own = [s for s in findings.special if _mark(s.label) == label]
        for values, each in (([s.x for s in own], axes[0]), ([s.trace for s in own], axes[1])):
            each.plot([s.value for s in own], values, marker=marker, ms=5.5, mfc="white",
                      mec=colour, mew=1.1, ls="none", label=label if own else None,
                      zorder=3)  # fmt: skip
    axes[0].set_ylabel("$x$ at $t = 0$  [length]")
    axes[1].set_ylabel("trace")
    traces = np.concatenate([branch.trace for branch in findings.branches])
    axes[1].set_ylim(max(-6, np.nanmin(traces) - 0.4), min(6, np.nanmax(traces) + 0.4))
    for level in (-2, 2):
        axes[1].axhline(level, color=GREY, ls=":", lw=0.8)
    axes[1].set_xlabel(f"${SYMBOLS[findings.parameter]}$")
    axes[0].plot([], [], color=BLACK, lw=1.1, label="stable")
    axes[0].plot([], [], color=BLACK, lw=0.8, ls="--", label="unstable")
    legend(axes[0], figure)
    known = sorted({branch.period for branch in findings.branches})
    periods = ", ".join("$T$" if n == 1 else f"${n}T$" for n in known)
    title(figure, findings, f"Periodic orbits of period {periods}")


def _mark(label: str) -> str:
    """Return the mark of a label: where a branch ends, that of the reason, if it has one."""
    reason = label.removeprefix("end: ").removesuffix(", fold")
    known = [name for name in MARKS if reason.startswith(name)]
    return known[0] if known else "end"


def _line(axes: Axes, branch: Branch, name: str, colour: str) -> None:
    """Draw a branch in pieces, cut where the stability changes or the state jumps at a wall."""
    y, solid = getattr(branch, name), _solid(branch)
    looks = np.where(np.diff(branch.itinerary) != 0, -1, solid.astype(int))  # -1: no line
    change = np.flatnonzero(np.diff(looks)) + 1
    for begin, end in zip([0, *change], [*change, len(looks)], strict=True):
        if begin < end and looks[begin] >= 0:
            look = {"lw": 1.4} if looks[begin] else {"lw": 0.9, "ls": (0, (4, 2))}
            part = slice(begin, end + 1)
            axes.plot(branch.value[part], y[part], color=colour, **look)


def _solid(branch: Branch) -> NDArray[np.bool_]:
    """Return whether the orbits between neighbours are stable.

    1 + det - |trace| is positive on stable orbits and 0 at a fold, a flip or where branches cross:
    with its sum over both ends, the neighbour of such a point decides.
    """
    with np.errstate(invalid="ignore"):
        margin = 1 + branch.determinant - np.abs(branch.trace)
        return np.asarray(margin[:-1] + margin[1:] > 0)


def plane(findings: Plane, figure: FigureBase) -> None:
    """Draw what is found over two parameters."""
    axes = figure.subplots()
    shades = {
        "none": "white", "elliptic only": BLUE, "saddle only": ORANGE,
        "elliptic and saddle": SKY,
        "period 1": BLUE, "period 2": SKY, "period 3": GREEN, "period 4": PURPLE,
        "longer period": ORANGE, "chaotic": RED, "no period found": GREY,
        "never hits a wall": PALE,
        "never turns": YELLOW, "no attractor found": "white",
    }  # fmt: skip
    colours = ListedColormap([DARK, *(shades[name] for name in findings.names)])
    count = len(findings.names) + 1
    norm = BoundaryNorm(np.arange(-1.5, count - 1), count)
    shown = np.ma.masked_equal(findings.code, UNDONE)
    cells(axes, findings.first, findings.second, shown, cmap=colours, norm=norm)
    handles: list[Artist] = [
        Patch(fc=shades[name], ec=BLACK, lw=0.4, label=name)
        for k, name in enumerate(findings.names)
        if (findings.code == k).any()
    ]
    if (findings.code == OUTSIDE).any():
        handles.append(Patch(fc=DARK, ec=BLACK, lw=0.4, label="no oscillator"))
    handles += undone(axes) if (findings.code == UNDONE).any() else []
    _border(axes, findings)
    handles += [each for each in axes.get_legend_handles_labels()[0] if not isinstance(each, Patch)]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, handlelength=1.0)
    axes.set_xlabel(f"${SYMBOLS[findings.parameter_1]}$")
    axes.set_ylabel(f"${SYMBOLS[findings.parameter_2]}$")
    orbits = "Orbits that hit each wall once and never turn or stick"
    what = orbits if findings.what == "orbits" else "Attractors"
    title(figure, findings, what)


def _border(axes: Axes, findings: Plane) -> None:
    """Draw f = 2F/π, above which no orbit hits each wall once and never turns or sticks."""
    names, p = (findings.parameter_1, findings.parameter_2), findings.parameters
    if findings.what != "orbits" or "f" not in names:
        return
    limits = axes.get_xlim(), axes.get_ylim()
    label = r"$f = 2F/\pi$"
    if "F" in names:
        F = np.array([0.0, 1e3])
        line = (2 * F / np.pi, F) if names[0] == "f" else (F, 2 * F / np.pi)
        axes.plot(*line, color=BLACK, ls=":", lw=1.1, label=label)
    elif names[0] == "f":
        axes.axvline(2 * float(p.F) / np.pi, color=BLACK, ls=":", lw=1.1, label=label)
    else:
        axes.axhline(2 * float(p.F) / np.pi, color=BLACK, ls=":", lw=1.1, label=label)
    axes.set_xlim(limits[0])
    axes.set_ylim(limits[1])


def inventory(findings: Inventory, figure: FigureBase) -> None:
    """Draw the orbits: at one value in the plane of states, else counts and positions over it."""
    if len(findings.values) <= 1:
        last = figure.subplots()
        _orbits(last, findings, "x", "v")
    else:
        axes = figure.subplots(2, 1, sharex=True)
        _counts(axes[0], findings)
        _orbits(axes[1], findings, "value", "x")
        axes[0].tick_params(labelbottom=False)
        axes[1].set_xlabel(f"${SYMBOLS[findings.parameter]}$")
        axes[1].set_ylabel("$x$ at $t = 0$  [length]")
        last = axes[1]
    if findings.orbits:
        legend(last, figure)
    period = "T" if findings.periods == 1 else f"{findings.periods}T"
    title(figure, findings, f"{len(findings.orbits)} orbits of period ${period}$ found")


def _orbits(axes: Axes, findings: Inventory, first: str, second: str) -> None:
    proved = [each for each in findings.orbits if each.verdict == PROVED]
    for kind in KINDS:
        own = [each for each in findings.orbits if each.kind == kind]
        if own:
            axes.plot([getattr(o, first) for o in own], [getattr(o, second) for o in own],
                      TYPE_MARKS[kind], ms=5.5, mfc=TYPE_COLOURS[kind], mec=BLACK, mew=0.5,
                      ls="none", label=kind)  # fmt: skip
    if proved:
        axes.plot([getattr(o, first) for o in proved], [getattr(o, second) for o in proved], "o",
                  ms=9.5, mfc="none", mec=BLACK, mew=0.9, ls="none", label="proved")  # fmt: skip
    if second == "v":
        stroboscopic(axes)
        l, r = float(findings.parameters.l), float(findings.parameters.r)
        axes.set_xlim(l - 0.04 * (r - l), r + 0.04 * (r - l))
        walls(axes, findings.parameters, over_time=False)
    else:
        axes.set_ylabel(UNITS["x"])


def _counts(axes: Axes, findings: Inventory) -> None:
    """Draw bars of the counts by type."""
    values = findings.values
    width = 0.8 * float(np.diff(np.sort(values)).min())
    below = np.zeros(len(values))
    for kind in KINDS:
        count = findings.count(kind)
        if count.any():
            axes.bar(values, count, width, below, color=TYPE_COLOURS[kind], ec=BLACK, lw=0.4)
            below += count
    for value, total in zip(values, below, strict=True):
        axes.annotate(f"{total:.0f}", (value, total), xytext=(0, 1.5), ha="center",
                      textcoords="offset points", fontsize=8)  # fmt: skip
    axes.set_ylim(0, 1.15 * max(1.0, float(below.max())))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylabel("number of orbits")
