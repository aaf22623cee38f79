"""The (1,1) orbits: over (f, R), and the elliptic ones over f."""

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import FigureBase
from matplotlib.patches import Patch

from cap.floats.one_one import symmetric_member, turn
from cap.parameters import PAPER
from cap.pictures.style import BLACK, BLUE, GREEN, GREY, PURPLE, RED, SKY, cells, parameters

if TYPE_CHECKING:
    from cap.paper.bifurcation import Branches
    from cap.paper.continuation import Map, Sampled

SHOWN = ("1/3", "1/4", "1/5", "1/6")  # rotation numbers that are marked
KINDS = {  # e elliptic, s saddle, - none, of plus, minus, pair: a shade, and words
    "---": ("#FFFFFF", "none of them"),
    "s--": ("#F7DDB0", "saddle (+)"),
    "-s-": ("#F7DDB0", "saddle (−)"),
    "e--": ("#9ECAE9", "elliptic (+)"),
    "es-": ("#9ECAE9", "elliptic (+), saddle (−)"),
    "ss-": ("#EDBE72", "2 saddles"),
    "sse": ("#7FCDB4", "2 saddles, elliptic pair"),
    "sss": ("#D98F4E", "2 saddles, saddle pair"),
    "s-e": ("#4FB093", "saddle (+), elliptic pair"),
    "s-s": ("#B5651D", "saddle (+), saddle pair"),
    "--e": ("#2F8F74", "elliptic pair"),
    "--s": ("#8C4A12", "saddle pair"),
}


def over_f_and_gap(data: "Sampled", figure: FigureBase) -> None:
    """Draw the map, the curves, and the nine points."""
    axes = figure.subplots()
    patches = _regions(axes, data.map)
    _curves(axes, data.map)
    _markers(axes, data.found)
    axes.set_xlim(data.map.f[0], data.map.f[-1])
    axes.set_ylim(data.map.R[0], data.map.R[-1])
    axes.set_xlabel("$f$  [force]")
    axes.set_ylabel("$R$  [length]")
    handles = [*patches, *axes.get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside right center", handlelength=1.6)
    given = parameters(PAPER, but=("f", "R"))
    heading = "Orbits that never turn or stick, with one hit of each wall"
    figure.suptitle(f"{heading}\n{given}", fontsize=10)


def _regions(axes: Axes, found: "Map") -> list[Patch]:
    """Shade the regions; return what explains the shades, ascending in size."""
    kinds = found.kinds()
    code = np.vectorize(list(KINDS).index)(kinds)
    norm = BoundaryNorm(np.arange(-0.5, len(KINDS)), len(KINDS))
    shades = ListedColormap([shade for shade, _ in KINDS.values()])
    cells(axes, found.f, found.R, code, norm=norm, cmap=shades)
    return [
        Patch(fc=shade, ec=BLACK, lw=0.4, label=words)
        for kind, (shade, words) in KINDS.items()
        if (kinds == kind).mean() > 1e-3
    ]


def _curves(axes: Axes, found: "Map") -> None:
    R = np.linspace(found.R[0], found.R[-1], 1000)
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


def _markers(axes: Axes, found: dict[tuple[str, str], str]) -> None:
    look = {"elliptic": ("o", "found: elliptic"), "saddle": ("^", "found: saddle"),
            "none": ("x", "found: none")}  # fmt: skip
    seen = set()
    for (f, R), kind in found.items():
        marker, words = look[kind]
        label = None if kind in seen else f"the paper {words}"
        seen.add(kind)
        axes.plot(float(f), float(R), marker, ms=6.5, mfc="white", mec=BLACK, mew=1.2, ls="none",
                  label=label, zorder=5)  # fmt: skip


def over_f(data: "Branches", figure: FigureBase) -> None:
    """Draw positions and rotation numbers."""
    axes = figure.subplots(1, 2)
    _positions(axes[0], data)
    _numbers(axes[1], data)
    for each in axes:
        each.set_xlabel("$f$  [force]")
        each.set_xlim(0.32, 0.645)
    handles, labels = axes[0].get_legend_handles_labels()
    more, words = axes[1].get_legend_handles_labels()
    known = dict(zip(words + labels, more + handles, strict=True))
    figure.legend(known.values(), known.keys(), loc="outside lower center", ncols=4)
    given = parameters(PAPER, but=("f",))
    heading = "Orbits over $f$ that never turn, with one hit of each wall"
    figure.suptitle(f"{heading}\n{given}", fontsize=10)


def _positions(axes: Axes, data: "Branches") -> None:
    axes.plot(data.pair[:, 0], data.pair[:, 1], color=BLUE, lw=1.5, label="the paper's orbit")
    axes.plot(data.mirror[:, 0], data.mirror[:, 1], color=SKY, lw=1.5, label="its mirror image")
    f, x, trace = data.symmetric.T
    for chosen, line in ((abs(trace) < 2, "-"), (abs(trace) > 2, "--")):
        kind = "elliptic" if line == "-" else "saddle"
        axes.plot(np.where(chosen, f, np.nan), x, line, color=BLACK, lw=1.1,
                  label=f"symmetric, {kind}")  # fmt: skip
    axes.plot([s.f for s in data.sweep], [s.x for s in data.sweep], ".", ms=4, color=RED,
              label="Newton's sweep as in the paper")  # fmt: skip
    birth = float(data.landmarks.birth[0])
    k = int(np.argmin(abs(f - birth)))
    axes.plot(birth, x[k], "D", ms=5.5, mfc="white", mec=PURPLE, mew=1.2, ls="none",
              label=f"pitchfork, $f = {birth:.7f}$")  # fmt: skip
    axes.axvline(data.fold, color=RED, ls=":", lw=1.0, label=f"the paper's fold, {data.fold}")
    axes.set_ylabel("$x_*$ at $t = 0$  [length]")


def _numbers(axes: Axes, data: "Branches") -> None:
    axes.plot(data.pair[:, 0], turn(data.pair[:, 2]), color=BLUE, lw=1.5)
    f, _, trace = data.symmetric.T
    numbers = turn(trace)
    axes.plot(f, numbers, color=BLACK, lw=1.1)
    axes.plot([s.f for s in data.sweep], [s.turn for s in data.sweep], ".", ms=4, color=RED)
    for name in SHOWN:
        level = float(Fraction(name))
        axes.axhline(level, color=GREY, ls=":", lw=0.7)
        axes.annotate(name, (0.322, level), xytext=(0, 1.5), textcoords="offset points",
                      fontsize=8, color="#555555")  # fmt: skip
        axes.plot(float(data.landmarks.resonances[name][0]), level, "o", ms=4.5, mfc="white",
                  mec=BLUE, mew=1.1)  # fmt: skip
    birth, zero = float(data.landmarks.birth[0]), float(data.landmarks.twist[0])
    axes.plot(zero, np.interp(zero, data.pair[::-1, 0],
              turn(data.pair[::-1, 2])), "s", ms=5.5, mfc="white", mec=GREEN, mew=1.2, ls="none",
              label=rf"$\tau_1 = 0$, $f = {zero:.7f}$")  # fmt: skip
    axes.plot(birth, 0, "D", ms=5.5, mfc="white", mec=PURPLE, mew=1.2, clip_on=False)
    axes.axvline(data.fold, color=RED, ls=":", lw=1.0)
    axes.set_ylim(0, 0.5)
    axes.set_ylabel(r"rotation number $\Theta_*/2\pi$")
