"""fig:kam-gallery: the fixed point, two invariant curves, and a chaotic orbit."""

import math
from typing import NamedTuple

import numpy as np
from matplotlib.figure import FigureBase

from cap.approx import swarm
from cap.approx.grid import island
from cap.approx.lyapunov import Lyapunov, exponents
from cap.approx.study import Floats, State
from cap.approx.trajectory import trajectory
from cap.errors import BadInput
from cap.paper.comparison import Comparison, claim, number
from cap.paper.figure import Figure, Result, Run
from cap.paper.impulse_bound import Rows, _thickness
from cap.paper.rows import Row, rows
from cap.parameters import PAPER
from cap.pictures.style import parameters

ITERATES, TRANSIENT = 800, 4
SMALL, LARGE = 0.003, 0.012
FAR = 0.05, 0.05
NOISE, RUNS = 1e-9, 200


class Panel(NamedTuple):
    """A panel: its letter, what it shows, and where the orbit starts."""

    letter: str
    words: str
    start: State


def panels(centre: State) -> list[Panel]:
    """Return the four panels; the paper does not say in which direction the radii are taken."""
    x, v = centre
    return [
        Panel("a", "the fixed point $P_*$", centre),
        Panel("b", rf"$P_* + ({SMALL}, 0)$", (x + SMALL, v)),
        Panel("c", rf"$P_* + ({LARGE}, 0)$", (x + LARGE, v)),
        Panel(
            "d", rf"$P_* + ({FAR[0]}, {FAR[1]})$, after ${TRANSIENT}T$", (x + FAR[0], v + FAR[1])
        ),
    ]


def compute(run: Run) -> Result:
    """Follow the orbits of the panels."""
    centre = island(PAPER)
    if centre is None:
        raise BadInput("the elliptic orbit was not found")
    own = panels(centre)
    starts = np.array([panel.start for panel in own])
    seen = swarm.follow(PAPER, starts, ITERATES, every=True)
    late = seen.states[3, TRANSIENT]
    spectrum = exponents(PAPER, starts, run.size(20_000, 500))
    shown = []
    for k, panel in enumerate(own):
        begin = (float(late[0]), float(late[1])) if panel.letter == "d" else panel.start
        stays = (
            seen.states[k, TRANSIENT : _stays(panel.start)]
            if panel.letter == "d"
            else seen.states[k]
        )
        orbit = trajectory(PAPER, orbit=begin, exactly=True, periods=4)
        shown.append(
            Row(
                orbit,
                f"({panel.letter}) {panel.words}",
                stays,
                ", then it turns" if len(stays) < ITERATES - TRANSIENT else "",
            )
        )
    table = [*_regular(own, seen.states, centre), *_chaotic(own[3], run), *_spectrum(spectrum, run)]
    return Result(tuple(table), Rows(tuple(shown)))


def _stays(start: State, periods: int = ITERATES) -> int:
    """Return for how many periods the orbit never turns."""
    seen = swarm.follow(PAPER, [start], periods)
    first = np.fmin(np.fmin(seen.first_time("turn"), seen.first_time("stick")),
                    seen.first_time("capture"))[0]  # fmt: skip
    return periods if math.isnan(first) else int(first / (2 * math.pi / float(PAPER.omega)))


def _regular(own: list[Panel], states: Floats, centre: State) -> list[Comparison]:
    """Compare panels (a) to (c)."""
    drift = float(np.abs(states[0] - states[0, 0]).max())
    found = [
        claim("(a) 800 iterates of P_*", "a single point", f"within {drift:.0e}", drift < 1e-9,
              "rounding errors grow"),
    ]  # fmt: skip
    for k in (1, 2):
        off, never = _thickness(states[k] - np.array(centre)), _stays(own[k].start) == ITERATES
        radius = (SMALL, LARGE)[k - 1]
        found.append(
            claim(f"({own[k].letter}) displacement {radius}: 800 iterates", "a closed curve",
                  f"{'never turns' if never else 'turns'}, strays {off:.0e} of the distance from a "
                  "curve", never and off < 1e-3, "the orbit is not on a curve")
        )  # fmt: skip
    hits = [_pattern(panel.start) for panel in own]
    return [
        *found,
        claim("hits per period, panels (a) to (d), 4 T", "one right, one left",
              "; ".join(sorted(set(hits))), set(hits) == {"one right, one left"},
              "another pattern"),
        number("displacement of panel (d)", "0.07", math.hypot(*FAR)),
    ]  # fmt: skip


def _pattern(start: State) -> str:
    words = [event.word for event in swarm.itinerary(PAPER, start, 4)]
    return "one right, one left" if words == ["hit r", "hit l"] * 4 else ", ".join(words)


def _chaotic(panel: Panel, run: Run) -> list[Comparison]:
    """Say what becomes of the orbit of panel (d), and of its neighbours."""
    periods = run.size(5000, 500)
    stays = _stays(panel.start, periods)
    near = np.array(panel.start) + NOISE * np.random.default_rng(0).standard_normal((RUNS, 2))
    seen = swarm.follow(PAPER, near, periods)
    lost = int((seen.turned | seen.stuck | seen.captured).sum())
    return [
        claim("(d) the chaotic orbit", "non-sticking, within Omega_NS",
              f"turns or sticks after {stays} periods; {lost} of {RUNS} starts within {NOISE:g} do "
              f"so within {periods}", lost == 0,
              "it is a long transient: 800 iterates from it are not all in Omega_NS"),
    ]  # fmt: skip


def _spectrum(study: Lyapunov, run: Run) -> list[Comparison]:
    """Compare the Lyapunov exponents."""
    last = study.exponents[:3, -1]
    early = exponents(
        PAPER, study.starts[3:], min(_stays(tuple(study.starts[3])), run.size(800, 100))
    )
    first, second = early.exponents[0, -1]
    periods = int(study.after[-1])
    return [
        claim("Lyapunov exponents on curves (a) to (c)", "both vanish",
              f"at most {np.abs(last).max():.1e} per time after {periods} periods",
              bool(np.abs(last).max() < 20 / periods), "an orbit is not on a curve",
              note="they fall like log N/N"),
        claim("Lyapunov exponents of (d) while it does not turn", "+-lambda, one positive",
              f"{first:.4f}, {second:.4f} per time over {int(early.after[-1])} periods",
              bool(first > 0.01 and abs(first + second) < 1e-6), "not chaotic",
              note="a finite time: the orbit turns then"),
    ]  # fmt: skip


def draw(data: Rows, figure: FigureBase) -> None:
    """Draw the panels."""
    rows(figure, data.rows, f"Around the elliptic orbit\n{parameters(PAPER)}")


FIGURE = Figure("orbits near the elliptic orbit", compute, draw, (7.8, 9.4))
