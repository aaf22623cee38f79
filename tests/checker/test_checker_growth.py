"""How fast a matrix grows is claimed from below, by a vector."""

from fractions import Fraction

import pytest

from cap.checker.kernel.growth import confirm_growth
from cap.checker.kernel.rejection import Rejected

GOLDEN = [range(1, 2), range(2)]
VECTOR, ROOT = [1000000000, 1618033989], Fraction(1618033988, 10**9)


def test_growth():
    """Of the golden mean, as far as the vector shows; in each row its own."""
    confirm_growth(GOLDEN, VECTOR, [ROOT, ROOT])
    for i in range(2):
        rates = [ROOT, ROOT]
        rates[i] += Fraction(2, 10**9)
        with pytest.raises(Rejected, match="may not grow"):
            confirm_growth(GOLDEN, VECTOR, rates)


@pytest.mark.parametrize(
    ("vector", "why"),
    [
        ([1], "one entry"),
        ([1, -1], "negative"),
        ([0, 0], "zero"),
        (VECTOR[::-1], "grow"),
    ],
)
def test_vectors_of_no_use(vector, why):
    """A vector of zeros proves nothing, nor does a negative one."""
    with pytest.raises(Rejected, match=why):
        confirm_growth(GOLDEN, vector, [ROOT, ROOT])
