"""Compiled: orbits through their flights and events, in doubles.  Units as in `.flight`.

Let p = exp(mτ) u; p' = exp(mτ)(s cos θ - α) is positive from the known times `slow` to the known
times `fast` of the sign s, and negative from there to the next.  So u has no zero while p rises,
and at most one from a fast to the next slow time; while u > 0 the distance flown is monotone.
Every root below is the only one in its bracket: there is no step size, and no event can be missed.
"""

import math
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from cap.floats.engine import flight
from cap.floats.engine.compiled import announced
from cap.floats.engine.flight import (
    FULL_TURN,
    NONE,
    Constants,
    Four,
    Motion,
    chatter,
    decay,
    event,
    flown,
    knots,
    moved,
    pushes,
    step_to,
)

Floats = NDArray[np.float64]

HIT, TURN, STICK, CAPTURE, RELEASE = 0, 2, 4, 5, 7  # to the right; one more is to the left

GRAZING = 1e-12  # speed, length or force in these units: rounding may have decided
TOO_MANY = 100_000  # steps in a period
ONE = (1.0, 0.0, 0.0, 1.0)


class Log(NamedTuple):
    """What is kept of the orbits, to be written to; the first axis is the orbit, but in ``table``.

    ``counts`` and ``first`` (time since the start) for each of `cap.flow.words.WORDS`; ``flags``
    (grazing, lost); ``table`` the events (period, time, word, wall, depth, v before, v after) of a
    single orbit, as many as there are rows.
    """

    counts: NDArray[np.int64]
    first: Floats
    flags: NDArray[np.bool_]
    table: Floats


@njit(error_model="numpy", forceinline=True)
def _hit(y: Constants, n: Motion, close: bool) -> Motion:
    """Return the motion after the hit of the wall ahead, at which n is."""
    word = HIT if n.sign > 0 else HIT + 1
    grazing = n.grazing or close or n.speed <= GRAZING
    return Motion(n.time, -n.sign, y.e * n.speed, n.sign, 0.0, n.sin, n.cos, word, grazing)


@njit(error_model="numpy", forceinline=True)
def _stop(y: Constants, n: Motion, close: bool) -> Motion:
    """Return the motion after v has vanished between the walls: it turns or sticks."""
    sign, word = 0.0, STICK
    if pushes(y, -n.sign, n.time):
        sign, word = -n.sign, TURN if n.sign < 0 else TURN + 1
    grazing = n.grazing or close or abs(abs(n.cos) - y.alpha) <= GRAZING
    return Motion(n.time, sign, 0.0, n.wall, n.depth, n.sin, n.cos, word, grazing)


@njit(error_model="numpy", forceinline=True)
def _release(y: Constants, n: Motion, end: float) -> Motion:
    """Return the motion, just begun, of a mass that was at rest; or at rest at the end."""
    sign, time = 0.0, math.inf
    for side in (1.0, -1.0):
        if n.depth > 0 or side != n.wall:
            begin = n.time if pushes(y, side, n.time) else knots(y, side, n.time)[0]
            if begin < time:
                sign, time = side, begin
    if time >= end:
        return Motion(end, 0.0, 0.0, n.wall, n.depth, n.sin, n.cos, NONE, n.grazing)
    theta, word = y.phase + time, RELEASE if sign > 0 else RELEASE + 1
    sin, cos = math.sin(theta), math.cos(theta)
    return Motion(time, sign, 0.0, n.wall, n.depth, sin, cos, word, n.grazing)


@njit(error_model="numpy", forceinline=True)
def _leave(y: Constants, n: Motion, end: float) -> Motion:
    """Return the motion after the capture of a mass that leaves a wall, or n if it is not yet."""
    time = chatter(y, n.speed, n.wall * n.cos)
    if n.time + time > end and time > 1e-15:  # it bounces until the end
        return n
    word = CAPTURE if n.wall > 0 else CAPTURE + 1
    last = min(n.time + time, end)
    return Motion(last, 0.0, 0.0, n.wall, 0.0, n.sin, n.cos, word, n.grazing)


