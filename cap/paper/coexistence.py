"""fig:coexist-main: a focus and a saddle at F = 3, and the other T-periodic orbits there."""

import math
from collections import Counter
from typing import Any

import numpy as np

from cap.audit.comparison import Comparison, claim, count, proved, roughly, taken_from
from cap.explore.inventory import inventory
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search.inventory import PROVED, Entry
from cap.paper.certified import theorem
from cap.paper.figure import Figure, Result, Run
from cap.paper.rows import Row, Rows
from cap.parameters import Parameters, at

FOCUS, SADDLE = (0.4064, -0.6708), (0.1992, -1.4002)
F = "3"


def compute(run: Run) -> Result:
    """Prove both orbits, and search for others."""
    p = at(F=F)
    focus, saddle = (theorem("periodic", state, F) for state in (FOCUS, SADDLE))
    found = inventory(p, prove=not run.quick, runner=run.runner).orbits
    compared = [
        *_orbit("focus", focus, ("+0.4064", "-0.6708"), ("-0.968", "+0.578")),
        *_multipliers(focus),
        *_orbit("saddle", saddle, ("+0.1992", "-1.4002"), ("+11.765", "+0.555")),
        *_real(saddle),
        *_both(p, found),
    ]
    shown = tuple(
        Row(trajectory(p, orbit=state, periods=2),
            f"{name}: $(x_*, v_*) = ({state[0]:.4f}, {state[1]:.4f})$")
        for name, state in (("sink (focus)", FOCUS), ("saddle", SADDLE))
    )  # fmt: skip
    return Result(tuple(compared), Rows(shown, "Two $T$-periodic orbits", forcing=False))


def _orbit(
    name: str, own: dict[str, Any], state: tuple[str, str], linear: tuple[str, str]
) -> list[Comparison]:
    """Compare a fixed point, the trace, the determinant and the events."""
    words = Counter(word.split()[0] for word in own["itinerary"])
    sides = Counter(own["itinerary"])
    pattern = f"{sides['hit r']} right, {sides['hit l']} left, {words['turn']} turns"
    return [
        proved(f"{name}: x_*", state[0], own["x"]),
        proved(f"{name}: v_*", state[1], own["v"]),
        proved(f"{name}: trace", linear[0], own["trace"]),
        proved(f"{name}: determinant", linear[1], own["determinant"]),
        claim(f"{name}: events in a period", "2 right, 2 left, 2 turns", f"{pattern} (proved)",
              pattern == "2 right, 2 left, 2 turns"),
    ]  # fmt: skip


def _multipliers(own: dict[str, Any]) -> list[Comparison]:
    first = own["multipliers"][0]
    hits = Counter(own["itinerary"])
    size = math.hypot(float(first["re"][0]), float(first["im"][0]))
    return [
        proved("focus: multipliers, real part", "-0.484", first["re"]),
        proved("focus: imaginary part", "0.587", first["im"]),
        proved("focus: modulus", "0.761", [f"{size:.15f}"]),
        claim("focus: type", "stable focus", f"{own['type']} (proved)",
              own["type"] == "sink focus", "another type"),
        *taken_from("ssec:hist-pitchfork", [
            claim("focus: hits per period", "one right, one left",
                  f"{hits['hit r']} right, {hits['hit l']} left (proved)",
                  hits["hit r"] == hits["hit l"] == 1,
                  "the appendix contradicts the caption, which is right")]),
    ]  # fmt: skip


def _real(own: dict[str, Any]) -> list[Comparison]:
    return [
        proved("saddle: larger multiplier", "11.72", own["multipliers"][0]),
        proved("saddle: smaller multiplier", "0.047", own["multipliers"][1]),
        claim("saddle: type", "saddle", f"{own['type']} (proved)", own["type"] == "saddle",
              "another type"),
        *taken_from("ssec:hist-pitchfork", [
            claim("patterns of the two", "visibly different, internal looping",
                  "the same events in the same order (proved)",
                  own["itinerary"] != theorem("periodic", FOCUS, F)["itinerary"],
                  "the appendix contradicts the caption, which is right")]),
    ]  # fmt: skip


def mirrored(p: Parameters, state: State) -> State:
    """Return the state at t = 0 of the mirror image of an orbit."""
    x, v = swarm.follow(p, [state], 0.5).states[0].tolist()
    return float(p.l + p.r) - x, -v


def _both(p: Parameters, found: tuple[Entry, ...]) -> list[Comparison]:
    """Compare what is said of the two, and of all."""
    gap = [np.abs(np.subtract(mirrored(p, state), state)).max() < 1e-3 for state in (FOCUS, SADDLE)]
    factors = theorem("periodic", FOCUS, F)["turning_factors"]
    product = math.prod(float(low) for low, _ in factors)
    sc = 4 * (2 * 3 + 2 - 3 * math.pi) / math.pi**2
    kinds = Counter(each.kind for each in found)
    return [
        roughly(count("T-periodic orbits at F = 3", 2, len(found),
                "more seeds: " + ", ".join(f"{n} {kind}" for kind, n in kinds.items())
                + f"; {sum(each.verdict == PROVED for each in found)} of them are proved")),
        claim("the two orbits under the symmetry", "not images of each other",
              "each is its own image" if all(gap) else "not their own images", all(gap),
              "the symmetry maps one to another orbit",
              note="so neither is one of a pair, as the appendix has it"),
        claim("determinant = product of (|F cos wt| - f)/(|F cos wt| + f) over turns", "yes",
              f"{product:.6f} (proved)", abs(product - float(
                  theorem("periodic", FOCUS, F)["determinant"][0])) < 1e-9),
        claim("(F, f) = (3, 0.4)", "in the purple region: 0 < f_sc < f", f"f_sc = {sc:.3f}", sc > 0,
              "f_sc is negative there"),
        *taken_from("ssec:hist-pitchfork", [
            claim("the pair of orbits", "T-periodic non-sticking",
                  f"turn {len(factors)} times in a period (proved)", not factors,
                  "by the paper's definition non-sticking orbits have no zero of the velocity")]),
    ]  # fmt: skip


FIGURE = Figure("two coexisting orbits at F = 3", compute, "rows:rows", (7.8, 5.2))
