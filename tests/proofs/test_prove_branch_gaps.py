"""The theorem branch for walls at many distances, up to the certificate that the checker accepts.

All of them, in steps as small as one likes: ``python benchmarks/sweep_branch.py``.
"""

from fractions import Fraction

import pytest
from closed_forms import setting

from cap.parameters import Parameters
from cap.proofs import branch, theorems
from cap.proofs.fixed_point import Setting, Start
from cap.sets import interval
from cap.subdivision import UNDECIDED, Cell

ODD = Parameters(*map(Fraction, ("3", "2", "1", "1/4", "11/10")))


def cells_accepted(ask):
    """Return how many cells the certificate has; raise `NotProved` if the checker rejects it."""
    return len(theorems.accepted(theorems.THEOREMS["branch"], ask)["claims"]["cells"])


@pytest.mark.slow
@pytest.mark.parametrize("R", ["0.705", pytest.param("2.9", marks=pytest.mark.slow)])
def test_near_both_ends(R):
    """Where the pair ends soon after its birth, and where it is born at little friction."""
    assert cells_accepted(setting(R)) > 10


@pytest.mark.slow
def test_in_between():
    """F = 3, omega = 2 and walls at 1/4 and 11/10: near R = 1.1 for F = omega = 1."""
    assert cells_accepted(Setting(ODD, Start(0.0, 0.0, ()), 12)) > 50


def test_a_cell_is_halved_until_its_enclosure_is_sharp():
    """At R = 1.1 near the period doubling, where (1 + T) tau_1 grows tenfold on few cells."""
    rho, cell = Fraction("1.1"), Cell(Fraction("0.224602"), Fraction("0.234569"))
    assert branch.examine_twist(rho, cell) == UNDECIDED
    for half in cell.halves():
        low, high = map(Fraction, branch.examine_twist(rho, half).split())
        values = []
        for k in range(9):  # the values at points, as the whole cell has none that are much larger
            delta = half.lower + (half.upper - half.lower) * Fraction(k, 8)
            tiny = Cell(delta, delta + Fraction(1, 10**12))
            values += map(Fraction, branch.examine_twist(rho, tiny).split())
        size = max(map(abs, values))
        assert low <= min(values)
        assert max(values) <= high
        assert max(min(values) - low, high - max(values)) < size / 10


def test_what_is_left_decides():
    """A model whose remainder is a twentieth of its values is not sharp; a smaller one is."""
    with interval.workprec(53):
        model = branch._model(Cell(Fraction(1), Fraction(2)))
        assert branch.is_sharp(model.widened(interval.around(Fraction(0), Fraction(9, 100))))
        assert not branch.is_sharp(model.widened(interval.around(Fraction(0), Fraction(12, 100))))
