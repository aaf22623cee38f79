"""Boxes of the unknowns of events: one lies in another if all its ends do."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cap.checker.particles.existence import lies_in

LARGE = [(Fraction(0), Fraction(4)), (Fraction(-3), Fraction(3))]
SMALL = [(Fraction(1), Fraction(2)), (Fraction(-1), Fraction(1))]


def test_a_box_in_a_box():
    """Ends may be in common."""
    assert lies_in(SMALL, LARGE)
    assert lies_in(LARGE, LARGE)
    assert not lies_in(LARGE, SMALL)


@pytest.mark.parametrize("n", range(2))
@pytest.mark.parametrize("end", range(2))
def test_one_end_outside(n, end):
    """By however little."""
    ends = list(SMALL[n])
    ends[end] = LARGE[n][end] + Fraction(2 * end - 1, 10**9)
    assert not lies_in([tuple(ends) if k == n else SMALL[k] for k in range(2)], LARGE)
