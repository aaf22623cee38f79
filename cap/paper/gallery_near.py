"""fig:kam-gallery: the fixed point, two invariant curves, and a chaotic orbit (certified)."""

import math
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cap.audit.comparison import Comparison, claim, number, taken_from, unstated
from cap.floats.diagnostics.lyapunov import Lyapunov, exponents
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.engine.swarm import Swarm
from cap.floats.findings import Floats, State
from cap.paper.escape import Escape, escape
from cap.paper.figure import Figure, Result, Run, elliptic
from cap.paper.impulse_bound import thickness
from cap.paper.rows import Row, Rows
from cap.parameters import PAPER

ITERATES, TRANSIENT = 800, 4
SMALL, LARGE = 0.003, 0.012
FAR = Fraction(1, 20)
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
            "d",
            rf"$P_* + ({float(FAR)}, {float(FAR)})$, after ${TRANSIENT}T$; iterates certified",
            (x + float(FAR), v + float(FAR)),
        ),
    ]


def compute(run: Run) -> Result:
    """Follow the orbits of the panels."""
    centre = elliptic()
    own = panels(centre)
    starts = np.array([panel.start for panel in own])
    seen = swarm.follow(PAPER, starts[:3], ITERATES, every=True)
    spectrum = exponents(PAPER, starts[:3], run.size(20_000, 500))
    found = escape(centre, FAR, run.size(ITERATES, 20))
    shown = [_row(panel, states) for panel, states in zip(own[:3], seen.states, strict=True)]
    ends = f", then it {found.word}" if found.word else ""
    shown.append(_row(own[3], found.states[TRANSIENT:], ends))
    table = [*_regular(own, seen, centre), *_chaotic(found, run), *_spectrum(spectrum, found)]
    return Result(tuple(table), Rows(tuple(shown), "Around the elliptic orbit"))


def _row(panel: Panel, states: Floats, words: str = "") -> Row:
    """Return the row of a panel: its orbit for four periods from the first of the states."""
    begin = float(states[0, 0]), float(states[0, 1])
    orbit = trajectory(PAPER, orbit=begin, exactly=True, periods=4)
    return Row(orbit, f"({panel.letter}) {panel.words}", states, words)


def _regular(own: list[Panel], seen: Swarm, centre: State) -> list[Comparison]:
    """Compare panels (a) to (c)."""
    states, lost = seen.states, seen.turned | seen.stuck | seen.captured
    drift = float(np.abs(states[0] - states[0, 0]).max())
    found = [
        claim("(a) 800 iterates of P_*", "a single point", f"within {drift:.0e}", drift < 1e-9,
              "rounding errors grow"),
    ]  # fmt: skip
    for k in (1, 2):
        off, never = thickness(states[k] - np.array(centre)), not lost[k]
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
        number("displacement of panel (d)", "0.07", math.hypot(FAR, FAR)),
    ]  # fmt: skip


def _pattern(start: State) -> str:
    words = [event.word for event in swarm.itinerary(PAPER, start, 4)]
    return "one right, one left" if words == ["hit r", "hit l"] * 4 else ", ".join(words)


def _chaotic(found: Escape, run: Run) -> list[Comparison]:
    """Say what becomes of the orbit of panel (d), and in floats of its neighbours."""
    periods = run.size(5000, 500)
    near = found.states[0] + NOISE * np.random.default_rng(0).standard_normal((RUNS, 2))
    seen = swarm.follow(PAPER, near, periods)
    lost = int((seen.turned | seen.stuck | seen.captured).sum())
    then = f", {found.word} at t = {found.after:.4f} T" if found.word else ""
    return [
        claim("(d) the chaotic orbit", "non-sticking, within Omega_NS",
              f"never turns or sticks for {found.periods} periods{then} (proved); in floats {lost} "
              f"of {RUNS} starts within {NOISE:g} turn or stick within {periods} periods",
              not (found.word or lost),
              "it is a long transient: 800 iterates from it are not all in Omega_NS"),
    ]  # fmt: skip


def _spectrum(findings: Lyapunov, found: Escape) -> list[Comparison]:
    """Compare the Lyapunov exponents."""
    last = findings.exponents[:, -1]
    periods = int(findings.after[-1])
    return taken_from("ssec:num-coexist", [
        claim("Lyapunov exponents on curves (a) to (c)", "both vanish",
              f"at most {np.abs(last).max():.1e} per time after {periods} periods",
              bool(np.abs(last).max() < 20 / periods), "an orbit is not on a curve",
              note="they fall like log N/N"),
        unstated(claim("growth along (d) while it does not turn", "+-lambda, one positive",
              f"+-{found.exponent:.5f} per time over {found.periods} periods (proved)", False),
              "the sentence is on hyperbolic Cantor sets; this is the growth in a finite time of "
              "an orbit that then sticks, after which its exponents are others"),
    ])  # fmt: skip


FIGURE = Figure("orbits near the elliptic orbit", compute, "rows:rows", (7.8, 9.4))
