"""A ball that bounces on a vibrating table.

    y'' = -g,  y > A sin t,     at y = A sin t:  w -> -e w,  w = y' - A cos t

Units in which the table has the frequency 1; g/A is the reciprocal of its reduced acceleration.
The ball lies on the table after infinitely many bounces, until the table falls faster than g.

P. J. Holmes, The dynamics of repeated impacts with a sinusoidally vibrating table, J. Sound Vib. 84
(1982); N. B. Tufillaro, T. M. Mello, Y. M. Choi, A. M. Albano, Period doubling boundaries of a
bouncing ball, J. Physique 47 (1986).

Known: with g = 1, an orbit of one bounce in a period hits where cos t = pi (1 - e)/((1 + e) A).
"""

from fractions import Fraction

from cap import Bounce, Guard, Mode, System, variables

y, v, cos, sin = variables("y v cos sin")


def ball(A=Fraction(6, 5), e=Fraction(1, 2), g=1):
    """Return the ball on a table that vibrates as A sin t, with the restitution e."""
    table = Guard(y - A * sin, "fly", Bounce(e), rest="rest")
    leave = Guard(g - A * sin, "fly", {"y": A * sin, "v": A * cos})
    fly = Mode({"y": v, "v": -g}, {"table": table})
    rest = Mode({"y": A * cos, "v": -A * sin}, {"leave": leave})
    return System("y v", 1, {"fly": fly, "rest": rest})
