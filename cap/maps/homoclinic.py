"""Homoclinic orbits of a saddle P* of Φ: proved to exist, and to be transverse.

The unstable curve near P* is the graph z_0(p) = P* + A (p, w(p)) of `cap.maps.cones`.  Its images
z_k(p) = Φ^k(z_0(p)) are carried as m_k + F_k (N_k c + E_k): c = A⁻¹ (P* - m_0) + (p, w(p)), F_k a
frame along the curve, N_k the product of the enclosures of Φ' in these frames, E_k errors.  Let
z_n(p) = P* + A (P, Q).  If P changes its sign between the ends of an interval of p, by more than
L |Q|, and |Q| <= r, then z_n(p) lies on the stable curve for a p between them; and the curves cross
there at an angle that is not zero if the tangent of W^u is outside of the cone |P| <= L |Q|.

From a guess to the interval: z_n(p) passes P* closer the better p is.  Newton's method for P(p) =
0, which is nearly that z_n lies on the stable curve, gains digits with n, until |Q| <= r.
"""

import math
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import BadInput, NotProved
from cap.flow.event import BALLS, Expected
from cap.flow.image import image
from cap.flow.itinerary import itinerary
from cap.flow.model import Oscillator
from cap.flow.windows import Itinerary, find_windows
from cap.maps.cones import Cones
from cap.parameters import Parameters
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix

LONGEST = 256  # periods of an orbit
NEWTON = 12  # steps at most, for one number of periods
SLACK = Fraction(1, 2**16)  # of a period: the windows of hits are larger by so much, if they may


class Place(NamedTuple):
    """The states z_k(p): m_k, F_k, N_k, E_k, and a box of all of them with m_k."""

    point: Box
    frame: Matrix[Ball]
    carried: Matrix[Ball]
    errors: Box
    box: Box


@dataclass(frozen=True)
class Crossing:
    """A homoclinic orbit that is proved: p lies in ``start``, and z_k in ``box``.

    ``angle``, in degrees, is that of the curves at z_k, k = ``periods``, in the plane in which
    ``scale`` has the length 1; ``hits`` are windows of the hits in all periods.
    """

    start: tuple[Fraction, Fraction]
    hits: tuple[Itinerary, ...]
    periods: int
    box: Box
    angle: Ball

    def meets(self, other: "Crossing") -> bool:
        """Return whether the boxes may have a common point."""
        return all(a.overlaps(b) for a, b in zip(self.box, other.box, strict=True))


class _Shot(NamedTuple):
    """Where z_n(p) is, for one p: P and Q, and dP/dp."""

    P: Ball
    Q: Ball
    slope: Ball


