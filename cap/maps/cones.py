"""The unstable and the stable curve of a saddle P* of Φ, near it: graphs in the cones of a frame.

In coordinates z = P* + A (p, q), A the frame, let b enclose A⁻¹ Φ' A over N = {|p| <= r, |q| <= r},
and let 0 < L < 1 with

    (u)  |b21| + L |b22| < L (|b11| - L |b12|),    |b11| - L |b12| > 1,
    (s)  |b12| + L |b22| < L (|b11| - L |b21|),    |b22| + L |b21| < 1.

Then W^u contains a graph q = w(p), |p| <= r, and W^s a graph p = w(q), |q| <= r, with w(0) = 0 and
|w'| <= L (the proof: `cap.checker.maps.cones`).
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from cap.errors import NotProved
from cap.flow.event import TAYLOR_MODELS
from cap.flow.model import Oscillator
from cap.flow.windows import find_windows
from cap.maps.fixed_point import FixedPoint
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix
from cap.sets.taylor_model import Domain


@dataclass(frozen=True)
class Cones:
    """The curves of the saddle in the box ``saddle`` are graphs, with slopes of at most L.

    ``frame`` has columns near their directions, ``reach`` is r and ``slope`` L.
    """

    saddle: Box
    frame: Matrix[Fraction]
    reach: Fraction
    slope: Fraction

    @property
    def columns(self) -> Matrix[Ball]:
        """A, enclosed."""
        (a, b), (c, d) = self.frame
        return (interval.ball(a), interval.ball(b)), (interval.ball(c), interval.ball(d))

    @property
    def slopes(self) -> Ball:
        """[-L, L]."""
        return interval.symmetric(interval.ball(self.slope))

    def at(self, p: Ball, q: Ball) -> Box:
        """Return the state P* + A (p, q)."""
        x, v = matrix.apply(self.columns, (p, q))
        return self.saddle[0] + x, self.saddle[1] + v


def cones(
    osc: Oscillator[Any], point: FixedPoint, frame: Matrix[Fraction], reach: Fraction
) -> Cones:
    """Prove (u) and (s) for the saddle, with the least L that serves, nearly.

    Raises `NotProved` with b if there is none: the reach may be too large.
    """
    near = Cones(point.box, frame, reach, Fraction(1))
    side = interval.symmetric(interval.ball(reach))
    box, m = near.at(side, side), point.hint.point
    states = Domain((box[0] - m[0], box[1] - m[1]), 2).variables(m)
    _, orbit = find_windows(osc, (states[0], states[1]), point.events, TAYLOR_MODELS)
    row, other = orbit.monodromy
    bound = TAYLOR_MODELS.bound
    jacobian = (bound(row[0]), bound(row[1])), (bound(other[0]), bound(other[1]))
    columns = near.columns
    b = matrix.product(matrix.inverse(columns), matrix.product(jacobian, columns))
    (b11, b12), (b21, b22) = ([abs(entry) for entry in row] for row in b)
    gap = interval.lower(b11 - b22)
    if not gap > 0:
        raise NotProved("cones", "the frame is not that of a saddle", {"A^-1 Phi' A": b})
    most = interval.upper(b12.max(b21)) * 2 / gap
    slope = interval.short(interval.ends(most)[1] * Fraction(11, 10))
    L = interval.ball(slope)
    unstable = b21 + L * b22 < L * (b11 - L * b12) and b11 - L * b12 > 1
    stable = b12 + L * b22 < L * (b11 - L * b21) and b22 + L * b21 < 1
    if not (L < 1 and unstable and stable):
        sets = {"A^-1 Phi' A": b, "L": slope}
        raise NotProved("cones", "the cones may not be mapped into themselves", sets)
    return Cones(point.box, frame, reach, slope)


def directions(
    monodromy: Matrix[Ball], multipliers: tuple[Ball, Ball], scale: tuple[Fraction, Fraction]
) -> Matrix[Ball]:
    """Return as columns the eigenvectors of two multipliers; in units of ``scale`` of length 1.

    The rows of Φ' - λ annihilate them: the longer one is used.
    """
    X, V = map(interval.ball, scale)
    (a, b), (c, d) = monodromy
    b, c = b * V / X, c * X / V
    columns = []
    for multiplier in multipliers:
        rows = (b, multiplier - a), (multiplier - d, c)
        lengths = [(x * x + v * v).sqrt() for x, v in rows]
        longer = 0 if lengths[0] > lengths[1] else 1
        x, v = (entry / lengths[longer] for entry in rows[longer])
        columns.append((x * X, v * V))
    (p, r), (q, s) = columns
    return (p, q), (r, s)
