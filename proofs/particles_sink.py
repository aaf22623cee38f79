"""Theorem (particles_sink).  Let two masses m_1, m_2 move between two walls, T = 2π/ω,

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= x_2 <= r,   elastic walls and collisions,

at rational parameters, and let an orbit of period nT be guessed, on which masses may turn, stick,
be released, and be hit while they rest.  If the lemmas below succeed, then

 (i)   there is exactly one orbit of period nT with these events, in this order, whose events lie in
       an explicit box;
 (ii)  it attracts all orbits that begin near enough to its state at t = 0.

Proof.  Lemmas 1 and 3: Krawczyk's inclusion for the equations between events.  Lemma 2: nothing
else happens (`cap.particles.stays`).  Its inequalities are strict, so the map over nT is
continuously differentiable near the orbit; Lemma 4: a power of its derivative there contracts.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from cap.certificate import writer
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps import zero
from cap.maps.zero import Hint, Problem
from cap.particles import stays
from cap.particles.model import Model
from cap.particles.stopping import Equations, Happening, unit_powers, unknowns, words_of
from cap.proofs.fixed_point import Proof, Setting, assembled, inside
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_orbit import LARGEST, ROUNDS, radius_of, system
from cap.sets import bisection, interval

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
        model = Model(setting.parameters, guess.masses)
        equations = Equations(model, tuple(words_of(model, guess)), guess.periods)
        problem = Problem(equations.value, equations.slope)
        units = _units(setting, equations)
        start = [Fraction(q) for q in unknowns(equations.words, guess)]
        hint, events = lemma_1_existence(setting, equations, problem, start)
        stays.verify(equations, events)
        claims = _claims(setting, equations, events) | lemma_4_contraction(equations, events)
        size = lemma_3_uniqueness(problem, hint, units)

    def certified(part: Fraction) -> dict[str, Any]:
        halves = [part * size * unit for unit in units]
        box = [inside(c, half) for c, half in zip(hint.centre, halves, strict=True)]
        content = claims | {"box": _by_event(box)}
        return assembled("particles_sink", setting, strings, (content, _hints(setting, hint)))

    return certified


def _units(setting: Setting, equations: Equations) -> list[Fraction]:
    units = setting.units
    sizes = {"time": units.time, "length": units.length, "speed": units.speed}
    return [sizes[kind] for kinds in unit_powers(equations.words) for kind in kinds]


def lemma_1_existence(
    setting: Setting, equations: Equations, problem: Problem, guess: list[Fraction]
) -> tuple[Hint, list[Happening]]:
    """*Statement.* The equations have a zero near the guess.

    *Computed.* Krawczyk's inclusion near a point refined by Newton's iteration; the events of the
    zero are enclosed.
    """
    units = _units(setting, equations)
    matrix = zero.inverse_of(problem.slope([interval.ball(q) for q in guess]))
    places = [setting.precise - interval.decade(unit) for unit in units]
    hint = zero.refined(problem, guess, matrix, places)
    box = problem.isolate(hint, [radius_of(setting) * unit for unit in units])
    return hint, equations.happenings(problem.tightened(hint, box))


def lemma_3_uniqueness(problem: Problem, hint: Hint, units: Sequence[Fraction]) -> Fraction:
    """*Statement.* It is the only zero in a box, in which directions are certain.

    Returns its half-widths, as a multiple of the units of the unknowns.
    """

    def attempt(size: Fraction) -> None:
        problem.isolate(hint, [size * unit for unit in units])

    size = bisection.largest(attempt, LARGEST, ROUNDS)
    if size is None:
        raise NotProved("Lemma 3", "no box around the orbit succeeded", {})
    return size


def lemma_4_contraction(equations: Equations, events: Sequence[Happening]) -> dict[str, Any]:
    """*Statement.* A power of the derivative contracts in the coordinates x/R, v/(Rω).

    *Computed.* The greatest sum of absolute values in a row, for powers of two.
    """
    omega = interval.ball(equations.model.parameters.omega)
    D = stays.derivative(equations, events)
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


def _claims(setting: Setting, equations: Equations, events: Sequence[Happening]) -> dict[str, Any]:
    """Return the claims on the orbit, rounded outwards."""
    pair, units = setting.rounding.pair, setting.units
    o = equations.model.first
    last = equations.stretches(events)[-1]
    x, v = last.reached(o.moment(interval.ZERO)._replace(t=equations.whole))
    return {
        "period": str(equations.periods),
        "itinerary": [word.word for word in equations.words],
        "x": [pair(q, units.length) for q in x],
        "v": [pair(q, units.speed) for q in v],
        "event_times": [pair(event.at.t, units.time) for event in events],
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
