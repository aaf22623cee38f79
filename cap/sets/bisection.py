"""Bisection: the largest size with which a proof step succeeds, and changes of sign.

Sizes only steer, nothing is proved with them; a change of sign is certain.
"""

from collections.abc import Callable
from fractions import Fraction

from cap.errors import NotProved
from cap.sets.interval import Ball

HALVINGS = 60


def largest(step: Callable[[Fraction], object], upper: Fraction, rounds: int) -> Fraction | None:
    """Return the largest size found with which ``step`` does not raise `NotProved`; None if none.

    ``upper`` is halved until it succeeds, then bisected ``rounds`` times.
    """
    size = upper
    for _ in range(HALVINGS):
        if succeeds(step, size):
            break
        size, upper = size / 2, size
    else:
        return None
    for _ in range(rounds if upper > size else 0):
        middle = (size + upper) / 2
        if succeeds(step, middle):
            size = middle
        else:
            upper = middle
    return size


def succeeds(step: Callable[[Fraction], object], size: Fraction) -> bool:
    """Return whether the step is proved with this size."""
    try:
        step(size)
    except NotProved:
        return False
    return True


def crossing(
    function: Callable[[Fraction], Ball], low: Fraction, high: Fraction, places: int
) -> tuple[Fraction, Fraction]:
    """Return neighbouring multiples of 10^-places in [low, high] between which the sign changes.

    The function is certainly positive at the first and certainly negative at the second.  Raises
    `NotProved` if it is not so at the ends, or a sign on the way is not certain.
    """
    scale = 10**places
    a, b = -(-low * scale // 1), high * scale // 1
    if not (a < b and function(Fraction(a, scale)) > 0 > function(Fraction(b, scale))):
        raise NotProved("bisection", "no change of sign from plus to minus", {"ends": (low, high)})
    while b - a > 1:
        middle = (a + b) // 2
        value = function(Fraction(middle, scale))
        if value > 0:
            a = middle
        elif value < 0:
            b = middle
        else:
            sets = {"at": Fraction(middle, scale), "value": value}
            raise NotProved("bisection", "a sign is not certain", sets)
    return Fraction(a, scale), Fraction(b, scale)
