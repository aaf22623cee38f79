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

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction

from cap.checker.kernel.elementary import cos_sin, pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.evaluation import Values
from cap.checker.system.exponential import Exponential
from cap.checker.system.model import CLOCK, PI, Model
from cap.checker.system.polynomial import Polynomial

Vector = list[Interval]
Pairs = list[tuple[Interval, Interval]]


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
    return [sum((x.scaled(a) for a, x in zip(row, v, strict=True) if a), zero) for row in A]


def dot(row: Sequence[Interval], column: Sequence[Interval]) -> Interval:
    """Return the sum of products."""
    pairs = zip(row, column, strict=True)
    return sum((a * b for a, b in pairs if a.lo or a.hi), row[0].integer(0))


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

    def particular(self, i: int, cos: Interval, sin: Interval) -> Interval:
        """Return the response of a variable at a time."""
        if not self.response:
            return self.pi.integer(0)
        U, V = self.response[i]
        return U * cos + V * sin

    def clock(self, t: Interval) -> tuple[Interval, Interval]:
        """Return cos wt and sin wt."""
        return cos_sin(t * self.omega)


class Leg:
    """The flights in a mode from a box of states, each from a time in an interval on.

    They may be ``known``, with what other legs of the mode have computed of them.
    """

    def __init__(
        self,
        model: Model,
        mode: str,
        start: Interval,
        state: Mapping[str, Interval],
        known: Flights | None = None,
    ) -> None:
        self.model, self.mode, self.start, self.given = model, mode, start, state
        self.flights = known or Flights(model, mode, start.bits)
        cos, sin = self.flights.clock(start)
        if self.flights.response is None:
            self.begin = [*(state[z] for z in model.state), cos, sin, start.integer(1)]
        else:
            shifts = (self.flights.particular(i, cos, sin) for i in range(len(model.state)))
            rests = [state[z] - x for z, x in zip(model.state, shifts, strict=True)]
            self.begin = [*rests, start.integer(1)]
        self._seen = dict[tuple[int, int], dict[str, Interval]]()

    def state(self, t: Interval) -> dict[str, Interval]:
        """Return the state at all times of an interval, for all of the flights."""
        found = self._values(t, self.model.state)
        return {z: found[z] for z in self.model.state}

    def over(self, g: Polynomial, t: Interval) -> Interval:
        """Return a polynomial in the state at all times of an interval, for all of the flights."""
        values = self._values(t, g.variables)
        return Values({**values, PI: self.flights.pi}, t.integer(1)).of(g)

    def begun(self, g: Polynomial) -> Interval:
        """Return a polynomial in the state, for each of the flights where it begins."""
        known = dict(zip(CLOCK, self.flights.clock(self.start), strict=True))
        return Values({**known, **self.given, PI: self.flights.pi}, self.start.integer(1)).of(g)

    def _values(self, t: Interval, names: Collection[str]) -> dict[str, Interval]:
        """Return the clock, and some variables of the state; others may be there, too."""
        if (t.lo, t.hi) not in self._seen:
            self._seen[t.lo, t.hi] = dict(zip(CLOCK, self.flights.clock(t), strict=True))
        found = self._seen[t.lo, t.hi]
        cos, sin = (found[z] for z in CLOCK)
        for i, z in enumerate(self.model.state):
            if z in names and z not in found:
                (row,) = self.flights.exponential.over(i, t - self.start)
                found[z] = dot(row, self.begin) + self.flights.particular(i, cos, sin)
        return found