@dataclass(frozen=True)
class Shooter:
    """What homoclinic orbits are searched and proved with."""

    osc: Oscillator[Any]
    parameters: Parameters
    cones: Cones

    def crossing(self, guess: Fraction, periods: int, places: int) -> Crossing:
        """Prove that an orbit near z_0(``guess``), which is back after some periods, is homoclinic.

        Raises `NotProved` if it is not certain, or an orbit turns.
        """
        p, n = self._refined(guess, periods)
        way = Way.of(self, self._between(round(p, places), n))
        for _ in range(n):
            way.follow()
        way.crosses()
        k = max(range(1, n), key=lambda k: self._distance(way.places[k].point))
        return Crossing(way.start, tuple(way.hits), k, way.places[k].box, way.angle(k))

    def _refined(self, guess: Fraction, periods: int) -> tuple[Fraction, int]:
        """Return p and the first n with |P|, |Q| < r/2 for z_n(p); nothing is proved."""
        p, n, ahead = interval.ball(guess), periods, 2
        close = interval.ball(self.cones.reach) / 2
        while n <= LONGEST:
            p, shots = self._aimed(p, n)
            if abs(shots[-1].P) < close and abs(shots[-1].Q) < close:
                back = (k for k in range(periods, n) if abs(shots[k - 1].Q) < close)
                return interval.rational(p), next(back, n)
            rest = abs(shots[-1].Q) / close
            left = int(float(rest.log().mid()) / self._rate()) + 1
            n, ahead = n + max(1, min(ahead, left)), 2 * ahead
        raise NotProved("homoclinic point", "the orbit does not come back", {"p": p})

    def _rate(self) -> float:
        """Return about how fast states on W^s come closer, log |λ| per period."""
        p = interval.ball(self.cones.reach)
        return float(abs(self._shots(p, 1)[-1].P / p).log().mid())

    def _aimed(self, p: Ball, n: int) -> tuple[Ball, list[_Shot]]:
        """Return p with P = 0 after n periods, nearly, by Newton's method on midpoints."""
        for _ in range(NEWTON):
            shots = self._shots(p, n)
            step = interval.point(shots[-1].P / shots[-1].slope)
            if abs(shots[-1].P) < interval.ball(self.cones.slope * self.cones.reach) / 8:
                break
            p = interval.point(p - step)
        return p, shots

    def _shots(self, p: Ball, n: int) -> list[_Shot]:
        """Follow z_0(p) for n periods, in midpoints; return where z_1(p), .., z_n(p) are."""
        z, carried = _points(self.cones.at(p, Ball(0))), self.cones.columns
        back, found = matrix.inverse(self.cones.columns), list[_Shot]()
        for _ in range(n):
            _, orbit = find_windows(self.osc, z, foreseen(self.parameters, z), BALLS)
            carried = _midpoints(matrix.product(orbit.monodromy, carried))
            z = _points(orbit.end)
            P, Q = matrix.apply(back, _minus(z, self.cones.saddle))
            found.append(_Shot(P, Q, matrix.product(back, carried)[0][0]))
        return found

    def _between(self, middle: Fraction, n: int) -> tuple[Fraction, Fraction]:
        """Return an interval around a crossing: P varies by several L r on it."""
        shot = self._shots(interval.ball(middle), n)[-1]
        wide = 8 * interval.ball(self.cones.slope * self.cones.reach) / abs(shot.slope)
        half = interval.short(interval.ends(wide)[1])
        return middle - half, middle + half

    def _distance(self, z: Box) -> float:
        """Return about how far a state is from P*, in natural units."""
        p = self.parameters
        x, v = (float(q.mid()) for q in _minus(z, self.cones.saddle))
        return (x / float(p.R)) ** 2 + (v / float(p.R * p.omega)) ** 2


