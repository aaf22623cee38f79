"""Where a curve of periodic orbits ends as a leg comes to touch the zero of a guard: a graze.

The zeros of F go on beyond it.  On one more cell, the *piece*, let h be the guard on its leg, with
L^2 h > 0 in a *window* of times, L h < 0 at its beginning and > 0 at its end, and outside of it let
h and all other guards be positive: so h is least at one time tau in it.  The derivative of the
least value m along the cell is that of h at a fixed time, as L h = 0 at tau.  Where it does not
vanish, m = 0 for at most one orbit: enclosed in a *short* cell, at whose ends m has two signs.
"""

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.ahead import Ahead, Begin
from cap.orbits.along import Along
from cap.orbits.branch import Follower
from cap.orbits.cells import Cell
from cap.orbits.periodic import Prover
from cap.orbits.points import FINE, PLACES
from cap.orbits.quiet import Reason
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.lemmas import Falls

SAMPLES, STEPS = 200, 40
WIDTHS = 0.2, 0.14, 0.1, 0.07, 0.05, 0.035, 0.02, 0.01, 0.005, 0.002  # half widths, of the leg

Window = tuple[float, float]


class Graze(NamedTuple):
    """A piece that goes on from the cell of a number; all of the statement of this module."""

    inside: int
    piece: Cell
    leg: int
    guard: str
    window: Window
    reasons: list[Reason]
    short: Cell
    time: tuple[Fraction, Fraction]


class Place(NamedTuple):
    """Which guard is about to be touched on which leg, and when; a guess."""

    leg: int
    guard: str
    time: float


class Least:
    """The least value of the guard near a place, at a point; a guess, which keeps the time."""

    def __init__(self, along: Callable[[Box, Place], Along], place: Place) -> None:
        self.along, self.place, self.time = along, place, Ball(place.time)

    def __call__(self, w: Box) -> Fraction:
        """Return it."""
        along, t = self.along(w, self.place), Ball(self.place.time)
        for _ in range(STEPS):
            step = (along.line(t)[1] / along.bend(t)).mid()
            t = (t - step).mid()
            if not 1e-50 <= abs(step) < 1e3:
                break
        self.place, self.time = self.place._replace(time=float(t)), t
        return interval.midpoint(along.height(t).mid())


