"""Cosines and sines of doubles, and doubles next to numbers, against mpmath."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from mpmath import mp, workdps

from cap.checker.kernel.angles import cos_sin, of, rounded
from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.rejection import Rejected


def test_cosine_and_sine_of_doubles():
    """At random numbers, and next to the multiples of pi/2, where the reduction cancels most."""
    rng = random.Random(4)  # noqa: S311
    hard = [float(k * mp.pi / 2) for k in range(-40, 40)]
    with workdps(40):
        for a in [rng.uniform(-90, 90) for _ in range(3000)] + hard:
            cos, sin = cos_sin(a)
            assert abs(mp.cos(a) - cos) <= 2.0**-50
            assert abs(mp.sin(a) - sin) <= 2.0**-50
    cos_sin(65535 * float(mp.pi / 2))
    for quarters in (65536, -65536, 10**6):  # P is a multiple of 2^-32: 2^16 P is a double
        with pytest.raises(Rejected, match="too large"):
            cos_sin(quarters * float(mp.pi / 2))


def test_doubles_next_to_numbers():
    """With bounds of the differences, which are not much larger."""
    third = Fraction(1, 3)
    a, e = rounded(third)
    assert abs(Fraction(a) - third) <= Fraction(e) <= Fraction(1, 2**54)
    z = pi(100)
    a, e = of(z)
    for end in (z.lower, z.upper):
        assert abs(Fraction(a) - end) <= Fraction(e) < Fraction(1, 2**51)
