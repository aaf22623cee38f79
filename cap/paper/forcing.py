"""fig:hist-cont: how many T-periodic orbits there are over F."""

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np

from cap.errors import BadInput
from cap.floats.diagnostics.continuation import continuation
from cap.floats.search.cycles import Cycle, StroboscopicMap
from cap.floats.search.orbits import search
from cap.paper.figure import Found, Run
from cap.paper.mirror import of_pairs
from cap.paper.nine_points import at_the_paper
from cap.parameters import Parameters, at

FORCES = ("0.65", "0.85", "1", "1.5", "2", "2.5", "3", "3.5", "4.5")
SAME = 0.025  # the paper's, in each coordinate
SLOWEST, DETERMINANTS = 0.05, (0.1, 5.0)  # of what the paper keeps
SEEDS = 3  # per side: the paper does not say how many; these come nearest to its counts
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


@cache
def _thorough(F: str) -> tuple[Cycle, ...]:
    return tuple(search(at(F=F)).isolated)


@cache
def _paper(F: str) -> tuple[Cycle, ...]:
    return tuple(grid_newton(at(F=F), SEEDS))


@cache
def _everywhere(run: Run) -> dict[str, tuple[Cycle, ...]]:
    """Search at each F, thoroughly."""
    forces = ("0.65", "1.5") if run.quick else FORCES
    found = run.runner.map(_thorough, forces, "search", processes=not run.quick)
    return dict(zip(forces, found, strict=True))


def data(run: Run) -> Counted:
    """Search at each F, thoroughly and as the paper does."""
    found = _everywhere(run)
    return Counted(tuple(found), tuple(found.values()), tuple(map(_paper, found)))


def split(found: Iterable[Cycle]) -> tuple[int, int]:
    """Return how many are elliptic, and saddles, as the paper counts: by the trace alone."""
    elliptic = [abs(each.trace) < 2 for each in found]
    return sum(elliptic), len(elliptic) - sum(elliptic)


def _sum(found: tuple[int, int]) -> str:
    return f"{found[0]} + {found[1]}"


def by_the_paper(_run: Run, F: str) -> Found:
    """Count what the paper's search finds at F."""
    return {"found": _sum(split(_paper(F))), "seeds": SEEDS}


def by_search(_run: Run, F: str) -> Found:
    """Count what a thorough search finds at F, and what the paper's misses."""
    return {"found": _sum(split(_thorough(F))), "missed": _missed(_thorough(F), _paper(F))}


def _missed(full: tuple[Cycle, ...], rough: tuple[Cycle, ...]) -> str:
    missing = [c for c in full if all(abs(c.x - r.x) + abs(c.v - r.v) > 1e-5 for r in rough)]
    words = [f"({c.x:.3f}, {c.v:.3f}) {c.kind(conserves=True)}" for c in missing]
    return ", ".join(words[:4]) + (f", and {len(words) - 4} more" if len(words) > 4 else "")


def all_by_the_paper(run: Run) -> Found:
    """Count what the paper's search finds at all F."""
    forces = ("1.5",) if run.quick else FORCES
    elliptic, saddle = split(cycle for F in forces for cycle in _paper(F))
    return {"elliptic": elliptic, "saddle": saddle}


def all_by_search(run: Run) -> Found:
    """Count what a thorough search finds at all F."""
    found = _everywhere(run)
    every = [(at(F=F), cycle) for F, cycles in found.items() for cycle in cycles]
    elliptic, saddle = split(cycle for _, cycle in every)
    kinds = Counter(cycle.kind(conserves=True) for _, cycle in every)
    return {
        "orbits": len(every),
        "passing": sum(kept(p, cycle) for p, cycle in every),
        "elliptic": elliptic,
        "saddle": saddle,
        "balanced": abs(elliptic - saddle) <= 0.25 * len(every),
        "types": ", ".join(f"{kinds[kind]} {kind}" for kind in sorted(kinds)),
        "numbers": ", ".join(f"{F}: {len(cycles)}" for F, cycles in found.items()),
        "few": all(1 <= len(cycles) <= 3 for F, cycles in found.items() if F != "2"),
    }


def below(_run: Run) -> Found:
    """Say whether the orbits found below F_sc turn."""
    found = [*_thorough("0.65"), *_thorough("0.85")]
    free = {word.split()[0] for cycle in found for word, _ in cycle.events} == {"hit"}
    shown = "velocity never zero, one hit of each wall: (1,1) orbits" if free else "with turns"
    return {"shown": shown}


def determinants(run: Run) -> Found:
    """Count the determinants that lie where most are said to lie."""
    dets = [cycle.determinant for found in _everywhere(run).values() for cycle in found]
    within = sum(0.5 <= det <= 0.6 for det in dets)
    return {"within": within, "orbits": len(dets), "half": len(dets) / 2}


def many(run: Run) -> Found:
    """Say at which F there are more than two orbits."""
    forces = [F for F, found in _everywhere(run).items() if len(found) > 2]
    least = min(map(float, forces), default=math.inf)
    return {"forces": ", ".join(forces), "least": least, "at_1": orbits_at_1()}


def orbits_at_1() -> str:
    """Count the orbits at F = 1 of which none is missing: those whose velocity never vanishes."""
    number = Counter[str]()
    for member, orbits in at_the_paper():
        number[member.kind] += orbits
    kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(number.items()))
    return (
        f"at F = 1 there are {number.total()} (1,1) orbits, whose velocity never vanishes: {kinds} "
        "(proved); orbits that turn or stick may be more"
    )


def flips(run: Run) -> Found:
    """Look for period doublings: flip saddles, and where the sinks found become such."""
    every = [(F, c) for F, found in _everywhere(run).items() for c, _ in of_pairs(at(F=F), found)]
    saddles = dict.fromkeys(F for F, c in every if c.kind(conserves=True) == "flip saddle")
    sinks = [(F, c) for F, c in every if "sink" in c.kind(conserves=True)]
    where = ", ".join(f"{value:.6f}" for value in doublings(sinks, run))
    return {"saddles": ", ".join(saddles), "where": where}


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
