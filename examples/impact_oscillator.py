"""A linear oscillator, damped and forced, that hits a wall.

    x'' + 2 d x' + x = cos(omega t),  x < gap,     at x = gap:  v -> -e v

Units in which mass, spring and amplitude of the force are 1.  The mass lies at the wall while the
contact force cos(omega t) - gap presses it there.

S. W. Shaw, P. J. Holmes, A periodically forced piecewise linear oscillator, J. Sound Vib. 90
(1983); C. Budd, F. Dux, Chattering and related behaviour in impact oscillators, Phil. Trans. R.
Soc. A 347 (1994).

Known: the multipliers of an orbit with k impacts in p periods have the product
e^(2k) exp(-4 pi d p/omega): the divergence of the flow is -2 d.
"""

from fractions import Fraction

from cap import Bounce, Guard, Mode, System, variables

x, v, cos = variables("x v cos")


def impact_oscillator(omega=2, e=Fraction(4, 5), d=Fraction(1, 20), gap=Fraction(1, 10)):
    """Return the oscillator with the damping d and the restitution e."""
    wall = Guard(gap - x, "free", Bounce(e), rest="held")
    leave = Guard(cos - gap, "free", {"x": gap, "v": 0})
    free = Mode({"x": v, "v": cos - x - 2 * d * v}, {"wall": wall})
    return System("x v", omega, {"free": free, "held": Mode({"x": 0, "v": 0}, {"leave": leave})})
