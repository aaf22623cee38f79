"""Truncated Taylor series in two variables, and the mean value form over a box.

A jet of order n holds the coefficients c_ij, i + j <= n, of (dx)^i (dv)^j; absent ones are zero.
The scalars are intervals, or complex intervals.  Over a box a jet encloses, for each point z of the
box, the Taylor coefficients at z; every formula below holds at each z separately, hence for the
box.

*Mean value form.*  c_ij(z) is the derivative of order (i, j) at z divided by i! j!, so that d c_ij
/ dx = (i+1) c_(i+1,j) and d c_ij / dv = (j+1) c_(i,j+1).  The box is convex, hence for z and m in
it

    c_ij(z)  lies in  c_ij(m) + (i+1) c_(i+1,j)(box) (z - m)_x + (j+1) c_(i,j+1)(box) (z - m)_v.

Both enclosures of c_ij hold, so their intersection does: that is ``tightened``.

*Cosine and sine of a jet* c + h, h without constant term: h^k has no terms of degree below k, and

    cos(c + h) = sum of cos^(k)(c) h^k / k!,    cos, -sin, -cos, sin, cos, ...
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, Protocol, TypeVar

from cap.checker.elementary import cos_sin
from cap.checker.interval import Interval


class Scalar(Protocol):
    """What a coefficient of a jet can do."""

    def __add__(self: S, other: S, /) -> S: ...
    def __mul__(self: S, other: S | int, /) -> S: ...
    def __neg__(self: S) -> S: ...


S = TypeVar("S", bound=Scalar)


class Jet(Generic[S]):
    """The sum of coefficients[i, j] dx^i dv^j for i + j <= order."""

    __slots__ = ("coefficients", "order")

    def __init__(self, order: int, coefficients: dict[tuple[int, int], S]) -> None:
        self.order = order
        self.coefficients = {(i, j): c for (i, j), c in coefficients.items() if i + j <= order}

    def truncated(self, order: int) -> Jet[S]:
        """Return the terms of degree at most order."""
        return Jet(order, self.coefficients)

    def __add__(self, other: Jet[S]) -> Jet[S]:
        total = dict(self.coefficients)
        for power, c in other.coefficients.items():
            total[power] = total[power] + c if power in total else c
        return Jet(min(self.order, other.order), total)

    def __neg__(self) -> Jet[S]:
        return Jet(self.order, {power: -c for power, c in self.coefficients.items()})

    def __sub__(self, other: Jet[S]) -> Jet[S]:
        return self + -other

    def __mul__(self, other: Jet[S] | S | int) -> Jet[S]:
        if not isinstance(other, Jet):
            return Jet(self.order, {power: c * other for power, c in self.coefficients.items()})
        order, total = min(self.order, other.order), dict[tuple[int, int], S]()
        for (i, j), c in self.coefficients.items():
            for (k, m), d in other.coefficients.items():
                if i + j + k + m <= order:
                    power, term = (i + k, j + m), c * d
                    total[power] = total[power] + term if power in total else term
        return Jet(order, total)


RealJet = Jet[Interval]


def powers(jet: Jet[S], one: S, highest: int) -> list[Jet[S]]:
    """Return jet^0, ..., jet^highest."""
    result = [Jet(jet.order, {(0, 0): one})]
    for _ in range(highest):
        result.append(result[-1] * jet)
    return result


def substituted(polynomial: Jet[S], x: Jet[S], v: Jet[S], one: S) -> Jet[S]:
    """Return the polynomial with jets without constant term in the place of its two variables."""
    order = min(polynomial.order, x.order)
    x_powers, v_powers = powers(x, one, order), powers(v, one, order)
    total = Jet[S](order, {})
    for (i, j), c in polynomial.coefficients.items():
        total = total + x_powers[i] * v_powers[j] * c
    return total


def cos_sin_jet(angle: RealJet) -> tuple[RealJet, RealJet]:
    """Return the cosine and the sine of a jet with intervals as coefficients."""
    cos, sin = cos_sin(angle.coefficients[0, 0])
    one = cos.integer(1)
    h = Jet(angle.order, {p: c for p, c in angle.coefficients.items() if p != (0, 0)})
    cos_jet, sin_jet = Jet(h.order, {(0, 0): cos}), Jet(h.order, {(0, 0): sin})
    term = Jet(h.order, {(0, 0): one})  # h^k / k!
    for k in range(1, h.order + 1):
        cos, sin = -sin, cos  # the next derivatives
        term = term * h * (one / k)
        cos_jet, sin_jet = cos_jet + term * cos, sin_jet + term * sin
    return cos_jet, sin_jet


class Centred:
    """The jet of one quantity over a box and at a point m of the box (there, to one order less).

    ``offsets`` encloses z - m for z in the box.
    """

    __slots__ = ("box", "centre", "offsets")

    def __init__(self, centre: RealJet, box: RealJet, offsets: tuple[Interval, Interval]) -> None:
        self.centre, self.offsets = centre, offsets
        self.box = tightened(box, centre, offsets)

    def __getitem__(self, power: tuple[int, int]) -> Interval:
        """Return the enclosure over the box of the coefficient of dx^i dv^j."""
        return self.box.coefficients[power]


def lift(formula: Callable[..., RealJet], *arguments: Centred) -> Centred:
    """Return formula(*arguments), evaluated at m and over the box and tightened."""
    centre = formula(*(a.centre for a in arguments))
    return Centred(centre, formula(*(a.box for a in arguments)), arguments[0].offsets)


def tightened(box: RealJet, centre: RealJet, offsets: tuple[Interval, Interval]) -> RealJet:
    """Return the jet over the box, coefficients below its order in mean value form as well."""
    result = dict(box.coefficients)
    for i, j in sorted(result, key=sum, reverse=True):
        if i + j < box.order:
            value = centre.coefficients.get((i, j), offsets[0].integer(0))
            for n, slope, offset in (
                (i + 1, result.get((i + 1, j)), offsets[0]),
                (j + 1, result.get((i, j + 1)), offsets[1]),
            ):
                if slope is not None:
                    value = value + slope * n * offset
            result[i, j] = result[i, j].intersection(value)
    return Jet(box.order, result)
