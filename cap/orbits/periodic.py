"""A periodic orbit of any system, from a guess to a proof.

*Theorem.*  `prove` returns only if the system has an orbit with the itinerary, which is p-periodic
(in periods of the clock, for z = (t, q) as in `cap.orbits.equations`), such that

1. it is the only one whose contacts lie within ``reach`` of the centre of ``hint``: by Krawczyk's
   inclusion F has exactly one zero there, and it lies in ``box``;
2. it has these contacts and no others: on each leg every guard of the mode is positive between the
   contacts (`cap.orbits.quiet`; ``reasons`` says by which lemma), and L h < 0 where one comes to
   zero;
3. the derivative of a round by (t, q) lies in ``derivative``: its eigenvalues are the n multipliers
   and 0.
"""

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, reduce
from typing import Any

import numpy as np

from cap.errors import BadInput, NotProved
from cap.maps import zero
from cap.maps.zero import Box, Hint, Problem
from cap.orbits.along import Along, End, Leg
from cap.orbits.equations import Block, Equations, derivative
from cap.orbits.itinerary import Itinerary
from cap.orbits.minima import Minimum, minima
from cap.orbits.numbers import Balls, Clock, Floats
from cap.orbits.quiet import Reason, inside, reason
from cap.sets import interval
from cap.sets.interval import Ball, Matrix

STEPS = 40  # of Newton's iteration in doubles
UNITS = 2.0**40
BITS = 64  # in which most guards are certain to be positive


@dataclass(frozen=True)
class PeriodicOrbit:
    """A proved orbit; see the theorem of this module."""

    itinerary: Itinerary
    hint: Hint
    reach: tuple[Fraction, ...]
    box: Box
    reasons: list[Reason]
    derivative: Matrix
    autonomous: bool

    @property
    def contacts(self) -> list[tuple[Ball, Box]]:
        """The times of the contacts and the states just before them, enclosed."""
        return contacts_of(self.itinerary, self.box)

    @property
    def trace(self) -> Ball:
        """The sum of the multipliers."""
        return self.symmetric[0]

    @cached_property
    def symmetric(self) -> list[Ball]:
        """The elementary symmetric functions of the n multipliers: their sum, .., their product."""
        return symmetric(self.derivative, autonomous=self.autonomous)

    def unstable(self, radius: Fraction = Fraction(1)) -> int | None:
        """How many multipliers lie outside a circle around 0, if certainly none lies on it."""
        return outside(
            [e / interval.ball(radius**k) for k, e in enumerate(self.symmetric, start=1)]
        )


def contacts_of(itinerary: Itinerary, box: Box) -> list[tuple[Ball, Box]]:
    """Return the times and the states, of all of them in a row."""
    step = len(itinerary.system.state) + 1
    return [(box[i], box[i + 1 : i + step]) for i in range(0, len(box), step)]


def in_order(leg: Leg) -> None:
    """Raise `NotProved` unless a leg ends after it begins."""
    if not leg.start.time < leg.end.time:
        sets = {"from": leg.start.time, "to": leg.end.time}
        raise NotProved(f"leg {leg.number + 1}", "the contacts may not be in order", sets)


def symmetric(D: Matrix, *, autonomous: bool) -> list[Ball]:
    """Return the elementary symmetric functions of the n multipliers, D the derivative of a round.

    Without a clock it is that of the state which counts; one of its multipliers is 0.
    """
    n = D.nrows() - 1
    if autonomous:
        D = interval.matrix([row[1:] for row in D.table()[1:]])
    coefficients = D.charpoly().coeffs()
    return [(-1) ** k * coefficients[D.nrows() - k] for k in range(1, n + 1)]


def outside(symmetric: Sequence[Ball]) -> int | None:
    """Return how many multipliers lie outside the unit circle, if certainly none lies on it."""
    signed = [(-1) ** k * e for k, e in enumerate(symmetric, start=1)]
    inside = _inside([interval.ONE, *signed])
    return None if inside is None else len(signed) - inside


def _inside(p: Sequence[Ball]) -> int | None:
    """Return how many zeros of a polynomial, highest power first, lie in the unit circle.

    None if a comparison of Schur and Cohn's recursion is not certain; one may lie on the circle.
    """
    if len(p) == 1:
        return 0
    first, last = abs(p[0]), abs(p[-1])
    if first > last:
        found = _inside([p[0] * a - p[-1] * b for a, b in zip(p, reversed(p), strict=True)][:-1])
        return None if found is None else found + 1
    found = _inside([*reversed(p)]) if last > first else None
    return None if found is None else len(p) - 1 - found


