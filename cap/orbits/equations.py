"""The equations of a periodic orbit by its contacts, F(z) = 0, for any system.

The unknowns are the times and states just before the K contacts, z = (t_k, q_k), n + 1 numbers for
each.  With R_k the reset, and the flight in the mode after it,

    h_k(q_k, t_k) = 0,      flight(R_k(q_k, t_k) from t_k to t_(k+1)) - q_(k+1) = 0,

where the contact after the last is the first one, p periods of the clock later.  No contact is
located and no flight is long, so nothing wraps as it does where a period is one map.

*With a symmetry* S (`cap.orbits.itinerary`) the last flight begins p/2 periods before its contact,
at S R_K, with the other signs of cos and sin, and ends at the first contact: what follows is about
the map to half a round later, and back by S.

*Without a clock* orbits may begin at any time: the first contact is at the time 0, and its unknown
t_0 is the period, at which it comes again.

*Derivative.*  (t, q)_(k+1) is a function of (t, q)_k: the time is that at which the next guard
comes to zero, its derivative follows from h_(k+1) = 0.  The product over a round has the
multipliers of the orbit as eigenvalues, and 0.
"""

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.orbits.itinerary import Itinerary
from cap.orbits.leg import Kinds
from cap.orbits.numbers import Numbers
from cap.sets import interval
from cap.sets.interval import Ball, Matrix

Unknowns = Sequence[Any]


class Place(NamedTuple):
    """Where the unknowns of a contact stand, and those of the next; whether a round ends there."""

    here: int
    there: int
    wraps: bool


Given = tuple[Any, Place, list[Any]]  # a leg, where its unknowns stand, the inputs of its functions


class Block(NamedTuple):
    """Derivatives of a leg: of h by (t, q), and of each variable on arrival by (t, q, t_next)."""

    guard: Sequence[Any]
    rows: Sequence[Sequence[Any]]


