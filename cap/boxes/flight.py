"""One flight, for intervals of doubles that enclose and for doubles that steer.

Units of 1/ω for time and F/ω² for length, so that v' = cos t - α sgn v - μ v (α = f/F, μ in units
of ω) between walls a distance ``width`` apart.  A flight of sign s is looked at in its mirror
image: u = s v >= 0 is its speed, ``gap`` its distance from the wall ahead, and its moments carry
s sin t and s cos t, so

    u' = cos t - α - μu,      gap' = -u

whatever its sign.  As in `cap.flow.model`, from (t0, u0) with d = t - t0 and D, h, k of
`cap.flow.relaxation`

    u = V(t) + (u0 - V(t0)) D - α h,      V = (sin t + μ cos t)/(1 + μ²),
    gap = gap0 - (X(t) - X(t0) + (u0 - V(t0)) h - α k),      X = (μ sin t - cos t)/(1 + μ²).

exp(μt) u has its minima at the *slow* times, cos t = α with sin t < 0, and its maxima at the *fast*
times, cos t = α with sin t > 0.
"""

from typing import Any, NamedTuple

from cap.sets.circular import TURN, sin_cos
from cap.sets.compiled import kernel
from cap.sets.decay import relaxed
from cap.sets.doubles import (
    TINY,
    UNIT,
    Interval,
    between,
    is_negative,
    is_positive,
    lower,
    magnitude,
    upper,
)
from cap.sets.records import Record


class Moment(NamedTuple):
    """A time with its sine and cosine: intervals, or doubles."""

    t: Any
    sin: Any
    cos: Any


class Instant(Record):
    """The same in memory."""

    t: Interval
    sin: Interval
    cos: Interval


class Constants(Record):
    """The constants.

    ``response`` = 1/(1 + μ²), ``sine`` = sqrt(1 - α²), ``arc`` = arccos α; ``slow_right`` and
    ``slow_left`` are the first slow times >= 0 of both signs.  ``viscous`` unless μ is exactly 0,
    ``elastic`` if e is exactly 1.
    """

    alpha: Interval
    mu: Interval
    e: Interval
    width: Interval
    response: Interval
    sine: Interval
    arc: Interval
    slow_right: Interval
    slow_left: Interval
    viscous: int
    elastic: int


class NearSystem(Record):
    """The same in doubles: they steer."""

    alpha: float
    mu: float
    e: float
    width: float
    response: float
    sine: float
    arc: float
    slow_right: float
    slow_left: float
    viscous: int
    elastic: int


class Flight(Record):
    """A flight of a sign, 1.0 or -1.0: when it begins, as it sees it; the speed and gap then."""

    sign: float
    t: Interval
    sin: Interval
    cos: Interval
    speed: Interval
    gap: Interval


class NearFlight(Record):
    """The same in doubles."""

    sign: float
    t: float
    sin: float
    cos: float
    speed: float
    gap: float


class Matrix(NamedTuple):
    """((a, b), (c, d))."""

    a: Interval
    b: Interval
    c: Interval
    d: Interval


class Base(Record):
    """Deviations ((p, q), (r, w)) ε + (δ, η) from a point: |ε| <= 1, |δ| <= x, |η| <= v."""

    p: float
    q: float
    r: float
    w: float
    x: float
    v: float


@kernel
def seen(sign: float, at: Moment) -> Moment:
    """Return the moment as a flight of this sign sees it; applied twice, this is the identity."""
    if sign < 0:
        return Moment(at.t, -at.sin, -at.cos)
    return at


@kernel
def moment(sign: float, t: Interval) -> Moment:
    """Return the moment at a time, as a flight of this sign sees it."""
    sine, cosine = sin_cos(t)
    return seen(sign, Moment(t, sine, cosine))


@kernel
def cosines(sign: float, begin: float, end: float) -> Interval:
    """Return all s cos t between two times.

    Where the sine has one sign the cosine is monotone.  Between two times less than π apart at
    which it is positive, it is positive too, and concave.
    """
    if not end - begin < 3:
        return Interval(0.0, 1.0)
    span = moment(sign, between(begin, end))
    first: Interval = moment(sign, Interval(begin, 0.0)).cos
    last: Interval = moment(sign, Interval(end, 0.0)).cos
    low, high = min(lower(first), lower(last)), max(upper(first), upper(last))
    if is_positive(span.sin) or is_negative(span.sin):
        return between(low, high)
    if low > 0:
        return between(low, min(1.0, upper(span.cos)))
    if high < 0:
        return between(max(-1.0, lower(span.cos)), high)
    return Interval(span.cos.mid, span.cos.rad)


