"""Pictures of states of a model: portraits, attractors, basins, bifurcation diagrams."""

import textwrap
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch

from cap.floats.models.attractor import ModelAttractor, ModelAttractors
from cap.floats.models.basin import OUTSIDE, ModelBasin
from cap.floats.models.continuation import ModelBranch
from cap.floats.models.diagram import ModelDiagram
from cap.floats.models.portrait import ModelPortrait
from cap.floats.models.spectrum import Floats
from cap.floats.models.subject import OfModel
from cap.floats.models.walls import Wall
from cap.pictures.models import MARKERS, heading
from cap.pictures.style import BLACK, BLUE, CYCLE, GREY, RED, cells, dots

SOLID = "#D9D9D9"
LOOKS: dict[bool, dict[str, Any]] = {True: {"lw": 1.4}, False: {"lw": 0.9, "ls": (0, (4, 2))}}
LEAST = 1e-3  # the width of a picture, relative to its numbers: ticks have four digits then
STROBE = r" at $t \equiv 0$ mod $T$"


def portrait(findings: ModelPortrait, figure: FigureBase) -> None:
    """Draw the states of all orbits in each plane, grey where contacts accumulated."""
    planes = figure.subplots(1, len(findings.planes), squeeze=False)[0]
    for axes, plane in zip(planes, findings.planes, strict=True):
        i, k = (findings.state.index(z) for z in plane)
        _walls(axes, plane, findings.walls)
        ends = np.ptp(findings.states[..., [i, k]], axis=(0, 1))
        size = 12.0 if ends.max() < LEAST else 1.0  # all states are one, as far as is seen
        for n, path in enumerate(findings.states):
            colour = "#AAAAAA" if findings.rested[n] else CYCLE[n % len(CYCLE)]
            dots(axes, path[:, [i, k]], colour, size)
        _labels(axes, plane, _when(findings, findings.event))
        _no_closer(axes)
    handles = [Patch(fc="#AAAAAA", label="contacts accumulate")] if findings.rested.any() else []
    if handles and not findings.rested.all():
        figure.legend(handles=handles, loc="outside lower center", handlelength=0.9)
    N, K, _ = findings.states.shape
    heading(figure, findings, f"Portrait: {N} orbits, {K} states of each")


def attractors(findings: ModelAttractors, figure: FigureBase) -> None:
    """Draw the attractors in each plane."""
    planes = figure.subplots(1, len(findings.planes), squeeze=False)[0]
    for axes, plane in zip(planes, findings.planes, strict=True):
        _walls(axes, plane, findings.walls)
        _drawn(axes, findings, plane, findings.found)
        _labels(axes, plane, _when(findings))
    _legend(figure, findings.found)
    heading(figure, findings, f"Where {len(findings.label)} seeds end")


def attractor(findings: ModelAttractors | ModelDiagram, figure: FigureBase) -> None:
    """Draw attractors, or their diagram over a parameter."""
    if isinstance(findings, ModelDiagram):
        diagram(findings, figure)
    else:
        attractors(findings, figure)


def diagram(findings: ModelDiagram, figure: FigureBase) -> None:
    """Draw the first variable over the parameter, and the largest exponent below."""
    top, low = figure.subplots(2, 1, sharex=True, height_ratios=[2.2, 1])
    value = np.broadcast_to(findings.value[:, None, None], findings.states.shape[:3])
    rested = np.broadcast_to(findings.rested[:, :, None], value.shape)
    for chosen, colour in ((rested, "#AAAAAA"), (~rested, BLUE)):
        points = np.stack([value[chosen], findings.states[..., 0][chosen]], axis=1)
        dots(top, points, colour, 0.5)
    top.set_ylabel(findings.state[0] + _when(findings))
    x = np.broadcast_to(findings.value[:, None], findings.exponent.shape)
    with np.errstate(invalid="ignore"):
        shown = np.where(np.isfinite(findings.exponent), findings.exponent, np.nan)
    low.axhline(0, color=GREY, lw=0.6)
    for chosen, colour in ((shown > 0, RED), (shown <= 0, BLACK)):
        low.plot(x[chosen], shown[chosen], ".", ms=1.5, color=colour)
    low.set_ylabel("largest exponent\n[1/time]")
    low.set_xlabel(findings.parameter)
    low.set_xlim(findings.value[0], findings.value[-1])
    if findings.rested.any() and not findings.rested.all():
        handles = [Patch(fc=BLUE, label="no contacts accumulate"),
                   Patch(fc="#AAAAAA", label="contacts accumulate")]  # fmt: skip
        figure.legend(handles=handles, loc="outside lower center", ncols=2, handlelength=0.9)
    heading(figure, findings, f"Attractors over {findings.parameter}")


def basin(findings: ModelBasin, figure: FigureBase) -> None:
    """Draw where the states of a plane end, with the attractors in it."""
    axes = figure.subplots()
    count = len(findings.found)
    shades = [_pale(CYCLE[k % len(CYCLE)]) for k in range(count)]
    colours = ListedColormap([SOLID, BLACK, *shades])
    norm = BoundaryNorm(np.arange(OUTSIDE - 0.5, count + 0.5), count + 2)
    image = cells(axes, findings.first, findings.second, findings.label, cmap=colours, norm=norm)
    left, right, low, high = image.get_extent()
    if not findings.fixed:
        _drawn(axes, findings, findings.plane, findings.found, size=6)
    axes.set(xlim=(left, right), ylim=(low, high))
    _labels(axes, findings.plane, _when(findings))
    _legend(figure, findings.found)
    others = "".join(f", {z} = {q:.4g}" for z, q in findings.fixed.items())
    heading(figure, findings, f"Where the states at $t = 0$ end{others}")


