"""Sets of states at a time, carried from period to period without being wrapped each time.

As in `cap.flow.propagation` a set is m + B ε + Q r: m a point, B ε the image of the initial box by
a point matrix, |ε| <= 1, and Q r the errors, in a frame Q that goes along with the set; it is made
orthogonal when its sides have become nearly parallel (Lohner 1987).  If a map φ has φ(m) in c and
derivatives in A + Δ, A a point matrix,

    φ(m + B ε + Q r)  is in  c + A B ε + A Q r + Δ (B ε + Q r).
"""

import math

from cap.boxes.flight import Base, Constants, Matrix
from cap.boxes.motion import FLY, REST, WALL, Motion, exact
from cap.sets.compiled import kernel
from cap.sets.doubles import TINY, Interval, magnitude
from cap.sets.records import Record, assign

SKEW = 0.05  # a frame is made orthogonal below this sine of the angle between its sides


class Frame(Record):
    """The vectors Q r: Q = ((a, c), (b, d)), |r| at most (along, across)."""

    a: float
    b: float
    c: float
    d: float
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
    x = abs(errors.a) * errors.along + abs(errors.c) * errors.across
    v = abs(errors.b) * errors.along + abs(errors.d) * errors.across
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
    errors.a, errors.b, errors.c, errors.d = 1.0, 0.0, 0.0, 1.0
    errors.along, errors.across = 0.0, 0.0


@kernel
def carry(errors: Frame, A: Matrix, more_x: float, more_v: float) -> None:
    """Replace Q r by A Q r and a box, A the midpoints.

    The new frame p, q is that of the directions of A Q; but if these are nearly the same, p is that
    of the longest side, and q is perpendicular.  The coordinates of w in it are w × q / p × q and
    p × w / p × q.
    """
    old_1, old_2 = (exact(errors.a), exact(errors.b)), (exact(errors.c), exact(errors.d))
    first, second = _applied(A, old_1), _applied(A, old_2)
    p, q = _frame(first, second, errors.along, errors.across)
    area = _cross(p, q)
    along = magnitude(_cross(first, q)) * errors.along
    along += magnitude(_cross(second, q)) * errors.across
    along += abs(q[1].mid) * more_x + abs(q[0].mid) * more_v
    across = magnitude(_cross(p, first)) * errors.along
    across += magnitude(_cross(p, second)) * errors.across
    across += abs(p[1].mid) * more_x + abs(p[0].mid) * more_v
    errors.a, errors.b, errors.c, errors.d = p[0].mid, p[1].mid, q[0].mid, q[1].mid
    errors.along = magnitude(exact(magnitude(Interval(along, TINY))) / area)
    errors.across = magnitude(exact(magnitude(Interval(across, TINY))) / area)


@kernel
def _applied(A: Matrix, w: tuple[Interval, Interval]) -> tuple[Interval, Interval]:
    """Return A w, A the midpoints."""
    a, b, c, d = exact(A.a.mid), exact(A.b.mid), exact(A.c.mid), exact(A.d.mid)
    return a * w[0] + b * w[1], c * w[0] + d * w[1]


@kernel
def _cross(p: tuple[Interval, Interval], q: tuple[Interval, Interval]) -> Interval:
    """Return p × q."""
    area: Interval = p[0] * q[1] - p[1] * q[0]
    return area


@kernel
def _frame(
    first: tuple[Interval, Interval],
    second: tuple[Interval, Interval],
    along: float,
    across: float,
) -> tuple[tuple[Interval, Interval], tuple[Interval, Interval]]:
    """Return the frame of two sides; any will do whose vectors are certain to be independent."""
    x_1, v_1, size_1 = _direction(first[0].mid, first[1].mid)
    x_2, v_2, size_2 = _direction(second[0].mid, second[1].mid)
    if abs(x_1 * v_2 - v_1 * x_2) > SKEW:
        return (exact(x_1), exact(v_1)), (exact(x_2), exact(v_2))
    if size_1 * along < size_2 * across:
        x_1, v_1 = x_2, v_2
    return (exact(x_1), exact(v_1)), (exact(-v_1), exact(x_1))


@kernel
def _direction(x: float, v: float) -> tuple[float, float, float]:
    """Return nearly the direction of a vector and its length; an axis stays an axis exactly."""
    length = math.sqrt(x * x + v * v)
    if length > 0 and x != 0 and v != 0:
        return x / length, v / length, length
    return (0.0, 1.0, length) if abs(v) > 0 else (1.0, 0.0, length)


@kernel
def product(A: Matrix, p: float, q: float, r: float, w: float) -> Matrix:
    """Return A ((p, q), (r, w)), A the midpoints."""
    a, b, c, d = exact(A.a.mid), exact(A.b.mid), exact(A.c.mid), exact(A.d.mid)
    P, Q, R, W = exact(p), exact(q), exact(r), exact(w)
    return Matrix(a * P + b * R, a * Q + b * W, c * P + d * R, c * Q + d * W)


@kernel
def image(n: Motion, y: Constants, source: Doubleton, d: Doubleton) -> None:
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
