"""The orbits of two masses of which theorems speak: existence, uniqueness, events, derivative.

Lemma 1      one zero of the equations near a guess: a T-periodic orbit with these events
Lemma 2      it has these events only, and no mass stops; collisions preserve the form
conclusion   what the theorem says of its multipliers
Lemma 3      it is the only zero in an explicit box
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from typing import Any

from cap.certificate.writer import Pair
from cap.errors import BadInput, NotProved
from cap.maps import zero
from cap.maps.zero import Box, Hint, Problem
from cap.particles import derivative, equations, flights
from cap.particles.model import Event, Guess, Model, events_of
from cap.proofs.fixed_point import Proof, Setting, assembled, inside
from cap.sets import bisection, interval
from cap.sets.interval import Ball

LARGEST = Fraction(1, 8)  # of the box, in the units of the unknowns
ROUNDS = 4  # of bisection, for its size


@dataclass(frozen=True)
class Orbit:
    """A proved orbit: its ``events`` enclose the only zero near the centre of ``hint``."""

    setting: Setting
    model: Model
    contacts: tuple[int, ...]
    problem: Problem
    hint: Hint
    events: list[Event]
    least_speeds: list[Ball]

    @cached_property
    def monodromy(self) -> list[list[Ball]]:
        """The derivative of the period map at t = 0."""
        return derivative.monodromy(self.model, self.events)

    @property
    def masses(self) -> list[Ball]:
        """The masses, enclosed."""
        return [interval.ball(m) for m in self.model.masses]

    @property
    def inertia(self) -> Fraction:
        """The unit m R² ω of the actions, m the first mass."""
        return self.model.masses[0] * self.setting.units.area


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
        return assembled(theorem, setting, strings, (box | claims, _hints(orbit)))

    return certified


def system(theorem: str, setting: Setting) -> tuple[Guess, dict[str, Any]]:
    """Return the guess, and the parameters for the certificate, of a theorem on two masses."""
    guess = setting.particles
    if len(guess.masses) != 2:
        raise BadInput(f"{theorem} is about two masses: give them, as --masses 1,9/10")
    return guess, setting.parameters.elastic_strings() | {"masses": [str(m) for m in guess.masses]}


def located(setting: Setting, guess: Guess) -> Orbit:
    """Prove Lemmas 1 and 2, at the current precision."""
    model = Model(setting.parameters, guess.masses)
    contacts = tuple(model.contact(word) for word, *_ in guess.events)
    problem = problem_of(model, contacts)
    hint, box = lemma_1_existence(setting, problem, unknowns(model, guess))
    events = events_of(model, contacts, box)
    least = lemma_2_flights(model, events)
    return Orbit(setting, model, contacts, problem, hint, events, least)


def problem_of(model: Model, contacts: tuple[int, ...]) -> Problem:
    """Return the equations of the orbits with these contacts."""
    return Problem(
        partial(equations.value, model, contacts), partial(equations.slope, model, contacts)
    )


def lemma_1_existence(
    setting: Setting, problem: Problem, guess: list[Fraction]
) -> tuple[Hint, Box]:
    """*Statement.* The equations of `cap.particles.equations` have a zero near the guess.

    *Computed.* Krawczyk's inclusion for the points m within 10^(2 - digits), in the units of the
    unknowns, of a point refined by Newton's iteration.
    """
    units = units_of(setting, len(guess))
    point = [interval.ball(q) for q in guess]
    matrix = zero.inverse_of(problem.slope(point))
    places = [setting.precise - interval.decade(unit) for unit in units]
    hint = zero.refined(problem, guess, matrix, places)
    box = problem.isolate(hint, [radius_of(setting) * unit for unit in units])
    return hint, problem.tightened(hint, box)


def lemma_2_flights(model: Model, events: list[Event]) -> list[Ball]:
    """*Statement.* The orbit has these events and no others, and no mass ever stops.  The period
    map preserves Σ m_i dv_i ∧ dx_i near it.

    *Computed.* See `cap.particles.flights`.
    """
    least = flights.least_speeds(model, events)
    flights.signs_are_conserved(model, events)
    return least


def lemma_3_uniqueness(orbit: Orbit) -> Fraction:
    """*Statement.* The orbit is the only one with this itinerary whose events lie in a box.

    *Computed.* Krawczyk's inclusion for the largest box found, of half-widths a multiple of the
    units of the unknowns; the multiple is returned.  A smaller box that contains the orbit will do.
    """
    units = units_of(orbit.setting, len(orbit.hint.centre))

    def attempt(size: Fraction) -> None:
        orbit.problem.isolate(orbit.hint, [size * unit for unit in units])

    size = bisection.largest(attempt, LARGEST, ROUNDS)
    if size is None:
        raise NotProved("Lemma 3", "no box around the orbit succeeded", {})
    return size


def radius_of(setting: Setting) -> Fraction:
    """Return the half-width, in the units of the unknowns, of the box that holds the zero."""
    return Fraction(100, 10**setting.precise)


def units_of(setting: Setting, size: int) -> list[Fraction]:
    """Return the units of the unknowns: of a time, a place and two velocities for each event."""
    units = setting.units
    return [units.time, units.length, units.speed, units.speed] * (size // 4)


def unknowns(model: Model, guess: Guess) -> list[Fraction]:
    """Return the unknowns of a guess."""
    found = list[float]()
    for word, t, x, v in guess.events:
        place = model.place_of(model.contact(word))
        found += [t, *(x[place.index(k)] for k in range(model.n - 1)), *v]
    return [Fraction(q) for q in found]


def _box(orbit: Orbit, size: Fraction) -> list[dict[str, Pair]]:
    """Return the box claimed, within ``size`` units of the centre of the hint."""
    centre = orbit.hint.centre
    halves = [size * unit for unit in units_of(orbit.setting, len(centre))]
    pairs = [inside(c, half) for c, half in zip(centre, halves, strict=True)]
    return [
        dict(zip(("t", "x", "v1", "v2"), pairs[k : k + 4], strict=True))
        for k in range(0, len(pairs), 4)
    ]


def _hints(orbit: Orbit) -> dict[str, Any]:
    exact, hint = interval.exact_decimal, orbit.hint
    return {
        "bits": str(orbit.setting.checker_bits),
        "centre": by_event(hint),
        "radius": exact(radius_of(orbit.setting)),
        "preconditioner": [[exact(q) for q in row] for row in hint.matrix],
    }


def by_event(hint: Hint) -> list[list[str]]:
    """Return the centre of a hint, a list for each event."""
    centre = [interval.exact_decimal(q) for q in hint.centre]
    return [centre[k : k + 4] for k in range(0, len(centre), 4)]


def _claims(orbit: Orbit) -> dict[str, Any]:
    """Return the claims on the orbit and its derivative, rounded outwards."""
    model, events, units = orbit.model, orbit.events, orbit.setting.units
    pair = orbit.setting.rounding.pair
    x, v = derivative.state(model, events)
    return {
        "itinerary": [model.word(contact) for contact in orbit.contacts],
        "x": [pair(q, units.length) for q in x],
        "v": [pair(q, units.speed) for q in v],
        "hit_times": [pair(event.at.t, units.time) for event in events],
        "closing_speeds": [pair(flights.closing_speed(model, e), units.speed) for e in events],
        "least_speeds": [pair(q, units.speed) for q in orbit.least_speeds],
        "monodromy": _monodromy(orbit),
    }


def _monodromy(orbit: Orbit) -> list[list[Pair]]:
    """Return D, after a check of the computation: Dᵀ J D - J contains 0."""
    n, pair, D = orbit.model.n, orbit.setting.rounding.pair, orbit.monodromy
    defect = derivative.symplectic_defect(orbit.model, D)
    if not all(q.contains(0) for q in defect):
        raise NotProved("Lemma 2", "the derivative does not preserve the form", {"D": defect[0]})
    time = orbit.setting.units.time
    units = [[time ** ((j >= n) - (i >= n)) for j in range(2 * n)] for i in range(2 * n)]
    return [
        [pair(q, unit) for q, unit in zip(*rows, strict=True)]
        for rows in zip(D, units, strict=True)
    ]
