"""The map from one release to the next: its interval, cycles, entropy over f, period doublings."""

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from cap.checker.kernel.theorem import Theorem
from cap.floats.diagnostics.return_map import late
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine.releases import images
from cap.pictures.style import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, UNITS, undone, walls
from cap.pictures.theorems.parts import heading, middle, number, system

PLACES, STEPS, VALUES, ITERATES = 1200, 60, 120, 30
FEIGENBAUM = 4.6692016
PERIODS = 12  # of the orbit in time


def attractor(theorem: Theorem, figure: Figure) -> None:
    """Draw the map on the interval that it takes into itself, and an orbit that comes there."""
    graph, time = figure.subplots(1, 2, width_ratios=[1, 1.1])
    _graph(theorem, graph)
    _come(theorem, time)
    words = f"entropy {number(theorem.claims['entropy'])} a release"
    figure.legend(loc="outside lower center", ncols=3)
    heading(figure, theorem, f"An interval of releases, {words}")


def window(theorem: Theorem, figure: Figure) -> None:
    """Draw the same, with the cycle that attracts."""
    claims = theorem.claims
    graph, time = figure.subplots(1, 2, width_ratios=[1, 1.1])
    _graph(theorem, graph)
    cycle = np.array([middle(x) for x in claims["cycle"]])
    x = np.repeat(np.append(cycle, cycle[0]), 2)
    graph.plot(x[:-1], x[1:], color=GREEN, lw=1.0, zorder=3)
    words = f"cycle that attracts (proved), multiplier {number(claims['multiplier'])}"
    graph.plot(cycle, np.roll(cycle, -1), "o", ms=5, mfc=GREEN, mec=BLACK, mew=0.6, zorder=4,
               label=words)  # fmt: skip
    _come(theorem, time)
    figure.legend(loc="outside lower center", ncols=2)
    words = f"entropy {number(claims['entropy'])} a release"
    heading(figure, theorem, f"A window of period {len(cycle)}, {words}")


def _graph(theorem: Theorem, axes: Axes) -> None:
    """Draw the graph in floats on the interval, with its critical point."""
    claims, p = theorem.claims, system(theorem)
    low, high = (float(q) for q in claims["interval"][:2])
    x = np.linspace(low, high, PLACES)
    axes.plot(x, images(p, x).value, color=BLUE, lw=1.2, label="$G$ (floats)")
    axes.plot([low, high], [low, high], color=GREY, lw=0.6, ls="--")
    place, words = middle(claims["critical_point"]), f"its {claims['turn']} (proved)"
    axes.plot(place, middle(claims["critical_value"]), "o", ms=6, mfc=RED, mec=BLACK, mew=0.6,
              zorder=5, label=words)  # fmt: skip
    axes.set(xlim=(low, high), ylim=(low, high), aspect="equal")
    axes.set(xlabel="place of a release  [length]", ylabel="place of the next  [length]")
    axes.set_title("an interval that $G$ takes into its interior (proved)")


def _come(theorem: Theorem, axes: Axes) -> None:
    """Draw an orbit of the basin in time, and the strips of the interval and its mirror image."""
    claims, p = theorem.claims, system(theorem)
    start = middle(claims["basin"]["x"]), middle(claims["basin"]["v"])
    found = trajectory(p, orbit=start, exactly=True, periods=PERIODS)
    axes.plot(
        found.t / found.period, found.x, color=BLACK, lw=0.7, label="orbit of the basin (floats)"
    )
    rest = np.array([str(word).startswith("release") for word in found.words])
    axes.plot(found.times[rest] / found.period, found.places[rest], "D", ms=4, mfc=ORANGE,
              mec=BLACK, mew=0.5, label="release (floats)")  # fmt: skip
    low, high = (float(q) for q in claims["interval"][:2])
    middle_of = float(p.l + p.r)
    axes.axhspan(
        low, high, color=BLUE, alpha=0.15, lw=0, label="the interval, and its mirror image"
    )
    axes.axhspan(middle_of - high, middle_of - low, color=BLUE, alpha=0.15, lw=0)
    walls(axes, p)
    axes.set(xlabel=UNITS["t"], ylabel=UNITS["x"], xlim=(0, PERIODS))
    axes.set_title("every orbit of a box comes to be released there (proved)")


