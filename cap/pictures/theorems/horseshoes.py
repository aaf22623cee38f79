"""The parallelograms of a horseshoe, on the curves of a saddle as floats have them.

The parallelograms are those of the certificate; their coverings are proved.  Colours tell the
symbols of the words by which sets of this kind are searched for, in floats: nothing rests on them.
"""

import math
from collections import Counter
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cap.checker.coverings.entropy import Coverings
from cap.checker.coverings.formulas import Formulas
from cap.checker.system.model import Model
from cap.checker.theorems.contact_horseshoe import ContactHorseshoe
from cap.checker.theorems.horseshoe import Horseshoe
from cap.checker.theorems.map_horseshoe import MapHorseshoe
from cap.floats.coverings.planar import Planar, contacts, formulas, half_period, images
from cap.floats.coverings.regions import cells, regions
from cap.floats.coverings.saddles import Saddle, saddles
from cap.floats.diagnostics.manifold import manifolds
from cap.pictures.style import BLACK, BLUE, CYCLE, ORANGE, RED, framed, stroboscopic
from cap.pictures.theorems.parts import heading, system
from cap.system.model import Guard, Mode, System
from cap.system.planar import Map
from cap.system.polynomial import Polynomial, over
from cap.system.section import Section

LENGTH, SPACING = 4.0, 0.01  # of the curves of a saddle, in natural units
POINTS, START, ITERATES = 4000, 1e-6, 60  # of an unstable curve of a map: on a side, begun so near
JUMP = 0.02  # of its size, at which a curve is broken
PLACES = 5  # of the entropy

Points = NDArray[np.float64]


def horseshoe(theorem: Horseshoe, figure: Figure) -> None:
    """Draw the sets of sigma, at t = 0, with the curves of a saddle of its square."""
    p = system(theorem)
    F, w = float(p.F), float(p.omega)
    g = half_period(float(p.f) / F, float(p.R) * w * w / (2 * F))
    scale = np.array([F / w**2, F / w])
    middle = np.array([float(p.l + p.r) / 2, 0.0])
    axes, saddle = figure.subplots(), nearest(theorem, saddles(g))
    x, v = map(float, middle + scale * saddle.point)
    curves = manifolds(p, orbit=(x, v), length=LENGTH, spacing=SPACING)
    for points, colour, name in (
        (curves.stable, BLUE, "$W^s$ (floats)"),
        (curves.unstable, RED, "$W^u$ (floats)"),
    ):
        axes.plot(*points.T, color=colour, lw=0.4, alpha=0.6, label=name)
    draw(theorem, axes, regions(g, saddle), lambda z: middle + scale * z)
    axes.plot(x, v, **SADDLE)
    stroboscopic(axes)
    figure.legend(loc="outside lower center", ncols=4, handlelength=1.4)
    heading(figure, theorem, f"{entropy(theorem)} per period $T$")


def map_horseshoe(theorem: MapHorseshoe, figure: Figure) -> None:
    """Draw the sets of a map, with the unstable curve of a saddle."""
    g = formulas(in_floats(theorem.p))
    axes, saddle = figure.subplots(), nearest(theorem, saddles(g))
    axes.plot(*unstable(g, saddle).T, color=RED, lw=0.4, alpha=0.6, label="$W^u$ (floats)")
    draw(theorem, axes, cells(g, saddle), lambda z: z)
    axes.plot(*saddle.point, **SADDLE)
    axes.set(xlabel=theorem.p.state[0], ylabel=theorem.p.state[1])
    figure.legend(loc="outside lower center", ncols=3, handlelength=1.4)
    words = f"{entropy(theorem)}  (the certificate is VERIFIED)"
    figure.suptitle(f"{words}\n{theorem.p}", fontsize=10)


def contact_horseshoe(theorem: ContactHorseshoe, figure: Figure) -> None:
    """Draw the sets of contacts, with the unstable curve of a saddle of the map between them."""
    section = section_in_floats(theorem.p, theorem.claims["mode"], theorem.claims["guard"])
    g = contacts(section, float(theorem.hints["middle"]))
    axes, saddle = figure.subplots(), nearest(theorem, saddles(g))
    axes.plot(*unstable(g, saddle).T, color=RED, lw=0.4, alpha=0.6, label="$W^u$ (floats)")
    draw(theorem, axes, cells(g, saddle), lambda z: z)
    axes.plot(*saddle.point, **SADDLE)
    at = f"just before a contact ('{section.guard}' of '{section.mode}')"
    axes.set(xlabel=f"t modulo {2 * g.size:.6g}", ylabel=f"{section.free} {at}")
    figure.legend(loc="outside lower center", ncols=3, handlelength=1.4)
    floor = math.floor(theorem.claims["per_period"] * 10**PLACES) / 10**PLACES
    words = f"{entropy(theorem)} per contact, {floor:.{PLACES}f} per period"
    figure.suptitle(f"{words}\n(the certificate is VERIFIED)", fontsize=10)