class Prover:
    """Proves orbits with one itinerary; what depends on that alone, or the precision, is kept.

    With ``pieces`` Lemma B stands for C, and its pieces are such as the checker takes.  ``values``
    are those of the parameters of the system, or sets of them: then what is proved holds for all.
    """

    def __init__(
        self,
        equations: Equations,
        *,
        pieces: bool = False,
        values: Mapping[str, Ball] | None = None,
    ) -> None:
        self._values = values
        self.equations, self.itinerary, self._pieces = equations, equations.itinerary, pieces
        self._balls = dict[int, Balls]()
        self._minima = dict[tuple[int, str, str], list[Minimum] | None]()

    @property
    def balls(self) -> Balls:
        """The numbers at the precision here."""
        bits = interval.working_bits()
        if bits not in self._balls:
            self._balls[bits] = (
                Balls(self.itinerary.system, self._values)
                if self._values
                else self.equations.kinds.balls
            )
        return self._balls[bits]

    @property
    def problem(self) -> Problem:
        """F and F' in balls."""
        equations, of = self.equations, self.balls
        return Problem(
            lambda z: equations.value(z, of), lambda z: equations.rows(equations.blocks(z, of))
        )

    def existence(
        self, hint: Hint, reach: Sequence[Fraction]
    ) -> tuple[Box, list[Block], list[Reason]]:
        """Prove that one orbit lies within ``reach`` of the hint, and that nothing else happens.

        Returns a box that contains its contacts, the derivatives of the legs over all points within
        reach, and why nothing else happens.
        """
        blocks = self.equations.blocks(hint.box(reach), self.balls)
        k = self._zero(hint, reach, blocks)
        return k, blocks, self.reasons(k)

    def _zero(self, hint: Hint, reach: Sequence[Fraction], blocks: Sequence[Block]) -> Box:
        """Prove that F has one zero within reach of the hint; return a box around it.

        The ``blocks`` are the derivatives of the legs over all points within reach.
        """
        with interval.guarded():  # K cannot be narrower than F(m)
            value = self.equations.value(hint.point, self.balls)
        E = zero.residual(hint, interval.matrix(self.equations.rows(blocks)))
        return zero.contracted(hint, value, E, hint.box(reach))

    def reasons(
        self,
        box: Box,
        windows: Mapping[tuple[int, str], tuple[float, float]] | None = None,
        lost: int | None = None,
        without: Collection[str] = (),
    ) -> list[Reason]:
        """Prove that nothing else happens on the orbits whose contacts lie in a box.

        In the window of a leg and a guard nothing is proved of it, nor of guards ``without``.
        Where a contact is lost, L h <= 0 before it and L h >= 0 after it are given.
        """
        found, vanishing = list[Reason](), self.itinerary.vanishing
        for leg in self.legs(box):
            mode = self.itinerary.flown(leg.number)
            following = self.itinerary.following(leg.number).guard
            in_order(leg)
            for name, lemma in self.equations.kinds.lemmas(mode).items():
                if name in without:
                    continue
                watch = self.equations.kinds.watch(mode, name)
                first, last = vanishing[leg.number][name], int(name == following)
                if lost is not None and self.itinerary.contacts[lost].guard == name:
                    first = 2 if leg.number == lost else first
                    last = 2 * last if self.itinerary.after(leg.number) == lost else last
                along = Along(leg, name, watch, first, last)
                if self._pieces:
                    longest = self.equations.kinds.longest(mode)
                    window = (windows or {}).get((leg.number, name))
                    found.append(reason(along, lemma, None, longest, window))
                else:
                    found.append(reason(along, lemma, self._minima_of(mode, name)))
        return found

    def least(self, box: Box, name: str) -> Ball:
        """Return an enclosure of the least value of a guard, which all modes have and none meets.

        It is that on the orbits whose contacts lie in a box.  Raises `NotProved` if it is not
        certain where its minima are.
        """
        found = list[Ball]()
        for leg in self.legs(box):
            h = self.along(leg, name)
            found += [h.at(leg.start), h.at(leg.end)]
        for h, time, clock in self.moments(box, name):
            if not h.leg.start.time < time < h.leg.end.time:
                raise h.failed("has a minimum where the leg may end", time, h.height(time, clock))
            found.append(h.height(time, clock))
        return reduce(interval.least, found)

    def moments(self, box: Box, name: str) -> list[tuple[Along, Ball, Clock]]:
        """Return the times at which a guard may have a minimum inside a leg, by Lemma C.

        All modes have the guard.
        """
        found = []
        for leg in self.legs(box):
            minima = self._minima_of(self.itinerary.flown(leg.number), name)
            if minima is None:
                raise NotProved("minima", f"those of the guard '{name}' are not known")
            h = self.along(leg, name)
            found += [(h, time, clock) for time, clock in inside(h, minima)]
        return found

    def along(self, leg: Leg, name: str) -> Along:
        """Return a guard along a leg, at whose ends it does not vanish by an identity."""
        watch = self.equations.kinds.watch(self.itinerary.flown(leg.number), name)
        return Along(leg, name, watch, 0, last=0)

    def legs(self, box: Box) -> list[Leg]:
        """Return the legs of the orbits whose contacts lie in a box."""
        equations, of, n = self.equations, self.balls, self.equations.n
        clocks = {place.here: of.clock(equations.time(box, place)) for place in equations.places}
        found, spans = [], self.spans(box)
        for k, (leg, place) in enumerate(zip(equations.legs, equations.places, strict=True)):
            (here, there, _), (first, last) = place, spans[k]
            before = box[here + 1 : here + n + 1]
            after = of.of(leg.after)(*clocks[here], *before)
            end = End(last, clocks[there], box[there + 1 : there + n + 1])
            cos, sin = clocks[here]
            begin = (-cos, -sin) if equations.is_moved(place) else (cos, sin)
            found.append(Leg(k, End(first, begin, after), end, of))
        return found

    def spans(self, box: Box) -> list[tuple[Ball, Ball]]:
        """Return the times at which the legs begin and end."""
        equations, of = self.equations, self.balls
        return [
            (equations.start(box, place, of), equations.end(box, place, of))
            for place in equations.places
        ]

    def _minima_of(self, mode: str, name: str) -> list[Minimum] | None:
        key = interval.working_bits(), mode, name
        if key not in self._minima:
            lemma = self.equations.kinds.lemmas(mode)[name]
            self._minima[key] = minima(lemma, self.balls)
        return self._minima[key]

    def prove(
        self, guess: Sequence[float], digits: int, far: Fraction | None = None
    ) -> PeriodicOrbit:
        """Prove that there is an orbit near the guess; see the theorem of this module.

        The centre has so many digits, the box reaches ``far`` from it.

        Raises `NotProved` with the step that failed and the sets at which it did.
        """
        near = self.newton(guess)
        hint = zero.refined(self.problem, near, self._inverse(near), [digits] * len(near))
        reach = (far or Fraction(100, 10**digits),) * len(near)
        with interval.workprec(zero.RESIDUAL):  # of 1 - C F' no more is kept
            blocks = self.equations.blocks(hint.box(reach), self.balls)
        box = self._zero(hint, reach, blocks)
        reasons, autonomous = self._in_few_bits(box), self.equations.autonomous
        D = derivative(self.equations.blocks(box, self.balls))
        return PeriodicOrbit(self.itinerary, hint, reach, box, reasons, D, autonomous)

    def _in_few_bits(self, box: Box) -> list[Reason]:
        """Prove what `reasons` does, in few bits where these suffice."""
        if interval.working_bits() > BITS:
            with suppress(NotProved), interval.workprec(BITS):
                return self.reasons(box)
        return self.reasons(box)

    def newton(self, guess: Sequence[float]) -> list[float]:
        """Return a zero of F near a guess, in doubles: the last step is below 1e-10."""
        equations, of = self.equations, self.equations.kinds.floats
        z = np.array(guess, float)
        if z.shape != (equations.size,):
            raise BadInput(f"the guess must be {equations.size} numbers, times and states")
        for _ in range(STEPS):
            step = self._step(z, of)
            z = z - step
            if not np.abs(step).max() < 1e6:
                break
            if np.abs(step).max() < 1e-10 * (1 + np.abs(z).max()):
                return [float(q) for q in z]
        raise NotProved("Newton", "the iteration does not converge near the guess", {"z": list(z)})

    def _step(self, z: Any, of: Floats) -> Any:
        """Return F'(z)^-1 F(z)."""
        at, equations = z.tolist(), self.equations
        try:
            value, blocks = equations.both(at, of)
            return np.linalg.solve(np.array(equations.rows(blocks)), np.array(value))
        except (ArithmeticError, ValueError, np.linalg.LinAlgError):
            raise NotProved("Newton", "F' is singular in doubles", {"z": at}) from None

    def _inverse(self, z: list[float]) -> list[list[float]]:
        """Return F'(z)^-1 in doubles, in units so large that most machines agree on them."""
        equations, of = self.equations, self.equations.kinds.floats
        inverse = np.linalg.inv(np.array(equations.rows(equations.blocks(z, of))))
        if not np.isfinite(inverse).all():
            raise NotProved("preconditioner", "it is beyond floats: the zero may be double")
        rows: list[list[float]] = (np.round(inverse * UNITS) / UNITS).tolist()
        return rows


def prove(itinerary: Itinerary, guess: Sequence[float], digits: int = 10) -> PeriodicOrbit:
    """Prove that a system has a periodic orbit with an itinerary near a guess.

    The guess has the time and the state just before each contact.  See the theorem of this module.
    """
    with interval.workprec(53 + 7 * max(0, digits - 8)):
        return Prover(Equations(itinerary)).prove(guess, digits)
