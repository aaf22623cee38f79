"""A hybrid system as data.

*Clock.*  The names cos and sin stand for cos wt and sin wt; pi is the number.  Names that are
neither these nor of the state are parameters; a system lists them.

*A mode* is a vector field: for each variable of the state a polynomial of degree at most 1 in the
state and the clock.  So y = (state, cos wt, sin wt, 1) has y' = M y with a constant matrix M.  A
mode in which something rests is a mode like any other.

*A guard* h of a mode is a polynomial; h > 0 in the mode.  Where h comes to zero, with L h < 0, the
state jumps by the reset, and the system goes on in one of the modes ``to``; if there are several,
the next flight shows which: its guards are positive at its start.  ``rest`` is the mode in which
infinitely many such events end that accumulate, and in which h stays zero.

*A reset* names the variables that change and their new values, rational functions of y; or it is a
`Bounce`: an impact against h = 0.

Wherever a polynomial is asked for, an int, a `Fraction` or an expression of sympy will do.

*Lie derivative.*  L h = sum of (dh/dz) z' over the state, - w sin dh/dcos + w cos dh/dsin, is the
derivative in time of h along the flights of a mode.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TypeVar

from cap.errors import BadInput
from cap.system.polynomial import COS, ONE, SIN, ZERO, Polynomial, Quotient, over, variable
from cap.system.validation import CLOCK, validate

Exact = TypeVar("Exact", Polynomial, Quotient)


@dataclass(frozen=True)
class Bounce:
    """An impact: L h becomes -e L h by an impulse along the gradient of h.

    The velocity of a position x is the one variable v for which some mode has x' = v; other modes
    may let x rest.  Its inertia is ``masses[v]``, a number, 1 where nothing is said.
    """

    e: Polynomial
    masses: Mapping[str, Polynomial] = dataclasses.field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "e", _read(Polynomial.of, self.e, "the restitution"))
        masses = {v: _read(Polynomial.of, m, f"the mass of {v}") for v, m in self.masses.items()}
        object.__setattr__(self, "masses", masses)


@dataclass(frozen=True)
class Guard:
    """A polynomial that is positive in its mode, and what happens where it comes to zero."""

    value: Polynomial
    to: tuple[str, ...]
    reset: Mapping[str, Polynomial | Quotient] | Bounce = dataclasses.field(default_factory=dict)
    rest: str | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "value", _read(Polynomial.of, self.value, "a guard"))
        object.__setattr__(self, "to", (self.to,) if isinstance(self.to, str) else tuple(self.to))
        if not isinstance(self.reset, Bounce):
            if not isinstance(self.reset, Mapping):
                raise BadInput("a reset names the variables that change, and their new values")
            reset = {z: _read(Quotient.of, new, f"the new {z}") for z, new in self.reset.items()}
            object.__setattr__(self, "reset", reset)


@dataclass(frozen=True)
class Mode:
    """A vector field, and the guards that end its flights, by name."""

    field: Mapping[str, Polynomial]
    guards: Mapping[str, Guard] = dataclasses.field(default_factory=dict)

    def __post_init__(self) -> None:
        _each(self.field, object, "a field names the variables, and their rates")
        _each(self.guards, Guard, "guards are named: a dictionary of Guard")
        rates = {z: _read(Polynomial.of, rate, f"{z}'") for z, rate in self.field.items()}
        object.__setattr__(self, "field", rates)


@dataclass(frozen=True)
class System:
    """Modes of one state and one clock; ``omega`` is its frequency, a rational times pi^k.

    The names of the state are a tuple, or one string with spaces between them.
    Raises `BadInput` unless all parts fit together (`cap.system.validation`).
    """

    state: tuple[str, ...]
    omega: Polynomial
    modes: Mapping[str, Mode]
    parameters: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        _each(self.modes, Mode, "modes are named: a dictionary of Mode")
        names = self.state.split() if isinstance(self.state, str) else self.state
        object.__setattr__(self, "state", tuple(names))
        object.__setattr__(self, "omega", _read(Polynomial.of, self.omega, "the frequency"))
        object.__setattr__(self, "parameters", tuple(self.parameters))
        validate(self)

    @cached_property
    def autonomous(self) -> bool:
        """Whether the clock occurs nowhere."""
        found = [q for mode in self.modes.values() for q in mode.field.values()]
        for key, mode in self.modes.items():
            for name, guard in mode.guards.items():
                parts = self.reset(key, name).values()
                found += [guard.value, *(q.numerator for q in parts)]
                found += [q.denominator for q in parts]
        return all(q.variables.isdisjoint(CLOCK) for q in found)

    def guard(self, mode: str, name: str) -> Guard:
        """Return a guard of a mode."""
        return self.modes[mode].guards[name]

    def lie(self, mode: str, h: Polynomial) -> Polynomial:
        """Return L h, the derivative of h in time along the flights of a mode."""
        if (mode, h) not in self._lies:
            clock = {COS: -self.omega * variable(SIN), SIN: self.omega * variable(COS)}
            rates = {**self.modes[mode].field, **clock}
            names = h.variables
            parts = (h.derivative(z) * rate for z, rate in rates.items() if z in names)
            self._lies[mode, h] = sum(parts, ZERO)
        return self._lies[mode, h]

    @cached_property
    def _lies(self) -> dict[tuple[str, Polynomial], Polynomial]:
        return {}

    def matrix(self, mode: str) -> list[list[Polynomial]]:
        """Return M of y' = M y, y = (state, cos wt, sin wt, 1); its entries have no variables."""
        y, none = (*self.state, *CLOCK), [ZERO] * len(self.state)
        rows = [self.modes[mode].field[z] for z in self.state]
        linear = [[*(q.derivative(z) for z in y), q.without(*y)] for q in rows]
        cos, sin = [*none, ZERO, -self.omega, ZERO], [*none, self.omega, ZERO, ZERO]
        return [*linear, cos, sin, [ZERO] * (len(y) + 1)]

    def is_constant(self, h: Polynomial) -> bool:
        """Return whether neither a variable of the state nor the clock occurs."""
        return h.variables.isdisjoint((*self.state, *CLOCK))

    def reset(self, mode: str, name: str) -> dict[str, Quotient]:
        """Return the state just after an event, each variable a rational function of y before."""
        if (mode, name) not in self._resets:
            given = self.guard(mode, name).reset
            changed = self._impact(mode, name, given) if isinstance(given, Bounce) else given
            after = {z: Quotient.of(changed.get(z, variable(z))) for z in self.state}
            self._resets[mode, name] = after
        return {**self._resets[mode, name]}

    @cached_property
    def _resets(self) -> dict[tuple[str, str], dict[str, Quotient]]:
        return {}

    def rest(self, mode: str, name: str) -> str:
        """Return the mode in which infinitely many of these events end."""
        rest = self.guard(mode, name).rest
        if rest is None:
            raise BadInput(
                f"the guard {name} of the mode {mode} names no resting mode: "
                "what follows infinitely many of its events is not defined"
            )
        return rest

    def velocity_of(self, position: str) -> str | None:
        """Return the one variable v for which a mode has position' = v, if there is one."""
        names = {variable(z): z for z in self.state}
        rates = {mode.field[position] for mode in self.modes.values()}
        found = [names[rate] for rate in rates if rate in names]
        return found[0] if len(found) == 1 else None

    def _impact(self, mode: str, name: str, bounce: Bounce) -> Mapping[str, Polynomial | Quotient]:
        """Return the velocities after an impact.

        v - (1 + e) (L h) (dh/dx)/m / sum of (dh/dx)^2/m, over all x with x' = v.
        """
        h = self.guard(mode, name).value
        slopes = {}
        for x in (z for z in self.state if h.derivative(z)):
            v = self.velocity_of(x)
            if v is None or h.derivative(v):
                raise BadInput(f"no bounce at {name} of {mode}: {x} is no position with a velocity")
            slopes[v] = h.derivative(x)
        inverse = {v: bounce.masses.get(v, ONE).reciprocal() for v in slopes}
        inertia = sum((q * q * inverse[v] for v, q in slopes.items()), ZERO)
        impulse = (ONE + bounce.e) * self.lie(mode, h)
        return {
            v: over(variable(v) * inertia - impulse * q * inverse[v], inertia)
            for v, q in slopes.items()
        }

    def at(self, values: Mapping[str, Fraction | int]) -> System:
        """Return the system with numbers in place of some parameters."""
        for name in values:
            if name not in self.parameters:
                raise BadInput(f"the system has no parameter {name}, but {list(self.parameters)}")
        numbers = {name: Polynomial.of(value) for name, value in values.items()}
        modes = {name: _mode_at(mode, numbers) for name, mode in self.modes.items()}
        left = tuple(name for name in self.parameters if name not in values)
        return System(self.state, self.omega.substituted(numbers), modes, left)


