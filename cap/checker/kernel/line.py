"""Models in one variable, in doubles: a polynomial in X, and a bound of what is left, as a C^1 map.

A model (c, e) of a function f over [-1, 1] says that f = c_0 + c_1 X + ... + c_n X^n + r, with r
continuously differentiable and |r| <= e in the norm

    |r| = sup |r| + sup |r'|/4.

The coefficients are doubles, taken exactly.  With this norm the functions are an algebra, |r s| <=
|r| |s|, and |1| = 1; X^k has the norm 1 + k/4 =: w_k, and w_(i+j) <= w_i w_j.  So |c| = the sum of
w_k |c_k| bounds the norm of a polynomial, and power series of functions converge as those of their
norms.  Each operation keeps the statement true for the result.

*Rounding* is as in ``angles``: a coefficient of a sum is wrong by at most h = 2^-53 of itself,
one of a product, a sum of at most n + 1 products, by at most (n + 2) h times the sum of their
sizes: together, by at most (n + 2) h |p| |q|.  As n <= 8, `_ROUND` = 2^-48 is more than 3 times
(n + 2) h.  Bounds are sums and products of numbers that are not negative, too small by less than
2^-43 of themselves; `_UP` = 1 + 2^-40 makes up for that, `_TINY` for underflow.

*Cosine and sine* of a + g, g a polynomial with g(0) = 0.  Let Z = C + i S be a polynomial with Z(0)
next to e^(ia), and Z' = i g' Z + q.  Then (Z e^(-ig))' = q e^(-ig), so Z differs from e^(ia + ig)
by at most E = |Z(0) - e^(ia)| + int_0^1 |q|, and its derivative by at most sup |q| + sup |g'| E.
The coefficients of Z are computed such that those of q vanish below degree n, but for rounding;
from there on, they are products of those of g' and Z, with int_0^1 X^k <= 1/(n + 1).  If a function
r with |r| = d <= 1 is added to g, |cos(a + g + r) - cos(a + g)| <= |cos(a + g)| (cosh d - 1) +
|sin(a + g)| sinh d <= 1.2 d (|cos(a + g)| + |sin(a + g)|), and so for the sine.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from math import comb
from operator import add, mul

from cap.checker.kernel.angles import cos_sin
from cap.checker.kernel.rejection import need

Coefficients = tuple[float, ...]
Line = tuple[Coefficients, float]

DEGREE = 6
_UP, _ROUND, _TINY = 1 + 2.0**-40, 2.0**-48, 2.0**-900
_WEIGHTS = tuple(1 + k / 4 for k in range(DEGREE + 1))
_ORDERS = tuple(range(DEGREE + 1))
_ZEROS = (0.0,) * DEGREE
DEGREES = _ORDERS
_BINOMIALS = [[float(comb(n, k)) for k in _ORDERS] for n in _ORDERS]
PARTS = [(k, k, k + 1) for k in _ORDERS[1:]]
BEND = 1.2  # of a cosine and a sine, at most, for each unit of the norms of both


def constant(a: float, e: float = 0.0) -> Line:
    """Return the model of a number within e of a double."""
    return (a, *_ZEROS), e


def across(ends: tuple[float, float]) -> Line:
    """Return the model of all numbers from one end of an interval to the other."""
    mid, rad = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
    return (mid, rad, *_ZEROS[1:]), (abs(ends[0]) + abs(ends[1])) * _ROUND


def norm(c: Coefficients) -> float:
    """Return a bound of the norm of a polynomial."""
    a0, a1, a2, a3, a4, a5, a6 = map(abs, c)
    norm = a0 + 1.25 * a1 + 1.5 * a2 + 1.75 * a3 + 2 * a4 + 2.25 * a5 + 2.5 * a6
    return norm * _UP + _TINY


def size(p: Line) -> float:
    """Return a bound of the norm of p."""
    return (norm(p[0]) + p[1]) * _UP


def rest(p: Line) -> float:
    """Return a bound of the norm of p - c_0."""
    return (norm((0.0, *p[0][1:])) + p[1]) * _UP


def first(p: Line) -> float:
    """Return the constant coefficient."""
    return p[0][0]


def error(p: Line) -> float:
    """Return the bound of what is left."""
    return p[1]


def exact(p: Line) -> Line:
    """Return the polynomial of a model."""
    return p[0], 0.0


def with_constant(p: Line, c: float) -> Line:
    """Return p with another constant coefficient."""
    return (c, *p[0][1:]), p[1]


def ball(p: Line) -> tuple[float, float]:
    """Return a number, and a bound of the norm of its difference from p."""
    return p[0][0], rest(p)


def bend(cos: Line, sin: Line) -> float:
    """Return a bound of the change of a cosine and a sine, per change of the angle, if <= 1."""
    return BEND * (size(cos) + size(sin)) * _UP


def root(slope: Line, bend: float, left: float, left_all: float) -> tuple[float, float]:
    """Return how far T_0 is from a zero T of F, by the lemma of `cap.checker.folded.events`.

    ``slope`` is F' at T_0, positive, which changes by ``bend`` per time; ``left`` bounds F(T_0),
    without and with the errors of F.
    """
    m = slope[0][0]
    need(m > 0, "the time of an event is not certain")
    e, e_all = 2 * left / m * _UP, 2 * left_all / m * _UP
    certain = e_all <= 1 and (rest(slope) + bend * e_all) * _UP <= m / 2
    need(certain, "the time of an event is not certain")
    return e, e_all


def widened(p: Line, e: float) -> Line:
    """Return the model of what differs from p by at most e in the norm."""
    return p[0], (p[1] + e) * _UP


def moved(p: Line, a: float, e: float) -> Line:
    """Return p plus a number within e of a."""
    c = p[0][0] + a
    return (c, *p[0][1:]), (p[1] + e + abs(c) * _ROUND) * _UP


def scaled(p: Line, a: float, e: float = 0.0) -> Line:
    """Return p times a number within e of a."""
    c, d = p
    more = norm(c) * (abs(a) * _ROUND + e) + d * (abs(a) + e)
    return tuple([a * z for z in c]), (more + _TINY) * _UP


def total(p: Line, q: Line) -> Line:
    """Return p + q."""
    c = tuple(map(add, p[0], q[0]))
    return c, (p[1] + q[1] + norm(c) * _ROUND) * _UP


def product(p: Line, q: Line) -> Line:
    """Return p q; terms of a degree above n go into the error."""
    (a, e), (b, f) = p, q
    a0, a1, a2, a3, a4, a5, a6 = a
    b0, b1, b2, b3, b4, b5, b6 = b
    c = (
        a0 * b0,
        a0 * b1 + a1 * b0,
        a0 * b2 + a1 * b1 + a2 * b0,
        a0 * b3 + a1 * b2 + a2 * b1 + a3 * b0,
        a0 * b4 + a1 * b3 + a2 * b2 + a3 * b1 + a4 * b0,
        a0 * b5 + a1 * b4 + a2 * b3 + a3 * b2 + a4 * b1 + a5 * b0,
        a0 * b6 + a1 * b5 + a2 * b4 + a3 * b3 + a4 * b2 + a5 * b1 + a6 * b0,
    )
    left, right = list(map(mul, map(abs, a), _WEIGHTS)), list(map(mul, map(abs, b), _WEIGHTS))
    ends = list(accumulate(right[::-1]))  # of the last coefficients
    tail = sum(map(mul, left[1:], ends))
    x, y = sum(left), ends[-1]
    return c, (tail + e * (y + f) + f * x + x * y * _ROUND + _TINY) * _UP


def ends(p: Line) -> tuple[float, float]:
    """Return a lower and an upper bound of p."""
    c, e = p
    spread = sum(map(abs, c)) - abs(c[0]) + e
    more = (abs(c[0]) + spread) * _ROUND + _TINY
    return c[0] - (spread + more) * _UP, c[0] + (spread + more) * _UP


def trigonometric(p: Line) -> tuple[Line, Line]:
    """Return the cosine and the sine of the polynomial of p."""
    c = p[0]
    C, S = waves(c)
    slopes = list(map(mul, map(abs, c[1:]), _ORDERS[1:]))  # of degrees 0 to n - 1
    sizes = [abs(a) + abs(b) for a, b in zip(C, S, strict=True)]
    last = list(accumulate(sizes[::-1]))  # of degrees n, n and n - 1, ...
    tail, steep = sum(map(mul, slopes, last)), sum(slopes)
    noise = (1 + steep * last[-1]) * _ROUND
    e = noise + tail / (DEGREE + 1)
    e = (e + (tail + noise + steep * e) / 4) * _UP + _TINY
    return (C, e), (S, e)


def waves(c: Coefficients) -> tuple[Coefficients, Coefficients]:
    """Return the first coefficients of the cosine and the sine of a polynomial, nearly."""
    cos, sin = cos_sin(c[0])
    C, S = [cos], [sin]
    slopes = list(map(mul, c[1:], _ORDERS[1:]))
    for k in _ORDERS[1:]:
        past = slopes[k - 1 :: -1]
        C.append(-sum(map(mul, past, S)) / k)
        S.append(sum(map(mul, past, C)) / k)
    return tuple(C), tuple(S)


def coefficients(p: Line) -> Coefficients:
    """Return the coefficients of the polynomial."""
    return p[0]


def of_coefficients(c: Sequence[float]) -> Line:
    """Return a polynomial."""
    return tuple(c), 0.0


def part(w: int, f: Sequence[float], g: Sequence[float]) -> tuple[float]:
    """Return the term of degree w of f g, for f without a constant."""
    return (sum(map(mul, f[1 : w + 1], g[w - 1 :: -1])),)


def half(p: Line, side: float) -> Line:
    """Return p on [-1, 0] or [0, 1], for the side -1 or 1, as a function on [-1, 1]."""
    c, e = p
    found, scale = list[float](), 1.0
    for k in _ORDERS:
        signs, more = 1.0, 0.0
        for j in range(k, DEGREE + 1):
            more += c[j] * _BINOMIALS[j][k] * signs * 0.5 ** (j - k)
            signs *= side
        found.append(more * scale)
        scale /= 2
    return tuple(found), (e + sum(map(abs, c)) * 8 * _ROUND) * _UP


def slopes(p: Line, steep: float | None = None) -> tuple[float, float]:
    """Return a lower and an upper bound of the derivative of p.

    ``steep`` bounds that of what is left, if it is known to be less than 4 e.
    """
    c, e = p
    bends = sum(map(mul, map(abs, c[2:]), _ORDERS[2:])) + (4 * e if steep is None else steep)
    more = (bends + abs(c[1])) * _ROUND + _TINY
    return c[1] - (bends + more) * _UP, c[1] + (bends + more) * _UP


def at_ends(p: Line) -> tuple[float, float]:
    """Return p at X = -1 and at X = 1, but for the error and rounding (`blur`)."""
    even, odd = sum(p[0][::2]), sum(p[0][1::2])
    return even - odd, even + odd


def blur(p: Line) -> float:
    """Return a bound of what is wrong with `at_ends`."""
    return (p[1] + sum(map(abs, p[0])) * 2 * _ROUND) * _UP + _TINY
