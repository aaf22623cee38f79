"""Curves over long ranges of a parameter: what is at their ends is found as over short ones."""

from fractions import Fraction

import pytest
from branches import certificate, pair, thrice

GRAZE, LATE = Fraction("0.1743294284"), Fraction("0.1369565588")
FOLD, LOSS = Fraction("0.9732258895"), Fraction("0.2520345895")
NEAR = Fraction(1, 10**9)


def at(claims, key):
    """Return the values of the parameter at the ends, or points, of a kind."""
    found = [[Fraction(q) for q in each["at"]] for each in claims[key]]
    assert all(0 < high - low < Fraction(1, 10**20) for low, high in found)
    return [low for low, _ in found]


@pytest.mark.parametrize("high", ["5", pytest.param("20", marks=pytest.mark.slow)])
def test_one_hit_of_each_end(high):
    """Down to the graze of `pair`; up through a fold, and on to where a hit is lost."""
    proved, why = pair(("0.05", high))
    claims = proved["claims"]
    (graze,), (lost,) = at(claims, "grazes"), at(claims, "lost")
    assert why == ("", "")
    assert abs(graze - GRAZE) < NEAR
    assert [graze] == at(certificate("graze")["claims"], "grazes")
    assert any(abs(s - FOLD) < NEAR for s in at(claims, "points"))
    assert abs(lost - LOSS) < NEAR


@pytest.mark.parametrize("high", ["0.6", pytest.param("20", marks=pytest.mark.slow)])
def test_two_hits_of_the_top(high):
    """From a graze, through a fold, to where one of the hits is lost: the graze of `pair`."""
    proved, why = thrice(("0.05", high))
    (graze,), (lost,) = (at(proved["claims"], key) for key in ("grazes", "lost"))
    assert why == ("", "")
    assert abs(graze - LATE) < NEAR
    assert abs(lost - GRAZE) < NEAR
