"""Rotation numbers of low order, and the terms of a map that they keep."""

from fractions import Fraction


def kept(degree: int, rotation: Fraction) -> list[tuple[int, int]]:
    """Return (a, b) for the monomials z^a z̄^b of a degree that no change of coordinates removes.

    They are those with (a - b - 1) θ in 2πZ, θ = 2π ``rotation``.
    """
    pairs = [(a, int(degree) - a) for a in range(int(degree) + 1)]
    return [(a, b) for a, b in pairs if ((a - b - 1) * rotation).denominator == 1]


def of_order(most: int) -> list[Fraction]:
    """Return the numbers in (0, 1) with a denominator that is at most so large, ascending."""
    return sorted({Fraction(p, q) for q in range(1, int(most) + 1) for p in range(1, q)})
