"""A curve of periodic orbits of a system of one's own, over its parameter.

All that is drawn is proved: the curve lies in boxes around the lines drawn that are smaller than a
pixel, unless they are drawn.
"""

import math
from collections.abc import Sequence
from itertools import groupby
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from cap.checker.theorems.contacts_branch import ContactsBranch
from cap.pictures.style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, legend
from cap.pictures.theorems.parts import middle, number

LOOKS: dict[str, tuple[str, str]] = {
    "fold": ("o", ORANGE),
    "flip": ("^", GREEN),
    "pair": ("s", PURPLE),
}
COLOURS = (BLUE, RED, GREY)  # none outside the unit circle, some, not said
WIDTHS = (2.0, 1.2, 1.2)
PIXEL = 1 / 600  # of what is shown
VARIES = 1e-6  # of a variable's size
PLACES = 5  # of the range, rounded inwards


def branch(theorem: ContactsBranch, figure: Figure) -> None:
    """Draw the time of the first contact, and a variable then that varies, over the parameter."""
    claims, p = theorem.claims, theorem.p
    cells, name = claims["cells"], p.state[-1]
    time = "period" if p.autonomous else "time"
    varied = varying(cells, len(p.state) - 1)
    rows = [(0, f"{time} of the first contact"), (varied, f"{p.state[varied - 1]} just before it")]
    symmetric = "symmetric " if "symmetry" in claims else ""
    kinds = {"flip": "multiplier -1 of half a round"} if symmetric else {}
    panels = figure.subplots(len(rows), 1, sharex=True)
    for axes, (row, words) in zip(panels, rows, strict=True):
        named = set[str]()
        for outside, group in groupby(cells, lambda cell: cell.get("outside")):
            lines = [ends(cell, row) for cell in group]
            kind = 2 if outside is None else min(outside, 1)
            label = told(outside, len(p.state) - 1)
            points = np.concatenate(lines)
            axes.plot(*points.T, color=COLOURS[kind], lw=WIDTHS[kind],
                      label=f"_{label}" if label in named else label)  # fmt: skip
            named.add(label)
        for cell in cells:
            around(axes, cell, row)
        for point in claims["points"]:
            marker, colour = LOOKS[point["kind"]]
            at, place = middle(point["at"]), float(point["short"]["centre"][row])
            label = (
                f"{kinds.get(point['kind'], point['kind'])} at {name} = {number(point['at'], 12)}"
            )
            axes.plot(at, place, marker, ms=6.5, mfc=colour, mec=BLACK, mew=0.8, ls="none",
                      label=label, zorder=3)  # fmt: skip
        grazes = [(graze, "graze") for graze in claims["grazes"]]
        lost = [(end, f"contact {end['contact']} lost") for end in claims.get("lost", ())]
        for end, what in (*grazes, *lost):
            label = f"{what} at {name} = {number(end['at'], 12)}"
            place = float(end["short"]["centre"][row])
            axes.plot(middle(end["at"]), place, "D", ms=5.5, mfc="white", mec=BLACK, mew=0.8,
                      ls="none", label=label, zorder=3)  # fmt: skip
        axes.set_ylabel(words)
    panels[-1].set_xlabel(f"parameter {name}")
    legend(panels[0], figure, 2)
    low, high = claims["range"]
    shown = math.ceil(low * 10**PLACES) / 10**PLACES, math.floor(high * 10**PLACES) / 10**PLACES
    figure.suptitle(
        f"A curve of {symmetric}periodic orbits, {len(cells)} pieces, on which {name} takes all "
        f"values in [{shown[0]:g}, {shown[1]:g}]\n(the certificate is VERIFIED)",
        fontsize=10,
    )


def varying(cells: Sequence[dict[str, Any]], count: int) -> int:
    """Return the first of so many variables that is seen to vary at the first contact, or 1."""
    for row in range(1, count + 1):
        places = [float(cell["centre"][row]) for cell in cells]
        if max(places) - min(places) > VARIES * max(map(abs, places)):
            return row
    return 1


def told(outside: int | None, count: int) -> str:
    """Return what is proved of the multipliers."""
    if outside is None:
        return "multipliers: nothing is claimed"
    return f"{outside} of {count} multipliers outside the unit circle, none on it"


def ends(cell: dict[str, Any], row: int) -> NDArray[np.float64]:
    """Return the parameter and an unknown (2, 2) at both ends of a piece."""
    low, high = cell["ends"]
    along, s0 = cell["along"], (low + high) / 2
    places = []
    for s in (low, high):
        z = [c + m * (s - s0) for c, m in zip(cell["centre"], cell["slope"], strict=True)]
        z[along] = s
        places.append((float(z[-1]), float(z[row])))
    return np.array(places)


def around(axes: Any, cell: dict[str, Any], row: int) -> None:
    """Draw the box of a piece, if it is seen."""
    (x0, y0), (x1, y1) = ends(cell, row)
    reach = [float(r) for r in cell["reach"]]
    rx, ry = reach[-1], reach[row]
    (left, right), (down, up) = axes.get_xlim(), axes.get_ylim()
    if rx > PIXEL * (right - left) or ry > PIXEL * (up - down):
        corner = min(x0, x1) - rx, min(y0, y1) - ry
        size = abs(x1 - x0) + 2 * rx, abs(y1 - y0) + 2 * ry
        axes.add_patch(Rectangle(corner, *size, fc="none", ec=GREY, lw=0.4))
