"""The flights of a mode in closed form, for any scalar; and in balls where there is none.

Let the field of the mode be A z + b + c cos wt + s sin wt.

*The response* U cos wt + V sin wt solves z' = A z + c cos wt + s sin wt if w V = A U + c and
-w U = A V + s, that is

    (w^2 + A^2) V = w c - A s,      U = -(A V + s)/w.

*The rest* y = z - response has y' = A y + b.  Let g_0 be one of its components and g_(j+1) the
derivative of g_j along this field.  If g_(k+1) = lambda g_k with a constant lambda, then by
Taylor's formula, with d = t - t_0 and all g_j taken at t_0,

    g_0(t) = g_0 + g_1 d + ... + g_(k-1) d^(k-1)/(k-1)! + g_k I_k,

where I_0 = exp(lambda d) and I_k is the integral of I_(k-1) from 0 to d.  As I_k = d^k/k! + lambda
I_(k+1), a monomial whose coefficients in g_k and g_(k-1) have the ratio lambda takes I_(k-1)
instead of both: fewer operations, and a narrower sum.  There is no division by lambda, which may
be a set around 0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import factorial
from typing import Any

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import COS, SIN, ZERO, Monomial, Polynomial, Quotient, variable

Vector = tuple[Quotient, ...]
Integral = Callable[[Any, Any, int], Any]


@dataclass(frozen=True)
class Course:
    """One component of the rest: the sum of powers[j] d^j and of integrals[k] I_k.

    The coefficients are polynomials in the rest at t_0 and parameters; ``rate`` is lambda.
    """

    powers: tuple[Polynomial, ...]
    integrals: Mapping[int, Polynomial]
    rate: Polynomial


@dataclass(frozen=True)
class Scalars:
    """What a type of numbers must offer: its constants, its pi, and I_k of (lambda, d, k)."""

    constant: Callable[[Fraction], Any]
    pi: Any
    integral: Integral

    def value(self, q: Polynomial | Quotient, values: Mapping[str, Any]) -> Any:
        """Return the value of a polynomial or a quotient."""
        if isinstance(q, Polynomial):
            return q.evaluated(values, self.constant, self.pi)
        top = self.value(q.numerator, values)
        return top if q.denominator == 1 else top / self.value(q.denominator, values)


@dataclass(frozen=True)
class Flights:
    """All flights of a mode, in closed form."""

    state: tuple[str, ...]
    cos: Vector
    sin: Vector
    courses: tuple[Course, ...]

    def response(self, clock: tuple[Any, Any], values: Mapping[str, Any], of: Scalars) -> list[Any]:
        """Return U cos wt + V sin wt; terms that are 0 are left out."""
        return [
            _sum(
                [of.value(q, values) * z for q, z in zip(pair, clock, strict=True) if q.numerator]
                or [of.constant(Fraction(0))]
            )
            for pair in zip(self.cos, self.sin, strict=True)
        ]

    def launch(
        self, z: Sequence[Any], clock: tuple[Any, Any], values: Mapping[str, Any], of: Scalars
    ) -> dict[str, Any]:
        """Return the rest at the start of a flight, at which (cos wt, sin wt) = ``clock``."""
        forced = self.response(clock, values, of)
        return {name: a - b for name, a, b in zip(self.state, z, forced, strict=True)}

    def state_at(
        self,
        rest: Mapping[str, Any],
        d: Any,
        clock: tuple[Any, Any],
        values: Mapping[str, Any],
        of: Scalars,
    ) -> list[Any]:
        """Return the state a time d after the start, at which the rest was ``rest``."""
        here = {**values, **rest}
        forced = self.response(clock, values, of)
        return [moved(c, d, here, of) + w for c, w in zip(self.courses, forced, strict=True)]


def moved(course: Course, d: Any, values: Mapping[str, Any], of: Scalars) -> Any:
    """Return one component of the rest after the time d, by Horner's rule."""
    total = None
    for q in reversed(course.powers):
        total = d * total if total is not None else None
        if q:
            term = of.value(q, values)
            total = term if total is None else term + total
    for k, q in course.integrals.items():
        term = of.value(q, values) * of.integral(of.value(course.rate, values), d, k)
        total = term if total is None else total + term
    return of.constant(Fraction(0)) if total is None else total


