"""Flights of a mode whose field is linear: springs and dampers, too.

Let the field of the mode be A z + b + c cos wt + s sin wt, with rational A and b.

*The response* P = U cos wt + V sin wt solves z' = A z + c cos wt + s sin wt if w V = A U + c and
-w U = A V + s, which is

    (w^2 + A^2) V = w c - A s,      U = -(A V + s)/w,

so z - P is a flight of A z + b, and with d = t - t_0

    z(t) = P(t) + (exp(N d) (z - P, 1)(t_0)) without its last row,      N = ((A, b), (0, 0)).

*Resonance.*  If the linear equation for V is not solved, the clock is put into the state: y = (z,
cos wt, sin wt, 1) has y' = M y, and z(t) is the beginning of exp(M d) y(t_0), for every rational w.

Beyond its ends a flight is continued by these formulas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache, reduce
from operator import add
from typing import NamedTuple, Protocol, TypeVar

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.evaluation import Values
from cap.checker.system.exponential import Exponential
from cap.checker.system.model import CLOCK, PI, Model
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.program import Program, Tape, Term

W = TypeVar("W", bound="Ring")
Vector = list[Interval]
Pairs = list[tuple[Interval, Interval]]


class Ring(Protocol):
    """What may stand for a variable of the state."""

    def __add__(self: W, other: W, /) -> W: ...
    def __sub__(self: W, other: W, /) -> W: ...
    def __mul__(self: W, other: W, /) -> W: ...


def matrix(model: Model, mode: str) -> list[list[Polynomial]]:
    """Return M; its entries have no variables but pi.  A field that is not linear rejects."""
    field, w, names = model.modes[mode].field, model.frequency, (*model.state, *CLOCK)
    none = Polynomial({})
    rows = list[list[Polynomial]]()
    for z in model.state:
        constants = [*(field[z].derivative(y) for y in names), field[z].without(names)]
        need(all(q.variables <= {PI} for q in constants), f"the mode {mode} is not linear")
        rows.append(constants)
    zeros = [none] * len(model.state)
    return [*rows, [*zeros, none, -w, none], [*zeros, w, none, none], [none] * len(rows[0])]


def rational(rows: Sequence[Sequence[Polynomial]], mode: str) -> list[list[Fraction]]:
    """Return a matrix of numbers; one with pi rejects."""
    plain = all(not q.variables for row in rows for q in row)
    need(plain, f"the mode {mode} has pi where its flights need a rational number")
    return [[q.number for q in row] for row in rows]


def solved(rows: list[Vector]) -> Vector | None:
    """Return the solution of a system of equations (A, b), or None if a pivot may be zero."""
    n = len(rows)
    for k in range(n):
        best = max(range(k, n), key=lambda i: rows[i][k].magnitude().lo)
        rows[k], rows[best] = rows[best], rows[k]
        if rows[k][k].contains_zero():
            return None
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [row[-1] for row in rows]


def _times(A: Sequence[Sequence[Fraction]], v: Vector, zero: Interval) -> Vector:
    """Return A v."""
    return [sum((x * a for a, x in zip(row, v, strict=True) if a), zero) for row in A]


def dot(row: Sequence[Interval], column: Sequence[Interval]) -> Interval:
    """Return the sum of products, rounded once."""
    least = most = 0
    for x, y in zip(row, column, strict=True):
        a, b, c, d = x.lo, x.hi, y.lo, y.hi
        if a >= 0:
            least += (a if c >= 0 else b) * c
            most += (b if d >= 0 else a) * d
        elif b <= 0:
            least += (a if d >= 0 else b) * d
            most += (b if c >= 0 else a) * c
        else:
            least += min(a * d, b * c)
            most += max(a * c, b * d)
    bits = row[0].bits
    return Interval(least >> bits, -(-most >> bits), bits)


@lru_cache(maxsize=256)
def flights(model: Model, mode: str, bits: int) -> Flights:
    """Return the flights of a mode at a precision; they are kept."""
    return Flights(model, mode, bits)


class Flights:
    """The flights of a mode at a precision: N or M, and U and V."""

    def __init__(self, model: Model, mode: str, bits: int) -> None:
        self.model, n = model, len(model.state)
        self.pi = pi(bits)
        self.values = Values({PI: self.pi}, self.pi.integer(1))
        self.omega = self.values.of(model.frequency)
        M = matrix(model, mode)
        self.response = self._response([[row[j] for j in range(n + 2)] for row in M[:n]], mode)
        if self.response is not None:
            M = [[M[i][j] for j in (*range(n), n + 2)] for i in (*range(n), n + 2)]
        self.exponential = Exponential(rational(M, mode), bits)
        self._along = dict[Polynomial, Along]()

    def _response(self, rows: list[list[Polynomial]], mode: str) -> Pairs | None:
        """Return U and V of each variable, or None if they are not found; none if they are zero."""
        n, w, zero = len(rows), self.omega, self.pi.integer(0)
        c, s = ([self.values.of(row[n + k]) for row in rows] for k in range(2))
        if not any(row[n + k].terms for row in rows for k in range(2)):
            return []
        A = rational([row[:n] for row in rows], mode)
        forced = [w * x - y for x, y in zip(c, _times(A, s, zero), strict=True)]
        equations = list[Vector]()
        for i, row in enumerate(A):
            square = [sum((a * A[k][j] for k, a in enumerate(row)), Fraction(0)) for j in range(n)]
            line = [Interval.enclosing(q, q, zero.bits) for q in square]
            line[i] = line[i] + w.square()
            equations.append([*line, forced[i]])
        V = solved(equations)
        if V is None:
            return None
        U = [-(a + x) / w for a, x in zip(_times(A, V, zero), s, strict=True)]
        return list(zip(U, V, strict=True))

    def clock(self, t: Interval) -> tuple[Interval, Interval]:
        """Return cos wt and sin wt."""
        return cos_sin(t * self.omega)

    def begin(
        self, z: Sequence[W], clock: tuple[W, W], constant: Callable[[Interval], W]
    ) -> list[W]:
        """Return y of a state, where its flight is P + exp(N d) y, or exp(M d) y."""
        one = constant(self.pi.integer(1))
        if self.response is None:
            return [*z, *clock, one]
        return [*(x - p for x, p in zip(z, self.particular(*clock, constant), strict=True)), one]

    def particular(self, cos: W, sin: W, constant: Callable[[Interval], W]) -> list[W]:
        """Return P at a time."""
        if not self.response:
            return [constant(self.pi.integer(0))] * len(self.model.state)
        return [cos * constant(U) + sin * constant(V) for U, V in self.response]

    def motion(self, d: Interval, rows: Sequence[int], order: int = 0) -> list[Interval]:
        """Return what flights depend on but for their start: d, or rows of the derivatives of X."""
        if self.exponential.is_polynomial:
            return [d]
        found = [self.exponential.over(i, d, order) for i in rows]
        return [x for k in range(order + 1) for row in found for x in row[k]]

    def inputs(self, tape: Tape, rows: Sequence[int], order: int = 0) -> Iterator[list[list[Term]]]:
        """Give, for k = 0, ..., order, the rows of the k-th derivative of X, of these inputs."""
        if not self.exponential.is_polynomial:
            for _ in range(order + 1):
                yield [tape.inputs(len(self.exponential.columns)) for _ in rows]
            return
        (d,) = tape.inputs(1)
        for k in range(order + 1):
            columns = [self.exponential.polynomials(i, k) for i in rows]
            yield [[_horner([*map(tape.constant, c)], d) for c in row] for row in columns]

    def along(self, g: Polynomial) -> Along:
        """Return a polynomial along flights."""
        if g not in self._along:
            self._along[g] = self._written(g)
        return self._along[g]

    def _written(self, g: Polynomial) -> Along:
        tape, state = Tape(self.pi.bits), self.model.state
        used = [i for i, z in enumerate(state) if z in g.variables]
        y, clock = tape.inputs(len(self.exponential.columns)), tape.inputs(2)
        (rows,) = self.inputs(tape, used)
        P = self.particular(clock[0], clock[1], tape.constant)
        moved = {state[i]: total(y, row) + P[i] for i, row in zip(used, rows, strict=True)}
        known = {**moved, **dict(zip(CLOCK, clock, strict=True)), PI: tape.constant(self.pi)}
        return Along(used, Program(tape.given, [Values(known, y[0].integer(1)).of(g)]))


def _horner(coefficients: Sequence[Term], d: Term) -> Term:
    """Return a polynomial; its coefficients begin with that of the highest power."""
    return reduce(lambda total, c: total * d + c, coefficients)


def total(y: Sequence[W], row: Sequence[W]) -> W:
    """Return the sum of products."""
    return reduce(add, (a * b for a, b in zip(y, row, strict=True)))


class Along(NamedTuple):
    """A polynomial along flights: of y, the clock, and d or these rows of X."""

    rows: list[int]
    program: Program


class Leg:
    """The flights in a mode from a box of states, each from a time in an interval on."""

    def __init__(
        self, model: Model, mode: str, start: Interval, state: Mapping[str, Interval]
    ) -> None:
        self.model, self.mode, self.start, self.given = model, mode, start, state
        self.flights = flights(model, mode, start.bits)
        z = [state[name] for name in model.state]
        self.begin = self.flights.begin(z, self.flights.clock(start), lambda x: x)
        self._clocks = dict[tuple[int, int], tuple[Interval, Interval]]()
        self._seen = dict[tuple[Polynomial, int, int], Interval]()

    def state(self, t: Interval) -> dict[str, Interval]:
        """Return the state at all times of an interval, for all of the flights."""
        return {z: self.over(variable(z), t) for z in self.model.state}

    def over(self, g: Polynomial, t: Interval) -> Interval:
        """Return a polynomial in the state at all times of an interval, for all of the flights."""
        place = g, t.lo, t.hi
        if place not in self._seen:
            along = self.flights.along(g)
            if place[1:] not in self._clocks:
                self._clocks[t.lo, t.hi] = self.flights.clock(t)
            motion = self.flights.motion(t - self.start, along.rows)
            inputs = [*self.begin, *self._clocks[t.lo, t.hi], *motion]
            (self._seen[place],) = along.program.run(inputs)
        return self._seen[place]

    def begun(self, g: Polynomial) -> Interval:
        """Return a polynomial in the state, for each of the flights where it begins."""
        known = dict(zip(CLOCK, self.flights.clock(self.start), strict=True))
        return Values({**known, **self.given, PI: self.flights.pi}, self.start.integer(1)).of(g)
