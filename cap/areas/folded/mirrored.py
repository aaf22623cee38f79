"""Compiled: the flight after a hit or a turn, backwards in time; see `cap.areas.folded.backward`.

After an event at T the phase is T - pi = ref' + d', up to turns.

*A hit* keeps the speed, and p = -W: A' = 2 sin T + A + a (T - d' - ref), B' = -W - cos T - a d'²/2
- A' d'.  With dT = -(d dA + dB)/s,

    dA' = dA - (2 cos T/s) (d dA + dB),      dB' = d dA + dB - d' dA'.

*A turn* has s = 0, and p becomes -W - p: A' = sin T - a d', B' = -W - p - cos T - a d'²/2 - A' d'.
With dT = -dA/(cos T + a),

    dA' = dA (a - cos T)/(cos T + a),      dB' = -(d dA + dB) - d' dA'.
"""

import math

from cap.areas.folded.backward import (
    PI_ERROR,
    ROUND,
    TURN,
    TURN_ERROR,
    Constants,
    Event,
    Flight,
    Four,
    Pair,
    from_rest,
    start,
)
from cap.areas.folded.polynomials import (
    LAST,
    TINY,
    UP,
    Model,
    ends,
    exact,
    moved,
    scaled,
    total,
    widened,
)
from cap.sets.compiled import kernel

ONE, NONE = (1.0, 0.0), (0.0, 0.0)


@kernel
def middle(p: Model, e: float) -> Pair:
    """Return the middle of the values of a model, and how far others are."""
    low, high = ends(widened(p, e))
    return between(low, high)


@kernel
def between(low: float, high: float) -> Pair:
    """Return the middle of an interval, and its radius."""
    m = 0.5 * (low + high)
    return m, max(high - m, m - low) * UP + abs(m) * ROUND


@kernel
def times(x: Pair, y: Pair) -> Pair:
    """Return a product of numbers with bounds of their errors."""
    m = x[0] * y[0]
    return m, (abs(x[0]) * y[1] + x[1] * (abs(y[0]) + y[1]) + abs(m) * ROUND + TINY) * UP


@kernel
def minus(x: Pair, y: Pair) -> Pair:
    """Return a difference."""
    m = x[0] - y[0]
    return m, (x[1] + y[1] + (abs(x[0]) + abs(y[0])) * ROUND) * UP


@kernel
def quotient(x: Pair, y: Pair) -> Pair:
    """Return a quotient, NaN if y may vanish: (x + u)/(y + w) - x/y = (u - w x/y)/(y + w).

    The checker, with its bounds, divides only if |y| > 2 |w|.
    """
    if not abs(y[0]) > 2.1 * y[1]:
        return math.nan, math.nan
    m = x[0] / y[0]
    more = (x[1] + y[1] * abs(m) + TINY) / (abs(y[0]) - y[1])
    return m, (more + abs(m) * ROUND + TINY) * UP


@kernel
def _folded(near: float, d: Model) -> tuple[float, Model]:
    """Return ref in [-pi, pi] and d' with near + d - pi = ref + d', up to turns."""
    ref = near - math.pi
    k = math.floor(ref / TURN + 0.5)
    error = (abs(near) + 8) * ROUND + PI_ERROR + abs(k) * TURN_ERROR
    return ref - k * TURN, widened(d, error)


Errors = tuple[tuple[float, float, float, float], Pair, Pair]
"""C, R and the bounds of the errors of A and B."""


