"""Trigonometric polynomials as a certificate has them: re im, re im, ..., integers."""

from __future__ import annotations

import re

from cap.checker.kernel.fourier import Circle, Coefficients, Function
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Many, Whole

COARSE = 20  # decimal places of what need not be sharp
LARGEST = 10**6  # of coefficients
POLYNOMIAL = re.compile("-?[0-9]{1,400} -?[0-9]{1,400}(,-?[0-9]{1,400} -?[0-9]{1,400})*")
QUOTIENTS = Many(Whole(1, 999), 1, 40)


def function(circle: Circle, words: str, unit: int) -> Function:
    """Return a trigonometric polynomial; its numbers are in so many units of the circle."""
    parts = [(re * unit, im * unit) for re, im in coefficients(words)]
    largest = max(abs(part) for pair in parts for part in pair)
    need(largest <= LARGEST * circle.unit, f"a coefficient is larger than {LARGEST}")
    return Function(circle, parts, 0)


def coefficients(words: str) -> Coefficients:
    """Return the coefficients of 0, 1, ...: complex integers; that of 0 is real."""
    need(POLYNOMIAL.fullmatch(words) is not None, "a list of coefficients is not one")
    pairs = [tuple(map(int, part.split(" "))) for part in words.split(",")]
    need(pairs[0][1] == 0, "a mean value is not real")
    return [(re, im) for re, im in pairs]
