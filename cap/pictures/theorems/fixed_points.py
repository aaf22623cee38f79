"""Periodic orbits of one mass: in time, their state in the box where it is alone, multipliers."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Theorem
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters
from cap.pictures.style import BLACK, BLUE, CYCLE, GREEN, legend
from cap.pictures.theorems.parts import (
    CIRCLE,
    around,
    box,
    heading,
    in_time,
    middle,
    multipliers,
    number,
    plane,
    point,
    system,
)

PALE_GREEN = "#CDEBE2"
OVER = colormaps["viridis"]
SMALL = 0.02  # of what is shown: what cannot be seen
RINGS, PERIODS = 9, 400  # of the portrait in floats around an elliptic point
ONE = "in it exactly one fixed point (proved)"


def elliptic(theorem: Theorem, figure: Figure) -> None:
    """Draw an elliptic orbit, with closed curves around its state as floats have them."""
    claims = theorem.claims
    axes = _orbit(theorem, figure, ("hit r", "hit l"), 1)
    rings(axes["plane"], system(theorem), claims)
    angle, turn = middle(claims["rotation_angle"]), number(claims["rotation_number"])
    pair = [complex(math.cos(angle), s * math.sin(angle)) for s in (1, -1)]
    twist = number(claims["twist"])
    told = rf"$e^{{\pm i\Theta}}$, $|\Theta|/2\pi$ = {turn}, twist $\tau_1$ = {twist}"
    multipliers(axes["multipliers"], pair, told)
    heading(figure, theorem, "An elliptic periodic orbit")


def saddle(theorem: Theorem, figure: Figure) -> None:
    """Draw a saddle."""
    axes = _orbit(theorem, figure, ("hit r", "hit l"), 1)
    _multipliers(axes["multipliers"], theorem.claims["multipliers"])
    heading(figure, theorem, "A saddle")


def periodic(theorem: Theorem, figure: Figure) -> None:
    """Draw a periodic orbit with any events; of one that attracts the ellipse it attracts."""
    claims = theorem.claims
    axes = _orbit(theorem, figure, claims["itinerary"], claims["period"])
    _multipliers(axes["multipliers"], claims["multipliers"])
    if "basin" in claims:
        ellipse(axes["plane"], claims, claims["basin"]["matrix"], "attracted (proved)")
        axes["plane"].legend(loc="upper right", fontsize=7.5)
    heading(figure, theorem, f"A periodic orbit: {claims['type']}, of period {claims['period']} T")


def _orbit(
    theorem: Theorem,
    figure: Figure,
    words: Sequence[str],
    periods: int,
    *more: str,
    wide: bool = False,
) -> dict[str, Axes]:
    """Draw the orbit in time, and its state in its box; return the axes, ``more`` beside them."""
    claims, p = theorem.claims, system(theorem)
    below = ["plane"] if wide else ["plane", "multipliers", *more]
    rows: list[Any] = [["time"] * len(below), below]
    axes = figure.subplot_mosaic(rows, height_ratios=[1, 1.25])
    state = middle(claims["x"]), middle(claims["v"])
    times = claims["event_times" if "event_times" in claims else "hit_times"]
    in_time(axes["time"], p, state, list(zip(words, times, strict=True)), periods)
    sides = claims["box"]["x"], claims["box"]["v"]
    box(axes["plane"], sides, ONE)
    around(axes["plane"], sides)
    point(axes["plane"], claims, None)
    plane(axes["plane"])
    told = f"$x^*$ = {number(claims['x'], 12)}\n$\\dot x^*$ = {number(claims['v'], 12)}"
    axes["plane"].set_title(told)
    axes["plane"].legend(loc="upper right", fontsize=7.5)
    legend(axes["time"], figure)
    return axes


def rings(axes: Axes, p: Parameters, claims: dict[str, Any]) -> None:
    """Draw orbits in floats that start between the fixed point and the rim of what is shown."""
    x, v = middle(claims["x"]), middle(claims["v"])
    reach = axes.get_xlim()[1] - x
    starts = [(x + reach * (k + 1) / RINGS, v) for k in range(RINGS)]
    found = swarm.follow(p, starts, PERIODS, every=True)
    stopped = found.stopped
    for k, path in enumerate(found.states):
        if not stopped[k]:
            dots(axes, path, CYCLE[k % len(CYCLE)])
    axes.plot([], [], ".", color=BLACK, ms=2, label="orbits once a period (floats)")
    axes.legend(loc="upper right", fontsize=7.5)


def dots(axes: Axes, states: Floats, colour: str) -> None:
    """Draw the states of an orbit in floats."""
    axes.plot(states[:, 0], states[:, 1], ".", ms=1.0, mew=0, color=colour, zorder=1)


def ellipse(axes: Axes, claims: dict[str, Any], matrix: Any, words: str) -> None:
    """Draw the ellipse |W (z - P*)| <= 1."""
    W = np.array([[float(q) for q in row] for row in matrix])
    shape = np.linalg.solve(W, np.stack([CIRCLE.real, CIRCLE.imag]))
    x, v = middle(claims["x"]), middle(claims["v"])
    if np.ptp(shape[0]) < SMALL * (axes.get_xlim()[1] - axes.get_xlim()[0]):
        words += ": smaller than the star"
    axes.fill(x + shape[0], v + shape[1], fc="none", ec=GREEN, lw=1.0, label=words)


def _multipliers(axes: Axes, claimed: Any) -> None:
    """Draw multipliers, real or a pair."""
    first, second = claimed
    if isinstance(first, Enclosure):
        told = f"{number(first)},  {number(second)}"
        multipliers(axes, [complex(middle(first)), complex(middle(second))], told)
    else:
        pair = [complex(middle(claim["re"]), middle(claim["im"])) for claim in claimed]
        multipliers(axes, pair, rf"{number(first['re'])} $\pm\ i$ {number(first['im'])}")


def persistence(theorem: Theorem, figure: Figure) -> None:
    """Draw an orbit that persists, and the boxes of its states over the range of losses."""
    claims = theorem.claims
    axes = _orbit(theorem, figure, claims["itinerary"], claims["period"], "range")
    _multipliers(axes["multipliers"], claims["multipliers"])
    if "basin" in claims:
        ellipse(axes["plane"], claims, claims["basin"]["matrix"], "attracted (proved)")
        axes["plane"].legend(loc="upper right", fontsize=7.5)
    epsilon, mu = (claims["range"][name] for name in ("epsilon", "mu"))
    cells = len(mu) - 1
    for k, sides in enumerate(claims["range"]["boxes"]):
        part = (k // cells) / max(1, len(epsilon) - 2)
        box(axes["range"], (sides["x"], sides["v"]), None, fc="none", ec=OVER(part), lw=0.6)
    axes["range"].autoscale_view()
    plane(axes["range"])
    most = f"$1 - e \\leq {float(epsilon[-1]):g}$, $\\mu \\leq {float(mu[-1]):g}$"
    axes["range"].set_title(f"a box for each cell of {most}\n(proved; yellow: large $1 - e$)")
    heading(figure, theorem, f"An orbit that persists: {claims['type']}")


def effective_stability(theorem: Theorem, figure: Figure) -> None:
    """Draw the two ellipses around the state of an orbit."""
    claims = theorem.claims
    axes = _orbit(theorem, figure, ("hit r", "hit l"), 1, wide=True)["plane"]
    rings(axes, system(theorem), claims)
    c, A = ([float(q) for q in claims["centre"]], np.array(claims["axes"], dtype=float))
    shape, kappa = A @ np.stack([CIRCLE.real, CIRCLE.imag]), float(claims["part"])
    periods = f"{float(claims['periods']):.0e}".replace("e+0", "e").replace("1e", "10^")
    axes.fill(c[0] + shape[0], c[1] + shape[1], fc="none", ec=BLUE, lw=1.2,
              label=f"$E$: there at all $nT$, $|n| \\leq {periods}$ (proved)")  # fmt: skip
    axes.fill(c[0] + kappa * shape[0], c[1] + kappa * shape[1], fc=PALE_GREEN, ec=GREEN, lw=1.2,
              zorder=0.8, label="$E'$: what starts here is in $E$ (proved)")  # fmt: skip
    axes.legend(loc="upper left", fontsize=8)
    heading(figure, theorem, "Nothing leaves by far, and nothing stops, for very long")
