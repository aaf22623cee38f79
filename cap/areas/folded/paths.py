"""Compiled: the release after one from an interval of places, as a C¹ map of the place.

*Units* and folding are those of `cap.areas.folded.backward`, but forwards in time, where friction
brakes:

    s = sin t - a d + A,      p = -cos t - a d²/2 + A d + B,      d = t - ref,      s' = cos t - a,

theta = arccos a; s has its minima at the slow times 2 pi k - theta.  A mass that stops before pi -
theta sticks until then, and is released against the direction of the flight; from there to pi +
theta it turns; after that it sticks until 2 pi - theta, and goes on.  So each release is at a slow
time, folded.

*Errors.*  A and B are polynomials of X in [-1, 1] and functions u, w with (u, w) = C n, |n_1| <=
R_1, |n_2| <= R_2, in the norm of `cap.areas.folded.lines`.

*An event* at T.  Let F be p, or s, along a flight, m a number next to its derivative F' at T_0, g
>= |F(T_0)|/|m|, and |F'(T_0) - m| + K 2 g <= |m|/2, with |F'(T_0 + z) - F'(T_0)| <= K |z| for |z|
<= 1.  Then z -> z - F(T_0 + z)/m is a contraction of |z| <= 2 g: F vanishes at T_0 + z for such a
z, and only there within 2 g.  For the cosine and the sine K = k = 1.2 (|cos T_0| + |sin T_0|) will
do; so K = a + k for a hit, k for a stop.
"""

import math
from typing import NamedTuple

from cap.areas.folded.backward import PI_ERROR, ROUND, TURN, TURN_ERROR, Constants, Four, Pair
from cap.areas.folded.laws import laws
from cap.areas.folded.lines import (
    BEND,
    Line,
    across,
    bound,
    centred,
    constant,
    ends,
    exact,
    moved,
    product,
    rest,
    scaled,
    size,
    total,
    trigonometric,
    widened,
)
from cap.areas.folded.mirrored import NONE, ONE, carried, minus, quotient, times
from cap.areas.folded.polynomials import UP
from cap.areas.folded.rests import height
from cap.flow import kernels
from cap.sets.compiled import kernel

ARCS = 12  # of a flight
CLEAR = 1e-13  # more than the rounding of the times of an arc


class Path(NamedTuple):
    """A flight: bounds of its start, ref, A, B, C, R, bounds of the errors of A and B.

    ``slow`` is the number of the first slow time that may follow the start.
    """

    begun: Pair
    ref: float
    A: Line
    B: Line
    C: tuple[float, float, float, float]
    R: Pair
    errors: Pair
    slow: int


class Happening(NamedTuple):
    """The time T_0 of an event, with cosine and sine, and D = T_0 - ref.

    ``e`` bounds the error of T_0 without those of A and B, ``e_all`` with them; k e the error of
    the cosine and the sine; ``ends`` are bounds of the time.  It is ``certain`` or not.
    """

    T: Line
    cos: Line
    sin: Line
    D: Line
    k: float
    certain: bool
    e: float
    e_all: float
    ends: Pair


class Step(NamedTuple):
    """What follows a flight: nothing certain, another one, or a release at the place ``next``.

    ``until``: the earliest time of the event.
    """

    kind: int
    until: float
    path: Path
    next: Line


LOST, FLIES, RELEASED = range(3)


@kernel
def lost(f: Path) -> Step:
    """Return that nothing is certain."""
    return Step(LOST, 0.0, f, f.A)


@kernel
def slow_time(y: Constants, k: int) -> Pair:
    """Return the slow time of this number, and a bound of its error."""
    t = TURN * k - y.theta
    return t, y.theta_error + abs(k) * TURN_ERROR + abs(t) * ROUND


@kernel
def released(y: Constants, low: float, high: float) -> Path:
    """Return the flight of releases at these distances to the wall ahead, at the slow time 0."""
    t, e = slow_time(y, 0)
    more = 4 * ROUND + 8 * (e + y.a_error) + y.sine_error
    A = constant(y.sine, more)
    B = moved(scaled(across(low, high), -1.0, 0.0), y.a, more)
    errors = A[7], B[7]
    return Path((t - e, t + e), t, exact(A), exact(B), (1.0, 0.0, 0.0, 1.0), errors, errors, 1)


@kernel
def influence(f: Path, D: Line, more: float) -> float:
    """Return a bound of D u + w, for the errors u, w of A and B; D is wrong by more."""
    d, far = D[0], rest(D) + more
    p = abs(d * f.C[0] + f.C[2]) * f.R[0] + abs(d * f.C[1] + f.C[3]) * f.R[1]
    return (p + (far + abs(d) * ROUND) * f.errors[0] + f.errors[1] * ROUND) * UP


