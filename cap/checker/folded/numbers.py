"""Numbers known up to an error: pairs (m, r) stand for all t with |t - m| <= r.

Doubles are rounded to nearest, so a sum, a product or a quotient is wrong by at most 2^-53 of
itself, and 2^-1075 where a product or a quotient underflows; ``TURN`` = 2^-49, ``UP`` = 1 + 2^-40
and ``TINY`` make up for all that is rounded in a formula here.
"""

from __future__ import annotations

from collections.abc import Callable

from cap.checker.kernel.rejection import need

Pair = tuple[float, float]

UP, TURN, TINY = 1 + 2.0**-40, 2.0**-49, 2.0**-900
_STEPS = 40  # of a search that steers


def times(x: Pair, y: Pair) -> Pair:
    """Return a product."""
    m = x[0] * y[0]
    return m, (abs(x[0]) * y[1] + x[1] * (abs(y[0]) + y[1]) + abs(m) * TURN + TINY) * UP


def minus(x: Pair, y: Pair) -> Pair:
    """Return a difference."""
    m = x[0] - y[0]
    return m, (x[1] + y[1] + (abs(x[0]) + abs(y[0])) * TURN) * UP


def quotient(x: Pair, y: Pair) -> Pair:
    """Return a quotient: (x + u)/(y + w) - x/y = (u - w x/y)/(y + w)."""
    need(abs(y[0]) > 2 * y[1], "a quotient by a number that may vanish")
    m = x[0] / y[0]
    more = (x[1] + y[1] * abs(m) + TINY) / (abs(y[0]) - y[1])
    return m, (more + abs(m) * TURN + TINY) * UP


def zero(f: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function that falls from positive to negative vanishes, nearly: it steers."""
    x, y, t = f(low), f(high), low
    for k in range(_STEPS):
        bisect = k % 3 == 2 or not x > 0 > y
        t = (low + high) / 2 if bisect else low + (high - low) * x / (x - y)
        value = f(t)
        if abs(value) < 1e-12:
            return t
        if value > 0:
            low, x = t, value
        else:
            high, y = t, value
    return t


def shifted(ends: Pair, near: float, ref: float) -> Pair:
    """Return bounds of the times that begin a flight, from those that ended the last one."""
    shift, e = near - ref, 8 * TURN * (abs(near) + 8)
    return ends[0] - shift - e, ends[1] - shift + e
