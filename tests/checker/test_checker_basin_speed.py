"""How fast the basin of the segment may be, where pi and the first turn are known less well."""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest

from cap.checker.flow.free import Free
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters

P = Parameters(*map(Fraction, (3, 2, 1, -1, 1)))
KAPPA = Fraction(1, 2)  # (F - f)/(F + f)


def drift(d, pi, turn, a=(1000, 1000)):
    """Check the drift from what is known of pi and of the first turn."""
    claims = {
        "basin": {"speed": Fraction(d), "drift": tuple(map(Fraction, a))},
        "turning_times": [SimpleNamespace(lower=Fraction(turn[0]), upper=Fraction(turn[1]))],
    }
    known = SimpleNamespace(
        p=P, claims=claims, pi=lambda: Interval.enclosing(*map(Fraction, pi), 9)
    )
    Free.drift(known)


def test_the_least_of_what_is_known_bounds_the_speed():
    """d <= pi (F + f)^2/(2 omega F) and d <= t_1 (F + f), for all pi and t_1 that are possible."""
    drift(4, (3, 4), (2, 9))
    with pytest.raises(Rejected, match="too fast for a period"):
        drift("4.01", (3, 4), (2, 9))
    drift(2, (3, 4), ("0.5", 9))
    with pytest.raises(Rejected, match="too fast for the first turn"):
        drift("2.01", (3, 4), ("0.5", 9))


def test_the_largest_of_what_is_known_bounds_the_drift():
    """a_1 >= t_1 + pi (F - f)/(2 omega f), a_2 >= f/((F + f)^2 (1 - kappa^4))."""
    first, second = 5 + Fraction(4) * 2 / 4, Fraction(1) / (16 * (1 - KAPPA**4))
    less = Fraction(1, 10**6)
    drift(1, (3, 4), (2, 5), (first, second))
    with pytest.raises(Rejected, match="to first order"):
        drift(1, (3, 4), (2, 5), (first - less, second))
    with pytest.raises(Rejected, match=r"larger than claimed$"):
        drift(1, (3, 4), (2, 5), (first, second - less))
