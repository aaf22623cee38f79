"""The unstable and the stable curve of a saddle P* of Φ, parameterized, with a proved error.

Let λ be a multiplier of P*, e its eigenvector, and W the parameterization of its curve with

    Φ(W(s)) = W(λ s),    W(0) = P*,    W'(0) = e,

which exists, is unique and analytic near 0 (Poincaré; Cabré, Fontich and de la Llave 2003), and
follows for larger s from the equation.  Let P be its Taylor polynomial of degree N, whose
coefficients a_k solve (Φ'(P*) - λ^k) a_k = -r_k, r_k the k-th coefficient of Φ(a_0 + .. + a_(k-1)
s^(k-1)): enclosures of them are computed.  P below is the true polynomial.

*Lemma.*  Vectors are written in the frame A of the eigenvectors, inequalities and absolute values
are meant entry by entry.  Let G(s) = Φ(P(s)) - P(λ s) on S, where S = [-1, 1] if |λ| < 1, and
[-1/|λ|, 1/|λ|] if |λ| > 1.  As all its coefficients up to N vanish, |G(s)| <= ε |s|^(N+1) with ε
the largest coefficient of order N + 1 of Φ∘P at the points of S.  Let C > 0, let B enclose Φ' on
convex boxes that contain P(s) + [-C, C], and let M be regular matrices, one for each s.  If

    |λ| > 1:    |λ|^-(N+1) (ε + |B| C) < C,
    |λ| < 1:    |M^-1| ε + (|1 - M^-1 B| + |M^-1| |λ|^(N+1)) C < C,

then |W(s) - P(s)| <= C |s|^(N+1) for |s| <= 1.  If D > 0 has, with H >= |Φ''| as a bilinear form,

    |λ| > 1:    |λ|^-(N+1) ((N+1) ε + H(C, p) + |B| D) < D,
    |λ| < 1:    |M^-1| ((N+1) ε + H(C, p)) + (|1 - M^-1 B| + |M^-1| |λ|^(N+1)) D < D,

with p >= |P'(s)| on S, then |W'(s) - P'(s)| <= D |s|^N.

*Proof.*  |λ| > 1: let (T h)(s) = Φ(P(s/λ) + h(s/λ)) - P(s), on the bounded h with |h(s)| <= C
|s|^(N+1).  By the mean value theorem |T h(s)| <= (ε + |B| C) |s/λ|^(N+1), so T maps this set into
itself, and for the same reason it contracts, in the norm max |h_i(s)| / (C_i |s|^(N+1)).  Its fixed
point h has W = P + h as a solution.  It is the analytic one: that differs from P by O(s^(N+1)), so
near 0 the two lie in a set on which T contracts.  |λ| < 1: the same with (T h)(s) = h(s) - M^-1
[Φ(P(s) + h(s)) - P(λ s) - h(λ s)], for T h - T h' has the size (|1 - M^-1 B| + |M^-1| |λ|^(N+1))
max |h - h'| / |s|^(N+1), and T 0 = -M^-1 G; and W(s) = Φ^-1(W(λ s)) is analytic, as Φ is injective
where orbits never stop (backwards in time they are determined), and its derivative regular.
Derivatives: h' is analytic and O(s^N), so d = sup
|h'(s)| / |s|^N is finite.  Differentiate the equations: G' is at most (N+1) ε |s|^N, Φ'(W) - Φ'(P)
applied to P' at most H(C, p) |s|^(N+1), so d <= left side with d for D; with the condition for D
this gives d <= D, as a non-negative matrix K with K D < D has a spectral radius below 1.  QED
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import comb
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.flow.event import BALLS
from cap.flow.jet_transport import transported
from cap.flow.model import Oscillator
from cap.flow.strobe import Orbit, strobe
from cap.flow.windows import Itinerary, find_windows
from cap.maps.fixed_point import FixedPoint
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.jet import Jet, Space
from cap.sets.matrix import Matrix

PIECES = 64  # into which each half of S is cut
FIRST = Fraction(1, 2**40)  # the C that is tried first
TRIALS = 6  # of C


@dataclass(frozen=True)
class Curve:
    """W(s) for |s| <= 1: |W - P| <= C |s|^(N+1) and |W' - P'| <= D |s|^N in the ``frame``.

    ``coefficients`` are those of P, enclosed; ``multiplier`` is λ.
    """

    multiplier: Ball
    coefficients: tuple[Box, ...]
    frame: Matrix[Ball]
    error: Box
    slope_error: Box

    @property
    def degree(self) -> int:
        """N."""
        return len(self.coefficients) - 1

    def at(self, s: Ball) -> Box:
        """Enclose W(s), for all s of a ball in [-1, 1]."""
        return self._near(_values(self.coefficients, s), self.error, s, self.degree + 1)

    def tangent(self, s: Ball) -> Box:
        """Enclose W'(s), likewise."""
        slopes = tuple((k * x, k * v) for k, (x, v) in enumerate(self.coefficients))[1:]
        return self._near(_values(slopes, s), self.slope_error, s, self.degree)

    def _near(self, value: Box, error: Box, s: Ball, power: int) -> Box:
        if not abs(s) <= 1:
            raise NotProved("curve", "the parameter may be outside of [-1, 1]", {"s": s})
        size = interval.upper(abs(s)) ** power
        aside = interval.symmetric(error[0] * size), interval.symmetric(error[1] * size)
        x, v = matrix.apply(self.frame, aside)
        return value[0] + x, value[1] + v


