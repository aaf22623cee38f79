"""Small compiled functions with intervals, for the tests of what numba makes of them."""

from numba import njit

from cap.sets.circular import acos, sin_cos
from cap.sets.compiled import IEEE, kernel, rounds_to_nearest
from cap.sets.doubles import between, clipped, hull, sqrt, square


@kernel
def polynomial(x, y):
    """Return a value that takes all operators, on intervals and doubles."""
    return (2.0 * x - y * y + 1.0) / (3.0 - x) - x / 7.0 + 5.0 / (y + 3.0) + (-x)


@kernel
def elementary(x, y):
    """Return a value that takes all functions."""
    sine, cosine = sin_cos(x)
    both = hull(clipped(sine, -0.5, 0.5), between(-0.25, 0.25)) + acos(0.25 * cosine)
    return both + sqrt(2.0 + sine) * cosine - square(y) * square(x)


def compiled(function):
    """Compile a function of two arguments as the kernels are."""

    def outer(x, y):
        return function(x, y)

    return njit(**IEEE)(outer)


probe = njit(**IEEE)(rounds_to_nearest)
