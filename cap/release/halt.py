"""Halts: stops at about the time at which the force becomes too weak for a turn.

A mass that moves to the side -s stops between the walls at the time τ, near the time t_b at which s
F cos ωt decreases through f.  If τ < t_b it turns to the side s, and sticks soon after; if not, it
sticks at once.  Let ε >= t_b - τ, ε >= 0, and ωε < min(2θ, π/2 - θ), θ = arccos(f/F).  Then it
moves at most D to the side s, and sticks between t_b and max(τ, t_b + ε), where

    0 <= D <= K ε³,   -2Kε² <= dD/dτ <= 0,   -2ε² <= dD/df <= 0,   K = ω √(F² - f²),

D is continuously differentiable, and 0 for τ >= t_b.  For g(t) = s F cos ωt - f is below its
tangent at t_b, of slope -K, as cos ωt > 0 there: the speed is at most Kε²/2, for at most 2ε.
"""

from typing import Any, cast

from cap.errors import NotProved
from cap.flow.event import E, Event, Expected, rest_time
from cap.flow.model import Flight, Moment
from cap.flow.orbit import SIDES, PartialOrbit
from cap.sets import interval
from cap.sets.interval import Ball

HALTS = ("halt right", "halt left")


class HaltingOrbit(PartialOrbit[E]):
    """A `PartialOrbit` that passes halts, too: "halt right" if it may turn to the right."""

    def meet(self, expected: Expected, number: int) -> None:
        """Prove that the next event is the one expected, and pass it."""
        if expected.word in HALTS:
            self._halt(SIDES[expected.word.partition(" ")[2]], expected, number)
        else:
            super().meet(expected, number)

    def _halt(self, side: int, expected: Expected, number: int) -> None:
        osc, flight = self.osc, self.flight
        if flight is None or flight.s != -side:
            raise NotProved(f"event {number}", f"no {expected.word} is possible")
        moment = rest_time(osc, flight, expected, self.kind, number)
        self._fly(flight, moment.t)
        late, late_by = self._room(side, self.bound(moment.t), number)
        place, slope = self._moved(flight, moment, side, late_by)
        x = self.bound(place)
        if not self.bound(osc.l) < x < self.bound(osc.r):
            raise NotProved(f"event {number}", "the mass may reach a wall", {"x": x})
        (_, b), _ = self.monodromy
        zero: Any = Ball(0)
        self.monodromy = (slope, b), (zero, zero)
        self._rest(place, interval.hull(self.now, late + late_by), 0)
        self.events.append(Event(expected.word, moment.t, zero, moment.cos))

    def _room(self, side: int, tau: Ball, number: int) -> tuple[Ball, Ball]:
        """Return t_b and a bound of t_b - τ; prove that it is small."""
        osc = self.osc
        theta = self.bound(osc.omega * osc.slow_left)
        theta = interval.pi() - theta
        for k in range(-1, 2 + int(float((tau / osc.T).upper()))):
            late = self.bound(osc.slow(side, k).t) + 2 * theta / osc.omega
            if abs(late - tau) < osc.T / 4:
                break
        else:
            raise NotProved(f"event {number}", "the force does not become too weak near a halt")
        early = (late - tau).upper()
        room = interval.upper(early) if early > 0 else Ball(0)
        turned, half = osc.omega * room, interval.pi() / 2
        arc = (2 * half - 2 * theta) / osc.omega
        if not (turned < 2 * theta and turned < half - theta and tau < late + arc):
            raise NotProved(f"event {number}", "the mass may turn too early for a halt")
        return late, room

    def _moved(self, flight: Flight[E], moment: Moment[E], side: int, room: Ball) -> tuple[E, Any]:
        """Return the place where the mass sticks, and its derivative by x."""
        osc, bound = self.osc, self.bound
        K = osc.omega * (bound(osc.F) ** 2 - bound(osc.f) ** 2).sqrt()
        excursion = side * interval.hull(Ball(0), K * room**3)
        by_time = side * interval.hull(Ball(0), -2 * K * room**2)
        place = self.kind.widened(osc.position(flight, moment), cast(Any, excursion))
        (a, _), (c, _) = self.monodromy
        delay = -bound(c) / bound(osc.acceleration(flight, moment))
        return place, self.kind.widened(a, by_time * delay)
