"""fig:KAM: the stroboscopic portrait around the elliptic orbit, and its island chains."""

from dataclasses import dataclass
from functools import cache
from itertools import islice

import numpy as np

from cap.audit.means.lazy import sympy as sp
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


def at_the_point(_run: Run) -> Found:
    """Enclose the rotation number at P_*, and take its first convergents."""
    turn = theorem("elliptic", (0.1003, 0.5419))["rotation_number"]
    fraction = sp.continued_fraction_iterator(sp.Rational(turn[0]))
    known = list(islice(sp.continued_fraction_convergents(fraction), 1, 4))
    both = {5, 7} <= {each.q for each in known}
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
        "largest": LARGEST,
        "names": ", ".join(str(each.number) for each in found) or "none",
    }


def layer(run: Run) -> Found:
    """Count what lies outside of the curves."""
    turned = _portrait(run).turned
    return {"lost": percent(int(turned.sum()), len(turned)), "total": len(turned)}
