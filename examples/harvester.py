"""An impact pair: a ball in a capsule that is shaken and inclined; a harvester of energy.

    z'' = cos(pi t) + G,  |z| < s/2,     at z = s/2 and z = -s/2:  v -> -e v

z is the place of the capsule relative to the ball; units in which the force has the amplitude 1 and
the period 2.  G is the part of gravity along the incline, s the length that is free.

L. Serdukova, R. Kuske, D. Yurchenko, Stability and bifurcation analysis of the period-T motion of a
vibroimpact energy harvester, Nonlinear Dynamics 98 (2019), arXiv 2003.02167.

Known: orbits that hit both ends once in a period (1:1), or one of them twice (2:1), and between
them period doublings and grazing impacts.
"""

from fractions import Fraction

from cap import Bounce, Guard, Mode, System, variables

z, v, cos, pi = variables("z v cos pi")


def harvester(s=Fraction(1, 2), e=Fraction(1, 2), G=Fraction(1, 10)):
    """Return the pair with the length s, the restitution e and the inclining force G."""
    force, still = cos + G, {"z": 0, "v": 0}
    top = Guard(s / 2 - z, "free", Bounce(e), rest="at the top")
    bottom = Guard(z + s / 2, "free", Bounce(e), rest="at the bottom")
    modes = {
        "free": Mode({"z": v, "v": force}, {"top": top, "bottom": bottom}),
        "at the top": Mode(still, {"leave top": Guard(force, "free", {"z": s / 2, "v": 0})}),
        "at the bottom": Mode(
            still, {"leave bottom": Guard(-force, "free", {"z": -s / 2, "v": 0})}
        ),
    }
    return System("z v", pi, modes)
