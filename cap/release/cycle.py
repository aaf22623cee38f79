"""Cycles of the release map that attract: found in floats, proved in balls."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap.errors import NotProved
from cap.flow.model import Oscillator
from cap.parameters import Parameters
from cap.release.passage import image
from cap.release.trap import value
from cap.release.unimodal import nearby
from cap.sets import interval
from cap.sets.interval import Ball

TRANSIENT, LONGEST = 3000, 64  # iterates before a cycle is looked for; its period
CLOSE = 1e-7  # of R


@dataclass(frozen=True)
class Round:
    """The ``images`` of a ball under G, ..., G^p, after itself; ``slope`` encloses (G^p)'."""

    images: tuple[Ball, ...]
    slope: Ball


def foreseen_cycle(p: Parameters, x: float) -> tuple[float, ...]:
    """Return the cycle that attracts a place, in floats; of no points if none is found."""
    orbit: list[float] = []
    for _ in range(TRANSIENT + 2 * LONGEST):
        here = value(p, x)
        if here is None:
            return ()
        x = here.value
        orbit.append(x)
    late, close = orbit[TRANSIENT:], CLOSE * float(p.R)
    for period in range(1, LONGEST + 1):
        if all(abs(a - b) < close for a, b in zip(late, late[period:], strict=False)):
            return tuple(late[-period:])
    return ()


def followed(osc: Oscillator[Any], p: Parameters, x: Ball, period: int) -> Round:
    """Return the images of a ball under G, ..., G^period.

    Raises `NotProved` where the events from an image are undecided.
    """
    images, slope = [x], Ball(1)
    for _ in range(period):
        x, here = image(osc, x, nearby(p, float(x.mid())))
        slope *= here
        images.append(x)
    return Round(tuple(images), slope)


def refined(osc: Oscillator[Any], p: Parameters, x: float, period: int) -> Ball:
    """Return a point close to a cycle, at the working precision: Newton's method, no proof."""
    point = Ball(x)
    for _ in range(interval.working_bits().bit_length() + 2):
        found = followed(osc, p, point, period)
        point = interval.point(point - (found.images[-1] - point) / (found.slope - 1))
    return point


def contracted(
    osc: Oscillator[Any], p: Parameters, ends: tuple[Fraction, Fraction], period: int
) -> Round:
    """Prove that G^period takes an interval into its interior, and contracts it."""
    low, high = map(interval.ball, ends)
    found = followed(osc, p, interval.hull(low, high), period)
    if not (low < found.images[-1] < high and abs(found.slope) < 1):
        sets = {"interval": [float(end) for end in ends], "slope": found.slope}
        raise NotProved("cycle", "an iterate of the release map may not contract", sets)
    return found
