"""A line of periodic orbits, exactly: contacts at quarters of a period of the clock.

The k-th contact is at the time j_k T/4, T = 2 pi/w, where cos wt and sin wt are 0, 1 or -1; the
state just before it is q_k(c), of which each variable is linear in a number c, with rational
coefficients.  Everything here is an identity of polynomials in c.

*Flights.*  With the clock in the state, y = (z, cos wt, sin wt, 1), those of a mode are y' = M y.
Let nu_1, nu_2, ... be different positive rational numbers, and

    M (M^2 + nu_1^2) (M^2 + nu_2^2) ... = 0.

Then every solution is a sum of constants and of cos nu_i t, sin nu_i t, and by interpolation

    exp(M d) = P_0 + sum of (cos(nu_i d) P_i + sin(nu_i d)/nu_i M P_i),
    P_0 = prod over j of (M^2 + nu_j^2)/nu_j^2,
    P_i = -M^2/nu_i^2 prod over j /= i of (M^2 + nu_j^2)/(nu_j^2 - nu_i^2):

P_0 is 1 where M = 0 and 0 where M^2 = -nu_i^2, and P_i the other way round.  For d = m T/4 the
angle nu_i d is m nu_i/w quarters of a turn, w rational.  If this is a whole number, exp(M d) is a
matrix of rational numbers.

*Orbits.*  If each guard of a contact vanishes at it, and each flight leads from after the reset to
the state before the next contact, F = 0 (``contacts``) for all c.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from cap.checker.kernel.rejection import need
from cap.checker.system.contacts import Round
from cap.checker.system.legs import matrix, rational
from cap.checker.system.model import COS, SIN, Model
from cap.checker.system.polynomial import ONE, ZERO, Polynomial, variable

Rows = list[list[Fraction]]
C = variable("c")
TURN = (1, 0, -1, 0)  # cos of quarters of a turn


class Linear(NamedTuple):
    """The number a + b c."""

    a: Fraction
    b: Fraction

    @property
    def polynomial(self) -> Polynomial:
        """It as a polynomial in c."""
        return Polynomial.of(self.a) + C * self.b


State = Sequence[Linear]


def confirm(
    orbit: Round, quarters: Sequence[int], states: Sequence[State], frequencies: Sequence[Fraction]
) -> None:
    """Prove that the contacts at these times and states are zeros of F, for all c."""
    model, count = orbit.model, len(orbit.contacts)
    need(not model.times_pi and not model.autonomous, "the clock has no rational frequency")
    ends = [*quarters, quarters[0] + 4 * orbit.periods]
    need(all(a < b for a, b in pairwise(ends)), "the contacts are not in order")
    apart = len({*frequencies}) == len(frequencies) and all(nu > 0 for nu in frequencies)
    need(apart, "the frequencies are not positive and different")
    need(any(z.b for q in states for z in q), "nothing depends on c")
    for k, contact in enumerate(orbit.contacts):
        here, guard = _named(model, states[k], quarters[k]), orbit.guard(k)
        need(guard.divisor == ONE, f"contact {k + 1}: a reset has a divisor")
        known = all(q.variables <= here.keys() for q in (guard.value, *guard.reset.values()))
        need(known, f"contact {k + 1}: more than the state and the clock occurs")
        vanishes = guard.value.substituted(here) == ZERO
        need(vanishes, f"contact {k + 1}: its guard does not vanish")
        after = {**here, **{z: q.substituted(here) for z, q in guard.reset.items()}}
        exponential = exact(model, contact.to, ends[k + 1] - quarters[k], frequencies)
        y = [*(after[z] for z in model.state), here[COS], here[SIN], ONE]
        arrival = [sum((x * m for m, x in zip(row, y, strict=True)), ZERO) for row in exponential]
        there = [z.polynomial for z in states[(k + 1) % count]]
        need(arrival[: len(there)] == there, f"leg {k + 1} does not lead to the next contact")


def exact(model: Model, mode: str, quarters: int, frequencies: Sequence[Fraction]) -> Rows:
    """Return exp(M d) of a mode, d so many quarters of a period; reject if it is not rational."""
    M = rational(matrix(model, mode), mode)
    one = [[Fraction(i == j) for j in range(len(M))] for i in range(len(M))]
    square, total = _product(M, M), one
    factors = [_sum(square, one, nu**2) for nu in frequencies]
    for factor in factors:
        total = _product(total, factor)
    nothing = all(not x for row in _product(M, total) for x in row)
    need(nothing, f"flights of the mode {mode} are no sums of these frequencies")
    found = [[x / _squares(frequencies) for x in row] for row in total]
    for i, nu in enumerate(frequencies):
        turns = quarters * nu / model.omega
        need(turns.denominator == 1, "a flight is not a whole number of quarters of a turn")
        P = [[-x / nu**2 for x in row] for row in square]
        for j, mu in enumerate(frequencies):
            if j != i:
                P = _product(P, [[x / (mu**2 - nu**2) for x in row] for row in factors[j]])
        cos, sin = TURN[turns.numerator % 4], TURN[(turns.numerator - 1) % 4]
        found = _sum(_sum(found, P, Fraction(cos)), _product(M, P), sin / nu)
    return found


def _named(model: Model, state: State, quarter: int) -> Mapping[str, Polynomial]:
    """Return the variables and the clock at a contact, as polynomials in c."""
    known = {z: q.polynomial for z, q in zip(model.state, state, strict=True)}
    cos, sin = TURN[quarter % 4], TURN[(quarter - 1) % 4]
    return {**known, COS: Polynomial.of(cos), SIN: Polynomial.of(sin)}


def _squares(frequencies: Sequence[Fraction]) -> Fraction:
    """Return the product of the squares."""
    total = Fraction(1)
    for nu in frequencies:
        total *= nu**2
    return total


def _sum(A: Rows, B: Rows, factor: Fraction) -> Rows:
    """Return A + factor B."""
    return [[x + factor * y for x, y in zip(*rows, strict=True)] for rows in zip(A, B, strict=True)]


def _product(A: Rows, B: Rows) -> Rows:
    """Return A B."""
    columns = list(zip(*B, strict=True))
    return [[sum((x * y for x, y in zip(row, column, strict=True)), Fraction(0))
             for column in columns] for row in A]  # fmt: skip
