"""fig:continuation: the (1,1) orbits over (f, R), from the closed forms.

That is, the T-periodic orbits whose velocity never vanishes, with one hit of each wall per period.
At F = ω = 1: α = f, ρ = R.  Every one of them is ``plus``, ``minus`` or one of the ``pair``.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cap.audit.comparison import Comparison, claim, count, number, percent, taken_from, unstated
from cap.floats.findings import Floats
from cap.floats.one_one import pair_curve, symmetric_member
from cap.paper.figure import Figure, Result, Run
from cap.paper.nine_points import FORCES, GAPS, PAPER_KINDS, nine, others
from cap.parameters import PAPER
from cap.proofs.census import census

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


def compute(run: Run) -> Result:
    """Prove what there is at the nine points, and draw the map."""
    points = {
        (f, R): {m.name: m.kind for m in census(Fraction(f), Fraction(R))}
        for f in FORCES
        for R in GAPS
    }
    found = mapped(run.size(SIDE if run.drawn else SIDE // 2, 24), run)
    rows = [*nine(points), *others(), *_formulas(points), *_shading(found), *_limits()]
    return Result(tuple(rows), Sampled(found, points, PAPER_KINDS))


def _sc(R: float) -> float:
    return 4 * (2 + R - math.pi) / math.pi**2


def _formulas(points: dict[tuple[str, str], dict[str, str]]) -> list[Comparison]:
    """Compare what the paper says about its curve f_sc(R)."""
    upper = [(f, R) for f in FORCES for R in GAPS if R != "1" and float(f) > _sc(float(R))]
    below = [(f, R) for f, R in (("0.15", "1"), ("0.35", "1"), ("0.15", "2"))
             if float(f) < _sc(float(R))]  # fmt: skip
    at_3 = f"f_sc(3) = {_sc(3):.3f} > f_imp, so that no point with R = 3 is above the curve"
    at_1 = f"f_sc(1) = {_sc(1):.3f} < 0: both points with R = 1 are above"
    predicted = [
        key for key in points
        if (float(key[0]) > _sc(float(key[1]))) == ("elliptic" in points[key].values())
    ]  # fmt: skip
    return [
        count("verified points above f_sc(R) with R = 2, 3", 4, len(upper), at_3),
        count("of (0.15, 1), (0.35, 1), (0.15, 2): below f_sc(R)", 3, len(below), at_1),
        claim("(0.55, 1)", "in the purple region, f_sc > 0",
              f"f_sc(1) = {_sc(1):.3f}", _sc(1) > 0, "by the caption it is in the blue region"),
        claim("elliptic (1,1) orbits exist above f_sc(R), not below", "at all points",
              f"at {len(predicted)} of 9", len(predicted) == 9,
              "no curve f_sc(R) separates anything: no root of its equation is an orbit (theorem "
              "`symmetric`)"),
        number("f_imp = 2F/pi", "0.637", 2 / math.pi),
        number("grid: steps in f", "0.003", (BOX[1] - BOX[0]) / (SIDE - 1)),
        number("grid: steps in R", "0.02", (BOX[3] - BOX[2]) / (SIDE - 1)),
    ]  # fmt: skip


def _shading(found: Map) -> list[Comparison]:
    """Compare the paper's shading with the (1,1) orbits that there are, over the grid."""
    f, R = np.meshgrid(found.f, found.R)
    sc = 4 * (2 + R - np.pi) / np.pi**2
    inside = f < 2 / math.pi
    elliptic, saddle = found.elliptic.any(axis=0), (found.exists & ~found.elliptic).any(axis=0)
    blue, purple = inside & (sc <= 0), inside & (sc > 0) & (f > sc)
    white = inside & (sc > 0) & (f < sc)
    why = "the regions are bounded by other curves: least speed 0, pitchfork, f = 2F/pi"

    def share(region: NDArray[np.bool_], truth: Any, words: str) -> Comparison:
        name, says = words.split(": ")
        part = int((region & truth).sum())
        return claim(f"{name} region, of (1,1) orbits", says,
                     f"true on {percent(part, int(region.sum()))} of it",
                     part == int(region.sum()), why)  # fmt: skip

    return [
        share(blue, elliptic & ~saddle, "blue: elliptic orbit only"),
        share(purple, elliptic & saddle, "purple: elliptic and saddle orbits"),
        share(white, ~elliptic & ~saddle, "white: no orbit (of the symmetric branch)"),
        claim("(1,1) orbits for f > 2F/pi", "none", "none",
              not found.exists[:, f > 2 / math.pi].any(), "the formulas give some"),
    ]  # fmt: skip


def _limits() -> list[Comparison]:
    """Compare how the multipliers tend to 1 at the saddle-center."""
    rho = float(PAPER.R * PAPER.omega**2 / PAPER.F)
    nu = np.geomspace(1e-10, 1e-7, 10)
    traces = [symmetric_member(2 / math.pi - n, rho, -1).trace for n in nu.tolist()]
    exponents = np.arccosh(np.array(traces) / 2)
    slope = float(np.polyfit(np.log(nu), np.log(exponents), 1)[0])
    gap = float(np.ptp([_least_gap(R) for R in (1.0, 2.0, 3.0)]))
    return [
        *taken_from("ssec:num-coexist", [
            unstated(number("exponent of mu in the positive Lyapunov exponent", "0.25", slope),
                     "this is the saddle's own, at f = 2F/pi; on which orbits of the chaotic "
                     "component of Omega_NS, at which mu, the paper's was computed is not said")]),
        claim("saddle-center: where", "f_sc(R), depends on R",
              f"2F/pi for every R (differences of {gap:.0e} between R = 1, 2, 3)", gap > 1e-3,
              "GKR2019 has it right: plus and minus meet at f = 2F/pi (proved)"),
    ]  # fmt: skip


def _least_gap(R: float) -> float:
    """Return f at which plus and minus meet: where their traces, 2 ∓ c sqrt(2/π - f), do."""
    f = 2 / math.pi - np.array([2e-8, 1e-8])
    c = [
        (symmetric_member(a, R, -1).trace - symmetric_member(a, R, 1).trace) ** 2
        for a in f.tolist()
    ]
    return float(f[1] + c[1] * (f[1] - f[0]) / (c[0] - c[1]))


FIGURE = Figure(
    "(1,1) orbits (velocity never zero, one hit of each wall) over (f, R)",
    compute,
    "one_one:over_f_and_gap",
    (8.2, 5.2),
)