def _each(parts: object, kind: type, message: str) -> None:
    """Refuse what is not a dictionary of some kind of values."""
    if not isinstance(parts, Mapping) or not all(isinstance(q, kind) for q in parts.values()):
        raise BadInput(message)


def _read(of: Callable[[object], Exact], value: object, what: str) -> Exact:
    """Return an exact value; say what it is if there is none."""
    try:
        return of(value)
    except BadInput as error:
        raise BadInput(f"{what}: {error}") from None


def _mode_at(mode: Mode, numbers: Mapping[str, Polynomial]) -> Mode:
    """Return a mode with numbers in place of some parameters."""
    rates = {name: rate.substituted(numbers) for name, rate in mode.field.items()}
    guards = {name: _guard_at(guard, numbers) for name, guard in mode.guards.items()}
    return Mode(rates, guards)


def _guard_at(guard: Guard, numbers: Mapping[str, Polynomial]) -> Guard:
    """Return a guard with numbers in place of some parameters."""
    reset = guard.reset
    if isinstance(reset, Bounce):
        masses = {name: m.substituted(numbers) for name, m in reset.masses.items()}
        changed: Mapping[str, Polynomial | Quotient] | Bounce = Bounce(
            reset.e.substituted(numbers), masses
        )
    else:
        changed = {name: _quotient_at(Quotient.of(q), numbers) for name, q in reset.items()}
    return Guard(guard.value.substituted(numbers), guard.to, changed, guard.rest)


def _quotient_at(q: Quotient, numbers: Mapping[str, Polynomial]) -> Quotient:
    """Return a quotient with numbers in place of some parameters."""
    return over(q.numerator.substituted(numbers), q.denominator.substituted(numbers))