def entropies(theorem: Theorem, figure: Figure) -> None:
    """Draw the bounds of the entropy over f."""
    claims = theorem.claims
    axes = figure.subplots()
    look: dict[str, Any] = {"lw": 0.8}
    for strip in claims["strips"]:
        for piece in strip["pieces"]:
            f = [float(q) for q in piece["f"][:2]]
            low, high = (float(q) for q in piece["entropy"][:2])
            colour = ORANGE if piece["cycle"] is not None else BLUE
            axes.fill_between(f, low, high, fc=colour, alpha=0.35, lw=0)
            axes.plot(f, [low, low], color=colour, **look)
            axes.plot(f, [high, high], color=colour, **look)
    a, b = (float(q) for q in claims["range"][:2])
    axes.set(xlim=(a, b), xlabel="friction $f$  [force]", ylabel="entropy of $G$ a release",
             ylim=(0, 0.75))  # fmt: skip
    axes.axhline(math.log(2), color=GREY, ls=":", lw=0.8)
    undone(axes)
    axes.fill_between([a, b], 0, 0.75, fc="white", lw=0, zorder=-1)
    handles = [
        Patch(fc=BLUE, alpha=0.4, label="between these bounds (proved)"),
        Patch(
            fc=ORANGE, alpha=0.4, label="likewise, and a cycle attracts the critical point (proved)"
        ),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    shares = ", ".join(f"{k} {float(claims[k]):.3g}" for k in ("positive", "periodic", "undecided"))
    axes.set_title(f"shares of the range: {shares}")
    heading(figure, theorem, "The entropy over $f$", but=("f",))


def cascade(theorem: Theorem, figure: Figure) -> None:
    """Draw the period doublings over f on orbits in floats, and their ratios."""
    claims = theorem.claims
    f = [middle(q) for q in claims["parameters"]]
    diagram, ratios = figure.subplots(1, 2, width_ratios=[1.6, 1])
    far = 0.6 * (f[-1] - f[0])
    values = np.linspace(f[0] - 0.3 * (f[-1] - f[0]), f[-1] + far * 0.4, VALUES)
    base = system(theorem, f=claims["parameters"][0].lower)
    for value in values:
        p = replace(base, f=Fraction(value))
        x = late(p, ITERATES)[0]
        diagram.plot(np.full_like(x, value), x, ".", ms=0.9, mew=0, color=GREY, rasterized=True)
    diagram.plot([], [], ".", color=GREY, label="releases (floats)")
    for k, (value, place) in enumerate(zip(f, claims["places"], strict=True)):
        diagram.axvline(value, color=PURPLE, lw=0.6)
        diagram.plot(value, middle(place), "o", ms=5, mfc=PURPLE, mec=BLACK, mew=0.5,
                     label="_" if k else "a point of the cycle that doubles (proved)")  # fmt: skip
    diagram.set(xlabel="friction $f$  [force]", ylabel="place of a release  [length]")
    diagram.set_title(
        f"periods {', '.join(str(claims['period'] * 2**k) for k in range(len(f)))} double"
    )
    places = np.arange(1, len(claims["ratios"]) + 1)
    ratios.plot(places, [middle(q) for q in claims["ratios"]], "o-", color=PURPLE, ms=5,
                label="ratios of differences (proved)")  # fmt: skip
    ratios.axhline(FEIGENBAUM, color=GREY, ls="--", lw=0.8, label=f"Feigenbaum's {FEIGENBAUM}")
    ratios.set(xlabel="$k$", ylabel=r"$(f_{k+1} - f_k)/(f_{k+2} - f_{k+1})$", xticks=places)
    figure.legend(loc="outside lower center", ncols=2)
    first = number(claims["parameters"][0], 14)
    heading(figure, theorem, f"Period doublings, the first at $f_1$ = {first}", but=("f",))
