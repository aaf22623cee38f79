"""Systems of about ten lines, as in the literature, on which `cap.system` is tested."""

from fractions import Fraction

from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import ONE, Polynomial, variables

x, y, v, w, cos, sin, pi = variables("x y v w cos sin pi")


def ball(A=Fraction(6, 5), e=Fraction(1, 2), g=1):
    """A ball on a table that vibrates as A sin t."""
    hit = Guard(y - A * sin, ("fly",), Bounce(Polynomial.of(e)), "rest")
    leave = Guard(g - A * sin, ("fly",))
    rest = Mode({"y": A * cos, "v": -A * sin}, {"leave": leave})
    fly = Mode({"y": v, "v": -g * ONE}, {"table": hit})
    return System(("y", "v"), ONE, {"fly": fly, "rest": rest})


def parabola(a=Fraction(2), e=Fraction(4, 5), E=Fraction(1)):
    """A billiard under gravity over a parabola that moves as E sin 2 pi t (Church and Fortin)."""
    table = Guard(y - a * x * x - E * sin, ("fly",), Bounce(Polynomial.of(e)))
    fly = Mode({"x": v, "y": w, "v": 0 * v, "w": ONE * Fraction(-981, 100)}, {"table": table})
    return System(("x", "y", "v", "w"), 2 * pi, {"fly": fly})


def spring(omega=Fraction(14, 5), e=Fraction(4, 5), damping=Fraction(1, 20), gap=Fraction(0)):
    """A linear impact oscillator, x'' = cos wt - x - 2 damping x', x < gap."""
    stop = Guard(gap - x, ("fly",), {"v": -e * v})
    fly = Mode({"x": v, "v": cos - x - 2 * damping * v}, {"stop": stop})
    return System(("x", "v"), Polynomial.of(omega), {"fly": fly})
