"""Cycles of the release map with the multiplier -1, where they double their period as f varies.

With f = F cos θ, x and θ are the unknowns of G^P(x) = x, (G^P)'(x) = -1.  The orbit is followed
point by point: derivatives of G at each point, over small balls, and the chain rule for G^P.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.flow.event import BALLS, Expected
from cap.flow.windows import Itinerary
from cap.maps.krawczyk import Preconditioner, operator
from cap.parameters import Parameters
from cap.release.family import over
from cap.release.jet import followed
from cap.release.passage import Passage, passage, windows
from cap.release.unimodal import nearby
from cap.sets import interval, matrix
from cap.sets.interval import Ball
from cap.sets.jet import Jet, Space
from cap.sets.matrix import Matrix

ORDER = 3


class Derivatives(NamedTuple):
    """Of G, or of an iterate: by x, by θ, and of higher order."""

    x: Ball
    t: Ball
    xx: Ball
    xt: Ball
    xxx: Ball

    def after(self, first: "Derivatives") -> "Derivatives":
        """Return those of this map after another: the chain rule."""
        x, t, xx, xt, xxx = first
        return Derivatives(
            self.x * x,
            self.x * t + self.t,
            self.xx * x**2 + self.x * xx,
            (self.xx * t + self.xt) * x + self.x * xt,
            self.xxx * x**3 + 3 * self.xx * x * xx + self.x * xxx,
        )


IDENTITY = Derivatives(Ball(1), Ball(0), Ball(0), Ball(0), Ball(0))


@dataclass(frozen=True)
class Iterate:
    """G^P over a set: its value and derivatives, the places between, the events from each."""

    places: tuple[Ball, ...]
    derivatives: Derivatives
    events: tuple[tuple[Expected, ...], ...]
    half_periods: int

    @property
    def speed(self) -> Ball:
        """The derivative of the multiplier by θ, where that is -1."""
        D = self.derivatives
        return D.xt + D.xx * D.t / 2

    @property
    def cubic(self) -> Ball:
        """What is positive if the cycles that branch off attract."""
        D = self.derivatives
        return D.xx**2 / 2 + D.xxx / 3


def at(p: Parameters, theta: Ball) -> Parameters:
    """Return the parameters with an f near F cos θ: it steers."""
    return replace(p, f=Fraction(float((theta.cos() * interval.ball(p.F)).mid())))


def mapped(
    p: Parameters, x: Ball, theta: Ball, expected: Itinerary
) -> tuple[Ball, Derivatives, Passage[Ball]]:
    """Prove the events of all releases from a ball; return G there, and its derivatives.

    G is in mean value form around the middles.
    """
    osc = over(p, theta)
    proved = passage(osc, x, windows(osc, x, expected, BALLS), BALLS)
    place, phase = Jet.variables((x, theta), ORDER)

    def lifted(space: Space) -> Any:
        return over(p, phase.truncated(space.order))

    jet = followed(lifted, place, proved.events)
    D = Derivatives(jet[1, 0], jet[0, 1], 2 * jet[2, 0], jet[1, 1], 6 * jet[3, 0])
    value = proved.value
    if not (x.is_exact() and theta.is_exact()):
        m, t = interval.point(x), interval.point(theta)
        middle = over(p, t)
        here = passage(middle, m, windows(middle, m, expected, BALLS), BALLS).value
        value = here + D.x * (x - m) + D.t * (theta - t)
    return value, D, proved


def orbit(p: Parameters, x: Ball, theta: Ball, period: int) -> Iterate:
    """Follow all orbits from a box, P times, in mean value form around its middle."""
    m, t = interval.point(x), interval.point(theta)
    near, centre, D = at(p, theta), m, IDENTITY
    places, events = [x], list[tuple[Expected, ...]]()
    halves = set[int]()
    alone = x.is_exact() and theta.is_exact()
    for _ in range(period):
        box = centre + D.x * (x - m) + D.t * (theta - t)
        expected = nearby(near, float(box.mid()))
        value, here, proved = mapped(p, box, theta, expected)
        centre = value if alone else mapped(p, centre, t, expected)[0]
        D = here.after(D)
        events.append(proved.times(BALLS.bound))
        halves.add(proved.half_periods)
        places.append(centre + D.x * (x - m) + D.t * (theta - t))
    if len(halves) > 1:
        raise NotProved("cycle", "the release map takes several times", {"half-periods": halves})
    return Iterate(tuple(places), D, tuple(events), halves.pop())


def refined(p: Parameters, x: Ball, theta: Ball, period: int, tolerance: Ball) -> tuple[Ball, Ball]:
    """Return a point near one with G^P(x) = x and (G^P)' = -1: Newton's method, no proof."""
    for _ in range(40):
        found = orbit(p, x, theta, period)
        defect = found.places[-1] - x, found.derivatives.x + 1
        step = matrix.apply(matrix.inverse(_jacobian(found)), defect)
        x, theta = (interval.point(z - s) for z, s in zip((x, theta), step, strict=True))
        if all(abs(interval.point(s)) < tolerance for s in step):
            return x, theta
    raise NotProved("cycle", "Newton's method does not come to a period doubling", {"x": x})


@dataclass(frozen=True)
class Doubling:
    """One zero (x, θ) in the box m ± ``reach``; it lies in ``box``."""

    hint: Preconditioner
    reach: tuple[Fraction, Fraction]
    box: tuple[Ball, Ball]
    orbit: Iterate


def proved(p: Parameters, x: Ball, theta: Ball, period: int, reach: Fraction) -> Doubling:
    """Prove that one cycle near has the multiplier -1, with the least period P (Krawczyk)."""
    places = interval.decade(1 / reach) + 8
    x_m, theta_m = (round(interval.rational(z), places) for z in (x, theta))
    there = orbit(p, interval.ball(x_m), interval.ball(theta_m), period)
    hint = Preconditioner((x_m, theta_m), _short(matrix.inverse(_jacobian(there))))
    reaches = reach * p.R, reach
    box = hint.box(reaches)
    found = orbit(p, *box, period)
    for y in found.places[1:-1]:
        if y.overlaps(box[0]):
            raise NotProved("cycle", "its period may be smaller", {"x": y})
    (a, b), (c, d) = _jacobian(found)
    # the zeros of H are the fixed points of z + H(z)
    image = there.places[-1], interval.ball(theta_m) + there.derivatives.x + 1
    K = operator(hint, image, ((a + 1, b), (c, d + 1)), box)
    if not hint.contains(K, reaches):
        raise NotProved("cycle", "Krawczyk's operator does not map a box into itself", {"K": K})
    return Doubling(hint, reaches, K, found)


def _jacobian(found: Iterate) -> Matrix[Ball]:
    """Return the derivative of (G^P(x) - x, (G^P)'(x) + 1) by x and θ."""
    D = found.derivatives
    return (D.x - 1, D.t), (D.xx, D.xt)


def _short(m: Matrix[Ball]) -> Matrix[Fraction]:
    (a, b), (c, d) = (tuple(Fraction(f"{float(q.mid()):.9e}") for q in row) for row in m)
    return (a, b), (c, d)
