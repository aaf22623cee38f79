"""Two masses coupled by a spring; the first is forced, the second hits a wall.

    p'' + 2 d p' + p + k (p - q) = a cos(omega t)
    q'' + 2 d q' + k (q - p) = 0,  q < gap,            at q = gap:  q' -> -e q'

Units in which the masses and the spring that holds the first are 1.  The second lies at the wall
while the spring presses it there, k (p - gap) > 0.

J. Shaw, S. W. Shaw, The onset of chaos in a two-degree-of-freedom impacting system, J. Applied
Mechanics 56 (1989), has such systems.

Known: the multipliers of an orbit with n impacts in m periods have the product
e^(2n) exp(-8 pi d m/omega).
"""

from fractions import Fraction

from cap import Bounce, Guard, Mode, System, variables

p, q, u, v, cos = variables("p q u v cos")


def coupled_masses(a=1, omega=2, k=1, d=Fraction(1, 10), e=Fraction(4, 5), gap=Fraction(1, 10)):
    """Return the masses at p and q with the velocities u and v."""
    pull = k * (p - q)
    push = a * cos - p - 2 * d * u
    wall = Guard(gap - q, "free", Bounce(e), rest="held")
    leave = Guard(k * (p - gap), "free", {"q": gap, "v": 0})
    free = Mode({"p": u, "q": v, "u": push - pull, "v": pull - 2 * d * v}, {"wall": wall})
    held = Mode({"p": u, "q": 0, "u": push - k * (p - gap), "v": 0}, {"leave": leave})
    return System("p q u v", omega, {"free": free, "held": held})
