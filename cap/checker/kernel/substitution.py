"""Jets in the place of the variables of a polynomial, which is a jet itself."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import accumulate
from operator import mul

from cap.checker.kernel.jet import Jet, S


def substituted(polynomial: Jet[S], arguments: Sequence[Jet[S]]) -> Jet[S]:
    """Return a polynomial with jets in the place of its variables, all without constant term."""
    order = min(polynomial.order, arguments[0].order)
    known = [list(accumulate([argument] * order, mul)) for argument in arguments]  # powers
    total = Jet[S](order, {})
    for power, c in polynomial.coefficients.items():
        factors = (known[n][k - 1] for n, k in enumerate(power) if k)
        total = total + reduce(mul, factors) * c
    return total
