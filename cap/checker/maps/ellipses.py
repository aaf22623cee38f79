"""What theorems about effective stability claim: two ellipses, and how long orbits stay.

The lemma is that of ``drift``: motions from E' = {c + A u : |u| <= part} at t = 0 are in E = {c + A
u : |u| <= 1} at all multiples of T up to N T, forwards and backwards.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Table
from cap.checker.maps.drift import Polynomial, Rows, change, drift, eliminated, excess, half_widths


def fields(size: int, state: str) -> Table:
    """Return the claims on ellipses in a space of this dimension."""
    return (
        Field("centre", [number] * size, "", "c", f"{state}, of the ellipses"),
        Field("axes", [[number] * size] * size, "", "A",
              "rows: the ellipse E is the set of all c + A u, |u| <= 1"),
        Field("part", number, "", r"\kappa",
              "the inner ellipse E' is the set of all c + A u, |u| <= part; P* is in it; part < 1"),
        Field("periods", number, "", "N",
              "an integer: motions from E' at t = 0 are in E at t = nT, |n| <= periods"),
    )  # fmt: skip


class Ellipses(NamedTuple):
    """The claims."""

    centre: Sequence[Fraction]
    axes: Rows
    part: Fraction
    periods: Fraction

    @classmethod
    def of(cls, claims: dict[str, Any]) -> Ellipses:
        """Return those of a certificate, which must be such."""
        found = cls(*(claims[name] for name in cls._fields))
        need(0 < found.part < 1, "the inner ellipse is not the smaller one")
        whole = found.periods >= 1 and found.periods.denominator == 1
        need(whole, "periods is not a positive integer")
        return found

    def box(self, bits: int) -> list[Interval]:
        """Return the least box around E."""
        halves = half_widths(self.axes, bits)
        return [
            Interval.enclosing(c - half.upper, c + half.upper, bits)
            for c, half in zip(self.centre, halves, strict=True)
        ]

    def hold(self, fixed_point: Sequence[Interval]) -> None:
        """Prove that A is regular, and the fixed point in E'."""
        bits = fixed_point[0].bits
        inverse = eliminated(self.axes)[1]
        square = Interval.enclosing(0, 0, bits)
        for row in inverse:
            u = square.integer(0)
            for entry, z, c in zip(row, fixed_point, self.centre, strict=True):
                offset = z - Interval.enclosing(c, c, bits)
                u = u + offset * Interval.enclosing(entry, entry, bits)
            square = square + u.square()
        most = Interval.enclosing(self.part**2, self.part**2, bits)
        need(square.is_before(most), "P* is not certainly in the inner ellipse")

    def last(self, H: Polynomial, z: Sequence[Centred]) -> None:
        """Prove that orbits stay so long; ``z`` are the coordinates and their images over a box."""
        bits = z[0].value.bits
        part = Interval.enclosing(self.part**2, self.part**2, bits)
        inner, outer = part + excess(H, self.part, bits), -excess(H, Fraction(1), bits) + 1
        lost = drift(change(H, self.axes, self.centre, z), self.axes) * int(self.periods)
        need((inner + lost).is_before(outer), "orbits may leave the ellipse before")

    def words(self, told: Callable[..., str], sentence: str) -> str:
        """Return a sentence with c, A, and the part."""
        return told(
            sentence,
            c=", ".join(map(decimal, self.centre)),
            A=", ".join(f"({', '.join(map(decimal, row))})" for row in self.axes),
            kappa=decimal(self.part),
        )
