"""How many multipliers lie outside the unit circle, from their elementary symmetric functions.

The multipliers are the zeros of p(z) = z^n - e_1 z^(n-1) + e_2 z^(n-2) - ...  With p = a_0 z^n +
... + a_n let p*(z) = a_n z^n + ... + a_0.  On the unit circle |p*| = |p|.  If |a_n| < |a_0|, then

    q(z) = (a_0 p(z) - a_n p*(z))/z

is a polynomial of degree n - 1, which has all zeros of p on the circle; and if there are none, q
has one zero less inside than p: a_0 p - a_n p* has as many there as p by Rouche's theorem, one of
them 0.  If |a_n| > |a_0|, the zeros of p* are 1/z for the zeros z of p: those of p outside are
those of p* inside.  If all comparisons are certain down to a polynomial without zeros, p has no
zero on the circle.

With e_k/r^k for e_k it is the circle of radius r.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.shapes import Enclosure


def outside(symmetric: Sequence[Interval]) -> int | None:
    """Return how many multipliers lie outside, if none is on the circle; None if unclear."""
    one = symmetric[0].integer(1)
    signs = (1 if k % 2 == 0 else -1 for k in range(len(symmetric) + 1))
    inside = _inside([a * s for a, s in zip([one, *symmetric], signs, strict=True)])
    return None if inside is None else len(symmetric) - inside


def _inside(p: Sequence[Interval]) -> int | None:
    """Return how many zeros of a polynomial lie inside the circle, if none is on it."""
    if len(p) == 1:
        return 0
    first, last = p[0].magnitude(), p[-1].magnitude()
    if last.is_before(first):
        found = _inside([p[0] * a - p[-1] * b for a, b in zip(p, reversed(p), strict=True)][:-1])
        return None if found is None else found + 1
    if first.is_before(last):
        found = _inside([*reversed(p)])
        return None if found is None else len(p) - 1 - found
    return None


def kind_of_two(trace: Enclosure, product: Enclosure, unstable: int) -> str:
    """Return what two multipliers are called, as many outside the circle; nothing if unclear.

    They are real if trace^2 > 4 product, and a pair of conjugates if trace^2 < 4 product.
    """
    squares = trace.lower**2, trace.upper**2
    least = min(squares) if trace.lower * trace.upper > 0 else Fraction(0)
    if unstable == 1:
        names = {trace.lower > 0: " (a saddle)", trace.upper < 0: " (a flip saddle)"}
    else:
        name = "source" if unstable else "sink"
        names = {
            least > 4 * product.upper: f" (a {name}, node)",
            max(squares) < 4 * product.lower: f" (a {name}, focus)",
        }
    return names.get(True, "")
