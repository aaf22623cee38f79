"""The oscillator with what follows from its data: its constants, and its flights in closed form."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

from cap.checker.flow.one_mass import MODES, OneMass, one_mass
from cap.checker.system.course import Course, Forcing, course, forcing, reciprocal_number
from cap.checker.system.friction import friction
from cap.checker.system.model import COS, SIN, Model
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.walls import Parameters


class Laws(NamedTuple):
    """A model with what follows from it, some of its constants being parameters.

    For both directions: the courses of x and v, the equations of the response, and the response.
    """

    model: Model
    mass: OneMass
    courses: Mapping[tuple[int, str], Course]
    forcing: Mapping[int, Forcing]
    responses: Mapping[int, Mapping[str, Polynomial]]


@cache
def laws(p: Parameters, names: tuple[str, ...]) -> Laws:
    """Return the laws of the oscillator, in which these constants are parameters."""
    numbers = {name: Polynomial.of(getattr(p, name)) for name in ("F", "f", "l", "r", "e", "mu")}
    model = friction(p.omega, numbers | {name: variable(name) for name in names})
    modes = MODES.items()
    courses = {(s, z): course(model, mode, variable(z)) for s, mode in modes for z in model.state}
    equations = {s: forcing(model, mode) for s, mode in modes}
    responses = {s: _response(model, s, equations[s]) for s in MODES}
    return Laws(model, one_mass(model), courses, equations, responses)


def _response(model: Model, s: int, equations: Forcing) -> dict[str, Polynomial]:
    """Return U cos wt + V sin wt in a mode; U and V are numbers, or further parameters."""
    if equations.is_exact:
        U, V = equations.response(model.omega, lambda q: q, reciprocal_number)
    else:
        U, V = ([variable(f"{part} {s} {z}") for z in model.state] for part in "UV")
    parts = zip(model.state, U, V, strict=True)
    return {z: variable(COS) * u + variable(SIN) * v for z, u, v in parts}
