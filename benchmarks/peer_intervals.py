"""One flight of many intervals: compiled intervals of doubles, and crival's arrays, in one run.

    pip install crival; python benchmarks/peer_intervals.py

Speed and gap after a flight, by the formula of `cap.boxes.flight` without viscosity, for N times
and speeds that are intervals.  crival rounds correctly: how wide its enclosures are beside ours is
told as well.  Processor time, per flight; the least of some rounds, in turns.
"""

import time

import ival
import numpy as np

from cap.sets.circular import sin_cos
from cap.sets.compiled import compiled
from cap.sets.doubles import Interval, between

ALPHA = 0.4


def _flights(t, u, out):
    for i in range(len(t)):
        at, speed = between(t[i, 0], t[i, 1]), between(u[i, 0], u[i, 1])
        sine, cosine = sin_cos(at)
        after = speed + sine - ALPHA * at
        gap = 2.0 - (at * (speed - 0.5 * (ALPHA * at)) - (cosine - Interval(1.0, 0.0)))
        out[i, 0], out[i, 1], out[i, 2], out[i, 3] = after.mid, after.rad, gap.mid, gap.rad


flights = compiled(_flights)


def ours(t, u):
    out = np.empty((len(t), 4))
    flights(t, u, out)
    return out


def theirs(t, u):
    at, speed = ival.Interval(t[:, 0], t[:, 1]), ival.Interval(u[:, 0], u[:, 1])
    after = speed + ival.sin(at) - ALPHA * at
    gap = 2.0 - (at * (speed - 0.5 * (ALPHA * at)) - (ival.cos(at) - 1.0))
    return after, gap


def compare(count, width):
    random = np.random.default_rng(0)
    t, u = random.uniform(0, 6, (count, 1)), random.uniform(0, 2, (count, 1))
    t, u = np.hstack([t, t + width]), np.hstack([u, u + width])
    best, found = [float("inf")] * 2, [ours(t, u), theirs(t, u)]
    for _ in range(5):
        for k, function in enumerate((ours, theirs)):
            began = time.process_time()
            found[k] = function(t, u)
            best[k] = min(best[k], (time.process_time() - began) / count * 1e9)
    own, (after, _) = found
    narrower = (after.hi - after.lo).mean() / (2 * own[:, 1]).mean()
    print(
        f"{count:8} flights, {width:g} wide: {best[0]:6.1f} ns, crival {best[1]:6.1f} ns, "
        f"{narrower:.4f} times as wide"
    )


if __name__ == "__main__":
    for width in (1e-12, 1e-6, 1e-2):
        for count in (10_000, 1_000_000):
            compare(count, width)
