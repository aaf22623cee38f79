"""Periodic orbits of two masses: in time, their multipliers, and the ellipsoid around one."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Theorem
from cap.errors import BadInput
from cap.floats.masses.mass_trajectory import trajectory
from cap.floats.masses.particles import Particles, engine
from cap.pictures.masses import MARKS, NAMES
from cap.pictures.style import BLUE, CYCLE, GREEN, RED, UNITS, legend, star, walls
from cap.pictures.theorems.parts import (
    CIRCLE,
    PALE_BLUE,
    heading,
    middle,
    multipliers,
    number,
    system,
)
from cap.pictures.times import mark

PALE_GREEN = "#CDEBE2"


def elliptic(theorem: Theorem, figure: Figure) -> None:
    """Draw an orbit with twist, and its multipliers."""
    claims = theorem.claims
    circle = _beside(theorem, figure)
    turns = [middle(theta) for theta in claims["theta"]]
    values = [value for turn in turns for value in _pair(turn)]
    told = ", ".join(number(theta, 6) for theta in claims["theta"])
    multipliers(circle, values, rf"$e^{{\pm 2\pi i\theta_j}}$, $\theta$ = {told}")
    circle.text(0, 0, f"$\\det B$ =\n{number(claims['twist_determinant'], 6)}", ha="center",
                va="center", fontsize=8)  # fmt: skip
    figure.legend(loc="outside lower center", ncols=4)
    heading(figure, theorem, "Two masses: an elliptic orbit with twist, hence invariant tori")


def saddle(theorem: Theorem, figure: Figure) -> None:
    """Draw an orbit with a real pair of multipliers and one on the circle."""
    claims = theorem.claims
    circle = _beside(theorem, figure)
    real = [complex(middle(q)) for q in claims["multipliers"]]
    values = [*real, *_pair(middle(claims["rotation_number"]))]
    told = ", ".join(number(q, 6) for q in claims["multipliers"])
    multipliers(circle, values, f"{told}; two on the circle")
    figure.legend(loc="outside lower center", ncols=4)
    heading(figure, theorem, "Two masses: an orbit that does not attract, nor is stable")


def _beside(theorem: Theorem, figure: Figure) -> Axes:
    """Draw an orbit in time; return the axes beside it."""
    axes: list[Axes] = figure.subplots(1, 2, width_ratios=[1.8, 1])
    _in_time(theorem, axes[0], theorem.claims["hit_times"])
    return axes[1]


def _pair(turns: float) -> list[complex]:
    """Return multipliers on the unit circle."""
    angle = 2 * math.pi * turns
    return [complex(math.cos(angle), s * math.sin(angle)) for s in (1, -1)]


def sink(theorem: Theorem, figure: Figure) -> None:
    """Draw an orbit that attracts."""
    claims = theorem.claims
    _in_time(theorem, figure.subplots(), claims["event_times"])
    figure.legend(loc="outside lower center", ncols=4)
    words = f"$\\|D\\Phi^{{{claims['power']}}}\\| \\leq {float(claims['contraction']):g}$"
    heading(
        figure, theorem, f"Two masses: an orbit of period {claims['period']} T attracts, {words}"
    )


def stability(theorem: Theorem, figure: Figure) -> None:
    """Draw the orbit, and the shadows of both ellipsoids on the planes of the masses."""
    claims = theorem.claims
    axes = figure.subplot_mosaic([["time", "time"], ["first", "second"]])
    _in_time(theorem, axes["time"], claims["hit_times"])
    c, A = np.array(claims["centre"], dtype=float), np.array(claims["axes"], dtype=float)
    for i, name in enumerate(("first", "second")):
        rows = [i, i + 2]
        u, s, _ = np.linalg.svd(A[rows])
        shadow = (u * s) @ np.stack([CIRCLE.real, CIRCLE.imag])
        for part, colour, face, words in (
            (1.0, BLUE, PALE_BLUE, "$E$: there at all $nT$ (proved)"),
            (float(claims["part"]), GREEN, PALE_GREEN, "$E'$: what starts here (proved)"),
        ):
            axes[name].fill(c[rows[0]] + part * shadow[0], c[rows[1]] + part * shadow[1], fc=face,
                            ec=colour, lw=1.1, label=words if i == 0 else None)  # fmt: skip
        star(axes[name], (c[rows[0]], c[rows[1]]), None)
        axes[name].set(
            xlabel=f"$x_{i + 1}$  [length]", ylabel=f"$\\dot x_{i + 1}$  [length / time]"
        )
        axes[name].ticklabel_format(useOffset=False)
        axes[name].tick_params(axis="x", labelrotation=20)
        axes[name].set_title(f"the ellipsoids, seen in the plane of mass {i + 1} (proved)")
    figure.legend(loc="outside lower center", ncols=4)
    heading(figure, theorem, f"Two masses: none stops for {int(claims['periods']):,} periods")


def limits(theorem: Theorem, figure: Figure) -> None:
    """Draw between which second masses the orbit is as claimed, and it in time at some of them."""
    claims = theorem.claims
    line, *below = figure.subplots(3, 1, height_ratios=[0.7, 1, 1])
    stop, flip = middle(claims["stop"]), middle(claims["flip"])
    first = float(theorem.p.masses[0])
    line.axvline(stop, color=RED, lw=1.4)
    line.axvline(flip, color=BLUE, lw=1.4)
    for at, words, where in (
        (stop, f"a mass stops:\n$m_2$ = {number(claims['stop'])}", "right"),
        (flip, f"a multiplier is $-1$:\n$m_2$ = {number(claims['flip'])}", "left"),
    ):
        line.annotate(words, (at, 0.5), xycoords=("data", "axes fraction"), ha=where, va="center",
                      xytext=(-4 if where == "right" else 4, 0), textcoords="offset points",
                      fontsize=8.5)  # fmt: skip
    rim = 2.2 * (flip - stop)
    line.set(
        yticks=[], xlim=(stop - rim, flip + rim), xlabel=f"second mass $m_2$, $m_1 = {first:g}$"
    )
    line.set_title(f"contacts: {', '.join(claims['itinerary'])} (proved)")
    for axes, name in zip(below, ("flip", "stop"), strict=True):
        _at_a_limit(theorem, axes, name)
    legend(below[0], figure, 3)
    heading(figure, theorem, "Two masses: where the orbit ends, as the second mass falls")


def _at_a_limit(theorem: Theorem, axes: Axes, name: str) -> None:
    """Draw the orbit at one limit, as floats have it from the first contact."""
    p, claims = theorem.p, theorem.claims
    point = [float(q) for q in theorem.hints[name]["upper"][0]]
    masses = p.masses[0], claims[name].upper
    state = _before(theorem, masses, claims["itinerary"][0], point)
    _drawn(theorem, axes, masses, state, [])
    axes.set_title(f"at $m_2 \\approx {float(masses[1]):.6f}$ (floats)")


def _before(
    theorem: Theorem, masses: Sequence[Fraction], word: str, point: Sequence[float]
) -> tuple[float, ...]:
    """Return the state at t = 0 from which the first contact comes, given as time, coordinate,
    velocities."""
    t, xi, *speeds = point
    p = system(theorem)
    places = {"hit r": (xi, float(p.r)), "hit l": (float(p.l), xi)}.get(word, (xi, xi))
    flow, angle = engine(Particles(p, tuple(masses))), float(p.omega) * t
    mode = "".join("+" if speed > 0 else "-" for speed in speeds)
    y = np.array([*places, *speeds, math.cos(angle), math.sin(angle), 1.0])
    back = flow.exponentials[flow.modes.index(mode)].flown(y, np.array([-t]))
    return tuple(back[0, : 2 * len(masses)].tolist())


def _in_time(theorem: Theorem, axes: Axes, times: Sequence[Enclosure]) -> None:
    """Draw both masses in time as curves in floats, and the proved times of what happens."""
    claims = theorem.claims
    state = tuple(middle(q) for q in (*claims["x"], *claims["v"]))
    _drawn(theorem, axes, theorem.p.masses, state, times)


def _drawn(
    theorem: Theorem,
    axes: Axes,
    masses: Sequence[Fraction],
    state: tuple[float, ...],
    times: Sequence[Enclosure],
) -> None:
    """Draw an orbit of two masses, and marks at these times of its events."""
    claims, p = theorem.claims, system(theorem)
    periods = claims.get("period", 1)
    walls(axes, p)
    axes.set(xlim=(0, periods), xlabel=UNITS["t"], ylabel="positions $x_i$  [length]")
    try:
        found = trajectory(p, masses=tuple(masses), state=state, exactly=True, periods=periods)
    except BadInput as reason:
        axes.set_title(str(reason))
        return
    t = found.t / found.period
    for i, mass in enumerate(masses):
        words = f"mass {i + 1}: {mass} (floats)" if times else f"mass {i + 1} (floats)"
        axes.plot(t, found.x[:, i], color=CYCLE[i], lw=1.0, label=words)
    named = set[str]()
    for word, time in zip(claims["itinerary"], times, strict=False):
        kind, *who = word.split()
        at = middle(time) / found.period
        wall = {"r": float(p.r), "l": float(p.l)}.get(who[0])
        own = next((int(w) - 1 for w in who if w in ("1", "2")), 0)
        place = float(np.interp(at, t, found.x[:, own])) if wall is None else wall
        words = "_" if kind in named else f"{NAMES.get(kind, kind)} (time proved)"
        mark(axes, (np.array([at]), np.array([place])), MARKS[kind], words)
        named.add(kind)
