"""Den Hartog's oscillator: a spring, a harmonic force and dry friction.

    x'' + x + f sgn x' = cos(omega t);     at x' = 0 it rests while |cos(omega t) - x| <= f

Units in which mass, spring and amplitude of the force are 1.  Static and kinetic friction are
one, unless an excess of the static one is given.

J. P. Den Hartog, Forced vibrations with combined Coulomb and viscous friction, Trans. ASME 53
(1931); S. W. Shaw, On the dynamic response of a system with dry friction, J. Sound Vib. 108 (1986).

Known: a symmetric motion with two stops in a period, in closed form, if the friction is small.
"""

from fractions import Fraction

from cap import Guard, Mode, System, variables

x, v, cos = variables("x v cos")


def den_hartog(omega=Fraction(7, 5), f=Fraction(1, 5), excess=Fraction(0)):
    """Return the oscillator with the kinetic friction f and the static friction f + excess."""
    force, still, static = cos - x, {"v": 0}, f + excess
    to_right, to_left = Guard(static - force, "right", still), Guard(static + force, "left", still)
    modes = {
        "right": Mode({"x": v, "v": force - f}, {"stop": Guard(v, ("left", "rest"), still)}),
        "left": Mode({"x": v, "v": force + f}, {"stop": Guard(-v, ("right", "rest"), still)}),
        "rest": Mode({"x": 0, "v": 0}, {"to right": to_right, "to left": to_left}),
    }
    return System("x v", omega, modes)
