"""Functions of one leg of an orbit, written once for each kind of leg.

A leg begins just before a contact: at the time t0, in the state q, where the guard of the contact
comes to zero; the reset follows, and a flight in the mode in which the system goes on, to t1.
Functions take times, states and, with each time, the clock (cos wt, sin wt); then the entries of X
(`cap.orbits.motion`).
"""

from functools import cached_property

from cap.orbits.itinerary import Contact
from cap.orbits.motion import Clock, Motion, named, scalars
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
        t0, t1 = tape.input("t0"), tape.input("t1")
        start, end = _clock(tape, "c0", "s0"), _clock(tape, "c1", "s1")
        before = named(system, [tape.input(q) for q in self._q], start)
        of, reset = scalars(tape), system.reset(contact.mode, contact.guard)
        self._tape = tape
        self._h = of.value(system.guard(contact.mode, contact.guard).value, before)
        self._after = [of.value(reset[z], before) for z in system.state]
        if signs:
            self._after = [q if s > 0 else -q for q, s in zip(self._after, signs, strict=True)]
            start = -start[0], -start[1]
        reached = motion.arrival(self._after, start, t1 - t0, end)
        self._reached = [reached[z] for z in system.state]

    @cached_property
    def after(self) -> Function:
        """The state after the reset, of (cos, sin, q)."""
        return Function(["c0", "s0", *self._q], self._after)

    @cached_property
    def value(self) -> Function:
        """h at the start, and the state on arrival."""
        return Function(self.inputs, [self._h, *self._reached])

    @cached_property
    def slope(self) -> Function:
        """dh by (t0, q), then for each variable on arrival its derivatives by (t0, q, t1)."""
        tape, one = self._tape, self._tape.number(1)
        w = scalars(tape).value(self._system.omega, {})
        by: dict[str, Gradient] = {name: {name: one} for name in ("t0", "t1", *self._q)}
        for t, c, s in (START, END):
            by |= {c: {t: -w * tape.input(s)}, s: {t: w * tape.input(c)}}
        rates = self.motion.rates(tape)
        by |= {x: {"t1": rate, "t0": -rate} for x, rate in rates.items()}
        h, *reached = gradients([self._h, *self._reached], by)
        zero, start = tape.number(0), ["t0", *self._q]
        rows = [h.get(v, zero) for v in start]
        rows += [z.get(v, zero) for z in reached for v in (*start, "t1")]
        return Function(self.inputs, rows)


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

    @cached_property
    def along(self) -> Function:
        """h and L h."""
        return Function(self.inputs, [self._of(q, along=True) for q in self._towers[:2]])

    @cached_property
    def height(self) -> Function:
        """h alone."""
        return Function(self.inputs, [self._of(self._towers[0], along=True)])

    @cached_property
    def bend(self) -> Function:
        """L² h."""
        return Function(self.inputs, [self._of(self._towers[2], along=True)])

    @cached_property
    def at(self) -> Function:
        """h at a place."""
        return Function(self._place, [self._of(self._towers[0], along=False)])

    @cached_property
    def gradient(self) -> Function:
        """The derivatives of h by the state at a place."""
        h = self._towers[0]
        rows = [self._of(h.derivative(z), along=False) for z in self._system.state]
        return Function(self._place, rows)

    @cached_property
    def rate(self) -> Function:
        """L h at a place."""
        return Function(self._place, [self._of(self._towers[1], along=False)])


def flown(system: System, motion: Motion) -> Function:
    """Return the state at the end of a flight, as a function of what a `Watch` takes."""
    tape, q = Tape(), [f"q{i}" for i in range(len(system.state))]
    start, end = _clock(tape, "c0", "s0"), _clock(tape, "c1", "s1")
    there = motion.arrival([tape.input(z) for z in q], start, tape.input("d"), end)
    inputs = ["c0", "s0", *q, "d", "c1", "s1", *motion.inputs]
    return Function(inputs, [there[z] for z in system.state])


def _clock(tape: Tape, c: str, s: str) -> Clock:
    return tape.input(c), tape.input(s)
