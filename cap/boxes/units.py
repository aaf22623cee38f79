"""From the units of the parameters to those of the flow, and back."""

import math
from fractions import Fraction
from typing import Any

from cap.boxes.flight import Constants, Instant, NearSystem
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, between, enclosing
from cap.sets.interval import Ball
from cap.sets.records import Record

BITS = 200


class Units(Record):
    """The place of the right wall, F/ω² and F/ω."""

    right: Interval
    length: Interval
    speed: Interval


@kernel
def _is_one(x: Interval) -> bool:
    return x.mid == 1 and x.rad == 0


@kernel
def place(units: Units, x: Interval) -> Interval:
    """Return where x is, in the units of the parameters."""
    return units.right + (x if _is_one(units.length) else x * units.length)


@kernel
def speed_of(units: Units, v: Interval) -> Interval:
    """Return the velocity v in the units of the parameters."""
    return v if _is_one(units.speed) else v * units.speed


@kernel
def inner_box(
    units: Units, x: tuple[float, float], v: tuple[float, float]
) -> tuple[Interval, Interval]:
    """Return a box, given by its ends in the units of the parameters, in those of the flow."""
    far, fast = between(x[0], x[1]) - units.right, between(v[0], v[1])
    return (
        far if _is_one(units.length) else far / units.length,
        fast if _is_one(units.speed) else fast / units.speed,
    )


def units_of(p: Parameters) -> Units:
    """Return the units."""
    length, speed = enclosing(p.F / p.omega**2), enclosing(p.F / p.omega)
    return Units(right=enclosing(p.r), length=length, speed=speed)


def system_of(p: Parameters, friction: Fraction = Fraction(1)) -> Constants:
    """Return the constants, enclosed; with the friction multiplied by 1 or -1."""
    alpha, mu = friction * p.f / p.F, p.mu / p.omega
    with interval.workprec(BITS):
        ratio, pi = interval.ball(alpha), interval.pi()
        arc = ratio.acos()
        return Constants(
            alpha=enclosing(alpha),
            mu=enclosing(mu),
            e=enclosing(p.e),
            width=enclosing(p.R * p.omega**2 / p.F),
            response=enclosing(1 / (1 + mu**2)),
            sine=of_ball(((1 - ratio) * (1 + ratio)).sqrt()),
            arc=of_ball(arc),
            slow_right=of_ball(2 * pi - arc),
            slow_left=of_ball(pi - arc),
            viscous=int(p.mu != 0),
            elastic=int(p.e == 1),
        )


def near(y: Constants) -> NearSystem:
    """Return the constants in doubles: they steer."""
    values = {name: getattr(y, name) for name in y.FIELDS}
    middles: dict[str, Any] = {
        name: q.mid if isinstance(q, Interval) else q for name, q in values.items()
    }
    return NearSystem(**middles)


def instant(part: Fraction) -> Instant:
    """Return the time ``part`` T, with its sine and cosine."""
    quarter = part % 1 * 4
    with interval.workprec(BITS):
        t = 2 * interval.pi() * interval.ball(part)
        sine, cosine = t.sin_cos()
        if quarter.denominator == 1:
            exact = ((0, 1), (1, 0), (0, -1), (-1, 0))[int(quarter)]
            sine, cosine = interval.Ball(exact[0]), interval.Ball(exact[1])
        return Instant(t=of_ball(t), sin=of_ball(sine), cos=of_ball(cosine))


def of_ball(x: Ball) -> Interval:
    """Return an interval around the nearest double that contains a ball."""
    low, high = interval.ends(x)
    mid = float((low + high) / 2)
    gap = max(high - Fraction(mid), Fraction(mid) - low)
    rad = float(gap)
    return Interval(mid, rad if Fraction(rad) >= gap else math.nextafter(rad, math.inf))
