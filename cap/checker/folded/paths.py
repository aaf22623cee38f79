"""What becomes of the releases from an interval of places, up to the next release, as a C^1 map.

The flights are those of ``flights``; the speed and the distance to the wall at each are functions
of one variable X, over [-1, 1]: A = A_0(X) + u, B = B_0(X) + w with polynomials A_0, B_0 and
functions u, w, all errors being bounded in the norm of ``kernel.line``: so the place of the next
release is enclosed with its derivative.  An interval is followed only as long as the same happens
to all its orbits.

*A hit or a stop at T.*  Let F(t) be p, or s, at the time t, and F' its derivative in t: s, or cos t
- a; both are functions of X.  Let T_0 be a polynomial, m the number F'(T_0) at X = 0, and

    g >= |F(T_0)|/|m|,    |1 - F'(T_0)/m| + K 2 g/|m| <= 1/2,

with |F'(T_0 + z) - F'(T_0)| <= K |z| for |z| <= 1.  Then z -> z - F(T_0 + z)/m maps the functions
with |z| <= 2 g to themselves, and is a contraction there (the norm of its derivative is at most 1/2
there): so F vanishes at T_0 + z for a function z with |z| <= 2 g, and F' has no zero within 2 g of
T_0.  By ``kernel.line``, sin(T_0 + z) and cos(T_0 + z) differ from those of T_0 by at most k |z|,
k = 1.2 (|cos T_0| + |sin T_0|); so K = a + k for a hit, K = k for a stop.

*A hit* at T is the next event if s > 0 up to then.  It is so at T, for F' does not change its sign,
and is shown at the slow times before.  T is not before the start: p < 0 and s >= 0 there, p = 0 and
s > 0 at T, so s would be negative at a minimum between, at a slow time.  *A stop* in an arc where
cos t < a is the only one there, as s decreases; it is the next event if s > 0 up to the begin of
the arc, and p < 0 at the stop.

*The derivative of a hit.*  dT = -(d dA + dB)/s.  After it the phase is T - pi, the speed s, p = -W,
so A' = 2 sin T + A - a (ref' + pi - ref), B' = -W - cos T + a d'^2/2 - A' d' with d' = T - pi -
ref':

    dA' = dA - (2 cos T/s) (d dA + dB),      dB' = d dA + dB - d' dA'.

*After a stop.*  A stop before pi - theta is a stick, with a release at pi - theta against the
direction of the flight; one from there to pi + theta a turn; one after it a stick, with a release
at 2 pi - theta in the direction of the flight.  After folding, each release is at a slow time.

*The derivative of a turn.*  dT = -dA/(cos T - a), and p changes by d dA + dB, as s = 0.  After a
turn, A' = sin T + a d', B' = -W - p - cos T + a d'^2/2 - A' d' with d' = T - pi - ref':

    dA' = -(cos T + a)/(cos T - a) dA,      dB' = -(d dA + dB) - d' dA'.

They are enclosed by balls of functions around numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from cap.checker.folded.basins import Basins, Bounds
from cap.checker.folded.flights import ARCS, Four, Path, System, carried
from cap.checker.folded.guesses import hit_guess, stop_guess
from cap.checker.folded.numbers import TURN, UP, Pair, minus, quotient, shifted, times
from cap.checker.folded.rests import height
from cap.checker.folded.scout import Middle, scout
from cap.checker.kernel import line
from cap.checker.kernel.line import Coefficients, Line
from cap.checker.kernel.rejection import Rejected, need

_MOST, _STROBES = 64, 8  # events, and multiples of pi of a flight
_NONE, _ONE = (0.0, 0.0), (1.0, 0.0)


class Happening(NamedTuple):
    """The time T_0 of an event, with cosine and sine, and D = T_0 - ref.

    ``e`` bounds the error of T_0 without those of A and B, ``e_all`` with them; k e the error of
    the cosine and the sine; ``ends`` are bounds of the time.
    """

    T: Coefficients
    cos: Line
    sin: Line
    D: Line
    k: float
    e: float = 0.0
    e_all: float = 0.0
    ends: Pair = _NONE


def next_release(y: System, basins: Basins, places: Pair) -> Line | int:
    """Return the distance to the wall ahead at the next release, from places X in [-1, 1].

    Or the fate, if all orbits are in a basin before.  After a rest near the wall nothing is known
    of the derivative: the polynomial is constant.
    """
    f = released(y, line.scaled(line.across(places), -1.0))
    for _ in range(_MOST):
        kind, near, k = upcoming(y, f)
        until, found = hit(y, f, near) if kind == "hit" else stop(y, f, near, k)
        for k, strobe in strobes(y, f, basins, until):
            if known := basins.fate(k, strobe):
                return known
        if not isinstance(found, Path):
            return found
        f = found
    raise Rejected("there is no release for long")


def upcoming(y: System, f: Path) -> tuple[str, float, int]:
    """Return what comes next in the middle of the interval, when, and in which arc: it steers."""
    slows = ((k, y.slows[k][0]) for k in range(f.slow, ARCS))
    middle = Middle(y.a, f.A[0], f.B[0], f.ref)
    return scout(middle, (f.begun[0] + f.begun[1]) / 2, slows, 2 * math.pi - 2 * y.theta[0])


def released(y: System, p: Line) -> Path:
    """Return the flight of a release at p, at the slow time 0."""
    t, e = y.slows[0]
    more = 4 * TURN + 8 * (e + y.a_error) + y.sine[1]
    A, B = line.constant(y.sine[0], more), line.moved(p, y.a, more)
    errors = A[1], B[1]
    return Path((t - e, t + e), t, A[0], B[0], (1.0, 0.0, 0.0, 1.0), errors, errors, 1)


def event(f: Path, T: Coefficients) -> Happening:
    """Return the event at T, of which nothing is shown."""
    cos, sin = line.trigonometric(T)
    lag = (abs(T[0]) + abs(f.ref)) * TURN
    D = line.moved((T, 0.0), -f.ref, lag)
    return Happening(T, cos, sin, D, line.BEND * (line.bound(cos) + line.bound(sin)) * UP)


def certain(h: Happening, m: float, change: float, left: Pair, K: float) -> Happening:
    """Prove that the event takes place close to T_0.

    ``change`` bounds F' - m, ``left`` F(T_0) without and with the errors of A and B.
    """
    g, g_all = left[0] / abs(m) * UP, left[1] / abs(m) * UP
    need(2 * g_all <= 1, "the time of an event is not certain")
    need((change + K * 2 * g_all) * UP <= abs(m) / 2, "the time of an event is not certain")
    low, high = line.ends((h.T, 2 * g_all * UP))
    # the next flight begins within 1.5 of [-pi, pi]: after the slow time of number -1
    need(high - low < 3, "the time of an event is not certain")
    return h._replace(e=2 * g * UP, e_all=2 * g_all * UP, ends=(low, high))


def influence(f: Path, D: Line, more: float = 0.0) -> float:
    """Return a bound of D u + w, for the errors u, w of A and B; D is wrong by more."""
    (c11, c12, c21, c22), (r1, r2) = f.C, f.R
    d, far = D[0][0], line.rest(D) + more
    p = abs(d * c11 + c21) * r1 + abs(d * c12 + c22) * r2
    return (p + (far + abs(d) * TURN) * f.errors[0] + f.errors[1] * TURN) * UP


def speed(y: System, f: Path, h: Happening) -> Line:
    """Return s at T_0, without errors."""
    return line.total(line.total(h.sin, line.scaled(h.D, -y.a, y.a_error)), (f.A, 0.0))


def place(y: System, f: Path, h: Happening) -> Line:
    """Return p at T_0, without errors."""
    drag = line.scaled(h.D, -y.a / 2, y.a_error)
    ahead = line.product(h.D, line.total(drag, (f.A, 0.0)))
    return line.total(line.scaled(h.cos, -1.0), line.total(ahead, (f.B, 0.0)))


def hit(y: System, f: Path, near: float) -> tuple[float, Path | Line]:
    """Prove that the next event is a hit; return the earliest time, and what follows.

    That is a flight, or after a capture the distance to the wall ahead at the release.
    """
    h = event(f, hit_guess(y, f, near))
    s = speed(y, f, h)
    m, K = s[0][0], y.a + y.a_error + h.k
    need(m > 0, "the mass may stop, or hit")
    left = line.bound(place(y, f, h))
    change = line.rest(s) + f.errors[0]
    h = certain(h, m, change, (left, left + influence(f, h.D)), K)
    since_start(y, f, h.ends[0])
    moving(y, f, h.ends[1])
    low, high = line.ends(line.widened(s, f.errors[0] + K * h.e_all))
    resting = height(y, h.ends, high) if low > 0 else None
    if resting is not None:
        W, e = y.width
        return h.ends[0], line.constant(W - resting / 2, e + resting / 2 * UP + W * TURN)
    c, D, tau = balls(h)
    g = quotient((2 * c[0], 2 * c[1]), (m, (change + K * h.e_all) * UP))
    j11, j12 = minus(_ONE, times(g, D)), (-g[0], g[1])
    J = j11, j12, minus(D, times(tau, j11)), minus(_ONE, times(tau, j12))
    ref, later = folded(y, h)
    error = (abs(h.T[0]) + abs(f.ref) + 16) * (y.a_error + 4 * TURN)
    twice = line.scaled(line.widened(h.sin, h.k * h.e), 2.0)
    A = line.moved(line.total(twice, (f.A, 0.0)), -y.a * (h.T[0] - f.ref), error)
    B = line.moved(start(y, A, later, h), -y.width[0], y.width[1])
    return h.ends[0], followed(y, f, h, ref, (A, B), J)


def stop(y: System, f: Path, near: float, k: int) -> tuple[float, Path | Line]:
    """Prove that the next event is a stop in this arc; return the earliest time, what follows.

    That is a flight, or after a stick the distance to the wall ahead at the release.
    """
    h = event(f, stop_guess(y, f, near))
    m = h.cos[0][0] - y.a
    need(m < 0, "a stop is not transversal")
    s = speed(y, f, h)
    left = line.bound(s)
    change = line.rest(h.cos) + y.a_error
    h = certain(h, m, change, (left, left + f.errors[0]), h.k)
    turn, more = y.turns[k - 1]
    after = turn + y.theta[0] + more + y.theta[1] + 1e-13
    before = y.slows[k][0] - y.slows[k][1]
    need(after < h.ends[0] and h.ends[1] < before, "a stop may be in another arc")
    need(f.begun[1] < before, "a flight may begin after the arc of a stop")
    moving(y, f, after)
    p = line.widened(place(y, f, h), (left + (y.a + y.a_error + h.k) * h.e) * h.e)
    p_all = line.widened(p, influence(f, h.D, h.e_all))
    need(line.ends(p_all)[1] < 0, "the mass may stop, or hit")
    more += 4 * TURN * (abs(turn) + 8)
    low, high = h.ends[0] - turn - more, h.ends[1] - turn + more
    (first, e), (last, r) = y.first, y.last
    if high < first - e:
        return h.ends[0], line.moved(p_all, *y.width)
    if low > last + r:
        return h.ends[0], line.scaled(p_all, -1.0)
    need(first + e < low and high < last - r, "a stick or a turn")
    ahead = line.moved(line.scaled(p, -1.0), -y.width[0], y.width[1])
    return h.ends[0], turned(y, f, h, ahead)


def turned(y: System, f: Path, h: Happening, ahead: Line) -> Path:
    """Return the flight after a turn, with p = ``ahead``."""
    c, D, tau = balls(h)
    a = y.a, y.a_error
    j11 = quotient(minus(minus(_NONE, c), a), minus(c, a))
    J = j11, _NONE, minus(minus(_NONE, D), times(tau, j11)), (-1.0, 0.0)
    ref, later = folded(y, h)
    A = line.widened(line.total(h.sin, line.scaled(later, y.a, y.a_error)), h.k * h.e)
    B = line.total(ahead, start(y, A, later, h))
    return followed(y, f, h, ref, (A, B), J)._replace(slow=1)


def balls(h: Happening) -> tuple[Pair, Pair, Pair]:
    """Return balls of functions around numbers: the cosine, T - ref, and T - pi - ref'."""
    c = h.cos[0][0], (line.rest(h.cos) + h.k * h.e_all) * UP
    D = h.D[0][0], (line.rest(h.D) + h.e_all) * UP
    return c, D, (0.0, (line.rest((h.T, 0.0)) + h.e_all + _lag(h)) * UP)


