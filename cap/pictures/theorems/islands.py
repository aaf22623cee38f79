"""Sets of motions that never stop: an island, all fixed points, where all launches must lie."""

from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from cap.checker.strips.columns import UNIT, columns, lines
from cap.checker.strips.overlap import Gap, gaps, mirrored
from cap.checker.theorems.conservative import Conservative
from cap.checker.theorems.converse import Converse
from cap.checker.theorems.inventory import Inventory
from cap.checker.theorems.island import Island
from cap.checker.tori.rings import offsets
from cap.checker.tori.written import coefficients
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.parameters import Parameters
from cap.pictures.style import BLACK, BLUE, CYCLE, GREY, ORANGE, RED, UNITS, framed, walls
from cap.pictures.theorems.parts import (
    PALE_BLUE,
    curve,
    heading,
    middle,
    number,
    plane,
    point,
    system,
)

TURN = np.linspace(0, 2 * np.pi, 1201)
RINGS, PERIODS = 24, 400  # orbits in floats around a curve
FAR = 2.2  # of its sizes, how far out they start
SEGMENTS = 8  # of a column
MARKERS = "*os^"


def island(theorem: Island, figure: Figure) -> None:
    """Draw the invariant curve, what is inside of it, and orbits in floats around it."""
    claims, p = theorem.claims, system(theorem)
    scale = float(p.F / p.omega**2), float(p.F / p.omega)
    x, v = (_curve(theorem, name, unit) for name, unit in zip("xv", scale, strict=True))
    x += float(p.l + p.r) / 2
    axes = figure.subplots()
    centre = middle(claims["x"]), middle(claims["v"])
    _orbits(axes, p, centre, FAR * (x.max() - centre[0]))
    words = f"inside nothing ever stops: area {number(claims['area'])} (proved)"
    axes.fill(x, v, fc=PALE_BLUE, ec="none", zorder=2, label=words)
    axes.plot(x, v, color=BLUE, lw=1.2, zorder=3, label="invariant curve (proved)")
    point(axes, claims)
    framed(axes, (x.min(), v.min()), (x.max(), v.max()), 0.6)
    plane(axes)
    figure.legend(loc="outside lower center", ncols=2)
    quotients = claims["rotation_number"]
    told = ", ".join(map(str, [*quotients["head"], *quotients["period"]]))
    heading(
        figure, theorem, f"An island: rotation number $[0; {told}, \\ldots]$ of {claims['map']}"
    )


def converse(theorem: Converse, figure: Figure) -> None:
    """Draw the polygons, and orbits in floats around their center."""
    claims, p = theorem.claims, system(theorem)
    scale = np.array([float(p.F / p.omega**2), float(p.F / p.omega)])
    centre = np.array([middle(claims["x"]), middle(claims["v"])])
    rings = [centre + 1e-9 * scale * np.array(offsets(words)) for words in claims["rings"]]
    axes = figure.subplots()
    _orbits(axes, p, (centre[0], centre[1]), rings[0][:, 0].max() - centre[0])
    for n, ring in enumerate(rings):
        last = n + 1 == len(rings)
        label = "no connected set of states around P* whose motions never stop meets these (proved)"
        look: dict[str, Any] = {"lw": 1.2 if last else 0.7, "label": label if last else None}
        axes.plot(*np.append(ring, ring[:1], axis=0).T, color=RED, zorder=2, **look)
    point(axes, claims)
    framed(axes, rings[0].min(axis=0), rings[0].max(axis=0), 0.1)
    plane(axes)
    figure.legend(loc="outside lower center")
    area = f"{float(claims['area']):g}"
    heading(figure, theorem, f"No invariant disk around $P^*$ without stops is larger than {area}")


def _curve(theorem: Island, name: str, unit: float) -> Floats:
    """Return a component of the curve in units of the parameters, from the middle of the walls."""
    values = curve(coefficients(theorem.claims["curve"][name]), theorem.hints["places"], TURN)
    return unit * values


def _orbits(axes: Axes, p: Parameters, centre: tuple[float, float], out: float) -> None:
    """Draw orbits in floats that start up to so far from the centre."""
    starts = [(centre[0] + out * (k + 1) / RINGS, centre[1]) for k in range(RINGS)]
    found = swarm.follow(p, starts, PERIODS, every=True)
    for path, stops in zip(found.states, found.stopped, strict=True):
        axes.plot(*path.T, ".", ms=1, mew=0, color=ORANGE if stops else GREY, zorder=1)
    axes.plot([], [], ".", ms=4, color=GREY, label="orbits once a period (floats)")
    axes.plot([], [], ".", ms=4, color=ORANGE, label="orbits that stop (floats)")