@dataclass
class Way:
    """The states z_0(p), z_1(p), .. for all p of the ``start``, enclosed; the hits proved."""

    shooter: Shooter
    start: tuple[Fraction, Fraction]
    inward: Box
    places: list[Place]
    turned: list[Matrix[Ball]] = field(default_factory=list)
    hits: list[Itinerary] = field(default_factory=list)

    @classmethod
    def of(cls, shooter: Shooter, start: tuple[Fraction, Fraction]) -> "Way":
        """Return the beginning."""
        cones = shooter.cones
        point = _points(cones.at(interval.ball((start[0] + start[1]) / 2), Ball(0)))
        back = matrix.inverse(cones.columns)
        way = cls(shooter, start, matrix.apply(back, _minus(cones.saddle, point)), [])
        zero = Ball(0), Ball(0)
        way._add(point, cones.columns, ((Ball(1), Ball(0)), (Ball(0), Ball(1))), zero)
        return way

    def _combinations(self, part: tuple[Fraction, Fraction]) -> Box:
        """Return c for all p of an interval."""
        p = interval.hull(*map(interval.ball, part))
        return self.inward[0] + p, self.inward[1] + self.shooter.cones.slopes * p

    def _add(self, point: Box, frame: Matrix[Ball], carried: Matrix[Ball], errors: Box) -> None:
        inner = _plus(matrix.apply(carried, self._combinations(self.start)), errors)
        box = _plus(point, matrix.apply(frame, inner))
        box = interval.hull(box[0], point[0]), interval.hull(box[1], point[1])
        self.places.append(Place(point, frame, carried, errors, box))

    def follow(self) -> None:
        """Prove the hits of the next period, and carry the states over it."""
        now, osc = self.places[-1], self.shooter.osc
        hits, orbit = find_windows(
            osc, now.box, foreseen(self.shooter.parameters, now.point), BALLS
        )
        end = image(osc, now.point, hits)
        moved = matrix.product(orbit.monodromy, now.frame)
        frame, point = self._along(moved), _points(end)
        back = matrix.inverse(frame)
        turned = matrix.product(back, moved)
        rounding = matrix.apply(back, _minus(end, point))
        errors = _plus(matrix.apply(turned, now.errors), rounding)
        self._add(point, frame, matrix.product(turned, now.carried), errors)
        slack = interval.symmetric(osc.T * interval.ball(SLACK))
        self.turned.append(turned)
        self.hits.append(tuple(hit._replace(window=hit.window + slack) for hit in hits))

    def _along(self, moved: Matrix[Ball]) -> Matrix[Ball]:
        """Return a frame of points: a tangent with a length near 1 in natural units, and across."""
        (x, _), (v, _) = moved
        p = self.shooter.parameters
        R, omega = interval.ball(p.R), interval.ball(p.omega)
        length = (x * x + v * v / (omega * omega)).sqrt() / R
        x, v = _points((x / length, v / length))
        return _points((x, -v / omega)), _points((v, x * omega))

    def crosses(self) -> None:
        """Prove that the last state is on W^s for some p, and the crossing transverse."""
        cones, last = self.shooter.cones, self.places[-1]
        back = matrix.inverse(cones.columns)
        turn = matrix.product(back, last.frame)
        centre = _plus(
            matrix.apply(back, _minus(last.point, cones.saddle)), matrix.apply(turn, last.errors)
        )
        carried = matrix.product(turn, last.carried)
        low, high, both = (
            _plus(centre, matrix.apply(carried, self._combinations(part)))
            for part in ((self.start[0],) * 2, (self.start[1],) * 2, self.start)
        )
        aside = interval.ball(cones.slope) * abs(both[1])
        inside = abs(both[1]) <= interval.ball(cones.reach)
        crossed = (low[0] < -aside and high[0] > aside) or (low[0] > aside and high[0] < -aside)
        along, across = matrix.apply(carried, (Ball(1), cones.slopes))
        steep = abs(along) > interval.ball(cones.slope) * abs(across)
        if not (inside and crossed and steep):
            sets = {"P at the ends": (low[0], high[0]), "Q": both[1], "tangent": (along, across)}
            raise NotProved("homoclinic point", "a transverse crossing is not certain", sets)

    def angle(self, k: int) -> Ball:
        """Return the angle of the curves at z_k, in degrees, in the plane of x and v/ω."""
        cones, omega, here = self.shooter.cones, self.shooter.osc.omega, self.places[k]
        home = matrix.product(matrix.inverse(self.places[-1].frame), cones.columns)
        stable = matrix.apply(home, (cones.slopes, Ball(1)))
        for turned in reversed(self.turned[k:]):
            stable = matrix.apply(matrix.adjugate(turned), (stable[0] / stable[1], Ball(1)))
        unstable = matrix.apply(here.carried, (Ball(1), cones.slopes))
        a, b = matrix.apply(here.frame, unstable)
        c, d = matrix.apply(here.frame, stable)
        b, d = b / omega, d / omega
        cosine = abs(a * c + b * d) / ((a * a + b * b) * (c * c + d * d)).sqrt()
        angle: Ball = cosine.acos() * 180 / interval.pi()
        return angle


def foreseen(p: Parameters, z: Box) -> Itinerary:
    """Return the hits of the next period from a state, in floats: hints.

    Raises `NotProved` if there is another event.
    """
    x, v = (float(q.mid()) for q in z)
    try:
        path = itinerary(p, x, v, 2 * math.pi / float(p.omega))
    except BadInput as reason:
        raise NotProved("homoclinic point", str(reason), {"x": z[0], "v": z[1]}) from None
    if any(not event.word.startswith("hit") for event in path.events):
        raise NotProved("homoclinic point", "an orbit turns", {"x": z[0], "v": z[1]})
    return tuple(Expected(e.word, interval.ball(Fraction(e.time))) for e in path.events)


def _points(z: Box) -> Box:
    return interval.point(z[0]), interval.point(z[1])


def _midpoints(m: Matrix[Ball]) -> Matrix[Ball]:
    return _points(m[0]), _points(m[1])


def _plus(a: Box, b: Box) -> Box:
    return a[0] + b[0], a[1] + b[1]


def _minus(a: Box, b: Box) -> Box:
    return a[0] - b[0], a[1] - b[1]
