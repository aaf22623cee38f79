"""Fourier models: a trigonometric polynomial with ball coefficients, and an error in a norm.

For u(θ) = Σ u_k exp(ikθ) let |u|_ρ = Σ |u_k| exp(ρ|k|): with it the functions for which it is
finite are an algebra, |uw|_ρ <= |u|_ρ |w|_ρ, and a function is bounded by its norm on the strip
|Im θ| <= ρ.  A model (p, e) encloses every function u with |u - q|_ρ <= e for some polynomial q
whose coefficients lie in those of p.  Operations keep this, and drop what exceeds the degree into
the error.  All bounds here grow with ρ: a model is also one for every smaller ρ.

(Haro, Canadell, Figueras, Luque and Mondelo, The parameterization method, 2016, Chapter 4, use the
same algebra with other norms.)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cached_property
from typing import Any

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall, ComplexPolynomial
from cap.sets.scalar import Ring

QUARTER = Ball((1, -2))
DOUBLINGS = 10  # of the digits, by Newton's method
I = ComplexBall(0, 1)


class Circle:
    """Where models live: the largest ``degree`` of their polynomials, and ρ of their norm."""

    def __init__(self, degree: int, rho: Fraction) -> None:
        self.degree, self.rho = degree, rho
        growth = interval.ball(rho)
        self.weights = [interval.upper((growth * abs(k)).exp()) for k in self.modes(2 * degree)]

    @staticmethod
    def modes(degree: int) -> range:
        """Return -degree .. degree."""
        return range(-degree, degree + 1)

    def constant(self, c: Any) -> FourierModel:
        """Return a constant function."""
        return self.model([ComplexBall(c)])

    def model(
        self, coefficients: Sequence[ComplexBall], error: Ball = interval.ZERO
    ) -> FourierModel:
        """Return a model; there are 2n + 1 coefficients, n <= degree: those of -n .. n."""
        below = self.degree - len(coefficients) // 2
        return FourierModel(self, ComplexPolynomial([0] * below + list(coefficients)), error)

    def real(self, coefficients: Sequence[ComplexBall]) -> FourierModel:
        """Return the real function with these coefficients of 0 .. n; that of -k is conjugate."""
        mean, *others = coefficients
        below = [c.conjugate() for c in reversed(others)]
        return self.model([*below, ComplexBall(mean.real), *others])

    def norm(self, coefficients: Sequence[ComplexBall], degree: int) -> Ball:
        """Return an upper bound of the norm of a polynomial of this degree."""
        weights = self.weights[2 * self.degree - degree :]
        terms = (c.abs_upper() * w for c, w in zip(coefficients, weights, strict=False))
        return interval.upper(interval.total(terms))


class FourierModel(Ring):
    """A trigonometric polynomial, times exp(i degree θ) as a polynomial, and an ``error`` >= 0."""

    def __init__(self, circle: Circle, polynomial: ComplexPolynomial, error: Ball) -> None:
        self.circle, self.polynomial, self.error = circle, polynomial, interval.upper(error)

    @cached_property
    def coefficients(self) -> list[ComplexBall]:
        """The coefficients of -degree .. degree."""
        given: list[ComplexBall] = self.polynomial.coeffs()
        return given + [ComplexBall(0)] * (2 * self.circle.degree + 1 - len(given))

    @cached_property
    def size(self) -> Ball:
        """An upper bound of the norm of the polynomial."""
        return self.circle.norm(self.coefficients, self.circle.degree)

    @property
    def norm(self) -> Ball:
        """An upper bound of the norms of all functions enclosed."""
        return interval.upper(self.size + self.error)

    @property
    def mean(self) -> ComplexBall:
        """An enclosure of the coefficients of 0."""
        c, e = self.coefficients[self.circle.degree], interval.symmetric(self.error)
        return c + ComplexBall(e, e)

    @property
    def swing(self) -> Ball:
        """An upper bound of |u(θ) - mean| for real θ, without the error: Σ |u_k|, k != 0."""
        parts = (c.abs_upper() for c in self.coefficients)
        return interval.upper(interval.total(parts) - abs(self.coefficients[self.circle.degree]))

    def centre(self) -> FourierModel:
        """Return the polynomial without the error."""
        return self.widened_to(interval.ZERO)

    def widened(self, by: Ball) -> FourierModel:
        """Return the model of the functions that differ from these by at most ``by``."""
        return self.widened_to(self.error + by)

    def widened_to(self, error: Ball) -> FourierModel:
        """Return the polynomial with this error."""
        return FourierModel(self.circle, self.polynomial, error)

    def __add__(self, other: Any) -> FourierModel:
        if not isinstance(other, FourierModel):
            other = self.circle.constant(other)
        self._same_circle(other)
        total = self.polynomial + other.polynomial
        return FourierModel(self.circle, total, self.error + other.error)

    def __neg__(self) -> FourierModel:
        return FourierModel(self.circle, -self.polynomial, self.error)

    def __mul__(self, other: Any) -> FourierModel:
        if not isinstance(other, FourierModel):
            c = ComplexBall(other)
            return FourierModel(self.circle, self.polynomial * c, self.error * c.abs_upper())
        self._same_circle(other)
        n = self.circle.degree
        whole: list[ComplexBall] = (self.polynomial * other.polynomial).coeffs()
        low, high = whole[:n], whole[3 * n + 1 :]
        weights = self.circle.weights
        dropped = interval.total(c.abs_upper() * w for c, w in zip(low, weights, strict=False))
        above = zip(high, weights[3 * n + 1 :], strict=False)
        dropped += interval.total(c.abs_upper() * w for c, w in above)
        kept = FourierModel(self.circle, ComplexPolynomial(whole[n : 3 * n + 1]), dropped)
        return kept.widened_to(dropped + self._mixed(other))

    def _mixed(self, other: FourierModel) -> Ball:
        """Return e |q| + |p| e' + e e', without norms that are not needed."""
        e, f = self.error, other.error
        total = interval.ZERO
        if not e.is_zero():
            total = total + e * other.norm
        if not f.is_zero():
            total = total + f * self.size
        return total

    def __truediv__(self, other: Any) -> FourierModel:
        """Return the quotient by a number; that by a model is a product with its `reciprocal`."""
        return self * (1 / ComplexBall(other))

    def _same_circle(self, other: FourierModel) -> None:
        """Raise `ValueError` if the other model is one in another norm."""
        if self.circle is not other.circle:
            raise ValueError("Fourier models with different norms do not mix")

    def times(self, factors: Sequence[ComplexBall], most: Ball = interval.ONE) -> FourierModel:
        """Return Σ f_k u_k exp(ikθ); the caller guarantees |f_k| <= ``most`` beyond the degree."""
        products = [f * c for f, c in zip(factors, self.coefficients, strict=True)]
        return FourierModel(self.circle, ComplexPolynomial(products), self.error * most)

    def derivative(self) -> FourierModel:
        """Return the derivative of a polynomial; `ValueError` if there is an error."""
        if not self.error.is_zero():
            raise ValueError("a function known up to an error has an unknown derivative")
        return self.times([I * k for k in Circle.modes(self.circle.degree)])

    def reciprocal(self) -> FourierModel:
        """Return 1/u, from Newton's method; it converges where |u - mean| < |mean|."""
        guess = self.circle.constant(1 / self.mean.mid())
        for _ in range(DOUBLINGS):
            guess = (guess * (2 - self.centre() * guess)).centre()
        return self.reciprocal_near(guess)

    def reciprocal_near(self, guess: FourierModel) -> FourierModel:
        """Return 1/u for all functions enclosed: with v = ``guess``, |1/u - v| <= |v| z/(1 - z).

        Verifies z = |1 - uv| < 1.  Raises `NotProved` otherwise.
        """
        v = guess.centre()
        z = (1 - self * v).norm
        if not z < 1:
            raise NotProved("reciprocal", "a function may vanish", {"|1 - uv|": z})
        return v.widened_to(v.size * z / (1 - z))

    def sin_cos(self) -> tuple[FourierModel, FourierModel]:
        """Return sine and cosine.

        With the mean c, (u - c)/2^m has a norm of at most 1/4; there the Taylor polynomials leave
        at most |h|^n cosh|h|/n!; then angles are doubled m times, and c is added.
        """
        centre = self.centre()
        c = centre.coefficients[self.circle.degree]
        rest = centre - c
        doublings, size = 0, rest.size
        while not size <= QUARTER:
            doublings, size = doublings + 1, size / 2
            if not doublings < 64:
                raise NotProved("sine", "a function is too large", {"norm": rest.size})
        sin, cos = _small_sin_cos(rest / 2**doublings)
        for _ in range(doublings):
            sin, cos = 2 * (sin * cos), 1 - 2 * (sin * sin)
        s, k = c.sin_cos()
        both = sin * k + cos * s, cos * k - sin * s
        return perturbed(both, self.error)


