"""Stick-slip: a mass on a spring, dragged by a belt, with a harmonic force.

    x'' + 2 d x' + x = a cos(omega t) - k sgn(x' - u);     it sticks, x' = u, while the friction
    that this needs, a cos(omega t) - x - 2 d u, is at most s in size

Units in which mass and spring are 1; u is the speed of the belt, k the kinetic friction, s >= k the
static one.  A mass that reaches the speed of the belt sticks.  Where more than s would be needed
for that, the model does not say what follows: floats flag the orbit (no mode), no proof is found.

J. P. Den Hartog, Mechanical Vibrations (1934); B. Feeny, A. Guran, N. Hinrichs, K. Popp, A
historical review on dry friction and stick-slip phenomena, Appl. Mech. Rev. 51 (1998).

Known: after a stick the mass has the belt's speed, so the map from one release to the next has one
variable.
"""

from fractions import Fraction

from cap import Guard, Mode, System, variables

x, v, cos = variables("x v cos")


def belt(
    a=Fraction(1, 2),
    omega=Fraction(3, 2),
    u=Fraction(1, 2),
    k=Fraction(4, 5),
    s=Fraction(3, 2),
    d=Fraction(1, 20),
):
    """Return the mass on the belt."""
    force, drag, belted = a * cos - x, 2 * d, {"v": u}
    need = force - drag * u
    leave = {"ahead": Guard(s - need, "faster", belted), "back": Guard(s + need, "slower", belted)}
    modes = {
        "slower": Mode(
            {"x": v, "v": force - drag * v + k}, {"catch": Guard(u - v, "stick", belted)}
        ),
        "faster": Mode(
            {"x": v, "v": force - drag * v - k}, {"catch": Guard(v - u, "stick", belted)}
        ),
        "stick": Mode({"x": u, "v": 0}, leave),
    }
    return System("x v", omega, modes)
