"""fig:continuation: the (1,1) orbits over (f, R), from the closed forms.

That is, the T-periodic orbits whose velocity never vanishes, with one hit of each wall per period.
At F = ω = 1: α = f, ρ = R.  Every one of them is ``plus``, ``minus`` or one of the ``pair``.
"""

import math
from dataclasses import dataclass
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from cap.floats.findings import Floats
from cap.floats.one_one import pair_curve, symmetric_member
from cap.paper.figure import Found, Run, percent
from cap.paper.nine_points import POINTS, members, papers_kind
from cap.parameters import PAPER

BOX = 0.01, 0.65, 0.2, 4.5
SIDE = 220
NAMES = ("plus", "minus", "pair")


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

    def kinds(self) -> NDArray[np.str_]:
        """Return for (M, N) points the kinds of plus, minus and pair: "se-", where - is none."""
        letters = np.where(self.elliptic, "e", np.where(self.exists, "s", "-"))
        return np.char.add(np.char.add(letters[0], letters[1]), letters[2])


@dataclass(frozen=True)
class Sampled:
    """The map, what is proved at the nine points, and what the paper found there."""

    map: Map
    points: dict[tuple[str, str], dict[str, str]]
    found: dict[tuple[str, str], str]


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


@cache
def _map(run: Run) -> Map:
    return mapped(run.size(SIDE if run.drawn else SIDE // 2, 24), run)


def data(run: Run) -> Sampled:
    """Prove what there is at the nine points, and compute the map."""
    points = {key: members(*key) for key in POINTS}
    return Sampled(_map(run), points, {key: papers_kind(*key) for key in POINTS})


def saddle_center(R: float) -> float:
    """Return the paper's f_sc(R), at F = ω = 1."""
    return 4 * (2 + R - math.pi) / math.pi**2


def curve(_run: Run) -> Found:
    """Say which of the nine points are above the paper's curve f_sc(R)."""
    above = [key for key in POINTS if float(key[0]) > saddle_center(float(key[1]))]
    predicted = [key for key in POINTS if (key in above) == ("elliptic" in members(*key).values())]
    return {
        "upper": sum(R != "1" for _, R in above),
        "lower": sum(key not in above for key in (("0.15", "1"), ("0.35", "1"), ("0.15", "2"))),
        "at_1": saddle_center(1),
        "at_3": saddle_center(3),
        "predicted": len(predicted),
    }


def region(run: Run, name: str) -> Found:
    """Return the part of a region of the paper's shading on which its words are true."""
    found = _map(run)
    f, R = np.meshgrid(found.f, found.R)
    sc, inside = 4 * (2 + R - np.pi) / np.pi**2, f < 2 / math.pi
    elliptic, saddle = found.elliptic.any(axis=0), (found.exists & ~found.elliptic).any(axis=0)
    where, true = {
        "blue": (sc <= 0, elliptic & ~saddle),
        "purple": ((sc > 0) & (f > sc), elliptic & saddle),
        "white": ((sc > 0) & (f < sc), ~elliptic & ~saddle),
    }[name]
    part, whole = int((inside & where & true).sum()), int((inside & where).sum())
    return {"part": percent(part, whole), "rest": whole - part}


def beyond_the_bound(run: Run) -> Found:
    """Look for orbits above the impulse bound."""
    found = _map(run)
    return {"none": not found.exists[..., found.f > 2 / math.pi].any()}


def exponent(_run: Run) -> Found:
    """Fit how the saddle's multipliers tend to 1 at the saddle-center."""
    rho = float(PAPER.R * PAPER.omega**2 / PAPER.F)
    nu = np.geomspace(1e-10, 1e-7, 10)
    traces = [symmetric_member(2 / math.pi - n, rho, -1).trace for n in nu.tolist()]
    exponents = np.arccosh(np.array(traces) / 2)
    return {"slope": float(np.polyfit(np.log(nu), np.log(exponents), 1)[0])}


def meeting(_run: Run) -> Found:
    """Say how the f at which plus and minus meet depends on R."""
    return {"gap": np.ptp([_meeting(R) for R in (1.0, 2.0, 3.0)])}


def _meeting(R: float) -> float:
    """Return f at which plus and minus meet: where their traces, 2 ∓ c sqrt(2/π - f), do."""
    f = 2 / math.pi - np.array([2e-8, 1e-8])
    c = [
        (symmetric_member(a, R, -1).trace - symmetric_member(a, R, 1).trace) ** 2
        for a in f.tolist()
    ]
    return float(f[1] + c[1] * (f[1] - f[0]) / (c[0] - c[1]))
