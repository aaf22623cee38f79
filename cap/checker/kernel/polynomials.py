"""Polynomials of weighted degree 6 in doubles, each with a bound of what is left.

A model is 16 coefficients and a bound e: it says of a quantity over [-1, 1]^2 that it is, at each
(X, Y), the sum of the coefficients times the monomials X^i Y^j with 2 i + j <= 6, and of r with |r|
<= e.  The monomials are ordered by their weight 2 i + j,

    1;  Y;  X, Y^2;  X Y, Y^3;  X^2, X Y^2, Y^4;  X^2 Y, X Y^3, Y^5;  X^3, X^2 Y^2, X Y^4, Y^6

(`MONOMIALS` has the order of the coefficients).  X counts twice, for it is used where quantities
vary less with X than with Y.  Each operation keeps what a model says true for the result.

*Rounding* is as in `cap.checker.kernel.angles`: h = 2^-53, `_UP` = 1 + 2^-40 for the bounds,
which are sums and products of less than 1000 operations; `_SUM` = 2^-51 for 2 h.  A coefficient of
a product is a sum of at most ten products, wrong by at most 11 h times the sum of their sizes; all
of them by at most 11 h |p| |q|, |p| the sum of the sizes of the coefficients: `_PRODUCT` = 2^-49.

*Terms of a weight above 6* in a product are at most the sum of |p_a| |q_b| over a + b > 6, p_a the
part of weight a.

*Cosine and sine* of c + g with |g| <= G: cos g = 1 - g^2/2 + g^4/24 - g^6/720 + r, |r| <= G^8/8!,
and sin g = g (1 - g^2/6 + g^4/120) + r, |r| <= G^7/7!.  The coefficients 1/24, ... are doubles,
wrong by less than 2^-55.

*Inverse*: with p c = 1 - g for a double c and |g| <= G < 0.6, 1/p = c (1 + g + ... + g^6 + r), |r|
<= G^7/(1 - G).
"""

from __future__ import annotations

from operator import add

from cap.checker.kernel.angles import cos_sin
from cap.checker.kernel.rejection import need

Model = tuple[float, ...]

MONOMIALS = (
    *((0, 0), (0, 1), (1, 0), (0, 2), (1, 1), (0, 3), (2, 0), (1, 2)),
    *((0, 4), (2, 1), (1, 3), (0, 5), (3, 0), (2, 2), (1, 4), (0, 6)),
)
LAST = len(MONOMIALS)  # where the bound is
_UP = 1 + 2.0**-40
_SUM, _PRODUCT, _TINY = 2.0**-51, 2.0**-49, 2.0**-900
_SHARES = [4 / ((i + 1) * (j + 1)) if i % 2 == j % 2 == 0 else 0.0 for i, j in MONOMIALS]
_ODD = [k for k, (i, j) in enumerate(MONOMIALS) if i % 2 or j % 2]
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
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, e = p
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, f = q
    return (
        a0 * b0,
        a0 * b1 + a1 * b0,
        a0 * b2 + a2 * b0,
        a0 * b3 + a1 * b1 + a3 * b0,
        a0 * b4 + a1 * b2 + a2 * b1 + a4 * b0,
        a0 * b5 + a1 * b3 + a3 * b1 + a5 * b0,
        a0 * b6 + a2 * b2 + a6 * b0,
        a0 * b7 + a1 * b4 + a2 * b3 + a3 * b2 + a4 * b1 + a7 * b0,
        a0 * b8 + a1 * b5 + a3 * b3 + a5 * b1 + a8 * b0,
        a0 * b9 + a1 * b6 + a2 * b4 + a4 * b2 + a6 * b1 + a9 * b0,
        a0 * b10 + a1 * b7 + a2 * b5 + a3 * b4 + a4 * b3 + a5 * b2 + a7 * b1 + a10 * b0,
        a0 * b11 + a1 * b8 + a3 * b5 + a5 * b3 + a8 * b1 + a11 * b0,
        a0 * b12 + a2 * b6 + a6 * b2 + a12 * b0,
        a0 * b13 + a1 * b9 + a2 * b7 + a3 * b6 + a4 * b4 + a6 * b3 + a7 * b2 + a9 * b1 + a13 * b0,
        a0 * b14
        + a1 * b10
        + a2 * b8
        + a3 * b7
        + a4 * b5
        + a5 * b4
        + a7 * b3
        + a8 * b2
        + a10 * b1
        + a14 * b0,
        a0 * b15 + a1 * b11 + a3 * b8 + a5 * b5 + a8 * b3 + a11 * b1 + a15 * b0,
        _rest(p, q, e, f),
    )


def _rest(p: Model, q: Model, e: float, f: float) -> float:
    """Return a bound of what is left of a product, by parts of one weight."""
    p, q = tuple(map(abs, p)), tuple(map(abs, q))
    p1, p2, p3, p4 = p[1], p[2] + p[3], p[4] + p[5], p[6] + p[7] + p[8]
    p5, p6 = p[9] + p[10] + p[11], p[12] + p[13] + p[14] + p[15]
    q1, q2, q3, q4 = q[1], q[2] + q[3], q[4] + q[5], q[6] + q[7] + q[8]
    q5, q6 = q[9] + q[10] + q[11], q[12] + q[13] + q[14] + q[15]
    last = q6
    high = p1 * last
    for part, more in ((p2, q5), (p3, q4), (p4, q3), (p5, q2), (p6, q1)):
        last += more
        high += part * last
    P, Q = p[0] + p1 + p2 + p3 + p4 + p5 + p6, q[0] + last
    return (high + e * (Q + f) + f * P + P * Q * _PRODUCT + _TINY) * _UP


def inverse(p: Model) -> Model:
    """Return 1/p."""
    need(p[0] != 0, "a model that may vanish is inverted")
    c = 1 / p[0]
    g = moved(scaled(p, -c), 1.0, 0.0)
    G = size(g)
    need(G < 0.6, "a model that may vanish is inverted")
    r = moved(g, 1.0, 0.0)
    for _ in range(5):
        r = moved(product(g, r), 1.0, 0.0)
    return scaled(widened(r, G**7 / (1 - G) * _UP), c)


def ends(p: Model) -> tuple[float, float]:
    """Return a lower and an upper bound of p; even powers are in [0, 1]."""
    low = high = sum(abs(p[k]) for k in _ODD) + p[LAST]
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


def trigonometric(p: Model) -> tuple[Model, Model]:
    """Return the cosine and the sine of p."""
    c, s = cos_sin(p[0])
    g = with_constant(p, 0.0)
    G, h, e = size(g), product(g, g), 2.0**-55
    cos = moved(scaled(h, -1 / 720, e), 1 / 24, e)
    cos = moved(product(cos, h), -0.5, 0.0)
    cos = widened(moved(product(cos, h), 1.0, 0.0), G**8 / 40320 * _UP)
    sin = moved(scaled(h, 1 / 120, e), -1 / 6, e)
    sin = moved(product(sin, h), 1.0, 0.0)
    sin = widened(product(sin, g), G**7 / 5040 * _UP)
    e = 2.0**-50
    return (
        total(scaled(cos, c, e), scaled(sin, -s, e)),
        total(scaled(cos, s, e), scaled(sin, c, e)),
    )
