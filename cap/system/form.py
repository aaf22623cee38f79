"""A system as JSON, both ways: exact numbers, and names that are only compared.

    {"format": "cap-system/1", "state": ["x", "v"], "parameters": [], "omega": TERM,
     "modes": {"right": {"x": POLYNOMIAL, "v": POLYNOMIAL}, ...},
     "guards": {"right": {"wall": {"value": POLYNOMIAL, "to": ["left"], "reset": RESET}, ...}}}

A polynomial is a list of terms; a term is a list: a rational as a string, then the names of its
factors, each as often as its power; "1/pi" is the only one that divides.  ``omega`` is a
polynomial, too.  A reset is {"v": [numerator, denominator], ...}, or {"bounce": {"e": POLYNOMIAL,
"masses": {"v": POLYNOMIAL}}}.  A guard may have "rest": the name of a mode.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from cap.errors import BadInput
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import PI, Monomial, Polynomial, Quotient
from cap.system.validation import DEGREE, POWERS_OF_PI, TERMS

FORMAT = "cap-system/1"
OVER_PI = "1/pi"
_RATIONAL = re.compile(r"-?(0|[1-9][0-9]{0,199})(/[1-9][0-9]{0,199})?", re.ASCII)
LONGEST = 1_000_000  # characters of a system


def dumps(system: System) -> str:
    """Return the system as JSON."""
    return json.dumps(as_json(system), indent=1) + "\n"


def loads(text: str) -> System:
    """Return the system that `dumps` wrote; raise `BadInput` on anything else."""
    if len(text) > LONGEST:
        raise BadInput(f"a system of more than {LONGEST} characters")
    try:
        value = json.loads(text, object_pairs_hook=_object, parse_constant=_no_number)
    except (json.JSONDecodeError, RecursionError) as error:
        raise BadInput(f"not JSON: {error}") from None
    if isinstance(value, dict) and "theorem" in value:
        raise BadInput(
            "a certificate, which `cap.verify` reads, no system: that is FILE.py, or JSON as "
            "cap.system.form writes it"
        )
    return from_json(value)


def as_json(system: System) -> dict[str, Any]:
    """Return the system as what `json.dumps` takes."""
    return {
        "format": FORMAT,
        "state": list(system.state),
        "parameters": list(system.parameters),
        "omega": _polynomial(system.omega),
        "modes": {
            name: {z: _polynomial(q) for z, q in mode.field.items()}
            for name, mode in system.modes.items()
        },
        "guards": {
            name: {guard: _guard(g) for guard, g in mode.guards.items()}
            for name, mode in system.modes.items()
        },
    }


def from_json(value: object) -> System:
    """Return the system that `as_json` wrote; raise `BadInput` on anything else."""
    keys = ("format", "state", "parameters", "omega", "modes", "guards")
    parts = _dictionary(value, "the system", keys)
    if parts["format"] != FORMAT:
        raise BadInput(f"the format is not {FORMAT}")
    modes = _dictionary(parts["modes"], "modes")
    guards = _dictionary(parts["guards"], "guards", modes)
    return System(
        _names(parts["state"], "the state"),
        _read_polynomial(parts["omega"], "omega"),
        {name: _read_mode(modes[name], guards[name], f"the mode {name}") for name in modes},
        _names(parts["parameters"], "the parameters"),
    )


def _guard(guard: Guard) -> dict[str, Any]:
    found = {
        "value": _polynomial(guard.value),
        "to": list(guard.to),
        "reset": _reset(guard.reset),
    }
    return found if guard.rest is None else found | {"rest": guard.rest}


def _reset(reset: Mapping[str, Polynomial | Quotient] | Bounce) -> dict[str, Any]:
    if isinstance(reset, Bounce):
        masses = {z: _polynomial(m) for z, m in reset.masses.items()}
        return {"bounce": {"e": _polynomial(reset.e), "masses": masses}}
    quotients = {z: Quotient.of(q) for z, q in reset.items()}
    return {z: [_polynomial(q.numerator), _polynomial(q.denominator)] for z, q in quotients.items()}


def _polynomial(q: Polynomial) -> list[list[str]]:
    return [[str(c), *_factors(monomial)] for monomial, c in sorted(q.terms.items())]


def _factors(monomial: Monomial) -> list[str]:
    return [n if k > 0 else OVER_PI for n, k in monomial for _ in range(abs(k))]


def _read_mode(field: object, guards: object, where: str) -> Mode:
    rates = _dictionary(field, where)
    named = _dictionary(guards, f"the guards of {where}")
    return Mode(
        {z: _read_polynomial(q, f"{z}' in {where}") for z, q in rates.items()},
        {name: _read_guard(g, f"the guard {name} of {where}") for name, g in named.items()},
    )


def _read_guard(value: object, where: str) -> Guard:
    keys = ("value", "to", "reset")
    rest = isinstance(value, dict) and "rest" in value
    parts = _dictionary(value, where, (*keys, "rest") if rest else keys)
    return Guard(
        _read_polynomial(parts["value"], where),
        _names(parts["to"], f"what follows {where}"),
        _read_reset(parts["reset"], f"the reset of {where}"),
        _name(parts["rest"], where) if rest else None,
    )


def _read_reset(value: object, where: str) -> Mapping[str, Polynomial | Quotient] | Bounce:
    parts = _dictionary(value, where)
    if parts.keys() == {"bounce"} and isinstance(parts["bounce"], dict):
        bounce = _dictionary(parts["bounce"], where, ("e", "masses"))
        masses = _dictionary(bounce["masses"], f"the masses of {where}")
        inertia = {z: _read_polynomial(m, where) for z, m in masses.items()}
        return Bounce(_read_polynomial(bounce["e"], where), inertia)
    return {z: _read_quotient(q, f"{z} in {where}") for z, q in parts.items()}


def _read_quotient(value: object, where: str) -> Quotient:
    pair = _list(value, where)
    if len(pair) != 2:
        raise BadInput(f"{where} is not a pair of polynomials")
    return Quotient(*(_read_polynomial(q, where) for q in pair))


def _read_polynomial(value: object, where: str) -> Polynomial:
    terms = _list(value, where)
    if len(terms) > TERMS:
        raise BadInput(f"{where} has more than {TERMS} terms")
    found = dict[Monomial, Fraction]()
    for term in terms:
        monomial, c = _read_term(_list(term, where), where)
        if monomial in found or not c:
            raise BadInput(f"{where} has a term twice, or one that is 0")
        found[monomial] = c
    return Polynomial(found)


def _read_term(term: list[object], where: str) -> tuple[Monomial, Fraction]:
    number, *factors = term or [None]
    if not isinstance(number, str) or not _RATIONAL.fullmatch(number):
        raise BadInput(f"{where} has no exact number: write a rational as a string, as '-2/5'")
    if len(factors) > DEGREE + POWERS_OF_PI:
        raise BadInput(f"{where} has a term with too many factors")
    names = Counter(_name(factor, where) for factor in factors)
    divided = names.pop(OVER_PI, 0)
    if divided and names[PI]:
        raise BadInput(f"{where} has pi and 1/pi in a term")
    if divided:
        names[PI] = -divided
    return tuple(sorted((name, k) for name, k in names.items() if k)), Fraction(number)


def _names(value: object, where: str) -> tuple[str, ...]:
    return tuple(_name(name, where) for name in _list(value, where))


def _name(value: object, where: str) -> str:
    if not isinstance(value, str) or not 0 < len(value) <= 80 or not value.isprintable():
        raise BadInput(f"not a name in {where}: {str(value)[:40]!r}")
    return value


def _list(value: object, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise BadInput(f"{where} is not a list")
    return value


def _dictionary(value: object, where: str, keys: Any = None) -> dict[str, Any]:
    """Return a dictionary, which has these keys if some are given."""
    if not isinstance(value, dict):
        raise BadInput(f"{where} is not an object")
    for key in value.keys() ^ set(value if keys is None else keys):
        raise BadInput(f"{where} has the unknown field {_name(key, where)!r}, or lacks it")
    return value


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise BadInput("a name stands twice in an object")
    return found


def _no_number(text: str) -> None:
    raise BadInput(f"not an exact number: {text}")
