"""Published orbits of a system: each row of a table is proved, or refused with the reason.

A table is a CSV file with a row for each orbit.  For its contacts k = 0, 1, ... it has columns
``t0, x0, v0, ..``: the time and the state just before; ``periods`` of the clock; and, where a mode
has several guards or there are several modes, ``mode0``, ``guard0``, ``to0``.  A variable that is
missing follows from the guard, which is zero.  Other columns are left alone.

An orbit that is proved is compared with its row: each printed number, in units of its last place.
So a Newton iteration that ends at another orbit is seen.
"""

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from functools import cache
from math import cos, pi, sin
from pathlib import Path
from typing import Any

from cap.errors import BadInput, NotProved
from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs.contacts import Prepared, prove
from cap.system import form
from cap.system.model import System
from cap.system.polynomial import COS, SIN

MOST = 64  # contacts


@dataclass(frozen=True)
class Row:
    """An orbit of a table: the system as JSON, the name of the row, and its printed numbers."""

    system: str
    name: str
    contacts: tuple[Contact, ...]
    periods: int
    printed: tuple[tuple[int, str], ...]  # which unknown, and what is printed of it
    guess: tuple[float, ...]


@dataclass(frozen=True)
class Verdict:
    """What became of a row.

    ``proved``; how many multipliers are ``unstable``, outside a circle of a ``radius`` (None: it is
    not decided); the largest difference to a printed number, in units of its last place; else the
    ``reason``.
    """

    proved: bool
    unstable: int | None = None
    radius: str = "1"
    places: float = 0.0
    reason: str = ""

    def encoded(self) -> str:
        """Return it as a string."""
        return json.dumps(asdict(self))

    @classmethod
    def decoded(cls, text: str) -> "Verdict":
        """Return it from a string."""
        return cls(**json.loads(text))


def rows(system: System, path: Path) -> list[Row]:
    """Return the rows of a table; raise `BadInput` with what is wrong with it."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            listed = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"cannot read {path}: {error}") from None
    if not listed:
        raise BadInput(f"{path} has no rows")
    text = form.dumps(system)
    return [_row(system, text, given, f"{path}, row {k}") for k, given in enumerate(listed, 1)]


def _row(system: System, text: str, given: Mapping[str, Any], where: str) -> Row:
    if None in given or None in given.values():
        raise BadInput(f"{where} has not as many numbers as the first line has names")
    count = next(k for k in range(MOST + 1) if f"t{k}" not in given or k == MOST)
    if not count:
        raise BadInput(f"{where} has no column t0: times are t0, t1, ..")
    contacts = [_contact(system, given, k, where) for k in range(count)]
    guess, printed = list[float](), list[tuple[int, str]]()
    for k, contact in enumerate(contacts):
        known = {z: given[f"{z}{k}"] for z in ("t", *system.state) if f"{z}{k}" in given}
        values = {z: _number(x, f"{where}, {z}{k}") for z, x in known.items()}
        _completed(system, contact, values, where)
        for z in ("t", *system.state):
            if z in known:
                printed.append((len(guess), known[z]))
            guess.append(values[z])
    periods = int(_number(given.get("periods", "1"), f"{where}, periods"))
    name = given.get("row") or where.rpartition(" ")[2]
    itinerary = Itinerary(system, contacts, periods)
    return Row(text, name, tuple(itinerary.contacts), periods, tuple(printed), tuple(guess))


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise BadInput(f"{where} is no number: {text[:40]!r}") from None
    if not abs(value) < 1e9:
        raise BadInput(f"{where} is not between -1e9 and 1e9: {text[:40]!r}")
    return value


def _contact(system: System, given: Mapping[str, str], k: int, where: str) -> Contact:
    """Return a contact: named in the row, or the only one that there is."""
    found = list[str]()
    choices: Sequence[str] = list(system.modes)
    for column in ("mode", "guard", "to"):
        name = given.get(f"{column}{k}") or (choices[0] if len(choices) == 1 else "")
        if name not in choices:
            raise BadInput(f"{where} needs a column {column}{k}: one of {', '.join(choices)}")
        found.append(name)
        guards = system.modes[found[0]].guards
        choices = (
            list(guards)
            if column == "mode"
            else list(guards[found[-1]].to)
            if column == "guard"
            else ()
        )
    return Contact(*found)


def _completed(system: System, contact: Contact, values: dict[str, float], where: str) -> None:
    """Add the one variable that is missing: the guard, which it enters linearly, is zero."""
    missing = [z for z in system.state if z not in values]
    if not missing:
        return
    h = system.guard(contact.mode, contact.guard).value
    slope = h.derivative(missing[0])
    if len(missing) > 1 or slope.variables & set(system.state) or not slope:
        raise BadInput(f"{where} does not give {', '.join(missing)}")
    angle = values["t"] * system.omega.evaluated({}, float, pi)
    at = {COS: cos(angle), SIN: sin(angle), **values, missing[0]: 0.0}
    values[missing[0]] = -h.evaluated(at, float, pi) / slope.evaluated(at, float, pi)


@cache
def _prepared(text: str) -> tuple[System, Prepared]:
    system = form.loads(text)
    return system, Prepared.of(system)


@cache
def _itinerary(text: str, contacts: tuple[Contact, ...], periods: int) -> Itinerary:
    return Itinerary(_prepared(text)[0], contacts, periods)


def verdict(row: Row, digits: int = 10) -> Verdict:
    """Prove the orbit of a row, and let the independent checker verify it."""
    _, shared = _prepared(row.system)
    itinerary = _itinerary(row.system, row.contacts, row.periods)
    try:
        proved = prove(itinerary, row.guess, digits, shared)
    except NotProved as failure:
        return Verdict(False, reason=str(failure))
    claims = proved["claims"]
    unknowns = [
        pair for t, q in zip(claims["times"], claims["states"], strict=True) for pair in (t, *q)
    ]
    away = max(_places(text, unknowns[k]) for k, text in row.printed)
    count = int(claims["unstable"]) if "unstable" in claims else None
    return Verdict(True, count, claims.get("radius", "1"), away)


def _places(printed: str, pair: Sequence[str]) -> float:
    """Return how far a printed number is from an enclosure, in units of its last place."""
    try:
        number = Decimal(printed)
    except InvalidOperation:
        raise BadInput(f"not a decimal: {printed[:40]!r}") from None
    exponent = int(number.as_tuple().exponent)
    value, (low, high) = Fraction(number), map(Fraction, pair)
    away = max(low - value, value - high, Fraction(0))
    return float(away / Fraction(10) ** exponent)
