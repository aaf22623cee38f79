"""From one release to the next: where it is, mirrored if it is to the left, and how much later.

*Entropy per period.*  Let all releases from an interval I have the same events: hits and turns, a
stick, and a release n half-periods later, the place of which, mirrored if it is to the left, is
G(x) in I.  Let (wall, v) before a hit and (wall, -e v) after it be one state: they have the same
future.  This is a closed relation, so a compact set of the plane of (x, v) becomes a compact metric
space.  Let phi_j(x) be the state j half-periods after the release at x, mirrored if j is odd.  The
times of the events depend continuously on x, and so does the state, at all times: it is continuous
in time at turns and sticks, and, with these states identified, at hits (without, phi_j jumps where
a hit takes place j half-periods after the release).  Let S be the map that takes a state to that
half a period later, mirrored: S phi_j = phi_(j+1), phi_n(x) = phi_0(G(x)), and S^2 is the map over
a period T.

Let A be the intersection of all G^k(I): it is compact, G(A) = A.  Let K_j = phi_j(A), K = K_0 + ..
+ K_(n-1), the union.  S is continuous on each K_j: the preimage there of a closed set B, phi_j of
phi_(j+1)^-1(B), is compact.  So it is on K, and S(K) = K.  S^n takes each K_j onto itself, and S^n
phi_j = phi_j G: so its entropy there is at most that of G on A; and on K_0, the set of all (x, 0)
with x in A, the same.  So the entropy of S^n on K is that of G on A; that of S^2 is 2/n times this.
The entropy of G on A is that on I: an invariant measure of the whole space 1 has m(G^k(I)) = m(I) =
1, so m(A) = 1, and entropy is the supremum of those of invariant measures [variational principle].
"""

from __future__ import annotations

from cap.checker.flow.events import LossyMap
from cap.checker.flow.losses import Lossy
from cap.checker.flow.mechanics import Flight
from cap.checker.flow.stops import SIDES
from cap.checker.kernel.jet import Centred, lift
from cap.checker.kernel.rejection import Rejected, need


def next_release(M: Lossy, phi: LossyMap, start: Flight) -> tuple[Centred, int]:
    """Prove the itinerary; return where the release at its end is, mirrored if to the left.

    And how many half-periods it comes after the release to the right in the first period.
    """
    earlier = any(word.startswith("release") for word in phi.itinerary[:-1])
    need(not earlier, "the release at the end is not the only release")
    events, flight = phi.follow(M, start)
    verb, _, side = phi.itinerary[-1].partition(" ")
    if verb != "release" or not isinstance(flight, Flight):
        raise Rejected("the itinerary does not end with a release")
    number, last = SIDES[side], events[-1].moment
    k = next(n for n, moment in enumerate(M.minima[number]) if moment is last)
    taken = 2 * k - (number < 0)
    x = M.place(flight, last)
    mirror = M.constant(M.walls[1] + M.walls[-1])
    return x if number > 0 else lift(lambda y, z: y - z, mirror, x), taken