@njit(error_model="numpy", forceinline=True)
def _leg(y: Constants, n: Motion, end: Motion) -> Motion:
    """Fly to the next event, slow time or the end, whichever is first."""
    gap = n.depth if n.sign == n.wall else y.width - n.depth
    if gap <= 0:
        return _hit(y, n, False)
    slow, fast = knots(y, n.sign, n.time)
    rising, final = fast < slow, end.time <= slow
    # at the slow time s cos θ = α and s sin θ < 0, at the fast time s sin θ > 0
    sin, cos = n.sign * math.sqrt(1 - y.alpha * y.alpha), n.sign * y.alpha
    low, high = 0.0, (end.time if final else slow) - n.time
    begin, last = (n.speed, 0.0, n.sin, n.cos), (end.sin, end.cos) if final else (-sin, cos)
    after = flown(y, n, high, *last)
    close = not final and abs(after[0]) <= GRAZING
    if after[0] > 0 or (rising and end.time <= fast):  # no zero of u until then
        if after[1] < gap:
            m, time = moved(y, n, high, after), end.time if final else slow
            grazing = n.grazing or close
            return Motion(time, n.sign, m.speed, m.wall, m.depth, *last, NONE, grazing)
        close = False
    else:
        if rising:
            middle = flown(y, n, fast - n.time, sin, cos)
            if middle[1] < gap:
                low, begin = fast - n.time, middle
            else:
                high, after = fast - n.time, middle
        if not rising or low > 0:
            guess = low + step_to(y, n, -1.0, begin)
            stop = event(y, n, -1.0, guess, low, high)
            touches = abs(stop[2] - gap) <= GRAZING
            if stop[2] < gap:
                return _stop(y, moved(y, n, stop[0], stop[1:]), close or touches)
            high, after, close = stop[0], stop[1:], touches
    guess = low + step_to(y, n, gap, begin)
    if not guess <= high:
        guess = high + step_to(y, n, gap, after)
    hit = event(y, n, gap, guess, low, high)
    return _hit(y, moved(y, n, hit[0], hit[1:]), close)


@njit(error_model="numpy", forceinline=True)
def _step(y: Constants, n: Motion, end: Motion) -> Motion:
    """Return the motion after the next event, or slow time, or at the end."""
    if n.sign == 0:
        return _release(y, n, end.time)
    if n.depth == 0 and n.sign != n.wall and (n.speed > 0 or not pushes(y, n.sign, n.time)):
        captured = _leave(y, n, end.time)
        if captured.sign == 0:
            return captured
    return _leg(y, n, end)


@njit(error_model="numpy", forceinline=True)
def _tangent(y: Constants, n: Motion, m: Motion, t: Four) -> Four:
    """Return the derivative, rows (a, b), (c, d), after the step from n to m; t is that before."""
    a, b, c, d = t
    if n.sign != 0 and m.word < CAPTURE:
        D, h, _ = decay(y.m, m.time - n.time)
        a, b, c, d = a + h * c, b + h * d, D * c, D * d
    if m.word == HIT or m.word == HIT + 1:
        kick = ((1 + y.e) * m.wall * m.cos + (1 - y.e) * y.alpha) / (m.speed / y.e)
        return -y.e * a, -y.e * b, kick * a - y.e * c, kick * b - y.e * d
    if m.word == TURN or m.word == TURN + 1:
        factor = max(0.0, abs(m.cos) - y.alpha) / (abs(m.cos) + y.alpha)
        return a, b, factor * c, factor * d
    if m.word == CAPTURE or m.word == CAPTURE + 1:
        return 0.0, 0.0, 0.0, 0.0
    if n.sign == 0 and m.time > n.time:  # it was held: at a wall by the forcing, or by friction
        if n.depth == 0 and pushes(y, n.wall, n.time):
            return 0.0, 0.0, 0.0, 0.0
        return a, b, 0.0, 0.0
    return (a, b, 0.0, 0.0) if m.word == STICK else (a, b, c, d)


@njit(error_model="numpy")
def _begin(y: Constants, v: float, wall: float, depth: float) -> Motion:
    """Return the motion from such a row; nan if that is no state."""
    sin, cos = math.sin(y.phase), math.cos(y.phase)
    sign = 1.0 if v > 0 else (-1.0 if v < 0 else 0.0)
    grazing = v == 0 and abs(abs(cos) - y.alpha) <= GRAZING
    zero = 0.0 if math.isfinite(v) and 0 <= depth <= y.width else math.nan
    return Motion(zero, sign, abs(v) + zero, wall, depth + zero, sin, cos, NONE, grazing)


