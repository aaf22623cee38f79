"""Real functions on the circle: a trigonometric polynomial, exactly, and an error in a norm.

u(theta) = sum of u_k exp(ik theta), u_(-k) the conjugate of u_k;  |u| = sum of |u_k| exp(rho |k|).
With this norm |uw| <= |u| |w|, and |u(theta)| <= |u| for real theta.  A ``Function`` is the set of
all u, real or complex, with |u - p| <= error; p has coefficients of 0..degree, complex integers in
units 10^-places, and the error is an integer in this unit.  All bounds grow with rho: so the same
numbers are bounds for each smaller rho.

*Products* by Kronecker's substitution: with X = 10^w, larger than twice each coefficient of the
product, polynomials are their values at X, decimal numbers whose digits are the coefficients one
after the other; ``decimal`` multiplies large numbers fast, and exactly (it raises if it cannot).

*Rounding.*  A coefficient is rounded by less than 1 in both parts together, so the error grows by
at most ``grain`` = the sum of exp(rho |k|) over |k| <= degree.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import MAX_EMAX, MAX_PREC, MIN_EMIN, Context, Decimal, Inexact, Rounded
from fractions import Fraction
from functools import cached_property
from math import isqrt

from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.exponential import exp
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

EXACTLY = Context(prec=MAX_PREC, Emax=MAX_EMAX, Emin=MIN_EMIN, traps=[Inexact, Rounded])
FINE = 10**20  # the unit of weights


def ceiling(a: int, b: int) -> int:
    """Return the least integer at least a/b."""
    return -(-a // b)


class Circle:
    """The degree, rho of the norm, and the unit."""

    def __init__(self, degree: int, rho: Fraction, places: int) -> None:
        self.degree, self.rho, self.unit = degree, rho, 10**places
        self.bits = places * 10 // 3 + 32  # of intervals that are as sharp as coefficients
        growth = exp(rho).upper
        step, weight = ceiling(growth.numerator * FINE, growth.denominator), FINE
        self.weights = list[int]()  # above exp(rho k) FINE, k <= 2 degree
        for _ in range(2 * degree + 1):
            self.weights.append(weight)
            weight = ceiling(weight * step, FINE)
        self.grain = ceiling(2 * sum(self.weights[: degree + 1]), FINE)

    def constant(self, c: Interval | int) -> Function:
        """Return a constant function."""
        if isinstance(c, int):
            return Function(self, [(c * self.unit, 0)], 0)
        middle, error = self.near(c)
        return Function(self, [(middle, 0)], error)

    def near(self, c: Interval) -> tuple[int, int]:
        """Return a number of units, and how far from it the numbers of an interval may be."""
        low, high = c.lo * self.unit >> c.bits, -(-c.hi * self.unit >> c.bits)
        middle = (low + high) // 2
        return middle, max(high - middle, middle - low)

    def above(self, q: Fraction) -> int:
        """Return an integer of units at least q."""
        return ceiling(q.numerator * self.unit, q.denominator)


Coefficients = list[tuple[int, int]]


class Function:
    """The functions u with |u - p| <= error."""

    def __init__(self, circle: Circle, coefficients: Coefficients, error: int) -> None:
        n = circle.degree
        need(len(coefficients) <= n + 1 and error >= 0, "a function has too many coefficients")
        self.circle, self.error = circle, error
        self.coefficients = coefficients + [(0, 0)] * (n + 1 - len(coefficients))

    @cached_property
    def sizes(self) -> list[int]:
        """Bounds of the |p_k|."""
        return [isqrt(re * re + im * im) + 1 for re, im in self.coefficients]

    @cached_property
    def size(self) -> int:
        """A bound of |p|."""
        sizes, weights = self.sizes, self.circle.weights
        terms = sum(s * w for s, w in zip(sizes, weights, strict=False))
        return ceiling(2 * terms - sizes[0] * weights[0], FINE)

    @property
    def norm(self) -> int:
        """A bound of |u| for all functions."""
        return self.size + self.error

    @property
    def swing(self) -> int:
        """A bound of |p(theta) - p_0| for real theta."""
        return 2 * sum(self.sizes[1:])

    @property
    def mean(self) -> int:
        """p_0."""
        return self.coefficients[0][0]

    def with_error(self, error: int) -> Function:
        """Return the same polynomial with another error."""
        return Function(self.circle, self.coefficients, error)

    def __add__(self, other: Function | int) -> Function:
        other = self.circle.constant(other) if isinstance(other, int) else other
        pairs = zip(self.coefficients, other.coefficients, strict=True)
        sums = [(a + c, b + d) for (a, b), (c, d) in pairs]
        return Function(self.circle, sums, self.error + other.error)

    def __neg__(self) -> Function:
        return Function(self.circle, [(-a, -b) for a, b in self.coefficients], self.error)

    def __sub__(self, other: Function | int) -> Function:
        return self + -other

    def __mul__(self, other: Function | Interval | int) -> Function:
        if isinstance(other, int):
            products = [(a * other, b * other) for a, b in self.coefficients]
            return Function(self.circle, products, self.error * abs(other))
        circle, unit = self.circle, self.circle.unit
        if isinstance(other, Interval):
            middle, radius = circle.near(other)
            products = [(a * middle // unit, b * middle // unit) for a, b in self.coefficients]
            error = self.error * abs(middle) + self.norm * radius
            return Function(circle, products, ceiling(error, unit) + 2 * circle.grain)
        whole = product(self.coefficients, other.coefficients)
        kept = [
            ((re + unit // 2) // unit, (im + unit // 2) // unit)
            for re, im in whole[: circle.degree + 1]
        ]
        beyond = zip(whole[circle.degree + 1 :], circle.weights[circle.degree + 1 :], strict=True)
        dropped = sum((isqrt(re * re + im * im) + 1) * w for (re, im), w in beyond)
        e, f = self.error, other.error
        mixed = (e * other.norm if e else 0) + (f * self.size if f else 0)
        error = ceiling(2 * dropped, unit * FINE) + ceiling(mixed, unit) + circle.grain
        return Function(circle, kept, error)

    def divided(self, n: int) -> Function:
        """Return u/n for an integer n > 0."""
        quotients = [(a // n, b // n) for a, b in self.coefficients]
        return Function(self.circle, quotients, ceiling(self.error, n) + 2 * self.circle.grain)

    def derivative(self) -> Function:
        """Return the derivative of a polynomial; of what has an error nothing is known."""
        need(self.error == 0, "a derivative of a function that is known up to an error")
        parts = [(-k * b, k * a) for k, (a, b) in enumerate(self.coefficients)]
        return Function(self.circle, parts, 0)

    def inverse_near(self, v: Function) -> Function:
        """Return 1/u: if |1 - uv| <= z < 1, it differs from v by at most |v| z/(1 - z)."""
        v, unit = v.with_error(0), self.circle.unit
        z = (self * v - 1).norm
        need(z < unit, "a function may vanish")
        return v.with_error(ceiling(v.size * z, unit - z))

    def cos_sin(self) -> tuple[Function, Function]:
        """Return cosine and sine.

        (p - p_0)/2^m has norm at most 1/4; Taylor polynomials there; then doubled m times; then p_0
        is added.
        """
        circle, unit = self.circle, self.circle.unit
        rest, m = Function(circle, [(0, 0), *self.coefficients[1:]], 0), 0
        while 4 * rest.norm > unit << m:
            m += 1
            need(m < 64, "a function is too large for its sine")
        cos, sin = taylor(rest.divided(1 << m))
        for _ in range(m):
            cos, sin = sin * sin * -2 + 1, sin * cos * 2
        mean = Fraction(self.mean, unit)
        c, s = cos_sin(Interval.enclosing(mean, mean, circle.bits))
        return moved((cos * c - sin * s, sin * c + cos * s), self.error)


def taylor(h: Function) -> tuple[Function, Function]:
    """Return cosine and sine of h, |h| <= 1/4, by Horner's rule in h^2.

    After the terms of degree below n, n even, they differ from the polynomials by at most |h|^n
    cosh|h|/n! <= 2 (1/4)^n/n!.
    """
    unit, n, left = h.circle.unit, 0, Fraction(2)
    while left * unit > 1:
        left /= 16 * (n + 1) * (n + 2)
        n += 2
    square = h * h
    one = h.circle.constant(1)
    cos = sin = one
    for k in range(n, 0, -2):
        cos = one - (square * cos).divided((k - 1) * k)
        sin = one - (square * sin).divided(k * (k + 1))
    sin = h * sin
    return cos.with_error(cos.error + 1), sin.with_error(sin.error + 1)


def moved(both: tuple[Function, Function], e: int) -> tuple[Function, Function]:
    """Return cos(u + h) and sin(u + h) for |h| <= e <= 1.

    cos h - 1 is at most cosh e - 1 <= 0.55 e^2, and sin h at most sinh e <= e + 0.18 e^3.
    """
    cos, sin = both
    unit = cos.circle.unit
    need(e <= unit, "the error of an angle is larger than 1")
    a = ceiling(11 * e * e, 20 * unit)
    b = e + ceiling(9 * e**3, 50 * unit**2)
    change = [ceiling(f.norm * a + g.norm * b, unit) for f, g in (both, both[::-1])]
    return cos.with_error(cos.error + change[0]), sin.with_error(sin.error + change[1])


def root(
    guess: Function, value: Function, slope: Callable[[int], Function], inverse: Function
) -> Function:
    """Return the root t near a guess p of g(t) = 0, where g(p) = ``value``.

    ``slope(R)`` has g'(t) for |t - p| <= R.  With Y = |A g(p)|, R = 2Y, and |1 - A g'| <= z <= 1/2
    on this ball, t -> t - A g(t) contracts it into itself; so |t - p| <= Y/(1 - z).
    """
    A, unit = inverse.with_error(0), guess.circle.unit
    Y = (A * value).norm
    z = (A * slope(2 * Y) - 1).norm
    need(2 * z <= unit, "an implicit equation has no contraction")
    return guess.with_error(ceiling(Y * unit, unit - z))


def product(u: Coefficients, w: Coefficients) -> Coefficients:
    """Return the coefficients of 0, 1, 2, ... of the product of two real functions, exactly."""
    n = len(u) - 1
    a, b, c, d = (both_sides(p, part) for p in (u, w) for part in (0, 1))
    most = [max(map(abs, seq)) for seq in (a, b, c, d)]
    largest = (2 * n + 1) * (most[0] + most[1]) * (most[2] + most[3])
    width = len(str(4 * max(largest, *most))) + 1
    A, B, C, D = (packed(seq, width) for seq in (a, b, c, d))
    times, count = EXACTLY.multiply, 4 * n + 1
    even, odd = times(A, C), times(B, D)
    cross = EXACTLY.subtract(times(EXACTLY.add(A, B), EXACTLY.add(C, D)), EXACTLY.add(even, odd))
    re = unpacked(EXACTLY.subtract(even, odd), width, count)
    im = unpacked(cross, width, count)
    return list(zip(re[2 * n :], im[2 * n :], strict=True))


def both_sides(p: Coefficients, part: int) -> list[int]:
    """Return real or imaginary parts of the coefficients of -n..n."""
    values = [c[part] for c in p]
    sign = -1 if part else 1
    return [sign * value for value in reversed(values[1:])] + values


def packed(values: Sequence[int], width: int) -> Decimal:
    """Return the sum of values[j] X^j, X = 10^width."""
    above = "".join(f"{max(value, 0):0{width}d}" for value in reversed(values))
    below = "".join(f"{max(-value, 0):0{width}d}" for value in reversed(values))
    return EXACTLY.subtract(Decimal(above), Decimal(below))


def unpacked(number: Decimal, width: int, count: int) -> list[int]:
    """Return the values, each less than X/2 in size, whose sum with the powers of X is given."""
    half = "5" + "0" * (width - 1)
    digits = format(EXACTLY.add(number, Decimal(half * count)), "f").zfill(width * count)
    shift = int(half)
    ends = range(len(digits), len(digits) - width * count, -width)
    return [int(digits[end - width : end]) - shift for end in ends]
