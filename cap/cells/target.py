"""A part of the basin of the segment, for what is compiled: see `cap.checker.folded.strip`."""

from typing import NamedTuple

from cap.sets.compiled import kernel

Pair = tuple[float, float]


class Strip(NamedTuple):
    """The states (x, s) with |w| < d, x and x + k w in (left, right), w = s - v, v in [slow, fast].

    x = edge + p.  There is no strip if d is 0.
    """

    left: float
    right: float
    slow: float
    fast: float
    d: float
    k: float
    edge: float
    edge_error: float


NOWHERE = Strip(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def inside(strip: Strip, speeds: Pair, x: Pair, both: Pair) -> bool:
    """Return whether states with these bounds of s, of x and of x + k w are in a strip."""
    least, most = strip.fast - strip.d, strip.slow + strip.d
    left, right = strip.left, strip.right
    here = left < x[0] and x[1] < right and left < both[0] and both[1] < right
    return least < speeds[0] and speeds[1] < most and here
