"""fig:KAM: the stroboscopic portrait around the elliptic orbit, and its island chains."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from cap.audit.comparison import Comparison, claim, percent, proved
from cap.errors import BadInput
from cap.floats.diagnostics.chains import Chain, chains
from cap.floats.diagnostics.portrait import Portrait, portrait
from cap.floats.diagnostics.rotation import SHAKY, Rotation, rotation
from cap.paper.certified import theorem
from cap.paper.figure import Figure, Result, Run
from cap.parameters import PAPER

RADIUS, PERIODS = 0.05, 300
LARGEST = 29  # denominator of the chains that are looked for
SEEDS = 1000  # of this search: states of orbits that never turn


@dataclass(frozen=True)
class Island:
    """The portrait, the rotation numbers on a ray, and the chains found."""

    portrait: Portrait
    rotation: Rotation
    chains: tuple[Chain, ...]


def convergents(value: Fraction, count: int) -> Iterator[Fraction]:
    """Give the first convergents of the continued fraction of a number in (0, 1)."""
    h, k = (1, 0), (0, 1)
    for _ in range(count):
        whole = value.numerator // value.denominator
        h, k = (whole * h[0] + h[1], h[0]), (whole * k[0] + k[1], k[0])
        if h[0]:
            yield Fraction(h[0], k[0])
        if value == whole:
            return
        value = 1 / (value - whole)


def compute(run: Run) -> Result:
    """Follow orbits from a disk as in the paper, measure rotation numbers, search for chains."""
    seen = portrait(PAPER, radius=RADIUS / float(PAPER.R), orbits=run.size(400, 60),
                    periods=PERIODS, runner=run.runner)  # fmt: skip
    turns = rotation(PAPER, radius=0.024, orbits=run.size(300, 40), periods=run.size(3000, 400),
                     runner=run.runner)  # fmt: skip
    if seen.centre is None:
        raise BadInput("the elliptic orbit was not found")
    regular = seen.states[~seen.turned].reshape(-1, 2)
    found = chains(PAPER, seen.centre, regular[:: -(-len(regular) // SEEDS)], LARGEST)
    rows = [*_curves(turns), *_chains(found), *_layer(seen)]
    return Result(tuple(rows), Island(seen, turns, tuple(found)))


def _curves(turns: Rotation) -> list[Comparison]:
    """Compare the rotation numbers on the curves that a ray meets."""
    own = theorem("elliptic", (0.1003, 0.5419))
    good = turns.quality < SHAKY
    low, high = float(turns.rotation[good].min()), float(turns.rotation[good].max())
    known = list(convergents(Fraction(own["rotation_number"][0]), 4))
    tight = ", ".join(map(str, known))
    steps = np.diff(turns.rotation[good & (turns.distance > 0.006)])
    near, top = good.argmax(), int(np.argmax(np.where(good, turns.rotation, -np.inf)))
    inner, there = turns.rotation[near], turns.distance[top]
    rises = f"rises from {inner:.10f} at P_* (a minimum: tau_1 > 0) to {high:.10f} at {there:.4f}, "
    return [
        proved("rotation number at P_*", "0.287", own["rotation_number"]),
        claim("rotation number with the radius", "varies smoothly, close to 0.287",
              f"{rises}then falls to {low:.4f}",
              bool((steps < 1e-4).all()), "",
              note="on the curves; nearly constant up to a distance of 0.01"),
        claim("5 and 7 are denominators of convergents", "both",
              f"convergents {tight}", {5, 7} <= {f.denominator for f in known},
              "7 is, 5 is not"),
    ]  # fmt: skip


def _chains(found: list[Chain]) -> list[Comparison]:
    """Compare the chains: elliptic orbits of period qT that never turn."""
    names = ", ".join(str(chain.number) for chain in found) or "none"
    said = f"chains found with q <= {LARGEST}: {names}"

    def chain(q: int, word: str) -> Comparison:
        own = [str(each.number) for each in found if each.number.denominator == q]
        return claim(f"chain of period {word}", "most visible", ", ".join(own) or "none found",
                     bool(own), said, note=said)  # fmt: skip

    return [chain(5, "five"), chain(7, "seven")]


def _layer(seen: Portrait) -> list[Comparison]:
    """Compare what lies outside of the curves."""
    lost, total = int(seen.turned.sum()), len(seen.turned)
    return [
        claim(f"orbits of the disk of radius {RADIUS} in {PERIODS} periods",
              "curves, chains, and a thin chaotic layer within Omega_NS",
              f"{percent(lost, total)} of {total} turn or stick", lost == 0,
              "the island is smaller than the disk: what surrounds it lies in Omega_dissip"),
    ]  # fmt: skip


FIGURE = Figure(
    "stroboscopic portrait around the elliptic orbit", compute, "island:island", (8.4, 4.4)
)
