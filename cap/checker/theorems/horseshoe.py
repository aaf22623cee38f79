"""The theorem about chaos of motions that never stop: an invariant set with positive entropy.

Let e = 1, mu = 0, 0 <= f < F, Phi the map of (x, v) over the period 2 pi/omega from t = 0.  sigma
is the flow over half a period, followed by the symmetry (x, v) -> -(x, v) (x from the middle
between the walls): sigma^2 = Phi (`half_period`, which also has where sigma is defined: for motions
whose velocity does not vanish, and which hit one wall in that time).

*Claimed:* what `entropy` says of g = sigma, and of its second iterate Phi: so Phi(Lambda) = Lambda.
All motions from Lambda never have the velocity 0, in the past and in the future.  sigma is
injective: if the sets are disjoint, it is semiconjugate on Lambda onto the subshift of A."""

from __future__ import annotations

from cap.checker.coverings.entropy import (
    CONES,
    COVERINGS,
    ENTROPY,
    GROWTH,
    LEANING,
    ORBITS,
    SETS,
    TOGETHER,
    VECTOR,
    Coverings,
)
from cap.checker.coverings.half_period import HalfPeriod
from cap.checker.system.lossy import SYSTEM
from cap.checker.system.walls import BetweenWalls


class Horseshoe(Coverings, BetweenWalls):
    """Entropy of motions that never stop."""

    HINTS = (
        SETS._replace(meaning=f"{SETS.meaning}; in units F/omega^2, F/omega, x from the middle"),
        COVERINGS,
        VECTOR,
        LEANING,
    )
    CLAIMS = (
        GROWTH,
        ENTROPY._replace(meaning="a lower bound of the entropy of Phi"),
        TOGETHER,
        ORBITS,
        CONES,
    )
    ITERATES = 2
    MAP, SHIFT = "sigma", "subshift"

    def map(self) -> HalfPeriod:
        """Return sigma, in natural units."""
        a = self.R * self.omega**2 / (2 * self.p.F)
        return HalfPeriod(self.p.f / self.p.F, a)

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.bounded(SYSTEM + _HORSESHOE)


_HORSESHOE = (
    "sigma, the flow over half a period from t = 0 followed by the symmetry (x, v) -> (l + r - x, "
    "-v), whose square is the time-T map Phi, T = 2 pi/omega, has a compact invariant set Lambda "
    "of states whose motions never have the velocity 0, neither later nor before; the topological "
    "entropy of Phi on Lambda, per period T, is at least {entropy}: "
)

THEOREM = Horseshoe
