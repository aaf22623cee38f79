"""Entropy in time: the flow of motions between whose contacts bounded times pass.

Let A, Lambda and the sets be as in `graph`, without a diamond, and let t' - t, the time from a
contact in Lambda to the next one, be a continuous positive function, at most tau_i on the i-th set.
The motions whose contacts are a bi-infinite orbit of g in Lambda form a flow: the suspension, under
t' - t, of the shift on these orbits.

*Lemma 5.*  If v >= 0 is not 0 and A v >= exp(s tau_i) v, in each row i, s > 0, the entropy of the
flow is at least s, per unit of time.  *Proof.*  Let B have the rows exp(-s tau_i) A_i.  B v >= v,
so rho(B) >= 1 (Lemma 4 of ``graph``), which is that of a strong component, B w = rho w on it, w >
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

from cap.checker.kernel.rejection import need

FINE = 10**25  # the unit of bounds of exponentials
TERMS = 40


def confirm_timed(
    edges: Sequence[Sequence[int]], vector: Sequence[int], rate: Fraction, times: Sequence[Fraction]
) -> None:
    """Check that A v >= exp(rate tau_i) v, for a vector v >= 0 that is not 0."""
    need(len(vector) == len(times) == len(edges), "not one time, and one entry, for each set")
    need(min(vector) >= 0 and max(vector) > 0, "the timed vector is negative somewhere, or zero")
    above = {tau: exp_above(rate * tau) for tau in set(times)}
    grows = all(
        FINE * sum(vector[j] for j in targets) >= above[tau] * v
        for targets, v, tau in zip(edges, vector, times, strict=True)
    )
    need(grows, "the coverings do not grow in time as claimed")


def exp_above(x: Fraction) -> int:
    """Return a number above FINE exp(x), 0 <= x <= 64.

    With z = x/2^k <= 1 the terms after the last one sum up to less than twice the next one; the sum
    is squared k times.  Each step is rounded up.
    """
    need(0 <= x <= 64, "an exponent is not in [0, 64]")
    k = max(0, (-(-x.numerator // x.denominator) - 1).bit_length())
    z = -(-x.numerator * FINE // (x.denominator << k))
    total, term = 0, FINE
    for n in range(1, TERMS + 1):
        total, term = total + term, -(-term * z // (FINE * n))
    total += 2 * term
    for _ in range(k):
        total = -(-total * total // FINE)
    return total
