"""A contact that is lost along a piece of a curve of zeros of F, as its speed goes to zero.

At a contact, the zero of the guard h of a mode in which the system goes on, let u = L h just before
it.  Let the reset R be such that, as polynomials,

    h(R) is a constant times h,      R - 1 = u g,      L h(R) = -u c,

with g a vector of polynomials and c one, over powers of the divisor of R; on the cell let the
divisor not vanish and c be positive, or c be the polynomial 0.  Where u < 0, L h(R) >= 0 after it;
where u = 0 the contact does nothing.

On the last piece of the leg before the contact, and on the first of that after it, let L^2 h > 0.
Where u <= 0 then h > 0 on both but for the contact: L h increases to u, or from L h(R), and so is
negative before it, and positive after it.

Let u' = du/ds not vanish on the cell: u = 0 for one s of it at most.  If u has two signs at the
ends of a short cell, whose ends lie among the w of the cell, it is so for one, which lies in it.
There h touches zero: h = L h = 0 < L^2 h.  Where u > 0 h rises through zero at the contact: it is
negative just before, so that this is no orbit.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.curve import Box, Curve
from cap.checker.system.evaluation import Values
from cap.checker.system.legs import dot
from cap.checker.system.model import CLOCK, COS, PI, SIN
from cap.checker.system.passage import Contact
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.quiet import after_event, watched


class LostContact:
    """The k-th contact of the orbits of a curve."""

    def __init__(self, curve: Curve, k: int) -> None:
        self.curve, self.k = curve, k
        self.equations = curve.equations
        orbit, self.model = self.equations.orbit, self.equations.model
        need(k < len(orbit.contacts), "there is no such contact to be lost")
        self.contact: Contact = orbit.contacts[k]
        need(not orbit.is_moved(k), "after a contact that is lost a symmetry moves the flight")
        self.h = watched(self.model, self.contact.mode)[self.contact.guard]

    @classmethod
    def of(cls, curve: Curve, end: Mapping[str, Any]) -> LostContact:
        """Return that of a certificate."""
        return cls(curve, end["contact"] - 1)

    def given(self, _j: int) -> dict[str, Any]:
        """Return what is given of a leg: the contact."""
        return {"lost": self.k}

    def confirm(self, w: Box) -> None:
        """Prove what is needed of the reset, over a box of zeros."""
        event, rate = self.equations.orbit.guard(self.k), self.h.rate
        need(self.contact.to == self.contact.mode, "a contact that is lost leads to another mode")
        vanishes = self.equations.orbit.zeros(self.k)[self.contact.guard] > 0
        need(vanishes, "the guard of a contact that is lost may not vanish after it")
        for z, q in event.reset.items():
            moved = q - variable(z) * event.divisor
            need(moved.divided(rate) is not None, f"a contact of speed 0 may move {z}")
        found = after_event(rate, event)
        if found is None:
            raise Rejected("the reset of a contact that is lost is too long")
        returned, power = found
        c = returned.divided(rate)
        if c is None:
            raise Rejected("the speed after a contact may not be a multiple of that before")
        sign = self._of(w, c) * self._of(w, power)
        need(not c.terms or (-sign).is_positive(), "a contact may not turn the speed")

    def speed(self, w: Box) -> Interval:
        """Return u over a box of zeros."""
        return self._of(w, self.h.rate)

    def change(self, w: Box, rates: Box) -> Interval:
        """Return u' over a box of zeros, where ``rates`` is w'."""
        rate, omega = self.h.rate, self.model.frequency
        moved, here = self.curve.expanded(rates), self.equations.places(self.k)[0]
        by_time = rate.derivative(SIN) * variable(COS) - rate.derivative(COS) * variable(SIN)
        gradient = [by_time * omega, *(rate.derivative(z) for z in self.model.state)]
        by = moved[here : here + self.equations.n + 1]
        return dot([self._of(w, q) for q in gradient], by)

    def short(self, curve: Curve, _hints: Mapping[str, Any]) -> LostContact:
        """Return the same on a short cell."""
        return LostContact(curve, self.k)

    def sign(self, w: Box) -> int:
        """Return the sign of -u, or 0 if it is not certain."""
        u = self.speed(w)
        return 1 if (-u).is_positive() else -1 if u.is_positive() else 0

    def time(self, w: Box) -> Interval:
        """Return the time of the contact."""
        return self.equations.start(self.curve.expanded(w), self.k)

    def _of(self, w: Box, q: Polynomial) -> Interval:
        """Return a polynomial in the state just before the contact."""
        z, here, of = self.curve.expanded(w), self.equations.places(self.k)[0], self.equations
        clock = of.passages[self.k].flights.clock(self.time(w))
        state = z[here + 1 : here + of.n + 1]
        known = dict(zip((*self.model.state, *CLOCK), (*state, *clock), strict=True))
        known[PI] = of.passages[self.k].flights.pi
        return Values(known, known[PI].integer(1)).of(q)
