"""fig:kam-gallery: the fixed point, two invariant curves, and a chaotic orbit (certified)."""

import math
from fractions import Fraction
from functools import cache

import numpy as np

from cap.floats.diagnostics.lyapunov import exponents
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.engine.swarm import Swarm
from cap.floats.findings import Floats, State
from cap.paper.escape import Escape, escape
from cap.paper.figure import Found, Run, elliptic
from cap.paper.impulse_bound import thickness
from cap.paper.rows import Row, Rows
from cap.parameters import PAPER

ITERATES, TRANSIENT = 800, 4
FAR = Fraction(1, 20)
SHIFTS = {"a": (0.0, 0.0), "b": (0.003, 0.0), "c": (0.012, 0.0), "d": (float(FAR), float(FAR))}
"""From P_* to the starts; the paper does not say in which direction the radii are taken."""
NOISE, RUNS = 1e-9, 200


@cache
def _starts() -> dict[str, State]:
    x, v = elliptic()
    return {letter: (x + dx, v + dv) for letter, (dx, dv) in SHIFTS.items()}


@cache
def _regular(_run: Run) -> Swarm:
    """Follow the orbits of panels (a) to (c)."""
    starts = [state for letter, state in _starts().items() if letter != "d"]
    return swarm.follow(PAPER, np.array(starts), ITERATES, every=True)


@cache
def _escape(run: Run) -> Escape:
    """Follow the orbit of panel (d)."""
    return escape(elliptic(), FAR, run.size(ITERATES, 20))


def data(run: Run) -> Rows:
    """Follow the orbits of the panels."""
    found, seen = _escape(run), _regular(run).states
    ends = f", then it {found.word}" if found.word else ""
    far = f"{float(FAR)}, {float(FAR)})$, after ${TRANSIENT}T$; iterates certified"
    shown = (
        _row("(a) the fixed point $P_*$", seen[0]),
        _row(rf"(b) $P_* + ({SHIFTS['b'][0]}, 0)$", seen[1]),
        _row(rf"(c) $P_* + ({SHIFTS['c'][0]}, 0)$", seen[2]),
        _row(rf"(d) $P_* + ({far}", found.states[TRANSIENT:], ends),
    )
    return Rows(shown, "Around the elliptic orbit")


def _row(title: str, states: Floats, words: str = "") -> Row:
    """Return the row of a panel: its orbit for four periods from the first of the states."""
    begin = float(states[0, 0]), float(states[0, 1])
    return Row(trajectory(PAPER, orbit=begin, exactly=True, periods=4), title, states, words)


def point(run: Run) -> Found:
    """Measure how far the iterates of the fixed point stray."""
    states = _regular(run).states[0]
    return {"drift": np.abs(states - states[0]).max()}


def curve(run: Run, letter: str) -> Found:
    """Measure how far the iterates of a panel stray from a curve."""
    seen, k = _regular(run), list(SHIFTS).index(letter)
    off = thickness(seen.states[k] - np.array(elliptic()))
    never = not seen.stopped[k]
    turns = "never turns" if never else "turns"
    return {"turns": turns, "off": off, "closed": never and off < 1e-3}


def patterns(_run: Run) -> Found:
    """List the hits on all four panels."""
    hits = "; ".join(sorted({_pattern(start) for start in _starts().values()}))
    return {"hits": hits, "displacement": math.hypot(*SHIFTS["d"])}


def _pattern(start: State) -> str:
    words = [event.word for event in swarm.itinerary(PAPER, start, 4)]
    return "one right, one left" if words == ["hit r", "hit l"] * 4 else ", ".join(words)


def chaotic(run: Run) -> Found:
    """Say what becomes of the orbit of panel (d), and in floats of its neighbours."""
    found, periods = _escape(run), run.size(5000, 500)
    near = found.states[0] + NOISE * np.random.default_rng(0).standard_normal((RUNS, 2))
    seen = swarm.follow(PAPER, near, periods)
    lost = int(seen.stopped.sum())
    return {
        "periods": found.periods,
        "then": f", {found.word} at t = {found.after:.4f} T" if found.word else "",
        "lost": lost,
        "runs": RUNS,
        "noise": NOISE,
        "longest": periods,
        "never": not (found.word or lost),
    }


def exponents_on_curves(run: Run) -> Found:
    """Bound the Lyapunov exponents of panels (a) to (c)."""
    starts = _regular(run).states[:, 0]
    found = exponents(PAPER, starts, run.size(20_000, 500))
    periods = int(found.after[-1])
    most = np.abs(found.exponents[:, -1]).max()
    return {"most": most, "periods": periods, "small": 20 / periods}


def growth(run: Run) -> Found:
    """Return how deviations grow along panel (d)."""
    found = _escape(run)
    return {"exponent": found.exponent, "periods": found.periods}
