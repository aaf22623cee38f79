"""How fast a matrix of zeros and ones grows, from below.

Of a graph A is the adjacency matrix, rho(A) its spectral radius.

*Lemma* (Collatz, Wielandt).  If v >= 0 is not 0 and A v >= s v, then A^n v >= s^n v: rho(A) >= s.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from cap.checker.kernel.rejection import need

Edges = Sequence[Sequence[int]]  # for each vertex those to which it has an edge


def confirm_growth(edges: Edges, vector: Sequence[int], rates: Sequence[Fraction]) -> None:
    """Check that A v >= s_i v, in each row i, for a vector v >= 0 that is not 0."""
    need(len(vector) == len(edges), "the vector has not one entry for each row")
    need(min(vector) >= 0 and max(vector) > 0, "the vector is negative somewhere, or zero")
    rows = zip(edges, vector, rates, strict=True)
    grows = all(sum(vector[j] for j in targets) >= s * v for targets, v, s in rows)
    need(grows, "the matrix may not grow as claimed")