def flights(system: System, mode: str) -> Flights:
    """Return the closed form; raise `BadInput` in resonance, and where no lambda is found."""
    U, V = response(system, mode)
    return Flights(system.state, U, V, tuple(_course(system, mode, z) for z in system.state))


def response(system: System, mode: str) -> tuple[Vector, Vector]:
    """Return U and V; raise `BadInput` if the clock is in resonance with the mode."""
    field = [system.modes[mode].field[z] for z in system.state]
    A = [[q.derivative(z) for z in system.state] for q in field]
    c, s = ([q.derivative(z) for q in field] for z in (COS, SIN))
    w = system.omega
    left = [[_dot(row, column) for column in zip(*A, strict=True)] for row in A]
    for i, row in enumerate(left):
        row[i] += w**2
    right = [w * q - _dot(row, s) for q, row in zip(c, A, strict=True)]
    V = _solved(left, right)
    if V is None:
        raise BadInput(f"the clock is in resonance with the mode {mode}")
    forced = [
        _sum([Quotient.of(q), *(a * v for a, v in zip(row, V, strict=True))])
        for q, row in zip(s, A, strict=True)
    ]
    return tuple(-u / w for u in forced), tuple(V)


def _course(system: System, mode: str, z: str) -> Course:
    """Return the course of a variable."""
    field = {y: q.without(COS, SIN) for y, q in system.modes[mode].field.items()}
    terms = [variable(z)]
    while len(terms) <= len(system.state) + 1:
        last = terms[-1]
        rate = sum((last.derivative(y) * q for y, q in field.items()), ZERO)
        for factor in (ZERO, *(q.derivative(y) for y, q in field.items())):
            if rate == last * factor and system.is_constant(factor):
                return _shortened(system, terms, factor)
        terms.append(rate)
    raise BadInput(f"the flights of the mode {mode} have no closed form of the known kind")


def _shortened(system: System, terms: Sequence[Polynomial], rate: Polynomial) -> Course:
    """Return a course; each monomial in the state ends with the first integral that is possible."""
    rows = [_by_monomial(system, g) for g in terms]
    powers, integrals = [ZERO] * len(terms), dict[int, Polynomial]()
    for monomial in {m: None for row in rows for m in row}:
        column = [row.get(monomial, ZERO) for row in rows]
        while len(column) > 1 and column[-1] == rate * column[-2]:
            column.pop()
        k = len(column) - 1
        for j, q in enumerate(column):
            part = q * Polynomial({monomial: Fraction(1)})
            if j == k and rate:
                integrals[k] = integrals.get(k, ZERO) + part
            else:
                powers[j] += part / factorial(j)
    return Course(tuple(powers), {k: q for k, q in sorted(integrals.items()) if q}, rate)


def _by_monomial(system: System, q: Polynomial) -> dict[Monomial, Polynomial]:
    """Return the coefficients, polynomials in parameters, of the monomials in the state."""
    found = dict[Monomial, Polynomial]()
    for monomial, c in q.terms.items():
        state = tuple(pair for pair in monomial if pair[0] in system.state)
        others = tuple(pair for pair in monomial if pair[0] not in system.state)
        found[state] = found.get(state, ZERO) + Polynomial({others: c})
    return found


def _solved(left: list[list[Polynomial]], right: list[Polynomial]) -> list[Quotient] | None:
    """Return the solution of linear equations, by elimination; None if they determine none."""
    rows = [[Quotient.of(q) for q in (*row, b)] for row, b in zip(left, right, strict=True)]
    for i in range(len(rows)):
        pivot = next((k for k in range(i, len(rows)) if rows[k][i].numerator), None)
        if pivot is None:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [q / rows[i][i] if q.numerator else q for q in rows[i]]
        for k, row in enumerate(rows):
            if k != i and row[i].numerator:
                rows[k] = [a - row[i] * b for a, b in zip(row, rows[i], strict=True)]
    return [row[-1] for row in rows]


def _dot(row: Sequence[Polynomial], column: Sequence[Polynomial]) -> Polynomial:
    return sum((a * b for a, b in zip(row, column, strict=True)), ZERO)


def _sum(terms: Sequence[Any]) -> Any:
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total
