"""Periodic orbits of one mass: in time, their state in the box where it is alone, multipliers."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Theorem
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters
from cap.pictures.style import BLACK, CYCLE, GREEN
from cap.pictures.theorems.parts import (
    CIRCLE,
    around,
    box,
    heading,
    in_time,
    legend,
    middle,
    multipliers,
    number,
    plane,
    point,
    system,
)

RINGS, PERIODS = 9, 400  # of the portrait in floats around an elliptic point
ONE = "in it exactly one fixed point (proved)"


def elliptic(theorem: Theorem, figure: Figure) -> None:
    """Draw an elliptic orbit, with closed curves around its state as floats have them."""
    claims = theorem.claims
    axes = _orbit(theorem, figure, [("hit r", "hit l")], 1)
    rings(axes["plane"], system(theorem), claims)
    angle, turn = middle(claims["rotation_angle"]), number(claims["rotation_number"])
    pair = [complex(math.cos(angle), s * math.sin(angle)) for s in (1, -1)]
    twist = number(claims["twist"])
    told = rf"$e^{{\pm i\Theta}}$, $|\Theta|/2\pi$ = {turn}, twist $\tau_1$ = {twist}"
    multipliers(axes["multipliers"], pair, told)
    heading(figure, theorem, "An elliptic periodic orbit")


def saddle(theorem: Theorem, figure: Figure) -> None:
    """Draw a saddle."""
    axes = _orbit(theorem, figure, [("hit r", "hit l")], 1)
    _multipliers(axes["multipliers"], theorem.claims["multipliers"])
    heading(figure, theorem, "A saddle")


def periodic(theorem: Theorem, figure: Figure) -> None:
    """Draw a periodic orbit with any events; of one that attracts the ellipse it attracts."""
    claims = theorem.claims
    axes = _orbit(theorem, figure, [claims["itinerary"]], claims["period"])
    _multipliers(axes["multipliers"], claims["multipliers"])
    if "basin" in claims:
        ellipse(axes["plane"], claims, claims["basin"]["matrix"], "attracted (proved)")
        axes["plane"].legend(loc="upper right", fontsize=7.5)
    heading(figure, theorem, f"A periodic orbit: {claims['type']}, of period {claims['period']} T")


def _orbit(theorem: Theorem, figure: Figure, words: Any, periods: int) -> dict[str, Axes]:
    """Draw the orbit in time, and its state in its box; return the axes."""
    claims, p = theorem.claims, system(theorem)
    axes = figure.subplot_mosaic(
        [["time", "time"], ["plane", "multipliers"]], height_ratios=[1, 1.25]
    )
    state = middle(claims["x"]), middle(claims["v"])
    times = claims["event_times" if "event_times" in claims else "hit_times"]
    in_time(axes["time"], p, state, list(zip(words[0], times, strict=True)), periods)
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
    stopped = found.turned | found.stuck | found.captured
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
