"""The basins as they are proved, pixel by pixel, beside what floats say.

Each coloured pixel is a rectangle of states all of which have the fate told, by the arithmetic of
the checker; of grey ones nothing is shown.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cap.checker.folded.fates import Judge, half, hopeless, slope, stop
from cap.checker.folded.follow import Seen
from cap.checker.folded.places import Leaf, seen_in
from cap.checker.kernel.theorem import Parameters as Checked
from cap.checker.theorems.mixed import NOT, Mixed
from cap.floats import swarm
from cap.parameters import Parameters
from cap.pictures.style import BLUE, GREY, ORANGE, PALE, blank, style

PIXELS = 4  # a leaf is so many wide and high
PERIODS = 40  # that orbits in floats are followed
OPEN, ATTRACTED, SEGMENT, STOPS = 0, 1, 2, 3
COLOURS = (GREY, BLUE, ORANGE, PALE)
NAMES = ("nothing is shown", "attracted", "to the segment", "stops at least once")

Image = NDArray[np.int8]
Work = Callable[[Callable[[Any], Any], Any], Sequence[Any]]


def draw(theorem: Mixed, work: Work) -> Figure:
    """Return the picture: proved on the left, floats on the right."""
    proved = image(theorem, work)
    with style():
        figure = blank((7, 9))
        axes = figure.subplots(1, 2, sharex=True, sharey=True)
        box = theorem.claims["box"]
        ends = [float(q) for side in (box["x"], box["v"]) for q in side[:2]]
        for each, pixels, words in zip(
            axes,
            (proved, in_floats(theorem, proved.shape)),
            ("proved", "floats"),
            strict=True,
        ):
            panel(each, pixels, ends, words)
        figure.legend(
            handles=[Patch(color=c, label=n) for c, n in zip(COLOURS, NAMES, strict=True)],
            loc="outside lower center",
            ncols=4,
        )
    return figure


def panel(axes: Axes, pixels: Image, ends: Sequence[float], words: str) -> None:
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
    axes.set_title(words)
    axes.set_xlabel("$x$")
    axes.set_ylabel("$v$ at $t = 0$")


def image(theorem: Mixed, work: Work) -> Image:
    """Return the fates of all pixels, rows from low v."""
    columns, rows = theorem.hints["columns"], theorem.hints["rows"]
    pixels = np.zeros((rows * PIXELS, columns * PIXELS), dtype=np.int8)
    judge = theorem.judge(work)
    followed = [n for n, cuts in enumerate(theorem.hints["leaves"]) if cuts != NOT]
    parts = work(partial(painted, theorem.p, judge), theorem.leaves())
    for n, part in zip(followed, parts, strict=True):
        j, i = (PIXELS * k for k in divmod(n, columns))
        pixels[j : j + PIXELS, i : i + PIXELS] = part
    return pixels


def painted(p: Checked, judge: Judge, leaf: Leaf) -> Image:
    """Return the fates of the pixels of a leaf."""
    pixels = np.zeros((PIXELS, PIXELS), dtype=np.int8)
    paint(judge, seen_in(p, judge, leaf), pixels)
    return pixels


def paint(judge: Judge, part: Seen, pixels: Image) -> None:
    """Colour the pixels of a part."""
    found = judge.fate(part)
    if found or pixels.size == 1 or hopeless(part):
        pixels[:] = found or (STOPS if stop(part) else OPEN)
        return
    x, y = slope(part)
    rows, columns = pixels.shape
    along = int(columns == 1 or (rows > 1 and y > x))
    middle = pixels.shape[1 - along] // 2
    halves = (
        (pixels[:middle], pixels[middle:]) if along else (pixels[:, :middle], pixels[:, middle:])
    )
    for side, each in zip((-1.0, 1.0), halves, strict=True):
        paint(judge, half(part, along, side), each)


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
