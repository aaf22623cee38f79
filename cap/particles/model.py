"""The mechanics of N masses, in balls; a mass alone is the oscillator of `cap.flow.model`.

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= .. <= x_N <= r,   elastic contacts

(eq:Nparticle, eq:Ncollision).  The contact k is "hit l" for k = 0, "hit r" for k = N, and between
them "meet k k+1".  With its normal n, and M = diag(m), it changes the velocities by

    v -> C v,      C = 1 - 2 M⁻¹ n nᵀ/(nᵀ M⁻¹ n).

The *places* of an event are the N - 1 coordinates that are free there: all but that of the mass at
the wall, or with one for the two masses that meet.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from cap.errors import BadInput, NotProved
from cap.flow.model import Flight, Moment, Oscillator
from cap.flow.strobe import oscillator
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.interval import Ball

Matrix = tuple[tuple[Ball, ...], ...]
Vector = tuple[Ball, ...]


@dataclass(frozen=True)
class Guess:
    """An orbit in floats: masses, and of each event its word, time, positions, velocities before.

    Its period is ``periods`` T; ``further`` are others of its family.  It needs no trust.
    """

    masses: tuple[Fraction, ...]
    events: tuple[tuple[str, float, tuple[float, ...], tuple[float, ...]], ...]
    further: tuple["Guess", ...] = ()
    periods: int = 1


class Model:
    """N masses with the parameters ``p``, enclosed at the precision of its creation."""

    def __init__(self, p: Parameters, masses: Sequence[Fraction]) -> None:
        """Raise `BadInput` unless masses are positive and nothing is lost."""
        if not masses or min(masses) <= 0:
            raise BadInput("give at least one mass, and positive ones")
        if not p.conserves:
            raise BadInput("the walls must be elastic, without viscosity: e = 1, mu = 0")
        self.parameters, self.masses, self.n = p, tuple(masses), len(masses)
        self.oscillators: list[Oscillator[Any]] = [
            oscillator(replace(p, F=p.F / m, f=p.f / m)) for m in masses
        ]
        self.first = self.oscillators[0]
        exact = [self._push(k) for k in range(self.n + 1)]
        self.pushes = [tuple(map(interval.ball, push)) for push in exact]
        self.rules = [self._rule(k, push) for k, push in enumerate(exact)]

    def normal(self, contact: int) -> list[int]:
        """Return n: the gap closes at the rate -(n · v)."""
        n = [0] * self.n
        if contact < self.n:
            n[contact] = 1
        if contact > 0:
            n[contact - 1] = -1
        return n

    def _push(self, contact: int) -> list[Fraction]:
        """Return p = 2 M⁻¹ n/(nᵀ M⁻¹ n), so that C = 1 - p nᵀ."""
        pull = [k / m for k, m in zip(self.normal(contact), self.masses, strict=True)]
        return [2 * q / sum(map(abs, pull)) for q in pull]

    def _rule(self, contact: int, push: list[Fraction]) -> Matrix:
        normal = self.normal(contact)
        return tuple(
            tuple(interval.ball((i == j) - p * k) for j, k in enumerate(normal))
            for i, p in enumerate(push)
        )

    def word(self, contact: int) -> str:
        """Return the word of a contact."""
        if contact in (0, self.n):
            return "hit r" if contact else "hit l"
        return f"meet {contact} {contact + 1}"

    def contact(self, word: str) -> int:
        """Return the contact that a word names; raise `NotProved` if it is no contact."""
        words = [self.word(k) for k in range(self.n + 1)]
        if word not in words:
            raise NotProved("itinerary", f"{word!r} is no contact: a mass stops", {})
        return words.index(word)

    def positions(self, contact: int, places: Sequence[Ball]) -> Vector:
        """Return the N positions at an event."""
        free = list(places)
        if contact in (0, self.n):
            free.insert(contact - 1 if contact else 0, self.first.r if contact else self.first.l)
        else:
            free.insert(contact, free[contact - 1])
        return tuple(free)

    def place_of(self, contact: int) -> list[int | None]:
        """Return for each mass the number of the place that is its position; None at a wall."""
        if contact in (0, self.n):
            index: list[int | None] = list(range(self.n - 1))
            index.insert(contact - 1 if contact else 0, None)
            return index
        return [i if i < contact else i - 1 for i in range(self.n)]

    def after(self, contact: int, before: Sequence[Ball]) -> Vector:
        """Return C v."""
        return tuple(
            interval.total(c * v for c, v in zip(row, before, strict=True))
            for row in self.rules[contact]
        )


class Event(NamedTuple):
    """An event, enclosed: its contact, moment, positions, and velocities before and after it."""

    contact: int
    at: Moment[Ball]
    x: Vector
    before: Vector
    after: Vector


@dataclass(frozen=True)
class Leg:
    """The flights of all masses from one event to the ``arrival`` at the next one."""

    model: Model
    start: Event
    end: Event
    arrival: Moment[Ball]

    @cached_property
    def signs(self) -> tuple[int, ...]:
        """The signs of the velocities; raises `NotProved` if one may vanish."""
        return tuple(map(sign, self.start.after))

    @cached_property
    def flights(self) -> list[Flight[Ball]]:
        """The flights."""
        parts = zip(self.model.oscillators, self.signs, self.start.x, self.start.after, strict=True)
        return [o.launch(s, self.start.at, x, v) for o, s, x, v in parts]

    @property
    def duration(self) -> Ball:
        """How long the flights last."""
        return self.arrival.t - self.start.at.t

    def reached(self) -> tuple[list[Ball], list[Ball]]:
        """Return the positions and velocities at the arrival."""
        pairs = list(zip(self.model.oscillators, self.flights, strict=True))
        at = self.arrival
        return [o.position(g, at) for o, g in pairs], [o.velocity(g, at) for o, g in pairs]

    def accelerations(self, at: Moment[Ball]) -> list[Ball]:
        """Return the accelerations at a moment."""
        pairs = zip(self.model.oscillators, self.flights, strict=True)
        return [o.acceleration(g, at) for o, g in pairs]


def sign(v: Ball) -> int:
    """Return the sign of a velocity; raise `NotProved` if it may vanish."""
    if v > 0:
        return 1
    if v < 0:
        return -1
    raise NotProved("signs", "a velocity may vanish, so a mass may stop", {"v": v})


def events_of(model: Model, contacts: Sequence[int], z: Sequence[Ball]) -> list[Event]:
    """Return the events whose unknowns, 2N for each, are ``z``: t, places, velocities before."""
    n, found = model.n, []
    for k, contact in enumerate(contacts):
        t, *rest = z[2 * n * k : 2 * n * (k + 1)]
        places, before = rest[: n - 1], tuple(rest[n - 1 :])
        x, after = model.positions(contact, places), model.after(contact, before)
        found.append(Event(contact, model.first.moment(t), x, before, after))
    return found


def legs_of(model: Model, events: Sequence[Event]) -> list[Leg]:
    """Return the flights between events that follow each other, from the last to the first + T."""
    first = events[0].at
    again = first._replace(t=first.t + model.first.T)
    following = [*events[1:], events[0]]
    arrivals = [*(event.at for event in events[1:]), again]
    return [
        Leg(model, start, end, at)
        for start, end, at in zip(events, following, arrivals, strict=True)
    ]
