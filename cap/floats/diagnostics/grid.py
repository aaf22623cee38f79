"""Rectangles of states at t = 0, around an orbit or between the walls."""

from dataclasses import dataclass

import numpy as np

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.engine.events import TOO_MANY
from cap.floats.findings import Floats, State
from cap.parameters import Parameters

Box = tuple[float, float, float, float]
MOST = 30_000_000  # states
PROBES = 16


@dataclass(frozen=True)
class Grid:
    """The states (x_j, v_i) of a rectangle, edges included; x (N,), v (M,), row by row."""

    x: Floats
    v: Floats

    @property
    def shape(self) -> tuple[int, int]:
        """The number of velocities and of positions."""
        return len(self.v), len(self.x)

    @property
    def count(self) -> int:
        """The number of states."""
        return len(self.x) * len(self.v)

    def sample(self) -> Floats:
        """Return `PROBES` of the states, from the first to the last."""
        places = np.linspace(0, self.count - 1, PROBES).astype(int)
        return np.concatenate([self.states(slice(k, k + 1)) for k in places.tolist()])

    def states(self, part: slice) -> Floats:
        """Return some of the states, (K, 2), in the order of an array of this shape."""
        row, column = np.divmod(np.arange(part.start, part.stop), len(self.x))
        return np.stack([self.x[column], self.v[row]], axis=-1)


def grid(p: Parameters, box: Box, points: int) -> Grid:
    """Return a grid of points x points states of a box (x min, x max, v min, v max)."""
    left, right, low, high = box
    x, v = f"x from {left:.6g} to {right:.6g}", f"v from {low:.6g} to {high:.6g}"
    if not (left < right and low < high):
        raise BadInput(f"the box is empty: {x}, {v}")
    l, r = float(p.l), float(p.r)
    if not (l <= left and right <= r):
        raise BadInput(f"the box must lie between the walls {l:.6g} and {r:.6g}: {x}")
    if points * points > MOST:
        raise BadInput(f"too many states: {points} x {points} (at most {MOST})")
    return Grid(np.linspace(left, right, points), np.linspace(low, high, points))


def require_followed(p: Parameters, states: Floats) -> None:
    """Raise `BadInput` if not one of the states (N, 2) can be followed for a period.

    An orbit is lost only after many events: if all are lost, that would take hours.
    """
    if all(swarm.follow(p, [state], 1).lost[0] for state in states):
        raise BadInput(
            "no orbit can be followed: x must lie between the walls, and the mass may not be so "
            f"fast that it has more than {TOO_MANY} events in a period"
        )


def whole(p: Parameters, speed: float | None = None) -> Box:
    """Return all positions, and velocities up to ``speed`` (default 2F/ω + Rω/2)."""
    top = speed or 2 * float(p.F / p.omega) + float(p.R * p.omega) / 2
    return float(p.l), float(p.r), -top, top


def around(p: Parameters, centre: State, reach: State) -> Box:
    """Return the box of half-widths ``reach`` around a state, as far as it is between the walls."""
    (x, v), (a, b) = centre, reach
    return max(float(p.l), x - a), min(float(p.r), x + a), v - b, v + b
