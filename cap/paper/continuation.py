"""fig:continuation: the (1,1) orbits over (f, R), from the closed forms.

That is, the T-periodic orbits whose velocity never vanishes, with one hit of each wall per period.
At F = ω = 1: α = f, ρ = R.  Every one of them is ``plus``, ``minus`` or one of the ``pair``.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cap.audit.comparison import Comparison, claim, count, number, percent, taken_from, unstated
from cap.floats.findings import Floats
from cap.paper.closed_form import pair_curve, symmetric_member
from cap.paper.figure import Figure, Result, Run
from cap.paper.nine_points import FORCES, GAPS, PAPER_KINDS, nine, others
from cap.parameters import PAPER
from cap.pictures.style import BLACK, GREEN, GREY, PURPLE, RED, parameters
from cap.proofs.census import census

BOX = 0.01, 0.65, 0.2, 4.5
SIDE = 220
NAMES = ("plus", "minus", "pair")
CLASSES = (  # which orbits there are: e elliptic, s saddle, - none; of plus, minus, pair
    "---", "s--", "-s-", "e--", "es-", "ss-", "sse", "sss", "s-e", "s-s", "--e", "--s",
)  # fmt: skip


@dataclass(frozen=True)
class Map:
    """Over f (N,) and R (M,): least speed and trace (3, M, N) of plus, minus and the pair."""

    f: Floats
    R: Floats
    least: Floats
    trace: Floats

    @property
    def exists(self) -> NDArray[np.bool_]:
        """Which orbits, (3, M, N), exist: where there is one, and its speed is positive."""
        return self.least > 0

    @property
    def elliptic(self) -> NDArray[np.bool_]:
        """Which of them are elliptic."""
        return self.exists & (abs(self.trace) < 2)

    def classes(self) -> NDArray[np.int64]:
        """Return the places (M, N) in `CLASSES`."""
        letters = np.where(self.elliptic, "e", np.where(self.exists, "s", "-"))
        words = np.char.add(np.char.add(letters[0], letters[1]), letters[2])
        return np.array([[CLASSES.index(str(w)) for w in row] for row in words])


@dataclass(frozen=True)
class Sampled:
    """The map, and what is proved at the nine points: words like "elliptic, saddle"."""

    map: Map
    points: dict[tuple[str, str], dict[str, str]]


def mapped(side: int, run: Run) -> Map:
    """Compute the map on side x side points of the paper's box.

    On processes: the precision of balls is that of all threads of one.
    """
    f, R = np.linspace(*BOX[:2], side), np.linspace(*BOX[2:], side)
    rows = run.runner.map(partial(_row, f), R.tolist(), "map", processes=not run.quick)
    least, trace = np.array(rows).transpose(1, 2, 0, 3)
    return Map(f, R, least, trace)


def _row(f: Floats, rho: float) -> Floats:
    """Return least speeds and traces (2, 3, N) of the symmetric orbits and the pair at one gap."""
    least, trace = np.full((2, 3, len(f)), np.nan)
    for k, sign in enumerate((1, -1)):
        found = np.array([symmetric_member(alpha, rho, sign) for alpha in f.tolist()])
        trace[k], least[k] = found[:, 1], found[:, 2]
    curve = pair_curve(rho, 2 * len(f))
    if len(curve.alpha):
        for values, to in ((curve.trace, trace), (curve.least_speed, least)):
            to[2] = np.interp(f, curve.alpha[::-1], values[::-1], np.nan, np.nan)
    return np.stack([least, trace])


def compute(run: Run) -> Result:
    """Prove what there is at the nine points, and draw the map."""
    points = {
        (f, R): {m.name: m.kind for m in census(Fraction(f), Fraction(R))}
        for f in FORCES
        for R in GAPS
    }
    found = mapped(run.size(SIDE if run.drawn else SIDE // 2, 24), run)
    rows = [*nine(points), *others(), *_formulas(points), *_shading(found), *_limits()]
    return Result(tuple(rows), Sampled(found, points))


def _sc(R: float) -> float:
    return 4 * (2 + R - math.pi) / math.pi**2


def _formulas(points: dict[tuple[str, str], dict[str, str]]) -> list[Comparison]:
    """Compare what the paper says about its curve f_sc(R)."""
    upper = [(f, R) for f in FORCES for R in GAPS if R != "1" and float(f) > _sc(float(R))]
    below = [(f, R) for f, R in (("0.15", "1"), ("0.35", "1"), ("0.15", "2"))
             if float(f) < _sc(float(R))]  # fmt: skip
    at_3 = f"f_sc(3) = {_sc(3):.3f} > f_imp, so that no point with R = 3 is above the curve"
    at_1 = f"f_sc(1) = {_sc(1):.3f} < 0: both points with R = 1 are above"
    predicted = [
        key for key in points
        if (float(key[0]) > _sc(float(key[1]))) == ("elliptic" in points[key].values())
    ]  # fmt: skip
    return [
        count("verified points above f_sc(R) with R = 2, 3", 4, len(upper), at_3),
        count("of (0.15, 1), (0.35, 1), (0.15, 2): below f_sc(R)", 3, len(below), at_1),
        claim("(0.55, 1)", "in the purple region, f_sc > 0",
              f"f_sc(1) = {_sc(1):.3f}", _sc(1) > 0, "by the caption it is in the blue region"),
        claim("elliptic (1,1) orbits exist above f_sc(R), not below", "at all points",
              f"at {len(predicted)} of 9", len(predicted) == 9,
              "no curve f_sc(R) separates anything: no root of its equation is an orbit (theorem "
              "`symmetric`)"),
        number("f_imp = 2F/pi", "0.637", 2 / math.pi),
        number("grid: steps in f", "0.003", (BOX[1] - BOX[0]) / (SIDE - 1)),
        number("grid: steps in R", "0.02", (BOX[3] - BOX[2]) / (SIDE - 1)),
    ]  # fmt: skip


def _shading(found: Map) -> list[Comparison]:
    """Compare the paper's shading with the (1,1) orbits that there are, over the grid."""
    f, R = np.meshgrid(found.f, found.R)
    sc = 4 * (2 + R - np.pi) / np.pi**2
    inside = f < 2 / math.pi
    elliptic, saddle = found.elliptic.any(axis=0), (found.exists & ~found.elliptic).any(axis=0)
    blue, purple = inside & (sc <= 0), inside & (sc > 0) & (f > sc)
    white = inside & (sc > 0) & (f < sc)
    why = "the regions are bounded by other curves: least speed 0, pitchfork, f = 2F/pi"

    def share(region: NDArray[np.bool_], truth: Any, words: str) -> Comparison:
        name, says = words.split(": ")
        part = int((region & truth).sum())
        return claim(f"{name} region, of (1,1) orbits", says,
                     f"true on {percent(part, int(region.sum()))} of it",
                     part == int(region.sum()), why)  # fmt: skip

    return [
        share(blue, elliptic & ~saddle, "blue: elliptic orbit only"),
        share(purple, elliptic & saddle, "purple: elliptic and saddle orbits"),
        share(white, ~elliptic & ~saddle, "white: no orbit (of the symmetric branch)"),
        claim("(1,1) orbits for f > 2F/pi", "none", "none",
              not found.exists[:, f > 2 / math.pi].any(), "the formulas give some"),
    ]  # fmt: skip


