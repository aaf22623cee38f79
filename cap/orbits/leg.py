"""Functions of one leg of an orbit, written once for each kind of leg.

A leg begins just before a contact: at the time t0, in the state q, where the guard of the contact
comes to zero; the reset follows, and a flight in the mode in which the system goes on, to t1.
Functions take times, states and, with each time, the clock (cos wt, sin wt); then the entries of X
(`cap.orbits.motion`).
"""

from collections.abc import Sequence
from functools import cached_property

from cap.orbits.itinerary import Contact
from cap.orbits.motion import Clock, Motion, named, scalars
from cap.orbits.numbers import Balls, Floats
from cap.sets import interval
from cap.system.exponential import number
from cap.system.lemmas import Lemma, lemmas
from cap.system.model import System
from cap.system.polynomial import Polynomial
from cap.system.source import Function
from cap.system.tape import Gradient, Tape, Term, gradients

Signs = tuple[int, ...] | None
START, END = ("t0", "c0", "s0"), ("t1", "c1", "s1")


class Kinds:
    """The functions of a system, each written when it is first asked for."""

    def __init__(self, system: System) -> None:
        self.system = system
        self._legs = dict[tuple[Contact, Signs], Leg]()
        self._motions = dict[str, Motion]()
        self._watches = dict[tuple[str, str], Watch]()
        self._lemmas = dict[str, dict[str, Lemma]]()
        self._longest = dict[str, float]()
        self._states = dict[str, Function]()
        self._balls = dict[int, Balls]()

    @property
    def balls(self) -> Balls:
        """The numbers at the precision here, if no parameter is left."""
        bits = interval.working_bits()
        if bits not in self._balls:
            self._balls[bits] = Balls(self.system)
        return self._balls[bits]

    @cached_property
    def floats(self) -> Floats:
        """Doubles, if no parameter is left."""
        return Floats(self.system)

    @cached_property
    def autonomous(self) -> bool:
        """Whether the clock occurs nowhere in the system."""
        return self.system.autonomous

    def leg(self, contact: Contact, mode: str | None = None, signs: Signs = None) -> "Leg":
        """Return the functions of the legs that begin with such a contact.

        With ``signs`` a symmetry moves the flight back, into a ``mode``.
        """
        key = contact, signs
        if key not in self._legs:
            self._legs[key] = Leg(self.system, contact, self.motion(mode or contact.to), signs)
        return self._legs[key]

    def watch(self, mode: str, guard: str) -> "Watch":
        """Return the functions of a guard along the flights of a mode."""
        if (mode, guard) not in self._watches:
            self._watches[mode, guard] = Watch(self.system, mode, guard, self.motion(mode))
        return self._watches[mode, guard]

    def state(self, mode: str) -> Function:
        """Return the state at the end of a flight, of what the functions of a guard take."""
        if mode not in self._states:
            self._states[mode] = flown(self.system, self.motion(mode))
        return self._states[mode]

    def lemmas(self, mode: str) -> dict[str, Lemma]:
        """Return the lemmas by which the guards of a mode stay positive."""
        if mode not in self._lemmas:
            self._lemmas[mode] = lemmas(self.system, mode)
        return self._lemmas[mode]

    def longest(self, mode: str) -> float:
        """Return how long a piece of a flight may be: less than 1/|N|, the largest column sum."""
        if mode not in self._longest:
            columns = zip(*self.motion(mode).generator, strict=True)
            sums = (sum(abs(float(number(q))) for q in column) for column in columns)
            norm = max(sums, default=0.0)
            self._longest[mode] = 0.9 / norm if norm else float("inf")
        return self._longest[mode]

    def motion(self, mode: str) -> Motion:
        """Return the flights of a mode."""
        if mode not in self._motions:
            self._motions[mode] = Motion(self.system, mode)
        return self._motions[mode]