class Grazer:
    """Looks for grazes at the ends of a curve."""

    def __init__(self, follower: Follower[Any], prover: Prover) -> None:
        self.follower, self.prover, self.ahead = follower, prover, Ahead(follower, "graze")
        self.cells, self.curve = follower.cells, follower.cells.curve

    def graze(self, cells: list[Cell], *, last: bool) -> Graze:
        """Return the graze beyond the first or the last cell of a curve; raise `NotProved`."""
        begins = self.ahead.begins(cells, last=last)
        proved = partial(self._proved, place=self._place(self.ahead.end(cells, last=last)))
        return self.ahead.first(begins, proved, "no graze is met")

    def _place(self, w: list[float]) -> Place:
        """Return the least relative minimum of all guards within legs."""
        found = []
        for along in self._alongs(tuple(map(Ball, w))):
            a, b = float(along.leg.start.time), float(along.leg.end.time)
            times = [a + (b - a) * k / SAMPLES for k in range(SAMPLES + 1)]
            h = [float(along.height(Ball(t))) for t in times]
            found += [
                (h[k], Place(along.leg.number, along.name, times[k]))
                for k in range(1, SAMPLES)
                if h[k] <= h[k - 1] and h[k] <= h[k + 1]
            ]
        if not found:
            raise NotProved("graze", "no guard has a minimum within a leg")
        return min(found)[1]

    def _alongs(self, w: Box) -> Iterator[Along]:
        """Give the guards on the legs, but those that fall."""
        prover, itinerary = self.prover, self.prover.itinerary
        for leg in prover.legs(tuple(self.curve.expanded(w))):
            mode = itinerary.flown(leg.number)
            following = itinerary.following(leg.number).guard
            for name, lemma in prover.equations.kinds.lemmas(mode).items():
                if not isinstance(lemma, Falls):
                    watch = prover.equations.kinds.watch(mode, name)
                    zeros = itinerary.vanishing[leg.number][name]
                    yield Along(leg, name, watch, zeros, name == following)

    def _along(self, w: Box, place: Place) -> Along:
        """Return the guard that is about to be touched."""
        every = self._alongs(w)
        return next(a for a in every if (a.leg.number, a.name) == (place.leg, place.guard))

    def _proved(self, begin: Begin, place: Place) -> Graze:
        """Prove the graze on a piece, where a guard is about to be touched at a place."""
        near = Least(self._along, place)
        piece = self.ahead.piece(begin, near)
        place, why = near.place, "the guard is not certain to have one least value"
        for window in self._windows(piece.wider, place):
            try:
                reasons = self._approached(piece, place, window)
                with interval.workprec(FINE):
                    short, time = self._short(piece, near)
                return Graze(
                    begin.number, piece, place.leg, place.guard, window, reasons, short, time
                )
            except NotProved as reason:
                why = str(reason)
        raise NotProved("graze", why)

    def _approached(self, piece: Cell, place: Place, window: Window) -> list[Reason]:
        """Prove that on a piece one guard alone may vanish, whose least value is monotone."""
        key, box = (place.leg, place.guard), tuple(self.curve.expanded(piece.wider))
        reasons = self.prover.reasons(box, {key: window})
        middle = interval.hull(Ball(window[0]), Ball(window[1]))
        if self._drift(piece, place, middle).contains(0):
            raise NotProved("graze", "the least value of the guard may not be monotone")
        return reasons

    def _windows(self, box: Box, place: Place) -> Iterator[Window]:
        """Give windows in which the guard has one least value, for all of a box, widest first."""
        along = self._along(box, place)
        long = float(along.leg.end.time) - float(along.leg.start.time)
        for width in WIDTHS:
            a, b = (round(place.time + sign * width * long, 10) for sign in (-1, 1))
            within = along.leg.start.time < a and along.leg.end.time > b
            if within and along.bend(interval.hull(Ball(a), Ball(b))) > 0 and turns(along, a, b):
                yield a, b

    def _drift(self, piece: Cell, place: Place, times: Ball) -> Ball:
        """Return an enclosure of the derivative of h along a cell at fixed times."""
        along = self._along(piece.box, place)
        rates = self.curve.expanded(self.follower.cells.rates(piece.box, piece.line.along))
        equations, of, z = self.curve.equations, self.cells.balls, self.curve.expanded(piece.box)
        at, leg = equations.places[place.leg], equations.legs[place.leg]
        n, start, clock = equations.n, along.leg.start, of.clock(times)
        q = z[at.here + 1 : at.here + n + 1]
        contact = of.clock(equations.time(z, at))
        arguments = [start.time, *contact, *q, times, *clock]
        if leg.motion.generator:
            arguments += of.exponential(leg.motion, times - start.time)
        flat, state = of.of(leg.slope)(*arguments), of.of(leg.value)(*arguments)[1:]
        by = rates[at.here : at.here + n + 1]
        if equations.autonomous and not place.leg:
            by = [interval.ZERO, *by[1:]]
        rows = [flat[i : i + n + 1] for i in range(n + 1, len(flat), n + 2)]
        gradient = of.of(along.watch.gradient)(*clock, *state)
        moved = [interval.total([a * b for a, b in zip(row, by, strict=True)]) for row in rows]
        return interval.total([g * d for g, d in zip(gradient, moved, strict=True)])

    def _short(self, piece: Cell, near: "Least") -> tuple[Cell, tuple[Fraction, Fraction]]:
        """Prove that the least value changes its sign over a short cell; return it, and when."""
        short = self.ahead.short(piece, near)
        unit, time, place = Fraction(1, 10**PLACES), interval.midpoint(near.time), near.place
        along = self._along(short.wider, place)
        for power in range(4):
            far = 4 * unit * 8**power
            a, b = round(time - far, PLACES), round(time + far, PLACES)
            if turns(along, a, b):
                break
        else:
            raise NotProved("graze", "the time of the touch is not certain")
        signs = [_sign(self._along(short.at(s), place), a, b) for s in short.line.ends]
        if signs[0] * signs[1] != -1:
            raise NotProved("graze", "the guard is not certain to touch zero")
        return short, (a, b)


def turns(along: Along, a: float | Fraction, b: float | Fraction) -> bool:
    """Return whether L h < 0 at a and > 0 at b."""
    first, last = (along.line(interval.ball(Fraction(t)))[1] for t in (a, b))
    return bool(first < 0 and last > 0)


def _sign(along: Along, a: Fraction, b: Fraction) -> int:
    """Return the sign of the least value of a convex h that is least in [a, b]; 0: not certain."""
    h, rate = along.line(interval.ball(a))
    return 1 if h + rate * interval.ball(b - a) > 0 else -1 if h < 0 else 0
