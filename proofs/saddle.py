"""Theorem (saddle).  Let the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,

be given at rational parameters, and let a non-sticking T-periodic orbit be guessed.  If the lemmas
below succeed, then

 (i)   Φ has exactly one fixed point P* in an explicit box; all orbits from the box are
       non-sticking, with the same sequence of transverse wall hits, so Φ is analytic and preserves
       area there;
 (ii)  P* is hyperbolic, its two multipliers real, one outside and one inside the unit circle;
 (iii) hence P* has analytic stable and unstable curves (Hadamard-Perron), and is unstable.

Lemmas 1 and 2 (`cap.proofs.fixed_point`) give (i), Lemma 3 gives (ii).
"""

from collections.abc import Callable

from cap.certificate.writer import Pair
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps.fixed_point import FixedPoint
from cap.maps.stability import real_multipliers
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Around, Located, Proof, Setting, proof_of
from cap.proofs.orbit import HITS, need_hits
from cap.sets import matrix
from cap.sets.interval import Ball

SUMMARY = "a hyperbolic T-periodic orbit that never stops"
GROUP = "orbit"
SEARCH = candidates.non_sticking


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    need_hits("saddle", setting)
    return proof_of("saddle", setting, HITS, conclusion)


def conclusion(orbit: Located) -> Callable[[Around], Content]:
    """Prove what the theorem says of P*; return the claims."""
    claims = {"multipliers": lemma_3_hyperbolicity(orbit.setting, orbit.point)}
    return lambda _around: (claims, {})


def lemma_3_hyperbolicity(setting: Setting, point: FixedPoint) -> list[Pair]:
    """*Statement.* |trace| > 2: the multipliers are real, the larger outside the unit circle.

    *Computed.* As the determinant is exactly one, they are t/2 ± sqrt((t/2)² - 1), t the trace; the
    smaller one is the reciprocal of the larger.
    """
    trace = matrix.trace(point.orbit.monodromy)
    if not (trace > 2 or trace < -2):
        raise NotProved("Lemma 3", "the trace may lie in [-2, 2]", {"trace": trace})
    outer, inner = real_multipliers(trace, Ball(1))
    return [setting.rounding.pair(outer), setting.rounding.pair(inner)]
