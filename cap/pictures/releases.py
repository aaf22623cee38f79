"""Pictures of the release map: its graph, and its orbits over a parameter."""

from collections import Counter

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Rectangle

from cap.floats.diagnostics.return_map import ReleaseMap, ReleaseOrbits
from cap.floats.findings import Floats
from cap.pictures.style import BLACK, BLUE, CYCLE, GREY, ORANGE, RED, SYMBOLS, title

STYLES = ("-", "--", ":")  # one for each round of the colours
RARE = 0.01  # of the places
WIDE = 0.004  # of the range of a parameter: a window so wide has room for its period


def release(findings: ReleaseMap | ReleaseOrbits, figure: FigureBase) -> None:
    """Draw the graph, or the orbits."""
    if isinstance(findings, ReleaseMap):
        graph(findings, figure)
    else:
        orbits(findings, figure)


def graph(findings: ReleaseMap, figure: FigureBase) -> None:
    """Draw G by branches, the diagonal, an orbit as a cobweb; beside it the interval, enlarged."""
    trapped = bool(np.isfinite(findings.critical))
    axes = figure.subplots(1, 2 if trapped else 1, squeeze=False)[0]
    _branches(findings, axes[0])
    _cobweb(findings.orbit, axes[0])
    axes[0].legend(title="hits, turns", loc="upper left", ncols=2)
    limits = float(findings.parameters.l), float(findings.parameters.r)
    axes[0].set_xlim(limits)
    axes[0].set_ylim(limits)
    axes[0].set_title("all releases to the right")
    if trapped:
        low, high = findings.interval
        axes[0].add_patch(_square(low, high))
        _inside(findings, axes[1])
    for each in axes:
        each.plot(limits, limits, color=GREY, lw=0.6, ls="--", zorder=0)
        each.set_xlabel("place $x$ of a release  [length]")
        each.set_ylabel("next release $G(x)$, mirrored  [length]")
        each.set_aspect("equal")
    title(figure, findings, "Release map")


def _branches(findings: ReleaseMap, axes: Axes) -> None:
    """Draw each branch in the colour and style of its events, rare ones in grey."""
    events = list(zip(findings.hits.tolist(), findings.turns.tolist(), strict=True))
    seen = Counter(pair for pair, n in zip(events, findings.half_periods, strict=True) if n)
    common = sorted(pair for pair, count in seen.items() if count > RARE * len(findings.x))
    common = common[: len(STYLES) * len(CYCLE)]
    rounds = [divmod(k, len(CYCLE)) for k in range(len(common))]
    styles = {pair: (STYLES[n], CYCLE[k]) for pair, (n, k) in zip(common, rounds, strict=True)}
    for pair, (style, colour) in styles.items():
        axes.plot([], [], style, color=colour, lw=1.1, label="{}, {}".format(*pair))
    axes.plot([], [], ".", ms=3, color=GREY, label="others")
    for k in range(int(findings.branch.max()) + 1):
        own = np.flatnonzero(findings.branch == k)
        style, colour = styles.get(events[own[0]], (".", GREY))
        mark = style if len(own) > 2 else "."
        axes.plot(findings.x[own], findings.value[own], mark, ms=1.5, color=colour, lw=1.1)


def _cobweb(orbit: Floats, axes: Axes) -> None:
    """Draw an orbit: up or down to the graph, across to the diagonal."""
    x = np.repeat(orbit, 2)
    axes.plot(x[:-1], x[1:], color=BLACK, lw=0.35, alpha=0.7, zorder=1)


def _square(low: float, high: float) -> Rectangle:
    return Rectangle((low, low), high - low, high - low, fill=False, ec=RED, lw=1.0)


def _inside(findings: ReleaseMap, axes: Axes) -> None:
    """Draw the interval that is mapped into itself, with late iterates on the graph."""
    low, high = findings.interval
    own = (findings.x >= low) & (findings.x <= high)
    axes.plot(findings.x[own], findings.value[own], color=BLUE, lw=1.2)
    settled = findings.orbit[len(findings.orbit) // 4 :]
    _cobweb(settled, axes)
    late = findings.late[(findings.late >= low) & (findings.late <= high)]
    axes.plot(
        late, np.full_like(late, low), "|", ms=5, color=ORANGE, alpha=0.5, label="late iterates"
    )
    axes.axvline(findings.critical, color=RED, lw=0.7, ls=":", label="critical point")
    axes.set_xlim(low, high)
    axes.set_ylim(low, high)
    axes.legend(loc="center right", frameon=True, framealpha=1, edgecolor="none")
    axes.set_title("an interval mapped into itself")


def _windows(findings: ReleaseOrbits, above: Axes, below: Axes) -> None:
    """Shade the windows of attracting cycles; write the periods at those that have room."""
    least = WIDE * (findings.values[-1] - findings.values[0])
    for low, high, period in findings.windows():
        for axes in (above, below):
            axes.axvspan(low, high, color=ORANGE, alpha=0.18, lw=0, zorder=0)
        if high - low > least:
            above.annotate(
                str(period), ((low + high) / 2, 0.97), xycoords=("data", "axes fraction"),
                ha="center", va="top", fontsize=8,
            )  # fmt: skip
    if findings.windows():
        above.set_title(
            "shaded: the orbits seen settle on cycles of one period, given where there is room",
            fontsize=9,
        )


def orbits(findings: ReleaseOrbits, figure: FigureBase) -> None:
    """Draw late iterates over the parameter, and the mean of log |G'| below."""
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    x = np.broadcast_to(findings.values[:, None], findings.late.shape)
    above.plot(x.ravel(), findings.late.ravel(), ".", ms=1.0, mew=0, color=BLUE, rasterized=True)
    above.set_ylabel("place of a release  [length]")
    _windows(findings, above, below)
    below.plot(findings.values, findings.exponent, color=RED, lw=0.7)
    below.axhline(0, color=GREY, lw=0.6)
    below.set_ylabel(r"mean of $\log |G'|$")
    finite = findings.exponent[np.isfinite(findings.exponent)]
    below.set_ylim(
        max(-2.0, float(finite.min(initial=0.0)) * 1.1), float(finite.max(initial=0.1)) * 1.2
    )
    below.set_xlabel(f"${SYMBOLS[findings.parameter]}$")
    title(figure, findings, "Orbits of the release map")
