"""Gears with backlash: rattle of a loaded gear between the flanks of its partner's teeth.

    x'' + d x' = m + a cos t,  |x| < b,     at x = b and x = -b:  v -> -e v

x is the angle relative to the driving gear, b half the backlash, d the drag, m the mean torque and
a the amplitude of its variation.  The gears stay in touch while the contact force is positive.

J. F. Mason, P. T. Piiroinen, The effect of codimension-two bifurcations on the global dynamics of a
gear model, SIAM J. Applied Dynamical Systems 8 (2009).

Known: rattling and silent motions can coexist; the multipliers of an orbit with k impacts in p
periods have the product e^(2k) exp(-2 pi d p).
"""

from fractions import Fraction

from cap import Bounce, Guard, Mode, System, variables

x, v, cos = variables("x v cos")


def gear_rattle(
    a=Fraction(3, 2), b=Fraction(1, 2), m=Fraction(1, 10), d=Fraction(1, 10), e=Fraction(1, 2)
):
    """Return the gears; all numbers in units of the period 2 pi."""
    torque, still = m + a * cos, {"x": 0, "v": 0}
    front = Guard(b - x, "free", Bounce(e), rest="in front")
    back = Guard(x + b, "free", Bounce(e), rest="behind")
    modes = {
        "free": Mode({"x": v, "v": torque - d * v}, {"front": front, "back": back}),
        "in front": Mode(still, {"leave front": Guard(torque, "free", {"x": b, "v": 0})}),
        "behind": Mode(still, {"leave back": Guard(-torque, "free", {"x": -b, "v": 0})}),
    }
    return System("x v", 1, modes)
