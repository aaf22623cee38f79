"""The map over a round, from a time s between two contacts, as jets over balls.

*Contacts.*  Newton's iteration on jets: if the time t of a contact is right to degree k, the terms
of degree k + 1 of h(z(t), t), over L h, are those that t lacks.  Times and states at the contacts
of the orbit are known, so they are the constant terms.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import factorial
from typing import Any

from cap.errors import NotProved
from cap.orbits.equations import Equations
from cap.orbits.itinerary import Contact
from cap.orbits.leg import END, START
from cap.orbits.motion import Motion, named, scalars
from cap.orbits.numbers import Balls
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.system.exponential import enclosed, exponential, number
from cap.system.model import System
from cap.system.source import Function
from cap.system.tape import Tape

Met = tuple[Ball, Sequence[Ball]]


class Strobe:
    """The map around a proved orbit, from the time s on; ``point`` encloses its state at s.

    ``contacts``: the times of these, and the states just before them, enclosed.
    """

    def __init__(
        self, equations: Equations, of: Balls, contacts: Sequence[Met], s: Fraction
    ) -> None:
        self.itinerary, self.kinds = equations.itinerary, equations.kinds
        self.of, self.contacts, self.s, itinerary = of, contacts, interval.ball(s), self.itinerary
        self.round, last = self.of.period * self.itinerary.periods, itinerary.contacts[-1]
        self._omega = number(itinerary.system.omega)
        self._functions = dict[object, Function]()
        t, q = contacts[-1]
        if not t - self.round < self.s < contacts[0][0]:
            raise NotProved("phase", "it is not between two contacts", {"s": self.s})
        _, _, *after = self._contact(last, t - self.round, q)
        self.point = self._flight(last.to, t - self.round, after, self.s)

    def jet(self, order: int) -> list[Jet]:
        """Return the jets of the map at its fixed point."""
        z: list[Any] = list(Jet.variables(self.point, order))
        t = Jet.constant(self.s, z[0].space)
        for contact, met in zip(self.itinerary.contacts, self.contacts, strict=True):
            t, z = self._met(contact, met, t, z)
            _, _, *z = self._contact(contact, t, z)
        end = Jet.constant(self.s + self.round, t.space)
        return self._flight(self.itinerary.contacts[-1].to, t, z, end)

    def _met(
        self, contact: Contact, at: Met, start: Jet, z: Sequence[Any]
    ) -> tuple[Jet, list[Any]]:
        """Return the time of a contact and the state just before it."""
        time, state = at
        t = Jet.constant(time, start.space)
        _, rate, *_ = self._contact(contact, time, state)
        if not rate < 0:
            raise NotProved("contact", "a guard may not be crossed: a graze", {"L h": rate})
        for degree in range(1, t.space.order + 1):
            h = self._contact(contact, t, self._flight(contact.mode, start, z, t))[0]
            lower = t.space.truncated(degree - 1).size
            terms = t.space.truncated(degree).size
            lacking = [0] * lower + [c / rate for c in h.coefficients[lower:terms]]
            t = t - Jet(t.space, lacking + [0] * (t.space.size - terms))
        arrived = self._flight(contact.mode, start, z, t)
        return t, [
            q.above(0) + known if isinstance(q, Jet) else known
            for q, known in zip(arrived, state, strict=True)
        ]

    def _contact(self, contact: Contact, t: Any, z: Sequence[Any]) -> tuple[Any, ...]:
        """Return h, L h, and the state just after a contact."""
        found: tuple[Any, ...] = self._function(contact)(*self._clock(t), *z)
        return found

    def _flight(self, mode: str, start: Any, z: Sequence[Any], end: Any) -> list[Any]:
        """Return the state at a time, on the flight from a state at another one."""
        motion = self.kinds.motion(mode)
        arguments = [start, *self._clock(start), *z, end, *self._clock(end)]
        if motion.generator:
            arguments += self._exponential(motion, end - start)
        return list(self._function(mode)(*arguments))

    def _clock(self, t: Any) -> tuple[Any, Any]:
        s, c = (t * self._omega).sin_cos()
        return c, s

    def _exponential(self, motion: Motion, d: Any) -> list[Any]:
        """Return the entries of exp(N d) in the rows of the state."""
        if not isinstance(d, Jet):
            return list(self.of.exponential(motion, d))
        N = enclosed(motion.generator)
        towers = [exponential(N, d.coefficients[0])]
        for _ in range(d.space.order):
            towers.append(towers[-1] * N)
        entries = zip(*(X.entries()[: len(motion.inputs)] for X in towers), strict=True)
        return [d.series([x / factorial(k) for k, x in enumerate(each)]) for each in entries]

    def _function(self, key: Contact | str) -> Any:
        """Return what a contact, or the flights of a mode, are as a function."""
        if key not in self._functions:
            system = self.itinerary.system
            found = contact(system, key) if isinstance(key, Contact) else self._flights(key)
            self._functions[key] = found
        return self.of.of(self._functions[key])

    def _flights(self, mode: str) -> Function:
        """Return the function of the state on arrival, of times, clocks and the state before."""
        tape, motion, system = Tape(), self.kinds.motion(mode), self.itinerary.system
        q = [f"q{i}" for i in range(len(system.state))]
        t0, c0, s0 = map(tape.input, START)
        t1, c1, s1 = map(tape.input, END)
        reached = motion.arrival([tape.input(z) for z in q], (c0, s0), t1 - t0, (c1, s1))
        return Function(
            [*START, *q, *END, *motion.inputs],
            [reached[z] for z in system.state],
            system.parameters,
        )


def contact(system: System, key: Contact) -> Function:
    """Return the function of h, L h and the state after a contact, of clock and state."""
    tape, q = Tape(), [f"q{i}" for i in range(len(system.state))]
    before = named(system, [tape.input(z) for z in q], (tape.input("c0"), tape.input("s0")))
    of, h = scalars(tape), system.guard(key.mode, key.guard).value
    reset = system.reset(key.mode, key.guard)
    outputs = [of.value(p, before) for p in (h, system.lie(key.mode, h))]
    outputs += [of.value(reset[z], before) for z in system.state]
    return Function(["c0", "s0", *q], outputs, system.parameters)