class Equations:
    """F and F' of the orbits with an itinerary; ``kinds`` may serve several of one system."""

    def __init__(self, itinerary: Itinerary, kinds: Kinds | None = None) -> None:
        self.itinerary = itinerary
        self.kinds = kinds = kinds or Kinds(itinerary.system)
        symmetry = itinerary.symmetry
        self.legs = [
            kinds.leg(contact, itinerary.flown(k), symmetry.signs)
            if symmetry and itinerary.is_moved(k)
            else kinds.leg(contact)
            for k, contact in enumerate(itinerary.contacts)
        ]
        self.n, count = len(itinerary.system.state), len(self.legs)
        step = self.n + 1
        self.size = step * count
        self.autonomous = kinds.autonomous
        self.places = self.places_of(step)

    def places_of(self, step: int) -> list[Place]:
        """Return where the contacts stand in a row of so many unknowns for each."""
        count = len(self.legs)
        return [Place(step * k, step * ((k + 1) % count), k + 1 == count) for k in range(count)]

    def value(self, z: Unknowns, of: Numbers) -> list[Any]:
        """Return F(z)."""
        return self._value(z, of, self._arguments(z, of))

    def blocks(self, z: Unknowns, of: Numbers) -> list[Block]:
        """Return the derivatives of each leg."""
        return self._blocks(of, self._arguments(z, of))

    def both(self, z: Unknowns, of: Numbers) -> tuple[list[Any], list[Block]]:
        """Return F(z) and the derivatives of each leg; their clocks are enclosed once."""
        given = list(self._arguments(z, of))
        return self._value(z, of, given), self._blocks(of, given)

    def _value(self, z: Unknowns, of: Numbers, given: Iterable[Given]) -> list[Any]:
        result: list[Any] = []
        for leg, (_, there, _), arguments in given:
            h, *reached = of.of(leg.value)(*arguments)
            result.append(h)
            result += [a - b for a, b in zip(reached, z[there + 1 :], strict=False)]
        return result

    def _blocks(self, of: Numbers, given: Iterable[Given]) -> list[Block]:
        found, n = [], self.n
        for leg, _, arguments in given:
            flat = of.of(leg.slope)(*arguments)
            rows = [flat[i : i + n + 2] for i in range(n + 1, len(flat), n + 2)]
            found.append(Block(flat[: n + 1], rows))
        return found

    def by_parameters(self, z: Unknowns, of: Numbers) -> list[list[list[Any]]]:
        """Return for each leg the derivatives of h, and of each variable on arrival, by each."""
        count, found = len(self.itinerary.system.parameters), []
        for leg, _, arguments in self._arguments(z, of):
            flat = of.of(leg.by_parameters)(*arguments)
            found.append([[*flat[i : i + count]] for i in range(0, len(flat), count)])
        return found

    def rows(self, blocks: Sequence[Block]) -> list[list[Any]]:
        """Return F' by rows."""
        result: list[list[Any]] = []
        for block, (here, there, _) in zip(blocks, self.places, strict=True):
            first = [0] * self.size
            first[here : here + self.n + 1] = block.guard
            result.append(first)
            for i, entries in enumerate(block.rows):
                row: list[Any] = [0] * self.size
                row[here : here + self.n + 1] = entries[:-1]
                if self.autonomous and not here:
                    row[here] = 0  # the first contact is at the time 0
                row[there] = row[there] + entries[-1]
                row[there + 1 + i] = row[there + 1 + i] - 1
                result.append(row)
        return result

    def _arguments(self, z: Unknowns, of: Numbers) -> Iterator[Given]:
        """Yield each leg with the places of its unknowns and its inputs."""
        clocks = {place.here: of.clock(self.time(z, place)) for place in self.places}
        for leg, place in zip(self.legs, self.places, strict=True):
            t0, t1 = self.start(z, place, of), self.end(z, place, of)
            q = z[place.here + 1 : place.here + self.n + 1]
            arguments = [t0, *clocks[place.here], *q, t1, *clocks[place.there]]
            if leg.motion.generator:
                arguments += of.exponential(leg.motion, t1 - t0)
            yield leg, place, arguments

    def time(self, z: Unknowns, place: Place) -> Any:
        """Return the time of a contact."""
        return z[place.here] * 0 if self.autonomous and not place.here else z[place.here]

    def start(self, z: Unknowns, place: Place, of: Numbers) -> Any:
        """Return the time at which the flight after a contact begins."""
        t = self.time(z, place)
        return t - of.period * self.itinerary.periods / 2 if self.is_moved(place) else t

    def is_moved(self, place: Place) -> bool:
        """Return whether a symmetry moves back the flight after a contact."""
        return place.wraps and self.itinerary.symmetry is not None

    def end(self, z: Unknowns, place: Place, of: Numbers) -> Any:
        """Return the time of the next contact."""
        t = z[place.there]
        later = place.wraps and not self.autonomous and not self.is_moved(place)
        return t + of.period * self.itinerary.periods if later else t


def derivative(blocks: Sequence[Block]) -> Matrix:
    """Return the product of the derivatives of (t, q)_(k+1) by (t, q)_k, enclosed.

    Raises `NotProved` unless L h < 0 is certain where each guard comes to zero.
    """
    return reduce(lambda total, step: step * total, steps(blocks))


def steps(blocks: Sequence[Block]) -> list[Matrix]:
    """Return the derivatives of (t, q)_(k+1) by (t, q)_k, enclosed; raise as `derivative`."""
    following = [(k + 1) % len(blocks) for k in range(len(blocks))]
    return [_step(block, blocks[j].guard, j) for block, j in zip(blocks, following, strict=True)]


def _step(block: Block, guard: Sequence[Ball], number: int) -> Matrix:
    """Return d(t, q)_(k+1) by (t, q)_k, where dh = ``guard`` at the end."""
    rate, time = guard[0], [interval.ZERO] * len(guard)
    for g, row in zip(guard[1:], block.rows, strict=True):
        if not g.is_zero():
            rate = rate + g * row[-1]
            time = [a + g * b for a, b in zip(time, row, strict=False)]
    if not rate < 0:
        reason = f"the guard of contact {number + 1} may not be crossed: a graze"
        raise NotProved("multipliers", reason, {"L h": rate})
    time = [-a / rate for a in time]
    state = [[a + row[-1] * b for a, b in zip(row, time, strict=False)] for row in block.rows]
    return interval.matrix([time, *state])
