"""The flights of a mode as terms, for functions over any scalar.

Let z' = A z + b + c cos wt + s sin wt.  If A is nilpotent, a flight is a polynomial in its duration
and a response to the clock, exactly (`cap.system.flight`).  Else it is

    z(t) = response(t) + X (z - response, 1),     X = exp(N d),  N = ((A, b), (0, 0)),

where the entries of X are inputs: whoever evaluates the terms provides them, and dX/dd = X N.  In
resonance there is no response: then z(t) = X (z, cos wt_0, sin wt_0, 1), with N = M of the mode.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property

from cap.errors import BadInput
from cap.sets import interval
from cap.system.exponential import BITS, Exponential
from cap.system.flight import Flights, Scalars, flights, response
from cap.system.model import System
from cap.system.polynomial import COS, SIN, Polynomial
from cap.system.tape import Tape, Term

Clock = tuple[Term, Term]
Generator = list[list[Polynomial]]


class Motion:
    """The flights of a mode; ``generator`` is N, empty if A is nilpotent."""

    def __init__(self, system: System, mode: str) -> None:
        self.system, self.mode, self.generator = system, mode, Generator()
        try:
            found = flights(system, mode)
        except BadInput:
            found = None
        self.flights = found if found and not any(c.integrals for c in found.courses) else None
        if self.flights is None:
            self._exponential(mode)

    def _exponential(self, mode: str) -> None:
        """Choose N, and the response, with as few rows as will do."""
        if self.system.parameters:
            raise BadInput(f"with parameters, flights of {mode} must be polynomials in time")
        system, M, n = self.system, self.system.matrix(mode), len(self.system.state)
        places = [*range(n), *range(n, n + 3)]
        try:
            forced = response(system, mode)
        except BadInput:
            self.response = None
        else:
            self.response = Flights(system.state, *forced, ())
            places = [*range(n), *([n + 2] if any(M[i][n + 2] for i in range(n)) else [])]
        self.generator = [[M[i][j] for j in places] for i in places]

    @cached_property
    def in_doubles(self) -> Exponential:
        """X as a function of doubles d."""
        with interval.workprec(BITS):
            return Exponential(self.generator, len(self.system.state))

    @cached_property
    def inputs(self) -> list[str]:
        """The names of the entries of X in the rows of the state."""
        return [x for row in self._names() for x in row]

    def _names(self) -> list[list[str]]:
        rows = range(len(self.system.state) if self.generator else 0)
        return [[f"x{i}_{j}" for j in range(len(self.generator))] for i in rows]

    def rates(self, tape: Tape) -> dict[str, Term]:
        """Return the derivatives of the inputs by the duration."""
        of, N = scalars(tape), self.generator
        return {
            x: _sum(tape, [tape.input(y) * of.value(N[k][j], {}) for k, y in enumerate(row)])
            for row in self._names()
            for j, x in enumerate(row)
        }

    def arrival(
        self, z: Sequence[Term], start: Clock, duration: Term, end: Clock
    ) -> Mapping[str, Term]:
        """Return the values of all variables, the clock's too, at the end of a flight."""
        tape = duration.tape
        state = self._arrival(scalars(tape), z, start, duration, end)
        return named(self.system, state, end)

    def _arrival(
        self, of: Scalars, z: Sequence[Term], start: Clock, duration: Term, end: Clock
    ) -> list[Term]:
        if self.flights:
            values = parameters(self.system, duration.tape)
            rest = self.flights.launch(z, start, values, of)
            return self.flights.state_at(rest, duration, end, values, of)
        tape, vector = duration.tape, list(z)
        if self.response:
            vector = list(self.response.launch(z, start, {}, of).values())
        one = tape.number(1)
        vector += {len(z): [], len(z) + 1: [one]}.get(len(self.generator), [*start, one])
        moved = [
            _sum(tape, [tape.input(x) * y for x, y in zip(row, vector, strict=True)])
            for row in self._names()
        ]
        if not self.response:
            return moved
        return [a + b for a, b in zip(moved, self.response.response(end, {}, of), strict=True)]


def scalars(tape: Tape) -> Scalars:
    """Return what the flights need of terms: constants; there are no integrals."""

    def refused(*_: object) -> Term:
        raise BadInput("a flight with an exponential is not a term")

    return Scalars(tape.number, tape.number(1, 1), refused)


def named(system: System, state: Sequence[Term], clock: Clock) -> dict[str, Term]:
    """Return terms by the names of the variables and parameters that they stand for."""
    given = parameters(system, clock[0].tape)
    return given | dict(zip(system.state, state, strict=True)) | {COS: clock[0], SIN: clock[1]}


def parameters(system: System, tape: Tape) -> dict[str, Term]:
    """Return the parameters of a system as inputs."""
    return {name: tape.input(name) for name in system.parameters}


def _sum(tape: Tape, terms: Sequence[Term]) -> Term:
    return sum(terms, tape.number(0))
