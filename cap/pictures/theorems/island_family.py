"""Islands at several values of f: their areas, and where resonances make them vanish."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cap.checker.theorems.islands import Islands
from cap.floats.diagnostics.islands import PERIODS, Island, island
from cap.floats.findings import Floats
from cap.pictures.style import BLACK, BLUE, GREY, ORANGE, RED
from cap.pictures.theorems.parts import heading, middle, system

VALUES = 72  # of f in floats, at most
MAPS = {2: ("Phi", "o", BLUE), 1: ("sigma", "s", ORANGE)}  # by half periods
ORDERS = (3, 4)  # of resonances


def islands(theorem: Islands, figure: Figure) -> None:
    """Draw the areas that are proved over f, those in floats, and the rotation number at P*."""
    claims = theorem.claims["islands"]
    f = np.unique([float(each["f"]) for each in (*claims, *theorem.hints["open"])])
    inner = max(1, VALUES // max(1, len(f) - 1))
    fine = np.unique(np.concatenate([np.linspace(*pair, inner + 1) for pair in pairwise(f)] or [f]))
    found = [island(system(theorem, f=q)) for q in map(Fraction, fine)]
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    parts = [each.area if each and each.area else np.nan for each in found]
    above.semilogy(fine, parts, "-", color=GREY, lw=1, zorder=1,
                   label=f"around P* nothing stops within {PERIODS} periods (floats)")  # fmt: skip
    for halves, (name, mark, colour) in MAPS.items():
        own = [each for each in claims if each["map"] == name]
        above.plot([float(each["f"]) for each in own], [middle(each["area"]) for each in own],
                   mark, color=colour, ms=5, mec=BLACK, mew=0.5,
                   label=rf"inside an invariant curve of $\{name}$ (proved)")  # fmt: skip
        turns = [each.turns if each and each.halves == halves else np.nan for each in found]
        below.plot(fine, turns, "-", color=colour, label=rf"of $\{name}$ at P* (floats)")
    for each in theorem.hints["open"]:
        above.plot(float(each["f"]), 0.03, "x", color=RED, transform=above.get_xaxis_transform())
    above.text(0.5, 0.02, "near the resonances 1/3 and 1/4 of P* islands are small (floats)",
               transform=above.transAxes, fontsize=8, ha="center", color=GREY)  # fmt: skip
    above.set_ylabel(r"area  [$F^2/\omega^3$]")
    for at, order in crossings(fine, found):
        _resonance(above, below, at, order)
    below.set(xlabel="friction $f$  [force]", ylabel="rotation number", ylim=(0, 0.5))
    figure.legend(loc="outside lower center", ncols=3, fontsize=7.5)
    words = f"Islands at {len(claims)} values of $f$"
    heading(figure, theorem, words, but=("f",))


def crossings(f: Floats, found: list[Island | None]) -> Iterator[tuple[float, int]]:
    """Give where the rotation number at P* passes 1/3, or 1/4, with the order."""
    for (a, one), (b, other) in pairwise(zip(f, found, strict=True)):
        if one and other and one.halves == other.halves:
            for order in ORDERS:
                p, q = one.turns - 1 / order, other.turns - 1 / order
                if p * q <= 0 and p != q:
                    yield float(a + (b - a) * p / (p - q)), order


def _resonance(above: Axes, below: Axes, at: float, order: int) -> None:
    """Mark a resonance."""
    for axes in (above, below):
        axes.axvline(at, color=BLACK, lw=0.7, ls=":", zorder=0)
    above.annotate(f"1/{order}", (at, 1), xycoords=("data", "axes fraction"), fontsize=8,
                   ha="center", va="bottom")  # fmt: skip
