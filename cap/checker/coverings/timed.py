"""Entropy in time: the flow of motions between whose contacts bounded times pass.

Let A, Lambda and the sets be as in `graph`, without a diamond, and let t' - t, the time from a
contact in Lambda to the next one, be a continuous positive function, at most tau_i on the i-th set.
The motions whose contacts are a bi-infinite orbit of g in Lambda form a flow: the suspension, under
t' - t, of the shift on these orbits.

*Lemma 5.*  If v >= 0 is not 0 and A v >= exp(s tau_i) v, in each row i, s > 0, the entropy of the
flow is at least s, per unit of time.  *Proof.*  Let B have the rows exp(-s tau_i) A_i.  B v >= v,
so rho(B) >= 1 (``growth``), which is that of a strong component, B w = rho w on it, w >
0.  The Markov measure m with the transitions B_ij w_j/(rho w_i) has the entropy

    h(m) = log rho + s (the mean of tau_i) >= s (the mean of tau_i).

The pairs of an orbit (z_k) and a path (i_k), z_k in N_(i_k), are a compact set, invariant under the
shift, and each path occurs (Lemma 1 of ``covering``).  So an invariant measure of pairs lies over
m, with an entropy of at least h(m); let mu be its image on orbits.  Without a diamond two paths of
one orbit with the same ends are equal, as their sets always meet: over n steps there are at most
V^2 paths of an orbit, V the number of sets.  So the entropy along the fibres over orbits is 0, and
that of mu is at least h(m) [Ledrappier, Walters].  The mean of t' - t over mu is at most that of
tau_i over m.  The flow has an invariant measure of entropy h(mu)/(mean of t' - t) >= s [Abramov],
and its topological entropy is at least that [variational principle].
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.exponential import exp
from cap.checker.kernel.growth import Edges, confirm_growth


def confirm_timed(
    edges: Edges, vector: Sequence[int], rate: Fraction, times: Sequence[Fraction]
) -> None:
    """Check that A v >= exp(rate tau_i) v, for a vector v >= 0 that is not 0."""
    above = {tau: exp(rate * tau).upper for tau in set(times)}
    confirm_growth(edges, vector, [above[tau] for tau in times])
