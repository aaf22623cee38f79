"""From just before a contact to just before the next one: the guard, the reset, the flight.

In t, q = (q_1, ..., q_n) and the time t' of the next contact, which have the indices 0, 1, ..., n,
n + 1, the guard is h(q, t), the state after the contact R(q, t), and that on arrival

    P(t') + exp(N d) y,      d = t' - t,  y = (R - P, 1)(t)        (``legs``),

whose derivative in d is exp(N d) N y.  If a symmetry S (``symmetry``) moves the flight back, S R
stands for R in it, and cos wt and sin wt have the other signs at its begin.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.slope import Slope
from cap.checker.system.evaluation import Values
from cap.checker.system.legs import flights, total
from cap.checker.system.model import CLOCK, PI, Guard, Model
from cap.checker.system.polynomial import ONE
from cap.checker.system.program import Program, Tape, Term

Clock = tuple[Interval, Interval]
Jet = Slope[Interval]
Written = Slope[Term]


class Contact(NamedTuple):
    """A guard of a mode comes to zero, and the system goes on in the mode ``to``."""

    mode: str
    guard: str
    to: str


class Step(NamedTuple):
    """From one contact to the next: h and the state on arrival, in (t, q, the next t).

    And the state just after the contact.
    """

    guard: Jet
    after: list[Interval]
    arrival: list[Jet]


@lru_cache(maxsize=512)
def passage(
    model: Model, contact: Contact, bits: int, signs: tuple[int, ...] | None = None
) -> Passage:
    """Return the passage after a contact at a precision; it is kept.

    With the ``signs`` of a symmetry its flight is moved back, into the mode that the contact has.
    """
    return Passage(model, contact, bits, signs)


class Passage:
    """The formulas above, written once, for intervals."""

    def __init__(
        self, model: Model, contact: Contact, bits: int, signs: tuple[int, ...] | None = None
    ) -> None:
        self.model, self.n = model, len(model.state)
        self.event = model.modes[contact.mode].guards[contact.guard]
        self.flights = flights(model, contact.to, bits)
        tape, n = Tape(bits), self.n
        start, q, end = tape.inputs(2), tape.inputs(n), tape.inputs(2)
        self._pi, one = tape.constant(self.flights.pi), start[0].integer(1)
        state = [Slope(x, {i: one}) for i, x in enumerate(q, start=1)]
        begin, last = self._clock(start, 0), self._clock(end, n + 1)
        guard, after = self._contact(self.event, [*begin, *state])
        if signs:
            after = [-x if s < 0 else x for x, s in zip(after, signs, strict=True)]
            begin = [-x for x in begin]
        motion = list(self.flights.inputs(tape, range(n), 1))
        arrival = self._arrival(motion, after, begin, last)
        without = len(tape.given) - len(motion[1]) * len(motion[1][0])
        if self.flights.exponential.is_polynomial:
            without = len(tape.given)
        values = [guard.value, *(x.value for x in after), *(x.value for x in arrival)]
        slopes = [y for x in (guard, *arrival) for y in x.by.values()]
        self._by = [list(x.by) for x in (guard, *arrival)]
        self._values = Program(tape.given[:without], values)
        self._slopes = Program(tape.given, [*values, *slopes])

    def _clock(self, clock: Sequence[Term], index: int) -> list[Written]:
        """Return cos wt and sin wt with their derivatives by t."""
        cos, sin = clock
        omega = cos.tape.constant(self.flights.omega)
        return [Slope(cos, {index: -(sin * omega)}), Slope(sin, {index: cos * omega})]

    def _contact(self, guard: Guard, before: Sequence[Written]) -> tuple[Written, list[Written]]:
        """Return the guard, and the state just after the contact; ``before``: clock, state."""
        known = dict(zip((*CLOCK, *self.model.state), before, strict=True))
        known[PI] = Slope(self._pi, {})
        values = Values(known, Slope(self._pi.integer(1), {}))
        state, divisor = dict(known), values.of(guard.divisor)
        for z, q in guard.reset.items():
            state[z] = values.of(q) if guard.divisor == ONE else values.of(q) / divisor
        return values.of(guard.value), [state[z] for z in self.model.state]

    def _arrival(
        self,
        motion: Sequence[Sequence[Sequence[Term]]],
        after: Sequence[Written],
        begin: Sequence[Written],
        end: Sequence[Written],
    ) -> list[Written]:
        """Return the state on arrival, from rows of exp(N d) and exp(N d) N."""

        def constant(x: Interval) -> Written:
            return Slope(self._pi.tape.constant(x), {})

        y = self.flights.begin(after, (begin[0], begin[1]), constant)
        P, found = self.flights.particular(end[0], end[1], constant), list[Written]()
        for row, rate, p in zip(*motion, P, strict=True):
            speed = total([x.value for x in y], rate)
            moved = total(y, [Slope(x, {}) for x in row])
            found.append(moved + Slope(speed.integer(0), {0: -speed, self.n + 1: speed}) + p)
        return found

    def step(self, start: Clock, q: Sequence[Interval], end: Clock, d: Interval) -> Step:
        """Return the step with its derivatives, over a box of clocks, states, and durations."""
        found = iter(self._slopes.run([*start, *q, *end, *self.flights.motion(d, self._rows, 1)]))
        guard, *others = (next(found) for _ in range(2 * self.n + 1))
        slopes = [Slope(x, {}) for x in (guard, *others[self.n :])]
        slopes = [
            Slope(x.value, {i: next(found) for i in by})
            for x, by in zip(slopes, self._by, strict=True)
        ]
        return Step(slopes[0], others[: self.n], slopes[1:])

    def values(
        self, start: Clock, q: Sequence[Interval], end: Clock, d: Interval
    ) -> list[Interval]:
        """Return the guard, and the state on arrival."""
        found = self._values.run([*start, *q, *end, *self.flights.motion(d, self._rows)])
        return [found[0], *found[self.n + 1 :]]

    @property
    def _rows(self) -> range:
        return range(self.n)
