"""A system that a certificate holds: its shape, its limits, and how it is printed.

    {"state": ["x", "v"], "omega": "27/10", "modes": {"fly": {
        "field": {"x": [["1", "v"]], "v": [["1", "cos"], ["-1", "x"]]},
        "guards": {"stop": {"value": [["1/10"], ["-1", "x"]],
                            "reset": {"v": [["-9/10", "v"]]}, "to": ["fly"]}}}}}

A polynomial is a list of terms; a term is a rational number and the names of its factors, each as
often as its power: variables of the state, cos and sin, which stand for cos wt and sin wt, and pi.
Omega is a rational number, or with "times_pi": "1" that times pi.  Fields are linear.  Variables
that a reset does not name do not jump; what it gives is over the "divisor", if there is one.
"rest", if it is there, is the mode in which infinitely many such events end.  Names are compared
and printed; nothing is evaluated in any other way.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from cap.checker.kernel.named import Named, name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import MAX_SIZE, number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Many, Word
from cap.checker.system.model import CLOCK, PI, Guard, Mode, Model
from cap.checker.system.polynomial import ONE, Polynomial

STATES, MODES, GUARDS, TERMS, DEGREE = 8, 64, 16, 40, 6
OF_GUARDS = 3  # their degree
_VARIABLE = re.compile("[A-Za-z][A-Za-z_0-9]{0,19}", re.ASCII)
_RESERVED = (*CLOCK, PI, "t", "omega")
_COMMON = 10**30  # of the denominators of a field

POLYNOMIAL = Many(Many(text, 1, 1 + DEGREE), 0, TERMS)
GUARD = {
    "value": POLYNOMIAL,
    "reset": Named(POLYNOMIAL, STATES),
    "divisor": Maybe(POLYNOMIAL),
    "to": Many(name, 1, MODES),
    "rest": Maybe(name),
}
MODE = {"field": Named(POLYNOMIAL, STATES), "guards": Named(GUARD, GUARDS)}
SYSTEM = {
    "state": Many(name, 1, STATES),
    "omega": number,
    "times_pi": Maybe(Word(("1",))),
    "modes": Named(MODE, MODES),
}


def model(given: dict[str, Any]) -> Model:
    """Return the system in fields of the shape above; what is no system rejects."""
    state, omega, modes = tuple(given["state"]), given["omega"], given["modes"]
    need(omega > 0 and _fits(omega), "omega is not between 10^-30 and 10^30")
    confirm_names(state)
    read = {key: _mode(part, state, modes, key) for key, part in modes.items()}
    return Model(state, omega, read, "times_pi" in given)


def confirm_names(state: Sequence[str]) -> None:
    """Reject names that are no names of variables."""
    need(len({*state}) == len(state), "two variables of the state have one name")
    for z in state:
        need(_VARIABLE.fullmatch(z) is not None, f"{z} is not a name of a variable")
        need(z not in _RESERVED, f"{z} is not a free name")


def _mode(given: dict[str, Any], state: tuple[str, ...], modes: Iterable[str], key: str) -> Mode:
    where = f"the mode {key}"
    need(given["field"].keys() == {*state}, f"{where} does not give the rate of each variable once")
    field = {z: _linear(given["field"][z], state, f"{z}' in {where}") for z in state}
    common = lcm(*(c.denominator for q in field.values() for c in q.terms.values()))
    need(common <= _COMMON, f"{where} has a common denominator above 10^30")
    guards = {
        g: _guard(part, state, modes, f"the guard {g} of {where}")
        for g, part in given["guards"].items()
    }
    return Mode(field, guards)


def _guard(
    given: dict[str, Any], state: tuple[str, ...], modes: Iterable[str], where: str
) -> Guard:
    value = polynomial(given["value"], state, where)
    low = all(len(monomial) <= OF_GUARDS for monomial in value.terms)
    need(low, f"{where} has a degree above {OF_GUARDS}")
    need(bool(value.variables - {PI}), f"{where} is constant")
    need(given["reset"].keys() <= {*state}, f"{where} resets what is no variable of the state")
    reset = {z: polynomial(q, state, f"{z} after {where}") for z, q in given["reset"].items()}
    divisor = polynomial(given.get("divisor", [["1"]]), state, f"the divisor of {where}")
    need(bool(divisor.terms), f"the divisor of {where} is 0")
    need({*given["to"]} <= {*modes}, f"{where} leads to an unknown mode")
    need(len({*given["to"]}) == len(given["to"]), f"{where} leads to a mode twice")
    rest = given.get("rest")
    need(rest is None or rest in modes, f"{where} rests in an unknown mode")
    return Guard(value, reset, tuple(given["to"]), divisor, rest)


def _linear(given: list[list[str]], state: tuple[str, ...], where: str) -> Polynomial:
    """Return a polynomial of degree at most one, but for pi."""
    q = polynomial(given, state, where)
    degrees = (sum(z != PI for z in monomial) for monomial in q.terms)
    need(all(degree <= 1 for degree in degrees), f"{where} is not linear")
    return q


def polynomial(given: list[list[str]], state: tuple[str, ...], where: str) -> Polynomial:
    """Return the polynomial of a list of terms, in the state, the clock and pi."""
    total = dict[tuple[str, ...], Fraction]()
    for term in given:
        c, monomial = number(term[0], where), tuple(sorted(term[1:]))
        need(_fits(c), f"{where} has a number that is not between 10^-30 and 10^30 in size")
        need({*monomial} <= {*state, *CLOCK, PI}, f"{where} has an unknown variable")
        need(monomial not in total, f"{where} has a monomial twice")
        total[monomial] = c
    return Polynomial(total)


def _fits(c: Fraction) -> bool:
    """Return whether a number has a moderate size, and no long denominator."""
    return 1 <= abs(c) * MAX_SIZE <= MAX_SIZE**2 and c.denominator <= MAX_SIZE


# how it is printed


def told(model: Model) -> str:
    """Return the system in one line."""
    modes = (_told_mode(model, key) for key in model.modes)
    omega = printed(model.frequency)
    return f"state ({', '.join(model.state)}), omega = {omega}; " + "; ".join(modes)


def _told_mode(model: Model, key: str) -> str:
    mode = model.modes[key]
    rates = ", ".join(f"{z}' = {printed(mode.field[z])}" for z in model.state)
    guards = (_told_guard(g, guard) for g, guard in mode.guards.items())
    return f"mode '{key}': {rates}, while {', '.join(guards) or 'nothing ends it'}"


def _told_guard(key: str, guard: Guard) -> str:
    over = "" if guard.divisor == ONE else f"/({printed(guard.divisor)})"
    jumps = [
        f"{z} becomes {f'({printed(q)}){over}' if over else printed(q)}"
        for z, q in guard.reset.items()
    ]
    jumps.append("mode " + " or ".join(f"'{m}'" for m in guard.to))
    if guard.rest is not None:
        jumps.append(f"and '{guard.rest}' after infinitely many in finite time")
    return f"{printed(guard.value)} > 0 ('{key}', at 0 {', '.join(jumps)})"


def printed(q: Polynomial, angle: str = "omega t") -> str:
    """Return a polynomial as people write it; cos and sin are those of an angle."""
    line = " ".join(_terms(q, angle)) or "0"
    return "-" + line[2:] if line.startswith("- ") else line.removeprefix("+ ")


def _terms(q: Polynomial, angle: str) -> Iterator[str]:
    """Give the terms, each after its sign."""
    for monomial, c in q.terms.items():
        factors = [f"{z}({angle})" if z in CLOCK else z for z in monomial]
        if abs(c) != 1 or not factors:
            factors.insert(0, str(abs(c)))
        yield f"{'-' if c < 0 else '+'} {' '.join(factors)}"
