"""fig:KAM: the stroboscopic portrait around the elliptic orbit, and its island chains."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

import numpy as np

from cap.errors import BadInput
from cap.floats.diagnostics.chains import Chain, chains
from cap.floats.diagnostics.portrait import Portrait, portrait
from cap.floats.diagnostics.rotation import SHAKY, Rotation, rotation
from cap.paper.certified import theorem
from cap.paper.figure import Found, Run, percent
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


@cache
def _portrait(run: Run) -> Portrait:
    """Follow orbits from a disk as in the paper."""
    radius, orbits = RADIUS / float(PAPER.R), run.size(400, 60)
    return portrait(PAPER, radius=radius, orbits=orbits, periods=PERIODS, runner=run.runner)


@cache
def _rotation(run: Run) -> Rotation:
    """Measure rotation numbers along a ray."""
    orbits, periods = run.size(300, 40), run.size(3000, 400)
    return rotation(PAPER, radius=0.024, orbits=orbits, periods=periods, runner=run.runner)


@cache
def _chains(run: Run) -> tuple[Chain, ...]:
    """Search for chains: elliptic orbits of period qT that never turn."""
    seen = _portrait(run)
    if seen.centre is None:
        raise BadInput("the elliptic orbit was not found")
    regular = seen.states[~seen.turned].reshape(-1, 2)
    return tuple(chains(PAPER, seen.centre, regular[:: -(-len(regular) // SEEDS)], LARGEST))


def data(run: Run) -> Island:
    """Compute what the picture shows."""
    return Island(_portrait(run), _rotation(run), _chains(run))


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


def at_the_point(_run: Run) -> Found:
    """Enclose the rotation number at P_*."""
    turn = theorem("elliptic", (0.1003, 0.5419))["rotation_number"]
    known = list(convergents(Fraction(turn[0]), 4))
    both = {5, 7} <= {each.denominator for each in known}
    return {"turn": turn, "tight": ", ".join(map(str, known)), "both": both}


def curves(run: Run) -> Found:
    """Find the rotation numbers on the curves that a ray meets."""
    seen = _rotation(run)
    good = seen.quality < SHAKY
    steps = np.diff(seen.rotation[good & (seen.distance > 0.006)])
    top = int(np.argmax(np.where(good, seen.rotation, -np.inf)))
    return {
        "inner": seen.rotation[good.argmax()],
        "low": seen.rotation[good].min(),
        "high": seen.rotation[good].max(),
        "there": seen.distance[top],
        "smooth": (steps < 1e-4).all(),
    }


def chain(run: Run, q: str) -> Found:
    """Look for chains of a period."""
    found = _chains(run)
    own = [str(each.number) for each in found if each.number.denominator == int(q)]
    return {
        "own": ", ".join(own) or "none found",
        "found": own,
        "largest": LARGEST,
        "names": ", ".join(str(each.number) for each in found) or "none",
    }


def layer(run: Run) -> Found:
    """Count what lies outside of the curves."""
    turned = _portrait(run).turned
    lost, total = int(turned.sum()), len(turned)
    return {"lost": percent(lost, total), "total": total, "none": lost == 0}
