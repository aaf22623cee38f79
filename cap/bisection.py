"""The largest size with which a proof step succeeds: it only steers, nothing is proved here."""

from collections.abc import Callable
from fractions import Fraction

from cap.errors import NotProved

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
