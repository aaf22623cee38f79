"""A flight of a mass with dry friction, for numbers of any kind: where it is, and how fast.

    x'' = F cos wt - f,      f with the sign of the velocity, which keeps it.

Let X, V be x and v less their responses -c and q to the force, c = (F/w^2) cos wt, q = (F/w) sin
wt, at a time of the flight, and d the time since then, of either sign.  As c'' = -F cos wt,

    x = X + V d - f d^2/2 - c,      v = V - f d + q.

These formulas stand here for all theorems; with viscosity they follow from the data (``losses``).
"""

from typing import Any, TypeVar

N = TypeVar("N", bound=Any)


def place(X: N, V: N, d: Any, half: Any, c: Any) -> N:
    """Return x; ``half`` is f/2."""
    return X + (V - d * half) * d - c  # type: ignore[no-any-return]


def velocity(V: N, d: Any, f: Any, q: Any) -> N:
    """Return v."""
    return V - d * f + q  # type: ignore[no-any-return]
