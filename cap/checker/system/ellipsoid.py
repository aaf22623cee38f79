"""An ellipsoid of motions that come nearer to a periodic orbit in each round.

Let P_k be the orbit's (t, q) just before its k-th contact, k = 0, ..., K - 1, and P_K that one
round later.  From z = (t, q) near P_0 on, let z_0 = z; then take the reset of the first contact,
even where its guard does not vanish, the flight after it until the next guard vanishes, which gives
z_1, and so on to z_K.  Where L h < 0, z_k is a function of z with a derivative D_k: a product of
those of the legs (``contacts``).

*Lemma.*  Let D_k be enclosed for all z_j in boxes P_j + [-r_j, r_j].  If the rows of D_k W^-1 are
shorter than r_k, k < K, and |W D_K W^-1| <= kappa < 1, then from all z in the ellipsoid
|W (z - P_0)| <= 1 the z_k exist, lie in the boxes, and, moved in time by one round,

    |W (z_K - P_0)| <= kappa |W (z - P_0)|.

*Proof.*  Let z move from P_0 on a line.  While all z_k lie in the boxes, z_k - P_k = M (z - P_0),
with a mean M of D_k on the line, and z - P_0 = W^-1 s, |s| <= 1: they are in the interior.  So they
never leave, and are defined up to the end of the line.  The last claim is W M W^-1 for M of D_K.

*The norm.*  |N| <= kappa if kappa^2 - N^T N is positive definite: if all pivots of its elimination
are positive.

*Without a clock* the first contact is at the time 0, z = q, and t_K is in the box of the period.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import reduce

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.contacts import Matrix, product
from cap.checker.system.legs import dot

Rows = Sequence[Sequence[Fraction]]


def confirm(W: Rows, kappa: Fraction, reach: Rows, size: int) -> None:
    """Reject what is no upper triangular matrix of this size, no contraction, and no boxes."""
    square = len(W) == size and all(len(row) == size for row in W)
    need(square, f"the matrix of the basin is not {size} x {size}")
    triangular = all(q == 0 for i, row in enumerate(W) for q in row[:i])
    need(triangular, "the matrix of the basin is not upper triangular")
    need(all(W[i][i] > 0 for i in range(size)), "the matrix of the basin may be singular")
    need(all(r > 0 for row in reach for r in row), "hints.reach is not positive")
    need(0 < kappa < 1, "the contraction of the basin is not between 0 and 1")


def contracts(
    parts: Sequence[Matrix], W: Rows, kappa: Fraction, reach: Rows, *, autonomous: bool
) -> None:
    """Prove the lemma; ``parts`` are the derivatives of the legs over the boxes."""
    first, like = int(autonomous), parts[0][0][0]
    inverse = _inverse(W, like)
    images = [[[like.integer(0)] * len(W)] * first + inverse]  # z_k - P_k is one of these times s
    for part in parts:
        images.append(product(part, images[-1]))
    limits = [*zip(images[0][first:], reach[0][first:], strict=True)]
    limits += [pair for rows, r in zip(images[1:-1], reach[1:], strict=True)
               for pair in zip(rows, r, strict=True)]  # fmt: skip
    limits += zip(images[-1][:first], reach[0][:first], strict=True)
    for row, r in limits:
        square = reduce(lambda total, x: total + x.square(), row, like.integer(0))
        need(square.upper < r * r, "images of the basin may leave the boxes")
    rows = [[Interval.enclosing(q, q, like.bits) for q in row] for row in W]
    need(_is_bounded(product(rows, images[-1][first:]), kappa), "the basin may not be contracted")


def _inverse(W: Rows, like: Interval) -> Matrix:
    """Return W^-1 by back substitution."""
    size = len(W)
    found = [[like.integer(int(i == j)) for j in range(size)] for i in range(size)]
    for i in reversed(range(size)):
        for j in range(size):
            less = sum((found[k][j] * W[i][k] for k in range(i + 1, size)), like.integer(0))
            found[i][j] = (found[i][j] - less) * (1 / W[i][i])
    return found


def _is_bounded(N: Matrix, kappa: Fraction) -> bool:
    """Return whether kappa^2 - N^T N is certainly positive definite."""
    columns = [*zip(*N, strict=True)]
    rows = [[-dot(a, b) for b in columns] for a in columns]
    for i, row in enumerate(rows):
        row[i] = row[i] + row[i].integer(1) * (kappa * kappa)
    for k in range(len(rows)):
        if not rows[k][k].is_positive():
            return False
        for i in range(k + 1, len(rows)):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return True
