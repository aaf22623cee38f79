"""Compiled: whether states are in a strip of `cap.checker.folded.strip`."""

from cap.checker.folded.numbers import Pair
from cap.checker.folded.strip import Strip
from cap.sets.compiled import kernel


@kernel
def inside(strip: Strip, speeds: Pair, x: Pair, both: Pair) -> bool:
    """Return whether states with these bounds of s, of x and of x + k w are in a strip."""
    least, most = strip.fast - strip.d, strip.slow + strip.d
    left, right = strip.left, strip.right
    here = left < x[0] and x[1] < right and left < both[0] and both[1] < right
    return least < speeds[0] and speeds[1] < most and here
