"""The equations of a periodic orbit by fewer unknowns: n for each contact, n that of the state.

*A guard of the state alone*, of degree 1, gives one variable before its contact by the others.  The
unknowns are the time and these; the equation h = 0 holds.

*A guard of the clock alone* leaves the state free, but for a variable that is a number until its
contact, and moves then.  That is no unknown, and on arrival it is this number: instead of the
equation that says so, there is h = 0, divided by a number near L h.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import BadInput
from cap.maps.zero import Problem
from cap.orbits.equations import Block, Equations
from cap.orbits.numbers import Balls, Floats
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.polynomial import Polynomial

Rows = list[list[Ball]]


class Solved(NamedTuple):
    """The variable of this number is ``constant`` + sum of weights times others, at a contact.

    With a ``rate``, near L h, the guard depends on the clock alone.
    """

    number: int
    constant: Fraction
    weights: dict[int, Fraction]
    rate: Fraction | None = None


class Free:
    """F and F' by the free unknowns; ``guess`` has the time and the state before each contact."""

    def __init__(self, equations: Equations, guess: Sequence[float]) -> None:
        itinerary, n = equations.itinerary, equations.n
        self.equations, self.n = equations, n
        places = range(0, len(guess), n + 1)
        events = [guess[k : k + n + 1] for k in places]
        self.solved = [_solved(equations, k, event) for k, event in enumerate(events)]
        self.names = [
            [z for i, z in enumerate(itinerary.system.state) if i != each.number]
            for each in self.solved
        ]

    def of(self, z: Sequence[Any]) -> list[Any]:
        """Return the free ones of times and states before contacts."""
        step = self.n + 1
        return [
            q
            for k, each in enumerate(self.solved)
            for i, q in enumerate(z[step * k : step * (k + 1)])
            if i != each.number + 1
        ]

    def whole(self, u: Sequence[Ball]) -> list[Ball]:
        """Return enclosures of the times and states before contacts."""
        found, n = list[Ball](), self.n
        for k, (number, constant, weights, _) in enumerate(self.solved):
            t, *rest = u[n * k : n * (k + 1)]
            rest.insert(number, interval.ball(constant))
            for i, w in weights.items():
                rest[number] = rest[number] + interval.ball(w) * rest[i]
            found += [t, *rest]
        return found

    def moved(self, u: Sequence[Ball]) -> list[Ball]:
        """Return derivatives of all times and states before contacts, from those of the free."""
        still = self.whole([interval.ZERO] * len(u))
        return [q - c for q, c in zip(self.whole(u), still, strict=True)]

    def by_parameters(self, u: Sequence[Ball], of: Balls, rates: Mapping[str, Ball]) -> list[Ball]:
        """Return an enclosure of the derivative of F where parameters move with these rates."""
        names, found = self.equations.itinerary.system.parameters, list[Ball]()
        every = [
            [interval.total(q * rates[p] for p, q in zip(names, row, strict=True)) for row in rows]
            for rows in self.equations.by_parameters(self.whole(u), of)
        ]
        for k, (_, *misses) in enumerate(every):
            following = (k + 1) % len(every)
            number, _, _, rate = self.solved[following]
            if rate:
                misses[number] = every[following][0] / interval.ball(rate)
            found += misses
        return found

    def problem(self, of: Balls) -> Problem:
        """Return F and F' in balls."""
        return Problem(lambda u: self.value(u, of), lambda u: self.slope(u, of))

    def value(self, u: Sequence[Ball], of: Balls) -> list[Ball]:
        """Return an enclosure of F."""
        step, found = self.n + 1, list[Ball]()
        full = self.equations.value(self.whole(u), of)
        for k, (_, there, _) in enumerate(self.equations.places):
            number, _, _, rate = self.solved[(k + 1) % len(self.solved)]
            misses = full[step * k + 1 : step * (k + 1)]
            if rate:
                misses[number] = full[there] / interval.ball(rate)
            found += misses
        return found

    def slope(self, u: Sequence[Ball], of: Balls) -> Rows:
        """Return an enclosure of F', by rows."""
        blocks, n = self.equations.blocks(self.whole(u), of), self.n
        result = Rows()
        for k, block in enumerate(blocks):
            following = (k + 1) % len(blocks)
            for left, right in self._rows(k, block, following, blocks[following]):
                row = [interval.ZERO] * len(u)
                row[n * k : n * (k + 1)] = left
                for j, q in enumerate(right, start=n * following):
                    row[j] = row[j] + q
                result.append(row)
        return result

    def _rows(self, k: int, block: Block, following: int, after: Block) -> list[tuple[Any, Any]]:
        """Return the derivatives of the equations of a leg by the unknowns at both its ends."""
        number, _, _, rate = self.solved[following]
        found = []
        for i, entries in enumerate(block.rows):
            end = [entries[-1], *(interval.ball(-(j == i)) for j in range(self.n))]
            found.append((self._by_free(k, entries[:-1]), self._by_free(following, end)))
        if rate:
            slopes = [q / interval.ball(rate) for q in after.guard]
            found[number] = [interval.ZERO] * self.n, self._by_free(following, slopes)
        return found

    def _by_free(self, k: int, slopes: Sequence[Ball]) -> list[Ball]:
        """Return derivatives by the free unknowns, from those by the time and all variables."""
        number, _, weights, _ = self.solved[k]
        t, *rest = slopes
        for i, w in weights.items():
            rest[i] = rest[i] + interval.ball(w) * rest[number]
        return [t, *rest[:number], *rest[number + 1 :]]


def _solved(equations: Equations, k: int, event: Sequence[float]) -> Solved:
    """Return what a contact says of the state before it."""
    itinerary = equations.itinerary
    contact, state = itinerary.contacts[k], itinerary.system.state
    h = itinerary.system.guard(contact.mode, contact.guard).value
    used = [i for i, z in enumerate(state) if z in h.variables]
    slopes = {i: h.derivative(state[i]) for i in used}
    if used and h.degree == 1 and h.variables <= {*state}:
        number = used[-1]
        rest = {i: _number(-slopes[i] / slopes[number]) for i in used[:-1]}
        return Solved(number, _number(-h.without(*state) / slopes[number]), rest)
    known, field = itinerary.known[k], itinerary.system.modes[contact.to].field
    moved = [z for z in known if field[z].substituted(known)]
    if used or not moved:
        raise BadInput(f"contact {k + 1}: its guard is neither of the state nor of the clock alone")
    z, value = moved[0], known[moved[0]]
    t, *q = event
    of = Floats(itinerary.system)
    (rate,) = of.of(equations.kinds.watch(contact.mode, contact.guard).rate)(*of.clock(t), *q)
    return Solved(state.index(z), _number(value), {}, Fraction(rate))


def _number(q: Polynomial) -> Fraction:
    """Return a rational; refuse powers of pi."""
    if not {*q.terms} <= {()}:
        raise BadInput(f"{q!r} is no rational number")
    return q.terms.get((), Fraction(0))
