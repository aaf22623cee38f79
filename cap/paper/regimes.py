"""fig:hist-gallery-low and fig:hist-gallery-high: regimes at six forcings."""

from functools import cache
from math import gcd

import numpy as np

from cap.audit import tables
from cap.floats.diagnostics.attractor import strongest
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search import cycles
from cap.floats.search.cycles import Cycle
from cap.floats.search.orbits import search
from cap.paper import events, mirror
from cap.paper.figure import Found, Run, percent
from cap.paper.rows import Row, Rows
from cap.parameters import at

LOW = "1.5", "3", "4.5"
HIGH = "6"
GENERIC = {"12": (4, 4, 5), "50": (2, 1, 7)}  # F: transient and window in T, |v| at most
SEEDS = 12  # per side, of the generic orbits


# periodic orbits


@cache
def _near(F: str) -> Cycle:
    """Return the orbit near the state that the paper prints."""
    table = "fig:hist-gallery-low" if F in LOW else "fig:hist-gallery-high"
    x, v = (float(tables.stated(f"F = {F}: {name}", table)) for name in ("x_*", "v_*"))
    return cycles.near(at(F=F), x, v)


@cache
def _orbit(F: str) -> Trajectory:
    own = _near(F)
    return _window(F, (own.x, own.v), 4)


def _window(F: str, state: State, periods: int) -> Trajectory:
    return trajectory(at(F=F), orbit=state, exactly=True, periods=periods)


def periodic(_run: Run, F: str) -> Found:
    """Find one of the periodic orbits, and count its hits in 4 T."""
    own, hits = _near(F), events.counted(_orbit(F).words)
    total = hits["right"] + hits["left"]
    return {
        **{name: getattr(own, name) for name in ("x", "v", "trace", "determinant")},
        **hits,
        "kind": own.kind(conserves=True),
        "hits": total,
        "per_period": total // 4,
    }


def _row(F: str) -> Row:
    own = _near(F)
    title = (
        f"$F = {float(F):g}$: {own.kind(conserves=True)}, tr $= {own.trace:.3f}$, "
        f"det $= {own.determinant:.3f}$; in $4T$: {_in_short(_orbit(F))}"
    )
    return Row(_orbit(F), title)


def _in_short(orbit: Trajectory) -> str:
    return "{right} r, {left} l, {turns} turns".format_map(events.counted(orbit.words))


def _rows(shown: list[Row]) -> Rows:
    return Rows(tuple(shown), "Regimes over $F$", ("F",))


def low(_run: Run) -> Rows:
    """Follow the three orbits at moderate F."""
    return _rows([_row(F) for F in LOW])


def together(run: Run) -> Found:
    """Compare the three orbits at moderate F."""
    found = {F: periodic(run, F) for F in LOW}
    hits = [(own["right"], own["left"]) for own in found.values()]
    symmetric = [
        F for F, own in found.items() if mirror.defect(at(F=F), (own["x"], own["v"])) < 1e-6
    ]
    determinants = [own["determinant"] for own in found.values()]
    rates = np.sqrt(determinants)
    return {
        "ratios": ", ".join(f"{a // gcd(a, b)}:{b // gcd(a, b)}" for a, b in hits),
        "rate": float(rates.mean()),
        "rates": ", ".join(f"{rate:.3f}" for rate in rates),
        "determinant": float(np.mean(determinants)),
        "symmetric": ", ".join(symmetric),
    }


def fastest(_run: Run) -> Found:
    """Find the largest speed at F = 6."""
    return {"speed": float(np.abs(_orbit(HIGH).v).max())}


# generic orbits: the paper does not say where its orbits start


@cache
def _generic(run: Run, F: str) -> list[Trajectory]:
    """Follow orbits from a grid after a transient."""
    transient, window, _ = GENERIC[F]
    side = run.size(SEEDS, 3)
    x, v = np.meshgrid(np.linspace(-0.9, 0.9, side), np.linspace(-2, 2, side))
    seeds = np.stack([x.ravel(), v.ravel()], axis=-1)
    late = swarm.follow(at(F=F), seeds, transient).states
    return [_window(F, (float(a), float(b)), window) for a, b in late if np.isfinite(a)]


def high(run: Run) -> Rows:
    """Follow the orbit at F = 6, and generic orbits."""
    return _rows([_row(HIGH), *(_generic_row(run, F) for F in GENERIC)])


def _generic_row(run: Run, F: str) -> Row:
    transient, window, _ = GENERIC[F]
    orbits = _generic(run, F)
    shown = orbits[len(orbits) // 2]
    return Row(shown, f"$F = {F}$: after ${transient}T$; in ${window}T$: {_in_short(shown)}")


def generic(run: Run, F: str) -> Found:
    """Find the speeds of generic orbits, and whether they stick."""
    orbits, most = _generic(run, F), GENERIC[F][2]
    speeds = np.array([np.abs(orbit.v).max() for orbit in orbits])
    return {
        "least": speeds.min(),
        "most": speeds.max(),
        "orbits": len(orbits),
        "slow": percent(float((speeds <= most).sum()), len(speeds)),
        "stuck": sum("stick" in each.counts() or "capture" in each.counts() for each in orbits),
    }


def sinks(run: Run, F: str) -> Found:
    """Look for stable orbits, and for where most seeds end."""
    p = at(F=F)
    found = () if run.quick else search(p).isolated
    stable = [cycle for cycle in found if "sink" in cycle.kind(conserves=True)]
    settled = None if run.quick else strongest(p)
    return {
        "sinks": len(stable),
        "settled": settled.kind if settled else "nothing",
    }
