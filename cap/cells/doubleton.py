"""Sets of states at a time, carried from period to period without being wrapped each time.

As in `cap.flow.propagation` a set is m + B ε + Q r: m a point, B ε the image of the initial box by
a point matrix, |ε| <= 1, and Q r the errors, in a frame Q, nearly a rotation, that is turned along
with the set (Lohner 1987).  If a map φ has φ(m) in c and derivatives in A + Δ, A a point matrix,

    φ(m + B ε + Q r)  is in  c + A B ε + A Q r + Δ (B ε + Q r).
"""

import math

from cap.cells.flight import Base, Matrix, System
from cap.cells.motion import FLY, REST, WALL, Motion, exact
from cap.sets.compiled import kernel
from cap.sets.doubles import TINY, Interval, magnitude, upper
from cap.sets.records import Record, assign


class Frame(Record):
    """The vectors Q r: Q = ((cos, -sin), (sin, cos)), |r| at most (along, across)."""

    cos: float
    sin: float
    along: float
    across: float


class Doubleton(Record):
    """A set of states: they move, rest between the walls, or at the wall ``side`` (1.0 or -1.0).

    x is measured from the right wall, in units of F/ω², v in units of F/ω.  B = ((p, q), (r, w)).
    All that came here had the events of ``surely``, none had others than those of ``possibly``.
    ``base`` is room.
    """

    kind: int
    side: float
    x: float
    v: float
    p: float
    q: float
    r: float
    w: float
    errors: Frame
    surely: int
    possibly: int
    base: Base


@kernel
def frame_box(errors: Frame) -> tuple[float, float]:
    """Return bounds of the components of Q r; exactly 0 if r is."""
    if errors.along == 0 and errors.across == 0:
        return 0.0, 0.0
    c, s = abs(errors.cos), abs(errors.sin)
    x, v = c * errors.along + s * errors.across, s * errors.along + c * errors.across
    return magnitude(Interval(x, TINY)), magnitude(Interval(v, TINY))


@kernel
def set_base(base: Base, d: Doubleton) -> None:
    """Write the deviations from the point m, the errors in a box."""
    base.p, base.q, base.r, base.w = d.p, d.q, d.r, d.w
    base.x, base.v = frame_box(d.errors)


@kernel
def box_of(d: Doubleton) -> tuple[Interval, Interval]:
    """Return all x and all v."""
    x, v = frame_box(d.errors)
    x, v = magnitude(Interval(abs(d.p) + abs(d.q), x)), magnitude(Interval(abs(d.r) + abs(d.w), v))
    return Interval(d.x, x), Interval(d.v, v)


@kernel
def set_box(d: Doubleton, kind: int, side: float, x: Interval, v: Interval) -> None:
    """Write the set of the states of a box."""
    d.kind, d.side, d.x, d.v = kind, side, x.mid, v.mid
    d.p, d.q, d.r, d.w = x.rad, 0.0, 0.0, v.rad
    clear(d.errors)


@kernel
def clear(errors: Frame) -> None:
    """Write no errors."""
    errors.cos, errors.sin, errors.along, errors.across = 1.0, 0.0, 0.0, 0.0


@kernel
def carry(errors: Frame, A: Matrix, more_x: float, more_v: float) -> None:
    """Replace Q r by A Q r and a box, A the midpoints, in the frame of their longest side.

    The new Q need not be a rotation: its inverse is ((c, s), (-s, c))/(c² + s²).
    """
    a, b, c, d = exact(A.a.mid), exact(A.b.mid), exact(A.c.mid), exact(A.d.mid)
    C, S = exact(errors.cos), exact(errors.sin)
    first, second = (a * C + b * S, c * C + d * S), (b * C - a * S, d * C - c * S)
    size_1 = (abs(first[0].mid) + abs(first[1].mid)) * errors.along
    size_2 = (abs(second[0].mid) + abs(second[1].mid)) * errors.across
    longest = second if size_1 < size_2 else first
    cos, sin = _direction(longest[0].mid, longest[1].mid)
    C, S = exact(cos), exact(sin)
    norm = C * C + S * S
    along = magnitude(C * first[0] + S * first[1]) * errors.along
    along += magnitude(C * second[0] + S * second[1]) * errors.across
    along += abs(cos) * more_x + abs(sin) * more_v
    across = magnitude(C * first[1] - S * first[0]) * errors.along
    across += magnitude(C * second[1] - S * second[0]) * errors.across
    across += abs(sin) * more_x + abs(cos) * more_v
    errors.cos, errors.sin = cos, sin
    errors.along = upper(exact(magnitude(Interval(along, TINY))) / norm)
    errors.across = upper(exact(magnitude(Interval(across, TINY))) / norm)


@kernel
def _direction(x: float, v: float) -> tuple[float, float]:
    """Return nearly the cosine and sine of the angle of a vector; an axis stays an axis exactly."""
    length = math.sqrt(x * x + v * v)
    if x != 0 and v != 0 and length > 0:
        return x / length, v / length
    return 1.0, 0.0


@kernel
def product(A: Matrix, p: float, q: float, r: float, w: float) -> Matrix:
    """Return A ((p, q), (r, w)), A the midpoints."""
    a, b, c, d = exact(A.a.mid), exact(A.b.mid), exact(A.c.mid), exact(A.d.mid)
    P, Q, R, W = exact(p), exact(q), exact(r), exact(w)
    return Matrix(a * P + b * R, a * Q + b * W, c * P + d * R, c * Q + d * W)


@kernel
def image(n: Motion, y: System, source: Doubleton, d: Doubleton) -> None:
    """Write the set of the motions ``n``, which came from ``source``, at the end of a span."""
    right = n.flight.sign > 0
    if n.kind == WALL:
        at = exact(0.0) if right else -y.width
        set_box(d, WALL, n.flight.sign, at, exact(0.0))
        return
    gap, speed = n.centre.gap, n.centre.speed
    x, v = (-gap, speed) if right else (gap - y.width, -speed)
    base, A = n.base, derivative(n)
    set_base(d.base, source)
    if _same(base, d.base):
        assign(d.errors, source.errors)
    else:
        clear(d.errors)
        d.errors.along, d.errors.across = base.x, base.v
    dx = magnitude(Interval(abs(base.p) + abs(base.q), base.x))
    dv = magnitude(Interval(abs(base.r) + abs(base.w), base.v))
    B = product(A, base.p, base.q, base.r, base.w)
    more_x = (x.rad + B.a.rad + B.b.rad) + (A.a.rad * dx + A.b.rad * dv)
    more_v = (v.rad + B.c.rad + B.d.rad) + (A.c.rad * dx + A.d.rad * dv)
    carry(d.errors, A, magnitude(exact(more_x)), magnitude(exact(more_v)))
    d.kind, d.side, d.x, d.v = REST if n.kind == REST else FLY, 0.0, x.mid, v.mid
    d.p, d.q, d.r, d.w = B.a.mid, B.b.mid, B.c.mid, B.d.mid


@kernel
def derivative(n: Motion) -> Matrix:
    """Return the derivative of (x, v) at the end of a span."""
    if n.flight.sign > 0:
        return Matrix(n.a, n.b, n.c, n.d)
    return Matrix(-n.a, -n.b, -n.c, -n.d)


@kernel
def _same(one: Base, other: Base) -> bool:
    first = one.p == other.p and one.q == other.q and one.r == other.r and one.w == other.w
    return first and one.x == other.x and one.v == other.v
