"""Certificates of periodic orbits of four systems, each proved once."""

from copy import deepcopy
from fractions import Fraction
from functools import cache

import models
from orbits.test_periodic import GUESS, HITS, STOP, TABLE, two_masses

from cap.orbits.itinerary import Itinerary
from cap.parameters import PAPER
from cap.proofs.contacts import prove
from cap.system.friction import oscillator

SPRING = models.spring(Fraction(27, 10), Fraction(9, 10), Fraction(1, 20), Fraction(1, 10))
__all__ = ["CASES", "SPRING", "STOP", "certificate"]

CASES = {
    "ball": lambda: (Itinerary(models.ball(), TABLE), [0.51, 0.58, -3.14]),
    "spring": lambda: (Itinerary(SPRING, STOP), [1.0, 0.1, 1.0]),
    "elliptic": lambda: (Itinerary(oscillator(PAPER), HITS), GUESS),
    "two masses": lambda: two_masses()[1:],
}


def certificate(name):
    """Return a certificate, which may be changed."""
    return deepcopy(_proved(name))


@cache
def _proved(name):
    return prove(*CASES[name]())
