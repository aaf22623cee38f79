"""Test tools: a damped spring before a wall, as a model; flights of linear modes in mpmath."""

from __future__ import annotations

from fractions import Fraction

from mpmath import expm, matrix, mp, mpf
from support import number

from cap.checker.system.model import COS, Guard, Mode, Model
from cap.checker.system.polynomial import Polynomial, variable

FLY, WALL = "fly", "wall"


def spring(wall="1/10", e="9/10", damping="1/20", omega="27/10", stiffness=1, force=1):
    """Return x'' = force cos wt - stiffness x - 2 damping x', x < wall, v -> -e v there."""
    x, v = variable("x"), variable("v")
    wall, e, damping = map(Fraction, (wall, e, damping))
    field = {"x": v, "v": variable(COS) * force - x * stiffness - v * (2 * damping)}
    hit = Guard(wall - x, {"x": Polynomial.of(wall), "v": v * -e}, (FLY,))
    return Model(("x", "v"), Fraction(omega), {FLY: Mode(field, {WALL: hit})})


def springy(damping="1/20", omega="27/10", stiffness=1, force=1):
    """Return its y' = M y, y = (x, v, cos wt, sin wt, 1), as one writes it down."""
    w, drag = Fraction(omega), -2 * Fraction(damping)
    rows = [0, 1, 0, 0, 0], [-stiffness, drag, force, 0, 0], [0, 0, 0, -w, 0], [0, 0, w, 0, 0]
    return [[Fraction(q) for q in row] for row in (*rows, [0] * 5)]


def exponential(M, d):
    """Return exp(M d) in mpmath."""
    return expm(matrix([[number(x) for x in row] for row in M]) * d, method="taylor")


def flown(M, state, omega, start, t):
    """Return the state at t of the flight from a state at a time; M as ``springy`` has it."""
    angle = number(Fraction(omega)) * start
    y = matrix([*map(mpf, state), mp.cos(angle), mp.sin(angle), 1])
    return list(exponential(M, mpf(t) - start) * y)[: len(y) - 3]
