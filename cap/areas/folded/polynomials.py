"""Compiled: polynomials of degree 4 in X and Y with a bound of what is left, over [-1, 1]^2.

A model of a quantity is 16 doubles: the coefficients, taken exactly, of

    1, Y, X, Y², XY, X², Y³, XY², X²Y, X³, Y⁴, XY³, X²Y², X³Y, X⁴,

and e >= 0: at each (X, Y) the quantity differs from the polynomial by at most e.  Each operation
keeps this true for the result; a NaN says nothing, and no comparison holds for it.

*Rounding* (`cap.sets.doubles`).  Let h = 2^-53.  A coefficient of a product is a sum of at most 9
products: it is wrong by at most 11 h times the sum of their sizes, all of them by 11 h |p| |q|,
where |p| is the sum of the sizes of the coefficients.  `PRODUCT` = 16 h.  A coefficient of a sum,
or of a product with a number, is wrong by at most h of itself; `SUM` = 4 h.  Bounds e are sums and
products of at most 100 numbers that are not negative, and so too small by at most 2^-46 of
themselves, for which `UP` = 1 + 2^-40 makes up; `TINY` covers underflow.
"""

import math

from cap.sets.circular import sin_cos_of_double
from cap.sets.compiled import kernel

Model = tuple[float, ...]
Three = tuple[float, float, float]

LAST = 15  # where e is
UP = 1 + 2.0**-40
SUM, PRODUCT, TINY = 2.0**-51, 2.0**-49, 2.0**-900
FLAT = 2.0**-200  # so small u and w are added to h
THIN = 2.0**-40  # of u: a smaller w is added to h; of the square: more than rounding
ANGLE = 2.0**-50  # more than the error of a cosine or a sine of a double
RATIO = 2.0**-55  # more than the error of the doubles next to 1/6, 1/24
NEAREST = 0.6  # sizes of g for which 1/(1 - g) is expanded


@kernel
def norm(p: Model) -> float:
    """Return the sum of the sizes of the coefficients."""
    low = abs(p[0]) + abs(p[1]) + abs(p[2]) + abs(p[3]) + abs(p[4]) + abs(p[5])
    return low + (
        abs(p[6])
        + abs(p[7])
        + abs(p[8])
        + abs(p[9])
        + abs(p[10])
        + abs(p[11])
        + abs(p[12])
        + abs(p[13])
        + abs(p[14])
    )


@kernel
def bound(p: Model) -> float:
    """Return a bound of |p|."""
    return (norm(p) + p[15]) * UP + TINY


@kernel
def constant(a: float, e: float) -> Model:
    """Return the model of a number within e of a."""
    return (a, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, e)


@kernel
def between(middle: Three, half: Three, e: float) -> Model:
    """Return the model of middle + half X, both polynomials in Y with three coefficients."""
    (a, b, c), (u, v, w) = middle, half
    return (a, b, u, c, v, 0.0, 0.0, w, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, e)


@kernel
def widened(p: Model, e: float) -> Model:
    """Return the model of what differs from p by at most e."""
    return (*p[:15], (p[15] + e) * UP)


@kernel
def exact(p: Model) -> Model:
    """Return the polynomial of a model."""
    return (*p[:15], 0.0)


@kernel
def centred(p: Model, a: float) -> Model:
    """Return p with another constant."""
    return (a, *p[1:])


@kernel
def moved(p: Model, a: float, e: float) -> Model:
    """Return p plus a number within e of a."""
    c = p[0] + a
    return (c, *p[1:15], (p[15] + e + abs(c) * SUM) * UP)


@kernel
def total(p: Model, q: Model) -> Model:
    """Return p + q."""
    r = (
        p[0] + q[0],
        p[1] + q[1],
        p[2] + q[2],
        p[3] + q[3],
        p[4] + q[4],
        p[5] + q[5],
        p[6] + q[6],
        p[7] + q[7],
        p[8] + q[8],
        p[9] + q[9],
        p[10] + q[10],
        p[11] + q[11],
        p[12] + q[12],
        p[13] + q[13],
        p[14] + q[14],
        p[15] + q[15],
    )
    return (*r[:15], (r[15] + norm(r) * SUM) * UP)


@kernel
def scaled(p: Model, c: float, d: float) -> Model:
    """Return p times a number within d of c."""
    return (
        p[0] * c,
        p[1] * c,
        p[2] * c,
        p[3] * c,
        p[4] * c,
        p[5] * c,
        p[6] * c,
        p[7] * c,
        p[8] * c,
        p[9] * c,
        p[10] * c,
        p[11] * c,
        p[12] * c,
        p[13] * c,
        p[14] * c,
        (norm(p) * (abs(c) * SUM + d) + p[15] * (abs(c) + d) + TINY) * UP,
    )


@kernel
def _parts(p: Model) -> tuple[float, float, float, float, float]:
    """Return the sums of the sizes of the coefficients of each degree."""
    return (
        abs(p[0]),
        abs(p[1]) + abs(p[2]),
        abs(p[3]) + abs(p[4]) + abs(p[5]),
        abs(p[6]) + abs(p[7]) + abs(p[8]) + abs(p[9]),
        abs(p[10]) + abs(p[11]) + abs(p[12]) + abs(p[13]) + abs(p[14]),
    )


