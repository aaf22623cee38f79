"""Theorem (particles_sink).  Let two masses m_1, m_2 move between two walls, T = 2π/ω,

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= x_2 <= r,   elastic walls and collisions,

at rational parameters, and let an orbit of period nT be guessed, on which masses may turn, stick,
be released, and be hit while they rest.  If the lemmas below succeed, then

 (i)   there is exactly one orbit of period nT with these events, in this order, whose events lie in
       an explicit box;
 (ii)  it attracts all orbits that begin near enough to its state at t = 0.

Proof.  Lemmas 1 and 3: Krawczyk's inclusion for the equations of the contacts (`cap.orbits.free`)
of the system `cap.system.masses`.  Lemma 2: nothing else happens (`cap.orbits.quiet`), and motions
near the orbit go on as it does (`cap.orbits.choice`), so the map over nT is continuously
differentiable there; Lemma 4: a power of its derivative (`cap.orbits.strobe`) contracts.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from cap.certificate import writer
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps import zero
from cap.maps.zero import Box, Hint, Problem
from cap.orbits.choice import without_choice
from cap.orbits.equations import Equations
from cap.orbits.free import Free
from cap.orbits.periodic import Prover, contacts_of
from cap.orbits.strobe import Strobe
from cap.particles.itinerary import itinerary, unknowns
from cap.particles.model import Guess
from cap.proofs.fixed_point import Proof, Setting, assembled, inside
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_orbit import LARGEST, ROUNDS, radius_of, system
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.system.masses import masses

SUMMARY = "an attracting periodic orbit, on which masses turn, stick, and are hit"
GROUP = "masses"
SEARCH = candidates.attracting
OPTIONS = OF_MASSES
POWERS = (1, 2, 4, 8, 16, 32, 64)


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    guess, strings = system("particles_sink", setting)
    with interval.workprec(setting.bits):
        model = masses(setting.parameters, guess.masses)
        prover = Prover(Equations(itinerary(model, guess)))
        free = Free(prover.equations, unknowns(guess))
        problem, units = free.problem(prover.balls), units_of(setting, free)
        start = [Fraction(q) for q in free.of(unknowns(guess))]
        hint, box = lemma_1_existence(setting, problem, units, start)
        round_of = lemma_2_events(prover, tuple(free.whole(box)))
        claims = _claims(setting, guess, round_of)
        claims |= lemma_4_contraction(setting, round_of)
        size = lemma_3_uniqueness(problem, hint, units)

    def certified(part: Fraction) -> dict[str, Any]:
        halves = [part * size * unit for unit in units]
        box = [inside(c, half) for c, half in zip(hint.centre, halves, strict=True)]
        content = claims | {"box": _by_event(box)}
        return assembled("particles_sink", setting, strings, (content, _hints(setting, hint)))

    return certified


def units_of(setting: Setting, free: Free) -> list[Fraction]:
    """Return the units of the unknowns: times, places, velocities."""
    units = {"x": setting.units.length, "v": setting.units.speed}
    return [q for names in free.names for q in (setting.units.time, *(units[z[0]] for z in names))]


def lemma_1_existence(
    setting: Setting, problem: Problem, units: Sequence[Fraction], guess: Sequence[Fraction]
) -> tuple[Hint, Box]:
    """*Statement.* The equations have a zero near the guess.

    *Computed.* Krawczyk's inclusion near a point refined by Newton's iteration.
    """
    matrix = zero.inverse_of(problem.slope([interval.ball(q) for q in guess]))
    places = [setting.precise - interval.decade(unit) for unit in units]
    hint = zero.refined(problem, guess, matrix, places)
    box = problem.isolate(hint, [radius_of(setting) * unit for unit in units])
    return hint, problem.tightened(hint, box)


def lemma_2_events(prover: Prover, box: Box) -> Strobe:
    """*Statement.* The orbit has these events and no others; so have those near it.

    Returns the map over nT near it.
    """
    prover.reasons(box)
    without_choice(prover, box)
    contacts = contacts_of(prover.itinerary, box)
    return Strobe(prover.itinerary, contacts, prover.equations.kinds, Fraction(0))


def lemma_3_uniqueness(problem: Problem, hint: Hint, units: Sequence[Fraction]) -> Fraction:
    """*Statement.* It is the only zero in a box.

    Returns its half-widths, as a multiple of the units of the unknowns.
    """

    def attempt(size: Fraction) -> None:
        problem.isolate(hint, [size * unit for unit in units])

    size = bisection.largest(attempt, LARGEST, ROUNDS)
    if size is None:
        raise NotProved("Lemma 3", "no box around the orbit succeeded", {})
    return size


def lemma_4_contraction(setting: Setting, around: Strobe) -> dict[str, Any]:
    """*Statement.* A power of the derivative contracts in the coordinates x/R, v/(Rω).

    *Computed.* The greatest sum of absolute values in a row, for powers of two.
    """
    omega = interval.ball(setting.parameters.omega)
    D = derivative(around)
    for i in (0, 1):
        D[i][2:] = [q * omega for q in D[i][2:]]
        D[2 + i][:2] = [q / omega for q in D[2 + i][:2]]
    for power in POWERS:
        sums = [interval.total(map(abs, row)) for row in D]
        if all(2 * q < 1 for q in sums):
            bounds = [writer.bound(q * (1 + interval.rounding())) for q in sums]
            return {"power": str(power), "contraction": max(bounds, key=Fraction)}
        D = [[interval.total(a * D[k][j] for k, a in enumerate(row)) for j in range(4)]
             for row in D]  # fmt: skip
    raise NotProved("Lemma 4", "no power of the derivative contracts", {"row": sums[0]})


def derivative(around: Strobe) -> list[list[Ball]]:
    """Return the derivative of a map at its fixed point, by rows."""
    return [jet.coefficients[1:] for jet in around.jet(1)]


def _claims(setting: Setting, guess: Guess, around: Strobe) -> dict[str, Any]:
    """Return the claims on the orbit, rounded outwards."""
    pair, units = setting.rounding.pair, setting.units
    x, v = around.point[:2], around.point[2:]
    return {
        "period": str(guess.periods),
        "itinerary": [word for word, *_ in guess.events],
        "x": [pair(q, units.length) for q in x],
        "v": [pair(q, units.speed) for q in v],
        "event_times": [pair(t, units.time) for t, _ in around.contacts],
    }


def _hints(setting: Setting, hint: Hint) -> dict[str, Any]:
    exact = interval.exact_decimal
    return {
        "bits": str(setting.checker_bits),
        "centre": _by_event([exact(q) for q in hint.centre]),
        "radius": exact(radius_of(setting)),
        "preconditioner": [[exact(q) for q in row] for row in hint.matrix],
    }


def _by_event(values: Sequence[Any]) -> list[list[Any]]:
    return [list(values[k : k + 4]) for k in range(0, len(values), 4)]
