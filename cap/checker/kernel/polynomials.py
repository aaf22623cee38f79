"""Polynomials of degree 4 in doubles, each with a bound of what is left.

A model is 15 coefficients and a bound e: it says of a quantity over [-1, 1]^2 that it is, at each
(X, Y), the sum of the coefficients times the monomials X^i Y^j with i + j <= 4, and of r with |r|
<= e.  The monomials are ordered by their degree, and then by i:

    1;  Y, X;  Y^2, X Y, X^2;  Y^3, X Y^2, X^2 Y, X^3;  Y^4, X Y^3, X^2 Y^2, X^3 Y, X^4

(`MONOMIALS`).  Each operation keeps what a model says true for the result.

*Rounding* is as in `cap.checker.kernel.angles`: h = 2^-53, `_UP` = 1 + 2^-40 for the bounds,
which are sums and products of less than 1000 operations; `_SUM` = 2^-51 for 2 h.  A coefficient of
a product is a sum of at most nine products, wrong by at most 11 h times the sum of their sizes; all
of them by at most 11 h |p| |q|, |p| the sum of the sizes of the coefficients: `_PRODUCT` = 2^-49.

*Terms of a degree above 4* in a product are at most the sum of |p_a| |q_b| over a + b > 4, p_a the
part of degree a.

*Cosine and sine* of c + g with |g| <= G: cos g = 1 - g^2/2 + g^4/24 + r, |r| <= G^6/6!, and sin g =
g (1 - g^2/6) + r, |r| <= G^5/5!.  The coefficients 1/24 and 1/6 are doubles, wrong by less than
2^-55.

*Where p < v.*  p is at most h + a X + b Y, h bounding all other terms.  With u >= w the sizes of a
and b, and d = v - h, h + a X + b Y < v in this part of the square:

    0                          if d + u + w <= 0
    (d + u + w)^2/(8 u w)      if d + u + w <= 2 w
    (d + u)/(2 u)              if d + u + w <= 2 u
    1 - (u + w - d)^2/(8 u w)  if d <= u + w,        else 1

*Inverse*: with p c = 1 - g for a double c and |g| <= G < 0.6, 1/p = c (1 + g + g^2 + r), |r| <=
G^3/(1 - G).
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import add, itemgetter

from cap.checker.kernel.angles import cos_sin
from cap.checker.kernel.rejection import need

Model = tuple[float, ...]

DEGREE = 4
MONOMIALS = [(i, degree - i) for degree in range(DEGREE + 1) for i in range(degree + 1)]
LAST = len(MONOMIALS)  # where the bound is
DEGREES = [i + j for i, j in MONOMIALS]
PARTS = [(w, w * (w + 1) // 2, (w + 1) * (w + 2) // 2) for w in range(1, DEGREE + 1)]
_UP = 1 + 2.0**-40
_SUM, _PRODUCT, _TINY = 2.0**-51, 2.0**-49, 2.0**-900
_FLAT = 2.0**-200  # so small u and w are added to h
_THIN = 2.0**-40  # of u: a smaller w is added to h; of the square: more than rounding
_SHARES = [4 / ((i + 1) * (j + 1)) if i % 2 == j % 2 == 0 else 0.0 for i, j in MONOMIALS]
_ODD = itemgetter(*(k for k, (i, j) in enumerate(MONOMIALS) if i % 2 or j % 2))
_EVEN = [k for k, (i, j) in enumerate(MONOMIALS) if k and i % 2 == j % 2 == 0]


def model(e: float = 0.0, **coefficients: float) -> Model:
    """Return a model by the names of its monomials: one, X, Y, YY, XY, XYY."""
    places = {"one": 0, "Y": 1, "X": 2, "YY": 3, "XY": 4, "XYY": 7}
    p = [0.0] * LAST + [e]
    for name, value in coefficients.items():
        p[places[name]] = value
    return tuple(p)


def size(p: Model) -> float:
    """Return a bound of |p|."""
    return sum(map(abs, p)) * _UP + _TINY


def rest(p: Model) -> float:
    """Return a bound of |p - p_0|, p_0 the constant coefficient."""
    return sum(map(abs, p[1:])) * _UP + _TINY


def first(p: Model) -> float:
    """Return the constant coefficient."""
    return p[0]


def error(p: Model) -> float:
    """Return the bound of what is left."""
    return p[LAST]


def ball(p: Model) -> tuple[float, float]:
    """Return a number, and a bound of its difference from p."""
    low, high = ends(p)
    m = (low + high) / 2
    return m, max(high - m, m - low) * _UP + abs(m) * _SUM


def bend(_cos: Model, _sin: Model) -> float:
    """Return a bound of the change of a cosine and a sine, per change of the angle."""
    return 1.0


def root(slope: Model, bend: float, left: float, left_all: float) -> tuple[float, float]:
    """Return how far T_0 is from a zero T of F, by the lemma of `cap.checker.folded.events`.

    ``slope`` is F' at T_0, positive, which changes by ``bend`` per time; ``left`` bounds F(T_0),
    without and with the errors of F.
    """
    least = ends(slope)[0]
    need(least > 0, "the time of an event is not certain")
    e, e_all = 2 * left / least * _UP, 2 * left_all / least * _UP
    need(2 * bend * e_all * _UP < least, "the time of an event is not certain")
    return e, e_all


def coefficients(p: Model) -> Model:
    """Return the coefficients of the polynomial."""
    return p[:LAST]


def of_coefficients(c: Sequence[float]) -> Model:
    """Return a polynomial."""
    return (*c, 0.0)


def with_constant(p: Model, c: float) -> Model:
    """Return p with another constant coefficient."""
    return (c, *p[1:])


def exact(p: Model) -> Model:
    """Return the polynomial of a model."""
    return (*p[:LAST], 0.0)


def widened(p: Model, e: float) -> Model:
    """Return the model of what differs from p by at most e."""
    return (*p[:LAST], (p[LAST] + e) * _UP)


def moved(p: Model, a: float, e: float) -> Model:
    """Return p plus a number within e of a."""
    c = p[0] + a
    return (c, *p[1:LAST], (p[LAST] + e + abs(c) * _SUM) * _UP)


def total(p: Model, q: Model) -> Model:
    """Return p + q."""
    r = [*map(add, p, q)]
    r[LAST] = (r[LAST] + sum(map(abs, r)) * _SUM) * _UP
    return tuple(r)


def scaled(p: Model, c: float, d: float = 0.0) -> Model:
    """Return p times a number within d of c."""
    r = [a * c for a in p]
    most = abs(c) * _SUM + d
    r[LAST] = (sum(map(abs, p)) * most + abs(r[LAST]) + _TINY) * _UP
    return tuple(r)


def product(p: Model, q: Model) -> Model:
    """Return p q."""
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, e = p
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, f = q
    return (
        a0 * b0,
        a0 * b1 + a1 * b0,
        a0 * b2 + a2 * b0,
        a0 * b3 + a1 * b1 + a3 * b0,
        a0 * b4 + a1 * b2 + a2 * b1 + a4 * b0,
        a0 * b5 + a2 * b2 + a5 * b0,
        a0 * b6 + a1 * b3 + a3 * b1 + a6 * b0,
        a0 * b7 + a1 * b4 + a2 * b3 + a3 * b2 + a4 * b1 + a7 * b0,
        a0 * b8 + a1 * b5 + a2 * b4 + a4 * b2 + a5 * b1 + a8 * b0,
        a0 * b9 + a2 * b5 + a5 * b2 + a9 * b0,
        a0 * b10 + a1 * b6 + a3 * b3 + a6 * b1 + a10 * b0,
        a0 * b11 + a1 * b7 + a2 * b6 + a3 * b4 + a4 * b3 + a6 * b2 + a7 * b1 + a11 * b0,
        a0 * b12 + a1 * b8 + a2 * b7 + a3 * b5 + a4 * b4 + a5 * b3 + a7 * b2 + a8 * b1 + a12 * b0,
        a0 * b13 + a1 * b9 + a2 * b8 + a4 * b5 + a5 * b4 + a8 * b2 + a9 * b1 + a13 * b0,
        a0 * b14 + a2 * b9 + a5 * b5 + a9 * b2 + a14 * b0,
        _rest(p, q, e, f),
    )


def _rest(p: Model, q: Model, e: float, f: float) -> float:
    """Return a bound of what is left of a product, by parts of one degree."""
    p0, p1, p2, p3, p4 = _parts(p)
    q0, q1, q2, q3, last = _parts(q)
    high = p1 * last
    last += q3
    high += p2 * last
    last += q2
    high += p3 * last
    last += q1
    high += p4 * last
    P, Q = p0 + p1 + p2 + p3 + p4, q0 + last
    return (high + e * (Q + f) + f * P + P * Q * _PRODUCT + _TINY) * _UP


def _parts(p: Model) -> tuple[float, float, float, float, float]:
    """Return the sums of the sizes of the coefficients of each degree."""
    a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, _ = map(abs, p)
    return a, b + c, d + e + f, g + h + i + j, k + l + m + n + o


def inverse(p: Model) -> Model:
    """Return 1/p."""
    need(p[0] != 0, "a model that may vanish is inverted")
    c = 1 / p[0]
    g = moved(scaled(p, -c), 1.0, 0.0)
    G = size(g)
    need(G < 0.6, "a model that may vanish is inverted")
    r = moved(total(g, product(g, g)), 1.0, 0.0)
    return scaled(widened(r, G * G * G / (1 - G) * _UP), c)


def ends(p: Model) -> tuple[float, float]:
    """Return a lower and an upper bound of p; even powers are in [0, 1]."""
    low = high = sum(map(abs, _ODD(p))) + p[LAST]
    for k in _EVEN:
        if p[k] > 0:
            high += p[k]
        else:
            low -= p[k]
    more = (abs(p[0]) + low + high) * _SUM + _TINY
    return p[0] - (low + more) * _UP, p[0] + (high + more) * _UP


def integral(p: Model) -> float:
    """Return a lower bound of the integral of p over [-1, 1]^2."""
    found = sum(c * share for c, share in zip(p, _SHARES, strict=False))
    return found - 4 * (p[LAST] + sum(map(abs, p)) * _PRODUCT) * _UP - _TINY


def part_below(p: Model, v: float) -> float:
    """Return a lower bound of the part of [-1, 1]^2 in which p < v."""
    u, w = max(abs(p[1]), abs(p[2])), min(abs(p[1]), abs(p[2]))
    high = ends((p[0], 0.0, 0.0, *p[3:]))[1]
    if u < _FLAT:
        high, u, w = high + u + w, 0.0, 0.0
    if w < u * _THIN:
        high, w = high + w, 0.0
    d = v - high - (abs(v) + abs(high) + u) * 2 * _SUM
    corner = d + u + w
    if corner <= 0 or d >= u + w:
        part = float(corner > 0)
    elif corner <= 2 * w:
        part = corner * corner / (8 * u * w)
    elif corner <= 2 * u:
        part = (d + u) / (2 * u)
    else:
        part = 1 - (u + w - d) * (u + w - d) / (8 * u * w)
    return max(0.0, part - _THIN)


def integral_below(density: Model, p: Model, v: float) -> float:
    """Return a lower bound of the integral of a density that is not negative over where p < v."""
    if ends(p)[1] < v:
        return max(0.0, integral(density))
    part, (least, most) = part_below(p, v), ends(density)
    if part == 0:
        return 0.0
    return max(4 * part * least / _UP, integral(density) - 4 * (1 - part) * most * _UP, 0.0)


def trigonometric(p: Model) -> tuple[Model, Model]:
    """Return the cosine and the sine of p."""
    c, s = cos_sin(p[0])
    g = with_constant(p, 0.0)
    G, h, e = size(g), product(g, g), 2.0**-55
    cos = moved(product(moved(scaled(h, 1 / 24, e), -0.5, 0.0), h), 1.0, 0.0)
    cos = widened(cos, G * G * G * G * G * G / 720 * _UP)
    sin = product(moved(scaled(h, -1 / 6, e), 1.0, 0.0), g)
    sin = widened(sin, G * G * G * G * G / 120 * _UP)
    e = 2.0**-50
    return (
        total(scaled(cos, c, e), scaled(sin, -s, e)),
        total(scaled(cos, s, e), scaled(sin, c, e)),
    )


def part(w: int, f: Sequence[float], g: Sequence[float]) -> tuple[float, ...]:
    """Return the part of degree w of f g, for f without a constant, w from 1 to 4."""
    if w == 1:
        return f[1] * g[0], f[2] * g[0]
    _, f1, f2, f3, f4, f5, f6, f7, f8, f9, *last = f
    g0, g1, g2, g3, g4, g5, g6, g7, g8, g9, *_ = g
    if w == 2:
        return f1 * g1 + f3 * g0, f1 * g2 + f2 * g1 + f4 * g0, f2 * g2 + f5 * g0
    if w == 3:
        return (
            f1 * g3 + f3 * g1 + f6 * g0,
            f1 * g4 + f2 * g3 + f3 * g2 + f4 * g1 + f7 * g0,
            f1 * g5 + f2 * g4 + f4 * g2 + f5 * g1 + f8 * g0,
            f2 * g5 + f5 * g2 + f9 * g0,
        )
    f10, f11, f12, f13, f14 = last
    return (
        f1 * g6 + f3 * g3 + f6 * g1 + f10 * g0,
        f1 * g7 + f2 * g6 + f3 * g4 + f4 * g3 + f6 * g2 + f7 * g1 + f11 * g0,
        f1 * g8 + f2 * g7 + f3 * g5 + f4 * g4 + f5 * g3 + f7 * g2 + f8 * g1 + f12 * g0,
        f1 * g9 + f2 * g8 + f4 * g5 + f5 * g4 + f8 * g2 + f9 * g1 + f13 * g0,
        f2 * g9 + f5 * g5 + f9 * g2 + f14 * g0,
    )
