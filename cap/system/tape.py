"""Formulas as a tape: operations on inputs and exact constants, each held once.

A `Term` is a place on its `Tape`.  Its arithmetic writes operations, after the obvious
simplifications: numbers are added and multiplied exactly, 0 and 1 disappear, signs move outwards.
An operation that is on the tape is not written again, so formulas share what they have in common.
A number is a rational times a power of π.

`gradients` writes the derivatives of terms on the same tape.  `cap.system.source` makes functions
of terms, for numbers of any kind.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from keyword import iskeyword
from typing import NamedTuple

ADD, SUB, MUL, DIV, NEG = "+", "-", "*", "/", "neg"

Gradient = Mapping[str, "Term"]  # by the names of variables; what is not there is zero


class Number(NamedTuple):
    """rational * π^power."""

    rational: Fraction
    power: int = 0


class Operation(NamedTuple):
    """A number, an input, or an operation on terms before it."""

    kind: str | Number
    operands: tuple[int, ...] = ()
    name: str = ""


INPUT = "input"
ZERO, ONE = Number(Fraction(0)), Number(Fraction(1))


class Tape:
    """The operations, in an order in which they can be carried out."""

    def __init__(self) -> None:
        self.operations: list[Operation] = []
        self._places: dict[Operation, int] = {}

    def number(self, rational: Fraction | int, power: int = 0) -> Term:
        """Return the constant rational * π^power."""
        q = Fraction(rational)
        return self.write(Operation(Number(q, power) if q else ZERO))

    def input(self, name: str) -> Term:
        """Return an input: the same for the same name, which stands as it is in a source."""
        if not name.isidentifier() or iskeyword(name):
            raise ValueError(f"not a name for an input: {name!r}")
        return self.write(Operation(INPUT, name=name))

    def write(self, operation: Operation) -> Term:
        """Return the term of an operation, which is written unless it is on the tape."""
        place = self._places.setdefault(operation, len(self.operations))
        if place == len(self.operations):
            self.operations.append(operation)
        return Term(self, place)


class Term:
    """What an operation on the tape results in."""

    __slots__ = ("place", "tape")

    def __init__(self, tape: Tape, place: int) -> None:
        self.tape, self.place = tape, place

    @property
    def operation(self) -> Operation:
        """The operation at this place."""
        return self.tape.operations[self.place]

    @property
    def number(self) -> Number | None:
        """The number that the term is, None if it is not one."""
        kind = self.operation.kind
        return kind if isinstance(kind, Number) else None

    @property
    def operands(self) -> list[Term]:
        """The terms of which the operation is made."""
        return [Term(self.tape, place) for place in self.operation.operands]

    def __add__(self, other: Term | Fraction | int) -> Term:
        other = self._lifted(other)
        a, b = self.number, other.number
        if ZERO in (a, b):
            return other if a == ZERO else self
        if a and b and a.power == b.power:
            return self.tape.number(a.rational + b.rational, a.power)
        for left, right in ((self, other), (other, self)):
            if right.operation.kind == NEG:
                return left - right.operands[0]
        return self._written(ADD, *sorted((self, other), key=_place))

    def __neg__(self) -> Term:
        operation = self.operation
        if isinstance(operation.kind, Number):
            return self.tape.number(-operation.kind.rational, operation.kind.power)
        if operation.kind == NEG:
            return self.operands[0]
        if operation.kind == SUB:
            left, right = self.operands
            return right - left
        if operation.kind == MUL and self.operands[0].number:
            factor, other = self.operands
            return -factor * other
        return self._written(NEG, self)

    def __sub__(self, other: Term | Fraction | int) -> Term:
        other = self._lifted(other)
        a, b = self.number, other.number
        if b or a == ZERO:
            return self + -other
        if self.place == other.place:
            return self.tape.number(0)
        if other.operation.kind == NEG:
            return self + other.operands[0]
        return self._written(SUB, self, other)

    def __mul__(self, other: Term | Fraction | int) -> Term:
        other = self._lifted(other)
        if a := self.number:
            return _scaled(other, a)
        if b := other.number:
            return _scaled(self, b)
        for left, right in ((self, other), (other, self)):
            if right.operation.kind == NEG:
                return -(left * right.operands[0])
        return self._written(MUL, *sorted((self, other), key=_place))

    def __truediv__(self, other: Term | Fraction | int) -> Term:
        other = self._lifted(other)
        if b := other.number:
            return self * self.tape.number(1 / b.rational, -b.power)
        return self if self.number == ZERO else self._written(DIV, self, other)

    def __pow__(self, exponent: int) -> Term:
        result = self.tape.number(1)
        for _ in range(exponent):
            result = result * self
        return result

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other: Fraction | int) -> Term:
        return self._lifted(other) - self

    def __rtruediv__(self, other: Fraction | int) -> Term:
        return self._lifted(other) / self

    def _lifted(self, other: Term | Fraction | int) -> Term:
        return other if isinstance(other, Term) else self.tape.number(other)

    def _written(self, kind: str, *operands: Term) -> Term:
        return self.tape.write(Operation(kind, tuple(map(_place, operands))))


def _scaled(term: Term, factor: Number) -> Term:
    """Return the product of a term and a number."""
    kind, operands = term.operation.kind, term.operands
    if factor == ONE:
        return term
    if factor == Number(Fraction(-1)):
        return -term
    if kind == NEG:
        return _scaled(operands[0], Number(-factor.rational, factor.power))
    if isinstance(kind, Number):
        return term.tape.number(factor.rational * kind.rational, factor.power + kind.power)
    if kind == MUL and (b := operands[0].number):
        both = Number(factor.rational * b.rational, factor.power + b.power)
        return _scaled(operands[1], both)
    c = term.tape.number(*factor)
    return c if factor == ZERO else term.tape.write(Operation(MUL, (c.place, term.place)))


def _place(term: Term) -> int:
    return term.place


def is_zero(term: Term) -> bool:
    """Return whether the term is the number 0; others may vanish, too."""
    return term.number == ZERO


def needed(outputs: Iterable[Term]) -> list[Term]:
    """Return the terms of which the ``outputs`` are made, themselves included, in order."""
    stack, found = list(outputs), dict[int, Term]()
    while stack:
        term = stack.pop()
        if term.place not in found:
            found[term.place] = term
            stack += term.operands
    return [found[place] for place in sorted(found)]


def gradients(outputs: Sequence[Term], inputs: Mapping[str, Gradient]) -> list[Gradient]:
    """Return the derivatives of the ``outputs``, given those of the ``inputs``.

    An input that is not given is constant.
    """
    found = dict[int, Gradient]()
    for term in needed(outputs):
        kind, places, name = term.operation
        if places:
            found[term.place] = _by_rule(term, [found[place] for place in places])
        else:
            found[term.place] = inputs.get(name, {}) if kind == INPUT else {}
    return [found[term.place] for term in outputs]


def _by_rule(term: Term, parts: Sequence[Gradient]) -> Gradient:
    """Return the gradient of an operation, from those of its operands."""
    zero, result = term.tape.number(0), dict[str, Term]()
    for variable in sorted({v for part in parts for v in part}):
        slope = _slope(term, [part.get(variable, zero) for part in parts])
        if not is_zero(slope):
            result[variable] = slope
    return result


def _slope(term: Term, by: Sequence[Term]) -> Term:
    """Return the derivative of an operation whose operands have the derivatives ``by``."""
    kind, operands = term.operation.kind, term.operands
    if kind == NEG:
        return -by[0]
    if kind == ADD:
        return by[0] + by[1]
    if kind == SUB:
        return by[0] - by[1]
    if kind == MUL:
        return by[0] * operands[1] + operands[0] * by[1]
    return (by[0] - term * by[1]) / operands[1]
