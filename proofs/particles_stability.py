"""Theorem (particles stability).  Let two masses m_1, m_2 move between two walls, T = 2π/ω,

    m_i x_i'' = F cos ωt - f sgn x_i',   l <= x_1 <= x_2 <= r,   elastic walls and collisions,

at rational parameters, and let an elliptic T-periodic orbit be guessed on which no mass stops.  If
the lemmas below succeed, then

 (i)   there is exactly one T-periodic orbit with the itinerary claimed whose events lie in an
       explicit box; P* is its state at t = 0;
 (ii)  with exact c, A, κ < 1 and N, let E = {c + A u : |u| <= 1} and E' = {c + A u : |u| <= κ}, in
       the coordinates (x_1, x_2, v_1, v_2): each motion that starts in E' at t = 0 is in E at t =
       nT for all integers |n| <= N, and no mass stops for |t| <= NT.

Tori of dimension two enclose nothing in dimension four: no curve bounds these motions for all time.

Proof.  Lemmas 1 to 3 (`cap.proofs.particle_orbit`) give (i), in balls.  For (ii) this module only
finds hints, an approximate integral H and the ellipsoids, from the normal form: that all orbits
from a box around E have these contacts over a period, and how little H changes on E, is proved by
the checker alone, in its arithmetic; the lemma is that of `cap.proofs.effective_stability`.
Ellipsoids are tried from a large one on, until the checker can follow.
"""

from fractions import Fraction
from typing import Any

from cap.certificate.writer import window
from cap.floats import candidates
from cap.maps import twist_matrix
from cap.particles import integral
from cap.particles.integral import Ellipsoid
from cap.proofs.fixed_point import Proof, Setting
from cap.proofs.options import OF_MASSES, PERIODS
from cap.proofs.particle_orbit import Orbit, proof_of
from cap.sets import interval

SUMMARY = "an ellipsoid around an elliptic orbit: on its motions no mass stops for N periods"
GROUP = "masses"
SEARCH = candidates.elliptic_particles
OPTIONS = (PERIODS, *OF_MASSES)

MANY = Fraction(10**6)  # periods, if not asked for
LARGEST = Fraction(1, 60_000)  # radius in the coordinates w, in the unit of the root of m R² ω
PART = Fraction(4, 5)  # κ
ORDER = 6  # of the jets with which the checker bounds the change of H
CENTRE, COEFFICIENTS = 14, 30  # decimals
WIDE = 3000  # times the radius are the windows of contacts


def prove(setting: Setting) -> Proof:
    """Prove (i), up to the size of the box; return what finds the hints for (ii)."""
    found = list[Orbit]()

    def conclusion(orbit: Orbit) -> dict[str, Any]:
        found.append(orbit)
        z = twist_matrix.reduced_traces(orbit.monodromy)
        return {"reduced_traces": [setting.rounding.pair(q) for q in z]}

    proof = proof_of("particles_stability", setting, conclusion)

    def certified(part: Fraction) -> dict[str, Any]:
        certificate = proof(part)
        with interval.workprec(setting.bits):
            claims, hints = around(found[0], part * LARGEST)
        certificate["claims"] |= claims
        certificate["hints"] |= hints
        return certificate

    return certified


def around(orbit: Orbit, radius: Fraction) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the claims and hints for ellipsoids of this size; nothing is proved here."""
    setting, exact = orbit.setting, interval.exact_decimal
    z = twist_matrix.reduced_traces(orbit.monodromy)
    frame = twist_matrix.frame(orbit.monodromy, orbit.masses, z)
    H = integral.integral(orbit.jet(3), frame)
    size = radius * interval.short(Fraction(float(orbit.inertia) ** 0.5))
    E = integral.ellipsoid(H, frame, orbit.strobe.point, size, (CENTRE, COEFFICIENTS))
    reach = radius * WIDE * setting.units.time
    windows = [interval.around(interval.midpoint(t), reach) for t, _ in orbit.contacts]
    claims = {
        "centre": [exact(c) for c in E.centre],
        "axes": [[exact(q) for q in row] for row in E.axes],
        "part": exact(PART),
        "periods": str(setting.of(PERIODS) or MANY),
    }
    return claims, {
        "windows": [window(w) for w in windows],
        "order": str(ORDER),
        **terms(E),
    }


def terms(E: Ellipsoid) -> dict[str, Any]:
    """Return the hints on H."""
    return {
        "powers": [[str(k) for k in m] for m in E.integral],
        "integral": [interval.exact_decimal(c) for c in E.integral.values()],
    }
