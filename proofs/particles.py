"""Theorem (particles).  Let two masses m_1, m_2 move between two walls, T = 2π/ω,

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= x_2 <= r,   elastic walls and collisions,

at rational parameters, and let a T-periodic orbit be guessed on which no mass stops.  If the lemmas
below succeed, then

 (i)   there is exactly one T-periodic orbit with the itinerary claimed whose events lie in an
       explicit box.  All its hits and collisions are transverse, no two are simultaneous, and no
       mass ever stops; at each collision the sum of the signs of the velocities is conserved.  So
       near its state P* at t = 0 the period map Φ is real analytic and preserves
       Ω = Σ m_i dv_i ∧ dx_i (theorem `symplectic`);
 (ii)  the multipliers of P* are exp(±2πiθ_1), exp(±2πiθ_2), on the unit circle and simple; θ_j in
       (0, 1) is the angle of the one whose eigenvector e has Ω(e, ē)/i > 0.  There is no resonance
       k_1 θ_1 + k_2 θ_2 = n with 0 < |k_1| + |k_2| <= 4;
 (iii) in complex coordinates with Ω = i Σ dw_j ∧ dw̄_j the map is
       w_j -> w_j exp(i (2πθ_j + Σ_k B_jk |w_k|²)) + O(|w|⁴), with an enclosed symmetric twist
       matrix B, and det B is not zero;
 (iv)  hence (KAM) every neighbourhood of P* contains a family of analytic invariant Lagrangian
       tori of dimension two around P*, on which Φ is conjugate to a rotation with Diophantine
       angles.  They fill a set of positive measure, of density one at P*.  On them no mass ever
       stops.

What (iv) does not give: stability.  Tori of dimension two do not enclose a region in the space of
dimension four, so orbits between them may leave (Arnold diffusion); there is no island.

Proof.  Lemmas 1, 2 and 3 (`cap.proofs.particle_orbit`) give (i); the restriction to equal friction
forces is what makes collisions with this sign rule symplectic.  Lemma 4 gives (ii), Lemma 5 gives
(iii).  For (iv), I_j = |w_j|² = δ² J_j with J in a compact set of the open quadrant: in the angles
and J the map is the rotation by 2πθ + δ²BJ up to terms of order δ³.  So its twist δ²B is larger
than what perturbs it, by the factor 1/δ, and det B != 0 is Kolmogorov's condition.
"""

from typing import Any

from cap.certificate.writer import Pair
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps import twist_matrix
from cap.proofs.fixed_point import Proof, Setting
from cap.proofs.options import OF_MASSES
from cap.proofs.particle_orbit import Orbit, proof_of
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "an elliptic orbit, its twist matrix, and invariant tori on which no mass stops"
GROUP = "masses"
SEARCH = candidates.particles
OPTIONS = OF_MASSES

ORDER = 4
RESONANCES = [
    (k, n)
    for k in range(ORDER + 1)
    for n in range(-ORDER, ORDER + 1)
    if 0 < k + abs(n) <= ORDER and (k > 0 or n > 0)
]


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    return proof_of("particles", setting, conclusion)


def conclusion(orbit: Orbit) -> dict[str, Any]:
    """Prove what the theorem says of the multipliers and the normal form; return the claims."""
    frame, claims = lemma_4_ellipticity(orbit)
    return claims | lemma_5_twist(orbit, frame)


def lemma_4_ellipticity(orbit: Orbit) -> tuple[twist_matrix.Frame, dict[str, Any]]:
    """*Statement.* Both reduced traces are in (-2, 2) and different, and none of the resonances of
    order at most four holds.

    *Computed.* The zeros z of z² - a z + b - 2, the angles by the sign of Ω(e, ē)/i, and for each k
    the distance of k·θ from the integers.
    """
    z = twist_matrix.reduced_traces(orbit.monodromy)
    frame = twist_matrix.frame(orbit.monodromy, orbit.masses, z)
    above = [bool(q.imag > 0) for q in frame.multipliers]
    theta = [twist_matrix.angle(q, above=up) for q, up in zip(z, above, strict=True)]
    pair = orbit.setting.rounding.pair
    distances = {f"{k},{n}": _distance(k, n, theta) for k, n in RESONANCES}
    return frame, {
        "reduced_traces": [pair(q) for q in z],
        "theta": [pair(q) for q in theta],
        "krein_signs": ["+" if up else "-" for up in above],
        "resonance_distances": {name: pair(q) for name, q in distances.items()},
    }


def _distance(k: int, n: int, theta: list[Ball]) -> Ball:
    """Return the distance of k θ_1 + n θ_2 from the integers, proved positive."""
    value = k * theta[0] + n * theta[1]
    near = round(interval.midpoint(value))
    distance = abs(value - near)
    for other in (near - 1, near + 1):  # which is the nearest may be uncertain
        distance = interval.least(distance, abs(value - other))
    if not distance > 0:
        reason = f"there may be a resonance of order {k + abs(n)}: k = ({k}, {n})"
        raise NotProved("Lemma 4", reason, {"k . theta": value})
    return distance


def lemma_5_twist(orbit: Orbit, frame: twist_matrix.Frame) -> dict[str, Any]:
    """*Statement.* det B lies in an explicit interval without zero.

    *Computed.* B from the jet of order 3 of Φ at P*; its imaginary parts, and the difference of its
    entries off the diagonal, are checked to contain zero.
    """
    jets = orbit.jet(3)
    (a, b), (_, d) = twist_matrix.twist_matrix(jets, frame)
    determinant = a * d - b * b
    if not (determinant > 0 or determinant < 0):
        raise NotProved("Lemma 5", "the twist matrix may be singular", {"det B": determinant})
    pair, unit = orbit.setting.rounding.pair, 1 / orbit.inertia
    rows: list[list[Pair]] = [[pair(q, unit) for q in row] for row in ((a, b), (b, d))]
    return {"twist_matrix": rows, "twist_determinant": pair(determinant, unit**2)}
