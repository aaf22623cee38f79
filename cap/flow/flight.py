"""A flight with dry friction, for numbers of any kind: where the mass is, and how fast.

    x'' = F cos ωt - f,      f with the sign of the velocity, which keeps it.

Let X, V be x and v less their responses -c and q to the force, c = (F/ω²) cos ωt, q = (F/ω) sin ωt,
at a time of the flight, and d the time since then, of either sign.  As c'' = -F cos ωt,

    x = X + V d - f d²/2 - c,      v = V + q - f d.

Balls, jets, Taylor and Fourier models, doubles and intervals of them, in Python, in arrays and in
compiled code (`cap.flow.kernels`), have the flight from here, or from the data (`formulas`, where
an oscillator is given).
"""

from typing import Any


def place(X: Any, V: Any, d: Any, half: Any, c: Any) -> Any:
    """Return x; ``half`` is f/2."""
    return X + (V - d * half) * d - c


def velocity(V: Any, d: Any, f: Any, q: Any) -> Any:
    """Return v."""
    return V + q - d * f
