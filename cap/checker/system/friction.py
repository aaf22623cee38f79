"""The oscillator with dry friction, as a model: x'' = F cos wt - f sgn x' - mu x', l < x < r.

At a wall v becomes -e v.  The mass rests while the force is at most as large as the friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from cap.checker.system.model import COS, Guard, Mode, Model
from cap.checker.system.polynomial import ZERO, Polynomial, variable

RIGHT, LEFT, REST = "right", "left", "rest"
WALL, STOP = "wall", "stop"


def friction(omega: Fraction, constants: Mapping[str, Polynomial]) -> Model:
    """Return the model; the constants F, f, l, r, e, mu are numbers, or variables of their own."""
    F, f, l, r, e, mu = (constants[name] for name in ("F", "f", "l", "r", "e", "mu"))
    x, v, force = variable("x"), variable("v"), F * variable(COS)

    def sliding(s: int, wall: Polynomial, back: str) -> Mode:
        hit = Guard((wall - x) * s, {"x": wall, "v": v * -e}, (back,))
        stop = Guard(v * s, {"v": ZERO}, (back, REST))
        return Mode({"x": v, "v": force - f * s - mu * v}, {WALL: hit, STOP: stop})

    released = {RIGHT: Guard(f - force, {}, (RIGHT,)), LEFT: Guard(f + force, {}, (LEFT,))}
    modes = {RIGHT: sliding(1, r, LEFT), LEFT: sliding(-1, l, RIGHT)}
    return Model(("x", "v"), omega, modes | {REST: Mode({"x": ZERO, "v": ZERO}, released)})
