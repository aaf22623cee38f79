"""Pictures of an orbit of a model: its positions between their walls, velocities, a plane."""

import textwrap
from collections import Counter
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from numpy.typing import NDArray

from cap.floats.findings import Floats
from cap.floats.models.inventory import ModelOrbits
from cap.floats.models.subject import OfModel
from cap.floats.models.trajectory import ModelOrbit
from cap.floats.models.walls import Wall
from cap.floats.words import short
from cap.pictures.style import BLACK, CYCLE, GREY, PURPLE, legend, star
from cap.pictures.times import mark

MOST = 12  # orbits that are drawn
MARKERS = "ov^sD<>hp"
SOLID, PALER = "#D9D9D9", "#F2F2F2"  # what a wall is made of, and where it moves
CHANGES = 1e-9  # of a wall that moves


def orbit(findings: ModelOrbit, figure: FigureBase) -> None:
    """Draw each position between its walls over the time, the velocities, and a plane."""
    rows = _rows(findings)
    heights = [1.4 if group[0] in findings.positions else 1.0 for group in rows]
    axes = figure.subplot_mosaic(
        [[f"row {k}", "plane"] for k in range(len(rows))],
        width_ratios=[1.35, 1],
        height_ratios=heights,
    )
    for k, group in enumerate(rows):
        _row(axes[f"row {k}"], findings, group, last=k == len(rows) - 1)
    _plane(axes["plane"], findings)
    legend(axes["plane"], figure, 8)
    heading(figure, findings, "Orbit and its events")


def heading(figure: FigureBase, findings: OfModel, words: str) -> None:
    """Write what is shown, of which model, at which parameters."""
    rest = "" if findings.complete else "  (interrupted)"
    name, *settings = findings.given().items()
    values = ", ".join(f"{key} = {short(q)}" for key, q in settings)
    shown = textwrap.fill(f"{name[1]}:  {values}", 100)
    figure.suptitle(f"{words}{rest}\n{shown}", fontsize=10)


def _rows(findings: ModelOrbit) -> list[tuple[str, ...]]:
    """Return the panels: a row for each position, at most four, and one for all the others."""
    others = tuple(z for z in findings.state if z not in findings.positions)
    return [*((z,) for z in findings.positions[:4]), *([others] if others else [])]


def _row(axes: Axes, findings: ModelOrbit, names: tuple[str, ...], *, last: bool) -> None:
    """Draw variables over the time."""
    unit = time_unit(findings)
    t, own = findings.t / unit, [findings.state.index(z) for z in names]
    for k, i in enumerate(own):
        colour = BLACK if len(own) == 1 else CYCLE[k % len(CYCLE)]
        axes.plot(t, findings.states[:, i], color=colour, lw=1.0, label=names[k])
    limits = _limits(findings.states[:, own])
    if len(own) == 1:
        for wall in findings.walls:
            if wall.variable == names[0]:
                limits = _wall(axes, t, wall, limits)
    else:  # room for the names
        limits = limits[0], limits[1] + 0.4 * (limits[1] - limits[0])
    axes.set_ylim(limits)
    for word, chosen, look in events(findings):
        for i in own:
            mark(axes, (findings.times[chosen] / unit, findings.before[chosen, i]), look, word)
    axes.set_xlim(0, max(float(t[-1]), 1e-9))
    axes.set_ylabel(", ".join(names))
    axes.tick_params(labelbottom=last)
    if len(own) > 1:
        axes.legend(handles=axes.get_lines()[: len(own)], loc="upper right", ncols=len(own))
    if last:
        axes.set_xlabel(time_label(findings))


def time_unit(findings: ModelOrbit) -> float:
    """Return the unit of the time axis: the clock's period, or 1."""
    return 1.0 if findings.autonomous else findings.period


def time_label(findings: ModelOrbit) -> str:
    """Return what stands at the time axis."""
    return "time $t$" if findings.autonomous else "time $t/T$  [periods of the clock]"


