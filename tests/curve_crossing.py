"""Where the parameterized curves of a saddle cross: Krawczyk's operator in their two parameters.

Let W_u and W_s be the curves of `cap.maps.parameterization`.  A zero of F(s, t) = Φ^k(W_u(s)) -
W_s(t) with s and t not 0 is a point of both curves: homoclinic, if it is not P*.  It is not: from
W_s(t) = P* would follow W_s(λ^n t) = P* for all n, but W_s'(0) is not 0.

Let X be a box of parameters around m and Y a matrix.  If m - Y F(m) + (1 - Y F'(X)) (X - m) lies in
the interior of X, then F has exactly one zero in X, and F' is regular at it (Neumaier 1990, Section
5.1): the tangents, which are its columns, differ, so the curves cross transversely.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.flow.event import BALLS
from cap.flow.image import image
from cap.flow.model import Oscillator
from cap.flow.windows import find_windows
from cap.maps.homoclinic import foreseen
from cap.maps.parameterization import Curve
from cap.parameters import Parameters
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix

NEWTON = 30  # steps at most


class Meeting(NamedTuple):
    """The parameters, the point Φ^k(W_u(s)) = W_s(t), and the angle of the curves, in degrees."""

    parameters: Box
    point: Box
    angle: Ball


class _Image(NamedTuple):
    """Φ^k(W_u(s)) with its derivative by s."""

    state: Box
    tangent: Box


@dataclass(frozen=True)
class Pair:
    """The unstable and the stable curve of a saddle."""

    osc: Oscillator[Any]
    parameters: Parameters
    unstable: Curve
    stable: Curve

    def meeting(self, guess: tuple[float, float], periods: int, radius: Fraction) -> Meeting:
        """Prove that the curves cross near ``guess``, once in the box of this radius around it.

        Raises `NotProved` if that is not certain.
        """
        m = self._refined(guess, periods)
        aside = interval.symmetric(interval.ball(radius))
        X = m[0] + aside, m[1] + aside
        value, slopes = self._defect(m, periods), self._slopes(X, periods)
        (a, b), (c, d) = slopes
        middle = interval.point(a), interval.point(b)
        Y = matrix.inverse((middle, (interval.point(c), interval.point(d))))
        step = matrix.apply(Y, value)
        (a, b), (c, d) = matrix.minus_identity(matrix.product(Y, slopes))
        K = m[0] - step[0] - (a + b) * aside, m[1] - step[1] - (c + d) * aside
        if not all(interval.subset_interior(k, x) for k, x in zip(K, X, strict=True)):
            sets = {"K": K, "X": X}
            raise NotProved("crossing", "K does not lie in the interior of its box", sets)
        if any(k.contains(0) for k in K):
            raise NotProved("crossing", "the curves may cross in the saddle only", {"K": K})
        unstable, stable = self._image(K[0], periods).tangent, self.stable.tangent(K[1])
        return Meeting(K, self.stable.at(K[1]), self._angle(unstable, stable))

    def _refined(self, guess: tuple[float, float], periods: int) -> Box:
        """Return a point near a zero, by Newton's method on midpoints."""
        m = interval.ball(Fraction(guess[0])), interval.ball(Fraction(guess[1]))
        for _ in range(NEWTON):
            inverse = matrix.inverse(self._slopes(m, periods))
            step = matrix.apply(inverse, self._defect(m, periods))
            m = interval.point(m[0] - step[0]), interval.point(m[1] - step[1])
            if all(q.contains(0) for q in step):
                break
        return m

    def _defect(self, m: Box, periods: int) -> Box:
        """Enclose F(m)."""
        image, other = self._image(m[0], periods).state, self.stable.at(m[1])
        return image[0] - other[0], image[1] - other[1]

    def _slopes(self, X: Box, periods: int) -> Matrix[Ball]:
        """Enclose F'(X)."""
        (a, c), (b, d) = self._image(X[0], periods).tangent, self.stable.tangent(X[1])
        return (a, -b), (c, -d)

    def _image(self, s: Ball, periods: int) -> _Image:
        """Prove that all orbits from W_u(s) hit the walls only; follow them.

        That of the middle of ``s`` is enclosed by itself, the others by the mean value theorem: by
        tangents times the distance in s.
        """
        m = interval.point(s)
        centre, tangent = self.unstable.at(m), self.unstable.tangent(s)
        for _ in range(periods):
            box = _along(centre, tangent, s - m)
            hits, orbit = find_windows(self.osc, box, foreseen(self.parameters, centre), BALLS)
            point = interval.point(centre[0]), interval.point(centre[1])
            aside = matrix.apply(orbit.monodromy, (centre[0] - point[0], centre[1] - point[1]))
            x, v = image(self.osc, point, hits)
            centre = x + aside[0], v + aside[1]
            tangent = matrix.apply(orbit.monodromy, tangent)
        return _Image(_along(centre, tangent, s - m), tangent)

    def _angle(self, unstable: Box, stable: Box) -> Ball:
        """Return the angle of two directions, in the plane of x and v/ω."""
        omega = self.osc.omega
        (a, b), (c, d) = (unstable[0], unstable[1] / omega), (stable[0], stable[1] / omega)
        cosine = abs(a * c + b * d) / ((a * a + b * b) * (c * c + d * d)).sqrt()
        angle: Ball = cosine.acos() * 180 / interval.pi()
        return angle


def _along(centre: Box, tangent: Box, distance: Ball) -> Box:
    return centre[0] + tangent[0] * distance, centre[1] + tangent[1] * distance
