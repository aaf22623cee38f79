"""fig:hist-cont: how many T-periodic orbits there are over F."""

import math
from collections import Counter
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from cap.audit.comparison import Comparison, claim, count, number, roughly, taken_from, unstated
from cap.errors import BadInput
from cap.floats.diagnostics.continuation import continuation
from cap.floats.search.cycles import Cycle, StroboscopicMap
from cap.floats.search.orbits import search
from cap.paper.figure import Figure, Result, Run
from cap.parameters import PAPER, Parameters, at
from cap.proofs.census import census

FORCES = ("0.65", "0.85", "1", "1.5", "2", "2.5", "3", "3.5", "4.5")
QUICK = ("0.65", "0.85", "1.5")
GIVEN = {"1.5": (2, 1), "2": (0, 0), "3.5": (0, 3)}  # F: elliptic, saddle, as the paper says
TOTAL = 7, 8
SAME = 0.025  # the paper's, in each coordinate
SLOWEST, DETERMINANTS = 0.05, (0.1, 5.0)  # of what the paper keeps
SEEDS = 3  # per side: the paper does not say how many; these come nearest to its counts
CHOSEN = "how many seeds, and the damping, are not said; ours are chosen to come near its counts"
FOLD = 0.887
SAME_F = 1e-5
NEIGHBOURS = 0.75  # how far on either side of its F a sink is followed


@dataclass(frozen=True)
class Counted:
    """The orbits found at each F: by a thorough search, and by the paper's from few ``seeds``."""

    forces: tuple[str, ...]
    thorough: tuple[tuple[Cycle, ...], ...]
    paper: tuple[tuple[Cycle, ...], ...]
    seeds: int = SEEDS
    fold: float = FOLD


def kept(p: Parameters, cycle: Cycle) -> bool:
    """Return whether the paper's search keeps a fixed point."""
    low, high = DETERMINANTS
    return abs(cycle.x) < float(p.r) and abs(cycle.v) > SLOWEST and low <= cycle.determinant <= high


def grid_newton(p: Parameters, seeds: int) -> list[Cycle]:
    """Search as the paper describes: Newton's method from seeds in [-0.5, 0.5] x [-2, 2]."""
    strobe, found = StroboscopicMap(p), list[Cycle]()
    for x in np.linspace(-0.5, 0.5, seeds).tolist():
        for v in np.linspace(-2, 2, seeds).tolist():
            try:
                cycle = strobe.newton((x, v))
            except BadInput:
                continue
            if cycle is None or not kept(p, cycle):
                continue
            near = (abs(cycle.x - c.x) < SAME and abs(cycle.v - c.v) < SAME for c in found)
            if not any(near):
                found.append(cycle)
    return found


def _both(F: str) -> tuple[list[Cycle], list[Cycle]]:
    p = at(F=F)
    return list(search(p).isolated), grid_newton(p, SEEDS)


def split(found: tuple[Cycle, ...]) -> tuple[int, int]:
    """Return how many are elliptic, and saddles, as the paper counts: by the trace alone."""
    elliptic = sum(abs(each.trace) < 2 for each in found)
    return elliptic, len(found) - elliptic


def compute(run: Run) -> Result:
    """Search at each F, thoroughly and as the paper does."""
    forces = QUICK if run.quick else FORCES
    found = run.runner.map(_both, forces, "search", processes=not run.quick)
    data = Counted(
        forces[: len(found)],
        tuple(tuple(each[0]) for each in found),
        tuple(tuple(each[1]) for each in found),
    )
    return Result((*_counts(data), *_words(data, run)), data)


def _counts(data: Counted) -> list[Comparison]:
    """Compare the counts that the paper states."""
    mine = dict(zip(data.forces, zip(data.paper, data.thorough, strict=True), strict=True))
    rows = []
    for F, (elliptic, saddle) in GIVEN.items():
        if F not in mine:
            continue
        rough, full = (split(each) for each in mine[F])
        rows += [
            unstated(claim(
                f"F = {F}: elliptic + saddle, grid-Newton", f"{elliptic} + {saddle}",
                f"{rough[0]} + {rough[1]} ({SEEDS} x {SEEDS} seeds)", False), CHOSEN),
            roughly(claim(
                f"F = {F}: all orbits found, elliptic + saddle", f"{elliptic} + {saddle}",
                f"{full[0]} + {full[1]}", full == (elliptic, saddle),
                "missed by the seeds: " + _missed(mine[F][1], mine[F][0]))),
        ]  # fmt: skip
    rough, full = (
        np.array([split(each) for each in part]).sum(axis=0).tolist()
        for part in (data.paper, data.thorough)
    )
    why = "missed by the seeds"
    return [
        *rows,
        unstated(count("elliptic orbits at all F, grid-Newton", TOTAL[0], rough[0]), CHOSEN),
        unstated(count("saddles at all F, grid-Newton", TOTAL[1], rough[1]), CHOSEN),
        roughly(count("orbits at all F", sum(TOTAL), sum(full),
                f"{why}, or dropped by the paper's filters (|v| > 0.05, 0.1 <= det <= 5), which "
                f"{_passing(data)} of ours pass")),
        roughly(claim("ratio elliptic : saddle", "1:1, one elliptic with one saddle",
              f"{full[0]} : {full[1]} of all that are found",
              abs(full[0] - full[1]) <= 0.25 * sum(full),
              "the paper's is of the 15 that it found; most orbits have turns and are saddles; by "
              "trace and determinant, not trace alone, " + _types(data))),
        roughly(claim(
            "orbits at each F but 2", "1 to 3",
            ", ".join(f"{F}: {len(o)}" for F, o in zip(data.forces, data.thorough, strict=True)),
            all(1 <= len(o) <= 3 for F, o in
                zip(data.forces, data.thorough, strict=True) if F != "2"), why)),
    ]  # fmt: skip