def _limits() -> list[Comparison]:
    """Compare how the multipliers tend to 1 at the saddle-center."""
    rho = float(PAPER.R * PAPER.omega**2 / PAPER.F)
    nu = np.geomspace(1e-10, 1e-7, 10)
    traces = [symmetric_member(2 / math.pi - n, rho, -1).trace for n in nu.tolist()]
    exponents = np.arccosh(np.array(traces) / 2)
    slope = float(np.polyfit(np.log(nu), np.log(exponents), 1)[0])
    gap = float(np.ptp([_least_gap(R) for R in (1.0, 2.0, 3.0)]))
    return [
        *taken_from("ssec:num-coexist", [
            unstated(number("exponent of mu in the positive Lyapunov exponent", "0.25", slope),
                     "this is the saddle's own, at f = 2F/pi; on which orbits of the chaotic "
                     "component of Omega_NS, at which mu, the paper's was computed is not said")]),
        claim("saddle-center: where", "f_sc(R), depends on R",
              f"2F/pi for every R (differences of {gap:.0e} between R = 1, 2, 3)", gap > 1e-3,
              "GKR2019 has it right: plus and minus meet at f = 2F/pi (proved)"),
    ]  # fmt: skip


def _least_gap(R: float) -> float:
    """Return f at which plus and minus meet: where their traces, 2 ∓ c sqrt(2/π - f), do."""
    f = 2 / math.pi - np.array([2e-8, 1e-8])
    c = [
        (symmetric_member(a, R, -1).trace - symmetric_member(a, R, 1).trace) ** 2
        for a in f.tolist()
    ]
    return float(f[1] + c[1] * (f[1] - f[0]) / (c[0] - c[1]))


LABELS = {
    "---": "none of them", "s--": "saddle (+)", "-s-": "saddle (−)", "e--": "elliptic (+)",
    "es-": "elliptic (+), saddle (−)", "ss-": "2 saddles", "sse": "2 saddles, elliptic pair",
    "sss": "2 saddles, saddle pair", "s-e": "saddle (+), elliptic pair",
    "s-s": "saddle (+), saddle pair", "--e": "elliptic pair", "--s": "saddle pair",
}  # fmt: skip


