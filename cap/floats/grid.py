"""Rectangles of states at t = 0, around an orbit or between the walls."""

from dataclasses import dataclass

import numpy as np

from cap.errors import BadInput
from cap.floats import cycles, periodic, swarm
from cap.floats.events import TOO_MANY
from cap.floats.study import Floats, State
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
    if not (left < right and low < high):
        raise BadInput(f"the box is empty: x from {left:.6g} to {right:.6g}, v {low:.6g} to {high}")
    l, r = float(p.l), float(p.r)
    if not (l <= left and right <= r):
        raise BadInput(f"the box must lie between the walls {l:.6g} and {r:.6g}: x = {left:.6g} ..")
    if points * points > MOST:
        raise BadInput(f"too many states: {points} x {points} (at most {MOST})")
    return Grid(np.linspace(left, right, points), np.linspace(low, high, points))


def require_followed(p: Parameters, states: Floats) -> None:
    """Raise `BadInput` if not one of the states (N, 2) can be followed for a period.

    Without this a picture of nothing would take hours: an orbit is lost after many events.
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


def island(p: Parameters, orbit: State | None = None) -> State | None:
    """Return the fixed point near ``orbit``, or without it the first elliptic one, or None."""
    if orbit is not None:
        return fixed_point(p, orbit)
    if not p.conserves:
        return None
    for hits in range(2, periodic.MOST_HITS + 1, 2):
        for guess in periodic.orbits(p, hits):
            if guess.kind == "elliptic":
                return polished(p, (guess.x, guess.v))
    return None


def fixed_point(p: Parameters, orbit: State) -> State:
    """Return the fixed point of Φ to which Newton's method leads from a state.

    If it leads to none for the state, that for the hit times, which is not as easily thrown off.
    """
    try:
        found: cycles.Cycle | periodic.Guess = cycles.near(p, *orbit)
    except BadInput:
        if not p.conserves:
            raise
        found = periodic.near(p, *orbit)
    return polished(p, (found.x, found.v))


def polished(p: Parameters, state: State, periods: int = 1) -> State:
    """Return a fixed point of Φⁿ after two more steps of Newton's method, unless it diverges."""
    z, unit = np.array(state), np.eye(2)
    for _ in range(2):
        path = swarm.follow(p, [z], periods, derivative=True)
        if path.monodromy is None or not np.isfinite(path.monodromy).all():
            return state
        defect = path.states[0] - z
        z = z + np.linalg.lstsq(unit - path.monodromy[0], defect, rcond=None)[0]
    close = np.abs(z - state).max() < 1e-6 * max(float(p.R), float(p.R * p.omega))
    return (float(z[0]), float(z[1])) if close else state


def region(
    p: Parameters, orbit: State | None, box: Box | None, reach: State
) -> tuple[Box, State | None]:
    """Return the box asked for and the fixed point that it is about.

    Without a box it is that of half-widths ``reach``, in units of R and Rω, around the fixed point;
    if there is none, the whole plane.
    """
    centre = island(p, orbit) if box is None or orbit is not None else None
    if box is not None:
        return box, centre
    if centre is None:
        return whole(p), None
    return around(p, centre, (reach[0] * float(p.R), reach[1] * float(p.R * p.omega))), centre