def _passing(data: Counted) -> int:
    return sum(
        kept(at(F=F), cycle)
        for F, found in zip(data.forces, data.thorough, strict=True)
        for cycle in found
    )


def _missed(full: tuple[Cycle, ...], rough: tuple[Cycle, ...]) -> str:
    missing = [c for c in full if all(abs(c.x - r.x) + abs(c.v - r.v) > 1e-5 for r in rough)]
    words = [f"({c.x:.3f}, {c.v:.3f}) {c.kind(conserves=True)}" for c in missing]
    return ", ".join(words[:4]) + (f", and {len(words) - 4} more" if len(words) > 4 else "")


def _types(data: Counted) -> str:
    kinds = [c.kind(conserves=True) for found in data.thorough for c in found]
    return ", ".join(f"{kinds.count(kind)} {kind}" for kind in sorted(set(kinds)))


def _words(data: Counted, run: Run) -> list[Comparison]:
    """Compare what the text says about the orbits."""
    mine = dict(zip(data.forces, data.thorough, strict=True))
    below = [c for F in ("0.65", "0.85") for c in mine.get(F, ())]
    free = all({word.split()[0] for word, _ in c.events} == {"hit"} for c in below)
    f, R = float(PAPER.f), float(PAPER.R)
    fold = (f * math.pi**2 - 4 * R) / (4 * (2 - math.pi))
    dets = [c.determinant for found in data.thorough for c in found]
    many = [F for F, found in mine.items() if len(found) > 2]
    within = sum(0.5 <= d <= 0.6 for d in dets)
    return [
        *taken_from("eq:hist-Fsc-cross", [
            number("F_sc at f = 0.4", "0.887", fold, note="the formula; no orbit folds there")]),
        number("F_imp = pi f/2", "0.628", math.pi * f / 2),
        claim("F = 0.65 and 0.85: orbits found below F_sc", "multiple turnings per period",
              "velocity never zero, one hit of each wall: (1,1) orbits" if free else "with turns",
              not free,
              "they are the orbits of the elliptic branch, to which no F_sc applies"),
        claim("most orbits have determinants", "in [0.5, 0.6]",
              f"{within} of {len(dets)}", 2 * within > len(dets),
              "orbits with sticks have 0, orbits that never turn 1, others anything below 1"),
        *taken_from("ssec:hist-connection", [
            claim("orbits proliferate", "above F = 1.3",
                  f"more than 2 at F = {', '.join(many)}", all(float(F) > 1.3 for F in many),
                  orbits_at_1())]),
        *taken_from("ssec:hist-pitchfork", [_flips(mine, run)]),
    ]  # fmt: skip


def orbits_at_1() -> str:
    """Count the orbits at F = 1 of which none is missing: those whose velocity never vanishes."""
    number = Counter[str]()
    for member in census(PAPER.f / PAPER.F, PAPER.R * PAPER.omega**2 / PAPER.F):
        number[member.kind] += 2 if member.name == "pair" else 1
    kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(number.items()))
    return (
        f"at F = 1 there are {number.total()} (1,1) orbits, whose velocity never vanishes: {kinds} "
        "(proved); orbits that turn or stick may be more"
    )


def _flips(mine: dict[str, tuple[Cycle, ...]], run: Run) -> Comparison:
    """Look for period doublings: flip saddles, and where the sinks found become such."""
    flips = [F for F, found in mine.items()
             if any(c.kind(conserves=True) == "flip saddle" for c in found)]  # fmt: skip
    sinks = [(F, c) for F, found in mine.items() for c in found if "sink" in c.kind(conserves=True)]
    where = ", ".join(f"{value:.6f}" for value in doublings(sinks, run))
    return claim(
        "period doublings in the range", "none observed, tr != -2",
        f"flip saddles at F = {', '.join(flips)}; along the sinks found the period doubles at "
        f"F = {where}", not flips,
        "a multiplier -1 of a map with det < 1 has trace -1 - det, not -2",
    )  # fmt: skip


def doublings(sinks: list[tuple[str, Cycle]], run: Run) -> list[float]:
    """Return the F, ascending, at which the period of a sink, or of the pair that it breaks into,
    doubles; mirror images do so at the same F."""

    def follow(sink: tuple[str, Cycle]) -> list[float]:
        F, cycle = sink
        ends = float(F) - NEIGHBOURS, float(F) + NEIGHBOURS
        curves = continuation(at(F=F), orbit=(cycle.x, cycle.v), parameter="F", range=ends,
                              points=run.size(200, 20), branches=2)  # fmt: skip
        return [each.value for each in curves.special if each.label == "flip" and each.period == 1]

    found = sorted(value for values in run.runner.map(follow, sinks, "flips") for value in values)
    return [b for a, b in pairwise([-math.inf, *found]) if b - a > SAME_F]


FIGURE = Figure("T-periodic orbits over F", compute, "forcing:forcing", (7.6, 4.8))
