"""The basins as they are proved, region by region, beside what floats say.

Each coloured region is what a region of
first stops is backwards at t = 0, by the arithmetic of the checker; its boundary is drawn to within
a pixel.  Of all regions all states stop.  Those of sticks, and the parts of those of turns that are
followed forwards, have the colour of a fate if the checker shows it for all of the region but at
most `LOST` of its area; it may be that more of a white one has a fate.  Of black nothing is shown.
"""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cap.checker.folded.ahead import Found, Outlook, found
from cap.checker.folded.areas import stuck
from cap.checker.folded.events import after, event
from cap.checker.folded.flights import Flight
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import Direction
from cap.checker.folded.regions import Leaf
from cap.checker.folded.stops import Start, Strobe, at_hit, flown, sticks, turns
from cap.checker.kernel.polynomials import MONOMIALS, Model, ends
from cap.checker.kernel.processes import Work
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.mixed import BACK, PLACES, SIDES, TURNS, Map, Mixed
from cap.floats.engine import swarm
from cap.floats.engine.events import HIT
from cap.pictures.style import BLACK, BLUE, ORANGE, stroboscopic
from cap.pictures.theorems.parts import heading, system
from cap.runner import within

PIXELS = 256, 768  # of what floats say
SIDE = 9  # points on a side of a region
LOST = 0.05  # of the area of a region with a fate, at most
PERIODS = 40  # that orbits in floats are followed
OPEN, ATTRACTED, SEGMENT, STOPS = 0, 1, 2, 3
LATE = 3  # more, in which those that go to the segment hit no wall
COLOURS = (BLACK, BLUE, ORANGE, "white")
NAMES = (
    "proved: nothing; floats: does not stop",
    f"attracted (proved but for at most {LOST:.0%} of each region)",
    "to the segment (likewise)",
    "proved: stops at least once",
)

Image = NDArray[np.int8]
Points = NDArray[np.float64]
Outline = tuple[int, Points]


class Proof(Mixed):
    """The proof of the checker, as it is; what it finds of places is kept for the picture."""

    known: Places

    def places(self, work: Map) -> Places:
        """Return what is known of all distances to the wall ahead."""
        self.known = super().places(work)
        return self.known

    def prove(self) -> None:
        """Prove it; the picture takes the rest of the time."""
        tell: Any = self.tell  # of a number, or of no part
        cost = self.phases()
        self.drawn = {words: part for words, part in cost.items() if words != PLACES}
        part = sum(cost.values()) / (sum(cost.values()) + sum(self.drawn.values()))
        self.tell = within(tell, 0, part)
        super().prove()
        self.tell = within(tell, part, 1, "picture: ")


def draw(theorem: Proof, figure: Figure) -> None:
    """Draw what is proved on the left; floats are on the right."""
    outlines = proved(theorem, theorem.known, Work(theorem.jobs, theorem.tell, theorem.drawn))
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    box = theorem.claims["box"]
    ends = [float(q) for side in (box["x"], box["v"]) for q in side[:2]]
    left.set_facecolor(COLOURS[OPEN])
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
    left.set_title("proved")
    right.set_title(f"floats, {PERIODS} periods: nothing is proved")
    for axes in (left, right):
        stroboscopic(axes)
    figure.legend(
        handles=[
            Patch(fc=c, ec=BLACK, lw=0.4, label=n) for c, n in zip(COLOURS, NAMES, strict=True)
        ],
        loc="outside lower center",
        ncols=2,
    )
    heading(figure, theorem, verdict(theorem))


def verdict(theorem: Mixed) -> str:
    """Return the shares that are proved."""
    shares = theorem.claims["shares"]
    words = {"attractor": "attracted", "segment": "to the segment", "stops": "stops"}
    parts = [f"{word} {shares[name].text[0]}" for name, word in words.items()]
    return "Basins; proved, of the area shown, at least: " + ", ".join(parts)


