"""Functions from terms: straight-line Python, for numbers of any kind.

A `Function` is written once.  ``bound`` makes it a Python function over one kind of numbers, in
which the constants are enclosed, or rounded: balls at the working precision, doubles, or what the
caller makes of rationals and π.  Jets and Taylor models over balls take the function of balls.
"""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from math import pi
from typing import Any

from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.tape import NEG, Number, Term, needed

Evaluated = Callable[..., tuple[Any, ...]]


class Function:
    """Outputs as a function of inputs, both in a fixed order.

    ``parameters`` are inputs that get their values once, when the function is bound.
    """

    def __init__(
        self, inputs: Sequence[str], outputs: Sequence[Term], parameters: Sequence[str] = ()
    ) -> None:
        self.inputs, self.outputs = tuple(inputs), tuple(outputs)
        self.parameters = tuple(parameters)
        self._at: dict[object, Evaluated] = {}

    @cached_property
    def source(self) -> str:
        """A function ``make`` of numbers and parameters, which returns the function."""
        writer = _Writer(self.outputs, self.parameters)
        ends = "".join(f"{writer.text[term.place]}, " for term in self.outputs)
        return (
            f"def make({', '.join((*writer.numbers, *self.parameters))}):\n"
            + "".join(f"    {line}\n" for line in writer.once)
            + f"    def function({', '.join(self.inputs)}):\n"
            + "".join(f"        {line}\n" for line in writer.body)
            + f"        return ({ends})\n    return function\n"
        )

    @cached_property
    def numbers(self) -> list[Number]:
        """The numbers that occur, in the order of the places."""
        return [term.number for term in needed(self.outputs) if term.number]

    @cached_property
    def _make(self) -> Callable[..., Evaluated]:
        scope: dict[str, Any] = {}
        exec(self.source, scope)  # noqa: S102 (made of places, operators and names of inputs)
        make: Callable[..., Evaluated] = scope["make"]
        return make

    def bound(
        self, constant: Callable[[Number], Any], values: Mapping[str, Any] | None = None
    ) -> Evaluated:
        """Return the function, its constants made by ``constant``, with values of parameters."""
        given = [values[name] for name in self.parameters] if values else []
        return self._make(*map(constant, self.numbers), *given)

    def balls(self) -> Evaluated:
        """Return the function over balls: an enclosure, at the precision here."""
        bits = interval.working_bits()
        if bits not in self._at:
            self._at[bits] = self.bound(enclosed)
        return self._at[bits]

    def floats(self) -> Evaluated:
        """Return the function over doubles, or arrays of them; nothing is rounded outwards."""
        if float not in self._at:
            self._at[float] = self.bound(rounded)
        return self._at[float]


def enclosed(number: Number) -> Ball:
    """Return a ball that contains the number."""
    q = interval.ball(number.rational)
    return q * interval.pi() ** number.power if number.power else q


def rounded(number: Number) -> float:
    """Return a double near the number."""
    return float(number.rational) * pi**number.power


class _Writer:
    """The lines of a function; a term that is used once is written where it is used."""

    def __init__(self, outputs: Sequence[Term], parameters: Sequence[str]) -> None:
        self.text: dict[int, str] = {}
        self.numbers: list[str] = []
        self.once: list[str] = []  # lines for terms without inputs, but for parameters
        self.body: list[str] = []
        terms = needed(outputs)
        self._constant = set[int]()
        self._parameters = set(parameters)
        self._uses = Counter(place for term in terms for place in term.operation.operands)
        self._uses.update(term.place for term in outputs)
        for term in terms:
            self._write(term)

    def _write(self, term: Term) -> None:
        place, operands = term.place, term.operation.operands
        if term.number:
            self.text[place] = f"n{place}"
            self.numbers.append(self.text[place])
            self._constant.add(place)
        elif not operands:
            self.text[place] = term.operation.name
            if term.operation.name in self._parameters:
                self._constant.add(place)
        else:
            self._operate(term, constant=self._constant.issuperset(operands))

    def _operate(self, term: Term, *, constant: bool) -> None:
        kind, operands = term.operation.kind, [self.text[p] for p in term.operation.operands]
        text = f"(-{operands[0]})" if kind == NEG else f"({operands[0]} {kind} {operands[1]})"
        self.text[term.place] = text
        if constant:
            self._constant.add(term.place)
        if constant or self._uses[term.place] > 1:
            self.text[term.place] = f"z{term.place}"
            (self.once if constant else self.body).append(f"z{term.place} = {text}")
