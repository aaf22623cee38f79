"""A polynomial that an area-preserving map hardly changes, and how long it keeps orbits together.

*The integral.*  At an elliptic fixed point ψ of `cap.maps.normal_form` conjugates Φ with a rotation
of circles, up to terms of some order; so the polynomial H = |ψ|², cut at a degree d, has H∘Φ - H =
O(|z|^(d+1)).  Here its coefficients are rounded: from then on it is just a polynomial.

*The ellipses.*  With z = c + A u, c and A exact, E is the image of |u| <= 1.  H is a polynomial in
u, near |u|².  With ζ = u_1 + i u_2 a homogeneous polynomial of degree n is a sum of a_jk ζ^j ζ̄^k,
j + k = n: for |u| <= κ it is at most κ^n Σ |a_jk|.

*The drift* is a bound of |H∘Φ - H| on E.  Over Taylor models in u, on the square around the disk,
both are polynomials with a remainder, and in the difference the polynomials nearly cancel.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.flow.event import TAYLOR_MODELS
from cap.flow.model import Oscillator
from cap.flow.strobe import strobe
from cap.flow.windows import Itinerary
from cap.maps.normal_form import Ellipticity, conjugate, conjugate_real, normal_form, substitute
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall
from cap.sets.jet import Jet
from cap.sets.taylor_model import Domain, TaylorModel

Rows = tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]
GROWTH = 1.03  # from one radius tried to the next
TRIED = 400
SHORT = 4  # digits of the axes
ROUNDED = 1.01  # more than what rounding the axes changes


@dataclass(frozen=True)
class Ellipse:
    """The set of z = ``centre`` + ``axes`` u with |u| <= 1."""

    centre: tuple[Fraction, Fraction]
    axes: Rows

    def half_widths(self) -> tuple[Ball, Ball]:
        """Return the half-widths of the least rectangle around it: the norms of the rows."""
        x, v = (interval.ball(a * a + b * b).sqrt() for a, b in self.axes)
        return x, v

    def determinant(self) -> Fraction:
        """Return det A."""
        (a, b), (c, d) = self.axes
        return a * d - b * c

    def coordinates(self, z: Sequence[Any]) -> tuple[Any, Any]:
        """Return u of states, over any scalar."""
        (a, b), (c, d) = self.axes
        inverse = 1 / self.determinant()
        x, v = (w - interval.ball(m) for w, m in zip(z, self.centre, strict=True))
        ball = interval.ball
        return (
            x * ball(d * inverse) - v * ball(b * inverse),
            v * ball(a * inverse) - x * ball(c * inverse),
        )


def integral(f: Jet, linear: Ellipticity) -> Jet:
    """Return |ψ|², a jet in (z, z̄), of the map ``f`` in the coordinate z."""
    psi, _ = normal_form(f, linear.multiplier)
    return psi * conjugate(psi)


def sizes(f: Jet) -> list[Ball]:
    """Return bounds, for each degree n, of the terms f_n of a polynomial in u for |u| <= 1."""
    zeta, bar = Jet.variables((ComplexBall(0), ComplexBall(0)), f.space.order)
    half = ComplexBall(1) / 2
    return moduli(substitute(f, ((zeta + bar) * half, (zeta - bar) * (half / ComplexBall(0, 1)))))


def moduli(f: Jet) -> list[Ball]:
    """Return the sums of the moduli of the coefficients of each degree."""
    sums = [Ball(0)] * (f.space.order + 1)
    for degree, coefficient in zip(f.space.degrees, f.coefficients, strict=True):
        sums[degree] = sums[degree] + abs(ComplexBall(0) + coefficient)
    return sums


class Growth(NamedTuple):
    """Of H cut at a degree, in floats: sizes of the terms of H∘Φ - H, and of H - |z|²."""

    degree: int
    drift: list[float]
    rest: list[float]


def growths(f: Jet, H: Jet) -> list[Growth]:
    """Return the sizes for each degree of H, at |z| <= 1; ``f`` is Φ in z, to a higher order."""
    result = []
    for degree in range(3, H.space.order + 1):
        cut = H.truncated(degree).extended(f.space.order)
        change = substitute(cut, (f, conjugate(f))) - cut
        drift, rest = ([float(s.mid()) for s in moduli(jet)] for jet in (change, cut))
        drift[: degree + 1], rest[:3] = [0.0] * (degree + 1), [0.0] * 3
        result.append(Growth(degree, drift, rest))
    return result


class Plan(NamedTuple):
    """A hint: H of a degree, the outer ellipse |z| <= radius, the inner one ``part`` as large."""

    degree: int
    radius: float
    part: float


def plan(growths: Sequence[Growth], periods: Fraction, largest: float) -> Plan:
    """Return the degree and the ellipses, in floats, of which the inner one is the largest found.

    Raises `NotProved` if there is none.
    """
    tried = [largest / GROWTH**k for k in range(TRIED)]
    plans = [_inner(growth, float(periods), radius) for growth in growths for radius in tried]
    best = max(plans, key=lambda p: p.radius * p.part)
    if not best.part:
        raise NotProved("ellipses", "no ellipse is found that orbits stay in for so long", {})
    return best


def _inner(growth: Growth, periods: float, radius: float) -> Plan:
    """Return the plan for an H and a radius, with the part 0 if there is none."""
    lost = periods * _at(growth.drift, radius)
    most = (radius**2 - _at(growth.rest, radius) - lost) / ROUNDED
    inner = math.sqrt(max(most, 0.0))
    while inner and inner**2 + _at(growth.rest, inner) > most:
        inner *= 0.99
    return Plan(growth.degree, radius, inner / radius)


def _at(sizes: list[float], radius: float) -> float:
    return math.fsum(size * radius**n for n, size in enumerate(sizes))


def ellipse(linear: Ellipticity, centre: tuple[Fraction, Fraction], radius: float) -> Ellipse:
    """Return an ellipse near |z| <= radius, its axes of a few digits.

    z = p δx + q δv is 1 at δx = Im q = 1/p, and i at (δx, δv) = (-Re q, p).
    """
    scale = Ball(radius)
    right, up = linear.q.imag * scale, (-linear.q.real * scale, linear.p * scale)
    a, b, d = (_rounded(interval.midpoint(entry)) for entry in (right, *up))
    return Ellipse(centre, ((a, b), (Fraction(0), d)))


def _rounded(value: Fraction) -> Fraction:
    if not value:
        return value
    return round(value, SHORT - interval.decade(abs(value)))


def polynomial(H: Jet, linear: Ellipticity, point: Sequence[Ball], E: Ellipse, places: int) -> Jet:
    """Return H as a polynomial in u, near |u|², its coefficients rounded and exact.

    ``H`` is in (z, z̄), where z is 0 at ``point``.
    """
    a, b = Jet.variables((Ball(0), Ball(0)), H.space.order)
    offsets = []
    for row, centre, at in zip(E.axes, E.centre, point, strict=True):
        p, q = map(interval.ball, row)
        offsets.append(a * p + b * q + (interval.ball(centre) - at))
    z = offsets[0] * ComplexBall(linear.p) + offsets[1] * linear.q
    inverse_area = 1 / abs(interval.ball(E.determinant()))
    exact = substitute(H, (z, conjugate_real(z))) * inverse_area
    rounded = [_decimal(ComplexBall(0) + c, places) for c in exact.coefficients]
    return Jet(H.space, [Fraction(0), *rounded[1:]])


def _decimal(c: ComplexBall, places: int) -> Fraction:
    return round(interval.midpoint(c.real), places)


class Held(NamedTuple):
    """Bounds: of H on the inner ellipse, of H from below on the boundary of E, of its change."""

    inner: Ball
    outer: Ball
    drift: Ball


def held(
    osc: Oscillator[Any], expected: Itinerary, E: Ellipse, H: Jet, part: Fraction, order: int
) -> Held:
    """Return the bounds; Φ is known by Taylor models of this order."""
    terms = zip(H.space.exponents, H.coefficients, strict=True)
    square = (2, 0), (0, 2)
    rest = sizes(Jet(H.space, [interval.ball(c - int(e in square)) for e, c in terms]))
    kappa = interval.ball(part)
    inner = kappa * kappa + interval.total(s * kappa**n for n, s in enumerate(rest))
    return Held(inner, 1 - interval.total(rest), drift(osc, expected, E, H, order))


def drift(osc: Oscillator[Any], expected: Itinerary, E: Ellipse, H: Jet, order: int) -> Ball:
    """Return a bound of |H∘Φ - H| on E; all orbits from E have the events of ``expected``."""
    u = Domain((Ball(1), Ball(1)), order).variables((Ball(0), Ball(0)))
    x, v = (u[0] * interval.ball(a) + u[1] * interval.ball(b) for a, b in E.axes)
    start = x + interval.ball(E.centre[0]), v + interval.ball(E.centre[1])
    end = strobe(osc, start, expected, TAYLOR_MODELS).end
    before = Jet(H.space, [interval.ball(c) for c in H.coefficients]).extended(order)
    change = _value(H, E.coordinates(end)) + -TaylorModel(u[0].domain, before, Ball(0))
    remainder: Ball = abs(change.remainder)
    return interval.total(sizes(change.polynomial)) + remainder


def _value(H: Jet, u: Sequence[Any]) -> Any:
    """Return H(u) by Horner's rule in u_1, its coefficients polynomials in u_2."""
    order, zero = H.space.order, u[0] * 0
    powers = [zero + 1]
    for _ in range(order):
        powers.append(powers[-1] * u[1])
    total = zero
    for i in range(order, -1, -1):
        row = zero
        for j in range(order - i + 1):
            row = row + powers[j] * interval.ball(H[i, j])
        total = total * u[0] + row
    return total