def _lag(h: Happening) -> float:
    """Return a bound of what is wrong with the time after folding."""
    return (abs(h.T[0]) + 8) * TURN


def folded(y: System, h: Happening) -> tuple[float, Line]:
    """Return ref in [-pi, pi] and d' with T - pi = ref + d', modulo 2 pi."""
    ref = h.T[0] - y.pi[0]
    k = round(ref / (2 * math.pi))
    need(k in y.turns, "a flight is too long")
    ref -= y.turns[k][0]
    error = h.e + _lag(h) + y.pi[1] + y.turns[k][1]
    return ref, ((0.0, *h.T[1:]), error * UP)


def start(y: System, A: Line, d: Line, h: Happening) -> Line:
    """Return -cos T + a d^2/2 - A d: B after the event, but for p."""
    half = line.scaled(d, y.a / 2, y.a_error)
    back = line.product(d, line.total(half, line.scaled(A, -1.0)))
    return line.total(line.scaled(line.widened(h.cos, h.k * h.e), -1.0), back)


def followed(
    y: System, f: Path, h: Happening, ref: float, models: tuple[Line, Line], J: Four
) -> Path:
    """Return the flight with models A, B after an event, the errors before carried by J."""
    (A, a), (B, b) = models
    C, R, errors = carried((f.C, f.R, f.errors), J, (a, b))
    begun = shifted(h.ends, h.T[0], ref)
    return Path(begun, ref, A, B, C, R, errors, y.first_slow(begun))


