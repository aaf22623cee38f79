"""Theorem (particles_limits).  Let two masses m_1 = m and m_2 move between two walls, T = 2π/ω,

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= x_2 <= r,   elastic walls and collisions,

at rational F, ω, f, l, r and m.  Let z_1 > z_2 be the reduced traces λ + 1/λ of a T-periodic orbit
on which no mass stops.  If the lemmas below succeed, then there are intervals `flip` and `stop` of
masses m_2, a box for each, and one itinerary, such that

 (i)   for each m_2 in `flip` there is exactly one T-periodic orbit with the itinerary whose events
       lie in the box, it depends analytically on m_2, and on it no mass stops.  At the upper end it
       is elliptic, both pairs of multipliers on the unit circle and simple; at the lower end one
       pair is real and negative, z_2 < -2.  So for some m_2 in `flip` one multiplier is -1;
 (ii)  for each m_2 in `stop` the equations of the flights between these events have exactly one
       solution in the box, which depends analytically on m_2.  At the upper end it is an orbit on
       which no mass stops; at the lower end a velocity has changed its sign inside of a flight.  So
       for some m_2 in `stop`, the largest one, the least speed of the orbit is 0: a mass comes to
       rest for an instant;
 (iii) for all m_2 between the two intervals there is exactly one such orbit, and no mass stops on
       it, in a box that depends on m_2; these orbits and those of (i) and (ii) are one analytic
       family.  Nothing is said of their multipliers, nor of m_2 between `flip` and m.

Proof.  Krawczyk's inclusion for all m_2 of an interval at once, and for both its ends, in smaller
boxes inside; the reduced traces and the least speeds depend continuously on m_2.  For (iii) the
masses between are divided into cells; neighbouring cells have the solution at the node between them
in common.  Velocities at critical moments are positive by the mean value theorem: from that at the
lower end of a cell, and their derivatives by m_2 along the family.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap.certificate.writer import Pair
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.maps import twist_matrix
from cap.maps.zero import Box
from cap.orbits.periodic import Prover, contacts_of
from cap.orbits.strobe import Strobe
from cap.particles import contacts
from cap.particles.guess import Guess
from cap.particles.itinerary import unknowns
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_cells import NODE, REACH_OF_CELLS, Line, Masses, Solved, family
from cap.proofs.particle_orbit import centre_of, lemma_1_existence, radius_of
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "one mass made lighter: where the orbit is no more elliptic, and where a mass stops"
GROUP = "masses"
SEARCH = candidates.lighter
OPTIONS = OF_MASSES

REACH = Fraction(1, 10**8)  # half-width of the box for an interval of masses, in its units
ROUNDS = 40  # of the secant method
Quantity = Callable[[Solved], Ball]


@dataclass(frozen=True)
class Crossing:
    """Masses at which a quantity is negative and positive; the orbits of all between them."""

    lower: Solved
    upper: Solved
    prover: Prover
    box: Box


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    guess = setting.particles
    if len(guess.further) != 1:
        raise BadInput("particles_limits begins with two equal masses: give --masses M,M, as 1,1")
    mass, (last,) = guess.masses[0], guess.further
    strings: dict[str, Any] = setting.parameters.elastic_strings()
    strings["masses"] = [str(mass)] * 2
    with interval.workprec(setting.bits):
        masses = Masses.of(setting, guess)
        flip, stop = lemma_1_flip(masses, guess), lemma_2_stop(masses, last)
        line = Line.between(masses, flip.lower, stop.upper)
        between = lemma_3_family(line)
        claims = {
            "itinerary": [word for word, *_ in guess.events],
            "flip": _claim(setting, mass, flip),
            "stop": _claim(setting, mass, stop),
        }
        hints = {
            "bits": str(setting.checker_bits),
            "radius": interval.exact_decimal(radius_of(setting)),
            "reach": interval.exact_decimal(REACH),
            "flip": _hints(flip),
            "stop": _hints(stop),
            "middle": [[interval.exact_decimal(q) for q in row] for row in line.middle],
            "nodes": [
                {"mass": interval.exact_decimal(node.mass), "centre": centre_of(node.hint)}
                for node in between
            ],
            "node_radius": interval.exact_decimal(NODE),
            "cell_reach": interval.exact_decimal(REACH_OF_CELLS),
        }
    return settled("particles_limits", setting, strings, (claims, hints))


def lemma_1_flip(masses: Masses, guess: Guess) -> Crossing:
    """*Statement.* (i).  *Computed.* z_2 + 2 at both ends; flights and signs over all masses."""
    crossing = _crossing(masses, guess, _beyond_minus_one)
    contacts.no_other_contacts(crossing.prover, crossing.box)
    crossing.prover.reasons(crossing.box)
    for end in (crossing.lower, crossing.upper):
        high, low = _reduced_traces(end)
        if not (-2 < high < 2 and low < 2):
            sets = {"z_1": high, "z_2": low}
            raise NotProved("Lemma 1", "the other pair may not be on the unit circle", sets)
    return crossing


def lemma_2_stop(masses: Masses, guess: Guess) -> Crossing:
    """*Statement.* (ii).  *Computed.* the speed at the slow moment of a flight at which it is the
    least near the guess, at both ends; contacts over all masses, and all speeds at the upper end.
    """
    near = _solved(masses, guess.masses[1], guess, None)
    speeds = _slow_speeds(near)
    slowest = min(range(len(speeds)), key=lambda k: interval.midpoint(speeds[k]))
    crossing = _crossing(masses, guess, lambda solved: _slow_speeds(solved)[slowest])
    contacts.no_other_contacts(crossing.prover, crossing.box)
    contacts.speeds_at_contacts(crossing.prover, crossing.box)
    crossing.upper.prover.reasons(crossing.upper.box)
    return crossing


def lemma_3_family(line: Line) -> list[Solved]:
    """*Statement.* (iii).  *Computed.* See `cap.proofs.particle_cells`; the preconditioner is
    interpolated between those of (i), (ii) and of the middle.
    """
    return family(line)


def _beyond_minus_one(solved: Solved) -> Ball:
    """Return z_2 + 2."""
    return _reduced_traces(solved)[1] + 2


def _reduced_traces(solved: Solved) -> tuple[Ball, Ball]:
    """Return z_1 and z_2."""
    equations = solved.prover.equations
    met = contacts_of(equations.itinerary, solved.box)
    strobe = Strobe(equations, solved.prover.balls, met, Fraction(0))
    high, low = twist_matrix.reduced_traces([jet.coefficients[1:] for jet in strobe.jet(1)])
    return high, low


def _slow_speeds(solved: Solved) -> list[Ball]:
    """Return the speeds at the moments inside of flights at which they are smallest.

    Raises `NotProved` if one may be at an event.
    """
    found = []
    for name in contacts.stops(solved.prover):
        for h, time, clock in solved.prover.moments(solved.box, name):
            if not h.leg.start.time < time < h.leg.end.time:
                sets = {"critical": time, "flight from": h.leg.start.time, "to": h.leg.end.time}
                raise NotProved("flight", "a speed may be critical at an event", sets)
            found.append(h.height(time, clock))
    return found


def _solved(masses: Masses, mass: Fraction, guess: Guess, near: Solved | None) -> Solved:
    """Prove that the equations have a zero for this second mass, near that for another."""
    free = masses.free
    start = list(near.hint.centre) if near else list(map(Fraction, free.of(unknowns(guess))))
    return masses.solved(
        mass, *lemma_1_existence(masses.setting, masses.problem(mass), masses.units, start)
    )


def _crossing(masses: Masses, guess: Guess, quantity: Quantity) -> Crossing:
    """Find neighbouring masses between which a quantity changes its sign, and prove it.

    It is found by the secant method.
    """
    places = masses.setting.digits + 1 - interval.decade(masses.m)

    def solved(mass: Fraction, near: Solved | None) -> Solved:
        return _solved(masses, mass, guess, near)

    here = solved(guess.masses[1], None)
    there = solved(here.mass - masses.m / 10**6, here)
    values = [interval.midpoint(quantity(each)) for each in (here, there)]
    for _ in range(ROUNDS):
        slope = (values[1] - values[0]) / (there.mass - here.mass)
        if not slope:
            break
        mass = round(there.mass - values[1] / slope, places + 5)
        if abs(mass - there.mass) * 10 ** (places + 2) < 1:
            break
        here, there = there, solved(mass, there)
        values = [values[1], interval.midpoint(quantity(there))]
    unit = Fraction(1, 10**places)
    lower = (there.mass - unit / 2) // unit * unit
    return _proved(masses, quantity, (solved(lower, there), solved(lower + 2 * unit, there)))


def _proved(masses: Masses, quantity: Quantity, ends: tuple[Solved, Solved]) -> Crossing:
    """Prove that a quantity changes its sign, along one family of zeros."""
    lower, upper = ends
    values = [quantity(each) for each in ends]
    if not values[0] < 0 < values[1]:
        sets = {"below": values[0], "above": values[1]}
        raise NotProved("crossing", "no change of sign between two masses", sets)
    reach = [REACH * unit for unit in masses.units]
    prover = masses.prover(interval.hull(*(interval.ball(end.mass) for end in ends)))
    K = masses.free.problem(prover.balls).isolate(upper.hint, reach)
    small = [radius_of(masses.setting) * unit for unit in masses.units]
    for end in ends:
        sides = zip(end.hint.centre, upper.hint.centre, small, reach, strict=True)
        if not all(abs(c - m) + r < far for c, m, r, far in sides):
            raise NotProved("crossing", "the zeros at the ends may be others", {})
    return Crossing(lower, upper, prover, tuple(masses.free.whole(K)))


def _claim(setting: Setting, mass: Fraction, crossing: Crossing) -> Pair:
    """Return the interval of masses, exactly."""
    places = setting.digits + 1 - interval.decade(mass)
    return [interval.decimal(end.mass, max(places, 0)) for end in (crossing.lower, crossing.upper)]


def _hints(crossing: Crossing) -> dict[str, Any]:
    exact = interval.exact_decimal
    return {
        "lower": centre_of(crossing.lower.hint),
        "upper": centre_of(crossing.upper.hint),
        "preconditioner": [[exact(q) for q in row] for row in crossing.upper.hint.matrix],
    }
