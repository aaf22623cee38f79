"""Maps (x, y) -> (x + b y' + c, y'), y' = y + q(x), of a cylinder, and curves that go around it.

x is an angle, q a polynomial in cos x and sin x with mean 0, b != 0.  The standard map is one: the
simplified map of a ball that bounces on a vibrating table, and of Fermi's accelerator; x is the
phase of an impact, y the speed after it, up to a constant, and the way of the table, or of the
wall, is neglected.  The map is entire, invertible, det = 1, and with Q' = q

    y' dx' - y dx = d(b y'²/2 + Q(x)):

it is exact, as Q is periodic.  For a curve (θ + x, y) with 𝓕(K) = K⁺ + E this gives, as ∮ y dx is
the same for K, K⁺ and 𝓕(K), after an integration by parts

    0 = 2 <det(E, K⁺')> + <det(E, E')>:

what the proof of the a-posteriori theorem has of closed curves in a simply connected U.  The curve
is embedded: if K∞(a) and K∞(b) are one point of the cylinder, so are K∞(θ + a) and K∞(θ + b) for
all θ, by 𝓕 and by density, and comparing the means a - b is a multiple of 2π.

An invariant curve around the cylinder separates it, and 𝓕 keeps its ends apart, as y' - y is
bounded: orbits that start below it stay below it, in both directions of time.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Any

from cap.errors import BadInput
from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel
from cap.sets.interval import Ball, ComplexBall
from cap.system.planar import Map as Formulas
from cap.system.polynomial import COS, SIN, Polynomial, variable
from cap.tori.invariant_curve import Curve, Image, Vector

HALF_I = ComplexBall(0, Ball((1, -1)))
WIDE = Ball(1) / 2**20  # a state that is followed no further


@dataclass(frozen=True)
class Kicked:
    """The map: b, c and q."""

    b: Fraction
    c: Fraction
    q: Polynomial

    @classmethod
    def of(cls, given: Formulas) -> "Kicked":
        """Return a map given by formulas; raise `BadInput` if it is none of these."""
        x, y = given.state
        first, second = (given.image[z] for z in given.state)
        q = second - variable(y)
        b = first.terms.get(((y, 1),), Fraction(0))
        rest = first - variable(x) - second * b
        if not q.variables <= {COS, SIN} or rest.variables:
            raise BadInput(
                f"the map is not ({x}, {y}) -> ({x} + b {y}' + c, {y}'), {y}' = {y} + q({x})"
            )
        constants = {name for p in (q, rest) for monomial in p.terms for name, _ in monomial}
        if not constants <= {COS, SIN}:
            raise BadInput("the constants of the map must be rational")
        if not b:
            raise BadInput(f"the map does not twist: the image of {x} does not depend on {y}")
        if mean(q):
            raise BadInput(f"the map moves all states up or down: the mean of q is {mean(q)}")
        return cls(b, rest.terms.get((), Fraction(0)), q)

    def terms(self) -> Iterator[tuple[Fraction, int, int]]:
        """Give the terms of q: the coefficient, and the powers of cos and sin."""
        for monomial, k in self.q.terms.items():
            powers = dict(monomial)
            yield k, powers.get(COS, 0), powers.get(SIN, 0)

    def over(self, circle: Circle) -> "Functions":
        """Return the map for curves (θ + x(θ), y(θ))."""
        return Functions(self, circle)


@dataclass(frozen=True)
class Functions:
    """A map of functions; it needs no hints."""

    at: Kicked
    circle: Circle

    def __call__(self, x: FourierModel, y: FourierModel) -> Image:
        """Return the image of the curves (θ + x, y) in the models."""
        circle, q = self.circle, self.at.q
        sine = circle.model([HALF_I, ComplexBall(0), -HALF_I])
        cosine = circle.model([ComplexBall(1) / 2, ComplexBall(0), ComplexBall(1) / 2])
        b, c = interval.ball(self.at.b), interval.ball(self.at.c)
        slope = q.derivative(SIN) * variable(COS) - q.derivative(COS) * variable(SIN)
        s, k = x.sin_cos()
        known = {COS: cosine * k - sine * s, SIN: sine * k + cosine * s}
        after, steep = y + _value(q, known, circle), _value(slope, known, circle)

        def tangent(w: Vector) -> Vector:
            pushed = w[1] + steep * w[0]
            return w[0] + pushed * b, pushed

        return Image(x + after * b + c, after, tangent)

    def along(self, _curve: Curve) -> "Functions":
        """Return the map."""
        return self

    def written(self, _places: int) -> tuple[dict[str, Any], "Functions"]:
        """Return the map, without hints."""
        return {}, self


def mean(q: Polynomial) -> Fraction:
    """Return the mean of q over a turn.

    That of cos^m sin^n is (m - 1)!! (n - 1)!!/(m + n)!! if both are even, else 0.
    """
    total = Fraction(0)
    for monomial, k in q.terms.items():
        m, n = (dict(monomial).get(name, 0) for name in (COS, SIN))
        if m % 2 == n % 2 == 0:
            above = prod(range(1, m, 2)) * prod(range(1, n, 2))
            total += k * Fraction(above, prod(range(2, m + n + 1, 2)))
    return total


def _value(p: Polynomial, known: dict[str, FourierModel], circle: Circle) -> FourierModel:
    """Return the value of a polynomial in cos and sin."""
    total = circle.constant(0)
    for monomial, k in p.terms.items():
        factors = [known[name] for name, power in monomial for _ in range(power)]
        product = (
            circle.constant(interval.ball(k)) if not factors else factors[0] * interval.ball(k)
        )
        for factor in factors[1:]:
            product = product * factor
        total = total + product
    return total


def reached(at: Kicked, x: Fraction, y: Fraction, count: int) -> Ball:
    """Return a lower bound of the largest y of the first states of an orbit, at most ``count``.

    So each invariant curve around the cylinder above the state (x, y) has points with a larger y:
    as the orbit stays below it.  The orbit is followed in balls, as far as the precision suffices.
    """
    a, v = interval.ball(x), interval.ball(y)
    b, c = interval.ball(at.b), interval.ball(at.c)
    terms = [(interval.ball(k), m, n) for k, m, n in at.terms()]
    highest = interval.lower(v)
    for _ in range(count):
        cos, sin = a.cos(), a.sin()
        v = v + interval.total(k * cos**m * sin**n for k, m, n in terms)
        a = a + b * v + c
        if not v.rad() < WIDE:
            break
        highest = interval.lower(v) if interval.lower(v) > highest else highest
    return highest
