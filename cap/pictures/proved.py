"""The basins as they are proved, region by region, beside what floats say.

Each coloured region is what a region of sticks, or a part of the strip, is backwards at t = 0, by
the arithmetic of the checker; its boundary is drawn to within a pixel.  Attracted are those of
which all places have that fate; of the others all stop, and most may have a fate; what is grey is
not proved.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cap.checker.folded.backward import Flight, System
from cap.checker.folded.events import after, event
from cap.checker.folded.regions import Leaf
from cap.checker.folded.sticks import at_event, flown, multiple, places_of, sticks
from cap.checker.folded.strip import Strip
from cap.checker.folded.strips import half_strip, strip_of
from cap.checker.folded.table import ATTRACTOR, Table
from cap.checker.kernel.polynomials import MONOMIALS, Model
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.mixed import Mixed
from cap.floats import swarm
from cap.parameters import Parameters
from cap.pictures.style import BLUE, GREY, ORANGE, PALE, blank, style

PIXELS = 256, 768  # of what floats say
SIDE = 9  # points on a side of a region
PERIODS = 40  # that orbits in floats are followed
OPEN, ATTRACTED, SEGMENT, STOPS = 0, 1, 2, 3
COLOURS = (GREY, BLUE, ORANGE, PALE)
NAMES = ("nothing is shown", "attracted", "to the segment", "stops at least once")

Image = NDArray[np.int8]
Points = NDArray[np.float64]
Outline = tuple[int, Points]
Work = Callable[[Callable[[Any], Any], Any], Sequence[Any]]


def draw(theorem: Mixed, work: Work) -> Figure:
    """Return the picture: proved on the left, floats on the right."""
    outlines = proved(theorem, work)
    with style():
        figure = blank((7, 9))
        left, right = figure.subplots(1, 2, sharex=True, sharey=True)
        box = theorem.claims["box"]
        ends = [float(q) for side in (box["x"], box["v"]) for q in side[:2]]
        left.set_facecolor(GREY)
        left.add_collection(
            PolyCollection(
                [points for _, points in outlines],
                facecolors=[COLOURS[fate] for fate, _ in outlines],
                edgecolors="none",
                antialiaseds=False,
                rasterized=True,
            )
        )
        panel(right, in_floats(theorem, PIXELS[::-1]), ends)
        for axes, words in ((left, "proved"), (right, "floats")):
            axes.set_title(words)
            axes.set_xlabel("$x$")
            axes.set_ylabel("$v$ at $t = 0$")
        figure.legend(
            handles=[Patch(color=c, label=n) for c, n in zip(COLOURS, NAMES, strict=True)],
            loc="outside lower center",
            ncols=4,
        )
    return figure


def proved(theorem: Mixed, work: Work) -> list[Outline]:
    """Return the outlines of what is proved, in x and v."""
    y, table, strip = System(theorem.p), theorem.places(work).table, theorem.strip()
    found = work(partial(of_sticks, y, table), theorem.sticks(y))
    found = [*found, *work(partial(of_strip, y, strip), theorem.strips(y))]
    p = theorem.p
    unit = np.array([float(p.F / p.omega**2), float(p.F / p.omega)])
    return [
        (fate, np.array([float(p.l), 0.0]) + points * unit)
        for each in (*found, [(SEGMENT, z) for z in halves(y, strip)])
        for fate, points in each
    ]


def of_sticks(y: System, table: Table, task: tuple[Leaf, bool]) -> list[Outline]:
    """Return the outlines of what comes to a region of sticks; x is from the left wall."""
    leaf, late = task
    start = sticks(y, leaf.region, late=late)
    places = places_of(y, leaf.region, late=late)
    fate = ATTRACTED if all(table.fate(part) == ATTRACTOR for part in places) else STOPS
    return [(fate, points) for _, points in passed(y, start.flight, leaf.flights)]


def of_strip(y: System, strip: Strip, task: tuple[Leaf, bool]) -> list[Outline]:
    """Return the outlines of what comes to a part of the strip."""
    leaf, fast = task
    f = strip_of(y, strip, leaf.region, fast=fast).flight
    return [(SEGMENT, points) for k, points in passed(y, f, leaf.flights) if k % 2]


def halves(y: System, strip: Strip) -> list[Points]:
    """Return the outlines of the strip."""
    regions = [(half_strip(y, strip, fast=fast)[0], fast) for fast in (False, True)]
    starts = [strip_of(y, strip, region, fast=fast).flight for region, fast in regions]
    return [outline(y, f, 1) for f in starts]


def passed(y: System, f: Flight, flights: int) -> list[tuple[int, Points]]:
    """Return the outlines at the multiples of pi that are passed, by their numbers.

    At one next to an event, of the states before it and of those after it: what is outside of the
    walls is none of them.
    """
    found = []
    try:
        for _ in range(flights):
            strobes = list(flown(y, f))
            found += [(each.number, outline(y, f, each.number - f.passed)) for each in strobes]
            e = event(y, f)
            late = [each.number for each in at_event(y, f, e, len(strobes))]
            found += [(k, outline(y, f, k - f.passed)) for k in late]
            f = after(y, f, e)
            found += [(k, outline(y, f, k - f.passed)) for k in late]
    except Rejected:
        pass
    return found


def outline(y: System, f: Flight, k: int) -> Points:
    """Return points (N, 2) of the boundary at k pi, x from the left wall and v, unfolded.

    Folded, the mass moves to the right backwards; at odd multiples of pi the picture is mirrored.
    """
    p, s = (on_boundary(z) for z in y.at(f, multiple(y, k)[0]))
    s = np.maximum(s, 0.0)
    return np.column_stack([-p, s] if k % 2 else [y.width[0] + p, -s])


def on_boundary(p: Model) -> Points:
    """Return the values of a polynomial on the boundary of the square."""
    t = np.linspace(-1, 1, SIDE)[:-1]
    one = np.ones(len(t))
    X, Y = np.concatenate([t, one, -t, -one]), np.concatenate([-one, t, one, -t])
    return np.asarray(sum(c * X**i * Y**j for c, (i, j) in zip(p, MONOMIALS, strict=False)))


def panel(axes: Axes, pixels: Image, ends: Sequence[float]) -> None:
    """Draw one image of the box with these ends of x and v."""
    axes.imshow(
        pixels,
        origin="lower",
        extent=(ends[0], ends[1], ends[2], ends[3]),
        aspect="auto",
        cmap=ListedColormap(list(COLOURS)),
        vmin=0,
        vmax=len(COLOURS) - 1,
        interpolation="nearest",
    )


def in_floats(theorem: Mixed, shape: tuple[int, int]) -> Image:
    """Return the fates of the middles of all pixels, in floats."""
    q, box = theorem.p, theorem.claims["box"]
    p = Parameters(q.F, q.omega, q.f, q.l, q.r)
    sides = []
    for (low, high), n in zip((box["x"][:2], box["v"][:2]), shape[::-1], strict=True):
        sides.append(float(low) + float(high - low) * (np.arange(n) + 0.5) / n)
    x, v = np.meshgrid(*sides)
    states = np.column_stack([x.ravel(), v.ravel()])
    before = PERIODS + (2 * math.pi - math.acos(p.f / p.F)) / 2 / math.pi - 1e-9
    resting = np.zeros(len(states), dtype=bool)
    for n in range(3):  # a release in I comes every three half-periods
        found = swarm.follow(p, states, before + n / 2)
        resting |= found.states[:, 1] == 0
    stopped = found.turned | found.stuck | found.captured
    fates = np.where(resting, ATTRACTED, np.where(stopped, SEGMENT, OPEN))
    return fates.astype(np.int8).reshape(shape)
