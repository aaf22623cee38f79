"""What is asked of the sweep, from a system given as data: its pull, and a rectangle in doubles."""

import math
from fractions import Fraction
from typing import NamedTuple

from cap.areas.resting.fates import Sides
from cap.areas.resting.pull import Pull
from cap.errors import BadInput
from cap.orbits.capture import Boxes, clock, value
from cap.orbits.wall import Wall
from cap.sets import doubles, interval
from cap.sets.doubles import Interval
from cap.sets.interval import Ball
from cap.system.exponential import number
from cap.system.polynomial import COS, SIN, Polynomial


class Rectangle(NamedTuple):
    """The states ``box`` at the time ``start``, and the time until which they are followed."""

    start: Fraction
    until: Fraction
    box: Boxes


def driven(place: Wall) -> Polynomial:
    """Return -h''; `BadInput` says why the theorem does not apply."""
    system = place.system
    mode = system.modes[place.falling]
    pull = -system.lie(place.falling, place.rate)
    slopes = [pull.derivative(z) for z in (COS, SIN)]
    sides = [variables(place, q) for q in (place.h, place.rate)]
    held = [q.multiple_of(pull) for q in place.rested().values()] if pull else [None]
    for fails, reason in (
        (len(system.state) != 2, f"the state has {len(system.state)} variables, not two"),
        (len(mode.guards) != 1, f"{place.falling} has other guards than {place.guard}"),
        (mode.guards[place.guard].to != (place.falling,), "a hit leads to another mode"),
        (any(len(names) != 1 for names in sides), "h or h' depends on both variables"),
        (not all(map(system.is_constant, slopes)), "-h'' has a product of cos and sin"),
        (bool(pull.variables & {*system.state}), "-h'' depends on the state: flights are not "
         "polynomial in time, but for the clock"),
        (any(k is None or k <= 0 for k in held), f"a guard of {place.rest} is not a multiple of "
         "-h''"),
    ):  # fmt: skip
        if fails:
            raise BadInput(f"no share of a rectangle is proved of this model: {reason}")
    return pull


def variables(place: Wall, q: Polynomial) -> list[str]:
    """Return on which variables of the state h, or h', depends: one, if the theorem applies."""
    return [z for z in place.system.state if q.derivative(z)]


def numbers(place: Wall, pull: Polynomial, asked: Rectangle) -> tuple[Pull, Sides]:
    """Return the pull from the start on, and the sides of the rectangle, in doubles."""
    known = clock(place.system, interval.ball(asked.start))
    c, d = (value(pull.derivative(z), {}) for z in (COS, SIN))
    omega = number(place.system.omega)
    early, late = _beside(asked.until - asked.start)
    p = Pull(
        _double(value(pull.without(COS, SIN), {})),
        _double(c * known[COS] + d * known[SIN]),
        _double(d * known[COS] - c * known[SIN]),
        _double(omega),
        _double(1 / omega),
        doubles.enclosing(place.e),
        early,
        late,
    )
    sides: list[Interval] = []
    for q in (place.h, place.rate):
        (z,) = variables(place, q)
        a, b = asked.box[z]
        slope = value(q.derivative(z), {})
        base = slope * interval.ball(a) + value(q.without(z), known)
        sides += [_double(base), _double(slope * interval.ball(b - a))]
    return p, Sides(*sides)


def _beside(q: Fraction) -> tuple[float, float]:
    """Return a double that is not above a number, and one that is not below."""
    x = float(q)
    low = x if Fraction(x) <= q else math.nextafter(x, -math.inf)
    return low, x if Fraction(x) >= q else math.nextafter(x, math.inf)


def _double(x: Ball) -> Interval:
    """Return an interval of doubles that contains a ball."""
    a, b = interval.ends(x)
    middle = doubles.enclosing((a + b) / 2)
    return doubles.widened(middle, doubles.upper(doubles.enclosing(b - a)))