SADDLE: dict[str, Any] = {
    "marker": "s", "ms": 5.5, "mfc": ORANGE, "mec": BLACK, "mew": 0.8, "ls": "none", "zorder": 4,
    "label": "saddle (floats)",
}  # fmt: skip


def entropy(theorem: Coverings) -> str:
    """Return what is proved."""
    edges = sum(map(len, theorem.hints["coverings"]))
    floor = math.floor(theorem.claims["entropy"] * 10**PLACES) / 10**PLACES
    return (
        f"{len(theorem.hints['sets'])} parallelograms, {edges} coverings: "
        f"entropy at least {floor:.{PLACES}f}"
    )


def corners(theorem: Coverings) -> Points:
    """Return the corners (K, 4, 2) of the parallelograms."""
    sets = np.array([[float(q) for q in numbers] for numbers in theorem.hints["sets"]])
    c, a, b = sets[:, None, 0:2], sets[:, None, 2:4], sets[:, None, 4:6]
    p, q = np.array([-1, 1, 1, -1])[:, None], np.array([-1, -1, 1, 1])[:, None]
    return np.asarray(c + p * a + q * b)


def nearest(theorem: Coverings, known: list[Saddle]) -> Saddle:
    """Return the saddle that is the nearest to a set."""
    centres = corners(theorem).mean(axis=1)
    return min(known, key=lambda saddle: np.hypot(*(centres - saddle.point).T).min())


def draw(theorem: Coverings, axes: Axes, found: Any, placed: Any) -> None:
    """Draw the sets, coloured by symbols, and show what is around them."""
    sets = corners(theorem)
    table, (x0, x1, y0, y1), _ = found
    part = (sets.mean(axis=1) - [x0, y0]) / [x1 - x0, y1 - y0]
    i, j = (np.clip((part * table.shape).astype(int), 0, np.array(table.shape) - 1)).T
    shown = placed(sets)
    colours = [CYCLE[k % len(CYCLE)] for k in table[i, j]]
    axes.add_collection(
        PolyCollection(
            list(shown),
            facecolors=colours,
            edgecolors=colours,
            linewidths=0.8,
            zorder=3,
            label="sets (proved), coloured by symbols",
        )
    )
    framed(axes, shown.min(axis=(0, 1)), shown.max(axis=(0, 1)), 0.06)


def unstable(g: Planar, saddle: Saddle) -> Points:
    """Return the unstable curve of a saddle, both sides, as images of a fundamental domain."""
    parts = []
    for side in (1, -1):
        s = START * abs(saddle.large) ** np.linspace(0, 2, POINTS)
        z = saddle.point + side * s[:, None] * saddle.unstable
        for _ in range(ITERATES):
            with np.errstate(invalid="ignore"):
                z = np.where(np.isfinite(z), images(g, z)[:, :2], np.nan)
                step = np.hypot(*np.diff(z, axis=0).T)
            parts.append(broken(z, step > JUMP * g.size))
            if not np.isfinite(z).any() or np.nanmean(step > JUMP * g.size) > 0.5:
                break
    return np.concatenate(parts)


def broken(z: Points, far: NDArray[np.bool_]) -> Points:
    """Return a curve with nan where two points are too far apart, and after its end."""
    gaps = np.flatnonzero(far) + 1
    return np.insert(z, [*gaps, len(z)], np.nan, axis=0)


def in_floats(p: Formulas) -> Map:
    """Return the map of a certificate as one that floats take."""
    return Map(
        p.state,
        {z: as_powers(q.terms) for z, q in zip(p.state, p.image, strict=True)},
        torus=p.torus,
    )


def section_in_floats(p: Model, mode: str, guard: str) -> Section:
    """Return the contacts with a guard as those that floats follow."""
    given = p.modes[mode].guards[guard]
    divisor = as_powers(given.divisor.terms)
    reset = {z: over(as_powers(q.terms), divisor) for z, q in given.reset.items()}
    contact = Guard(as_powers(given.value.terms), (mode,), reset)
    field = {z: as_powers(q.terms) for z, q in p.modes[mode].field.items()}
    frequency = as_powers(p.frequency.terms)
    return Section(System(p.state, frequency, {mode: Mode(field, {guard: contact})}), mode, guard)


def as_powers(terms: Mapping[tuple[str, ...], Fraction]) -> Polynomial:
    """Return a polynomial of the checker as one with powers."""
    return Polynomial({tuple(sorted(Counter(m).items())): c for m, c in terms.items()})