class _Bounds(NamedTuple):
    """On all of S, in the frame: ε, |B|, |1 - M^-1 B|, |M^-1|, p, and |Φ''| as two matrices."""

    epsilon: Box
    B: Matrix[Ball]
    rest: Matrix[Ball]
    inverse: Matrix[Ball]
    slope: Box
    second: tuple[Matrix[Ball], Matrix[Ball]]


def curve(
    osc: Oscillator[Any],
    point: FixedPoint,
    frame: Matrix[Ball],
    multipliers: tuple[Ball, Ball],
    which: int,
    degree: int = 12,
) -> Curve:
    """Prove the lemma for the unstable curve (``which`` 0) or the stable one (1).

    ``frame`` encloses eigenvectors of the ``multipliers`` as columns: W'(0) is the column, so its
    length says how much of the curve |s| <= 1 is.  Raises `NotProved` if no C or D serves: the
    column is too long, or the degree too low.
    """
    return _Prover(osc, point, frame, multipliers, which, degree).prove()


@dataclass(frozen=True)
class _Prover:
    osc: Oscillator[Any]
    point: FixedPoint
    frame: Matrix[Ball]
    multipliers: tuple[Ball, Ball]
    which: int
    degree: int

    @property
    def multiplier(self) -> Ball:
        return self.multipliers[self.which]

    def prove(self) -> Curve:
        coefficients = self.coefficients()
        C: Box = interval.ball(FIRST), interval.ball(FIRST)
        for _ in range(TRIALS):
            bounds = self.bounds(coefficients, C)
            better = self.solved(bounds, bounds.epsilon)
            if all(b <= c for b, c in zip(better, C, strict=True)) and self.serves(
                bounds, bounds.epsilon, better
            ):
                D = self.slope_error(bounds, better)
                return Curve(self.multiplier, coefficients, self.frame, better, D)
            C = better[0] * 2, better[1] * 2
        raise NotProved("curve", "no bound of the remainder serves", {"C": C})

    def slope_error(self, bounds: _Bounds, C: Box) -> Box:
        """Return D."""
        n, p = self.degree + 1, bounds.slope
        e, H = bounds.epsilon, bounds.second
        given = n * e[0] + _form(H[0], C, p), n * e[1] + _form(H[1], C, p)
        D = self.solved(bounds, given)
        if not self.serves(bounds, given, D):
            raise NotProved("curve", "no bound of the remainder's derivative serves", {"D": D})
        return D

    def system(self, bounds: _Bounds, given: Box) -> tuple[Matrix[Ball], Box]:
        """Return K and c: the condition of the lemma is K C + c < C."""
        power = abs(self.multiplier) ** (self.degree + 1)
        if self.which == 0:
            (a, b), (c, d) = bounds.B
            return ((a / power, b / power), (c / power, d / power)), (
                given[0] / power,
                given[1] / power,
            )
        (a, b), (c, d) = bounds.rest
        (e, f), (g, h) = bounds.inverse
        K = (a + e * power, b + f * power), (c + g * power, d + h * power)
        return K, matrix.apply(bounds.inverse, given)

    def serves(self, bounds: _Bounds, given: Box, C: Box) -> bool:
        """Return whether K C + c < C."""
        K, c = self.system(bounds, given)
        image = matrix.apply(K, C)
        return all(y + z < x for x, y, z in zip(C, image, c, strict=True))

    def solved(self, bounds: _Bounds, given: Box) -> Box:
        """Return numbers C somewhat above the solution of K C + c = C."""
        K, c = self.system(bounds, given)
        (a, b), (d, e) = matrix.minus_identity(K)
        least = interval.ball(FIRST) ** 8
        C = matrix.apply(matrix.inverse(((-a, -b), (-d, -e))), c)
        if not all(x > -least for x in C):
            raise NotProved("curve", "the map may not contract: a longer power serves", {"K": K})
        return interval.upper(C[0] + least) * 2, interval.upper(C[1] + least) * 2

    def coefficients(self) -> tuple[Box, ...]:
        """Enclose a_0, .., a_N."""
        column = self.frame[0][self.which], self.frame[1][self.which]
        found: list[Box] = [self.point.box, column]
        (a, b), (c, d) = self.point.orbit.monodromy
        for k in range(2, self.degree + 1):
            x, v = (_jet([z[i] for z in found], k) for i in (0, 1))
            image = transported(self.osc, self.point.orbit, x, v)
            power = self.multiplier**k
            inverse = matrix.inverse(((a - power, b), (c, d - power)))
            x_k, v_k = matrix.apply(inverse, (image[0][k,], image[1][k,]))
            found.append((-x_k, -v_k))
        return tuple(found)

    def bounds(self, coefficients: tuple[Box, ...], C: Box) -> _Bounds:
        """Return what the lemma needs, the largest over all pieces of S."""
        found, length = list[_Bounds](), 1 if self.which else 1 / abs(self.multiplier)
        for side in (1, -1):
            events = self.point.events
            for n in range(PIECES):
                ends = (interval.ball(Fraction(side * k, PIECES)) * length for k in (n, n + 1))
                events, piece = self.piece(coefficients, C, interval.hull(*ends), events)
                found.append(piece)
        return _largest(found)

    def piece(
        self, coefficients: tuple[Box, ...], C: Box, s: Ball, events: Itinerary
    ) -> tuple[Itinerary, _Bounds]:
        """Return the windows of the hits, and the bounds, on a piece of S."""
        back, order = matrix.inverse(self.frame), self.degree + 1
        taylor = [_values(_shifted(coefficients, k), s) for k in range(self.degree + 1)]
        tube = matrix.apply(self.frame, (interval.symmetric(C[0]), interval.symmetric(C[1])))
        box = taylor[0][0] + tube[0], taylor[0][1] + tube[1]
        events, orbit = find_windows(self.osc, box, events, BALLS)
        x, v = (_jet([z[i] for z in taylor], order) for i in (0, 1))
        image = transported(self.osc, orbit, x, v)
        epsilon = _sizes(matrix.apply(back, (image[0][order,], image[1][order,])))
        first, second = self.derivatives(orbit, box, events)
        inverse = matrix.inverse(_points(first))
        rest = _entries(matrix.minus_identity(matrix.product(inverse, first)))
        slope = _sizes(matrix.apply(back, taylor[1]))
        return events, _Bounds(epsilon, _entries(first), rest, _entries(inverse), slope, second)

    def derivatives(
        self, orbit: Orbit[Ball], box: Box, events: Itinerary
    ) -> tuple[Matrix[Ball], tuple[Matrix[Ball], Matrix[Ball]]]:
        """Enclose Φ' and |Φ''| over a box, in the frame: Φ' by the mean value theorem."""
        m = interval.point(box[0]), interval.point(box[1])
        rows = matrix.inverse(self.frame)
        p, q = matrix.apply(rows, (box[0] - m[0], box[1] - m[1]))
        first, second = list[Box](), list[Matrix[Ball]]()
        middle = strobe(self.osc, m, events, BALLS)
        for here, wide in zip(self.turned(middle, m), self.turned(orbit, box), strict=True):
            a, b, c = 2 * wide[2, 0], wide[1, 1], 2 * wide[0, 2]
            first.append((here[1, 0] + a * p + b * q, here[0, 1] + b * p + c * q))
            second.append(((abs(a), abs(b)), (abs(b), abs(c))))
        return (first[0], first[1]), (second[0], second[1])

    def turned(self, orbit: Orbit[Ball], box: Box) -> list[Jet]:
        """Return jets of Φ at all points of a box, in the frame before and after."""
        p, q = Jet.variables((Ball(0), Ball(0)), 2)
        (a, b), (c, d) = self.frame
        x, v = transported(self.osc, orbit, p * a + q * b + box[0], p * c + q * d + box[1])
        return [x * row[0] + v * row[1] for row in matrix.inverse(self.frame)]


