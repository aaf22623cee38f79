"""The schematic figures: drawn from computed orbits where there is something to compute."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import FancyArrowPatch, Rectangle

from cap.audit.comparison import Comparison, claim, number, percent, roughly
from cap.errors import BadInput
from cap.floats.diagnostics.attractor import Attractor, attractors
from cap.floats.diagnostics.fate import Fate, fate
from cap.floats.diagnostics.portrait import Portrait, portrait
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.findings import Floats, State
from cap.floats.search import periodic
from cap.floats.search.fixed_point import elliptic_point
from cap.paper.figure import Figure, Result, Run
from cap.parameters import PAPER
from cap.pictures.states import fates
from cap.pictures.style import BLACK, BLUE, GREEN, GREY, RED, UNITS, parameters

MASSES = 1.0, 0.9
SADDLE = 0.3435, 0.7753


def _centre() -> State:
    found = elliptic_point(PAPER)
    if found is None:
        raise BadInput("the elliptic orbit was not found")
    return found


# the model


def model(run: Run) -> Result:
    """Check the few numbers of the model."""
    del run
    rows = (
        number("gap R = r - l", "2", float(PAPER.R)),
        number("period T = 2 pi/omega (the paper: 2 pi)", f"{2 * math.pi:.6f}",
               2 * math.pi / float(PAPER.omega)),
        claim("forcing condition F > f", "F = 1 > 0.4 = f", f"{PAPER.F} > {float(PAPER.f)}",
              PAPER.f < PAPER.F, "the mass comes to rest"),
    )  # fmt: skip
    return Result(rows, None)


def draw_model(data: None, figure: FigureBase) -> None:
    """Draw the mass between the walls."""
    del data

    axes = _stage(figure)
    _body(axes, 0.0, 0.35, "$m = 1$")
    _arrow(axes, (-0.1, 0.62), (0.45, 0.62), r"$F\cos\omega t$", "blue")
    _arrow(axes, (0.3, -0.28), (-0.15, -0.28), r"$-f\,\mathrm{sgn}\,\dot x$", "red")
    _arrow(axes, (0.2, 0.22), (0.5, 0.22), r"$\dot x$", "green")
    _measure(axes, "$R = r - l$")
    figure.suptitle(f"The oscillator\n{parameters(PAPER)}", fontsize=10)


def _stage(figure: FigureBase) -> Axes:
    """Draw the floor and the walls."""
    axes = figure.subplots()
    axes.set_axis_off()
    for x, name in ((-1.0, "$l$"), (1.0, "$r$")):
        left = x - 0.12 if x < 0 else x
        axes.add_patch(Rectangle((left, -0.18), 0.12, 0.9, fc="#DDDDDD", ec="none", hatch="////"))
        axes.plot([x, x], [-0.18, 0.72], color="black", lw=1.2)
        axes.annotate(name, (x, -0.42), ha="center")
    axes.add_patch(Rectangle((-1, -0.2), 2, 0.05, fc="#DDDDDD", ec="none", hatch="////"))
    axes.plot([-1, 1], [-0.15, -0.15], color="black", lw=1.0)
    axes.annotate("$x$", (1.22, -0.42), ha="center")
    axes.annotate("", (1.18, -0.36), (-1.18, -0.36), arrowprops={"arrowstyle": "->", "lw": 0.7})
    axes.set_xlim(-1.3, 1.3)
    axes.set_ylim(-0.55, 1.0)
    axes.set_aspect("equal")
    return axes


def _body(axes: Axes, x: float, width: float, name: str) -> None:
    axes.add_patch(Rectangle((x - width / 2, -0.15), width, 0.3, fc="#CFE3F1", ec="black", lw=0.8))
    axes.annotate(name, (x, 0.0), ha="center", va="center", fontsize=9)


def _arrow(axes: Axes, begin: State, end: State, words: str, colour: str) -> None:

    own = {"blue": BLUE, "red": RED, "green": GREEN}[colour]
    axes.add_patch(
        FancyArrowPatch(begin, end, arrowstyle="-|>", mutation_scale=11, color=own, lw=1.3)
    )
    x, y = max(begin[0], end[0]), begin[1]
    axes.annotate(words, (x + 0.03, y), va="center", color=own, fontsize=9)


def _measure(axes: Axes, words: str) -> None:
    axes.annotate("", (1, 0.88), (-1, 0.88), arrowprops={"arrowstyle": "<->", "lw": 0.7})
    axes.annotate(words, (0, 0.88), ha="center", va="center", backgroundcolor="white")


# the cover


class Lifted(NamedTuple):
    """An orbit and its lift q(t)."""

    orbit: Trajectory
    q: Floats


def wave(q: Floats) -> Floats:
    """Return the triangular wave W(q) of eq:Wq."""
    part = np.mod(q, 2)
    return np.asarray(np.where(part < 1, part, 2 - part))


def cover(run: Run) -> Result:
    """Lift the elliptic orbit."""
    del run
    orbit = trajectory(PAPER, orbit=_centre(), exactly=True, periods=3)
    length = float(PAPER.R)
    way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(orbit.x)))]) / length
    q = (orbit.x[0] - float(PAPER.l)) / length + way
    back = float(np.abs(float(PAPER.l) + length * wave(q) - orbit.x).max())
    hit = float(orbit.times[0])
    jump = 2 * float(PAPER.F) * abs(math.cos(float(PAPER.omega) * hit)) / length
    rows = (
        number("period of W", "2", 2.0 if np.allclose(wave(q + 2), wave(q)) else math.nan),
        claim("pi(q(t)) = x(t) along the elliptic orbit", "yes", f"up to {back:.0e}", back < 1e-9,
              "the lift fails"),
        number("hits per period: q grows by", "2", (q[-1] - q[0]) / 3),
        claim("reflections become", "smooth passages of q through integers",
              f"q is C^1 there: q'' jumps by 2F |cos wt|/R = {jump:.4f} at the first hit",
              jump < 1e-9, "the lifted flow is smooth on each side only, and W has a corner"),
        number("jump of q'' at an integer (proof of Lemma lift-flow: 2f/R)",
               f"{2 * float(PAPER.f) / length:.4f}", jump,
               "the force changes its sign with W', friction does not: it is 2F |cos wt|/R"),
    )  # fmt: skip
    return Result(rows, Lifted(orbit, q))


def draw_cover(data: Lifted, figure: FigureBase) -> None:
    """Draw the wave, the lift, and the orbit."""
    axes = figure.subplots(1, 3)
    q = np.linspace(0, 7, 701)
    axes[0].plot(q, float(PAPER.l) + float(PAPER.R) * wave(q), color=BLUE)
    axes[0].set_xlabel("$q$")
    axes[0].set_ylabel(r"$\pi(q) = R\,W(q) + l$  [length]")
    t = data.orbit.t / data.orbit.period
    axes[1].plot(t, data.q, color=RED)
    for k in range(1, int(data.q[-1]) + 1):
        axes[1].axhline(k, color=GREY, ls=":", lw=0.7)
    axes[1].set_ylabel("$q(t)$")
    axes[2].plot(t, data.orbit.x, color="black", lw=0.9)
    for wall in (PAPER.l, PAPER.r):
        axes[2].axhline(float(wall), color=GREY, ls="--", lw=0.7)
    axes[2].set_ylabel(UNITS["x"])
    for each in axes[1:]:
        each.set_xlabel(UNITS["t"])
        each.set_xlim(0, 3)
    figure.suptitle(f"The cover, and the lift of the elliptic orbit\n{parameters(PAPER)}",
                    fontsize=10)  # fmt: skip


# the decomposition


@dataclass(frozen=True)
class Decomposition:
    """Who turns in the whole plane, curves around both elliptic points, saddles, attractors."""

    basin: Fate
    islands: tuple[Portrait, Portrait]
    points: dict[str, list[State]]
    attractors: tuple[Attractor, ...]


def decomposition(run: Run) -> Result:
    """Compute what the sketch shows."""
    box = -1.0, 1.0, -1.6, 1.6
    points, periods = run.size(400, 60), run.size(100, 30)
    briefly = not run.drawn
    basin = fate(PAPER, box=box, points=points, periods=periods, runner=run.runner, briefly=briefly)
    found = periodic.orbits(PAPER, 2)
    orbits = {
        kind: [(each.x, each.v) for each in found if each.kind == kind]
        for kind in ("elliptic", "saddle")
    }
    islands = [
        portrait(PAPER, orbit=state, radius=0.022, orbits=run.size(60, 10), periods=200)
        for state in orbits["elliptic"]
    ]
    ends = attractors(PAPER, points=run.size(24, 6), transient=run.size(1000, 100), periods=130)
    never = basin.counts["never turns"]
    first = basin.first[np.isfinite(basin.first)]
    late, turned = int((first > 2 * math.pi / float(PAPER.omega)).sum()), len(first)
    kinds = [f"{each.kind} ({each.share:.1%} of the seeds)" for each in ends.found]
    rows = (
        roughly(claim(
            "elliptic points in Omega_NS", "one, P_*", f"{len(orbits['elliptic'])}",
            len(orbits["elliptic"]) == 1, "P_* and its mirror image (both proved)")),
        roughly(claim(
            "saddles beside the island", "one, S_*", f"{len(orbits['saddle'])}",
            len(orbits["saddle"]) == 1, "two that hit each wall once (proved); perhaps more")),
        claim("Omega_dissip", "at least one zero of the velocity per period",
              f"of the states that turn, {percent(late, turned)} do so only after the first period",
              late == 0,
              "an orbit in Omega_dissip may not turn for many periods"),
        claim("attractor", "one", "; ".join(kinds), len(kinds) == 1,
              "several; in floats, and chaos may be transient"),
        claim("Omega_NS has positive measure", "yes",
              f"KAM curves (proved); {percent(never, basin.fate.size)} of |v| < 1.6 never turn in "
              f"{basin.periods} periods", never > 0, "no state was found that never turns"),
    )  # fmt: skip
    turning = tuple(each for each in ends.found if each.kind != "never turns")
    return Result(rows, Decomposition(basin, (islands[0], islands[-1]), orbits, turning))


def draw_decomposition(data: Decomposition, figure: FigureBase) -> None:
    """Draw the plane."""
    axes = figure.subplots()
    fates(axes, data.basin)
    handles = list(axes.get_legend().legend_handles)  # type: ignore[union-attr]
    labels = [text.get_text() for text in axes.get_legend().get_texts()]  # type: ignore[union-attr]
    axes.get_legend().remove()  # type: ignore[union-attr]
    for each in data.islands:
        own = each.states[~each.turned].reshape(-1, 2)
        axes.scatter(own[:, 0], own[:, 1], s=0.3, c=BLUE, lw=0, rasterized=True)
    for kind, marker, colour in (("elliptic", "*", RED), ("saddle", "s", "white")):
        (line,) = axes.plot(*np.array(data.points[kind]).reshape(-1, 2).T, marker, ms=7, mfc=colour,
                            mec=BLACK, mew=0.7, ls="none")  # fmt: skip
        handles.append(line)
        labels.append(f"{kind} fixed point")
    for found in data.attractors:
        (line,) = axes.plot(*found.states[:500].T, ".", ms=1.6, color=GREEN)
    handles.append(line)
    labels.append("attractors")
    axes.set_xlim(data.basin.x[0], data.basin.x[-1])
    axes.set_ylim(data.basin.v[0], data.basin.v[-1])
    figure.legend(handles, labels, loc="outside lower center", ncols=3, markerscale=1.4)
    words = f"Who turns within {data.basin.periods} periods, and the islands"
    figure.suptitle(f"{words}\n{parameters(PAPER)}", fontsize=10)


# many particles


def collision(first: float, second: float) -> Floats:
    """Return the matrix of eq:Ncollision."""
    total = first + second
    return np.array([[first - second, 2 * second], [2 * first, second - first]]) / total


def particles(run: Run) -> Result:
    """Check the algebra of collisions: no orbit of several masses is followed for this figure."""
    del run
    C, equal = collision(*MASSES), collision(1.0, 1.0)
    m = np.diag(MASSES)
    momentum, energy = np.abs(MASSES @ C - MASSES).max(), np.abs(C.T @ m @ C - m).max()
    standard = np.abs(C.T @ C - np.eye(2)).max()
    rows: tuple[Comparison, ...] = (
        claim("the collision is an involution", "yes",
              f"up to {np.abs(C @ C - np.eye(2)).max():.0e}",
              np.allclose(C @ C, np.eye(2)), "it is none"),
        claim("momentum and energy", "preserved", f"up to {max(momentum, energy):.0e}",
              bool(max(momentum, energy) < 1e-12), "they change"),
        claim("equal masses", "exchange velocities", "exchange velocities"
              if np.array_equal(equal, [[0, 1], [1, 0]]) else str(equal.tolist()),
              np.array_equal(equal, [[0, 1], [1, 0]]), "they do not"),
        claim(f"masses {MASSES[0]:g} and {MASSES[1]:g}: entries of the matrix", "all four nonzero",
              ", ".join(f"{entry:.4f}" for entry in C.ravel()), bool((C != 0).all()), "one is 0"),
        claim("a collision preserves sum dv_i dx_i (Theorem multiparticle)", "yes",
              f"C^T C - 1 is up to {standard:.4f} for masses {MASSES[0]:g} and {MASSES[1]:g}",
              bool(standard < 1e-12), "deviations of positions are mapped by C too: preserved is "
              f"sum m_i dv_i dx_i (C^T m C - m is up to {energy:.0e})"),
        claim("volume", "preserved", f"det C^2 = {np.linalg.det(C) ** 2:.6f}",
              bool(abs(np.linalg.det(C) ** 2 - 1) < 1e-12), "it changes"),
    )  # fmt: skip
    return Result(rows, None)


def draw_particles(data: None, figure: FigureBase) -> None:
    """Draw the particles."""
    del data
    axes = _stage(figure)
    for k, (x, width) in enumerate(((-0.7, 0.24), (-0.25, 0.34), (0.15, 0.2), (0.72, 0.3)), 1):
        _body(axes, x, width, f"$m_{k}$" if k < 4 else "$m_N$")
        axes.add_patch(FancyArrowPatch((x - 0.09, 0.32), (x + 0.13, 0.32), arrowstyle="-|>",
                       mutation_scale=9, color="#0072B2", lw=1.1))  # fmt: skip
    axes.annotate("…", (0.42, 0.0), ha="center", va="center", fontsize=13)
    axes.annotate(r"$F\cos\omega t$ on each", (0, 0.5), ha="center", color="#0072B2", fontsize=9)
    _measure(axes, "$R = r - l$")
    figure.suptitle(r"$N$ particles: $m_i\ddot x_i = F\cos\omega t - f\,\mathrm{sgn}\,\dot x_i$",
                    fontsize=10)  # fmt: skip


MODEL = Figure("the model", model, draw_model, (5.6, 3.4))
COVER = Figure("the cover and the lift", cover, draw_cover, (8.4, 3.2))
DECOMPOSITION = Figure("decomposition of the plane", decomposition, draw_decomposition, (6.0, 6.0))
PARTICLES = Figure("N particles", particles, draw_particles, (5.6, 3.4))