def draw(data: Sampled, figure: FigureBase) -> None:
    """Draw the map, the curves, and the nine points."""
    axes = figure.subplots()
    patches = _regions(axes, data.map)
    _curves(axes, data.map)
    _markers(axes)
    axes.set_xlim(*BOX[:2])
    axes.set_ylim(*BOX[2:])
    axes.set_xlabel("$f$  [force]")
    axes.set_ylabel("$R$  [length]")
    handles = [*patches, *axes.get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside right center", handlelength=1.6)
    given = parameters(PAPER, but=("f", "R"))
    heading = "Orbits that never turn or stick, with one hit of each wall"
    figure.suptitle(f"{heading}\n{given}", fontsize=10)


def _regions(axes: Axes, found: Map) -> list[Patch]:
    """Shade the regions; return what explains the shades, ascending in size."""
    shades = {
        "---": "#FFFFFF", "s--": "#F7DDB0", "-s-": "#F7DDB0", "e--": "#9ECAE9",
        "es-": "#9ECAE9", "ss-": "#EDBE72", "sse": "#7FCDB4", "sss": "#D98F4E",
        "s-e": "#4FB093", "s-s": "#B5651D", "--e": "#2F8F74", "--s": "#8C4A12",
    }  # fmt: skip
    code = found.classes()
    norm = BoundaryNorm(np.arange(-0.5, len(CLASSES)), len(CLASSES))
    df, dR = (float(a[1] - a[0]) / 2 for a in (found.f, found.R))
    extent = (found.f[0] - df, found.f[-1] + df, found.R[0] - dR, found.R[-1] + dR)
    axes.imshow(code, origin="lower", extent=extent, aspect="auto", norm=norm,
                cmap=ListedColormap([shades[name] for name in CLASSES]))  # fmt: skip
    return [
        Patch(fc=shades[name], ec=BLACK, lw=0.4, label=LABELS[name])
        for k, name in enumerate(CLASSES)
        if (code == k).mean() > 1e-3
    ]


def _curves(axes: Axes, found: Map) -> None:

    R = np.linspace(*BOX[2:], 1000)
    axes.axvline(2 / math.pi, color=BLACK, ls=":", lw=1.1, label=r"$f = 2F/\pi$: the formulas meet")
    for level, colour, words in (
        ((math.pi**2 - 4) / 2, PURPLE, "pitchfork: the pair is born"),
        (math.pi**2 - 2, GREEN, r"$\Phi' = -1$ at the symmetric orbit"),
    ):
        own = R[level > R]
        alpha = 2 / np.pi * np.sqrt(1 - (own / level) ** 2)
        least = [symmetric_member(*each, 1).least_speed for each in zip(alpha, own, strict=True)]
        alpha[np.array(least) < 0] = np.nan
        axes.plot(alpha, own, color=colour, lw=1.3, label=words)
    for k, line, name in ((0, "-", "+"), (1, "--", "−"), (2, "-.", "pair")):
        axes.contour(found.f, found.R, found.least[k], [0], colors=[BLACK], linewidths=0.9,
                     linestyles=[line])  # fmt: skip
        axes.plot([], [], line, color=BLACK, lw=0.9, label=f"least speed 0 ({name})")
    shown = np.where(found.exists[2], found.trace[2], np.nan)
    axes.contour(found.f, found.R, shown, [-2], colors=[GREY], linewidths=1.3)
    if np.isfinite(shown).any() and np.nanmin(shown) < -2:
        axes.plot([], [], color=GREY, lw=1.3, label="trace −2 (pair)")
    axes.plot(4 * (2 + R - np.pi) / np.pi**2, R, color=RED, ls=(0, (5, 2)), lw=1.4,
              label=r"$f_{\rm sc}(R)$ of the paper: no orbit")  # fmt: skip


def _markers(axes: Axes) -> None:
    look = {"elliptic": ("o", "found: elliptic"), "saddle": ("^", "found: saddle"),
            "none": ("x", "found: none")}  # fmt: skip
    seen = set()
    for (f, R), kind in PAPER_KINDS.items():
        marker, words = look[kind]
        label = None if kind in seen else f"the paper {words}"
        seen.add(kind)
        axes.plot(float(f), float(R), marker, ms=6.5, mfc="white", mec=BLACK, mew=1.2, ls="none",
                  label=label, zorder=5)  # fmt: skip


FIGURE = Figure(
    "(1,1) orbits (velocity never zero, one hit of each wall) over (f, R)",
    compute,
    draw,
    (8.2, 5.2),
)
