"""A capture: orbits of a box, whose hits accumulate at a wall, where they rest until a release."""

import math

import numpy as np
from matplotlib.figure import Figure

from cap.checker.kernel.theorem import Theorem
from cap.floats.diagnostics.trajectory import trajectory
from cap.pictures.style import BLACK, CYCLE, ORANGE, PURPLE, UNITS
from cap.pictures.theorems.parts import around, box, heading, number, plane, system

SEEN = 0.2  # of a period, after the release
TINY = 1e-9  # of a distance that is drawn
GRID = 3  # orbits in floats on a side of the box


def capture(theorem: Theorem, figure: Figure) -> None:
    """Draw orbits of the box in time, with what is proved of all of them, and the box."""
    claims, p = theorem.claims, system(theorem)
    T, wall = 2 * math.pi / float(p.omega), float(p.r if claims["wall"] == "r" else p.l)
    time, sides = figure.subplots(1, 2, width_ratios=[2, 1])
    end = float(claims["release_time"].upper) / T + SEEN
    (a, b), (c, d) = ((float(claims["box"][z].lower), float(claims["box"][z].upper)) for z in "xv")
    part = (np.arange(GRID) + 0.5) / GRID
    starts = [(a + s * (b - a), c + u * (d - c)) for s in part for u in part]
    for k, start in enumerate(starts):
        found = trajectory(p, orbit=start, exactly=True, periods=end)
        look = {"color": CYCLE[k % len(CYCLE)], "lw": 0.8}
        away = np.abs(found.x - wall)
        words = "_" if k else "orbits of the box (floats)"
        time.semilogy(found.t / T, np.where(away > TINY, away, np.nan), label=words, **look)
        sides.plot(*start, ".", color=look["color"], ms=5)
    when = claims["accumulation_time"]
    low, high = float(when.lower) / T, float(when.upper) / T
    words = "in here their hits accumulate (proved)"
    time.axvspan(low, high, color=PURPLE, alpha=0.2, lw=0, label=words)
    release = float(claims["release_time"].lower) / T
    words = f"all are released at t = {number(claims['release_time'])} (proved)"
    time.axvline(release, color=ORANGE, lw=1.2, label=words)
    time.set(xlim=(0, end), xlabel=UNITS["t"], ylim=(TINY, None),
             ylabel="distance from the wall  [length]")  # fmt: skip
    time.set_title(", ".join(claims["itinerary"]))
    box(sides, (claims["box"]["x"], claims["box"]["v"]), "all of it is captured (proved)")
    around(sides, (claims["box"]["x"], claims["box"]["v"]), 0.2)
    plane(sides)
    sides.ticklabel_format(useOffset=False)
    sides.locator_params(axis="x", nbins=3)  # long labels: 0.98999
    sides.set_title("the box at $t = 0$")
    sides.axhline(0, color=BLACK, lw=0.3)
    figure.legend(loc="outside lower center", ncols=2)
    heading(figure, theorem, f"A box is captured at the wall {claims['wall']}")
