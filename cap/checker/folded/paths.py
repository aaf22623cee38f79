"""What becomes of the releases from an interval of places, up to the next release, as a C^1 map.

The flow is that of ``motion``, for states that depend on one variable X in [-1, 1]: A = A_0(X) + u,
B = B_0(X) + w with polynomials A_0, B_0 and functions u, w, all errors being bounded in the norm of
``kernel.line``: so the place of the next release is enclosed with its derivative.  An interval is
followed only as long as the same happens to all its orbits.

*After a stop.*  With theta = arccos(f/F), a stop before pi - theta is a stick, with a release at pi
- theta against the direction of the flight; one from there to pi + theta a turn; one after it a
stick, with a release at 2 pi - theta in the direction of the flight.  After folding, each release
is at a slow time.
"""

from __future__ import annotations

import math

from cap.checker.folded.basins import Basins
from cap.checker.folded.events import Event, after, event
from cap.checker.folded.flights import Flight
from cap.checker.folded.motion import Direction
from cap.checker.folded.numbers import TURN, UP, Pair
from cap.checker.folded.rests import height
from cap.checker.kernel import line
from cap.checker.kernel.line import Line
from cap.checker.kernel.rejection import Rejected, need

_MOST = 64  # events


def next_release(y: Direction, basins: Basins, places: Pair) -> Line | int:
    """Return the distance to the wall ahead at the next release, from places X in [-1, 1].

    Or the fate, if all orbits are in a basin before.  After a rest near the wall nothing is known
    of the derivative: the polynomial is constant.
    """
    f = released(y, line.scaled(line.across(places), -1.0))
    for _ in range(_MOST):
        e = event(y, f)
        if known := basins.seen(y, f, e.ends[0]):
            return known
        found = rested(y, e) if e.p is None else stuck(y, e, e.p[1])
        if found is not None:
            return found
        f = after(y, f, e)
    raise Rejected("there is no release for long")


def released(y: Direction, p: Line) -> Flight:
    """Return the flight of a release at p, at the slow time -theta."""
    t, e = -y.rest[0], y.rest[1]
    more = 4 * TURN + 8 * (e + y.a_error) + y.sine[1]
    A, B = line.constant(y.sine[0], more), line.moved(p, -y.a, more)
    errors = A[1], B[1]
    exact = line.exact(A), line.exact(B)
    return Flight((t - e, t + e), t, *exact, (1.0, 0.0, 0.0, 1.0), errors, errors, 1, 0)


def rested(y: Direction, h: Event) -> Line | None:
    """Return the distance to the wall ahead at the release, if the mass rests after a hit."""
    low, high = line.ends(h.s)
    resting = height(y, h.ends, high) if low > 0 else None
    if resting is None:
        return None
    W, e = y.width
    return line.constant(W - resting / 2, e + resting / 2 * UP + W * TURN)


def stuck(y: Direction, e: Event, p: Line) -> Line | None:
    """Return the distance to the wall ahead at the release, if the mass sticks at p."""
    turn, more = y.multiple(2 * math.floor(e.ends[0] / (2 * math.pi)))
    more += 4 * TURN * (abs(turn) + 8)
    low, high = e.ends[0] - turn - more, e.ends[1] - turn + more
    first, last = y.theta[0], y.pi[0] + y.rest[0]  # where a stop is a turn
    error = y.theta[1] + y.pi[1] + y.rest[1] + 4 * TURN
    if high < first - error:
        return line.moved(p, *y.width)
    if low > last + error:
        return line.scaled(p, -1.0)
    need(first + error < low and high < last - error, "a stick or a turn")
    return None