def perturbed(
    both: tuple[FourierModel, FourierModel], error: Ball
) -> tuple[FourierModel, FourierModel]:
    """Return sin(u + e), cos(u + e) from sin u, cos u for all functions e of norm <= ``error``.

    sin(u + e) - sin u = sin u (cos e - 1) + cos u sin e,  |sin e| <= sinh|e|,  |cos e - 1| <=
    cosh|e| - 1.
    """
    sin, cos = both
    if error.is_zero():
        return both
    far, turn = error.sinh(), error.cosh() - 1
    a, b = sin.norm * turn + cos.norm * far, cos.norm * turn + sin.norm * far
    return sin.widened_to(sin.error + a), cos.widened_to(cos.error + b)


def _small_sin_cos(h: FourierModel) -> tuple[FourierModel, FourierModel]:
    """Return sine and cosine of a polynomial of norm at most 1/4."""
    size, n, left = h.size, 1, h.size * h.size.cosh()
    while not left < interval.rounding() / 2**10:  # after the terms of degree < n + 1
        n += 1
        left = left * size / n
    n += n % 2
    square = h * h
    zero = h.circle.constant(0)
    sin, cos = zero, zero
    for k in range(n, -1, -2):  # Horner: 1 - square/(k(k - 1)) (1 - ...)
        cos = 1 - square * cos / ((k + 1) * (k + 2))
        sin = 1 - square * sin / ((k + 2) * (k + 3))
    return (h * sin).widened(left), cos.widened(left)


def root(
    guess: FourierModel,
    value: FourierModel,
    slope: Callable[[Ball], FourierModel],
    inverse: FourierModel,
) -> FourierModel:
    """Return the one root near ``guess`` of an equation g(t) = 0 between functions.

    Assumes:   ``value`` encloses g(guess), ``slope(R)`` g'(guess + e) for all |e| <= R.
    Verifies:  |1 - A g'| = Z <= 1/2 for R = 2Y, Y = |A g(guess)|, A = ``inverse``: so t -> t - A
               g(t) contracts the ball of radius R into itself.
    Returns:   the model of the root, of the error Y/(1 - Z); there is no other one in the ball.
    Raises:    NotProved.
    """
    A = inverse.centre()
    Y = (A * value).norm
    Z = (1 - A * slope(2 * Y)).norm
    if not 2 * Z <= 1:
        raise NotProved("implicit equation", "no contraction", {"|A g|": Y, "|1 - A g'|": Z})
    return guess.centre().widened_to(Y / (1 - Z))
