"""Truncated Taylor series in several variables, and the mean value form over a box.

A jet of order n holds the coefficients c_ij, i + j <= n, of (dx)^i (dv)^j; absent ones are zero.
With more variables, as e and mu, powers have more components, and what follows more terms.
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

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import product
from operator import add
from typing import Any, Generic, TypeVar

from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need

S = TypeVar("S", bound=Any)  # what a coefficient is: it has sums and products
Power = tuple[int, ...]


class Jet(Generic[S]):
    """The sum of coefficients[i, j, ...] dx^i dv^j ... for i + j + ... <= order."""

    __slots__ = ("coefficients", "order")

    def __init__(self, order: int, coefficients: Mapping[Power, S]) -> None:
        self.order = order
        self.coefficients = {p: c for p, c in coefficients.items() if sum(p) <= order}

    @property
    def origin(self) -> Power:
        """The power 0, 0, ... of a jet that is not empty."""
        return (0,) * len(next(iter(self.coefficients)))

    @property
    def constant(self) -> S:
        """The constant term."""
        return self.coefficients[self.origin]

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
        order, total = min(self.order, other.order), dict[Power, S]()
        for p, c in self.coefficients.items():
            for q, power in partners(p, order):
                d = other.coefficients.get(q)
                if d is not None:
                    term = c * d
                    total[power] = total[power] + term if power in total else term
        return Jet(order, total)


@cache
def partners(p: Power, order: int) -> list[tuple[Power, Power]]:
    """Return (q, p + q) for all powers q for which p + q has a degree of at most the order."""
    degrees = product(range(order + 1), repeat=len(p))
    sums = ((q, tuple(map(add, p, q))) for q in degrees)
    return [(q, total) for q, total in sums if sum(total) <= order]


@cache
def raised(p: Power) -> list[Power]:
    """Return the power, raised by one in each variable."""
    return [(*p[:n], p[n] + 1, *p[n + 1 :]) for n in range(len(p))]


RealJet = Jet[Interval]


def cos_sin_jet(angle: RealJet) -> tuple[RealJet, RealJet]:
    """Return the cosine and the sine of a jet with intervals as coefficients."""
    cos, sin = cos_sin(angle.constant)
    one, origin = cos.integer(1), angle.origin
    h = Jet(angle.order, {p: c for p, c in angle.coefficients.items() if any(p)})
    cos_jet, sin_jet = Jet(h.order, {origin: cos}), Jet(h.order, {origin: sin})
    term = Jet(h.order, {origin: one})  # h^k / k!
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

    def __init__(self, centre: RealJet, box: RealJet, offsets: Sequence[Interval]) -> None:
        self.centre, self.offsets = centre, offsets
        self.box = tightened(box, centre, offsets)

    def __getitem__(self, power: Power) -> Interval:
        """Return the enclosure over the box of the coefficient of dx^i dv^j ..."""
        need(sum(power) <= self.box.order, "a coefficient beyond the order of its jet")
        return self.box.coefficients.get(power, self.offsets[0].integer(0))

    @property
    def value(self) -> Interval:
        """The enclosure of the quantity over the box."""
        return self.box.constant


def lift(formula: Callable[..., RealJet], *arguments: Centred) -> Centred:
    """Return formula(*arguments), evaluated at m and over the box and tightened."""
    centre = formula(*(a.centre for a in arguments))
    return Centred(centre, formula(*(a.box for a in arguments)), arguments[0].offsets)


def tightened(box: RealJet, centre: RealJet, offsets: Sequence[Interval]) -> RealJet:
    """Return the jet over the box, coefficients below its order in mean value form as well."""
    result = dict(box.coefficients)
    for power in sorted(result, key=sum, reverse=True):
        if sum(power) < box.order:
            result[power] = result[power].intersection(mean_value(power, result, centre, offsets))
    return Jet(box.order, result)


def mean_value(
    power: Power, box: Mapping[Power, Interval], centre: RealJet, offsets: Sequence[Interval]
) -> Interval:
    """Return the mean value form of a coefficient, from those over the box, and at the centre."""
    value = centre.coefficients.get(power, offsets[0].integer(0))
    for higher, n, offset in zip(raised(power), power, offsets, strict=True):
        slope = box.get(higher)
        if slope is not None:
            value = value + slope * (n + 1) * offset
    return value
