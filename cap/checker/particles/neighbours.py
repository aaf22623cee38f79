"""All orbits of two masses from a box of states at t = 0, over one period.

The box is convex, with a point c; quantities are jets in the state at t = 0, at c and over the box
(``Centred``).  The contacts of an itinerary are followed.  Each has a time window:

*A contact in its window.*  Let g = n.x - level be the distance from contact, along the flights
continued.  If it has one sign at the beginning of the window and the other one at its end, and g'
is not 0 in the window, then g has exactly one zero in it, an analytic function of the state.

*Nothing else.*  With the times of contacts that this gives, for each flight from one to the next
(the first begins at t = 0, the last ends at T): the velocities do not vanish on it, and the masses
do not meet inside it (``orbit``); at its ends they are between the walls, but for the contact.  As
velocities keep their signs no wall is touched inside.  So the contacts are those of the motions.

So no mass stops in the period, and Phi is analytic on the box.  It is injective: from the state at
T a motion can be followed back, as flights are determined by the signs of velocities, and elastic
contacts can be reversed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

from cap.checker.flow.hits import Zero, event_time, slope
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet, RealJet, cos_sin_jet, lift
from cap.checker.kernel.rejection import need
from cap.checker.particles.mechanics import NORMALS, Flight, Instant, Mechanics, Signs, sign
from cap.checker.particles.orbit import together

Ends = tuple[Fraction, Fraction]
Formula = Callable[[int, int, Sequence[RealJet], Sequence[RealJet]], RealJet]


class Arc(NamedTuple):
    """A flight of both masses: their signs, the moment (t, cos wt, sin wt) of its start, x and v.

    ``met``: whether the masses are in contact there.
    """

    signs: Signs
    moment: Sequence[Centred]
    x: Sequence[Centred]
    v: Sequence[Centred]
    met: bool = False


class Neighbours:
    """The orbits from a box around c, with jets up to an order: at c to one order less."""

    def __init__(self, M: Mechanics, box: Sequence[Interval], c: Sequence[Interval], order: int):
        self.M, self.bits, self.omega, self.order = M, M.bits, M.omega, order
        self.offsets = [z - m for z, m in zip(box, c, strict=True)]
        self.states = [self.variable(n, *q) for n, q in enumerate(zip(box, c, strict=True))]

    def variable(self, n: int, z: Interval, m: Interval) -> Centred:
        """Return a coordinate of the state at t = 0."""
        unit = tuple(int(i == n) for i in range(4))
        centre, box = (Jet(self.order, {(0,) * 4: q, unit: q.integer(1)}) for q in (m, z))
        return Centred(centre.truncated(self.order - 1), box, self.offsets)

    def constant(self, q: Interval) -> Centred:
        """Return what is the same for all orbits."""
        jet = Jet(self.order, {(0,) * 4: q})
        return Centred(jet.truncated(self.order - 1), jet, self.offsets)

    def instant(self, t: Interval) -> list[Centred]:
        """Return a moment that is the same for all orbits."""
        return [self.constant(q) for q in self.M.instant(t)]

    def over(self, itinerary: Sequence[str], windows: Sequence[Ends]) -> list[Centred]:
        """Return Phi over the box; all orbits from it have these contacts and no mass stops."""
        x, v, zero = self.states[:2], self.states[2:], self.M.number(0)
        arc = Arc(self.signs(v), self.instant(zero), x, v)
        self.between_the_walls(x)
        for word, window in zip(itinerary, windows, strict=True):
            arc = self.contact(arc, word, window)
        end = self.instant(self.M.period)
        before = arc.moment[0].value.is_before(self.M.period)
        need(before, "the last contact may be after T")
        x, v = self.at(arc, end)
        self.quiet(arc, end, x, v, met=False)
        self.between_the_walls(x)
        return [*x, *v]

    def signs(self, v: Sequence[Centred]) -> Signs:
        """Return the signs of velocities, which must be certain."""
        return sign(v[0].value), sign(v[1].value)

    def between_the_walls(self, x: Sequence[Centred]) -> None:
        """Prove that l < x_1 < x_2 < r."""
        places = [self.M.walls[0], *(q.value for q in x), self.M.walls[1]]
        inside = all(p.is_before(q) for p, q in pairwise(places))
        need(inside, "the masses may be in contact at t = 0 or T")

    # flights

    def arc(self, arc: Arc) -> list[Centred]:
        """Return what a flight is made of."""
        return [*arc.moment, *arc.x, *arc.v]

    def place(self, i: int, s: int, arc: Sequence[RealJet], now: Sequence[RealJet]) -> RealJet:
        """Return x_i on a flight."""
        return along(self.M.place, i, s, arc, now)

    def velocity(self, i: int, s: int, arc: Sequence[RealJet], now: Sequence[RealJet]) -> RealJet:
        """Return v_i on a flight."""
        return along(self.M.velocity, i, s, arc, now)

    def at(self, arc: Arc, now: Sequence[Centred]) -> tuple[list[Centred], list[Centred]]:
        """Return places and velocities at a moment of a flight."""
        parts = self.arc(arc)

        def formula(of: Formula, i: int) -> Centred:
            return lift(lambda *q: of(i, arc.signs[i], q[:7], q[7:]), *parts, *now)

        x, v = ([formula(of, i) for i in (0, 1)] for of in (self.place, self.velocity))
        return x, v

    def guard(self, word: str, signs: Signs) -> Zero:
        """Return g and g'."""
        n, (l, r) = NORMALS[word], self.M.walls
        level = {"hit l": l, "hit r": r, "meet 1 2": l.integer(0)}[word]

        def along(of: Formula, arc: Sequence[RealJet], now: Sequence[RealJet]) -> RealJet:
            return of(0, signs[0], arc, now) * n[0] + of(1, signs[1], arc, now) * n[1]

        place, velocity = ((lambda *q, of=of: along(of, *q)) for of in (self.place, self.velocity))
        return Zero(place, velocity, level)

    # contacts

    def contact(self, arc: Arc, word: str, window: Ends) -> Arc:
        """Prove that the next contact is this one, in its window; return the flight after it."""
        guard = self.guard(word, arc.signs)
        self.crossed(arc, guard, word, window)
        M: Any = self  # all that is used: bits, omega and offsets
        t = event_time(M, self.arc(arc), window, guard)
        need(arc.moment[0].value.is_before(t.value), "the contacts are not in order")
        now = [t, *(lift(lambda q, k=k: cos_sin_jet(q * self.omega)[k], t) for k in (0, 1))]
        x, v = self.at(arc, now)
        met = word == "meet 1 2"
        self.quiet(arc, now, x, v, met=met)
        x = self.placed(word, x)
        (a, b), (c, d) = self.M.rule(word)
        after = [lift(lambda p, q, k=k: p * k[0] + q * k[1], *v) for k in ((a, b), (c, d))]
        return Arc(self.signs(after), now, x, after, met)

    def crossed(self, arc: Arc, guard: Zero, word: str, window: Ends) -> None:
        """Prove that g has exactly one zero in the window, and comes to it from inside."""
        need(window[0] < window[1], "a window is empty")
        towards = -1 if word == "hit l" else 1  # the sign of g'
        parts = [q.box.truncated(0) for q in self.arc(arc)]
        values = []
        for end in window:
            now = [Jet(0, {(0,) * 4: q}) for q in self.M.instant(self.M.number(end))]
            values.append((guard.value(parts, now).constant - guard.level) * towards)
        need((-values[0]).is_positive(), "a contact may be before its window")
        need(values[1].is_positive(), "a contact may be after its window")
        M: Any = self
        steep = slope(M, parts, Interval.enclosing(*window, self.bits), guard) * towards
        need(steep.is_positive(), "a contact may not be transverse")

    def placed(self, word: str, x: Sequence[Centred]) -> list[Centred]:
        """Return the places at a contact, there exactly in contact; the others apart."""
        l, r = self.M.walls
        free = x[1] if word == "hit l" else x[0]
        apart = l.is_before(free.value) and free.value.is_before(r)
        need(apart, "a mass may be at a wall while the other one has a contact")
        if word == "meet 1 2":
            return [free, free]
        return [self.constant(l), free] if word == "hit l" else [free, self.constant(r)]

    def quiet(
        self,
        arc: Arc,
        now: Sequence[Centred],
        x: Sequence[Centred],
        v: Sequence[Centred],
        *,
        met: bool,
    ) -> None:
        """Prove that on a flight no mass stops, and the masses do not meet inside."""
        M, signs = self.M, arc.signs
        start, end = (Instant(*(q.value for q in at)) for at in (arc.moment, now))
        places = arc.x[0].value, arc.x[1].value
        flight = Flight(signs, start, places, (arc.v[0].value, arc.v[1].value))
        for i, s in enumerate(signs):
            inside = M.critical(s, start.t, end.t)
            speeds = [flight.v[i], v[i].value, *(M.velocity(i, flight, at) for at in inside)]
            need(all((u * s).is_positive() for u in speeds), "a mass may stop")
        for touching, (p, q) in ((arc.met, places), (met, (x[0].value, x[1].value))):
            need(touching or p.is_before(q), "the masses may meet at an end of a flight")
        if signs[0] == signs[1]:
            inside = M.critical(signs[0], start.t, end.t)
            together(M, flight, [start, *inside, end], (arc.met, met))


def along(law: Any, i: int, s: int, arc: Sequence[Any], now: Sequence[Any]) -> RealJet:
    """Return x_i or v_i on a flight: the laws hold for jets, too."""
    flight = Flight((s, s), Instant(*arc[:3]), (arc[3], arc[4]), (arc[5], arc[6]))
    found: RealJet = law(i, flight, Instant(*now))
    return found
