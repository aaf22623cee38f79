"""Where a curve of periodic orbits ends as a leg comes to touch the zero of a guard: a graze.

The zeros of F go on beyond it.  On one more cell, the *piece*, let h be the guard on its leg, with
L^2 h > 0 in a *window* of times, L h < 0 at its beginning and > 0 at its end, and outside of it let
h and all other guards be positive: so h is least at one time tau in it.  The derivative of the
least value m along the cell is that of h at a fixed time, as L h = 0 at tau.  Where it does not
vanish, m = 0 for at most one orbit: enclosed in a *short* cell, at whose ends m has two signs.
"""

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.maps.zero import Box
from cap.orbits.along import Along
from cap.orbits.branch import FINE, PLACES, Follower
from cap.orbits.cells import Cell
from cap.orbits.periodic import Prover
from cap.orbits.quiet import Reason
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.lemmas import Falls

SAMPLES, STEPS = 200, 40
BACK = 24, 16, 12, 9, 7, 5, 4, 3, 2, 1  # how many cells before the end the piece begins
BEYOND = Fraction(1, 4)  # of the way to the graze
WIDTHS = 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002  # half widths of a window, of its leg

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


class Grazer:
    """Looks for grazes at the ends of a curve."""

    def __init__(self, follower: Follower[Any], prover: Prover) -> None:
        self.follower, self.prover = follower, prover
        self.cells, self.curve = follower.cells, follower.cells.curve

    def graze(self, cells: list[Cell], *, last: bool) -> Graze:
        """Return the graze beyond the first or the last cell of a curve; raise `NotProved`."""
        ordered = cells if last else cells[::-1]
        if len(ordered) < 2:
            raise NotProved("graze", "the curve has one cell")
        end = _outer(ordered[-1], ordered[-2])
        place, why = self._place([float(x) for x in ordered[-1].at(end)]), "no graze is met"
        for back in BACK:
            if back >= len(ordered):
                continue
            inside = len(ordered) - back
            before = ordered[inside]
            try:
                s = _outer(before, ordered[inside - 1])
                piece, place = self._piece(before, s, place)
                return self._proved(inside if last else back - 1, piece, place)
            except NotProved as reason:
                why = str(reason)
        raise NotProved("graze", why)

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

    def _least(self, w: Box, place: Place) -> tuple[Ball, Ball, Ball]:
        """Return the least value of the guard near a time, the time, and L^2 h; a guess."""
        along, t = self._along(w, place), Ball(place.time)
        for _ in range(STEPS):
            rate, bend = along.line(t)[1], along.bend(t)
            step = (rate / bend).mid()
            t = (t - step).mid()
            if not abs(step) < 1e3:
                break
            if abs(step) < 1e-50:
                break
        return along.height(t).mid(), t, along.bend(t).mid()

    def _zero(
        self, at: Callable[[Fraction], Box], ends: tuple[Fraction, Fraction], place: Place
    ) -> tuple[Fraction, Place, Fraction]:
        """Return where the least value vanishes, by the secant method, and when; a guess."""
        a, b = ends
        f = interval.midpoint(self._least(at(a), place)[0])
        for _ in range(STEPS):
            m, t, _ = self._least(at(b), place)
            g, place = interval.midpoint(m), place._replace(time=float(t))
            if f == g or abs(b - a) < Fraction(1, 10 ** (PLACES + 3)):
                break
            new = round(b - g * (b - a) / (g - f), PLACES + 8)
            if abs(new - b) > 1:
                raise NotProved("graze", "no graze is near the end of the curve")
            a, f, b = b, g, new
        return b, place, interval.midpoint(t)

    def _piece(self, before: Cell, s: Fraction, place: Place) -> tuple[Cell, Place]:
        """Return a cell from the outer end of another to beyond the graze."""
        w = [float(x) for x in before.at(s)]
        v = self.cells.tangent(w)
        along = self.follower.unknown(v)
        begin = s if along == before.line.along else self.follower.begin(before, s, along)

        def at(value: Fraction) -> Box:
            near = [x + y * (float(value) - w[along]) / v[along] for x, y in zip(w, v, strict=True)]
            near[along] = float(value)
            return tuple(map(Ball, self.cells.newton(near, along)[0]))

        inward = 1 if s == max(before.line.ends) else -1
        step = inward * Fraction(1, 10**6) * (1 if along == before.line.along else 0)
        step = step or Fraction(1, 10**6)
        zero, place, _ = self._zero(at, (begin, begin + step), place)
        end = round(zero + (zero - begin) * BEYOND, 12)
        low, high = min(begin, end), max(begin, end)
        if not low < high:
            raise NotProved("graze", "its piece is too short")
        middle = [float(x) for x in at((low + high) / 2)]
        piece = self.cells.prove(self.cells.line(middle, along, (low, high)))
        if not piece.holds(before, s) and not before.holds(piece, begin):
            raise NotProved("graze", "its piece is not certain to go on from a cell")
        return piece, place

    def _proved(self, inside: int, piece: Cell, place: Place) -> Graze:
        """Prove the graze on a piece."""
        box = piece.wider
        window = self._window(box, place)
        key = place.leg, place.guard
        reasons = self.prover.reasons(tuple(self.curve.expanded(box)), {key: window})
        middle = interval.hull(Ball(window[0]), Ball(window[1]))
        if self._drift(piece, place, middle).contains(0):
            raise NotProved("graze", "the least value of the guard may not be monotone")
        with interval.workprec(FINE):
            short, time = self._short(piece, place)
        return Graze(inside, piece, *key, window, reasons, short, time)

    def _window(self, box: Box, place: Place) -> Window:
        """Return a window in which the guard has one least value, for all of a box."""
        along = self._along(box, place)
        long = float(along.leg.end.time) - float(along.leg.start.time)
        for width in WIDTHS:
            a, b = (round(place.time + sign * width * long, 10) for sign in (-1, 1))
            within = along.leg.start.time < a and along.leg.end.time > b
            if within and along.bend(interval.hull(Ball(a), Ball(b))) > 0 and turns(along, a, b):
                return a, b
        raise NotProved("graze", "the guard is not certain to have one least value")

    def _drift(self, piece: Cell, place: Place, times: Ball) -> Ball:
        """Return an enclosure of the derivative of h along a cell at fixed times."""
        along = self._along(piece.box, place)
        rates = self.curve.expanded(self.follower.rates(piece.box, piece.line.along))
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

    def _short(self, piece: Cell, place: Place) -> tuple[Cell, tuple[Fraction, Fraction]]:
        """Prove that the least value changes its sign over a short cell; return it, and when."""

        def at(s: Fraction) -> Box:
            return tuple(map(interval.ball, self.follower.fine(piece.line, (s, s)).centre))

        low, high = piece.line.ends
        near = (9 * low + high) / 10, (low + 9 * high) / 10
        zero, place, time = self._zero(at, near, place)
        unit, middle = Fraction(1, 10**PLACES), round(zero, PLACES)
        ends = middle - 2 * unit, middle + 2 * unit
        if not low < ends[0] < ends[1] < high:
            raise NotProved("graze", "it is not on its piece")
        short = self.cells.prove(self.follower.fine(piece.line, ends))
        if not all(piece.holds(short, s) for s in ends):
            raise NotProved("graze", "it is not certain to be on its piece")
        along = self._along(short.wider, place)
        for power in range(4):
            far = 4 * unit * 8**power
            a, b = round(time - far, PLACES), round(time + far, PLACES)
            if turns(along, a, b):
                break
        else:
            raise NotProved("graze", "the time of the touch is not certain")
        signs = [_sign(self._along(short.at(s), place), a, b) for s in ends]
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


def _outer(cell: Cell, before: Cell) -> Fraction:
    """Return the end of a cell that is farther from another one."""
    centre = [float(x) for x in before.line.centre]

    def far(s: Fraction) -> float:
        return sum((float(x) - c) ** 2 for x, c in zip(cell.at(s), centre, strict=True))

    return max(cell.line.ends, key=far)