@kernel
def seen(y: Constants, f: Path, time: Pair, cos: float, sin: float) -> tuple[Line, Line]:
    """Return p and s at a time within an error of a double; cos and sin are wrong by that too."""
    t = time[0]
    d = t - f.ref
    e = time[1] + (abs(t) + abs(f.ref)) * ROUND
    error = (size(f.A) + abs(d) + 2) * (e + ROUND) + y.a_error * abs(d)
    s = moved(f.A, kernels.velocity(0.0, d, y.a, sin), error + f.errors[0])
    p = total(scaled(f.A, d, e), f.B)
    more = error * (1 + abs(d)) + influence(f, constant(d, e), 0.0)
    return moved(p, kernels.place(0.0, 0.0, d, 0.5 * y.a, cos), more), s


@kernel
def moving(y: Constants, f: Path, until: float) -> bool:
    """Return whether s > 0 from the start to a time, if it is so there."""
    for k in range(f.slow, ARCS):
        t, e = slow_time(y, k)
        if t - e > until:
            return True
        s = seen(y, f, (t, e + y.a_error + y.sine_error), y.a, -y.sine)[1]
        if not ends(s)[0] > 0:
            return False
    return False


@kernel
def since_start(y: Constants, f: Path, low: float) -> bool:
    """Return whether a hit, not before a time, is not before the start either."""
    if low > f.begun[1]:
        return True
    if not slow_time(y, 0)[0] - 6 < low:
        return False
    for k in range(ARCS):
        t, e = slow_time(y, k)
        if not (t + e < low or f.begun[1] < t - e):
            return False
    return True


@kernel
def near_event(f: Path, T: Line) -> Happening:
    """Return the event at T, of which nothing is shown."""
    cos, sin = trigonometric(T)
    D = moved(T, -f.ref, (abs(T[0]) + abs(f.ref)) * ROUND)
    k = BEND * (bound(cos) + bound(sin)) * UP
    return Happening(T, cos, sin, D, k, False, 0.0, 0.0, (0.0, 0.0))


@kernel
def certain(h: Happening, m: float, change: float, left: Pair, K: float) -> Happening:
    """Return the event, certain if it takes place close to T_0.

    ``change`` bounds F' - m, ``left`` F(T_0) without and with the errors of A and B.
    """
    e, e_all = 2 * (left[0] / abs(m) * UP) * UP, 2 * (left[1] / abs(m) * UP) * UP
    found = e_all <= 1 and (change + K * e_all) * UP <= abs(m) / 2
    bounds = ends(widened(h.T, e_all))
    found = found and bounds[1] - bounds[0] < 2.9  # 3 in the checker, with its bounds
    return Happening(h.T, h.cos, h.sin, h.D, h.k, found, e, e_all, bounds)


speed, place, start, from_rest = laws(total, product, scaled, -1.0)


@kernel
def minus_cosine(h: Happening) -> Line:
    """Return the cosine half a period later."""
    return scaled(widened(h.cos, h.k * h.e), -1.0, 0.0)


@kernel
def lag(h: Happening) -> float:
    """Return a bound of what is wrong with the time after folding."""
    return (abs(h.T[0]) + 8) * ROUND


@kernel
def balls(h: Happening) -> tuple[Pair, Pair, Pair]:
    """Return balls of functions around numbers: the cosine, T - ref, and T - pi - ref'."""
    c = h.cos[0], (rest(h.cos) + h.k * h.e_all) * UP
    D = h.D[0], (rest(h.D) + h.e_all) * UP
    return c, D, (0.0, (rest(h.T) + h.e_all + lag(h)) * UP)


@kernel
def folded(h: Happening) -> tuple[float, Line]:
    """Return ref in [-pi, pi] and d' with T - pi = ref + d', up to turns."""
    ref = h.T[0] - math.pi
    k = round(ref / TURN)
    error = h.e + lag(h) + PI_ERROR + abs(k) * TURN_ERROR
    return ref - TURN * k, widened(centred(h.T, 0.0), error)


@kernel
def followed(
    y: Constants, f: Path, h: Happening, ref: float, AB: tuple[Line, Line], J: Four
) -> Path:
    """Return the flight with models A, B after an event, the errors before carried by J."""
    A, B = AB
    C, R, errors = carried((f.C, f.R, f.errors), J, A[7], B[7])
    shift, e = h.T[0] - ref, 8 * ROUND * (abs(h.T[0]) + 8)
    begun = h.ends[0] - shift - e, h.ends[1] - shift + e
    t, more = slow_time(y, 0)
    slow = 1 if begun[0] > t + more else 0
    return Path(begun, ref, exact(A), exact(B), C, R, errors, slow)


