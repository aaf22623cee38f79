"""The peer: the same proof at the paper's parameters, written straightforwardly in python-flint.

Nothing is general, F = ω = 1, R = 2, f = 2/5; all that our proof certifies is certified: each hit
exists and is the only one in its time window (interval Newton), the velocity keeps its sign on
each flight (bisection in time), the last flight ends between the walls, and Krawczyk's operator
maps the box into its interior.  On a flight of sign s from (x0, v0) at t0, with d = t - t0,

    v(t) = a + sin t - s f d,             a = v0 - sin t0,
    x(t) = b + a d - cos t - s f d²/2,    b = x0 + cos t0.

`benchmarks/ratios.py` compares our times with these.
"""

from flint import arb, ctx, fmpq

F = fmpq(2, 5)
M = "0.1002798898441967281474588631753400", "0.5419433067664594696756509456797456"
C = ("-1.048817355", "1.336320626"), ("-0.3424755651", "0.04881735493")
RADIUS = "1e-9"
HITS = ("1.099172910712220600", "3e-9"), ("3.516090441407112716", "1.5e-8")


class Failed(Exception):
    """A step of the proof is not certain."""


def need(certain):
    """Raise `Failed` unless a condition is certain."""
    if not certain:
        raise Failed


class Hints:
    """Hints at the current precision: m, the matrix C, the box m ± radius, windows of the hits."""

    def __init__(self):
        self.f, self.end = arb(F), 2 * arb.pi()
        with ctx.workprec(ctx.prec + 11):
            self.m = tuple(map(arb, M))
        self.box = tuple(arb(q, RADIUS) for q in self.m)
        self.windows = tuple(arb(t, radius) for t, radius in HITS)
        self.C = tuple(tuple(map(arb, row)) for row in C)


def newton(s, now, a, b, f, window):
    """Return where the solutions of x(t) = s in the window lie; s v > 0 there."""
    rate = a + window.sin() - s * f * (window - now)
    need(s * rate > 0)
    middle = window.mid()
    d = middle - now
    return middle - (b + d * (a - s * f * d / 2) - middle.cos() - s) / rate


def hit_time(s, now, a, b, f, window):
    """Prove that x(t) = s has one solution in the window; enclose it."""
    t = newton(s, now, a, b, f, window)
    need(window.contains(t))
    return newton(s, now, a, b, f, t)


def keeps_sign(s, now, a, f, end):
    """Prove that s v > 0 from ``now`` to ``end``, by bisection of the time."""
    pieces = [(now, end)]
    while pieces:
        first, last = pieces.pop()
        t = first.union(last)
        if not s * (a + t.sin() - s * f * (t - now)) > 0:
            need(last - first > 1e-3)
            middle = (first.mid() + last.mid()) / 2
            pieces += [(first, middle), (middle, last)]


def flow(x, v, h, windows):
    """Prove the two hits of all orbits from (x, v), and no other event until T.

    Return the state at T, the monodromy and the times of the hits.
    """
    f, T, s, now, a, b = h.f, h.end, 1, arb(0), v, x + 1
    p, q, r, w, times = 1, 0, 0, 1, []
    for window in windows:
        t = hit_time(s, now, a, b, f, window)
        sin, cos = t.sin_cos()
        d = t - now
        speed = a + sin - s * f * d
        need(now < t and s * speed > 0)
        keeps_sign(s, now, a, f, t)
        p, q, salt = p + d * r, q + d * w, 2 * cos / speed
        p, q, r, w = -p, -q, salt * p - r, salt * q - w
        s, now, a, b = -s, t, -speed - sin, s + cos
        times.append(t)
    d = T - now
    x, v = b + d * (a - s * f * d / 2) - 1, a - s * f * d
    need(now < T and s * v > 0 and x > -1 and x < 1)
    keeps_sign(s, now, a, f, T)
    return (x, v), (p + d * r, q + d * w, r, w), times


def krawczyk(h, image, slope):
    """Prove that one fixed point lies in the box; return K, which contains it."""
    p, q, r, w = slope
    (c1, c2), (c3, c4) = h.C
    x, v = h.m
    dx, dv = h.box[0] - x, h.box[1] - v
    g, k = image[0] - x, image[1] - v
    p, w = p - 1, w - 1
    K = (
        x - (c1 * g + c2 * k) + (1 - (c1 * p + c2 * r)) * dx - (c1 * q + c2 * w) * dv,
        v - (c3 * g + c4 * k) - (c3 * p + c4 * r) * dx + (1 - (c3 * q + c4 * w)) * dv,
    )
    need(all(outer.contains_interior(inner) for outer, inner in zip(h.box, K, strict=True)))
    return K


