"""Theorem (symplectic).  Consider N masses between two walls,

    m_i x_i'' = F_i cos ωt - f_i sgn x_i',   f_i > 0,   l <= x_1 <= .. <= x_N <= r,

with elastic hits and collisions, none simultaneous, and no zero of a velocity; Φ leads from the
states at one time to those at another, near a state from which the motion is so.

 (i)   Φ preserves the volume.
 (ii)  Its defect from preserving Ω = Σ m_i dv_i ∧ dx_i is Φ*Ω - Ω = -Σ_k (Σ_i f_i Δs_i)_k dx_k ∧
       dt_k, (x_k, t_k) the place and time of the k-th collision and Δs_i the jumps of the signs
       there.  Each collision for itself is symplectic if and only if Σ f_i Δs_i = 0: for equal
       friction forces if the sum of the two signs is kept, otherwise if both signs are.
 (iii) In the coordinates sqrt(m_i) x_i reflections in the faces have the polytope of configurations
       as a fundamental domain for equal masses, for N = 2 at 3 : 1, for N = 4 at 6 : 2 : 1 : 3, and
       these reversed, only.
 (iv)  For N >= 2 no motion keeps all signs at all collisions for ever: Ω_NS^(N) of the paper is
       empty.  So if f_i and f_(i+1) differ for all i, no motion for ever has only symplectic
       collisions.
 (v)   The hypothesis (K1) of the paper holds for no orbit.

The forces F_i cos ωt may be any smooth functions of the time in (i) and (ii).
"""

from cap.proofs.symplectic_events import exact_defect, flights, hits, signs, symplectic, volume
from cap.proofs.symplectic_signs import emptiness, resonances
from cap.proofs.symplectic_tiling import angles, tiling

SUMMARY = "which collisions of masses with friction preserve volume and sum m_i dv_i^dx_i"
GROUP = "identities"
LEMMAS = (
    flights,
    hits,
    volume,
    symplectic,
    exact_defect,
    signs,
    angles,
    tiling,
    emptiness,
    resonances,
)
