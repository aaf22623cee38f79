"""What a certificate may say, declared: tables of fields, each with the shape of its value.

A *shape* is a dictionary, a list, or a reader: a function of a value, and of its place.  A value
must match it exactly: the same keys, but for those that are ``optional``; the same length.

*Numbers* are exact (``number``), or upper bounds.  *Sets* [lower, upper] are of three kinds:

    Quantity(u)   an enclosure of one number of unit u, as narrow as the digits that are claimed
    enclosure     an enclosure of one number, or of what a quantity takes, of any width
    region        a set of which something is claimed for all its points

A *unit* is a product of powers of the units of the theorem, as "R^2 omega^-1".
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.reading import number, text
from cap.checker.kernel.rejection import need


class Enclosure(NamedTuple):
    """The closed interval [lower, upper], with the two strings that state it, and its unit."""

    lower: Fraction
    upper: Fraction
    text: tuple[str, str]
    unit: str | None = None

    def __str__(self) -> str:
        """Return the enclosure exactly as it is stated."""
        return f"[{self.text[0]}, {self.text[1]}]"


class Field(NamedTuple):
    """A field of a certificate: name and shape; for people a label, a symbol, and its meaning."""

    name: str
    shape: Any
    label: str
    symbol: str
    meaning: str


Table = tuple[Field, ...]


def matched(value: Any, shape: Any, where: str) -> Any:
    """Return the value with its leaves read; it must have exactly the given shape."""
    if isinstance(shape, dict):
        return fields(value, shape, where)
    if isinstance(shape, list):
        listed = isinstance(value, list) and len(value) == len(shape)
        need(listed, f"{where} is not a list of {len(shape)}")
        pairs = enumerate(zip(value, shape, strict=True))
        return [matched(v, part, f"{where}[{n}]") for n, (v, part) in pairs]
    return shape(value, where)


def fields(value: Any, shape: dict[str, Any], where: str) -> dict[str, Any]:
    """Return an object with its values read, in the order of its shape."""
    need(isinstance(value, dict), f"{where} is not an object")
    optional = {key for key, part in shape.items() if getattr(part, "optional", False)}
    complete = shape.keys() - optional <= value.keys() <= shape.keys()
    need(complete, f"{where} has missing or unknown fields")
    present = [(key, part) for key, part in shape.items() if key in value]
    return {key: matched(value[key], part, f"{where}.{key}") for key, part in present}


def columns(table: Table) -> dict[str, Any]:
    """Return the shape of an object with the fields of a table."""
    return {field.name: field.shape for field in table}


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


class Quantity(NamedTuple):
    """An enclosure of a number: at most 10^-digits max(|lower|, |upper|, unit) wide."""

    unit: str = ""

    def __call__(self, value: Any, where: str) -> Enclosure:
        """Read it."""
        return enclosure(value, where)._replace(unit=self.unit)


class Word(NamedTuple):
    """One of these words."""

    words: Sequence[str]

    def __call__(self, value: Any, where: str) -> str:
        """Read it."""
        need(value in self.words, f"{where} is none of: {', '.join(self.words)}")
        return str(value)


class Whole(NamedTuple):
    """An integer, in these bounds."""

    least: int
    most: int

    def __call__(self, value: Any, where: str) -> int:
        """Read it."""
        plain = re.fullmatch("0|[1-9][0-9]{0,5}", text(value, where)) is not None
        within = plain and self.least <= int(value) <= self.most
        need(within, f"{where} is not between {self.least} and {self.most}, as a plain integer")
        return int(value)


class Many(NamedTuple):
    """A list of values of one shape, so many at least and at most."""

    shape: Any
    least: int
    most: int

    def __call__(self, value: Any, where: str) -> Any:
        """Read it."""
        listed = isinstance(value, list) and self.least <= len(value) <= self.most
        need(listed, f"{where} is not a list of {self.least} to {self.most}")
        return matched(value, [self.shape] * len(value), where)
