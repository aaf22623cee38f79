"""A map of one variable: from the time of a release to the time of the next one.

*A release* is a contact (``passage``) whose guard is h = c x + r(clock), x a variable of the state
and c a number, and whose reset gives all other variables by x and the clock.  Just before it x =
-r/c, so the time t of a release gives the state just after it; what happened before is forgotten.

*The map.*  Let contacts be given, the first of them the release; each leads to the mode of the
next, the last one to that of the first.  F(t) is the time of the next release, if after the release
at t these contacts follow one another and nothing else happens before.

*A contact over a set of releases.*  Flights begin at times in T_0 and in a box of states.  For a
window W after T_0 with L h < 0 on it, and m in W, let

    N = m - h(m)/L h(W),      h(m) in h_c(m) + (dh(m)/dt) (T - c),

where c is one of the times T of release, h_c is h on its flight, and the derivative by t is over T.
If N lies in the interior of W, h has on each flight exactly one zero in W, it lies in N, and h
falls there.  All guards of the mode are positive before (``quiet``); no other mode that the guard
before names is open.  So F is defined on the set, and analytic.

*Derivatives* by t: z' on arrival at a fixed time has dz = A d(t_k, q_k), with the derivatives A of
the flight (``passage``); so the time of the contact has dt = -(grad h . dz)/L h, and the state
there dz + (dz/dt) dt.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.contacts import Round
from cap.checker.system.evaluation import Values
from cap.checker.system.legs import Leg, dot, flights
from cap.checker.system.model import CLOCK, COS, PI, SIN, Model
from cap.checker.system.passage import Contact, passage
from cap.checker.system.polynomial import ONE, variable
from cap.checker.system.quiet import Watched, halved, vanishing, watched

AGAIN = 4  # times that a window is narrowed
PIECES = 400  # of one flight, for each guard

Windows = Sequence[Interval]


class Moment(NamedTuple):
    """A contact of the motions after a set of releases: its time, the state just before it.

    ``by`` are the derivatives of time and state by the time of the release.
    """

    time: Interval
    state: list[Interval]
    by: list[Interval]


class Arrival(NamedTuple):
    """Flights of one mode, and the contact at their end."""

    leg: Leg
    moment: Moment


class Releases:
    """F at a precision; no more than ``budget`` pieces of flights are looked at in all."""

    def __init__(
        self, model: Model, contacts: Sequence[Contact], bits: int, budget: int = 1 << 62
    ) -> None:
        need(not model.autonomous, "the clock occurs nowhere: releases have no phase")
        Round(model, contacts, 1).confirm()
        self.model, self.contacts, self.bits, self.left = model, contacts, bits, budget
        mode, key, _ = contacts[0]
        guard = model.modes[mode].guards[key]
        names = sorted(guard.value.variables - {*CLOCK, PI})
        need(len(names) == 1, f"{key} of {mode} is not of one variable of the state and the clock")
        self.x, rate = names[0], guard.value.derivative(names[0])
        need(rate.terms.keys() == {()}, f"{key} of {mode} is not of degree 1 in {self.x}")
        known = {self.x, *CLOCK, PI}
        for z in model.state:
            given = guard.reset.get(z, variable(z)).variables | guard.divisor.variables
            need(
                given <= known, f"{z} after {key} of {mode} is not given by {self.x} and the clock"
            )
        self.place = guard.value.without(names) * (-1 / rate.number)
        w, cos, sin = model.frequency, variable(COS), variable(SIN)
        self.speed = self.place.derivative(SIN) * cos * w - self.place.derivative(COS) * sin * w
        self.passages = [passage(model, contact, bits) for contact in contacts]
        self.flights = flights(model, contacts[0].to, bits)
        self.period = self.flights.pi * 2 / self.flights.omega

    def release(self, t: Interval) -> Moment:
        """Return the releases at times in an interval; variables that are forgotten are 0."""
        known, zero = self._values(t, {}), t.integer(0)
        state = [known.of(self.place) if z == self.x else zero for z in self.model.state]
        by = [known.of(self.speed) if z == self.x else zero for z in self.model.state]
        return Moment(t, state, [t.integer(1), *by])

    def over(self, t: Interval, windows: Windows) -> list[Moment]:
        """Prove that F is defined at all times in an interval; return the contacts that follow.

        The last of them is the next release.
        """
        middle = t.midpoint()
        centre, found = self._followed(middle, windows), [self.release(t)]
        for k, (window, at) in enumerate(zip(windows, centre, strict=True)):
            found.append(self._next(found[-1], k, window, at, t - middle))
        return found[1:]

    def at(self, t: Interval, windows: Windows) -> Moment:
        """Return the next release, where F is known to be defined, with contacts in the windows."""
        return self._followed(t, windows)[-1].moment

    def _followed(self, t: Interval, windows: Windows) -> list[Arrival]:
        """Return what follows a release: the one zero in each window."""
        need(len(windows) == len(self.contacts), "not one window for each contact")
        moment, found = self.release(t), list[Arrival]()
        for k, given in enumerate(windows):
            leg, h = self._leg(moment, k, given)
            window = given
            for n in range(AGAIN):
                m = window.midpoint()
                time = m - leg.over(h.h, m) / self._falling(leg, h, window)
                inner = n > 0 or time.lies_inside(window.lower, window.upper)
                need(inner, "a guard may have no zero in its window")
                window = time.intersection(window)
            moment = self._arrived(moment, k, leg, window)
            found.append(Arrival(leg, moment))
        return found

    def _next(
        self, before: Moment, k: int, window: Interval, at: Arrival, spread: Interval
    ) -> Moment:
        """Return the contact after the k-th, counted from 0, whose time is in a window.

        ``at`` is the same for one of the releases, the others are at most ``spread`` from it.
        """
        leg, h = self._leg(before, k, window)
        m = at.moment.time.midpoint()
        slope = dot(self._gradient(leg, h, m), self._moved(before, k, m)[0])
        height = at.leg.over(h.h, m) + slope * spread
        time = m - height / self._falling(leg, h, window)
        inner = time.lies_inside(window.lower, window.upper)
        need(inner, f"'{self.contacts[(k + 1) % len(self.contacts)].guard}' may have no zero in "
             "its window")  # fmt: skip
        self._quiet(k, leg, time)
        self._closed(k, leg)
        found = self._arrived(before, k, leg, time)
        state = [
            x.intersection(y + by * spread)
            for x, y, by in zip(found.state, at.moment.state, found.by[1:], strict=True)
        ]
        return found._replace(state=state)

    def _leg(self, before: Moment, k: int, window: Interval) -> tuple[Leg, Watched]:
        """Return the flights after the k-th contact, and the guard that ends them."""
        contact, following = self.contacts[k], self.contacts[(k + 1) % len(self.contacts)]
        need(before.time.is_before(window), "a window begins before the contact before it")
        leg = Leg(self.model, contact.to, before.time, self._after(contact, before))
        return leg, watched(self.model, contact.to)[following.guard]

    def _falling(self, leg: Leg, h: Watched, window: Interval) -> Interval:
        """Return L h in a window, where it is negative."""
        rate = leg.over(h.rate, window)
        need((-rate).is_positive(), "a guard may not fall in its window")
        return rate

    def _gradient(self, leg: Leg, h: Watched, t: Interval) -> list[Interval]:
        """Return the derivatives of a guard by the state."""
        return [leg.over(h.h.derivative(z), t) for z in self.model.state]

    def _moved(self, before: Moment, k: int, t: Interval) -> tuple[list[Interval], list[Interval]]:
        """Return the derivatives of the state at a fixed time by that of the release, and in time.

        The time is after the k-th contact.
        """
        start, end = (self.flights.clock(x) for x in (before.time, t))
        step = self.passages[k].step(start, before.state, end, t - before.time)
        rows = [x.derivatives(len(before.by) + 1) for x in step.arrival]
        return [dot(row[:-1], before.by) for row in rows], [row[-1] for row in rows]

    def _arrived(self, before: Moment, k: int, leg: Leg, time: Interval) -> Moment:
        """Return the contact at the end of flights, with its derivatives."""
        contact, following = self.contacts[k], self.contacts[(k + 1) % len(self.contacts)]
        h = watched(self.model, contact.to)[following.guard]
        moved, rates = self._moved(before, k, time)
        by_time = -dot(self._gradient(leg, h, time), moved) / self._falling(leg, h, time)
        by = [x + rate * by_time for x, rate in zip(moved, rates, strict=True)]
        return Moment(time, [*leg.state(time).values()], [by_time, *by])

    def _quiet(self, k: int, leg: Leg, end: Interval) -> None:
        """Prove that until then all guards of the mode after the k-th contact are positive."""
        contact, following = self.contacts[k], self.contacts[(k + 1) % len(self.contacts)].guard
        zeros = vanishing(self.model, contact.mode, contact.guard, contact.to)
        for key, g in watched(self.model, contact.to).items():
            most = min(PIECES, self.left)
            self.left -= halved(leg, g, end, (zeros[key], int(key == following)), most)

    def _closed(self, k: int, leg: Leg) -> None:
        """Prove that after the k-th contact no other mode is open.

        In each, a guard is negative, or vanishes after this contact and falls.
        """
        contact = self.contacts[k]
        for mode in self.model.modes[contact.mode].guards[contact.guard].to:
            if mode != contact.to:
                zeros = vanishing(self.model, contact.mode, contact.guard, mode)
                guards = watched(self.model, mode).items()
                signs = [leg.begun((h.h, h.rate, h.bend)[zeros[key]]) for key, h in guards]
                closed = any((-x).is_positive() for x in signs)
                need(closed, f"the mode {mode} may be open after '{contact.guard}'")

    def _after(self, contact: Contact, before: Moment) -> dict[str, Interval]:
        """Return the state just after a contact."""
        guard = self.model.modes[contact.mode].guards[contact.guard]
        values = self._values(before.time, dict(zip(self.model.state, before.state, strict=True)))
        divisor = values.of(guard.divisor)
        found = dict[str, Interval]()
        for z in self.model.state:
            reset = values.of(guard.reset.get(z, variable(z)))
            found[z] = reset / divisor if z in guard.reset and guard.divisor != ONE else reset
        return found

    def _values(self, t: Interval, state: Mapping[str, Interval]) -> Values[Interval]:
        """Return the values of all variables at a time."""
        clock = dict(zip(CLOCK, self.flights.clock(t), strict=True))
        return Values({**clock, **state, PI: self.flights.pi}, t.integer(1))
