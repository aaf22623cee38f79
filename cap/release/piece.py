"""Pieces of a strip of f: where the critical point is, its symbols for all f of the piece, cycles.

The critical point c(θ) lies near an affine function ĉ(θ).  If |H'(ĉ)| <= s, and |H''| >= k between,
then |ĉ - c| <= s/k and |H(ĉ) - H(c)| <= s²/k, as H' is monotone there: so H(c) is known as a Taylor
model in θ, and its images are.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from cap.errors import NotProved
from cap.parameters import Parameters
from cap.release import cycle as cycles
from cap.release.family import BOUND, Family, phase
from cap.release.strip import Core, stays
from cap.release.trap import turning_point
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import TaylorModel

MOST = 14  # symbols
WIDEST = Fraction(1, 3)  # of [a, b]: what a symbol is told of
GRID = 10**9  # of brackets
TRANSIENT, LONGEST = 400, 12  # of cycles


@dataclass(frozen=True)
class Line:
    """ĉ(θ) = at + rate (θ - θ₀); |H''| has a lower bound within ``reach``."""

    at: Fraction
    rate: Fraction
    reach: Fraction


@dataclass(frozen=True)
class Near:
    """Places at + rate (θ - θ₀) + ε with |ε| <= reach."""

    at: Ball
    rate: Ball
    reach: Ball

    def places(self, part: Family) -> Ball:
        """Return all of them."""
        return self.at + (part.theta - part.origin) * self.rate + interval.symmetric(self.reach)


def line(found: Core, part: Family) -> Line:
    """Return an affine function close to the critical points, from floats."""
    (t0, c0), (t1, c1), (t2, c2) = (_critical(found, f) for f in (part.low, part.p.f, part.high))
    rate = Fraction(round((c2 - c0) / (t2 - t0) * 10**4), 10**4)
    at = Fraction((c0 + c2 + 2 * c1) / 4) - rate * Fraction((t0 + t2 + 2 * t1) / 4)
    reach = max((part.high - part.low) / part.p.F / 2, Fraction(1, 10**4)) * part.p.R
    return Line(Fraction(round(at * GRID), GRID), rate, reach)


def _critical(found: Core, f: Fraction) -> tuple[float, float]:
    """Return θ - θ₀ and the critical point, as y."""
    p, shift = found.family.p, found.shift(f)
    here = turning_point(replace(p, f=f), found.critical + shift)
    if here is None:
        raise NotProved("critical point", "it is not found for all f")
    return float((phase(p, f) - found.family.origin).mid()), here.x - shift


def critical_point(found: Core, part: Family, near: Line, turn: int) -> tuple[Ball, Near]:
    """Return an enclosure of c for all f of the piece, and H(c(θ)), near a line."""
    theta = part.alone
    guess = _on(part, near, theta)
    middle = float(BOUND(guess).mid())
    events = found.expected((middle, middle), (part.low, part.high))
    image = part.image(guess, theta, events)
    u, t = part.variables((-near.reach, near.reach))
    bent = part.image(_on(part, near, t) + u, t, events, curved=True).curve
    if bent is None or not turn * bent > 0:
        raise NotProved("critical point", "H'' may vanish near it", {"H''": bent})
    slope = interval.upper(abs(image.slope))
    away = interval.upper(slope / interval.lower(abs(bent)))
    if not away < interval.ball(near.reach):
        raise NotProved("critical point", "it may not be near a line", {"distance": away})
    c = BOUND(guess) + interval.symmetric(away)
    value = straightened(part, image.model.widened(-turn * interval.hull(Ball(0), slope * away)))
    stays(found, c)
    stays(found, value.places(part))
    return c, value


def _on(part: Family, near: Line, theta: TaylorModel) -> TaylorModel:
    rise: TaylorModel = (theta - part.origin) * interval.ball(near.rate)
    return rise + interval.ball(near.at)


def straightened(part: Family, value: TaylorModel) -> Near:
    """Return a line near a function of θ, and perhaps of other variables before it."""
    *others, _ = value.domain.space.exponents[0]
    first, last = (0,) * (len(others) + 1), (*(0,) * len(others), 1)
    rate = interval.point(value.polynomial[last])
    middle = interval.point(part.theta)
    at = interval.point(value.polynomial[first]) - (middle - part.origin) * rate
    at = interval.point(at)
    theta = value.domain.variables([*(Ball(0) for _ in others), middle])[-1]
    rest = value - ((theta - part.origin) * rate + at)
    return Near(at, rate, interval.upper(abs(BOUND(rest))))


def image(found: Core, part: Family, y: Near) -> tuple[Near, Ball]:
    """Return H(y), and H' there."""
    low, high = map(float, interval.ends(y.places(part)))
    reach = interval.rational(interval.upper(y.reach)) + Fraction(1, 10**18)
    u, theta = part.variables((-reach, reach))
    place = (theta - part.origin) * y.rate + y.at + u
    found_there = part.image(place, theta, found.expected((low, high), (part.low, part.high)))
    return straightened(part, found_there.model), found_there.slope


