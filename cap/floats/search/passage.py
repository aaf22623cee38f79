"""Motions of a ball on a table from one speed to another, in doubles: which starts to try.

A motion that goes far below a curve, or above it, shows that no curve lies between: see
`cap.checker.tori.passage`.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from cap.floats.search.spanning import Ball

IMPACTS = 200  # of a motion
PHASES, SPEEDS = 60, 60  # starts
KEPT, TRIED = 200, 6
FAR = 3.0  # speeds above the curve: so many times its own, and a little more
PLACES = 9  # decimals of a start
Array = np.ndarray[Any, Any]


class Start(NamedTuple):
    """Decimals of the phase and the speed after an impact."""

    phase: str
    speed: str


def rising(a: float, low: float) -> list[Start]:
    """Return starts at speeds below ``low`` of motions that rise much, the best first."""
    return _best(a, np.linspace(low / 4, low, SPEEDS, endpoint=False), 1)


def falling(a: float, high: float) -> list[Start]:
    """Return starts at speeds above ``high`` of motions that fall much, the best first."""
    return _best(a, np.linspace(high, FAR * high + 3, SPEEDS + 1)[1:], -1)


def _best(a: float, speeds: Array, sign: int) -> list[Start]:
    t, v = (
        grid.ravel()
        for grid in np.meshgrid(np.linspace(0, 2 * math.pi, PHASES, endpoint=False), speeds)
    )
    t, v, gain = _extreme(a, t, v, sign)
    order = np.argsort(-gain)[:KEPT]
    t, v = t[order].round(PLACES), v[order].round(PLACES)
    best = np.argsort(-_gain(a, t, v, sign))[:TRIED]
    return [Start(*(f"{q:.{PLACES}f}" for q in (t[n], v[n]))) for n in best]


def _extreme(a: float, t: Array, v: Array, sign: int) -> tuple[Array, Array, Array]:
    """Return the state of each motion where its speed is least, or greatest, and how far it went.

    A motion that ends there is reversed in time: (t, v) -> (pi - t, v).
    """
    path = _path(a, t, v)
    speeds = sign * np.log([v for _, v in path])
    first, last = speeds.argmin(axis=0), speeds.argmax(axis=0)
    each = np.arange(len(t))
    phases = np.array([t for t, _ in path])[first, each]
    low, high = speeds[first, each], speeds[last, each]
    phases = np.where(first <= last, phases, math.pi - phases) % (2 * math.pi)
    return phases, np.exp(sign * low), high - low


def _gain(a: float, t: Array, v: Array, sign: int) -> Array:
    speeds = sign * np.log([w for _, w in _path(a, t, v)])
    gain: Array = speeds.max(axis=0) - speeds[0]
    return gain


def _path(a: float, t: Array, v: Array) -> list[tuple[Array, Array]]:
    ball, path = Ball(a), [(t, v)]
    with np.errstate(all="ignore"):  # a flight that is lost steers nothing but a choice
        for _ in range(IMPACTS):
            s = ball.flight(t, v)
            after = (t + s) % (2 * math.pi)
            t, v = after, s - v - a * np.cos(t) + a * np.cos(after)
            path.append((t, v))
    return path
