"""Polynomials in four variables as rows of floats, for compiled code."""

import math
from collections.abc import Sequence

from numba.extending import register_jitable

from cap.floats.findings import Floats
from cap.system.polynomial import PI, Polynomial


def terms(q: Polynomial, names: Sequence[str]) -> list[float]:
    """Return how many terms there are, and of each its coefficient and the powers of four names."""
    numbers = [float(len(q.terms))]
    for monomial, c in q.terms.items():
        powers = dict(monomial)
        numbers.append(float(c) * math.pi ** powers.get(PI, 0))
        numbers += [float(powers.get(name, 0)) for name in names]
    return numbers


@register_jitable
def evaluated(y: Floats, n: int, x: float, v: float, c: float, s: float) -> tuple[float, int]:
    """Return the sum of products that stands from the place n on, and the place after it."""
    total, count = 0.0, int(y[n])
    n += 1
    for _ in range(count):
        term = y[n]
        for _ in range(int(y[n + 1])):
            term *= x
        for _ in range(int(y[n + 2])):
            term *= v
        for _ in range(int(y[n + 3])):
            term *= c
        for _ in range(int(y[n + 4])):
            term *= s
        total += term
        n += 5
    return total, n
