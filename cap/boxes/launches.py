"""Compiled: one flight from wall to wall, of launches (t, u) from a wall.

A flight of sign 1 leaves the left wall at the time t with the speed u.  If it reaches the right one
without a stop, at t1, it leaves that with a speed u1: in the mirror image, a launch at (t1 + π, u1)
again.  For e = 1 and μ = 0 this map preserves u dt du, and its inverse is that for friction -f,
with t replaced by -t.
"""

from collections.abc import Callable
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from cap.boxes.flight import Matrix, Moment, force, launch, moment
from cap.boxes.motion import FLY, Motion, exact, rebase, set_matrix
from cap.boxes.period import World
from cap.boxes.scout import HIT, STOP, scout
from cap.boxes.transverse import hit, stop
from cap.boxes.windows import windows
from cap.sets.compiled import compiled, kernel, rounds_to_nearest
from cap.sets.doubles import Interval, between, is_positive, lower, upper

Floats = NDArray[np.float64]

HITS, STOPS, EITHER = 0, 1, 2


class Flights(NamedTuple):
    """What is written of N flights: verdicts, images (N, 4) and derivatives (N, 8)."""

    verdict: NDArray[np.int8]
    images: Floats
    derivative: Floats


Fly = Callable[[World, Floats, Motion, Floats, Flights], bool]


@kernel
def _begin(world: World, n: Motion, t: Interval, u: Interval) -> None:
    """Begin the flights: the derivative by t, at a fixed time after it, drifts from (-u, -u')."""
    y, zero = world.system, exact(0.0)
    n.kind, n.ended, n.certain, n.rising, n.bounced = FLY, 0, 1, 0, 0
    n.words, n.maybe, n.itinerary = 0, 0, 0
    at = moment(1.0, t)
    launch(n.flight, 1.0, at, u, y.width)
    launch(n.centre, 1.0, moment(1.0, exact(t.mid)), exact(u.mid), y.width)
    rebase(n, t.rad, u.rad)
    set_matrix(n, -u, zero, -force(y, at.cos, u), exact(1.0))


@kernel
def _flown(world: World, n: Motion) -> int:
    """Follow the flights to their first event, before the end."""
    y, near, centre = world.system, n.near, n.centre
    end = Moment(world.end.t, world.end.sin, world.end.cos)
    if not is_positive(n.flight.speed):
        return EITHER
    at = Moment(centre.t.mid, centre.sin.mid, centre.cos.mid)
    launch(near, 1.0, at, centre.speed.mid, centre.gap.mid)
    event, time = scout(world.near, near, Moment(end.t.mid, end.sin.mid, end.cos.mid))
    if event == HIT and hit(y, n, time, end):
        return HITS
    if event == STOP and stop(y, n, time, end):
        return STOPS
    w = windows(y, n, end)
    return STOPS if w.hit > w.top and w.done < lower(w.horizon.t) else EITHER


@kernel
def _derivative(world: World, n: Motion) -> Matrix:
    """Return the derivative of (t1, u1), after a hit: ∂t1 = -∂(s x)/u1, ∂u1 = ∂u + u1' ∂t1."""
    u, f = n.flight.speed, n.flight
    a, b = -n.a / u, -n.b / u
    push = force(world.system, f.cos, u)
    return Matrix(a, b, n.c + push * a, n.d + push * b)


@kernel
def _write(world: World, n: Motion, i: int, out: Flights) -> None:
    """Write the images of flights that hit, and the derivative."""
    image, entries, f, m = out.images[i], out.derivative[i], n.flight, _derivative(world, n)
    image[0], image[1], image[2], image[3] = lower(f.t), upper(f.t), lower(f.speed), upper(f.speed)
    for j, entry in enumerate((m.a, m.b, m.c, m.d)):
        entries[2 * j], entries[2 * j + 1] = lower(entry), upper(entry)


def _compiled() -> Fly:
    @compiled
    def fly(world, cells, n, probe, out):  # type: ignore[no-untyped-def]
        """Follow flights; see `FLY_OVER`."""
        if not rounds_to_nearest(probe):
            return False
        for i in range(len(cells)):
            cell = cells[i]
            _begin(world, n, between(cell[0], cell[1]), between(cell[2], cell[3]))
            out.verdict[i] = _flown(world, n)
            if out.verdict[i] == HITS:
                _write(world, n, i, out)
        return True

    return cast(Fly, fly)


FLY_OVER = _compiled()
"""Follow the flights of ``cells`` (N, 4), rows (t low, t high, u low, u high), to the next wall.

(world, cells, a motion, probe, out) -> whether the processor rounds as it should.
"""
