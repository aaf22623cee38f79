"""The rest after a capture: the guards of the mode of rest, where h = h' = 0."""

from __future__ import annotations

from fractions import Fraction

from cap.errors import NotProved
from cap.orbits.capture import Boxes, clock
from cap.orbits.wall import Wall
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.polynomial import Polynomial

DEPTH = 9  # a piece of the time of rest is at least 2^-DEPTH of it

Times = list[Fraction]


class Held:
    """The guards of the mode of rest where h = h' = 0, at times and over pieces of time.

    The other variables lie in a box, if the guards depend on them.
    """

    def __init__(self, place: Wall, others: Boxes) -> None:
        self.place, self.guards = place, place.rested()
        self.others = {z: interval.hull(*map(interval.ball, ends)) for z, ends in others.items()}
        self.rates = {
            key: place.standing(place.system.lie(place.rest, q)) for key, q in self.guards.items()
        }

    def at(self, key: str, t: Fraction) -> Ball:
        """Return a guard at a time."""
        return self._value(self.guards[key], interval.ball(t))

    def _value(self, q: Polynomial, t: Ball) -> Ball:
        known = {**self.others, **clock(self.place.system, t)}
        value: Ball = q.evaluated(known, interval.ball, interval.pi())
        return value

    def ended(self, t: Fraction) -> list[str]:
        """Return the guards that are not positive at a time."""
        return [key for key in self.guards if not self.at(key, t) > 0]

    def cuts(self, a: Fraction, b: Fraction) -> Times:
        """Return times between two, so dense that the guards are seen to be positive."""
        waiting, done = [(a, b, 0)], Times()
        while waiting:
            low, high, depth = waiting.pop()
            if all(self._holds(key, low, high) for key in self.guards):
                done.append(high)
            elif depth < DEPTH:
                middle = (low + high) / 2
                waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]
            else:
                sets = {"between": (low, high)}
                raise NotProved("rest", "a guard of the mode of rest may come to 0", sets)
        return done[:-1]

    def _holds(self, key: str, a: Fraction, b: Fraction) -> bool:
        piece = interval.hull(interval.ball(a), interval.ball(b))
        if self._value(self.guards[key], piece) > 0:
            return True
        rate = self._value(self.rates[key], piece)
        end = b if rate < 0 else a if rate > 0 else None
        return end is not None and bool(self.at(key, end) > 0)
