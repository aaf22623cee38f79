"""The map of Hénon: (x, y) -> (1 - a x² + y, b x).

M. Hénon, A two-dimensional mapping with a strange attractor, Comm. Math. Phys. 50 (1976).

Known: at a = 1.4, b = 0.3 its topological entropy is at least 0.46469 (S. Newhouse, M. Berz, J.
Grote, K. Makino, On the estimation of topological entropy on surfaces, Contemp. Math. 469 (2008)).
"""

from fractions import Fraction

from cap import Map, variables

x, y = variables("x y")


def henon(a=Fraction(7, 5), b=Fraction(3, 10)):
    """Return the map of Hénon."""
    return Map("x y", {"x": 1 - a * x**2 + y, "y": b * x})
