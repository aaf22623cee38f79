"""Pictures of the plane of states at t = 0 mod T."""

import math

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import FigureBase
from matplotlib.image import AxesImage
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from cap.floats.diagnostics.alignment import THRESHOLD, Alignment
from cap.floats.diagnostics.attractor import NONE, Attractors
from cap.floats.diagnostics.fate import FATES, LOST, Fate
from cap.floats.diagnostics.manifold import Manifolds
from cap.floats.diagnostics.portrait import Portrait
from cap.floats.findings import Findings
from cap.pictures.style import (
    BLACK,
    BLUE,
    CYCLE,
    GREEN,
    GREY,
    ORANGE,
    PALE,
    PURPLE,
    RED,
    YELLOW,
    cells,
    framed,
    star,
    stroboscopic,
    title,
    undone,
)

DENSE = 20_000  # points above which they are drawn as pixels
LARGEST = {"sali": math.sqrt(2), "gali": 1.0}  # the smaller of |a + b|, |a - b|; |a ^ b|
LOWEST = -16  # of log10 of an index: what doubles can tell from 0
FATE_COLOURS = (BLUE, YELLOW, ORANGE, PURPLE)


def portrait(findings: Portrait, figure: FigureBase) -> None:
    """Draw the points of many orbits; those that turn or stick in grey, below.

    Around a fixed point, the picture ends a little outside the orbits that never turn.
    """
    axes = figure.subplots()
    points(axes, findings)
    star(axes, findings.centre)
    regular = findings.states[~findings.turned].reshape(-1, 2)
    regular = regular[np.isfinite(regular).all(axis=1)]
    if findings.centre is not None and len(regular):
        low, high = np.nanquantile(regular, [0.002, 0.998], axis=0)
        framed(axes, low, high, 0.15)
    stroboscopic(axes)
    count, periods = len(findings.states), findings.states.shape[1] - 1
    words = f"Stroboscopic portrait: {count} orbits, {periods} periods"
    title(figure, findings, words + (" (grey: turns or sticks)" if findings.turned.any() else ""))


def points(axes: Axes, findings: Portrait) -> None:
    """Draw the orbits; those that never turn in four colours, by their mean distance.

    Without a fixed point to be seen, the first periods of those that turn are left out.
    """
    size = float(np.clip(1e5 / max(1, findings.states[..., 0].size), 0.3, 4))
    regular = np.flatnonzero(~findings.turned)
    if findings.centre is not None and len(regular):
        away = findings.states[regular] - np.array(findings.centre)
        regular = regular[np.argsort(np.hypot(*np.moveaxis(away, -1, 0)).mean(axis=1))]
    shades = (BLUE, ORANGE, GREEN, PURPLE)
    late = 0 if findings.centre is not None else min(20, findings.states.shape[1] // 4)
    groups = [(findings.states[findings.turned, late:], "#AAAAAA")]
    groups += [(findings.states[regular[k::4]], shade) for k, shade in enumerate(shades)]
    for states, colour in groups:
        own = states.reshape(-1, 2)
        axes.scatter(own[:, 0], own[:, 1], s=size, c=colour, lw=0, rasterized=len(own) > DENSE)


def alignment(findings: Alignment, figure: FigureBase) -> None:
    """Draw the map of log10 of an index, and how it falls along some orbits."""
    axes = figure.subplots(1, 2, width_ratios=[1.35, 1])
    name = findings.name.upper()
    image = index_map(axes[0], findings)
    label = rf"$\log_{{10}}$ {name} after {findings.periods} periods"
    figure.colorbar(image, ax=axes[0], label=label, extend="min")
    for k, (start, curve) in enumerate(zip(findings.starts, findings.curves, strict=True)):
        if np.isfinite(curve).any():
            n = np.arange(1, len(curve) + 1)
            axes[1].loglog(n, np.maximum(curve, 1e-17), color=CYCLE[k], lw=0.9,
                           label=f"$x_0 = {start[0]:.4g}$")  # fmt: skip
            axes[0].plot(*start, "o", ms=4, mfc=CYCLE[k], mec="white", mew=0.6)
    axes[1].axhline(10**THRESHOLD, color=GREY, ls=":", lw=0.8)
    axes[1].set_xlabel(r"periods $n$")
    axes[1].set_ylabel(f"{name}$(n)$")
    if axes[1].get_legend_handles_labels()[0]:
        axes[1].legend(title="orbits that never turn", loc="lower left")
    counts = findings.counts
    words = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    title(figure, findings, f"{name}: {findings.index.size} states, {words}")


def index_map(axes: Axes, findings: Alignment) -> AxesImage:
    """Draw log10 of the index; states whose orbit turned are grey.

    What is below the colour bar, as an index 0, has the colour of its lower end.
    """
    shown = np.log10(np.maximum(findings.index, 10.0 ** (LOWEST - 1)))
    top = math.log10(LARGEST[findings.name])
    undone(axes)
    _one(axes, findings, ~findings.lost, PALE)
    image = cells(axes, findings.x, findings.v, shown, cmap="cividis_r", vmin=LOWEST, vmax=top)
    if findings.centre is not None:
        axes.plot(*findings.centre, "*", ms=9, mfc="white", mec=BLACK, mew=0.7)
    stroboscopic(axes)
    return image


def fate(findings: Fate, figure: FigureBase) -> None:
    """Draw which states turn, stick or are captured, and when they first do."""
    axes = figure.subplots(1, 2, sharey=True)
    fates(axes[0], findings)
    T = 2 * np.pi / float(findings.parameters.omega)
    undone(axes[1])
    _one(axes[1], findings, findings.fate != LOST, BLUE)
    first = findings.first / T
    top = float(np.nanmax(first)) if np.isfinite(first).any() else 1.0
    image = cells(axes[1], findings.x, findings.v, first, cmap="magma", vmin=0, vmax=max(top, 1e-9))
    stroboscopic(axes[1])
    axes[1].set_ylabel("")
    star(axes[1], findings.centre)
    figure.colorbar(image, ax=axes[1], label="first turn, stick or capture, $t/T$")
    axes[0].xaxis.set_major_locator(MaxNLocator(5, prune="upper"))
    axes[1].xaxis.set_major_locator(MaxNLocator(5, prune="lower"))
    title(figure, findings, f"Fates within {findings.periods} periods")


def fates(axes: Axes, findings: Fate) -> None:
    """Draw the partition of the plane."""
    norm = BoundaryNorm([-0.5, 0.5, 1.5, 2.5, 3.5], 4)
    shown = np.ma.masked_equal(findings.fate, LOST)
    cells(axes, findings.x, findings.v, shown, cmap=ListedColormap(FATE_COLOURS), norm=norm)
    star(axes, findings.centre, None)
    stroboscopic(axes)
    counts, total = findings.counts, max(1, findings.fate.size)
    handles: list[Artist] = [
        Patch(fc=colour, ec=BLACK, lw=0.4, label=f"{name} ({counts[name] / total:.1%})")
        for name, colour in zip(FATES, FATE_COLOURS, strict=True)
        if counts[name]
    ]
    handles += _left_out(axes, findings, findings.fate == LOST)
    axes.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2,
                handlelength=0.9, columnspacing=1.2)  # fmt: skip


