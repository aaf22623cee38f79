"""The orbits of two masses of which theorems speak: existence, uniqueness, events, derivative.

Lemma 1      one zero of the equations near a guess: a T-periodic orbit with these events
Lemma 2      it has these events only, and no mass stops; collisions preserve the form
conclusion   what the theorem says of its multipliers
Lemma 3      it is the only zero in an explicit box
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from cap.certificate.writer import Pair
from cap.errors import BadInput, NotProved
from cap.maps import zero
from cap.maps.zero import Box, Hint, Problem
from cap.orbits.choice import without_choice
from cap.orbits.equations import Equations
from cap.orbits.free import Free
from cap.orbits.periodic import Prover, contacts_of
from cap.orbits.strobe import Strobe
from cap.particles import contacts
from cap.particles.guess import Guess
from cap.particles.itinerary import itinerary, unknowns
from cap.proofs.fixed_point import Proof, Setting, assembled, inside
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.system.masses import masses

LARGEST = Fraction(1, 8)  # of the box, in the units of the unknowns
ROUNDS = 4  # of bisection, for its size


@dataclass(frozen=True)
class Orbit:
    """A proved orbit: the ``box`` encloses the only zero near the centre of ``hint``.

    It has the times and states just before the contacts.
    """

    setting: Setting
    guess: Guess
    prover: Prover
    free: Free
    hint: Hint
    box: Box

    @property
    def problem(self) -> Problem:
        """The equations by the free unknowns."""
        return self.free.problem(self.prover.balls)

    @property
    def units(self) -> list[Fraction]:
        """The units of these."""
        return units_of(self.setting, self.free)

    @cached_property
    def contacts(self) -> list[tuple[Ball, Box]]:
        """The times of contacts, and the states just before them."""
        return contacts_of(self.prover.itinerary, self.box)

    @cached_property
    def strobe(self) -> Strobe:
        """The period map, at t = 0."""
        return Strobe(self.prover.equations, self.prover.balls, self.contacts, Fraction(0))

    def jet(self, order: int) -> list[Jet]:
        """Return jets, in the deviation at t = 0, of the deviation a period later."""
        return [jet.above(0) for jet in self.strobe.jet(order)]

    @cached_property
    def monodromy(self) -> list[list[Ball]]:
        """The derivative of the period map at t = 0."""
        return [jet.coefficients[1:] for jet in self.jet(1)]

    @property
    def masses(self) -> list[Ball]:
        """The masses, enclosed."""
        return [interval.ball(m) for m in self.guess.masses]

    @property
    def inertia(self) -> Fraction:
        """The unit m R² ω of the actions, m the first mass."""
        return self.guess.masses[0] * self.setting.units.area


Conclusion = Callable[[Orbit], dict[str, Any]]
"""What a theorem says more of the orbit: claims."""


def proof_of(theorem: str, setting: Setting, conclusion: Conclusion) -> Proof:
    """Prove a theorem on an orbit of two masses up to the size of its box.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    guess, strings = system(theorem, setting)
    with interval.workprec(setting.bits):
        orbit = located(setting, guess)
        claims = _claims(orbit) | conclusion(orbit)
        size = lemma_3_uniqueness(orbit)

    def certified(part: Fraction) -> dict[str, Any]:
        box = {"box": _box(orbit, part * size)}
        return assembled(theorem, setting, strings, (box | claims, hints(orbit)))

    return certified


def system(theorem: str, setting: Setting) -> tuple[Guess, dict[str, Any]]:
    """Return the guess, and the parameters for the certificate, of a theorem on two masses."""
    guess = setting.particles
    if len(guess.masses) != 2:
        raise BadInput(f"{theorem} is about two masses: give them, as --masses 1,9/10")
    return guess, setting.parameters.elastic_strings() | {"masses": [str(m) for m in guess.masses]}


def located(setting: Setting, guess: Guess) -> Orbit:
    """Prove Lemmas 1 and 2, at the current precision."""
    contacts.never_rest(guess)
    orbit = solved(setting, guess)
    lemma_2_flights(orbit)
    return orbit


def solved(setting: Setting, guess: Guess) -> Orbit:
    """Prove Lemma 1, at the current precision."""
    system = masses(setting.parameters, guess.masses)
    prover = Prover(Equations(itinerary(system, guess)))
    free = Free(prover.equations, unknowns(guess))
    problem, start = free.problem(prover.balls), list(map(Fraction, free.of(unknowns(guess))))
    hint, box = lemma_1_existence(setting, problem, units_of(setting, free), start)
    return Orbit(setting, guess, prover, free, hint, tuple(free.whole(box)))


def lemma_1_existence(
    setting: Setting, problem: Problem, units: Sequence[Fraction], guess: Sequence[Fraction]
) -> tuple[Hint, Box]:
    """*Statement.* The equations of `cap.orbits.free` have a zero near the guess.

    *Computed.* Krawczyk's inclusion for the points m within 10^(2 - digits), in the units of the
    unknowns, of a point refined by Newton's iteration.
    """
    matrix = zero.inverse_of(problem.slope([interval.ball(q) for q in guess]))
    places = [setting.precise - interval.decade(unit) for unit in units]
    hint = zero.refined(problem, guess, matrix, places)
    box = problem.isolate(hint, [radius_of(setting) * unit for unit in units])
    return hint, problem.tightened(hint, box)