@kernel
def hit(y: Constants, f: Path, T: Line) -> Step:
    """Return what follows a hit, if it is certain to be next."""
    h = near_event(f, T)
    s = speed(y, f.A, h.D, h.sin)
    m, K = s[0], y.a + y.a_error + h.k
    if not m > 0:
        return lost(f)
    left = bound(place(y, f, h.D, h.cos))
    change = rest(s) + f.errors[0]
    h = certain(h, m, change, (left, left + influence(f, h.D, 0.0)), K)
    if not (h.certain and since_start(y, f, h.ends[0]) and moving(y, f, h.ends[1])):
        return lost(f)
    low, high = ends(widened(s, f.errors[0] + K * h.e_all))
    resting = height(y, h.ends, high) if low > 0 else -1.0
    if resting >= 0:
        e = y.width_error + resting / 2 * UP + y.width * ROUND
        return Step(RELEASED, h.ends[0], f, constant(y.width - resting / 2, e))
    return Step(FLIES, h.ends[0], _bounced(y, f, h, m, (change + K * h.e_all) * UP), f.A)


@kernel
def _bounced(y: Constants, f: Path, h: Happening, m: float, change: float) -> Path:
    """Return the flight after a hit with a speed within ``change`` of m.

    With dT = -(d dA + dB)/s,

        dA' = dA - (2 cos T/s) (d dA + dB),      dB' = d dA + dB - d' dA'.
    """
    c, D, tau = balls(h)
    g = quotient((2 * c[0], 2 * c[1]), (m, change))
    j11, j12 = minus(ONE, times(g, D)), (-g[0], g[1])
    J = j11, j12, minus(D, times(tau, j11)), minus(ONE, times(tau, j12))
    ref, later = folded(h)
    error = (abs(h.T[0]) + abs(f.ref) + 16) * (y.a_error + 4 * ROUND)
    twice = scaled(widened(h.sin, h.k * h.e), 2.0, 0.0)
    A = moved(total(twice, f.A), -y.a * (h.T[0] - f.ref), error)
    B = moved(start(y, A, later, minus_cosine(h)), -y.width, y.width_error)
    return followed(y, f, h, ref, (A, B), J)


@kernel
def stop(y: Constants, f: Path, T: Line) -> Step:
    """Return what follows a stop, if it is certain to be next."""
    h = near_event(f, T)
    m = h.cos[0] - y.a
    if not m < 0:
        return lost(f)
    s = speed(y, f.A, h.D, h.sin)
    left = bound(s)
    h = certain(h, m, rest(h.cos) + y.a_error, (left, left + f.errors[0]), h.k)
    k = math.floor((T[0] + y.theta) / TURN)
    more = y.theta_error + abs(k + 1) * TURN_ERROR + (abs(k) + 1) * TURN * ROUND + CLEAR
    after, before = TURN * k + y.theta + more, TURN * (k + 1) - y.theta - more
    alone = after < h.ends[0] and h.ends[1] < before and f.begun[1] < before
    p = widened(place(y, f, h.D, h.cos), (left + (y.a + y.a_error + h.k) * h.e) * h.e)
    p_all = widened(p, influence(f, h.D, h.e_all))
    if not (h.certain and alone and moving(y, f, after) and ends(p_all)[1] < 0):
        return lost(f)
    return _stopped(y, f, h, p, p_all, (h.ends[0] - TURN * k - more, h.ends[1] - TURN * k + more))


@kernel
def _stopped(y: Constants, f: Path, h: Happening, p: Line, p_all: Line, phase: Pair) -> Step:
    """Return what follows a stop at a phase between these, at p; p_all is p with all errors."""
    low, high = phase
    if high < math.pi - y.theta - CLEAR:
        return Step(RELEASED, h.ends[0], f, moved(p_all, y.width, y.width_error))
    if low > math.pi + y.theta + CLEAR:
        return Step(RELEASED, h.ends[0], f, scaled(p_all, -1.0, 0.0))
    if not (math.pi - y.theta + CLEAR < low and high < math.pi + y.theta - CLEAR):
        return lost(f)
    ahead = moved(scaled(p, -1.0, 0.0), -y.width, y.width_error)
    return Step(FLIES, h.ends[0], _turned(y, f, h, ahead), f.A)


@kernel
def _turned(y: Constants, f: Path, h: Happening, ahead: Line) -> Path:
    """Return the flight after a turn, with p = ``ahead``.

    With dT = -dA/(cos T - a),

        dA' = -(cos T + a)/(cos T - a) dA,      dB' = -(d dA + dB) - d' dA'.
    """
    c, D, tau = balls(h)
    a = y.a, y.a_error
    j11 = quotient(minus(minus(NONE, c), a), minus(c, a))
    J = j11, NONE, minus(minus(NONE, D), times(tau, j11)), (-1.0, 0.0)
    ref, later = folded(h)
    A = widened(from_rest(y, later, h.sin), h.k * h.e)
    found = followed(y, f, h, ref, (A, total(ahead, start(y, A, later, minus_cosine(h)))), J)
    begun, ref, A, B, C, R, errors, _ = found
    return Path(begun, ref, A, B, C, R, errors, 1)
