"""Maps (x, y) -> (x + b y' + c, y'), y' = y + q(x), of the cylinder x modulo 2 pi.

b != 0 and c are rational, q is a polynomial in cos x and sin x with rational coefficients and mean
0: that of cos^m sin^n is (m - 1)!! (n - 1)!!/(m + n)!! if m and n are even, else 0.

*Such a map* is entire, and has an inverse: x = x' - b y' - c, y = y' - q(x).  Its derivative (1 +
b q', b; q', 1) has determinant 1.  With Q' = q, Q periodic,

    y' dx' - y dx = d(b y'^2/2 + Q(x)):

so the integral of y dx around the cylinder is kept, along each closed curve.  As y' - y is bounded,
both ends of the cylinder are kept.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import prod
from typing import NamedTuple

from cap.checker.coverings.formulas import Formulas
from cap.checker.kernel.fourier import Circle, Function
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.model import COS, SIN
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.tori.invariant_curve import Image, Vector


class Kicked(NamedTuple):
    """b, c, q."""

    b: Fraction
    c: Fraction
    q: Polynomial

    @classmethod
    def of(cls, given: Formulas) -> Kicked:
        """Return the map; formulas of another form reject."""
        x, y = given.state
        first, second = given.image
        q = second - variable(y)
        b = first.terms.get((y,), Fraction(0))
        rest = first - variable(x) - second * b
        need(q.variables <= {COS, SIN}, "the second coordinate is not kicked by a function of x")
        need(not rest.variables, "the first coordinate is not moved by b y' + c")
        need(b != 0, "the map does not twist")
        need(mean(q) == 0, "the mean of the kick is not 0")
        return cls(b, rest.number, q)

    def over(self, x: Function, y: Function) -> Image:
        """Return the image of all curves (theta + x, y) in these functions."""
        circle, half = x.circle, x.circle.unit // 2
        cosine = Function(circle, [(0, 0), (half, 0)], 0)
        sine = Function(circle, [(0, 0), (0, -half)], 0)
        k, s = x.cos_sin()
        known = {COS: cosine * k - sine * s, SIN: sine * k + cosine * s}
        cos, sin = variable(COS), variable(SIN)
        slope = self.q.derivative(SIN) * cos - self.q.derivative(COS) * sin
        after, steep = y + value(self.q, known, circle), value(slope, known, circle)
        b, c = exact(self.b, circle), exact(self.c, circle)

        def tangent(w: Vector) -> Vector:
            pushed = w[1] + steep * w[0]
            return w[0] + pushed * b, pushed

        return Image(x + after * b + circle.constant(c), after, tangent)


def mean(q: Polynomial) -> Fraction:
    """Return the mean of a polynomial in cos and sin."""
    total = Fraction(0)
    for monomial, c in q.terms.items():
        m, n = monomial.count(COS), monomial.count(SIN)
        if m % 2 == n % 2 == 0:
            above = prod(range(1, m, 2)) * prod(range(1, n, 2))
            total += c * Fraction(above, prod(range(2, m + n + 1, 2)))
    return total


def exact(q: Fraction, circle: Circle) -> Interval:
    """Return a number at the precision of functions."""
    return Interval.enclosing(q, q, circle.bits)


def value(p: Polynomial, known: Mapping[str, Function], circle: Circle) -> Function:
    """Return the value of a polynomial."""
    total = circle.constant(0)
    for monomial, c in p.terms.items():
        product = circle.constant(exact(c, circle))
        for name in monomial:
            product = product * known[name]
        total = total + product
    return total