def _limits(values: Floats) -> tuple[float, float]:
    """Return the range of values with a rim."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    rim = 0.08 * (high - low) + 1e-9
    return low - rim, high + rim


def _wall(axes: Axes, t: Floats, wall: Wall, limits: tuple[float, float]) -> tuple[float, float]:
    """Draw a wall, solid on its far side if something bounces there; return limits with it."""
    size = limits[1] - limits[0]
    low, high = float(wall.place.min()), float(wall.place.max())
    if not wall.solid and (low > limits[1] + size or high < limits[0] - size):
        return limits
    axes.plot(t, wall.place, color=GREY, lw=1.0, ls="-" if wall.solid else ":")
    limits = min(limits[0], low - 0.04 * size), max(limits[1], high + 0.04 * size)
    if wall.solid:
        edge = limits[0] - size if wall.side > 0 else limits[1] + size
        axes.fill_between(t, wall.place, edge, color=SOLID, lw=0, zorder=0)
    return limits


def events(
    findings: ModelOrbit,
) -> list[tuple[str, NDArray[np.bool_], tuple[str, str]]]:
    """Return the events that happen by name: which, and the marker and colour of it."""
    names = dict.fromkeys(findings.words.tolist())
    listed = []
    for k, word in enumerate(names):
        look = (MARKERS[k % len(MARKERS)], CYCLE[k % len(CYCLE)])
        look = ("X", PURPLE) if word == "capture" else look
        listed.append((word, findings.words == word, look))
    return listed


def _plane(axes: Axes, findings: ModelOrbit) -> None:
    """Draw the orbit in the plane of two variables, with its states at t = 0, T, ..."""
    i, k = (findings.state.index(z) for z in findings.plane)
    for wall in findings.walls:
        draw = {findings.plane[0]: axes.axvline, findings.plane[1]: axes.axhline}.get(wall.variable)
        low, high = float(wall.place.min()), float(wall.place.max())
        if draw and high - low < CHANGES * (1 + abs(low)):
            draw(low, color=GREY, ls="--" if wall.solid else ":", lw=0.8)
        elif draw and wall.solid and set(findings.plane) != set(findings.positions):
            span: Any = axes.axvspan if draw == axes.axvline else axes.axhspan
            span(low, high, color=PALER, lw=0, zorder=0, label="where the wall moves")
    for n, each in enumerate(findings.surfaces):
        label = None if n else "the wall at an event"
        axes.plot(each.first, each.second, color=GREY, lw=0.8, zorder=0, label=label)
    axes.plot(findings.states[:, i], findings.states[:, k], color=BLACK, lw=0.8)
    for word, chosen, look in events(findings):
        mark(axes, (findings.before[chosen, i], findings.before[chosen, k]), look, word)
    for n, state in enumerate(findings.strobe):
        label = None if n else ("start" if findings.autonomous else r"$t \equiv 0$ mod $T$")
        star(axes, (state[i], state[k]), label)
    axes.set_xlabel(findings.plane[0])
    axes.set_ylabel(findings.plane[1])
    if findings.surfaces:
        low, high = _limits(findings.states[:, k])
        axes.set_ylim(low - 0.25 * (high - low), high)


def orbits(findings: ModelOrbits, figure: FigureBase) -> None:
    """Draw the orbits that were found in a plane; dashed those that do not attract."""
    axes = figure.subplots()
    i, k = (findings.state.index(z) for z in findings.plane)
    for n, each in enumerate(findings.orbits[:MOST]):
        colour, line = CYCLE[n % len(CYCLE)], "-" if each.attracts else (0, (4, 2))
        axes.plot(each.curve[:, i], each.curve[:, k], color=colour, lw=0.9, ls=line)
        axes.plot(each.contacts[:, i], each.contacts[:, k], "o", ms=3, mfc="white", mec=colour)
        words = "attracts" if each.attracts else "does not attract"
        star(axes, (each.state[i], each.state[k]), None)
        counts = ", ".join(f"{m} {word}" for word, m in Counter(each.words).items())
        label = textwrap.shorten(f"{n + 1}: {counts}, {words}", 60)
        axes.plot([], [], color=colour, ls=line, label=label)
    axes.set_xlabel(findings.plane[0])
    axes.set_ylabel(findings.plane[1])
    if findings.orbits:
        figure.legend(loc="outside lower center", ncols=2)
    else:
        axes.set(xticks=[], yticks=[])
        axes.text(0.5, 0.5, "\n".join(findings.others) or "none", ha="center", va="center")
    count = len(findings.orbits)
    what = f"{count} orbit{'s' * (count != 1)}"
    heading(figure, findings, f"{what} of period {findings.periods} T found")