def seen(y: System, f: Path, time: Pair, cos: float, sin: float) -> tuple[Line, Line]:
    """Return (p, s) at a time t; cos and sin are wrong by 2^-50 + its error."""
    t, e = time
    d = t - f.ref
    e += (abs(t) + abs(f.ref)) * TURN
    error = (line.size(f.A) + abs(d) + 2) * (e + TURN) + y.a_error * abs(d)
    s = line.moved((f.A, 0.0), sin - y.a * d, error + f.errors[0])
    p = line.total(line.scaled((f.A, 0.0), d, e), (f.B, 0.0))
    more = error * (1 + abs(d)) + influence(f, line.constant(d, e))
    return line.moved(p, -cos - y.a * d * d / 2, more), s


def since_start(y: System, f: Path, low: float) -> None:
    """Prove that a hit, not before a time, is not before the start either."""
    if low <= f.begun[1]:
        need(y.slows[0][0] - 6 < low, "a hit may be before the start")
        for t, e in y.slows.values():
            need(t + e < low or f.begun[1] < t - e, "a hit may be before the start")


def moving(y: System, f: Path, until: float) -> None:
    """Prove that s > 0 from the start to a time, if it is so there."""
    for k in range(f.slow, ARCS):
        if y.slows[k][0] - y.slows[k][1] > until:
            return
        s = seen(y, f, y.slow_time(k), y.a, -y.sine[0])[1]
        need(line.ends(s)[0] > 0, "the mass may stop, or not")
    raise Rejected("a flight is too long")


def strobes(y: System, f: Path, basins: Basins, until: float) -> Iterator[tuple[int, Bounds]]:
    """Give the multiples of pi that the flight passes before a time, and bounds, if of use."""
    for k in range(_STROBES):
        t, e = y.strobes[k]
        if basins.at(k) and f.begun[1] < t - e and t + e < until:
            yield k, bounds_of(*seen(y, f, (t, e), -1.0 if k % 2 else 1.0, 0.0))


def bounds_of(p: Line, s: Line) -> Bounds:
    """Return what gives bounds of sums of p and s."""

    def bounds(a: Pair, b: Pair) -> Pair:
        return line.ends(line.total(line.scaled(p, *a), line.scaled(s, *b)))

    return bounds
