"""Pictures of orbits in time, with the marks of their events."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase

from cap.floats.diagnostics.chatter import Chatter
from cap.floats.diagnostics.gallery import Gallery
from cap.floats.diagnostics.trajectory import Trajectory
from cap.floats.findings import Floats
from cap.floats.history import History
from cap.pictures.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    SYMBOLS,
    UNITS,
    legend,
    star,
    title,
    walls,
)

MARKS = {  # of events: marker, colour
    "hit r": ("v", BLUE),
    "hit l": ("^", BLUE),
    "turn": ("o", GREEN),
    "stick": ("s", RED),
    "release": ("D", ORANGE),
    "capture": ("X", PURPLE),
}


def orbit(findings: Trajectory, figure: FigureBase) -> None:
    """Draw x(t) and v(t) beside the orbit in the plane of (x, v)."""
    axes = figure.subplot_mosaic([["x", "plane"], ["v", "plane"]], width_ratios=[1.25, 1])
    position(axes["x"], findings)
    velocity(axes["v"], findings)
    axes["x"].tick_params(labelbottom=False)
    axes["x"].set_xlabel("")
    plane(axes["plane"], findings)
    legend(axes["plane"], figure, 8)
    title(figure, findings, "Orbit and its events")


def position(axes: Axes, findings: Trajectory) -> None:
    """Draw x(t), with the walls."""
    axes.plot(findings.t / findings.period, findings.x, color="black", lw=0.9)
    walls(axes, findings.parameters)
    for name, chosen in _events(findings).items():
        _mark(axes, name, findings.times[chosen] / findings.period, findings.places[chosen])
    time_axis(axes, findings)
    axes.set_ylabel(UNITS["x"])


def velocity(axes: Axes, findings: Trajectory) -> None:
    """Draw v(t); hits are jumps."""
    axes.axhline(0, color=GREY, lw=0.5)
    axes.plot(findings.t / findings.period, findings.v, color="black", lw=0.9)
    for name, chosen in _events(findings).items():
        _mark(axes, name, findings.times[chosen] / findings.period, findings.before[chosen])
    time_axis(axes, findings)
    axes.set_ylabel(UNITS["v"])


def plane(axes: Axes, findings: Trajectory) -> None:
    """Draw the orbit in the plane of (x, v), with its states at t = 0, T, …."""
    axes.axhline(0, color=GREY, lw=0.5)
    walls(axes, findings.parameters, over_time=False)
    axes.plot(findings.x, findings.v, color="black", lw=0.8)
    for name, chosen in _events(findings).items():
        _mark(axes, name, findings.places[chosen], findings.before[chosen])
    for k, state in enumerate(findings.strobe):
        star(axes, (state[0], state[1]), r"$t \equiv 0$ mod $T$" if k == 0 else None)
    axes.set_xlabel(UNITS["x"])
    axes.set_ylabel(UNITS["v"])


def time_axis(axes: Axes, findings: History) -> None:
    """Let the axis be the time, in periods."""
    axes.set_xlim(0, max(float(findings.t[-1]) / findings.period, 1e-9))
    axes.set_xlabel(UNITS["t"])


def _events(findings: Trajectory) -> dict[str, "np.ndarray[tuple[int], np.dtype[np.bool_]]"]:
    """Return which events bear which mark, for those that there are."""
    found = {}
    for name in MARKS:
        chosen = np.array(
            [str(w) == name or str(w).split()[0] == name for w in findings.words], bool
        )
        if chosen.any():
            found[name] = chosen
    return found


def _mark(axes: Axes, name: str, x: Floats, y: Floats) -> None:
    words = {"hit r": "hit at $r$", "hit l": "hit at $l$"}.get(name, name)
    mark(axes, (x, y), MARKS[name], words)


def mark(axes: Axes, at: tuple[Floats, Floats], look: tuple[str, str], words: str) -> None:
    """Mark places by a marker in a colour, and name it in the legend."""
    marker, colour = look
    axes.plot(*at, marker, ms=4.5, mfc="white", mec=colour, mew=1.1, ls="none", label=words)


def gallery(findings: Gallery, figure: FigureBase) -> None:
    """Draw one row for each value: x(t), and the orbit in the plane."""
    rows = max(1, len(findings.orbits))
    axes = figure.subplots(rows, 2, squeeze=False, width_ratios=[2.2, 1])
    for k, (value, found, each) in enumerate(
        zip(findings.values, findings.attractors, findings.orbits, strict=True)
    ):
        left, right = axes[k]
        position(left, each)
        plane(right, each)
        left.set_title(_regime(findings, k, float(value), found.kind), loc="left")
        for one in (left, right):
            one.set_xlabel(one.get_xlabel() if k == rows - 1 else "")
        left.set_ylabel("$x$  [length]")
        right.set_ylabel(r"$\dot x$  [length / time]")
    handles: dict[str, Any] = {}
    for row in axes:
        found_handles, labels = row[1].get_legend_handles_labels()
        handles |= dict(zip(labels, found_handles, strict=True))
    figure.legend([*handles.values()], [*handles], loc="outside lower center", ncols=8)
    title(figure, findings, f"Regimes over ${SYMBOLS[findings.parameter]}$")


def _regime(findings: Gallery, k: int, value: float, kind: str) -> str:
    words = f"${SYMBOLS[findings.parameter]} = {value:.6g}$: {kind}"
    if np.isfinite(findings.trace[k]):
        words += rf", tr $= {findings.trace[k]:.3f}$, det $= {findings.determinant[k]:.3f}$"
    return words


def chatter(findings: Chatter, figure: FigureBase) -> None:
    """Draw the orbit up to its capture, and the speeds and times of the hits on log scales."""
    axes = figure.subplots(1, 3, width_ratios=[1.3, 1, 1])
    orbit, wall = findings.orbit[0], findings.wall
    gap = np.abs(wall - orbit.x)
    begin = findings.times[0] - 0.35 * (findings.end - findings.times[0])
    chosen = orbit.t >= begin
    axes[0].plot(orbit.t[chosen], gap[chosen], color="black", lw=0.9)
    axes[0].plot(findings.times, np.zeros_like(findings.times), "v", ms=4, mfc="white", mec=BLUE,
                 mew=1, ls="none", clip_on=False, label="hits")  # fmt: skip
    axes[0].axvline(findings.end, color=PURPLE, ls="--", lw=0.9, label=r"$t_\infty$")
    axes[0].set_ylim(bottom=0)
    axes[0].set_xlabel("time $t$  [time]")
    axes[0].set_ylabel("distance from the wall  [length]")
    axes[0].legend()
    k = np.arange(1, len(findings.times) + 1)
    left = np.maximum(findings.end - findings.times, 1e-16)
    for each, values, name in (
        (axes[1], findings.speeds, "speed after the hit  [length / time]"),
        (axes[2], left, r"time left $t_\infty - t_k$  [time]"),
    ):
        each.semilogy(k, values, "o", ms=3.5, mfc="white", mec=BLUE, mew=1)
        line = values[-1] * findings.ratio ** (k - k[-1])
        each.semilogy(k, line, "--", color=RED, lw=0.9, label=f"ratio {findings.ratio:.5f}")
        each.set_xlabel("hit $k$")
        each.set_ylabel(name)
        each.legend()
    title(figure, findings, rf"Capture at $t_\infty = {findings.end:.9g}$: infinitely many hits")
