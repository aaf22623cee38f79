"""How many multipliers lie outside the unit circle."""

import random
from fractions import Fraction

import numpy as np
import pytest

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.shapes import Enclosure
from cap.checker.system.stability import kind_of_two, outside


def thin(*numbers):
    """Return intervals around numbers, not wide."""
    tiny = Fraction(1, 10**12)
    return [Interval.enclosing(Fraction(q) - tiny, Fraction(q) + tiny, 100) for q in numbers]


def symmetric(zeros):
    """Return the elementary symmetric functions."""
    coefficients = np.poly(zeros)
    return [float((-1) ** k * c.real) for k, c in enumerate(coefficients)][1:]


@pytest.mark.parametrize("seed", range(40))
def test_as_many_as_in_floats(seed):
    """Random zeros, in pairs of conjugates and real."""
    draw = random.Random(seed)  # noqa: S311
    zeros = []
    for _ in range(draw.randint(1, 3)):
        z = complex(draw.uniform(-2, 2), draw.uniform(-2, 2))
        zeros += [z, z.conjugate()] if draw.random() < 0.6 else [complex(z.real)]
    if any(abs(abs(z) - 1) < 1e-3 for z in zeros):
        return
    assert outside(thin(*symmetric(zeros))) == sum(abs(z) > 1 for z in zeros)


@pytest.mark.parametrize("numbers", [(1, 1), (2, 1), (0, 1), ("5/2", 1.5), (1,), (0, -1)])
def test_on_the_circle(numbers):
    """With a multiplier on the circle nothing is said; nor where coefficients are equal."""
    assert outside(thin(*numbers)) is None


def test_zeros():
    """Multipliers that are 0 are inside."""
    assert outside(thin(0, 0, 0)) == 0
    assert outside(thin(3, 0, 0)) == 1


@pytest.mark.parametrize(
    ("trace", "product", "unstable", "word"),
    [
        (1, "1/5", 0, "sink, node"),
        (-1, "1/5", 0, "sink, node"),
        ("1/10", "1/5", 0, "sink, focus"),
        (5, 5, 2, "source, node"),
        (0, 5, 2, "source, focus"),
        (3, 1, 1, "a saddle"),
        (-3, 1, 1, "a flip saddle"),
        (1, "1/4", 0, ""),
        (0, 0, 0, ""),
    ],
)
def test_words(trace, product, unstable, word):
    """What is certain of two multipliers has a name."""
    tiny = Fraction(1, 10**6)
    ends = [Enclosure(Fraction(q) - tiny, Fraction(q) + tiny, ("", "")) for q in (trace, product)]
    told = kind_of_two(*ends, unstable)
    assert word in told
    assert bool(told) == bool(word)
