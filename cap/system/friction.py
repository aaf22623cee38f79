"""The oscillator with dry friction: x'' = F cos wt - f sgn x' - mu x', l < x < r, v -> -e v."""

from __future__ import annotations

from dataclasses import fields

from cap.parameters import Parameters
from cap.system.model import Guard, Mode, System
from cap.system.polynomial import ZERO, variables

RIGHT, LEFT, REST = "right", "left", "rest"
HELD_RIGHT, HELD_LEFT = "held right", "held left"  # at rest at a wall
WALL, STOP, TO_RIGHT, TO_LEFT = "wall", "stop", "to right", "to left"
NAMES = tuple(field.name for field in fields(Parameters))


def friction() -> System:
    """Return the model; its parameters have the names of `cap.parameters.Parameters`."""
    x, v, cos, F, omega, f, l, r, e, mu = variables(f"x v cos {' '.join(NAMES)}")
    force, still = F * cos, {"x": ZERO, "v": ZERO}
    stop = {"v": ZERO}
    hit_right = Guard(r - x, (LEFT,), {"x": r, "v": -e * v}, HELD_RIGHT)
    hit_left = Guard(x - l, (RIGHT,), {"x": l, "v": -e * v}, HELD_LEFT)
    to_right, to_left = Guard(f - force, (RIGHT,), stop), Guard(f + force, (LEFT,), stop)
    modes = {
        RIGHT: Mode(
            {"x": v, "v": force - f - mu * v},
            {WALL: hit_right, STOP: Guard(v, (LEFT, REST), stop)},
        ),
        LEFT: Mode(
            {"x": v, "v": force + f - mu * v},
            {WALL: hit_left, STOP: Guard(-v, (RIGHT, REST), stop)},
        ),
        REST: Mode(still, {TO_RIGHT: to_right, TO_LEFT: to_left}),
        HELD_RIGHT: Mode(still, {TO_LEFT: to_left}),
        HELD_LEFT: Mode(still, {TO_RIGHT: to_right}),
    }
    return System(("x", "v"), omega, modes, NAMES)


def oscillator(p: Parameters) -> System:
    """Return the model with these parameters."""
    return friction().at({name: getattr(p, name) for name in NAMES})
