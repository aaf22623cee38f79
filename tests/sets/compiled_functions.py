"""Small compiled functions with intervals, for the tests of what numba makes of them."""

from numba import njit

from cap.sets.circular import acos, sin_cos
from cap.sets.compiled import IEEE, kernel, rounds_to_nearest, rows
from cap.sets.decay import relax
from cap.sets.doubles import Interval, between, clipped, hull, sqrt, square
from cap.sets.records import Record, assign


class Pair(Record):
    """An interval with its number."""

    k: int
    x: Interval


class Triple(Record):
    """Two pairs and a double."""

    first: Pair
    second: Pair
    weight: float


pair_at = rows(Pair)


@kernel
def polynomial(x, y):
    """Return a value that takes all operators, on intervals and doubles."""
    return (2.0 * x - y * y + 1.0) / (3.0 - x) - x / 7.0 + 5.0 / (y + 3.0) + (-x)


@kernel
def elementary(x, y):
    """Return a value that takes all functions."""
    sine, cosine = sin_cos(x)
    D, h, k = relax(square(y), square(x))
    both = hull(clipped(sine, -0.5, 0.5), between(-0.25, 0.25)) + acos(0.25 * cosine)
    return both + sqrt(2.0 + sine) * cosine - D * (h + k)


@kernel
def exchange(t, table):
    """Write into records, and a row of a table; return a field."""
    t.first.x = t.second.x * t.weight
    t.first.k = t.first.k + 3
    assign(pair_at(table, 1), t.first)
    t.weight = 7.0
    return t.second.k


def compiled(function):
    """Compile a function of two arguments as the kernels are."""

    def outer(x, y):
        return function(x, y)

    return njit(**IEEE)(outer)


probe = njit(**IEEE)(rounds_to_nearest)