def _pale(colour: str) -> str:
    """Return a colour, lighter."""
    parts = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{int(0.45 * part + 0.55 * 255):02X}" for part in parts)


def _drawn(
    axes: Axes,
    findings: ModelAttractors | ModelBasin,
    plane: tuple[str, str],
    found: tuple[ModelAttractor, ...],
    size: float = 5,
) -> None:
    """Draw the states of attractors in a plane."""
    i, k = (findings.state.index(z) for z in plane)
    for n, each in enumerate(found):
        states = each.states[:, [i, k]]
        colour = CYCLE[n % len(CYCLE)]
        if len(states) > 64:
            dots(axes, states, colour, 0.8)
        else:
            axes.plot(states[:, 0], states[:, 1], "o", ms=size, mfc=colour, mec=BLACK, mew=0.5)


def _legend(figure: FigureBase, found: tuple[ModelAttractor, ...]) -> None:
    """Name the attractors with their shares."""
    handles = []
    for n, each in enumerate(found[:9]):
        label = textwrap.shorten(f"{each.kind} ({each.share:.1%}): {each.events}", 60)
        handles.append(Patch(fc=CYCLE[n % len(CYCLE)], ec=BLACK, lw=0.4, label=label))
    figure.legend(handles=handles, loc="outside lower center", ncols=2, handlelength=0.9)


def _walls(axes: Axes, plane: tuple[str, str], walls: tuple[Wall, ...]) -> None:
    """Draw the walls at t = 0."""
    for wall in walls:
        draw = {plane[0]: axes.axvline, plane[1]: axes.axhline}.get(wall.variable)
        if draw and wall.solid:
            draw(float(wall.place[0]), color=GREY, ls="--", lw=0.8)


def _no_closer(axes: Axes) -> None:
    """Widen limits between which there is little but rounding: all states may be one."""
    for (low, high), limit in ((axes.get_xlim(), axes.set_xlim), (axes.get_ylim(), axes.set_ylim)):
        least = LEAST * max(abs(low), abs(high), 1)
        if high - low < least:
            limit((low + high - least) / 2, (low + high + least) / 2)


def _when(findings: OfModel, event: str = "") -> str:
    """Return when the states are looked at: once a period of the clock, if there is one."""
    return f" just after {event}" if event else "" if findings.autonomous else STROBE


def _labels(axes: Axes, plane: tuple[str, str], when: str) -> None:
    """Label the axes of a plane of states."""
    axes.set_xlabel(plane[0])
    axes.set_ylabel(plane[1] + when)


def continuation(findings: ModelBranch, figure: FigureBase) -> None:
    """Draw the branch, solid where it attracts, and the moduli of its multipliers below."""
    top, low = figure.subplots(2, 1, sharex=True, height_ratios=[1.6, 1])
    value = findings.value
    for points, stable in _parts(findings):
        top.plot(*points.T, color=BLUE, **LOOKS[stable])
    for stable, label in ((True, "attracts"), (False, "does not attract")):
        if (findings.stable == stable).any():
            top.plot([], [], color=BLUE, label=label, **LOOKS[stable])
    for k, label in enumerate(dict.fromkeys(each.label for each in findings.special)):
        own = [each for each in findings.special if each.label == label]
        top.plot([e.value for e in own], [e.state[0] for e in own], MARKERS[k % len(MARKERS)],
                 ms=6, mfc="white", mec=CYCLE[(k + 1) % len(CYCLE)], ls="none",
                 label=label)  # fmt: skip
    low.axhline(1, color=GREY, lw=0.6)
    for k, sizes in enumerate(np.abs(findings.multipliers).T):
        low.plot(value, sizes, color=CYCLE[k % len(CYCLE)], lw=0.9)
    low.set_ylim(0, min(3.0, 1.05 * float(np.abs(findings.multipliers).max())))
    top.set_ylabel(f"{findings.state[0]}{STROBE}")
    low.set_ylabel("|multipliers|")
    low.set_xlabel(findings.parameter)
    figure.legend(loc="outside lower center", ncols=4)
    heading(figure, findings, f"An orbit of period {findings.periods} T over {findings.parameter}")


def _parts(findings: ModelBranch) -> Iterator[tuple[Floats, bool]]:
    """Give the points (M, 2) of parts of the branch that look alike, and whether they attract.

    Two parts meet at the special orbit between them, if there is one.
    """
    points = np.stack([findings.value, findings.states[:, 0]], axis=1)
    changes = np.diff(2 * findings.itinerary + findings.stable)
    cuts = [0, *(np.flatnonzero(changes) + 1).tolist(), len(points)]
    before = points[:0]
    for begin, end in pairwise(cuts):
        after = points[end : end + 1]
        for each in findings.special:
            here = np.array([each.value, each.state[0]])
            if len(after) and np.all((points[end - 1] - here) * (points[end] - here) <= 0):
                after = here[None]
        yield np.concatenate([before, points[begin:end], after]), bool(findings.stable[begin])
        before = after