def proved(theorem: Mixed, places: Places, work: Map) -> list[Outline]:
    """Return the outlines of what is proved, in x and v, those on top of others later."""
    p, y, V = theorem.p, Direction(theorem.p), float(theorem.region()[1])
    outlook = theorem.outlook(places)
    outlines = list[list[Outline]]()
    for side, name in SIDES.items():
        drawn = partial(of_sticks, outlook, y, V, side)
        outlines += work(drawn, theorem.leaves(y, name), BACK.format(name), Leaf.work)
    outlines += work(partial(of_turns, outlook, y, V), theorem.leaves(y, "turns"), TURNS, Leaf.work)
    unit = np.array([float(p.F / p.omega**2), float(p.F / p.omega)])
    return [
        (fate, np.array([float(p.l), 0.0]) + points * unit)
        for each in outlines
        for fate, points in each
    ]


def of_sticks(o: Outlook, y: Direction, V: float, side: int, leaf: Leaf) -> list[Outline]:
    """Return the outlines of what comes to a region of sticks; x is from the left wall."""
    start = sticks(y, side, leaf.region)
    fate = shown(stuck(y, o.fates, start, side, leaf.region))
    return [(fate, points) for points in passed(y, V, start, leaf.flights)]


def of_turns(o: Outlook, y: Direction, V: float, leaf: Leaf) -> list[Outline]:
    """Return the outlines of what comes to a region of turns, then those of parts with a fate."""
    fates = [(STOPS, leaf.region), *((shown(found(o, part)), part) for part in leaf.parts)]
    return [
        (fate, points)
        for k, (fate, region) in enumerate(fates)
        if k == 0 or fate != STOPS
        for points in passed(y, V, turns(y, region), leaf.flights)
    ]


def shown(found: Found) -> int:
    """Return the fate of nearly all of a region, if one is shown."""
    fates = zip((ATTRACTED, SEGMENT), found.missing, strict=False)
    return next((fate for fate, missing in fates if missing <= LOST * found.area), STOPS)


def passed(y: Direction, V: float, start: Start, flights: int) -> list[Points]:
    """Return the outlines at the multiples of pi that are passed, where some are slower than V.

    At one next to a hit, of the states before it and of those after it: what is outside of the
    walls is none of them.
    """
    outlines, f = list[Points](), start.flight
    try:
        for _ in range(flights):
            flying = list(flown(y, f, V))
            outlines += outlined(y, f, flying)
            e = event(y, f)
            if e.p:
                break
            late = at_hit(y, f, e, len(flying), V)
            outlines += outlined(y, f, late)
            f = after(y, f, e)
            outlines += outlined(y, f, late)
    except Rejected:
        pass
    return outlines


def outlined(y: Direction, f: Flight, strobes: Sequence[Strobe]) -> list[Points]:
    """Return the outlines in a flight where some are slower than V."""
    slow = (number for number, excess in strobes if ends(excess)[0] < 0)
    return [outline(y, f, number - f.passed) for number in slow]


def outline(y: Direction, f: Flight, k: int) -> Points:
    """Return points (N, 2) of the boundary at k pi, x from the left wall and v, unfolded.

    Folded, the mass moves to the right backwards; at odd multiples of pi the picture is mirrored.
    """
    p, s = (on_boundary(z) for z in y.at(f, y.multiple(k)[0]))
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
    p, box = system(theorem), theorem.claims["box"]
    sides = []
    for (low, high), n in zip((box["x"][:2], box["v"][:2]), shape[::-1], strict=True):
        sides.append(float(low) + float(high - low) * (np.arange(n) + 0.5) / n)
    x, v = np.meshgrid(*sides)
    found = swarm.follow(p, np.column_stack([x.ravel(), v.ravel()]), PERIODS)
    late = swarm.follow(p, found.states, LATE)
    hits = late.counts[:, HIT : HIT + 2].any(axis=1)
    stopped = found.stopped & ~(found.lost | late.lost)
    fates = np.where(stopped, np.where(hits, ATTRACTED, SEGMENT), OPEN)
    return fates.astype(np.int8).reshape(shape)
