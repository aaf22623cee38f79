"""Orbits of two masses that turn and stick, as zeros of equations, in balls and jets over balls.

Of a contact the unknowns are its time, its place, and both velocities just before; of another event
its time, both positions, and the velocity of the mass that does not stop or start.  The equations
say that the flights from each event arrive at the next one, after the last at the first, nT later;
that of the velocity of a mass that is released is replaced by its time: the slow moment of that
number (`cap.flow.model.Oscillator.slow`).  Their derivative is that of jets in the unknowns of both
events.

A mass rests from its stick to its release, or until it is hit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

from cap.errors import NotProved
from cap.flow.model import Flight, Moment
from cap.particles.model import Guess, Model, sign
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet

SIZE = 4  # unknowns of an event
SIDES = {"right": 1, "left": -1}
ANY = Any  # a ball, or a jet over balls


@dataclass(frozen=True)
class Word:
    """What happens: a ``contact``, or -1 and what the ``mass`` does, with the ``side`` it goes to.

    ``rests``: who rests afterwards.  ``number``: of the slow moment of a release.
    """

    word: str
    contact: int
    mass: int
    side: int
    rests: tuple[bool, bool]
    number: int

    @property
    def kind(self) -> str:
        """The first word."""
        return self.word.split()[0]


def words_of(model: Model, guess: Guess) -> list[Word]:
    """Return the words of a guess; who rests is found by going round twice."""
    resting, found = {0: False, 1: False}, list[Word]()
    for word, time, _, _ in [*guess.events, *guess.events]:
        kind, *rest = word.split()
        contact = model.contact(word) if kind in ("hit", "meet") else -1
        mass = int(rest[0]) - 1 if contact < 0 else -1
        side = SIDES.get(rest[-1], 0)
        for i, k in enumerate(model.normal(contact)) if contact >= 0 else ((mass, 1),):
            resting[i] = kind == "stick" if k else resting[i]
        number = _number(model, side, time) if kind == "release" else 0
        found.append(Word(word, contact, mass, side, (resting[0], resting[1]), number))
    return found[len(guess.events) :]


def _number(model: Model, side: int, time: float) -> int:
    o = model.first
    origin = o.slow(side, 0).t
    return round((time - float(origin.mid())) / float(o.T.mid()))


@dataclass(frozen=True)
class Happening:
    """An event: its moment, positions and velocities before; after it, velocities and directions.

    A direction is 0 for a mass that rests.
    """

    word: Word
    at: Moment[ANY]
    x: tuple[ANY, ANY]
    before: tuple[ANY, ANY]
    after: tuple[ANY, ANY]
    signs: tuple[int, int]

    @classmethod
    def of(cls, model: Model, word: Word, z: Sequence[ANY]) -> "Happening":
        """Return the event with the unknowns ``z``; `NotProved` if a direction is uncertain."""
        t, *rest = z
        if word.contact >= 0:
            x, before = model.positions(word.contact, rest[:1]), list(rest[1:])
            rule = model.rules[word.contact]
            after = [row[0] * before[0] + row[1] * before[1] for row in rule]
        else:
            x, before = tuple(rest[:2]), [rest[2]]
            before.insert(word.mass, interval.ZERO)
            after = list(before)
        signs = [
            0 if still else word.side if i == word.mass else sign(_ball(after[i]))
            for i, still in enumerate(word.rests)
        ]
        after = [u if s else interval.ZERO for u, s in zip(after, signs, strict=True)]
        pairs = (x[0], x[1]), (before[0], before[1]), (after[0], after[1]), (signs[0], signs[1])
        return cls(word, model.first.moment(t), *pairs)


def _ball(q: ANY) -> Ball:
    return Ball(q.coefficients[0] if isinstance(q, Jet) else q)


@dataclass(frozen=True)
class Stretch:
    """The flights and rests of both masses from one event to the ``arrival`` at the next one."""

    model: Model
    start: Happening
    end: Happening
    arrival: Moment[ANY]

    @cached_property
    def flights(self) -> list[Flight[ANY] | None]:
        """The flights; None for a mass that rests."""
        h = self.start
        parts = zip(self.model.oscillators, h.signs, h.x, h.after, strict=True)
        return [o.launch(s, h.at, x, v) if s else None for o, s, x, v in parts]

    def reached(self, at: Moment[ANY]) -> tuple[list[ANY], list[ANY]]:
        """Return positions and velocities at a moment."""
        x, v = list[ANY](), list[ANY]()
        for o, g, place in zip(self.model.oscillators, self.flights, self.start.x, strict=True):
            x.append(o.position(g, at) if g else place)
            v.append(o.velocity(g, at) if g else interval.ZERO)
        return x, v

    def misses(self, delay: Ball) -> list[ANY]:
        """Return the four equations; the arrival is so much later than the event, nT or 0."""
        word = self.end.word
        x, v = self.reached(self.arrival)
        miss = [a - b for a, b in zip(x, self.end.x, strict=True)]
        miss += [a - b for a, b in zip(v, self.end.before, strict=True)]
        if word.kind == "release":
            due = self.model.first.slow(word.side, word.number).t
            miss[2 + word.mass] = self.arrival.t - delay - due
        return miss


@dataclass(frozen=True)
class Equations:
    """The equations of an itinerary, over so many periods."""

    model: Model
    words: tuple[Word, ...]
    periods: int

    @property
    def whole(self) -> Ball:
        """The time nT."""
        return Ball(self.periods * self.model.first.T)

    def happenings(self, z: Sequence[Ball]) -> list[Happening]:
        """Return the events with these unknowns."""
        pieces = [z[SIZE * k : SIZE * (k + 1)] for k in range(len(self.words))]
        return [Happening.of(self.model, w, q) for w, q in zip(self.words, pieces, strict=True)]

    def stretches(self, events: Sequence[Happening]) -> list[Stretch]:
        """Return what is between the events."""
        first = events[0].at
        again = first._replace(t=first.t + self.whole)
        arrivals = [*(event.at for event in events[1:]), again]
        following = [*events[1:], events[0]]
        return [
            Stretch(self.model, *each) for each in zip(events, following, arrivals, strict=True)
        ]

    def value(self, z: Sequence[Ball]) -> list[Ball]:
        """Return an enclosure of the equations."""
        found = self.stretches(self.happenings(z))
        return [q for k, one in enumerate(found) for q in one.misses(self._delay(k))]

    def slope(self, z: Sequence[Ball]) -> list[list[Ball]]:
        """Return an enclosure of their derivative, by rows."""
        count = len(self.words)
        rows = [[interval.ZERO] * len(z) for _ in z]
        for k in range(count):
            ends = k, (k + 1) % count
            values = [q for n in ends for q in z[SIZE * n : SIZE * (n + 1)]]
            jets = Jet.variables(values, 1)
            start, end = (
                Happening.of(self.model, self.words[n], jets[SIZE * j : SIZE * (j + 1)])
                for j, n in enumerate(ends)
            )
            arrival = end.at._replace(t=end.at.t + self._delay(k))
            stretch = Stretch(self.model, start, end, arrival)
            for i, miss in enumerate(stretch.misses(self._delay(k))):
                for j in range(2 * SIZE):
                    column = SIZE * ends[j // SIZE] + j % SIZE
                    slope = miss.coefficients[1 + j] if isinstance(miss, Jet) else 0
                    rows[SIZE * k + i][column] = rows[SIZE * k + i][column] + slope
        return rows

    def _delay(self, k: int) -> Ball:
        return self.whole if k == len(self.words) - 1 else interval.ZERO


def unit_powers(words: Sequence[Word]) -> list[tuple[str, ...]]:
    """Return the kinds of the unknowns of each event: time, length, speed."""
    contact, other = ("time", "length", "speed", "speed"), ("time", "length", "length", "speed")
    return [contact if word.contact >= 0 else other for word in words]


def unknowns(words: Sequence[Word], guess: Guess) -> list[float]:
    """Return the unknowns of a guess."""
    found = list[float]()
    for word, (_, t, x, v) in zip(words, guess.events, strict=True):
        if word.contact >= 0:
            found += [t, x[1 if word.contact == 0 else 0], *v]
        else:
            found += [t, *x, v[1 - word.mass]]
    return found


def certain_order(events: Sequence[Happening], whole: Ball) -> None:
    """Prove that the events follow each other in (0, nT)."""
    times = [interval.ZERO, *(event.at.t for event in events), whole]
    for t, following in pairwise(times):
        if not t < following:
            raise NotProved("events", "they may be out of order", {"t": t, "next": following})
