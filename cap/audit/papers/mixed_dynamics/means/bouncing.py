"""Orbits at large forcing, from random starts, in floats: how they grow, and where they are."""

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

from cap.parameters import Parameters, at

FORCINGS, STARTS = (6, 12, 24, 48, 96, 192), 30


@dataclass(frozen=True)
class Growth:
    """How two medians over random starts grow with F, and the exponents of F between the ends."""

    hits: tuple[float, ...]
    speeds: tuple[float, ...]

    @property
    def exponents(self) -> tuple[float, float]:
        """The exponents of the hits per period, and of the largest |v|."""
        over = math.log(FORCINGS[-1] / FORCINGS[0])
        return (
            math.log(self.hits[-1] / self.hits[0]) / over,
            math.log(self.speeds[-1] / self.speeds[0]) / over,
        )


@cache
def growth() -> Growth:
    """Follow random starts for 20 T, then look at them for 4 T, at each F of `FORCINGS`."""
    import numpy as np  # noqa: PLC0415 (the float engine, where it is asked)

    from cap.floats.diagnostics.trajectory import trajectory  # noqa: PLC0415
    from cap.floats.engine import swarm  # noqa: PLC0415

    hits, speeds = [], []
    for F in FORCINGS:
        p = at(F=str(F))
        late = _late(p)
        hits.append(float(np.median(swarm.follow(p, late, 4).count("hit"))) / 4)
        orbits = [trajectory(p, orbit=(x, v), exactly=True, periods=4) for x, v in late]
        speeds.append(float(np.median([np.abs(orbit.v).max() for orbit in orbits])))
    return Growth(tuple(hits), tuple(speeds))


def near_the_walls(F: int) -> list[float]:
    """Return the shares of the time that orbits from random starts are within R/10 of a wall."""
    import numpy as np  # noqa: PLC0415 (the float engine, where it is asked)

    from cap.floats.diagnostics.trajectory import trajectory  # noqa: PLC0415

    p = at(F=str(F))
    shares = []
    for x, v in _late(p):
        orbit = trajectory(p, orbit=(x, v), exactly=True, periods=4)
        steps, sizes = np.diff(orbit.t), np.abs(orbit.x)
        near = (sizes[1:] + sizes[:-1]) / 2 > 0.8
        shares.append(float(steps[near].sum() / steps.sum()))
    return shares


def _late(p: Parameters) -> Any:
    """Return where random starts are after 20 periods."""
    import numpy as np  # noqa: PLC0415

    from cap.floats.engine import swarm  # noqa: PLC0415

    starts = np.random.default_rng(int(p.F)).uniform((-0.9, -2.0), (0.9, 2.0), (STARTS, 2))
    return swarm.follow(p, starts, 20).states