@kernel
def carried(before: Errors, J: Four, za: float, zb: float) -> Errors:
    """Return the errors after a map with derivatives in J.

    The new C has the longer column of J C in its first direction.  Its inverse is its transposed up
    to 2^-49: what that costs is in ``size``.
    """
    (j11, k11), (j12, k12), (j21, k21), (j22, k22) = J
    (c11, c12, c21, c22), (r1, r2), (ea, eb) = before
    m11, m12 = j11 * c11 + j12 * c21, j11 * c12 + j12 * c22
    m21, m22 = j21 * c11 + j22 * c21, j21 * c12 + j22 * c22
    size = (abs(j11) + abs(j12) + abs(j21) + abs(j22)) * (ea + eb + r1 + r2) * ROUND
    za, zb = za + k11 * ea + k12 * eb + size, zb + k21 * ea + k22 * eb + size
    longer = (m11 * m11 + m21 * m21) * r1 * r1 >= (m12 * m12 + m22 * m22) * r2 * r2
    u, w = (m11, m21) if longer else (m12, m22)
    length = math.sqrt(u * u + w * w)
    u, w = (u / length, w / length) if length > 1e-100 else ONE
    n1 = abs(u * m11 + w * m21) * r1 + abs(u * m12 + w * m22) * r2 + abs(u) * za + abs(w) * zb
    n2 = abs(u * m21 - w * m11) * r1 + abs(u * m22 - w * m12) * r2 + abs(u) * zb + abs(w) * za
    n1, n2 = (n1 + 2 * size) * UP, (n2 + 2 * size) * UP
    errors = (abs(u) * n1 + abs(w) * n2) * UP, (abs(w) * n1 + abs(u) * n2) * UP
    return (u, -w, w, u), (n1, n2), errors


@kernel
def _followed(f: Flight, event: Event, ref: float, AB: tuple[Model, Model], J: Four) -> Flight:
    """Return the flight with models A, B, the errors of which J carries."""
    A, B = AB
    C, R, errors = carried((f.C, f.R, f.errors), J, A[LAST], B[LAST])
    shift, e = event.near - ref, 8 * ROUND * (abs(event.near) + 8)
    begun = event.ends[0] - shift - e, event.ends[1] - shift + e
    return Flight(exact(A), exact(B), C, R, errors, ref, begun, 1)


@kernel
def after_hit(y: Constants, f: Flight, event: Event) -> Flight:
    """Return the flight after a hit; its errors are NaN if the speed may vanish."""
    D, tau = middle(event.D, event.all), middle(event.d, event.all + event.lag)
    c = middle(event.cos, event.all)
    g = quotient((2 * c[0], 2 * c[1]), between(event.least, event.most))
    j11, j12 = minus(ONE, times(g, D)), (-g[0], g[1])
    J = j11, j12, minus(D, times(tau, j11)), minus(ONE, times(tau, j12))
    ref, later = _folded(event.near, widened(event.d, event.time + event.lag))
    near = event.near
    error = (abs(near) + abs(f.ref) + 16) * (y.a_error + 4 * ROUND)
    twice = scaled(widened(event.sin, event.time), 2.0, 0.0)
    A = moved(total(twice, f.A), y.a * (near - f.ref), error)
    cos = scaled(widened(event.cos, event.time), -1.0, 0.0)
    B = moved(start(y, A, later, cos), -y.width, y.width_error)
    found = _followed(f, event, ref, (A, B), J)
    if found.begun[0] > y.theta_error + 4 * ROUND - y.theta:
        return found
    return Flight(*found[:7], 0)


@kernel
def after_turn(y: Constants, f: Flight, event: Event) -> Flight:
    """Return the flight after a turn; its errors are NaN if s' may vanish."""
    D, tau = middle(event.D, event.all), middle(event.d, event.all + event.lag)
    c, a = middle(event.cos, event.all), (y.a, y.a_error)
    j11 = quotient(minus(a, c), minus(c, (-y.a, y.a_error)))
    J = j11, NONE, minus(minus(NONE, D), times(tau, j11)), (-1.0, 0.0)
    ref, later = _folded(event.near, widened(event.d, event.time + event.lag))
    sin = widened(event.sin, event.time)
    A = from_rest(y, later, sin)
    cos = scaled(widened(event.cos, event.time), -1.0, 0.0)
    ahead = moved(scaled(event.place, -1.0, 0.0), -y.width, y.width_error)
    return _followed(f, event, ref, (A, total(ahead, start(y, A, later, cos))), J)
