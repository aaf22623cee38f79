"""Cycles on which releases end, in floats."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.floats.engine.releases import images
from cap.floats.search.release_cycles import release_cycles
from cap.parameters import PAPER


@pytest.mark.parametrize(
    ("changes", "periods"), [({"f": "3/10"}, [1]), ({"F": "3/2"}, [2]), ({"f": "39/100"}, [3])]
)
def test_a_cycle_comes_back(changes, periods):
    """After its period, and attracts: the product of the derivatives is small."""
    p = replace(PAPER, **{name: Fraction(value) for name, value in changes.items()})
    cycles = release_cycles(p)
    assert [len(cycle) for cycle in cycles] == periods
    for cycle in cycles:
        x, slopes = np.array([[release.x, release.slope] for release in cycle]).T
        found = images(p, x)
        assert found.value == pytest.approx(np.roll(x, -1), abs=1e-8)
        assert found.slope == pytest.approx(slopes, abs=1e-6)
        assert abs(np.prod(slopes)) < 1
        assert x.argmin() == 0


def test_there_may_be_none():
    """Chaos, and what all goes to the segment."""
    assert release_cycles(PAPER) == []
    assert release_cycles(replace(PAPER, f=Fraction(1, 2))) == []