def manifolds(findings: Manifolds, figure: FigureBase) -> None:
    """Draw the manifolds of a saddle and the points in which they meet."""
    axes = figure.subplots()
    for points, colour, name in (
        (findings.stable, BLUE, "$W^s$"),
        (findings.unstable, RED, "$W^u$"),
    ):
        axes.plot(*points.T, color=colour, lw=0.6, label=name)
    if len(findings.homoclinic):
        axes.plot(*findings.homoclinic.T, "o", ms=2, mfc="white", mec=BLACK, mew=0.4, ls="none",
                  label=f"{len(findings.homoclinic)} homoclinic points")  # fmt: skip
    known = findings.unstable[np.isfinite(findings.unstable).all(axis=1)]
    if (
        len(known) and np.ptp(known, axis=0).min() > 1e-9 * np.abs(known).max()
    ):  # the stable one goes far, through orbits that turn
        rim = 0.2 * np.ptp(known, axis=0) + 1e-12
        low, high = known.min(axis=0) - rim, known.max(axis=0) + rim
        axes.set_xlim(
            max(float(findings.parameters.l), low[0]), min(float(findings.parameters.r), high[0])
        )
        axes.set_ylim(low[1], high[1])
    axes.plot(
        *findings.saddle, "s", ms=5, mfc=ORANGE, mec=BLACK, mew=0.6, ls="none", label="saddle"
    )
    stroboscopic(axes)
    axes.legend(loc="best", handlelength=1.2)
    title(figure, findings, "Stable and unstable manifolds")


def attractors(findings: Attractors, figure: FigureBase) -> None:
    """Draw where each seed ends, and the attractors themselves."""
    axes = figure.subplots(1, 2)
    shades = _shades(len(findings.found))
    colours = ListedColormap(shades or ["white"])
    norm = BoundaryNorm(np.arange(-0.5, colours.N), colours.N)
    shown = np.ma.masked_equal(findings.label, NONE)
    cells(axes[0], findings.x, findings.v, shown, cmap=colours, norm=norm)
    for each, colour in zip(findings.found, shades, strict=True):
        few = len(each.states) <= 64
        look = {"ms": 5, "mec": BLACK, "mew": 0.5} if few else {"ms": 0.7, "mew": 0}
        many = len(each.states) > DENSE
        axes[1].plot(*each.states.T, "o", mfc=colour, ls="none", rasterized=many, **look)
    axes[1].margins(0.1)
    for each_axes, words in zip(axes, ("basins (by seed)", "attractors"), strict=True):
        stroboscopic(each_axes)
        each_axes.set_title(words)
    handles: list[Artist] = [
        Patch(fc=colour, ec=BLACK, lw=0.4, label=f"{each.kind} ({each.share:.1%})")
        for each, colour in zip(findings.found[:9], shades, strict=False)
    ]
    handles += _left_out(axes[0], findings, findings.label == NONE)
    if handles:
        figure.legend(handles=handles, loc="outside lower center", ncols=3, handlelength=0.9)
    title(figure, findings, "Attractors and their basins")


def _shades(count: int) -> list[str]:
    """Return colours; after the palette, lighter and darker greys."""
    greys = [str(round(0.35 + 0.5 * k / max(1, count), 3)) for k in range(max(0, count - 8))]
    return [*CYCLE[:count], *greys]


def _left_out(axes: Axes, findings: Findings, own: NDArray[np.bool_]) -> list[Artist]:
    """Hatch the cells of which nothing is known, if there are any, and say why."""
    return undone(axes, "lost" if findings.complete else "not computed") if own.any() else []


def _one(axes: Axes, findings: Alignment | Fate, own: NDArray[np.bool_], colour: str) -> None:
    """Draw these cells in one colour."""
    cells(axes, findings.x, findings.v, np.where(own, 0.0, np.nan), cmap=ListedColormap([colour]))
