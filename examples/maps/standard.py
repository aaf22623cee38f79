"""The standard map: (x, y) -> (x + y', y'), y' = y + K sin x, both modulo 2 pi.

B. V. Chirikov, A universal instability of many-dimensional oscillator systems, Phys. Rep. 52
(1979).
"""

from cap import Map, variables

x, y, sin = variables("x y sin")


def standard(K=2):
    """Return the standard map on the torus."""
    return Map("x y", {"x": x + y + K * sin, "y": y + K * sin}, torus=True)
