"""Pictures of the release map: its graph, and its orbits over a parameter."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Rectangle

from cap.floats.return_map import ReleaseMap, ReleaseOrbits
from cap.floats.study import Floats
from cap.pictures.style import BLACK, BLUE, CYCLE, GREY, ORANGE, RED, SYMBOLS, parameters, title

RARE = 0.01  # of the places


def release(study: ReleaseMap | ReleaseOrbits, figure: FigureBase) -> None:
    """Draw the graph, or the orbits."""
    if isinstance(study, ReleaseMap):
        graph(study, figure)
    else:
        orbits(study, figure)


def graph(study: ReleaseMap, figure: FigureBase) -> None:
    """Draw G by branches, the diagonal, an orbit as a cobweb; beside it the interval, enlarged."""
    trapped = bool(np.isfinite(study.critical))
    axes = figure.subplots(1, 2 if trapped else 1, squeeze=False)[0]
    _branches(study, axes[0])
    _cobweb(study.orbit, axes[0])
    axes[0].legend(title="half-periods", loc="upper left", ncols=2)
    limits = float(study.parameters.l), float(study.parameters.r)
    axes[0].set_xlim(limits)
    axes[0].set_ylim(limits)
    axes[0].set_title("all releases to the right")
    if trapped:
        low, high = study.interval
        axes[0].add_patch(_square(low, high))
        _inside(study, axes[1])
    for each in axes:
        each.plot(limits, limits, color=GREY, lw=0.6, ls="--", zorder=0)
        each.set_xlabel("place $x$ of a release  [length]")
        each.set_ylabel("next release $G(x)$, mirrored  [length]")
        each.set_aspect("equal")
    title(figure, study, "Release map")


def _branches(study: ReleaseMap, axes: Axes) -> None:
    """Draw each branch in the colour of its duration, rare ones in grey."""
    durations, counts = np.unique(study.half_periods, return_counts=True)
    common = [int(n) for n in durations[counts > RARE * len(study.x)] if n]
    colours = {n: CYCLE[k % len(CYCLE)] for k, n in enumerate(common)}
    for n, colour in colours.items():
        axes.plot([], [], color=colour, lw=1.1, label=str(n))
    axes.plot([], [], ".", ms=3, color=GREY, label="others")
    for k in range(int(study.branch.max()) + 1):
        own = study.branch == k
        n = int(study.half_periods[own][0])
        mark = "-" if n in colours and own.sum() > 2 else "."
        axes.plot(study.x[own], study.value[own], mark, ms=1.5, color=colours.get(n, GREY), lw=1.1)


def _cobweb(orbit: Floats, axes: Axes) -> None:
    """Draw an orbit: up or down to the graph, across to the diagonal."""
    x = np.repeat(orbit, 2)
    axes.plot(x[:-1], x[1:], color=BLACK, lw=0.35, alpha=0.7, zorder=1)


def _square(low: float, high: float) -> Rectangle:
    return Rectangle((low, low), high - low, high - low, fill=False, ec=RED, lw=1.0)


def _inside(study: ReleaseMap, axes: Axes) -> None:
    """Draw the interval that is mapped into itself, with late iterates on the graph."""
    low, high = study.interval
    own = (study.x >= low) & (study.x <= high)
    axes.plot(study.x[own], study.value[own], color=BLUE, lw=1.2)
    settled = study.orbit[len(study.orbit) // 4 :]
    _cobweb(settled, axes)
    late = study.late[(study.late >= low) & (study.late <= high)]
    axes.plot(
        late, np.full_like(late, low), "|", ms=5, color=ORANGE, alpha=0.5, label="late iterates"
    )
    axes.axvline(study.critical, color=RED, lw=0.7, ls=":", label="critical point")
    axes.set_xlim(low, high)
    axes.set_ylim(low, high)
    axes.legend(loc="center right", frameon=True, framealpha=1, edgecolor="none")
    axes.set_title("an interval mapped into itself")


def orbits(study: ReleaseOrbits, figure: FigureBase) -> None:
    """Draw late iterates over the parameter, and the mean of log |G'| below."""
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    x = np.broadcast_to(study.values[:, None], study.late.shape)
    above.plot(x.ravel(), study.late.ravel(), ".", ms=1.0, mew=0, color=BLUE, rasterized=True)
    above.set_ylabel("place of a release  [length]")
    below.plot(study.values, study.exponent, color=RED, lw=0.7)
    below.axhline(0, color=GREY, lw=0.6)
    below.set_ylabel(r"mean of $\log |G'|$")
    finite = study.exponent[np.isfinite(study.exponent)]
    below.set_ylim(
        max(-2.0, float(finite.min(initial=0.0)) * 1.1), float(finite.max(initial=0.1)) * 1.2
    )
    below.set_xlabel(f"${SYMBOLS[study.parameter]}$")
    rest = "" if study.complete else "  (interrupted)"
    shown = parameters(study.parameters, but=(study.parameter,))
    figure.suptitle(f"Orbits of the release map{rest}\n{shown}", fontsize=10)
