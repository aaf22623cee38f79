"""Theorem (saddle).  Let the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,

be given at rational parameters, and let a non-sticking T-periodic orbit be guessed.  If the lemmas
below succeed, then

 (i)   Φ has exactly one fixed point P* in an explicit box; all orbits from the box are
       non-sticking, with the same sequence of transverse wall hits, so Φ is analytic and preserves
       area there;
 (ii)  P* is hyperbolic, its two multipliers real, one outside and one inside the unit circle;
 (iii) hence P* has analytic stable and unstable curves (Hadamard-Perron), and is unstable.

Lemmas 1 and 2 (`proofs.non_sticking`) give (i), Lemma 3 gives (ii).
"""

from typing import Any

from cap.errors import NotProved
from cap.flow.model import Oscillator
from cap.maps.fixed_point import FixedPoint, Neighbourhood
from cap.sets import matrix
from proofs import non_sticking
from proofs.fixed_point import Proof, Setting


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    return non_sticking.proof_of("saddle", setting, conclusion)


def conclusion(
    _osc: Oscillator[Any], setting: Setting, point: FixedPoint, _around: Neighbourhood
) -> dict[str, Any]:
    """Prove what the theorem says of P*; return the claims."""
    return {"multipliers": lemma_3_hyperbolicity(setting, point)}


def lemma_3_hyperbolicity(setting: Setting, point: FixedPoint) -> list[list[str]]:
    """*Statement.* |trace| > 2: the multipliers are real, the larger outside the unit circle.

    *Computed.* As the determinant is exactly one, they are t/2 ± sqrt((t/2)² - 1), t the trace; the
    smaller one is the reciprocal of the larger.
    """
    half = matrix.trace(point.orbit.monodromy) / 2
    if not (half > 1 or half < -1):
        raise NotProved("Lemma 3", "the trace may lie in [-2, 2]", {"trace": 2 * half})
    root = (half * half - 1).sqrt()
    larger = half + root if half > 0 else half - root
    return [setting.rounding.pair(larger), setting.rounding.pair(1 / larger)]
