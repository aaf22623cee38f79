"""A line of periodic orbits, exactly: contacts at quarters of a period of the clock.

At these times cos wt and sin wt are 0, 1 or -1.  With y = (state, cos, sin, 1), y' = M y in a mode.
If M (M² + ν_1²) (M² + ν_2²) ... = 0 for different rational ν_i > 0, one of them w, exp(M d) is the
polynomial in M that is 1 at 0 and exp(± i ν d) at ± i ν; where all angles ν d are quarters of
turns it is rational.  Guards and resets of the contacts that are linear in the state make the state
at each contact a linear function of that at the first one.  That the guards vanish, and that the
round closes, is a linear system: its solutions, if they are a line, are the states a + b c.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cap.errors import NotProved
from cap.orbits.itinerary import Itinerary
from cap.system.exponential import number
from cap.system.model import System
from cap.system.polynomial import COS, SIN, Polynomial

TURN = (1, 0, -1, 0)  # cos of quarters of a turn
NEAR = 1e-6  # of a contact to a quarter of a period
DENOMINATOR = 1000  # of a frequency
STEP = "family"

Row = list[Fraction]


class Family(NamedTuple):
    """Contacts at so many quarters; the states before them are a + b c, c one of the first."""

    itinerary: Itinerary
    quarters: list[int]
    states: list[list[tuple[Fraction, Fraction]]]
    frequencies: list[Fraction]

    def at(self, c: Fraction) -> list[list[Fraction]]:
        """Return the states at c."""
        return [[a + b * c for a, b in q] for q in self.states]


def quarters(itinerary: Itinerary, times: Sequence[float]) -> list[int]:
    """Return the times of contacts in quarters of a period; raise `NotProved` if they are none."""
    omega = float(number(itinerary.system.omega))
    found = [t * omega / (np.pi / 2) for t in times]
    if any(abs(x - round(x)) > NEAR for x in found):
        raise NotProved(STEP, "contacts are not at quarters of a period", {"t": list(times)})
    return [round(x) for x in found]


def family(itinerary: Itinerary, times: Sequence[int]) -> Family:
    """Return the line of orbits with an itinerary and contacts at such times."""
    system, n = itinerary.system, len(itinerary.system.state)
    frequencies = _frequencies(itinerary)
    ends = [*times, times[0] + 4 * itinerary.periods]
    state = [[Fraction(i == j) for j in range(n + 1)] for i in range(n)]  # of (q_0, 1)
    first, states, rows = state, [state], list[Row]()
    for k, (mode, name, to) in enumerate(itinerary.contacts):
        clock = {COS: Fraction(TURN[times[k] % 4]), SIN: Fraction(TURN[(times[k] - 1) % 4])}
        at = dict(zip(system.state, state, strict=True))
        rows.append(_linear(system.guard(mode, name).value, at, clock))
        after = list[Row]()
        for q in system.reset(mode, name).values():
            if q.denominator != 1:
                raise NotProved(STEP, f"the reset of contact {k + 1} has a divisor")
            after.append(_linear(q.numerator, at, clock))
        y = [*after, *(_constant(x, n) for x in (clock[COS], clock[SIN], Fraction(1)))]
        flight = _exponential(system, to, ends[k + 1] - times[k], frequencies)
        state = [_combined(row, y) for row in flight[:n]]
        states.append(state)
    rows += [_difference(x, y) for x, y in zip(state, first, strict=True)]
    line = _line(rows, n)
    each = [[_on(row, line) for row in q] for q in states[:-1]]
    return Family(itinerary, list(times), each, frequencies)


def _on(row: Row, line: list[tuple[Fraction, Fraction]]) -> tuple[Fraction, Fraction]:
    """Return a linear function of the first state on the line of its solutions."""
    a = row[-1] + sum((x * p for x, (p, _) in zip(row, line, strict=False)), Fraction(0))
    return a, sum((x * q for x, (_, q) in zip(row, line, strict=False)), Fraction(0))


def _line(rows: list[Row], n: int) -> list[tuple[Fraction, Fraction]]:
    """Return the solutions of rows (x, 1) = 0, x = a + b c; c is the first that is not fixed."""
    rows, pivots = [list(row) for row in rows], list[int]()
    for j in reversed(range(n)):  # the free one is the first
        k = next((i for i in range(len(pivots), len(rows)) if rows[i][j]), None)
        if k is None:
            continue
        done = len(pivots)
        rows[done], rows[k] = rows[k], rows[done]
        rows[done] = [x / rows[done][j] for x in rows[done]]
        for i, row in enumerate(rows):
            if i != done and row[j]:
                rows[i] = [x - row[j] * y for x, y in zip(row, rows[done], strict=True)]
        pivots.append(j)
    if any(row[-1] for row in rows[len(pivots) :]):
        raise NotProved(STEP, "no orbit has contacts at these times")
    free = [j for j in range(n) if j not in pivots]
    if len(free) != 1:
        count = len(free) or "no"
        raise NotProved(STEP, f"orbits with contacts at these times have {count} free variables")
    line = [(Fraction(0), Fraction(1))] * n
    for row, j in zip(rows, pivots, strict=False):
        line[j] = -row[-1], -row[free[0]]
    return line


def _linear(q: Polynomial, at: Mapping[str, Row], clock: Mapping[str, Fraction]) -> Row:
    """Return a polynomial that is linear in the state, as a function of the first state."""
    known = q.substituted({z: Polynomial.of(x) for z, x in clock.items()})
    if known.degree > 1 or any(name == "pi" for m in known.terms for name, _ in m):
        raise NotProved(STEP, "a guard or a reset is not linear in the state")
    constant = known.terms.get((), Fraction(0))
    found = _constant(constant, len(at))
    for z, row in at.items():
        found = [x + known.terms.get(((z, 1),), Fraction(0)) * y for x, y in zip(found, row,
                 strict=True)]  # fmt: skip
    return found


def _constant(x: Fraction, n: int) -> Row:
    return [*([Fraction(0)] * n), x]


def _combined(row: Row, y: Sequence[Row]) -> Row:
    return [sum((x * z for x, z in zip(row, c, strict=True)), Fraction(0))
            for c in zip(*y, strict=True)]  # fmt: skip


def _difference(x: Row, y: Row) -> Row:
    return [a - b for a, b in zip(x, y, strict=True)]


# flights


def _matrix(system: System, mode: str) -> list[Row]:
    """Return M."""
    rows = system.matrix(mode)
    if any(not q.is_number or any(m for m in q.terms) for row in rows for q in row):
        raise NotProved(STEP, f"the flights of '{mode}' have pi in their equations")
    return [[q.terms.get((), Fraction(0)) for q in row] for row in rows]


def _frequencies(itinerary: Itinerary) -> list[Fraction]:
    """Return the frequencies of the flights, that of the clock among them; a guess."""
    system = itinerary.system
    if any(m for m in system.omega.terms):
        raise NotProved(STEP, "the clock has no rational frequency")
    omega = system.omega.terms[()]
    found = {omega}
    for contact in itinerary.contacts:
        for value in np.linalg.eigvals(np.array(_matrix(system, contact.to), float)):
            near = Fraction(abs(float(value.imag))).limit_denominator(DENOMINATOR)
            if near:
                found.add(near)
    return sorted(found)


def _exponential(
    system: System, mode: str, times: int, frequencies: Sequence[Fraction]
) -> list[Row]:
    """Return exp(M d), d so many quarters of a period of the clock."""
    M = _matrix(system, mode)
    one = [[Fraction(i == j) for j in range(len(M))] for i in range(len(M))]
    square = [_combined(row, M) for row in M]
    factors = [_plus(square, one, nu**2) for nu in frequencies]
    rest = M
    for factor in factors:
        rest = [_combined(row, factor) for row in rest]
    if any(x for row in rest for x in row):
        raise NotProved(STEP, f"the flights of '{mode}' are not sums of cos and sin of rational "
                        "frequencies")  # fmt: skip
    found, omega = one, system.omega.terms[()]
    for i, nu in enumerate(frequencies):
        turns = times * nu / omega
        if turns.denominator != 1:
            raise NotProved(STEP, "a flight is not a whole number of quarters of a turn")
        P = [[-x / nu**2 for x in row] for row in square]
        for j, mu in enumerate(frequencies):
            if j != i:
                other = [[x / (mu**2 - nu**2) for x in row] for row in factors[j]]
                P = [_combined(row, other) for row in P]
        cos, sin = TURN[turns.numerator % 4], TURN[(turns.numerator - 1) % 4]
        found = _plus(found, P, Fraction(cos - 1))  # P_0 = 1 - the sum of all P_i
        found = _plus(found, [_combined(row, P) for row in M], sin / nu)
    return found


def _plus(A: list[Row], B: list[Row], factor: Fraction) -> list[Row]:
    return [[x + factor * y for x, y in zip(*rows, strict=True)] for rows in zip(A, B, strict=True)]
