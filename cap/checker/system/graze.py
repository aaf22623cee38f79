"""A guard that comes to touch zero within a leg, along a piece of a curve of zeros of F.

On a cell (``curve``), for each s, let h be a guard of the mode of a leg along its flight.  In the
*window* [a, b], which lies within the leg, let L^2 h > 0 and L h(a) < 0 < L h(b): there is one time
tau in it with L h = 0, and h is least there.  By the implicit function theorem tau is analytic in
s, and so is the least value m(s) = h(tau(s), s), whose derivative is that of h by s at a fixed
time, as L h(tau) = 0.  Let this vanish for no time in the window and no s: m is monotone.

*Where m = 0.*  On a *short* cell, whose ends lie among the w of the cell, let L h < 0 < L h at the
ends of a narrow window [c, d] in the window, so that it contains tau.  As h is convex,

    h(c) + L h(c) (d - c) <= m <= h(c).

If the left side is positive at one end of the short cell and h(c) negative at the other one, m
vanishes for one s of the cell, which lies in the short one.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.curve import Box, Curve
from cap.checker.system.evaluation import Values
from cap.checker.system.legs import Leg, dot
from cap.checker.system.model import CLOCK, PI
from cap.checker.system.polynomial import Polynomial
from cap.checker.system.quiet import Watched, watched

Ends = tuple[Fraction, Fraction]


def turns(flights: Leg, h: Watched, end: Interval, window: Interval) -> None:
    """Prove that h has one least value in the window, which lies within the leg."""
    need(flights.start.is_before(window) and window.is_before(end), "a window is not in its leg")
    need(flights.over(h.bend, window).is_positive(), "a guard may not be convex in the window")
    inside(flights, h, window)


def inside(flights: Leg, h: Watched, window: Interval) -> None:
    """Prove that L h changes its sign from one end of a window to the other."""
    a, b = _ends(window)
    falls, rises = -flights.over(h.rate, a), flights.over(h.rate, b)
    need(falls.is_positive() and rises.is_positive(), "a guard may not turn in the window")


def sign(flights: Leg, h: Watched, narrow: Interval) -> int:
    """Return the sign of the least value of h, which is taken in a window, or 0 if not certain."""
    a, b = _ends(narrow)
    above = flights.over(h.h, a)
    least = above + flights.over(h.rate, a) * (b - a)
    return 1 if least.is_positive() else -1 if (-above).is_positive() else 0


def drift(curve: Curve, box: Box, rates: Box, k: int, window: Interval, h: Polynomial) -> Interval:
    """Return the derivative of h by s at the times of a window on the k-th leg.

    ``rates`` is w' on the box.
    """
    equations, model = curve.equations, curve.equations.model
    z, moved, here = curve.expanded(box), curve.expanded(rates), equations.places(k)[0]
    n, passage, start = equations.n, equations.passages[k], equations.start(z, k)
    clock = passage.flights.clock
    begin, q = clock(start), z[here + 1 : here + n + 1]
    step = passage.step(equations.turned(k, begin), q, clock(window), window - start)
    by = moved[here : here + n + 1]
    if equations.autonomous and not k:
        by = [start.integer(0), *by[1:]]  # the first contact is at the time 0
    known = dict(zip(model.state, (x.value for x in step.arrival), strict=True))
    known |= {**dict(zip(CLOCK, clock(window), strict=True)), PI: passage.flights.pi}
    values = Values(known, start.integer(1))
    gradient = [values.of(h.derivative(name)) for name in model.state]
    return dot(gradient, [dot(x.derivatives(n + 2)[:-1], by) for x in step.arrival])


def _ends(window: Interval) -> tuple[Interval, Interval]:
    """Return the ends of a window."""
    lo, hi, bits = window.lo, window.hi, window.bits
    return Interval(lo, lo, bits), Interval(hi, hi, bits)


class Graze:
    """The least value of a guard in a window of times, on the j-th leg of the orbits of a curve."""

    def __init__(self, curve: Curve, j: int, guard: str, ends: Ends) -> None:
        self.curve, self.j, self.guard, self.ends = curve, j, guard, ends
        model, orbit = curve.equations.model, curve.equations.orbit
        need(j < len(orbit.contacts), "a graze is on no leg")
        guards = watched(model, orbit.flown(j))
        need(guard in guards, "there is no such guard to be grazed")
        need(ends[0] < ends[1], "the ends of a window are not in order")
        self.h, self.window = guards[guard], Interval.enclosing(*ends, curve.equations.bits)

    @classmethod
    def of(cls, curve: Curve, end: Mapping[str, Any]) -> Graze:
        """Return that of a certificate."""
        return cls(curve, end["leg"] - 1, end["guard"], end["window"])

    def given(self, j: int) -> dict[str, Any]:
        """Return where on the j-th leg a guard may vanish."""
        return {"windows": {self.guard: self.window}} if j == self.j else {}

    def confirm(self, w: Box) -> None:
        """Prove that there is one least value in the window, over a box of zeros."""
        end = self.curve.equations.end(self.curve.expanded(w), self.j)
        turns(self._flights(w), self.h, end, self.window)

    def change(self, w: Box, rates: Box) -> Interval:
        """Return m' over a box of zeros, where ``rates`` is w'."""
        return drift(self.curve, w, rates, self.j, self.window, self.h.h)

    def short(self, curve: Curve, hints: Mapping[str, Any]) -> Graze:
        """Return the same on a short cell, in a narrow window."""
        (a, b), (c, d) = self.ends, hints["narrow"]
        need(a <= c and d <= b, "the narrow window of a graze is not in its window")
        return Graze(curve, self.j, self.guard, (c, d))

    def time(self, w: Box) -> Interval:
        """Prove that the least value is taken in the window; return this."""
        inside(self._flights(w), self.h, self.window)
        return self.window

    def sign(self, w: Box) -> int:
        """Return the sign of m, or 0 if it is not certain."""
        return sign(self._flights(w), self.h, self.window)

    def _flights(self, w: Box) -> Leg:
        equations, z = self.curve.equations, self.curve.expanded(w)
        after = dict(zip(equations.model.state, equations.steps(z)[self.j].after, strict=True))
        orbit = equations.orbit
        return Leg(equations.model, orbit.flown(self.j), equations.start(z, self.j), after)
