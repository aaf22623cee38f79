"""A parameter as one more variable of the state: p' = 0, and no contact moves it.

A model is a function of numbers, so how it depends on p is found by interpolation: the numbers in
fields, guards and resets are polynomials in p of a low degree at more values than determine them.
What is proved is about the system that is found, which certificates hold and print.  It has the
modes that may be reached by contacts from those of an orbit, and no others.
"""

from collections.abc import Callable, Collection, Iterable, Mapping
from fractions import Fraction
from itertools import pairwise

from cap.errors import BadInput
from cap.system.model import Guard, Mode, System
from cap.system.polynomial import ONE, ZERO, Polynomial, Quotient, variable

SAMPLES, DEGREE = 9, 4


At = Callable[[Fraction], System]


def moving(at: At, name: str, ends: tuple[Fraction, Fraction], begun: Collection[str]) -> System:
    """Return the system in which p, of this ``name``, is the last variable.

    ``at`` returns the system at a value, here between two ``ends``; orbits are in the modes that
    are ``begun``.  Raises `BadInput` if p is not such a parameter.
    """
    low, high = ends
    values = [low + (high - low) * k / (SAMPLES - 1) for k in range(SAMPLES)]
    systems = [at(p) for p in values]
    first = systems[0]
    if name in first.state:
        raise BadInput(f"{name} is a variable of the state")
    if any(system.omega != first.omega for system in systems):
        raise BadInput(f"the frequency depends on {name}: choose units in which it does not")
    same = all(_shape(system) == _shape(first) for system in systems)
    if not same or any(system.state != first.state for system in systems):
        raise BadInput(f"modes or guards depend on {name}, not only numbers in them")
    p = _Parameter(name, values)
    modes = {}
    for key in _reached(first, begun):
        mode = first.modes[key]
        field = {
            z: p.fitted([s.modes[key].field[z] for s in systems], f"{z}' of {key}")
            for z in first.state
        }
        if any(z != name and name in q.derivative(z).variables for q in field.values()
               for z in (*first.state, "cos", "sin")):  # fmt: skip
            raise BadInput(
                f"in the mode {key} {name} multiplies a variable or the clock, so that flights are "
                "not linear with it: choose units in which it stands in guards, resets or constant "
                f"forces (a force {name} cos wt: measure lengths in {name})"
            )
        guards = {g: _guard(systems, key, g, p) for g in mode.guards}
        modes[key] = Mode({**field, name: ZERO}, guards)
    return System((*first.state, name), first.omega, modes)


class _Parameter:
    """The values at which the model was asked, and its polynomials between them."""

    def __init__(self, name: str, values: list[Fraction]) -> None:
        self.name, self.values = name, values

    def fitted(self, found: list[Polynomial], where: str) -> Polynomial:
        """Return the polynomial of p and the variables that is each of these at its value."""
        total = ZERO
        for monomial in {m for q in found for m in q.terms}:
            numbers = [q.terms.get(monomial, Fraction(0)) for q in found]
            total += self._of(numbers, where) * Polynomial({monomial: Fraction(1)})
        return total

    def _of(self, numbers: list[Fraction], where: str) -> Polynomial:
        """Return the polynomial in p through numbers, by divided differences."""
        table, total, power = list(numbers), ZERO, ONE
        for k in range(len(numbers)):
            if k > DEGREE and table[0]:
                raise BadInput(
                    f"{where} is no polynomial in {self.name} of degree {DEGREE} at most"
                )
            total += power * table[0]
            power *= variable(self.name) - self.values[k]
            table = [
                (b - a) / (self.values[i + k + 1] - self.values[i])
                for i, (a, b) in enumerate(pairwise(table))
            ]
        return total


def _reached(system: System, begun: Collection[str]) -> list[str]:
    """Return the modes that contacts lead to, from those that are ``begun`` on."""
    found = dict.fromkeys(begun)
    while more := [m for k in found for q in system.modes[k].guards.values()
                   for m in q.to if m not in found]:  # fmt: skip
        found |= dict.fromkeys(more)
    return [key for key in system.modes if key in found]


def _shape(system: System) -> Mapping[str, Iterable[object]]:
    """Return modes, guards, and where these lead."""
    return {m: [(g, q.to) for g, q in mode.guards.items()] for m, mode in system.modes.items()}


def _guard(systems: list[System], mode: str, name: str, p: _Parameter) -> Guard:
    """Return a guard with its reset."""
    where, resets = f"the guard {name} of {mode}", [s.reset(mode, name) for s in systems]
    reset = {}
    for z, q in resets[0].items():
        if any(r[z].denominator != q.denominator for r in resets):
            raise BadInput(f"{z} after {where} is divided by what depends on {p.name}")
        top = p.fitted([r[z].numerator for r in resets], f"{z} after {where}")
        if (top, q.denominator) != (variable(z), ONE):
            reset[z] = Quotient(top, q.denominator)
    value = p.fitted([s.guard(mode, name).value for s in systems], where)
    return Guard(value, systems[0].guard(mode, name).to, reset)
