"""The fixed point of Φ that a picture is about: near a state, or the first elliptic one."""

import numpy as np

from cap.errors import BadInput
from cap.floats.diagnostics.grid import Box, around, whole
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search import cycles, orbits, periodic
from cap.parameters import Parameters


def elliptic_point(p: Parameters, orbit: State | None = None) -> State | None:
    """Return the fixed point near ``orbit``; without it the first elliptic one found, or None.

    That is of an orbit that never stops.
    """
    if orbit is not None:
        return fixed_point(p, orbit)
    if not p.conserves:
        return None
    for guesses in orbits.from_hit_times(p):
        for guess in guesses:
            if guess.kind == "elliptic":
                return polished(p, (guess.x, guess.v))
    return None


def fixed_point(p: Parameters, orbit: State) -> State:
    """Return the fixed point of Φ to which Newton's method leads from a state.

    If Newton's method for the state does not converge, that for the hit times is tried, which
    converges from farther away.
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
    centre = elliptic_point(p, orbit) if box is None or orbit is not None else None
    if box is not None:
        return box, centre
    if centre is None:
        return whole(p), None
    return around(p, centre, (reach[0] * float(p.R), reach[1] * float(p.R * p.omega))), centre