@kernel
def launch(n: Any, sign: float, at: Moment, speed: Any, gap: Any) -> None:
    """Write a flight; ``at`` is as it sees it."""
    n.sign = sign
    n.t, n.sin, n.cos = at.t, at.sin, at.cos
    n.speed, n.gap = speed, gap


@kernel
def slow(y: Constants, sign: float, k: int) -> Moment:
    """Return the k-th slow moment of a sign, k >= 0, as its flights see it."""
    first = y.slow_right if sign > 0 else y.slow_left
    return Moment(first + float(k) * TURN, -y.sine, y.alpha)


@kernel
def fast_before(y: Constants, at: Moment) -> Interval:
    """Return the fast time before a slow moment: there, exp(μt) u begins to fall."""
    fast: Interval = at.t - TURN + 2.0 * y.arc
    return fast


@kernel
def flown(y: Any, n: Any, at: Moment) -> tuple[Any, Any]:
    """Return (speed, gap) at a moment of the formula, whatever may have happened before it."""
    d = at.t - n.t
    if y.viscous == 0:
        rate = n.speed - n.sin
        speed = rate + at.sin - y.alpha * d
        return speed, n.gap - (d * (rate - 0.5 * (y.alpha * d)) - (at.cos - n.cos))
    D, h, k = relaxed(y.mu, d)
    rate = n.speed - y.response * (n.sin + y.mu * n.cos)
    speed = y.response * (at.sin + y.mu * at.cos) + rate * D - y.alpha * h
    moved = y.response * (y.mu * (at.sin - n.sin) - (at.cos - n.cos))
    return speed, n.gap - (moved + rate * h - y.alpha * k)


@kernel
def force(y: Any, cos: Any, speed: Any) -> Any:
    """Return u' where s cos t and the speed are such."""
    dry = cos - y.alpha
    return dry - y.mu * speed if y.viscous != 0 else dry


@kernel
def steepest(y: Constants, at: Moment, speed: Interval, radius: float) -> float:
    """Return a bound of |u'| within ``radius`` of a moment at which the speeds are ``speed``.

    |cos(t + d) - cos t| <= |sin t| |d| + d²/2; and |u'| <= A follows from A >= K + μ (|u| + A R).
    """
    most = magnitude(at.cos - y.alpha) + radius * (magnitude(at.sin) + radius)
    if y.viscous != 0:
        mu = magnitude(y.mu)
        if not mu * radius < 0.25:
            return 1e300
        most = (most + mu * magnitude(speed)) / (1 - 2 * mu * radius)
    return magnitude(Interval(most, TINY))


@kernel
def drift(y: Constants, m: Matrix, d: Interval) -> Matrix:
    """Return the derivative after a flight of the duration ``d``."""
    if y.viscous == 0:
        return Matrix(m.a + d * m.c, m.b + d * m.d, m.c, m.d)
    D, h, _ = relaxed(y.mu, d)
    return Matrix(m.a + h * m.c, m.b + h * m.d, D * m.c, D * m.d)


@kernel
def spread(a: Interval, b: Interval, base: Base) -> float:
    """Return a bound of |a δx + b δv| over the deviations of a base.

    The rounding of a.mid p + b.mid r is below 3u (|a.mid p| + |b.mid r|): so much is added.
    """
    more_a, more_b = a.rad + 4 * UNIT * abs(a.mid), b.rad + 4 * UNIT * abs(b.mid)
    first = abs(a.mid * base.p + b.mid * base.r) + (more_a * abs(base.p) + more_b * abs(base.r))
    second = abs(a.mid * base.q + b.mid * base.w) + (more_a * abs(base.q) + more_b * abs(base.w))
    box = magnitude(a) * base.x + magnitude(b) * base.v
    return magnitude(Interval(first + second, box + TINY))
