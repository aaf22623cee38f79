"""What is no system: `BadInput` with one line that names the place."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from cap.errors import BadInput
from cap.system.polynomial import COS, PI, SIN, Polynomial, Quotient

if TYPE_CHECKING:
    from cap.system.model import Bounce, Guard, System

CLOCK = COS, SIN
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]{0,39}", re.ASCII)
STATES, PARAMETERS, MODES, GUARDS = 24, 24, 1000, 100
TERMS, DEGREE, POWERS_OF_PI = 1000, 12, 24


def validate(system: System) -> None:
    """Raise `BadInput` unless all parts of a system fit together."""
    _names(system)
    _frequency(system)
    for mode in system.modes:
        _mode(system, mode)
    for mode, name, guard in _guards(system):
        _guard(system, guard, f"the guard {name} of the mode {mode}")
        system.reset(mode, name)
    for mode, name, guard in _guards(system):
        if guard.rest is not None:
            _need(
                not system.lie(guard.rest, guard.value),
                f"the guard {name} of the mode {mode} does not stay 0 in {guard.rest}",
            )


def _frequency(system: System) -> None:
    """Refuse a frequency that is neither a number > 0 nor a polynomial in parameters."""
    omega, known = system.omega, set(system.parameters)
    right = bool(omega.variables) and omega.variables <= known
    _need(
        right or _is_positive(omega),
        f"the frequency must be a positive rational times a power of pi: {omega}",
    )


def _names(system: System) -> None:
    """Refuse names that are no names, occur twice, or are too many."""
    _need(bool(system.state), "a system needs at least one variable")
    _need(bool(system.modes), "a system needs at least one mode")
    _few(system.state, STATES, "variables")
    _few(system.parameters, PARAMETERS, "parameters")
    _few(system.modes, MODES, "modes")
    variables = (*system.state, *system.parameters)
    for name in variables:
        _need(bool(_NAME.fullmatch(name)), f"not a name of a variable: {name!r}")
        _need(name not in (*CLOCK, PI), f"{name} is the name of the clock or of pi")
        _need(variables.count(name) == 1, f"two variables have the name {name}")


def _mode(system: System, mode: str) -> None:
    """Refuse a field that is not linear in the state and the clock, or not of this state."""
    field, place = system.modes[mode].field, f"the mode {mode}"
    for z in system.state:
        _need(z in field, f"{place} does not say what {z}' is")
    for z, rate in field.items():
        _need(z in system.state, f"{place} gives the rate of {z}, no variable of the state")
        _known(system, rate, f"{z}' in {place}")
        linear = all(system.is_constant(rate.derivative(y)) for y in (*system.state, *CLOCK))
        _need(
            linear,
            f"{z}' in {place} is not linear in the state and the clock: {rate} "
            "(flights that are not linear are out of reach)",
        )
    _few(system.modes[mode].guards, GUARDS, f"guards of {place}")


def _guard(system: System, guard: Guard, place: str) -> None:
    """Refuse a guard, or its reset, that is about something else than this system."""
    _known(system, guard.value, place)
    _need(not system.is_constant(guard.value), f"{place} is constant: {guard.value}")
    _need(bool(guard.to), f"{place} names no mode to go on in")
    for mode in (*guard.to, *([] if guard.rest is None else [guard.rest])):
        _need(mode in system.modes, f"{place} goes on in an unknown mode: {mode}")
    if isinstance(guard.reset, Mapping):
        _reset(system, guard.reset, place)
    else:
        _bounce(system, guard.reset, place)


def _reset(system: System, reset: Mapping[str, Polynomial | Quotient], place: str) -> None:
    """Refuse a reset that is about something else than this system."""
    for z, new in reset.items():
        _need(z in system.state, f"the reset of {place} changes {z}, no variable of the state")
        parts = Quotient.of(new)
        _known(system, parts.numerator, f"the new {z} at {place}")
        _known(system, parts.denominator, f"the new {z} at {place}")
        _need(bool(parts.denominator), f"the new {z} at {place} has the denominator 0")


def _bounce(system: System, bounce: Bounce, place: str) -> None:
    """Refuse a restitution outside [0, 1] and masses that are not positive numbers."""
    e = bounce.e
    if e.is_number:
        rational = set(e.terms) <= {()} and 0 <= e.terms.get((), 0) <= 1
        _need(rational, f"the restitution of {place} is not a rational in [0, 1]: {e}")
    else:
        _need(system.is_constant(e), f"the restitution of {place} is not constant: {e}")
        _known(system, e, f"the restitution of {place}")
    for z, mass in bounce.masses.items():
        _need(z in system.state, f"{place} gives the mass of {z}, no variable of the state")
        _need(_is_positive(mass), f"the mass of {z} at {place} is not a positive number: {mass}")


def _known(system: System, value: Polynomial, place: str) -> None:
    """Refuse unknown variables, and polynomials that are too large."""
    unknown = value.variables - {*system.state, *system.parameters, *CLOCK}
    _need(not unknown, f"{place} names an unknown variable: {min(unknown, default='')}")
    _few(value.terms, TERMS, f"terms of {place}")
    _need(value.degree <= DEGREE, f"{place} has a degree above {DEGREE}")
    powers = [abs(k) for monomial in value.terms for name, k in monomial if name == PI]
    _need(max(powers, default=0) <= POWERS_OF_PI, f"{place} has a power of pi above {POWERS_OF_PI}")


def _is_positive(value: Polynomial) -> bool:
    """Return whether a polynomial is a positive rational times a power of pi."""
    return value.is_number and len(value.terms) == 1 and min(value.terms.values()) > 0


def _few(names: Iterable[object], most: int, what: str) -> None:
    count = len(list(names))
    _need(count <= most, f"too many {what}: {count}, at most {most}")


def _guards(system: System) -> Iterator[tuple[str, str, Guard]]:
    for mode, parts in system.modes.items():
        for name, guard in parts.guards.items():
            yield mode, name, guard


def _need(condition: bool, message: str) -> None:
    if not condition:
        raise BadInput(message)
