"""The schematic figures: drawn from computed orbits where there is something to compute."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cap.audit.comparison import Comparison, claim, number, percent, roughly
from cap.floats.diagnostics.attractor import Attractor, attractors
from cap.floats.diagnostics.fate import Fate, fate
from cap.floats.diagnostics.portrait import Portrait, portrait
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.findings import Floats, State
from cap.floats.search import periodic
from cap.paper.figure import Figure, Result, Run, elliptic
from cap.parameters import PAPER

MASSES = 1.0, 0.9


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


# the cover


class Lifted(NamedTuple):
    """An orbit, its lift q(t), and x over q."""

    orbit: Trajectory
    q: Floats
    wave: tuple[Floats, Floats]


def wave(q: Floats) -> Floats:
    """Return the triangular wave W(q) of eq:Wq."""
    part = np.mod(q, 2)
    return np.asarray(np.where(part < 1, part, 2 - part))


def cover(run: Run) -> Result:
    """Lift the elliptic orbit."""
    del run
    orbit = trajectory(PAPER, orbit=elliptic(), exactly=True, periods=3)
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
    shown = np.linspace(0, 7, 701)
    wave_of_x = float(PAPER.l) + length * wave(shown)
    return Result(rows, Lifted(orbit, q, (shown, wave_of_x)))


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


MODEL = Figure("the model", model, "sketches:model", (5.6, 3.4))
COVER = Figure("the cover and the lift", cover, "sketches:cover", (8.4, 3.2))
DECOMPOSITION = Figure("decomposition of the plane", decomposition, "sketches:decomposition",
                       (6.0, 6.0))  # fmt: skip
PARTICLES = Figure("N particles", particles, "sketches:particles", (5.6, 3.4))
