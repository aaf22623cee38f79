"""Nothing else happens: on each leg of an orbit all guards of its mode are positive.

Each guard h of the mode is positive between the contacts at the ends of the leg by one of

* *Lemma M* (h falls, or rises, while other guards are positive): then its end, or its start;
* *Lemma C* ((L + λ) h is a function of the clock): e^(λt) h first rises, then falls between times
  that the clock alone decides, so h is positive if it is so there and at both ends;
* *Lemma B* else: the leg is cut until on each piece, with D <= L² h there, by Taylor's formula

      h(t) >= h(m) + L h(m) (t - m) + D (t - m)²/2 > 0.

At an end h may be zero: at the start by an identity (`cap.orbits.itinerary`), at the end where it
is the guard of the next contact.  Lemma B then needs h'(start) + min(D, 0) |piece|/2 > 0, or D > 0
if L h vanishes there, too; and the same from the end.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.orbits.equations import Equations
from cap.orbits.leg import Watch
from cap.orbits.minima import Minima, minima
from cap.orbits.numbers import Balls
from cap.sets import interval
from cap.sets.interval import Ball

DEPTH = 40  # of cuts in halves


class Reason(NamedTuple):
    """Why a guard is positive on a leg: the lemma, and the times of the cuts if it is B."""

    leg: int
    guard: str
    lemma: str
    cuts: tuple[float, ...] = ()
