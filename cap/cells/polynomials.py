"""Compiled: polynomials in X and Y with a bound of what is left, over [-1, 1]^2.

A model of a quantity is 17 doubles: the coefficients, taken exactly, of

    1, Y, X, Y², XY, Y³, X², XY², Y⁴, X²Y, XY³, Y⁵, X³, X²Y², XY⁴, Y⁶,

the monomials X^i Y^j with 2 i + j <= 6 in the order of this weight, and e >= 0: at each (X, Y) the
quantity differs from the polynomial by at most e.  So X is thought of as small, of the size of Y².
Each operation keeps this true for the result; a NaN says nothing, and no comparison holds for it.

*Rounding* (`cap.sets.doubles`).  Let h = 2^-53.  A coefficient of a product is a sum of at most ten
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

UP = 1 + 2.0**-40
SUM, PRODUCT, TINY = 2.0**-51, 2.0**-49, 2.0**-900
ANGLE = 2.0**-50  # more than the error of a cosine or a sine of a double
RATIO = 2.0**-55  # more than the error of the doubles next to 1/6, 1/24, 1/120, 1/720
NEAREST = 0.6  # sizes of g for which 1/(1 - g) is expanded


@kernel
def norm(p: Model) -> float:
    """Return the sum of the sizes of the coefficients."""
    low = abs(p[0]) + abs(p[1]) + abs(p[2]) + abs(p[3]) + abs(p[4]) + abs(p[5]) + abs(p[6])
    high = abs(p[7]) + abs(p[8]) + abs(p[9]) + abs(p[10]) + abs(p[11])
    return low + high + (abs(p[12]) + abs(p[13]) + abs(p[14]) + abs(p[15]))


@kernel
def bound(p: Model) -> float:
    """Return a bound of |p|."""
    return (norm(p) + p[16]) * UP + TINY


@kernel
def constant(a: float, e: float) -> Model:
    """Return the model of a number within e of a."""
    return (a, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, e)


@kernel
def widened(p: Model, e: float) -> Model:
    """Return the model of what differs from p by at most e."""
    return (*p[:16], (p[16] + e) * UP)


@kernel
def exact(p: Model) -> Model:
    """Return the polynomial of a model."""
    return (*p[:16], 0.0)


@kernel
def centred(p: Model, a: float) -> Model:
    """Return p with another constant."""
    return (a, *p[1:])


@kernel
def moved(p: Model, a: float, e: float) -> Model:
    """Return p plus a number within e of a."""
    c = p[0] + a
    return (c, *p[1:16], (p[16] + e + abs(c) * SUM) * UP)


@kernel
def total(p: Model, q: Model) -> Model:
    """Return p + q."""
    r = (
        *(p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3], p[4] + q[4], p[5] + q[5]),
        *(p[6] + q[6], p[7] + q[7], p[8] + q[8], p[9] + q[9], p[10] + q[10], p[11] + q[11]),
        *(p[12] + q[12], p[13] + q[13], p[14] + q[14], p[15] + q[15], p[16] + q[16]),
    )
    return (*r[:16], (r[16] + norm(r) * SUM) * UP)


@kernel
def scaled(p: Model, c: float, d: float) -> Model:
    """Return p times a number within d of c."""
    return (
        *(p[0] * c, p[1] * c, p[2] * c, p[3] * c, p[4] * c, p[5] * c, p[6] * c, p[7] * c),
        *(p[8] * c, p[9] * c, p[10] * c, p[11] * c, p[12] * c, p[13] * c, p[14] * c, p[15] * c),
        (norm(p) * (abs(c) * SUM + d) + p[16] * (abs(c) + d) + TINY) * UP,
    )


@kernel
def _parts(p: Model) -> tuple[float, float, float, float, float, float, float]:
    """Return the sums of the sizes of the coefficients of the weights 0 to 6."""
    return (
        abs(p[0]),
        abs(p[1]),
        abs(p[2]) + abs(p[3]),
        abs(p[4]) + abs(p[5]),
        abs(p[6]) + abs(p[7]) + abs(p[8]),
        abs(p[9]) + abs(p[10]) + abs(p[11]),
        abs(p[12]) + abs(p[13]) + abs(p[14]) + abs(p[15]),
    )


@kernel
def _left(p: Model, q: Model) -> float:
    """Return a bound of what the polynomial of p q leaves."""
    a, b = _parts(p), _parts(q)
    q5 = b[5] + b[6]
    q4 = b[4] + q5
    q3 = b[3] + q4
    q2 = b[2] + q3
    q1 = b[1] + q2
    q0 = b[0] + q1
    p0 = a[0] + a[1] + a[2] + a[3] + a[4] + a[5] + a[6]
    heavy = a[1] * b[6] + a[2] * q5 + a[3] * q4 + a[4] * q3 + a[5] * q2 + a[6] * q1
    return (heavy + p[16] * (q0 + q[16]) + q[16] * p0 + p0 * q0 * PRODUCT + TINY) * UP


@kernel
def product(p: Model, q: Model) -> Model:
    """Return p q; terms of a weight above 6 are at most the products of the sizes."""
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, _e = p
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, _f = q
    x2y2 = a0 * b13 + a1 * b9 + a2 * b7 + a3 * b6 + a4 * b4
    xy4 = a0 * b14 + a1 * b10 + a2 * b8 + a3 * b7 + a4 * b5
    y6 = a0 * b15 + a1 * b11 + a3 * b8 + a5 * b5
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
        x2y2 + a6 * b3 + a7 * b2 + a9 * b1 + a13 * b0,
        xy4 + a5 * b4 + a7 * b3 + a8 * b2 + a10 * b1 + a14 * b0,
        y6 + a8 * b3 + a11 * b1 + a15 * b0,
        _left(p, q),
    )


@kernel
def inverse(p: Model) -> Model:
    """Return 1/p, NaN if p may vanish.

    With p c = 1 - g for a double c and |g| <= G < 1 it is c (1 + g + ... + g^6 + r) with |r| <=
    G^7/(1 - G).
    """
    c = 1 / p[0]
    g = scaled(moved(scaled(p, c, 0.0), -1.0, 0.0), -1.0, 0.0)
    size = bound(g)
    if not size < NEAREST:
        return constant(math.nan, math.nan)
    square = product(g, g)
    r = product(moved(g, 1.0, 0.0), moved(square, 1.0, 0.0))
    fourth = product(square, square)
    r = total(r, product(fourth, moved(total(g, square), 1.0, 0.0)))
    s = size * size
    return scaled(widened(r, s * s * s * size / (1 - size) * UP), c, 0.0)


@kernel
def trigonometric(p: Model) -> tuple[Model, Model]:
    """Return the cosine and the sine of p.

    For the constant a of p and p = a + g, |g| <= G, those of g are their series up to g^6 and g^5,
    with remainders of at most G^8/8! and G^7/7!; then follow the formulas for sums.
    """
    s, c = sin_cos_of_double(p[0])
    g = centred(p, 0.0)
    size = bound(g)
    h = product(g, g)
    even = moved(scaled(h, -1 / 720, RATIO), 1 / 24, RATIO)
    even = moved(product(moved(product(even, h), -0.5, 0.0), h), 1.0, 0.0)
    odd = moved(scaled(h, 1 / 120, RATIO), -1 / 6, RATIO)
    odd = product(moved(product(odd, h), 1.0, 0.0), g)
    sixth = size * size * size * size * size * size
    even = widened(even, sixth * size * size / 40320 * UP)
    odd = widened(odd, sixth * size / 5040 * UP)
    cos = total(scaled(even, c, ANGLE), scaled(odd, -s, ANGLE))
    return cos, total(scaled(even, s, ANGLE), scaled(odd, c, ANGLE))


@kernel
def ends(p: Model) -> tuple[float, float]:
    """Return a lower and an upper bound of p; monomials that are squares are in [0, 1]."""
    mixed = abs(p[4]) + abs(p[5]) + abs(p[7]) + abs(p[9]) + abs(p[10]) + abs(p[11])
    spread = p[16] + abs(p[1]) + abs(p[2]) + mixed + abs(p[12]) + abs(p[14])
    high = max(p[3], 0.0) + max(p[6], 0.0) + max(p[8], 0.0) + max(p[13], 0.0) + max(p[15], 0.0)
    low = min(p[3], 0.0) + min(p[6], 0.0) + min(p[8], 0.0) + min(p[13], 0.0) + min(p[15], 0.0)
    more = (abs(p[0]) + spread + high - low) * 2 * SUM + TINY
    return p[0] - (spread - low + more) * UP, p[0] + (spread + high + more) * UP


@kernel
def integral(p: Model) -> float:
    """Return a number that is at most the integral of p over [-1, 1]^2."""
    whole = p[0] + (p[3] + p[6]) / 3 + p[8] / 5 + p[13] / 9 + p[15] / 7
    return 4 * (whole - (p[16] + norm(p) * 4 * SUM) * UP)
