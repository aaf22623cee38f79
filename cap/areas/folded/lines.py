"""Compiled: polynomials in X with a bound of what is left, over [-1, 1], as C¹ maps.

A model of a function f is 8 doubles, c_0, ..., c_6 and e >= 0: f = c_0 + ... + c_6 X⁶ + r, the
coefficients taken exactly, r continuously differentiable, and |r| <= e in the norm

    |r| = sup |r| + sup |r'|/4.

In it |r s| <= |r| |s|, |1| = 1, and X^k has the norm 1 + k/4.  Each operation keeps what a model
says true for the result; a NaN says nothing, and no comparison holds for it.

*Rounding* is as in `cap.areas.folded.polynomials`: with h = 2^-53, a coefficient of a product, a
sum of at most seven products, is wrong by at most 8 h times the sum of their sizes, so all of them
by 8 h |p| |q| in the norm, and less for other operations: `NOISE` = 2^-48 is more than 3 times
that.

*Cosine and sine* of a + g, g(0) = 0, by series Z = C + i S.  With Z' = i g' Z + q, (Z e^(-ig))' = q
e^(-ig): so Z is wrong by at most E = |Z(0) - e^(ia)| + int_0^1 |q|, and Z' by sup |q| + sup |g'| E.
q has the terms of a degree of 6 and more of -i g' Z, and rounding; int_0^1 X^k <= 1/7 for them.
"""

from cap.areas.folded.polynomials import TINY, UP
from cap.sets.circular import sin_cos_of_double
from cap.sets.compiled import kernel

Line = tuple[float, ...]

NOISE = 2.0**-48
BEND = 1.2  # of a cosine and a sine, at most, for each unit of the norms of both


@kernel
def constant(a: float, e: float) -> Line:
    """Return the model of a number within e of a."""
    return (a, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, e)


@kernel
def across(low: float, high: float) -> Line:
    """Return the model of all numbers from one to another."""
    noise = (abs(low) + abs(high)) * NOISE
    return (0.5 * (low + high), 0.5 * (high - low), 0.0, 0.0, 0.0, 0.0, 0.0, noise)


@kernel
def _variation(p: Line) -> float:
    """Return the norm of the polynomial without its constant."""
    low = 1.25 * abs(p[1]) + 1.5 * abs(p[2]) + 1.75 * abs(p[3])
    return low + 2.0 * abs(p[4]) + 2.25 * abs(p[5]) + 2.5 * abs(p[6])


@kernel
def size(p: Line) -> float:
    """Return a bound of the norm of the polynomial."""
    return (abs(p[0]) + _variation(p)) * UP + TINY


@kernel
def bound(p: Line) -> float:
    """Return a bound of the norm of p."""
    return (size(p) + p[7]) * UP


@kernel
def rest(p: Line) -> float:
    """Return a bound of the norm of p - c_0."""
    return (_variation(p) * UP + TINY + p[7]) * UP


@kernel
def exact(p: Line) -> Line:
    """Return the polynomial of a model."""
    return (p[0], p[1], p[2], p[3], p[4], p[5], p[6], 0.0)


@kernel
def centred(p: Line, a: float) -> Line:
    """Return p with another constant."""
    return (a, p[1], p[2], p[3], p[4], p[5], p[6], p[7])


@kernel
def widened(p: Line, e: float) -> Line:
    """Return the model of what differs from p by at most e in the norm."""
    return (p[0], p[1], p[2], p[3], p[4], p[5], p[6], (p[7] + e) * UP)


@kernel
def moved(p: Line, a: float, e: float) -> Line:
    """Return p plus a number within e of a."""
    c = p[0] + a
    return (c, p[1], p[2], p[3], p[4], p[5], p[6], (p[7] + e + abs(c) * NOISE) * UP)


@kernel
def scaled(p: Line, a: float, e: float) -> Line:
    """Return p times a number within e of a."""
    more = (size(p) * (abs(a) * NOISE + e) + p[7] * (abs(a) + e) + TINY) * UP
    low = p[0] * a, p[1] * a, p[2] * a, p[3] * a
    return (*low, p[4] * a, p[5] * a, p[6] * a, more)


@kernel
def total(p: Line, q: Line) -> Line:
    """Return p + q."""
    low = p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]
    r = (*low, p[4] + q[4], p[5] + q[5], p[6] + q[6], p[7] + q[7])
    return widened(r, size(r) * NOISE)


