"""A clock's escapement: a balance with friction that gets a kick once a turn.  No force drives it.

    x'' + 2 d x' + x = -f sgn x',     at x = 0, while x' > 0:  x' -> x' + k

Units in which the balance has mass and spring 1.  It rests where it stops with |x| <= f.  Swung too
weakly, it comes to rest; else it ends at one swing, whose period nobody gives.

A. A. Andronov, A. A. Vitt, S. E. Khaikin, Theory of Oscillators (1937; Pergamon 1966), chapter III.

Known: without dry friction, f = 0, the period is 2 pi/sqrt(1 - d^2), the multiplier of the swing
is q = exp(-2 pi d/sqrt(1 - d^2)), and it passes x = 0 after the kick at the speed k/(1 - q).
"""

from fractions import Fraction

from cap import Guard, Mode, System, variables

x, v = variables("x v")


def clock(f=Fraction(1, 50), k=Fraction(1, 2), d=Fraction(1, 20)):
    """Return the clock with the dry friction f, the damping d and the kick k."""
    still, force = {"v": 0}, -x - 2 * d * v
    kick, end = Guard(-x, "going", {"v": v + k}), Guard(v, "rest", still)
    held = {"right": Guard(f - x, "back", still), "left": Guard(f + x, "coming", still)}
    modes = {
        "coming": Mode({"x": v, "v": force - f}, {"kick": kick, "end": end}),
        "going": Mode({"x": v, "v": force - f}, {"stop": Guard(v, ("back", "rest"), still)}),
        "back": Mode({"x": v, "v": force + f}, {"turn": Guard(-v, ("coming", "rest"), still)}),
        "rest": Mode({"x": 0, "v": 0}, held),
    }
    return System("x v", 1, modes)
