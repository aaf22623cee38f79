"""What a certificate may say, declared: tables of fields, each with the shape of its value.

A *shape* is built of dictionaries, lists and the classes below; a value must match it exactly: the
same keys, but for those that are ``Maybe`` or of ``Some``; the same lengths, but for
``Many`` and ``First``.  Its leaves are numbers and words, and sets [lower, upper] of three kinds:

    Quantity(u)   an enclosure of one number of unit u, as narrow as the digits that are claimed
    enclosure     an enclosure of one number, or of what a quantity takes, of any width
    region        a set of which something is claimed for all its points
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.reading import bounded, number, text
from cap.checker.kernel.rejection import Rejected, need


class Unit(NamedTuple):
    """The unit R^a omega^b F^c."""

    R: int = 0
    omega: int = 0
    F: int = 0


ONE, LENGTH, SPEED, FORCE = Unit(), Unit(R=1), Unit(R=1, omega=1), Unit(F=1)
TIME, RATE = Unit(omega=-1), Unit(omega=1)


class Enclosure(NamedTuple):
    """The closed interval [lower, upper], with the two strings that state it, and its unit."""

    lower: Fraction
    upper: Fraction
    text: tuple[str, str]
    unit: Unit | None = None

    def __str__(self) -> str:
        """Return the enclosure exactly as it is stated."""
        return f"[{self.text[0]}, {self.text[1]}]"


class Quantity(NamedTuple):
    """An enclosure of a number: at most 10^-digits max(|lower|, |upper|, unit) wide."""

    unit: Unit = ONE


class Taken(NamedTuple):
    """An enclosure of what a quantity takes, each end so many digits sharp."""

    unit: Unit | None
    digits: int


class Word(NamedTuple):
    """One of these words."""

    words: Sequence[str]


class Whole(NamedTuple):
    """An integer, in these bounds."""

    least: int
    most: int


class Many(NamedTuple):
    """A list of values of one shape, so many at least and at most."""

    shape: Any
    least: int
    most: int


class Maybe(NamedTuple):
    """The value of a field that may be missing."""

    shape: Any


class Some(NamedTuple):
    """An object with some of these fields."""

    shapes: Mapping[str, Any]


class First(NamedTuple):
    """A list of the first few of these values."""

    shapes: Sequence[Any]


class OrNone(NamedTuple):
    """A value of this shape or, for what does not exist, the word "none"."""

    shape: Any


class Cases(NamedTuple):
    """An object of one of several shapes: the one in the cases that has its value of a key."""

    key: str
    cases: Mapping[str, Mapping[str, Any]]


class OneOrOther(NamedTuple):
    """An object of the first shape, or what is no object, of the second shape."""

    thing: Mapping[str, Any]
    other: Any


class Field(NamedTuple):
    """A field of a certificate: name and shape; for people a label, a symbol, and its meaning."""

    name: str
    shape: Any
    label: str
    symbol: str
    meaning: str


Table = tuple[Field, ...]


def enclosure(value: Any, where: str) -> Enclosure:
    """Return a pair of numbers with lower <= upper."""
    lower, upper = matched(value, [number, number], where)
    need(lower <= upper, f"{where} has lower > upper")
    return Enclosure(lower, upper, (value[0], value[1]))


def region(value: Any, where: str) -> Enclosure:
    """Return the same; what is claimed of all its points need not hold of a larger set."""
    return enclosure(value, where)


def bound(value: Any, where: str) -> Fraction:
    """Return an upper bound."""
    return number(value, where)


def tabled(value: Any, table: Table, where: str) -> dict[str, Any]:
    """Return an object with the fields of a table."""
    read: dict[str, Any] = matched(value, {field.name: field.shape for field in table}, where)
    return read


def matched(value: Any, shape: Any, where: str) -> Any:
    """Return the value with its leaves read; it must have exactly the given shape."""
    match shape:
        case dict() | Some() | Cases():
            triples = fields(value, shape, where)
            return {key: matched(v, part, f"{where}.{key}") for key, v, part in triples}
        case list() | Many() | First():
            pairs = enumerate(items(value, shape, where))
            return [matched(v, part, f"{where}[{n}]") for n, (v, part) in pairs]
        case OrNone(part):
            return None if value == "none" else matched(value, part, where)
        case OneOrOther(thing, other):
            return matched(value, thing if isinstance(value, dict) else other, where)
        case _:
            return leaf(value, shape, where)


def fields(value: Any, shape: Any, where: str) -> list[tuple[str, Any, Any]]:
    """Return the keys of an object, in the order of its shape, with their values and shapes."""
    if not isinstance(value, dict):
        raise Rejected(f"{where} is not an object")
    match shape:
        case Some(shape):
            optional = set(shape)
        case Cases(key, cases):
            chosen = [case for name, case in cases.items() if value.get(key) == name]
            need(len(chosen) == 1, f"{where}.{key} is none of: {', '.join(cases)}")
            shape, optional = {key: text, **chosen[0]}, set()
        case _:
            optional = {key for key, part in shape.items() if isinstance(part, Maybe)}
    complete = shape.keys() - optional <= value.keys() <= shape.keys()
    need(complete, f"{where} has missing or unknown fields")
    parts = ((key, part.shape if isinstance(part, Maybe) else part) for key, part in shape.items())
    return [(key, value[key], part) for key, part in parts if key in value]


def items(value: Any, shape: Any, where: str) -> list[tuple[Any, Any]]:
    """Return the items of a list with their shapes."""
    listed = isinstance(value, list)
    match shape:
        case Many(part, least, most):
            within = listed and least <= len(value) <= most
            need(within, f"{where} is not a list of {least} to {most}")
            shape = [part] * len(value)
        case First(shapes):
            shape = shapes[: len(value) if listed else 0]
    need(listed and len(value) == len(shape), f"{where} is not a list of {len(shape)}")
    return list(zip(value, shape, strict=True))


def leaf(value: Any, shape: Any, where: str) -> Any:
    """Return a number, a word, or a set."""
    match shape:
        case Quantity(unit) | Taken(unit, _):
            return enclosure(value, where)._replace(unit=unit)
        case Word(words):
            need(value in words, f"{where} is none of: {', '.join(words)}")
            return str(value)
        case Whole(least, most):
            return bounded(text(value, where), least, most, where)
        case _:
            return shape(value, where)
