"""An orbit near P* that never turns for many periods, certified until it turns or sticks.

Floats cannot say when: their rounding grows by 10¹⁷ on the way.  So P* is enclosed to 100 digits,
and the certified flow follows the box around P* + (shift, shift), period by period.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from cap.floats.findings import Floats, State
from cap.flow.propagation import Happened, after_periods
from cap.paper.certified import theorem
from cap.parameters import PAPER
from cap.sets import interval, matrix
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

DIGITS = 100
BITS = 512


@dataclass(frozen=True)
class Escape:
    """What is proved: in ``periods`` T there are only hits; in the next T something else happens
    first at the time ``after`` T: ``word``, "turns" or "sticks", empty if the end came before.

    ``states`` (periods + 1, 2): once a period, rounded to doubles.  ``exponent``: per time, of the
    largest growth of a deviation in all these periods.
    """

    periods: int
    word: str
    after: float
    states: Floats
    exponent: float


def escape(near: State, shift: Fraction, most: int) -> Escape:
    """Follow the orbit of P* + (shift, shift), where P* is the elliptic point near a state.

    At most for so many periods.  Raises `NotProved` if its events are not certain.
    """
    own = theorem("elliptic", near, digits=DIGITS)
    with interval.workprec(BITS):
        T = 2 * interval.pi() / interval.ball(PAPER.omega)
        x, v = (_shifted(own[name], shift) for name in "xv")
        states, growth = [(float(x.mid()), float(v.mid()))], _identity()
        first: Happened | None = None
        while first is None and len(states) <= most:
            image = after_periods(PAPER, x, v, 1)
            first = _first_other(image.events)
            if first is None:
                (x, v), growth = image.state, matrix.product(image.monodromy, growth)
                states.append((float(x.mid()), float(v.mid())))
        periods = len(states) - 1
        return Escape(
            periods,
            "" if first is None else f"{first.word.split()[0]}s",
            periods + (float((first.time / T).mid()) if first else 0.0),
            np.array(states),
            float((_largest(growth).log() / (periods * T)).mid()),
        )


def _shifted(pair: list[str], shift: Fraction) -> Ball:
    """Return a ball that contains an enclosure, moved."""
    return interval.hull(*(interval.ball(Fraction(end) + shift) for end in pair))


def _identity() -> Matrix[Ball]:
    return (Ball(1), Ball(0)), (Ball(0), Ball(1))


def _first_other(events: tuple[Happened, ...]) -> Happened | None:
    """Return the first event that is no hit, or None."""
    return next((event for event in events if not event.word.startswith("hit")), None)


def _largest(m: Matrix[Ball]) -> Ball:
    """Return the largest singular value of a matrix of determinant 1."""
    (a, b), (c, d) = m
    total: Ball = a * a + b * b + c * c + d * d
    return ((total + (total * total - 4).sqrt()) / 2).sqrt()