def lemma_2_flights(orbit: Orbit) -> None:
    """*Statement.* The orbit has these events and no others, and no mass ever stops.  The period
    map preserves Σ m_i dv_i ∧ dx_i near it.

    *Computed.* See `cap.orbits.quiet`, `cap.orbits.choice` and `cap.particles.contacts`.
    """
    contacts.signs_are_kept(orbit.prover.itinerary)
    nothing_else(orbit)


def nothing_else(orbit: Orbit) -> None:
    """Prove that the orbit has these events and no others, and so have motions near it."""
    orbit.prover.reasons(orbit.box)
    without_choice(orbit.prover, orbit.box)


def lemma_3_uniqueness(orbit: Orbit) -> Fraction:
    """*Statement.* The orbit is the only one with this itinerary whose events lie in a box.

    *Computed.* Krawczyk's inclusion for the largest box found, of half-widths a multiple of the
    units of the unknowns; the multiple is returned.  Directions are certain in it: so the checker
    asks.  A smaller box that contains the orbit will do.
    """
    problem, hint, free, units = orbit.problem, orbit.hint, orbit.free, orbit.units

    def attempt(size: Fraction) -> None:
        reach = [size * unit for unit in units]
        contacts.directions(orbit.prover, tuple(free.whole(hint.box(reach))))
        problem.isolate(hint, reach)

    size = bisection.largest(attempt, LARGEST, ROUNDS)
    if size is None:
        raise NotProved("Lemma 3", "no box around the orbit succeeded", {})
    return size


def radius_of(setting: Setting) -> Fraction:
    """Return the half-width, in the units of the unknowns, of the box that holds the zero."""
    return Fraction(100, 10**setting.precise)


def units_of(setting: Setting, free: Free) -> list[Fraction]:
    """Return the units of the unknowns: times, places, velocities."""
    units = {"x": setting.units.length, "v": setting.units.speed}
    return [q for names in free.names for q in (setting.units.time, *(units[z[0]] for z in names))]


def _box(orbit: Orbit, size: Fraction) -> list[dict[str, Pair]]:
    """Return the box claimed, within ``size`` units of the centre of the hint."""
    centre = orbit.hint.centre
    halves = [size * unit for unit in orbit.units]
    pairs = [inside(c, half) for c, half in zip(centre, halves, strict=True)]
    return [dict(zip(("t", "x", "v1", "v2"), each, strict=True)) for each in by_event(pairs)]


def hints(orbit: Orbit) -> dict[str, Any]:
    """Return what the checker needs and does not trust."""
    exact, hint = interval.exact_decimal, orbit.hint
    return {
        "bits": str(orbit.setting.checker_bits),
        "centre": centre_of(hint),
        "radius": exact(radius_of(orbit.setting)),
        "preconditioner": [[exact(q) for q in row] for row in hint.matrix],
    }


def centre_of(hint: Hint) -> list[list[str]]:
    """Return the centre of a hint, a list for each event."""
    return by_event([interval.exact_decimal(q) for q in hint.centre])


def by_event(values: Sequence[Any]) -> list[list[Any]]:
    """Return values of the unknowns, a list for each event."""
    return [list(values[k : k + 4]) for k in range(0, len(values), 4)]


def _claims(orbit: Orbit) -> dict[str, Any]:
    """Return the claims on the orbit and its derivative, rounded outwards."""
    units, pair, point = orbit.setting.units, orbit.setting.rounding.pair, orbit.strobe.point
    n = len(point) // 2
    closing = contacts.closing_speeds(orbit.prover, orbit.contacts)
    least = contacts.least_speeds(orbit.prover, orbit.box)
    return {
        "itinerary": [word for word, *_ in orbit.guess.events],
        "x": [pair(q, units.length) for q in point[:n]],
        "v": [pair(q, units.speed) for q in point[n:]],
        "hit_times": [pair(t, units.time) for t, _ in orbit.contacts],
        "closing_speeds": [pair(q, units.speed) for q in closing],
        "least_speeds": [pair(q, units.speed) for q in least],
        "monodromy": _monodromy(orbit),
    }


def _monodromy(orbit: Orbit) -> list[list[Pair]]:
    """Return D, after a check of the computation: Dᵀ J D - J contains 0."""
    pair, D, n = orbit.setting.rounding.pair, orbit.monodromy, len(orbit.masses)
    defect = contacts.symplectic_defect(orbit.masses, D)
    if not all(q.contains(0) for q in defect):
        raise NotProved("Lemma 2", "the derivative does not preserve the form", {"D": defect[0]})
    time = orbit.setting.units.time
    units = [[time ** ((j >= n) - (i >= n)) for j in range(2 * n)] for i in range(2 * n)]
    return [
        [pair(q, unit) for q, unit in zip(*rows, strict=True)]
        for rows in zip(D, units, strict=True)
    ]
