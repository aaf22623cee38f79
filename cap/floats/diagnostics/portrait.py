"""Stroboscopic portraits: many orbits, seen once in a period."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cap.errors import BadInput
from cap.floats.diagnostics.grid import PROBES, Box, grid, require_followed, whole
from cap.floats.engine import swarm
from cap.floats.engine.pieces import in_pieces
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.fixed_point import elliptic_point
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

MOST = 10_000_000  # states kept
GOLDEN = math.pi * (3 - math.sqrt(5))


@dataclass(frozen=True, kw_only=True)
class Portrait(Findings):
    """The states (N, K, 2) of N orbits at t = 0, T, …; ``turned`` (N,): it turns or sticks.

    ``centre`` is the fixed point around which the orbits start, or None.
    """

    states: Floats
    turned: NDArray[np.bool_]
    centre: State | None

    def columns(self) -> dict[str, ArrayLike]:
        """Return one row for each orbit and period."""
        orbit, period = np.indices(self.states.shape[:2])
        return {
            "orbit": orbit,
            "period": period,
            "x": self.states[..., 0],
            "v": self.states[..., 1],
            "turned": self.turned[:, None],
        }

    def lines(self) -> list[str]:
        """Return how many orbits there are, and how many of them turn."""
        n, k = self.states.shape[:2]
        head = f"stroboscopic portrait at {described(self.parameters)}: {n} orbits, {k - 1} periods"
        about = f"  around ({self.centre[0]:.10g}, {self.centre[1]:.10g})" if self.centre else ""
        done = np.isfinite(self.states).all(axis=(1, 2))
        never, lost = int((~self.turned & done).sum()), int((~done).sum())
        tail = f", {lost} were lost or not done" if lost else ""
        return [
            head,
            *([about] if about else []),
            f"  {never} of the orbits never turn or stick{tail}",
        ]


def portrait(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    orbit: State | None = None,
    box: Box | None = None,
    radius: float | None = None,
    orbits: int = 100,
    periods: int = 500,
    runner: Runner | None = None,
) -> Portrait:
    """Follow orbits from an ellipse around a fixed point, or from a box, or from the whole plane.

    The ellipse has the half-axes ``radius`` R and ``radius`` Rω (default 1/40).  Without a box or a
    radius, and with no elliptic orbit to be found, the orbits start all over the plane.
    """
    runner = runner or Runner()
    if orbits * (periods + 1) > MOST:
        raise BadInput(f"too many points: {orbits} orbits x {periods} periods (at most {MOST})")
    centre = None if box else elliptic_point(p, orbit)
    starts = _disk(p, centre, radius or 1 / 40, orbits) if centre else _spread(p, box, orbits)
    if not len(starts):
        raise BadInput("the radius is too large: no orbit starts between the walls")
    require_followed(p, starts[:: -(-len(starts) // PROBES)])
    states = np.full((len(starts), periods + 1, 2), np.nan)
    turned = np.zeros(len(starts), dtype=np.bool_)

    def follow(part: slice) -> None:
        found = swarm.follow(p, starts[part], periods, every=True)
        states[part], turned[part] = found.states, found.stopped

    in_pieces(runner, len(starts), follow, "portrait", periods)
    complete = not runner.interrupted
    return Portrait(parameters=p, complete=complete, states=states, turned=turned, centre=centre)


def _disk(p: Parameters, centre: State, radius: float, count: int) -> Floats:
    """Return points along a spiral that fills an ellipse evenly, but for what is past the walls."""
    k = np.arange(count)
    r, angle = radius * np.sqrt((k + 0.5) / count), GOLDEN * k
    x = centre[0] + float(p.R) * r * np.cos(angle)
    v = centre[1] + float(p.R * p.omega) * r * np.sin(angle)
    inside = (x > float(p.l)) & (x < float(p.r))
    return np.asarray(np.stack([x, v], axis=-1)[inside])


def _spread(p: Parameters, box: Box | None, count: int) -> Floats:
    side = max(1, round(math.sqrt(count)))
    if side == 1:
        side = 2
    cells = grid(p, box or whole(p), side)
    return cells.states(slice(0, cells.count))