@njit(error_model="numpy")
def _end(y: Constants, time: float) -> Motion:
    """Return a motion with the time and phase at the end of a period, or of a part of one."""
    theta = y.phase + (time if time < FULL_TURN else 0.0)
    return Motion(time, 0.0, 0.0, 1.0, 0.0, math.sin(theta), math.cos(theta), NONE, False)


@njit(error_model="numpy")
def _tabulate(y: Constants, table: Floats, row: int, period: int, n: Motion, m: Motion) -> None:
    """Write down the event between n and m, if there is room."""
    if row < len(table):
        hit, captured = m.word < TURN, m.word == CAPTURE or m.word == CAPTURE + 1
        before = m.wall * m.speed / y.e if hit else n.sign * n.speed if captured else 0.0
        after = m.sign * m.speed + 0.0  # not -0.0
        facts = float(period), m.time, float(m.word), m.wall, m.depth, before, after
        for j, fact in enumerate(facts):
            table[row, j] = fact


@njit(error_model="numpy")
def _write(rows: Floats, tangents: Floats, place: tuple[int, int], n: Motion, t: Four) -> None:
    """Write the state n, and the derivative t if it is wanted."""
    i, k = place
    each = rows.shape[1] > 1
    last = k if each else 0
    rows[i, last, 0], rows[i, last, 1], rows[i, last, 2] = n.sign * n.speed + 0.0, n.wall, n.depth
    if tangents.shape[1] > 0 and k > 0:
        for j, entry in enumerate(t):
            tangents[i, k - 1 if each else 0, j] = entry + n.time  # 0, or nan if lost


@njit(error_model="numpy")
def _orbit(y: Constants, i: int, ends: Floats, rows: Floats, tangents: Floats, log: Log) -> None:
    counts, first, flags, table = log
    n, t, seen = _begin(y, rows[i, 0, 0], rows[i, 0, 1], rows[i, 0, 2]), ONE, 0
    _write(rows, tangents, (i, 0), n, t)
    begin = n
    for period, stop in enumerate(ends):
        end, steps = _end(y, stop), 0
        while n.time < stop and steps < TOO_MANY:
            m = _step(y, n, end)
            if tangents.shape[1] > 0:
                t = _tangent(y, n, m, t)
            if m.word != NONE:
                _tabulate(y, table, seen, period, n, m)
                if counts[i, m.word] == 0:
                    first[i, m.word] = FULL_TURN * period + m.time
                counts[i, m.word] += 1
                seen += 1
            n, steps = m, steps + 1
        zero = n.time - stop if n.time >= stop else math.nan
        speed, depth, sin, cos = n.speed + zero, n.depth + zero, begin.sin, begin.cos
        n = Motion(zero, n.sign, speed, n.wall, depth, sin, cos, NONE, n.grazing)
        _write(rows, tangents, (i, period + 1), n, t)
        t = ONE if rows.shape[1] > 1 else t
    flags[i, 0], flags[i, 1] = n.grazing, math.isnan(n.time)


def _compiled(sources: str) -> Callable[[Constants, Floats, Floats, Floats, Log], None]:
    """Return the function that follows orbits; ``sources``, a digest, is part of its cache key.

    Without it, numba would not notice a change in the functions that are compiled into this one.
    """

    def follow(y: Constants, ends: Floats, rows: Floats, tangents: Floats, log: Log) -> None:
        """Follow orbits.  ``rows`` (N, K, 3) holds v, wall and depth, first only the starts.

        ``ends`` are the ends in [0, 2π] of the periods.  With K = 1 the last states are written
        over the starts, else all after them.  ``tangents`` is for the derivatives in the order of
        their rows: (N, 1, 4) over all periods; of each, (N, K - 1, 4), if K > 1; none: (N, 0, 4).
        All is nan from where an orbit is lost.
        """
        _ = sources
        for i in range(len(rows)):
            _orbit(y, i, ends, rows, tangents, log)

    return announced(follow)


def _digest() -> str:
    files = Path(__file__), Path(flight.__file__)
    return sha256(b"".join(file.read_bytes() for file in files)).hexdigest()


follow = _compiled(_digest())
