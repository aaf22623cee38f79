"""Whether this processor, in this thread, computes with doubles as IEEE 754 has it.

What is proved in doubles needs that sums, products, quotients and square roots are rounded once, to
the nearest double, ties to even, with gradual underflow.  A thread may be set otherwise, by another
library say, at any time; what Python was compiled for does not tell.  So sums are looked at whose
rounding tells, of numbers that are made while the program runs.  With h = 2^-53:

    1 + h = 1, -1 - h = -1            not if rounded upwards, downwards, or ties away from 0
    1 + m > 1, -1 - m < -1            m = h (1 + 2^-52); not if rounded to 0, or first to the 64
                                      bits of an extended double, where 1 + m becomes the tie 1 + h
    2^-1022/2 > 0, 2^-1074 2^900 > 0  not if small results, or operands, are flushed to 0

*When.*  A proof in doubles asks when it begins and when it ends, and so does each task of one, in
its own process (``processes``): between, nothing but the checker runs there.

*Trusted besides*, for it cannot be seen from a few numbers: ``math.sqrt`` is rounded as quotients
are; ``math.hypot`` and ``math.fsum`` err by less than 2^-51 of their results; ``math.nextafter``,
comparisons, and the nearest doubles of integers and fractions are right to the last bit.  The
cosines, sines and arccosines of ``math`` only steer.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from cap.checker.kernel.rejection import Rejected, need

NUMBERS = "0x1p0", "0x1p-53", "0x1.0000000000001p-53", "0x1p-1022", "0x1p-1074", "0x1p900"


def rounds_to_nearest() -> bool:
    """Return whether doubles are those of IEEE 754, rounded to nearest, in this thread, now."""
    binary = (sys.float_info.radix, sys.float_info.mant_dig) == (2, 53)
    return binary and as_it_should(*map(float.fromhex, NUMBERS))


def as_it_should(one: float, h: float, m: float, normal: float, least: float, large: float) -> bool:
    """Return whether sums, products and quotients of the ``NUMBERS`` are rounded so."""
    ties = one + h == one and -one - h == -one
    more = one + m > one and -one - m < -one
    return ties and more and normal / (one + one) > 0 and least * large > 0


def need_doubles() -> None:
    """Reject, unless doubles are so."""
    need(
        rounds_to_nearest(),
        "doubles are not those of IEEE 754 here: not rounded to nearest, or flushed to zero",
    )


@contextmanager
def in_doubles() -> Iterator[None]:
    """Do what is proved in doubles: they are so when it begins and when it ends.

    Where a double would be too large, or is no number and no integer is next to it, it rejects.
    """
    need_doubles()
    try:
        yield
    except (ArithmeticError, ValueError) as reason:
        raise Rejected(f"what is computed is not a finite double: {reason}") from None
    need_doubles()
