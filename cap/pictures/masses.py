"""Pictures of N masses: in time, and in the plane of each mass at t = 0 mod T."""

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch

from cap.floats.findings import Floats
from cap.floats.masses.mass_attractor import NEVER, MassAttractors
from cap.floats.masses.mass_portrait import MassPortrait
from cap.floats.masses.mass_trajectory import MassTrajectory
from cap.floats.masses.masses import OfMasses
from cap.floats.words import short
from cap.pictures.style import (
    BLACK,
    BLUE,
    CYCLE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    dots,
    framed,
    legend,
    parameters,
    star,
    walls,
)
from cap.pictures.times import mark, time_axis

MARKS = {  # of events: marker, colour
    "hit": ("o", BLUE),
    "meet": ("X", BLACK),
    "turn": ("^", GREEN),
    "stick": ("s", RED),
    "release": ("D", ORANGE),
}
NAMES = {"hit": "hit of a wall", "meet": "collision"}
ISLAND = (BLUE, SKY, GREEN, PURPLE)
STROBE = r"$\dot x_i$  [length / time] at $t \equiv 0$ mod $T$"
LATE = 0.75  # the part of an orbit from anywhere that is not drawn


def orbit(findings: MassTrajectory, figure: FigureBase) -> None:
    """Draw all x_i(t) with hits and collisions, and v_i(t) below."""
    top, low = figure.subplots(2, 1, sharex=True, height_ratios=[1.2, 1])
    t, n = findings.t / findings.period, findings.x.shape[1]
    for i in range(n):
        colour = CYCLE[i % len(CYCLE)]
        mass = short(str(findings.masses[i]))
        top.plot(t, findings.x[:, i], color=colour, lw=1.0, label=f"$m_{i + 1} = {mass}$")
        low.plot(t, findings.v[:, i], color=colour, lw=0.9)
    walls(top, findings.parameters)
    low.axhline(0, color=GREY, lw=0.5)
    kinds = np.array([str(word).split()[0] for word in findings.words], dtype=np.str_)
    for kind, (marker, colour) in MARKS.items():
        chosen = kinds == kind
        if chosen.any():
            x, y = findings.times[chosen] / findings.period, findings.places[chosen]
            mark(top, (x, y), (marker, colour), NAMES.get(kind, kind))
    time_axis(low, findings)
    top.set_ylabel("positions $x_i$  [length]")
    low.set_ylabel(r"velocities $\dot x_i$  [length / time]")
    legend(top, figure, 8)
    _title(figure, findings, "Positions and velocities")


def portrait(findings: MassPortrait, figure: FigureBase) -> None:
    """Draw the projections to the planes of the masses; below, what is near the centre, larger."""
    n = len(findings.masses)
    island = findings.states[findings.near & findings.never]
    near = findings.centre is not None and len(island) > 0
    rows = figure.subplots(2 if near else 1, n, squeeze=False)
    for row in rows:
        for i, axes in enumerate(row):
            _walls(axes, findings)
            _points(axes, findings, i)
            axes.set_xlabel(f"$x_{i + 1}$  [length]")
        row[0].set_ylabel(STROBE)
    for i, axes in enumerate(rows[0]):
        axes.set_title(f"$m_{i + 1} = {short(str(findings.masses[i]))}$")
        if near:
            seen = _plane(island, i)
            framed(rows[1][i], np.nanmin(seen, axis=0), np.nanmax(seen, axis=0), 0.15)
        if findings.centre:
            star(rows[-1][i], (findings.centre[i], findings.centre[n + i]), None)
    figure.legend(handles=_legend(findings), loc="outside lower center", ncols=3, handlelength=0.9)
    periods = findings.states.shape[1] - 1
    _title(figure, findings, f"Stroboscopic portrait, {periods} periods, in projection")


def _points(axes: Axes, findings: MassPortrait, i: int) -> None:
    """Draw all orbits in the plane of one mass."""
    stopping = findings.states[findings.near & findings.stopped]
    dots(axes, _plane(stopping, i), "#AAAAAA", 0.6)
    far = findings.states[~findings.near]
    dots(axes, _plane(far[:, int(LATE * far.shape[1]) :], i), RED, 2.5)
    never = findings.states[findings.near & findings.never]
    for k, colour in enumerate(ISLAND):
        dots(axes, _plane(never[k :: len(ISLAND)], i), colour, 1.2)


def _legend(findings: MassPortrait) -> list[Artist]:
    """Return what the colours mean, with numbers of orbits."""
    groups = (
        (findings.near & findings.never, BLUE, "begin near the star, no mass stops"),
        (findings.near & findings.stopped, "#AAAAAA", "begin there, and a mass stops"),
        (~findings.near, RED, "begin anywhere: the last quarter"),
    )
    return [
        Patch(fc=colour, label=f"{words} ({int(chosen.sum())})")
        for chosen, colour, words in groups
        if chosen.any()
    ]


def attractors(findings: MassAttractors, figure: FigureBase) -> None:
    """Draw late states of all seeds in the planes of the masses, by what they end on."""
    planes = _planes(findings, figure)
    shades = [CYCLE[k % len(CYCLE)] for k in range(len(findings.found))]
    handles: list[Artist] = []
    for each, colour in zip(findings.found, shades, strict=True):
        for i, axes in enumerate(planes):
            size = 0.8 if each.kind == NEVER else 5
            dots(axes, _plane(each.states[:, None], i), colour, size)
        words = f"{each.kind} ({each.share:.1%})"
        handles.append(Patch(fc=colour, ec=BLACK, lw=0.4, label=words))
    if handles:
        figure.legend(handles=handles[:9], loc="outside lower center", ncols=3, handlelength=0.9)
    _title(figure, findings, f"Where {len(findings.label)} random seeds end, in projection")


def _planes(findings: OfMasses, figure: FigureBase) -> list[Axes]:
    """Return axes for each mass, of the same ranges."""
    n = len(findings.masses)
    rows = figure.subplots(1, n, squeeze=False, sharex=True, sharey=True)
    for i, axes in enumerate(rows[0]):
        _walls(axes, findings)
        axes.set_xlabel(f"$x_{i + 1}$  [length]")
        axes.set_title(f"$m_{i + 1} = {short(str(findings.masses[i]))}$")
    rows[0][0].set_ylabel(STROBE)
    return list(rows[0])


def _walls(axes: Axes, findings: OfMasses) -> None:
    axes.axhline(0, color=GREY, lw=0.5)
    walls(axes, findings.parameters, over_time=False)


def _plane(states: Floats, i: int) -> Floats:
    """Return the states of one mass, (K, 2)."""
    n = states.shape[-1] // 2
    return states[..., [i, n + i]].reshape(-1, 2)


def _title(figure: FigureBase, findings: OfMasses, words: str) -> None:
    rest = "" if findings.complete else "  (interrupted)"
    law = r",\ f_i = f m_i" if findings.proportional else ""
    masses = r",\ ".join(short(str(m)) for m in findings.masses)
    given = f"{parameters(findings.parameters)[:-1]},\\ m = ({masses}){law}$"
    figure.suptitle(f"{words}{rest}\n{given}", fontsize=10)
