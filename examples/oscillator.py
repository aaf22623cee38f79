"""The oscillator of this package: a harmonic force, dry friction, two walls.

    x'' = F cos(omega t) - f sgn x' - mu x',  l < x < r,     at a wall:  v -> -e v

At x' = 0 the mass rests while |F cos(omega t)| <= f; at a wall, while it is pressed there or held.

Known: what the stored certificates prove of it.  It is the system of `cap.system.friction`.
"""

from fractions import Fraction

from cap import Guard, Mode, System, variables

x, v, cos = variables("x v cos")


def oscillator(F=1, omega=1, f=Fraction(2, 5), l=-1, r=1, e=1, mu=0):
    """Return the oscillator with the friction f, the restitution e and the viscosity mu."""
    force, still, stop = F * cos, {"x": 0, "v": 0}, {"v": 0}
    to_right, to_left = Guard(f - force, "right", stop), Guard(f + force, "left", stop)
    hit_right = Guard(r - x, "left", {"x": r, "v": -e * v}, rest="held right")
    hit_left = Guard(x - l, "right", {"x": l, "v": -e * v}, rest="held left")
    stop_right, stop_left = Guard(v, ("left", "rest"), stop), Guard(-v, ("right", "rest"), stop)
    modes = {
        "right": Mode({"x": v, "v": force - f - mu * v}, {"wall": hit_right, "stop": stop_right}),
        "left": Mode({"x": v, "v": force + f - mu * v}, {"wall": hit_left, "stop": stop_left}),
        "rest": Mode(still, {"to right": to_right, "to left": to_left}),
        "held right": Mode(still, {"to left": to_left}),
        "held left": Mode(still, {"to right": to_right}),
    }
    return System("x v", omega, modes)
