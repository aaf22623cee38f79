"""Church and Fortin's billiard: a ball under gravity over a parabola that moves up and down.

    x'' = 0,  y'' = -g,  y > a x^2 + E sin(2 pi t)

At the table the velocity relative to it keeps its tangential part; its normal part is multiplied by
-e.  Units: seconds and metres, g = 9.81.

K. E. M. Church, C. Fortin, Computer-assisted methods for analyzing periodic orbits in vibrating
gravitational billiards (2020).

Known: tables of orbits with two impacts.  Infinitely many impacts that accumulate have no resting
mode here: a ball that slides along a parabola has no flight that is linear in the state.
"""

from fractions import Fraction

from cap import Bounce, Guard, Mode, System, variables

x, y, v, w, sin, pi = variables("x y v w sin pi")


def billiard(a=Fraction(9, 5), e=Fraction(3, 4), E=Fraction(3, 2), g=Fraction(981, 100)):
    """Return the billiard over a x^2 + E sin(2 pi t), with the restitution e."""
    table = Guard(y - a * x**2 - E * sin, "fly", Bounce(e))
    fly = Mode({"x": v, "y": w, "v": 0, "w": -g}, {"table": table})
    return System("x y v w", 2 * pi, {"fly": fly})
