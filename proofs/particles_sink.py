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

from fractions import Fraction
from typing import Any

from cap.certificate import writer
from cap.errors import NotProved
from cap.floats import candidates
from cap.proofs.fixed_point import Proof, Setting, assembled, inside
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_orbit import (
    Orbit,
    by_event,
    hints,
    lemma_3_uniqueness,
    nothing_else,
    solved,
    system,
)
from cap.sets import interval
from cap.sets.interval import Ball

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
        orbit = solved(setting, guess)
        nothing_else(orbit)
        claims = _claims(orbit) | lemma_4_contraction(setting, orbit.monodromy)
        size = lemma_3_uniqueness(orbit)

    def certified(part: Fraction) -> dict[str, Any]:
        halves, hint = [part * size * unit for unit in orbit.units], orbit.hint
        box = [inside(c, half) for c, half in zip(hint.centre, halves, strict=True)]
        content = claims | {"box": by_event(box)}, hints(orbit)
        return assembled("particles_sink", setting, strings, content)

    return certified


def lemma_4_contraction(setting: Setting, D: list[list[Ball]]) -> dict[str, Any]:
    """*Statement.* A power of the derivative contracts in the coordinates x/R, v/(Rω).

    *Computed.* The greatest sum of absolute values in a row, for powers of two.
    """
    omega = interval.ball(setting.parameters.omega)
    D = [*map(list, D)]
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


def _claims(orbit: Orbit) -> dict[str, Any]:
    """Return the claims on the orbit, rounded outwards."""
    pair, units, guess = orbit.setting.rounding.pair, orbit.setting.units, orbit.guess
    return {
        "period": str(guess.periods),
        "itinerary": [word for word, *_ in guess.events],
        "x": [pair(q, units.length) for q in orbit.strobe.point[:2]],
        "v": [pair(q, units.speed) for q in orbit.strobe.point[2:]],
        "event_times": [pair(t, units.time) for t, _ in orbit.contacts],
    }
