"""Random intervals of the checker, and points in them: helpers of the tests."""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.interval import Interval

BITS = (8, 53, 64, 200, 300)


def some_integer(rng, bits):
    """Return a random integer of any size up to 3 bits; 0 and ±1 in units are among them."""
    kind = rng.randrange(6)
    if kind == 0:
        return rng.choice((0, 1, -1, 1 << bits, -(1 << bits), (1 << bits) + 1, (1 << bits) - 1))
    size = rng.choice((4, bits // 2, bits, bits + 8, 3 * bits))
    return rng.randint(-(1 << size), 1 << size)


def some_interval(rng, bits):
    """Return a random interval, from a point to very wide."""
    a = some_integer(rng, bits)
    width = rng.choice((0, 0, 1, 2, 1 << (bits // 2), 1 << bits, 1 << (2 * bits)))
    return Interval(a, a + rng.randint(0, width), bits)


def points(rng, x):
    """Return both ends of an interval and two points between them."""
    inner = [rng.randint(x.lo, x.hi) for _ in range(2)]
    return [Fraction(n, 1 << x.bits) for n in (x.lo, x.hi, *inner)]


def contains(x, q):
    """Return whether an interval contains a rational number."""
    return x.lower <= q <= x.upper
