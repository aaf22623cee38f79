"""How a variable of the state moves on the flights of a mode: closed forms, by exact algebra.

Let the field of the mode be A z + b + c cos wt + s sin wt, where A, b, c, s are constant on the
flights: numbers and parameters.

*The response* U cos wt + V sin wt is a solution of z' = A z + c cos wt + s sin wt if w V = A U + c
and -w U = A V + s, that is

    (w^2 + A^2) V = w c - A s,      U = -(A V + s)/w.

*The rest* y = z - response has y' = A y + b.  Let g_0 be one of its components and g_(j+1) the
derivative of g_j along this field.  If g_(k+1) = lambda g_k with a constant lambda, then g_k grows
like e^(lambda t), and by Taylor's formula with its remainder as an integral, with d = t - t_0,

    g_0(t) = g_0 + g_1 d + ... + g_(k-1) d^(k-1)/(k-1)! + g_k d^k phi_k(lambda d),

g_j on the right at t_0, phi_k as in ``exponential``; phi_k(0) = 1/k!.  There is no division by
lambda, so it may be a parameter that is known in an interval around 0.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.model import CLOCK, COS, SIN, Model
from cap.checker.system.polynomial import ZERO, Polynomial


class Course(NamedTuple):
    """One component of the rest: g_0, ..., g_k and lambda."""

    terms: tuple[Polynomial, ...]
    rate: Polynomial


class Forcing(NamedTuple):
    """The linear equations (w^2 + A^2) V = w c - A s of the response, with A and s."""

    A: list[list[Polynomial]]
    s: list[Polynomial]
    left: list[list[Polynomial]]
    right: list[Polynomial]

    @property
    def is_exact(self) -> bool:
        """Whether no parameter occurs."""
        entries = [*self.s, *self.right, *(q for row in (*self.A, *self.left) for q in row)]
        return not any(q.variables for q in entries)

    def response(
        self, omega: Fraction, element: Callable[[Polynomial], Any], inverse: Callable[[Any], Any]
    ) -> tuple[list[Any], list[Any]]:
        """Return U and V, computed with what ``element`` makes of polynomials in parameters."""
        rows = zip(self.left, self.right, strict=True)
        V = solved([[element(q) for q in (*row, last)] for row, last in rows], inverse)
        U = [element(s) for s in self.s]
        for i, row in enumerate(self.A):
            for a, v in zip(row, V, strict=True):
                U[i] = U[i] + element(a) * v
        return [u * element(Polynomial.of(-1 / omega)) for u in U], V


def solved(rows: list[list[Any]], inverse: Callable[[Any], Any]) -> list[Any]:
    """Solve linear equations, rows of coefficients and right side, by elimination."""
    for i in range(len(rows)):
        factor = inverse(rows[i][i])
        rows[i] = [x * factor for x in rows[i]]
        for k, row in enumerate(rows):
            if k != i:
                rows[k] = [x - row[i] * y for x, y in zip(row, rows[i], strict=True)]
    return [row[-1] for row in rows]


def reciprocal_number(q: Polynomial) -> Polynomial:
    """Return 1/q of a number that is not zero."""
    need(set(q.terms) == {()}, "a response is not determined")
    return Polynomial({(): 1 / q.number})


def course(model: Model, mode: str, variable: Polynomial) -> Course:
    """Return the course of one variable of the state in a mode."""
    field = {z: q.without(CLOCK) for z, q in model.modes[mode].field.items()}
    terms = [variable]
    while len(terms) <= len(model.state) + 1:
        last = terms[-1]
        rate = sum((last.derivative(z) * q for z, q in field.items()), ZERO)
        for factor in (ZERO, *(q.derivative(z) for z, q in field.items())):
            if rate == last * factor and model.is_constant(factor):
                return Course(tuple(terms), factor)
        terms.append(rate)
    raise Rejected(f"the flights in the mode {mode} are not of a known form")


def forcing(model: Model, mode: str) -> Forcing:
    """Return the equations of the response in a mode; a field that is not linear rejects."""
    field = [model.modes[mode].field[z] for z in model.state]
    A = [[q.derivative(z) for z in model.state] for q in field]
    c, s = ([q.derivative(z) for q in field] for z in (COS, SIN))
    constants = [*c, *s, *(a for row in A for a in row)]
    need(all(map(model.is_constant, constants)), f"the field of the mode {mode} is not linear")
    w = model.omega
    left = [[_dot(row, column) for column in zip(*A, strict=True)] for row in A]
    for i, row in enumerate(left):
        row[i] += w**2
    right = [q * w - _dot(row, s) for q, row in zip(c, A, strict=True)]
    return Forcing(A, s, left, right)


def _dot(row: Sequence[Polynomial], column: Sequence[Polynomial]) -> Polynomial:
    """Return the sum of the products."""
    return sum((a * b for a, b in zip(row, column, strict=True)), ZERO)