class Leg:
    """The guard at the start, the state after the reset and that on arrival, with derivatives.

    If a symmetry moves the flight back, the state after the reset and the clock at the begin of the
    flight have its ``signs``, and t0 is earlier than the contact; the clock given is the contact's.
    """

    def __init__(
        self, system: System, contact: Contact, motion: Motion, signs: Signs = None
    ) -> None:
        self.motion, self._system, tape = motion, system, Tape()
        self._q = [f"q{i}" for i in range(len(system.state))]
        self.inputs = [*START, *self._q, *END, *motion.inputs]
        start = _clock(tape, "c0", "s0")
        before = named(system, [tape.input(q) for q in self._q], start)
        of, reset = scalars(tape), system.reset(contact.mode, contact.guard)
        self._tape = tape
        self._h = of.value(system.guard(contact.mode, contact.guard).value, before)
        self._after = [of.value(reset[z], before) for z in system.state]
        if signs:
            self._after = [q if s > 0 else -q for q, s in zip(self._after, signs, strict=True)]
            start = -start[0], -start[1]
        self._start = start
        self._reached = self._arrival(self._after)

    def _arrival(self, after: Sequence[Term]) -> list[Term]:
        """Return the state on arrival, from that after the reset."""
        tape = self._tape
        duration, end = tape.input("t1") - tape.input("t0"), _clock(tape, "c1", "s1")
        reached = self.motion.arrival(after, self._start, duration, end)
        return [reached[z] for z in self._system.state]

    @cached_property
    def after(self) -> Function:
        """The state after the reset, of (cos, sin, q)."""
        return self._function(["c0", "s0", *self._q], self._after)

    @cached_property
    def value(self) -> Function:
        """h at the start, and the state on arrival."""
        return self._function(self.inputs, [self._h, *self._reached])

    @cached_property
    def slope(self) -> Function:
        """dh by (t0, q), then for each variable on arrival its derivatives by (t0, q, t1).

        A flight from z at t0 moves as z does: by t0 it has the derivative -J f(z, t0), with J = exp
        (A d) its derivative by z, and f the field.  That has no terms that cancel.
        """
        tape, zero = self._tape, self._tape.number(0)
        h, *after = gradients([self._h, *self._after], self._clocked("t0", START, self._q))
        end = self._clocked("t1", END, [])
        end |= {x: {"t1": rate} for x, rate in self.motion.rates(tape).items()}
        arrived = gradients(self._reached, end)
        start = ["t0", *self._q]
        rows = [h.get(v, zero) for v in start]
        fields = [*zip(after, self._leaving(), strict=True)]
        slopes = [
            {v: q.get(v, zero) for v in start} | {"t0": q.get("t0", zero) - f} for q, f in fields
        ]
        for by_state, by_end in zip(self._by_state(), arrived, strict=True):
            for v in start:
                parts = [J * q[v] for J, q in zip(by_state, slopes, strict=True)]
                rows.append(sum(parts, zero))
            rows.append(by_end.get("t1", zero))
        return self._function(self.inputs, rows)

    @cached_property
    def by_parameters(self) -> Function:
        """The derivatives of h and of each variable on arrival by each parameter of the system."""
        tape, names = self._tape, self._system.parameters
        by: dict[str, Gradient] = {name: {name: tape.number(1)} for name in names}
        found = gradients([self._h, *self._reached], by)
        zero = tape.number(0)
        return self._function(self.inputs, [q.get(p, zero) for q in found for p in names])

    def _function(self, inputs: Sequence[str], outputs: Sequence[Term]) -> Function:
        return Function(inputs, outputs, self._system.parameters)

    def _clocked(self, t: str, clock: Sequence[str], others: Sequence[str]) -> dict[str, Gradient]:
        """Return the derivatives of a time, its clock, and other inputs, by time and these."""
        tape, (_, c, s) = self._tape, clock
        w = scalars(tape).value(self._system.omega, {})
        by: dict[str, Gradient] = {name: {name: tape.number(1)} for name in (t, *others)}
        return by | {c: {t: -w * tape.input(s)}, s: {t: w * tape.input(c)}}

    def _leaving(self) -> list[Term]:
        """Return the field of the flight at its start."""
        field, here = self._system.modes[self.motion.mode].field, self._start
        known = named(self._system, self._after, here)
        return [scalars(self._tape).value(field[z], known) for z in self._system.state]

    def _by_state(self) -> list[list[Term]]:
        """Return J, by rows: no variable of the state occurs in it, as flights are affine."""
        tape, names = self._tape, [f"a{i}" for i in range(len(self._after))]
        zero, one = tape.number(0), tape.number(1)
        reached = self._arrival([tape.input(a) for a in names])
        return [
            [row.get(a, zero) for a in names]
            for row in gradients(reached, {a: {a: one} for a in names})
        ]


class Watch:
    """A guard h and its derivatives L h, L² h, along flights, and where a flight begins or ends.

    Along a flight they are functions of the clock and the state at its start, the duration d, the
    clock then, and X; at a place, of the clock and the state there.
    """

    def __init__(self, system: System, mode: str, guard: str, motion: Motion) -> None:
        self.motion, q = motion, [f"q{i}" for i in range(len(system.state))]
        self._system, h = system, system.guard(mode, guard).value
        rate = system.lie(mode, h)
        self._towers = h, rate, system.lie(mode, rate)
        self._tape = tape = Tape()
        self.inputs = ["c0", "s0", *q, "d", "c1", "s1", *motion.inputs]
        self._place = ["c0", "s0", *q]
        start, end = _clock(tape, "c0", "s0"), _clock(tape, "c1", "s1")
        state = [tape.input(z) for z in q]
        self._here = named(system, state, start)
        self._there = motion.arrival(state, start, tape.input("d"), end)

    def _of(self, q: Polynomial, *, along: bool) -> Term:
        term: Term = scalars(self._tape).value(q, self._there if along else self._here)
        return term

    def _towered(self, numbers: Sequence[int], *, along: bool) -> Function:
        """Return some of h, L h and L² h, along a flight or at a place."""
        terms = [self._of(self._towers[k], along=along) for k in numbers]
        return Function(self.inputs if along else self._place, terms, self._system.parameters)

    @cached_property
    def along(self) -> Function:
        """h and L h."""
        return self._towered((0, 1), along=True)

    @cached_property
    def height(self) -> Function:
        """h alone."""
        return self._towered((0,), along=True)

    @cached_property
    def bend(self) -> Function:
        """L² h."""
        return self._towered((2,), along=True)

    @cached_property
    def at(self) -> Function:
        """h at a place."""
        return self._towered((0,), along=False)

    @cached_property
    def rate(self) -> Function:
        """L h at a place."""
        return self._towered((1,), along=False)

    @cached_property
    def gradient(self) -> Function:
        """The derivatives of h by the state at a place."""
        h = self._towers[0]
        rows = [self._of(h.derivative(z), along=False) for z in self._system.state]
        return Function(self._place, rows, self._system.parameters)


def flown(system: System, motion: Motion) -> Function:
    """Return the state at the end of a flight, as a function of what a `Watch` takes."""
    tape, q = Tape(), [f"q{i}" for i in range(len(system.state))]
    start, end = _clock(tape, "c0", "s0"), _clock(tape, "c1", "s1")
    there = motion.arrival([tape.input(z) for z in q], start, tape.input("d"), end)
    inputs = ["c0", "s0", *q, "d", "c1", "s1", *motion.inputs]
    return Function(inputs, [there[z] for z in system.state], system.parameters)


def _clock(tape: Tape, c: str, s: str) -> Clock:
    return tape.input(c), tape.input(s)
