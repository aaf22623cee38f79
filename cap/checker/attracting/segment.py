"""The segment of orbits that touch no wall, as in the theorem `segment`, and its basin."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from cap.checker.attracting.part import Part
from cap.checker.folded.basins import Basins, Bounds, Row, rounded
from cap.checker.folded.units import above, below
from cap.checker.kernel.shapes import columns
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems.segment import Segment


class Strip(NamedTuple):
    """The states (p, s) in all rows, p minus the distance to the wall ahead: to the segment."""

    rows: tuple[Row, Row, Row]

    def contains(self, bounds: Bounds) -> bool:
        """Return whether some states are in it."""
        return all(
            row.low < low and high < row.high
            for row in self.rows
            for low, high in [bounds(rounded(row.a), rounded(row.b))]
        )


class Touching(Part):
    """The segment."""

    CLAIM = columns(Segment.CLAIMS)

    def prove(self, known: Basins) -> None:  # noqa: ARG002
        """Prove the theorem `segment`."""
        it = self.theorem
        part = Certificate("segment", it.p, it.certificate.digits, self.claim, it.hints)
        Segment(part, it.step).prove()

    def basins(self) -> Basins:
        """Return a strip in the basin that is claimed."""
        return Basins((self.strip(),))

    def strip(self) -> Strip:
        """Return a part of the basin: the states that move to the right, and those mirrored.

        With D(w) = a w + b w^2 and k = a + b d, D(w) <= k w for 0 <= w <= d.  So a state (x, v) is
        in the basin if x and x + k (v - u) are in (left, right) and |v - u| < d, u the velocity of
        the orbits of the segment, which is known to be in an interval; p = x - r.
        """
        units, claims = self.scale, self.claim
        d, (a, b) = claims["basin"]["speed"], claims["basin"]["drift"]
        slow, fast = (units.speed(u) for u in claims["v"][:2])
        left, right = units.length(claims["left"].upper), units.length(claims["right"].lower)
        edge, k = units.length(units.p.r), Fraction(above((a + b * d) * units.p.omega))
        d = units.speed(d) * (1 - Fraction(1, 10**9))
        rows = (
            Row(1.0, 0.0, above(left - edge), below(right - edge)),
            Row(0.0, 1.0, above(fast - d), below(slow + d)),
            Row(1.0, float(k), above(left - edge + k * fast), below(right - edge + k * slow)),
        )
        return Strip(rows)


PART = Touching