def rotation(slope):
    """Return the trace and the rotation number."""
    trace = slope[0] + slope[3]
    return trace, (trace / 2).acos() / (2 * arb.pi())


def existence(h):
    """Prove that one fixed point lies in the box; return K, the trace, the rotation, the times."""
    _, slope, times = flow(*h.box, h, h.windows)
    with ctx.workprec(ctx.prec + 11):
        image, _, _ = flow(*h.m, h, h.windows)
    return krawczyk(h, image, slope), *rotation(slope), times


def second_pass(h):
    """Return the trace and rotation number over K."""
    K, _, _, _ = existence(h)
    return rotation(flow(*K, h, h.windows)[1])


# Jets of order 3 in (x, v): lists of coefficients of 1, x, v, xx, xv, vv, xxx, xxv, xvv, vvv.


def add(p, q):
    """Return p + q."""
    return [i + j for i, j in zip(p, q, strict=True)]


def sub(p, q):
    """Return p - q."""
    return [i - j for i, j in zip(p, q, strict=True)]


def scaled(p, c):
    """Return c p for a number c."""
    return [c * i for i in p]


def mul(p, q):
    """Return p q without what exceeds order 3."""
    a, b, c, d, e, f, g, h, i, j = p
    k, l, m, n, o, r, s, t, u, w = q
    return [
        a * k,
        a * l + b * k,
        a * m + c * k,
        a * n + b * l + d * k,
        a * o + b * m + c * l + e * k,
        a * r + c * m + f * k,
        a * s + b * n + d * l + g * k,
        a * t + b * o + c * n + d * m + e * l + h * k,
        a * u + b * r + c * o + e * m + f * l + i * k,
        a * w + c * r + f * m + j * k,
    ]


def composed(p, g0, g1, g2, g3):
    """Return g(p), from the Taylor coefficients of g at the value of p."""
    h = [0, *p[1:]]
    h2 = mul(h, h)
    h3 = mul(h2, h)
    return add(add([g0] + 9 * [0], scaled(h, g1)), add(scaled(h2, g2), scaled(h3, g3)))


def sin_cos(p):
    """Return the jets of sine and cosine."""
    s, c = p[0].sin_cos()
    return composed(p, s, c, -s / 2, -c / 6), composed(p, c, -s, -c / 2, s / 6)


def reciprocal(p):
    """Return 1/p."""
    q = 1 / p[0]
    return composed(p, q, -q * q, q * q * q, -q * q * q * q)


def jet_of_flight(s, now, a, b, f, t):
    """Return x(t) + cos t and v(t) - sin t of a flight."""
    d = sub(t, now)
    fall = scaled(d, s * f)
    return add(b, mul(d, sub(a, scaled(fall, fmpq(1, 2))))), sub(a, fall)


def jet_of_hit_time(s, flight, t):
    """Return the jet of the solution of x(t) = s, whose value is t: first to order 1, then one
    step of Newton's iteration, which is right to order 3."""
    now, a, b, f = flight
    d = t - now[0]
    rest = a[0] - s * f * d
    speed = rest + t.sin()
    linear = ((now[k] * rest - b[k] - d * a[k]) / speed for k in (1, 2))
    t = [t, *linear] + 7 * [0]
    sin, cos = sin_cos(t)
    place, rest = jet_of_flight(s, now, a, b, f, t)
    gap = [0, *sub(place, cos)[1:]]
    return sub(t, mul(gap, reciprocal(add(rest, sin))))


def jet(h, times):
    """Return the jets of Φ at all states of the box; it has hits at these ``times`` only."""
    one, zero = arb(1), arb(0)
    x, v = [h.box[0], one] + 8 * [zero], [h.box[1], zero, one] + 7 * [zero]
    f, s, now, a, b = h.f, 1, 10 * [zero], v, [x[0] + 1, *x[1:]]
    for time in times:
        t = jet_of_hit_time(s, (now, a, b, f), time)
        sin, cos = sin_cos(t)
        _, rest = jet_of_flight(s, now, a, b, f, t)
        b = [s + cos[0], *cos[1:]]
        s, now, a = -s, t, sub(scaled(sin, -2), rest)
    place, rest = jet_of_flight(s, now, a, b, f, [h.end] + 9 * [zero])
    return [place[0] - 1, *place[1:]], rest
