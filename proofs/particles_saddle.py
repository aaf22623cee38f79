"""Theorem (particles_saddle).  Let two masses m_1, m_2 move between two walls, T = 2π/ω,

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= x_2 <= r,   elastic walls and collisions,

at rational parameters, and let a T-periodic orbit be guessed on which no mass stops.  If the lemmas
below succeed, then

 (i)   there is exactly one T-periodic orbit with the itinerary claimed whose events lie in an
       explicit box.  All its hits and collisions are transverse, no two are simultaneous, and no
       mass ever stops; at each collision the sum of the signs of the velocities is conserved.  So
       near its state P* at t = 0 the period map Φ is real analytic and preserves
       Σ m_i dv_i ∧ dx_i (theorem `symplectic`);
 (ii)  one pair of multipliers of P* is real, one of them outside the unit circle, the other one
       inside; both are negative if the reduced trace is below -2 (inverse hyperbolic).  The other
       pair is exp(±2πiρ), on the unit circle, ρ in (0, 1/2);
 (iii) hence (Hadamard-Perron) P* has strong stable and unstable curves, and is unstable.

Lemmas 1, 2 and 3 (`cap.proofs.particle_orbit`) give (i), Lemma 4 gives (ii).
"""

from typing import Any

from cap.errors import NotProved
from cap.floats import candidates
from cap.maps import twist_matrix
from cap.maps.stability import real_multipliers
from cap.proofs.fixed_point import Proof, Setting
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_orbit import Orbit, proof_of
from cap.sets.interval import Ball

SUMMARY = "an orbit with one pair of multipliers on the unit circle and one real pair"
GROUP = "masses"
SEARCH = candidates.particles
OPTIONS = OF_MASSES


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    return proof_of("particles_saddle", setting, lemma_4_hyperbolicity)


def lemma_4_hyperbolicity(orbit: Orbit) -> dict[str, Any]:
    """*Statement.* Of the two reduced traces one lies in (-2, 2), the other outside [-2, 2].

    *Computed.* The multipliers z/2 ± sqrt((z/2)² - 1) of the one, the angle of the other.
    """
    z = twist_matrix.reduced_traces(orbit.monodromy)
    outside = [q for q in z if q > 2 or q < -2]
    within = [q for q in z if -2 < q < 2]
    if not (len(outside) == len(within) == 1):
        sets = {"z_1": z[0], "z_2": z[1]}
        raise NotProved("Lemma 4", "not one pair on the unit circle and one real pair", sets)
    pair = orbit.setting.rounding.pair
    return {
        "reduced_traces": [pair(q) for q in z],
        "multipliers": [pair(q) for q in real_multipliers(outside[0], Ball(1))],
        "rotation_number": pair(twist_matrix.angle(within[0], above=True)),
    }