def images(found: Core, part: Family, y: Near) -> Iterator[Near]:
    """Yield y = H(c), H²(c), ... for all f of the piece, while they are narrow enough to tell
    something."""
    widest = interval.ball((found.upper - found.lower) * WIDEST)
    for _ in range(MOST):
        if not 2 * y.places(part).rad() < widest:
            return
        yield y
        try:
            y = image(found, part, y)[0]
        except NotProved:
            return


def symbols(places: list[Ball], c: Ball, turn: int) -> str:
    """Return the branches: R where H decreases, L where it increases, ? where that is not
    certain."""
    branches = "RL" if turn > 0 else "LR"  # to the left of c, to the right
    return "".join(branches[0] if y < c else branches[1] if y > c else "?" for y in places)


@dataclass(frozen=True)
class Attracting:
    """J, all places up to ``reach`` from at + rate (θ - θ₀), is contracted by H^period for all f;
    the image of c with this number lies in J."""

    period: int
    at: Fraction
    rate: Fraction
    reach: Fraction
    image: int


def attracting(
    found: Core, part: Family, images: list[Near], agrees: Callable[[Attracting], bool]
) -> Attracting | None:
    """Return a cycle that is proved to attract c for all f of the piece, if one is found.

    Of the intervals J it has the longest with which the caller ``agrees``.
    """
    seen = [foreseen_cycle(part.p, found, f) for f in (part.low, part.high)]
    if len({period for period, _ in seen}) > 1 or not seen[0][0]:
        return None
    period = seen[0][0]
    t = [float((phase(part.p, f) - part.origin).mid()) for f in (part.low, part.high)]
    rate = Fraction(round((seen[1][1] - seen[0][1]) / (t[1] - t[0]) * 10**4), 10**4)
    middle = (seen[0][1] + seen[1][1]) / 2 - float(rate) * (t[0] + t[1]) / 2
    at = Fraction(round(middle * GRID), GRID)
    for exponent in range(6, 14):
        reach = Fraction(1, 2**exponent) * part.p.R
        inside = (n for n, x in enumerate(images, 1) if within(part, x, (at, rate, reach)))
        number = next(inside, 0)
        cycle = Attracting(period, at, rate, reach, number)
        if number and agrees(cycle) and contracts(found, part, (at, rate, reach), period):
            return cycle
    return None


def within(part: Family, y: Near, J: tuple[Fraction, Fraction, Fraction]) -> bool:
    """Return whether y certainly lies inside J."""
    return bool(_distance(part, y, J) + y.reach < interval.ball(J[2]))


def _distance(part: Family, y: Near, J: tuple[Fraction, Fraction, Fraction]) -> Ball:
    """Return how far the line of y is from that in the middle of J."""
    at, rate = map(interval.ball, J[:2])
    return abs((y.at - at) + (part.theta - part.origin) * (y.rate - rate))


def contracts(
    found: Core, part: Family, J: tuple[Fraction, Fraction, Fraction], period: int
) -> bool:
    """Return whether it is certain that H^period contracts J into its interior, for all f.

    And that no image before that meets J: so the period is the least one.
    """
    y, slope = Near(*map(interval.ball, J)), Ball(1)
    try:
        for n in range(period):
            if n and not _distance(part, y, J) - y.reach > interval.ball(J[2]):
                return False
            y, here = image(found, part, y)
            slope *= here
    except NotProved:
        return False
    return within(part, y, J) and bool(abs(slope) < 1)


def foreseen_cycle(p: Parameters, found: Core, f: Fraction) -> tuple[int, float]:
    """Return the period of the cycle that attracts c, in floats, and its place next to c, as y."""
    shift = found.shift(f)
    c = found.critical + shift
    cycle = cycles.foreseen_cycle(replace(p, f=f), c, TRANSIENT, LONGEST)
    return len(cycle), min(cycle, key=lambda x: abs(x - c)) - shift if cycle else 0.0