@kernel
def _left(p: Model, q: Model) -> float:
    """Return a bound of what the polynomial of p q leaves."""
    a, b = _parts(p), _parts(q)
    q3 = b[3] + b[4]
    q2 = b[2] + q3
    q1 = b[1] + q2
    q0 = b[0] + q1
    p0 = a[0] + a[1] + a[2] + a[3] + a[4]
    high = a[1] * b[4] + a[2] * q3 + a[3] * q2 + a[4] * q1
    return (high + p[15] * (q0 + q[15]) + q[15] * p0 + p0 * q0 * PRODUCT + TINY) * UP


@kernel
def product(p: Model, q: Model) -> Model:
    """Return p q; terms of a higher degree are at most the products of the sizes."""
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, _e = p
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, _f = q
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
        _left(p, q),
    )


@kernel
def inverse(p: Model) -> Model:
    """Return 1/p, NaN if p may vanish.

    With p c = 1 - g for a double c and |g| <= G < 1 it is c (1 + g + ... + g^4 + r) with |r| <=
    G^5/(1 - G).
    """
    c = 1 / p[0]
    g = scaled(moved(scaled(p, c, 0.0), -1.0, 0.0), -1.0, 0.0)
    size = bound(g)
    if not size < NEAREST:
        return constant(math.nan, math.nan)
    square = product(g, g)
    r = product(moved(total(g, square), 1.0, 0.0), square)
    r = moved(total(g, r), 1.0, 0.0)
    s = size * size
    return scaled(widened(r, s * s * size / (1 - size) * UP), c, 0.0)


@kernel
def trigonometric(p: Model) -> tuple[Model, Model]:
    """Return the cosine and the sine of p.

    For the constant a of p and p = a + g, |g| <= G, those of g are their series up to g^4 and g^3,
    with remainders of at most G^6/6! and G^5/5!; then follow the formulas for sums.
    """
    s, c = sin_cos_of_double(p[0])
    g = centred(p, 0.0)
    size = bound(g)
    h = product(g, g)
    even = moved(product(moved(scaled(h, 1 / 24, RATIO), -0.5, 0.0), h), 1.0, 0.0)
    odd = product(moved(scaled(h, -1 / 6, RATIO), 1.0, 0.0), g)
    fifth = size * size * size * size * size
    even = widened(even, fifth * size / 720 * UP)
    odd = widened(odd, fifth / 120 * UP)
    cos = total(scaled(even, c, ANGLE), scaled(odd, -s, ANGLE))
    return cos, total(scaled(even, s, ANGLE), scaled(odd, c, ANGLE))


@kernel
def ends(p: Model) -> tuple[float, float]:
    """Return a lower and an upper bound of p; monomials that are squares are in [0, 1]."""
    spread = (
        p[15]
        + abs(p[1])
        + abs(p[2])
        + abs(p[4])
        + abs(p[6])
        + abs(p[7])
        + abs(p[8])
        + abs(p[9])
        + abs(p[11])
        + abs(p[13])
    )
    high = max(p[3], 0.0) + max(p[5], 0.0) + max(p[10], 0.0) + max(p[12], 0.0) + max(p[14], 0.0)
    low = min(p[3], 0.0) + min(p[5], 0.0) + min(p[10], 0.0) + min(p[12], 0.0) + min(p[14], 0.0)
    more = (abs(p[0]) + spread + high - low) * 2 * SUM + TINY
    return p[0] - (spread - low + more) * UP, p[0] + (spread + high + more) * UP


@kernel
def integral(p: Model) -> float:
    """Return a number that is at most the integral of p over [-1, 1]^2."""
    whole = p[0] + (p[3] + p[5]) / 3 + (p[10] + p[14]) / 5 + p[12] / 9
    return 4 * (whole - (p[15] + norm(p) * 4 * SUM) * UP)


@kernel
def part_below(p: Model, v: float) -> float:
    """Return a number that is at most the part of [-1, 1]^2 in which p < v.

    p is at most h + a X + b Y, h bounding all other terms; u >= w are the sizes of a and b, and d =
    v - h.  The part of the square where a X + b Y < d has two corners cut off, or one, or none.
    """
    u, w = max(abs(p[1]), abs(p[2])), min(abs(p[1]), abs(p[2]))
    z = 0.0
    h = ends(
        (
            p[0],
            z,
            z,
            p[3],
            p[4],
            p[5],
            p[6],
            p[7],
            p[8],
            p[9],
            p[10],
            p[11],
            p[12],
            p[13],
            p[14],
            p[15],
        )
    )[1]
    if u < FLAT:
        h, u, w = h + u + w, 0.0, 0.0
    if w < u * THIN:
        h, w = h + w, 0.0
    d = v - h - (abs(v) + abs(h) + u) * 2 * SUM
    corner = d + u + w
    if corner <= 0:
        return 0.0
    if d >= u + w:
        part = 1.0
    elif corner <= 2 * w:
        part = corner * corner / (8 * u * w)
    elif corner <= 2 * u:
        part = (d + u) / (2 * u)
    else:
        part = 1 - (u + w - d) * (u + w - d) / (8 * u * w)
    return max(0.0, part - THIN)


@kernel
def integral_below(density: Model, p: Model, v: float) -> float:
    """Return a number that is at most the integral of a density, not negative, over where p < v."""
    if ends(p)[1] < v:
        return max(0.0, integral(density))
    part, (least, most) = part_below(p, v), ends(density)
    if part == 0:
        return 0.0
    return max(4 * part * least / UP, integral(density) - 4 * (1 - part) * most * UP, 0.0)
