"""Appendix, A.2 and A.3: orbits at large forcing, from random starts, in floats."""

import math
from functools import cache
from statistics import median
from typing import TYPE_CHECKING

from cap.audit import labels
from cap.audit.means.need import need
from cap.audit.steps import Words
from cap.parameters import at

if TYPE_CHECKING:
    from cap.floats.diagnostics.trajectory import Trajectory

FORCINGS, STARTS = (6, 12, 24, 48, 96, 192), 30


@cache
def _late(F: int) -> list["Trajectory"]:
    """Follow random starts for 20 T; return what they do in the 4 T after."""
    import numpy as np  # noqa: PLC0415 (the float engine, where it is asked)

    from cap.floats.diagnostics.trajectory import trajectory  # noqa: PLC0415
    from cap.floats.engine import swarm  # noqa: PLC0415

    p = at(F=str(F))
    starts = np.random.default_rng(F).uniform((-0.9, -2.0), (0.9, 2.0), (STARTS, 2))
    late = swarm.follow(p, starts, 20).states
    return [trajectory(p, orbit=(x, v), exactly=True, periods=4) for x, v in late]


def _hits(orbit: "Trajectory") -> float:
    """Return the hits per period."""
    return orbit.counts().get("hit", 0) / 4


def _speed(orbit: "Trajectory") -> float:
    return float(abs(orbit.v).max())


def scaling(what: str) -> Words:
    """The median of the hits per period, or of the largest |v|, grows more slowly than F."""
    measure = {"hits": _hits, "speed": _speed}[what]
    medians = [median(map(measure, _late(F))) for F in FORCINGS]
    exponent = math.log(medians[-1] / medians[0]) / math.log(FORCINGS[-1] / FORCINGS[0])
    need(exponent < 3 / 4, "they may grow in proportion to F", medians=medians)
    return {
        "numbers": ", ".join(f"{value:.3g}" for value in medians),
        "forcings": ", ".join(map(str, FORCINGS)),
        "exponent": f"{exponent:.2f}",
        "starts": STARTS,
    }


def time_near_the_walls() -> Words:
    """At F = 50 no orbit is within R/10 of a wall for half of the time."""
    shares = sorted(map(_near_the_walls, _late(50)))
    need(shares[-1] < 1 / 2, "an orbit is near the walls most of the time", shares=shares)
    middle = shares[len(shares) // 2]
    return {"orbits": len(shares), "median": f"{middle:.0%}", "largest": f"{shares[-1]:.0%}"}


def _near_the_walls(orbit: "Trajectory") -> float:
    """Return the share of the time that an orbit is so near to a wall."""
    steps, sizes = orbit.t[1:] - orbit.t[:-1], abs(orbit.x)
    near = (sizes[1:] + sizes[:-1]) / 2 > 0.8
    return float(steps[near].sum() / steps.sum())


def number_of_subsections() -> Words:
    """The appendix has not five of them."""
    found = [p for p in labels.stored().places if p.section == "A" and p.kind == "subsection"]
    need(len(found) != 5, "there are five")
    return {"found": len(found)}
