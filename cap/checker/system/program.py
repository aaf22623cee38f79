"""Formulas as lists of operations, written once and carried out in integers.

A `Term` is the place of a number on a `Tape`.  Its arithmetic, that of an interval, does not
compute but writes operations; one that is there is not written again, and products with 0 and 1 and
operations on constants are left out.  A `Program` carries out those that its outputs need: from
intervals for the inputs it computes enclosures, each operation as in `Interval`.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected

ADD, SUB, MUL, DIV, SCALE, GIVEN = range(6)
Operation = tuple[int, int, int]


class Tape:
    """Operations, after the inputs; constants are intervals of these bits."""

    def __init__(self, bits: int) -> None:
        self.bits = bits
        self.operations: list[Operation] = []
        self.constants = dict[int, Interval]()
        self.scales = list[Fraction]()
        self.given = list[Term]()  # all inputs
        self._places = dict[Operation, int]()

    def inputs(self, count: int) -> list[Term]:
        """Return the next inputs."""
        found = [self.write((GIVEN, len(self.operations), 0)) for _ in range(count)]
        self.given += found
        return found

    def write(self, operation: Operation) -> Term:
        """Return the term of an operation."""
        place = self._places.setdefault(operation, len(self.operations))
        if place == len(self.operations):
            self.operations.append(operation)
        return Term(self, place)

    def constant(self, value: Interval) -> Term:
        """Return a constant."""
        place = len(self.operations)
        same = (p for p, x in self.constants.items() if (x.lo, x.hi) == (value.lo, value.hi))
        found = next(same, place)
        if found == place:
            self.constants[place] = value
            self.operations.append((GIVEN, place, 0))
        return Term(self, found)


class Term:
    """What an operation on the tape results in."""

    __slots__ = ("place", "tape")

    def __init__(self, tape: Tape, place: int) -> None:
        self.tape, self.place = tape, place

    @property
    def constant(self) -> Interval | None:
        """The constant that the term is, None if it is not one."""
        return self.tape.constants.get(self.place)

    def integer(self, n: int) -> Term:
        """Return the integer n."""
        one = 1 << self.tape.bits
        return self.tape.constant(Interval(n * one, n * one, self.tape.bits))

    def is_integer(self, n: int) -> bool:
        """Return whether the term is the constant n."""
        value = self.constant
        return value is not None and value.lo == value.hi == n << value.bits

    def __add__(self, other: Term | int) -> Term:
        b = self._lifted(other)
        if self.is_integer(0) or b.is_integer(0):
            return b if self.is_integer(0) else self
        if self.constant and b.constant:
            return self.tape.constant(self.constant + b.constant)
        return self.tape.write((ADD, min(self.place, b.place), max(self.place, b.place)))

    def __sub__(self, other: Term | int) -> Term:
        b = self._lifted(other)
        if b.is_integer(0):
            return self
        if self.constant and b.constant:
            return self.tape.constant(self.constant - b.constant)
        return self.tape.write((SUB, self.place, b.place))

    def __neg__(self) -> Term:
        return self.integer(0) - self

    def __mul__(self, other: Term | Fraction | int) -> Term:
        if isinstance(other, Fraction):
            return self._scaled(other)
        b = self._lifted(other)
        for x, y in ((self, b), (b, self)):
            if x.is_integer(0) or y.is_integer(1):
                return x
        if self.constant and b.constant:
            return self.tape.constant(self.constant * b.constant)
        return self.tape.write((MUL, min(self.place, b.place), max(self.place, b.place)))

    def __truediv__(self, other: Term | int) -> Term:
        b = self._lifted(other)
        if self.is_integer(0) or b.is_integer(1):
            return self
        return self.tape.write((DIV, self.place, b.place))

    def _scaled(self, c: Fraction) -> Term:
        if self.constant:
            return self.tape.constant(self.constant * c)
        if c in (0, 1):
            return self if c else self.integer(0)
        if c not in self.tape.scales:
            self.tape.scales.append(c)
        return self.tape.write((SCALE, self.place, self.tape.scales.index(c)))

    def _lifted(self, other: Term | int) -> Term:
        return other if isinstance(other, Term) else self.integer(other)


class Program:
    """The operations that some terms need, in an order in which they can be carried out."""

    def __init__(self, inputs: Sequence[Term], outputs: Sequence[Term]) -> None:
        tape = inputs[0].tape
        self.bits, self.scales = tape.bits, [(c.numerator, c.denominator) for c in tape.scales]
        needed, waiting = set[int](), [term.place for term in outputs]
        while waiting:
            place = waiting.pop()
            if place not in needed:
                needed.add(place)
                kind, i, j = tape.operations[place]
                waiting += [] if kind == GIVEN else [i] if kind == SCALE else [i, j]
        constants = [place for place in tape.constants if place in needed]
        given = [term.place for term in inputs] + constants
        written = sorted(needed.difference(given))
        at = {place: k for k, place in enumerate([*given, *written])}
        self.low = [tape.constants[place].lo for place in constants]
        self.high = [tape.constants[place].hi for place in constants]
        self.operations = list[Operation]()
        for kind, i, j in (tape.operations[place] for place in written):
            self.operations.append((kind, at[i], j if kind == SCALE else at[j]))
        self.outputs = [at[term.place] for term in outputs]

    def run(self, inputs: Sequence[Interval]) -> list[Interval]:
        """Return enclosures of the outputs for all values of the inputs."""
        bits, scales = self.bits, self.scales
        lo, hi = [x.lo for x in inputs] + self.low, [x.hi for x in inputs] + self.high
        low, high = lo.append, hi.append
        for kind, i, j in self.operations:
            a, b = lo[i], hi[i]
            if kind == MUL:
                c, d = lo[j], hi[j]
                if a >= 0:
                    least, most = (a if c >= 0 else b) * c, (b if d >= 0 else a) * d
                elif b <= 0:
                    least, most = (a if d >= 0 else b) * d, (b if c >= 0 else a) * c
                else:
                    least, most = min(a * d, b * c), max(a * c, b * d)
                low(least >> bits)
                high(-(-most >> bits))
            elif kind == ADD:
                low(a + lo[j])
                high(b + hi[j])
            elif kind == SUB:
                low(a - hi[j])
                high(b - lo[j])
            elif kind == SCALE:
                n, m = scales[j]
                a, b = (a * n, b * n) if n >= 0 else (b * n, a * n)
                low(a // m)
                high(-(-b // m))
            else:
                c, d = lo[j], hi[j]
                if c <= 0 <= d:
                    raise Rejected("division by an interval that contains zero")
                if d < 0:
                    a, b, c, d = -b, -a, -d, -c
                a, b = a << bits, -b << bits
                low(min(a // c, a // d))
                high(-min(b // c, b // d))
        return [Interval(lo[k], hi[k], bits) for k in self.outputs]
