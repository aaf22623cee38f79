"""The flight of `cap.flow.flight` for polynomials with errors, which have functions, no operators.

Units F = ω = 1; p is x, s is v, A and B are V and X, and a is -f where a flight has the sense 1 of
time, f where it has the sense -1.
"""

from collections.abc import Callable
from typing import Any

from cap.sets.compiled import kernel

Operation = Callable[..., Any]


def laws(total: Operation, product: Operation, scaled: Operation, sense: float) -> Any:
    """Return the compiled functions speed, place, start and from_rest.

    The first argument, y, has a and a bound of its error.  d is the time since ref, with the sine
    or the cosine at ref + d.
    """

    @kernel
    def speed(y: Any, A: Any, d: Any, sin: Any) -> Any:
        """Return s."""
        return total(total(sin, scaled(d, sense * y.a, y.a_error)), A)

    @kernel
    def place(y: Any, f: Any, d: Any, cos: Any) -> Any:
        """Return p for the A and B of a flight."""
        drive = scaled(d, 0.5 * sense * y.a, y.a_error)
        return total(scaled(cos, -1.0, 0.0), total(product(d, total(drive, f.A)), f.B))

    @kernel
    def start(y: Any, A: Any, d: Any, cos: Any) -> Any:
        """Return B where p = 0."""
        half = scaled(d, -0.5 * sense * y.a, y.a_error)
        return total(cos, product(d, total(half, scaled(A, -1.0, 0.0))))

    @kernel
    def from_rest(y: Any, d: Any, minus_sin: Any) -> Any:
        """Return A where s = 0, given minus the sine."""
        return total(minus_sin, scaled(d, -sense * y.a, y.a_error))

    return speed, place, start, from_rest
