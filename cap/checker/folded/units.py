"""The units of the folded flow: places, speeds and distances to the wall ahead, as doubles.

Lengths are in units of F/omega^2, times of 1/omega (`cap.checker.folded.flights`).
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

from cap.checker.folded.numbers import Pair
from cap.checker.folded.portions import roof
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Enclosure
from cap.checker.system.walls import Parameters


class Distances(NamedTuple):
    """Distances to the wall ahead: an interval that contains those meant, and one within them."""

    outer: Pair
    inner: Pair


class Units(NamedTuple):
    """The units at some parameters."""

    p: Parameters

    def length(self, x: Fraction) -> Fraction:
        """Return a length in units of F/omega^2."""
        return x * self.p.omega**2 / self.p.F

    def speed(self, v: Fraction) -> Fraction:
        """Return a speed in units of F/omega."""
        return v * self.p.omega / self.p.F

    def width(self) -> float:
        """Return the largest distance to the wall ahead, or a little more."""
        return roof(self.length(self.p.r - self.p.l))

    def distances(self, places: Enclosure) -> Distances:
        """Return the distances to the wall ahead of releases to the right from these places."""
        a, b = places[:2]
        need(self.p.l < a < b < self.p.r, "an interval of places is not between the walls")
        low, high = self.length(self.p.r - b), self.length(self.p.r - a)
        return Distances((below(low), above(high)), (above(low), below(high)))


def above(x: Fraction) -> float:
    """Return a double that is not less."""
    a = float(x)
    return a if Fraction(a) >= x else math.nextafter(a, math.inf)


def below(x: Fraction) -> float:
    """Return a double that is not more."""
    return -above(-x)