@kernel
def _left(p: Line, q: Line) -> float:
    """Return a bound of what the polynomial of p q leaves."""
    b6 = 2.5 * abs(q[6])
    b5 = 2.25 * abs(q[5]) + b6
    b4 = 2.0 * abs(q[4]) + b5
    b3 = 1.75 * abs(q[3]) + b4
    b2 = 1.5 * abs(q[2]) + b3
    b1 = 1.25 * abs(q[1]) + b2
    high = 1.25 * abs(p[1]) * b6 + 1.5 * abs(p[2]) * b5 + 1.75 * abs(p[3]) * b4
    high += 2.0 * abs(p[4]) * b3 + 2.25 * abs(p[5]) * b2 + 2.5 * abs(p[6]) * b1
    x, y = abs(p[0]) + _variation(p), abs(q[0]) + b1
    return (high + p[7] * (y + q[7]) + q[7] * x + x * y * NOISE + TINY) * UP


@kernel
def product(p: Line, q: Line) -> Line:
    """Return p q; terms of a degree above 6 go into the error."""
    a0, a1, a2, a3, a4, a5, a6, _e = p
    b0, b1, b2, b3, b4, b5, b6, _f = q
    return (
        a0 * b0,
        a0 * b1 + a1 * b0,
        a0 * b2 + a1 * b1 + a2 * b0,
        a0 * b3 + a1 * b2 + a2 * b1 + a3 * b0,
        a0 * b4 + a1 * b3 + a2 * b2 + a3 * b1 + a4 * b0,
        a0 * b5 + a1 * b4 + a2 * b3 + a3 * b2 + a4 * b1 + a5 * b0,
        a0 * b6 + a1 * b5 + a2 * b4 + a3 * b3 + a4 * b2 + a5 * b1 + a6 * b0,
        _left(p, q),
    )


@kernel
def ends(p: Line) -> tuple[float, float]:
    """Return a lower and an upper bound of p."""
    spread = abs(p[1]) + abs(p[2]) + abs(p[3]) + abs(p[4]) + abs(p[5]) + abs(p[6]) + p[7]
    far = (spread + (abs(p[0]) + spread) * NOISE + TINY) * UP
    return p[0] - far, p[0] + far


@kernel
def _series(p: Line) -> tuple[Line, Line]:
    """Return the first coefficients of the cosine and the sine of a polynomial, nearly."""
    a, b, c, d, e, f = p[1], 2 * p[2], 3 * p[3], 4 * p[4], 5 * p[5], 6 * p[6]
    S0, C0 = sin_cos_of_double(p[0])
    C1, S1 = -a * S0, a * C0
    C2, S2 = -(b * S0 + a * S1) / 2, (b * C0 + a * C1) / 2
    C3, S3 = -(c * S0 + b * S1 + a * S2) / 3, (c * C0 + b * C1 + a * C2) / 3
    C4 = -(d * S0 + c * S1 + b * S2 + a * S3) / 4
    S4 = (d * C0 + c * C1 + b * C2 + a * C3) / 4
    C5 = -(e * S0 + d * S1 + c * S2 + b * S3 + a * S4) / 5
    S5 = (e * C0 + d * C1 + c * C2 + b * C3 + a * C4) / 5
    C6 = -(f * S0 + e * S1 + d * S2 + c * S3 + b * S4 + a * S5) / 6
    S6 = (f * C0 + e * C1 + d * C2 + c * C3 + b * C4 + a * C5) / 6
    return (C0, C1, C2, C3, C4, C5, C6, 0.0), (S0, S1, S2, S3, S4, S5, S6, 0.0)


@kernel
def trigonometric(p: Line) -> tuple[Line, Line]:
    """Return the cosine and the sine of a polynomial, p without its error."""
    C, S = _series(p)
    z6 = abs(C[6]) + abs(S[6])
    z5 = abs(C[5]) + abs(S[5]) + z6
    z4 = abs(C[4]) + abs(S[4]) + z5
    z3 = abs(C[3]) + abs(S[3]) + z4
    z2 = abs(C[2]) + abs(S[2]) + z3
    z1 = abs(C[1]) + abs(S[1]) + z2
    whole = abs(C[0]) + abs(S[0]) + z1
    a, b, c = abs(p[1]), 2 * abs(p[2]), 3 * abs(p[3])
    d, e, f = 4 * abs(p[4]), 5 * abs(p[5]), 6 * abs(p[6])
    tail = a * z6 + b * z5 + c * z4 + d * z3 + e * z2 + f * z1
    steep = a + b + c + d + e + f
    noise = (1 + steep * whole) * NOISE
    wrong = noise + tail / 7
    wrong = (wrong + (tail + noise + steep * wrong) / 4) * UP + TINY
    return widened(C, wrong), widened(S, wrong)
