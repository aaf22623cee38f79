"""The flights of one mass without viscosity as straight-line code, made from the model.

The formulas are those of `cap.system.flight` for `cap.system.friction` with mu = 0.  What is the
same for all flights of an oscillator is computed once; F = 1 and omega = 1 cost nothing.
"""

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache
from typing import Any, Generic, NamedTuple

from cap.sets.scalar import S
from cap.system.flight import Scalars, flights
from cap.system.friction import LEFT, RIGHT, friction
from cap.system.model import System
from cap.system.source import Function
from cap.system.tape import Number, Tape, Term

PARAMETERS = ("F", "omega", "f")


class Formulas(NamedTuple, Generic[S]):
    """Of the flights of one sign; sin and cos are those of ωt, d is the time since the start.

    ``rest(x, v, sin, cos)`` is the state less the forced response.  Of a flight with this rest at
    its start, ``position`` and ``velocity`` (rest x, rest v, d, sin, cos) are x and v, and
    ``acceleration(cos)`` is v'.  The results are tuples.
    """

    rest: Callable[..., tuple[S, S]]
    position: Callable[..., tuple[S]]
    velocity: Callable[..., tuple[S]]
    acceleration: Callable[..., tuple[S]]


def dry(values: Mapping[str, Any], constant: Callable[[Fraction], Any]) -> dict[int, Formulas[Any]]:
    """Return the formulas by the sign of the velocity.

    ``values`` are those of F, omega and f, in any scalar type; ``constant`` makes its numbers.
    """
    one: Any = 1
    units = frozenset(name for name in ("F", "omega") if one == values[name])
    return {s: _bound(functions, values, constant) for s, functions in _written(units).items()}


def _bound(
    functions: tuple[Function, ...], values: Mapping[str, Any], constant: Callable[[Fraction], Any]
) -> Formulas[Any]:
    """Return the functions with these numbers."""

    def number(q: Number) -> Any:
        return constant(q.rational)  # there is no pi in this model

    return Formulas(*(f.bound(number, values) for f in functions))


@cache
def _written(units: frozenset[str]) -> dict[int, tuple[Function, ...]]:
    """Return the functions, which know that some parameters are 1."""
    system = friction().at({"mu": 0} | dict.fromkeys(units, 1))
    return {1: _of_mode(system, RIGHT), -1: _of_mode(system, LEFT)}


def _of_mode(system: System, mode: str) -> tuple[Function, ...]:
    """Return the functions of one mode, in the order of `Formulas`."""
    tape, form = Tape(), flights(system, mode)
    x, v, d, sin, cos = map(tape.input, ("x", "v", "d", "sin", "cos"))
    values = {name: tape.input(name) for name in system.parameters}
    of = Scalars(tape.number, tape.number(1, 1), _no_integral)
    rest = form.launch((x, v), (cos, sin), values, of)
    position, velocity = form.state_at({"x": x, "v": v}, d, (cos, sin), values, of)
    rate = of.value(system.modes[mode].field["v"], {**values, "cos": cos})

    def function(inputs: str, *outputs: Term) -> Function:
        return Function(inputs.split(), outputs, [n for n in PARAMETERS if n in values])

    return (
        function("x v sin cos", rest["x"], rest["v"]),
        function("x v d sin cos", position),
        function("x v d sin cos", velocity),
        function("cos", rate),
    )


def _no_integral(*_: Any) -> Any:
    raise ValueError("a flight without viscosity is a polynomial in its duration")
