"""An ellipsoid of motions around a periodic orbit that attracts them.

Let P_k be the orbit's (t, q) just before its k-th contact, k = 0, .., K - 1, and P_K = P_0 one
round later.  From z = (t, q) near P_0 on, take the reset of the first contact there, whether its
guard vanishes or not, the flight until the guard of the next contact vanishes, and so on: z_k.
Where L h < 0 it is a function of z, with the derivative D_k.  Let W be invertible.

*Lemma.*  Let D_k be enclosed where all z_j lie in boxes P_j ± r_j.  If the rows of W^-1 are not
longer than r_0, those of D_k W^-1 shorter than r_k, and |W D_K W^-1| <= kappa < 1, then for all z
of the ellipsoid |W (z - P_0)| <= 1 the z_k exist, lie in the boxes, and

    |W (z_K - P_0)| <= kappa |W (z - P_0)|   (moved in time by one round).

*Proof.*  Let z move from P_0 on a straight line.  As long as all z_k lie in the boxes, they are
differentiable, and z_k - P_k = M (z - P_0) with a mean M of D_k.  So they stay inside, and cannot
leave.  If moreover nothing else happens on legs between the boxes, the motions of the system that
come to the first contact in the ellipsoid have these z_k, and come to it again, nearer to P_0.

*Without a clock* the first contact is at the time 0, the ellipsoid one of states q.
"""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from math import ceil, isfinite, log10
from typing import Any, NamedTuple, TypeVar

import numpy as np

from cap.errors import NotProved
from cap.maps.metric import metric
from cap.maps.zero import Box
from cap.orbits.equations import steps
from cap.orbits.periodic import PeriodicOrbit, Prover
from cap.sets import interval
from cap.sets.interval import Ball, Matrix

DIGITS = 4  # of W, where the orbit does not attract slowly
HALVINGS, TRIALS = 24, 4
SLACK, SLOW, LEAST = 1.1, 1e-9, 1e-12

Rows = list[list[Fraction]]
Legs = TypeVar("Legs")


class Ellipsoid(NamedTuple):
    """W, upper triangular, kappa, and the r_k; ``box`` has what lies within r_k of the orbit."""

    matrix: Rows
    contraction: Fraction
    reach: Rows
    box: Box


def attracted(
    prover: Prover, orbit: PeriodicOrbit, quiet: Callable[[Box], Legs]
) -> Iterator[tuple[Ellipsoid, Legs]]:
    """Give ellipsoids that are attracted, each half as large as the one before, until none is.

    ``quiet`` proves that nothing else happens between contacts in a box, or raises `NotProved`;
    what it returns is given, too.
    """
    first = _first(orbit)
    parts = [_floats(D) for D in _products(prover, orbit.box, first)]
    W, digits = _metric(parts[-1][first:])
    size = float(prover.balls.period) / 4 / max(np.linalg.norm(np.linalg.inv(W), axis=1))
    for _ in range(HALVINGS):
        try:
            found = _proved(prover, orbit, _decimals(W / size, digits), parts)
            legs = quiet(found.box)
        except NotProved:
            pass
        else:
            yield found, legs
        size = size / 2


def _first(orbit: PeriodicOrbit) -> int:
    """Return the first column of the derivatives: without a clock, the time does not vary."""
    return int(orbit.autonomous)


def _products(prover: Prover, box: Sequence[Ball], first: int) -> list[Matrix]:
    """Return D_0, .., D_K over boxes."""
    equations = prover.equations
    parts = steps(equations.blocks(box, prover.balls))
    rows = interval.identity(equations.n + 1).table()
    found = [interval.matrix([row[first:] for row in rows])]
    for part in parts:
        found.append(part * found[-1])
    return found


def _floats(D: Matrix) -> Any:
    return np.array([[float(x) for x in row] for row in D.table()])


def _metric(D: Any) -> tuple[Any, int]:
    """Return W, upper triangular, and how many digits of it matter."""
    slack = 1 - float(max(abs(np.linalg.eigvals(D))))
    if not slack > SLOW:
        raise NotProved("ellipsoid", "the orbit attracts too slowly for doubles")
    return metric(D, 1 - slack * 3 / 4, "ellipsoid"), DIGITS - round(log10(slack))


def _proved(prover: Prover, orbit: PeriodicOrbit, rows: Rows, parts: list[Any]) -> Ellipsoid:
    """Prove that an ellipsoid is attracted; ``parts`` are D_k on the orbit, in doubles."""
    first, W = _first(orbit), np.array(rows, float)
    matrix = interval.matrix([[interval.ball(q) for q in row] for row in rows])
    inverse = matrix.inv()
    lengths = [np.linalg.norm(part @ np.linalg.inv(W), axis=1) for part in parts]
    reach = [[_above(Ball(float(x))) for x in row] for row in lengths[:-1]]
    if first:
        reach[0][0] = _above(Ball(float(lengths[-1][0])))
    for _ in range(TRIALS):
        sides = [r for each in reach for r in each]
        box = tuple(
            x + interval.symmetric(interval.ball(r)) for x, r in zip(orbit.box, sides, strict=True)
        )
        products = _products(prover, box, first)
        need = [_lengths(D * inverse) for D in products]
        if first:
            need[0][0] = need[-1][0]
        longest = (a for row in need[:-1] for a in row)
        if all(a < interval.ball(r) for a, r in zip(longest, sides, strict=True)):
            break
        reach = [[_above(a) for a in row] for row in need[:-1]]
    else:
        raise NotProved("ellipsoid", "its images may grow beyond boxes around the orbit")
    last = interval.matrix(products[-1].table()[first:])
    return Ellipsoid(rows, _bound(matrix * last * inverse), reach, box)


def _decimals(W: Any, digits: int) -> Rows:
    """Return an upper triangular matrix in short decimals, exactly."""
    return [
        [Fraction(f"{q:.{digits}g}") if j >= i else Fraction(0) for j, q in enumerate(row)]
        for i, row in enumerate(W.tolist())
    ]


def _above(x: Ball) -> Fraction:
    """Return a short number, somewhat above."""
    found = float(interval.upper(x)) * SLACK
    if not isfinite(found):
        raise NotProved("ellipsoid", "its images may be unbounded")
    return Fraction(f"{max(found, LEAST):.3g}")


def _lengths(V: Matrix) -> list[Ball]:
    """Return upper bounds of the lengths of the rows."""
    return [interval.total(interval.upper(abs(x)) ** 2 for x in row).sqrt() for row in V.table()]


def _bound(N: Matrix) -> Fraction:
    """Return a decimal kappa < 1 that no matrix in N exceeds in norm."""
    near = float(np.linalg.norm(_floats(N), 2))
    for part in (0.1, 0.3, 0.6, 0.9):
        places = 2
        while 10.0**-places > (1 - near) / 20 and places < 16:
            places += 1
        kappa = Fraction(ceil((near + part * (1 - near)) * 10**places), 10**places)
        if kappa < 1 and _is_bounded(N, interval.ball(kappa)):
            return kappa
    raise NotProved("ellipsoid", "it is not certain to be contracted", {"norm in doubles": near})


def _is_bounded(N: Matrix, kappa: Ball) -> bool:
    """Return whether kappa² - NᵀN is positive definite: the pivots of its elimination are."""
    size = N.ncols()
    rows = (interval.identity(size) * (kappa * kappa) - N.transpose() * N).table()
    for k in range(size):
        if not rows[k][k] > 0:
            return False
        for i in range(k + 1, size):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return True