def _jet(coefficients: list[Ball], order: int) -> Jet:
    """Return the jet in one variable with these first coefficients."""
    space = Space(1, order)
    return Jet(space, coefficients + [Ball(0)] * (space.size - len(coefficients)))


def _shifted(coefficients: tuple[Box, ...], k: int) -> tuple[Box, ...]:
    """Return the coefficients of the k-th derivative divided by k!."""
    pairs = enumerate(coefficients[k:], start=k)
    return tuple((comb(j, k) * x, comb(j, k) * v) for j, (x, v) in pairs)


def _values(coefficients: tuple[Box, ...], s: Ball) -> Box:
    """Return the value of a polynomial, by Horner's rule."""
    x, v = coefficients[-1]
    for a, b in reversed(coefficients[:-1]):
        x, v = x * s + a, v * s + b
    return x, v


def _sizes(z: Box) -> Box:
    return abs(z[0]), abs(z[1])


def _entries(m: Matrix[Ball]) -> Matrix[Ball]:
    return _sizes(m[0]), _sizes(m[1])


def _points(m: Matrix[Ball]) -> Matrix[Ball]:
    (a, b), (c, d) = m
    return (interval.point(a), interval.point(b)), (interval.point(c), interval.point(d))


def _form(second: Matrix[Ball], a: Box, b: Box) -> Ball:
    """Return the bilinear form of a symmetric matrix."""
    x, v = matrix.apply(second, b)
    return a[0] * x + a[1] * v


def _largest(found: list[_Bounds]) -> _Bounds:
    """Return upper bounds, entry by entry, of what was found on the pieces."""

    def most(values: list[Any]) -> Any:
        if isinstance(values[0], tuple):
            return tuple(most([value[k] for value in values]) for k in range(len(values[0])))
        return reduce(lambda a, b: a.max(b), map(interval.upper, values))

    return _Bounds(*(most([bounds[k] for bounds in found]) for k in range(len(_Bounds._fields))))