def inventory(theorem: Inventory, figure: Figure) -> None:
    """Draw all fixed points of orbits that never stop, and these orbits in time."""
    claims, p = theorem.claims, system(theorem)
    states, time = figure.subplots(1, 2, width_ratios=[1, 1.3])
    for k, each in enumerate(claims["fixed_points"]):
        x, v = middle(each["x"]), middle(each["v"])
        words = f"trace {number(each['trace'])}"
        look: dict[str, Any] = {"color": CYCLE[k], "zorder": 3 - 0.1 * k}
        states.plot(x, v, MARKERS[k], ms=9 - k, mec=BLACK, mew=0.6, label=words, **look)
        found = trajectory(p, orbit=(x, v), exactly=True, periods=1)
        time.plot(found.t / found.period, found.x, lw=1.0, **look)
    walls(states, p, over_time=False)
    walls(time, p)
    plane(states)
    open_boxes = claims["undecided"]["boxes"]
    states.set_title("there is none" if not claims["fixed_points"] else "their states (proved)")
    time.set(xlabel=UNITS["t"], ylabel=UNITS["x"], xlim=(0, 1))
    time.set_title("their orbits (floats)")
    if claims["fixed_points"]:
        figure.legend(loc="outside lower center", ncols=4)
    family = "; a family that touches no wall, and turns, is not counted" * bool(claims["families"])
    rest = f"but for what {open_boxes} boxes leave open" if open_boxes else "none is left out"
    count = len(claims["fixed_points"])
    what = (
        f"All {count} orbits of period $T$ that never stop" if count else "No orbit of period $T$"
    )
    what += "" if count else " never stops"
    heading(figure, theorem, f"{what}, {rest}{family}")


def conservative(theorem: Conservative, figure: Figure) -> None:
    """Draw where launches lie whose orbits never stop: in gaps of both families."""
    hints, claims = theorem.hints, theorem.claims
    at = lines(hints["lines"])
    t = np.array([np.linspace(a, b, SEGMENTS + 1) for a, b in pairwise(at)])
    forward = [bands(gaps(column)) for column in columns(hints["forward"])]
    backward = [bands(mirrored(gaps(column))) for column in reversed(columns(hints["backward"]))]
    axes = figure.subplots()
    _filled(axes, t, forward, BLUE, 0.18)
    _filled(axes, t, backward, RED, 0.18)
    _filled(axes, t, list(map(shared, forward, backward)), BLACK, 1.0)
    for colour, alpha, words in (
        (BLUE, 0.18, "forwards not shown to stop"),
        (RED, 0.18, "backwards not shown to stop"),
        (BLACK, 1.0, f"neither: area at most {float(claims['area']):g} (proved)"),
    ):
        axes.fill([], [], fc=colour, alpha=alpha, label=words)
    axes.autoscale_view()
    axes.set(xlabel=r"time $\omega t$ of a launch from the wall $l$",
             ylabel=r"its energy $E = u^2/2$  [$(F/\omega)^2$]", ylim=(0, None))  # fmt: skip
    figure.legend(loc="outside lower center", ncols=3)
    heading(figure, theorem, "Almost all launches that never stop lie in the black set")


def bands(found: list[Gap]) -> Floats:
    """Return the gaps of a column as bands (N, 2, K): lower and upper ends of E at K times."""
    s = np.linspace(-1, 1, SEGMENTS + 1)
    edges = UNIT * np.array(found, dtype=float).reshape(-1, 2, 3)
    return np.asarray(edges @ np.stack([np.ones_like(s), s, s * s]))


def shared(one: Floats, two: Floats) -> Floats:
    """Return the bands in which those of one family meet those of another."""
    begin = np.searchsorted(np.maximum.accumulate(two[:, 1].max(axis=1)), one[:, 0].min(axis=1))
    met = [np.empty((0, *one.shape[1:]))]
    for band, first in zip(one, begin, strict=True):
        others = two[first:]
        others = others[others[:, 0].min(axis=1) < band[1].max()]
        low, high = np.maximum(others[:, 0], band[0]), np.minimum(others[:, 1], band[1])
        met.append(np.stack([low, np.maximum(low, high)], axis=1)[(low < high).any(axis=1)])
    return np.concatenate(met)


def _filled(axes: Axes, t: Floats, families: list[Floats], colour: str, alpha: float) -> None:
    """Fill bands, column by column."""
    outlines = [
        np.column_stack([np.append(at, at[::-1]), np.append(low, high[::-1])])
        for at, column in zip(t, families, strict=True)
        for low, high in column
    ]
    look: Any = {"facecolors": colour, "edgecolors": "none", "alpha": alpha, "rasterized": True}
    axes.add_collection(PolyCollection(outlines, **look))
