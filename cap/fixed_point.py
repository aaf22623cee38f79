"""A non-sticking fixed point of the stroboscopic map, from a float guess to tight enclosures.

The functions here choose boxes, windows and preconditioners; all that they choose is proved by
`cap.flow` and `cap.krawczyk`, so no choice needs trust.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from cap import interval, matrix
from cap.errors import NotProved
from cap.flow import BALLS, TAYLOR_MODELS, Enclosure, NoCertainHit, Orbit, over, strobe
from cap.interval import Ball, Box
from cap.krawczyk import Preconditioner, contract, operator
from cap.model import Oscillator
from cap.scalar import S
from cap.taylor_model import Domain, TaylorModel

Windows = tuple[Ball, ...]
Reach = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Start:
    """A guess: the state at t = 0 and the hit times, as floats."""

    x: float
    v: float
    hit_times: tuple[float, ...]


@dataclass(frozen=True)
class FixedPoint:
    """A proved fixed point P*: the only one in the rectangle S of half-widths ``reach`` around m.

    m is the centre of ``hint``.  P* lies in ``box``; ``orbit`` encloses the orbits from there.
    """

    hint: Preconditioner
    reach: Reach
    box: Box
    orbit: Orbit[Ball]


class Existence(NamedTuple):
    """A rectangle S with exactly one fixed point: it lies in ``box``, in the interior of S.

    ``orbit`` encloses the orbits from S, ``image`` is Φ(m).
    """

    box: Box
    orbit: Orbit[Ball]
    image: Box


def existence(
    osc: Oscillator[Ball], hint: Preconditioner, reach: Reach, windows: Windows
) -> Existence:
    """Prove that Φ has exactly one fixed point in the rectangle m ± ``reach``."""
    box = hint.box(reach)
    orbit = strobe(osc, box, windows, BALLS)
    with interval.guarded():  # K cannot be narrower than Φ(m)
        image = strobe(osc, hint.point, tuple(hit.time for hit in orbit.hits), BALLS).end
    return Existence(contract(hint, image, orbit.monodromy, box), orbit, image)


def prove(
    osc: Oscillator[Ball], start: Start, digits: int, scale: Reach = (Fraction(1), Fraction(1))
) -> FixedPoint:
    """Prove that a fixed point exists near ``start``; enclose it to about ``digits`` digits.

    Digits are relative to ``scale``, the units of x and v.  The fixed point is proved to be alone
    in the rectangle m ± 10^(2 - digits) scale, where m has just that many digits.
    """
    hint, times = _refined(osc, start, [digits - interval.decade(unit) for unit in scale])
    radius = Fraction(100, 10**digits)
    reach = radius * scale[0], radius * scale[1]
    windows = find_windows(osc, hint.box(reach), times, BALLS)
    box, orbit, image = existence(osc, hint, reach, windows)
    times, m = tuple(hit.time for hit in orbit.hits), hint.point
    while True:  # P* in box implies P* in K(box), with Φ' between m and P*: until nothing is gained
        way = interval.hull(box[0], m[0]), interval.hull(box[1], m[1])
        k = operator(hint, image, strobe(osc, way, times, BALLS).monodromy, box)
        tighter = interval.intersection(k[0], box[0]), interval.intersection(k[1], box[1])
        if not any(10 * new.rad() < 9 * old.rad() for new, old in zip(tighter, box, strict=True)):
            return FixedPoint(hint, reach, box, strobe(osc, box, times, BALLS))
        box = tighter


def _refined(
    osc: Oscillator[Ball], start: Start, places: Sequence[int]
) -> tuple[Preconditioner, Windows]:
    """Return a point of ``places`` decimals close to a fixed point, with C and hit times.

    Newton's iteration on midpoints, from the guess; nothing is proved here.
    """
    centre = Fraction(start.x), Fraction(start.v)
    times: Windows = tuple(interval.ball(Fraction(t)) for t in start.hit_times)
    for _ in range(max(places).bit_length() + 4):
        point = interval.ball(centre[0]), interval.ball(centre[1])
        windows = find_windows(osc, point, times, BALLS)
        orbit = strobe(osc, point, windows, BALLS)
        times = tuple(interval.point(hit.time) for hit in orbit.hits)
        inverse = matrix.inverse(matrix.minus_identity(orbit.monodromy))
        defect = orbit.end[0] - point[0], orbit.end[1] - point[1]
        step = tuple(interval.midpoint(entry) for entry in matrix.apply(inverse, defect))
        centre = round(centre[0] - step[0], places[0]), round(centre[1] - step[1], places[1])
        if all(abs(s) * 10**p < 1 for s, p in zip(step, places, strict=True)):
            break
    (a, b), (c, d) = inverse
    rows = (_short(a), _short(b)), (_short(c), _short(d))
    return Preconditioner(centre, rows), times


def _short(x: Ball) -> Fraction:
    """Return a decimal with about ten digits near ``x``."""
    return Fraction(f"{float(x.mid()):.9e}")


def find_windows(
    osc: Oscillator[S], state: tuple[S, S], times: Sequence[Ball], kind: Enclosure[S]
) -> Windows:
    """Return time windows, near ``times``, for which `strobe` succeeds; it only steers.

    A window that does not contain its Newton image is widened to hold it (epsilon inflation).
    """
    windows = list(times)
    for _ in range(20 * len(windows) + 20):
        try:
            orbit = strobe(osc, state, tuple(windows), kind)
        except NoCertainHit as miss:
            windows[miss.number - 1] = _inflated(interval.hull(miss.window, miss.newton))
        else:
            return _with_slack(osc, state, orbit, kind) or tuple(windows)
    raise NotProved("windows", "the hit times vary too much on the box", {"windows": windows})


def _with_slack(
    osc: Oscillator[S], state: tuple[S, S], orbit: Orbit[S], kind: Enclosure[S]
) -> Windows | None:
    """Return windows a little larger than the hit times of ``orbit``, if `strobe` succeeds."""
    windows = tuple(_inflated(kind.bound(hit.time)) for hit in orbit.hits)
    try:
        strobe(osc, state, windows, kind)
    except NotProved:
        return None
    return windows


def _inflated(window: Ball) -> Ball:
    """Return a ball a little larger than ``window``, even if that is a point."""
    tenth = interval.symmetric(window - interval.point(window)) / 10
    return window + tenth + interval.symmetric(window) * interval.rounding()


@dataclass(frozen=True)
class Neighbourhood:
    """The rectangle of half-widths ``reach`` around m holds one fixed point only.

    All orbits from there are non-sticking on [0, T] and make their hits in ``windows``.
    """

    reach: Reach
    windows: Windows


def neighbourhood(osc: Oscillator[Ball], point: FixedPoint, reach: Reach) -> Neighbourhood:
    """Prove that Φ has exactly one fixed point in the rectangle of half-widths ``reach`` around m.

    Over Taylor models of order two, which hardly overestimate Φ' even on large boxes.
    """
    models, hint, m = over(osc, TaylorModel), point.hint, point.hint.point
    box = hint.box(reach)
    x, v = Domain((box[0] - m[0], box[1] - m[1]), 2).variables(m)  # contains the box
    times = tuple(hit.time for hit in point.orbit.hits)
    windows = find_windows(models, (x, v), times, TAYLOR_MODELS)
    slope = strobe(models, (x, v), windows, TAYLOR_MODELS).monodromy
    image = strobe(osc, m, windows, BALLS).end
    contract(hint, image, slope, box, TaylorModel.bound)
    return Neighbourhood(reach, windows)


def largest_neighbourhood(osc: Oscillator[Ball], point: FixedPoint, scale: Reach) -> Neighbourhood:
    """Return the largest rectangle found, of half-widths a multiple of ``scale``.

    From 2^-7 (halved first until it succeeds) the multiple is doubled until it fails or exceeds
    one, and then bisected four times.
    """

    def attempt(factor: Fraction) -> Neighbourhood | None:
        try:
            return neighbourhood(osc, point, (factor * scale[0], factor * scale[1]))
        except NotProved:
            return None

    factor = Fraction(1, 2**7)
    best = attempt(factor)
    while best is None:
        factor /= 2
        if factor < Fraction(1, 2**60):
            raise NotProved("neighbourhood", "no rectangle around the fixed point succeeded", {})
        best = attempt(factor)
    upper = 2 * factor
    while factor < 1 and (larger := attempt(upper)):
        best, factor, upper = larger, upper, 2 * upper
    for _ in range(4):
        middle = (factor + upper) / 2
        if better := attempt(middle):
            best, factor = better, middle
        else:
            upper = middle
    return best
