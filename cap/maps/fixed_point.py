"""A fixed point of Φⁿ, Φ the stroboscopic map, from a float guess to tight enclosures.

The functions here choose boxes, windows and preconditioners; all that they choose is proved by
`cap.flow.strobe` and `cap.maps.krawczyk`, so no choice needs trust.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.image import image
from cap.flow.model import Oscillator
from cap.flow.strobe import Orbit, strobe
from cap.flow.windows import Itinerary, find_windows, is_capture
from cap.maps.krawczyk import Preconditioner, contract, operator
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.taylor_model import Domain

Reach = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Start:
    """A guess: the state at t = 0, the events in (0, nT) with their times, and n, in floats.

    Of a capture the time is the end of the window of its lemma.
    """

    x: float
    v: float
    events: tuple[tuple[str, float], ...]
    periods: int = 1

    @classmethod
    def non_sticking(cls, x: float, v: float, hit_times: Sequence[float]) -> "Start":
        """Return the guess of a T-periodic orbit with hits only: the walls alternate."""
        words = ("hit r", "hit l") if v > 0 else ("hit l", "hit r")
        return cls(x, v, tuple((words[k % 2], t) for k, t in enumerate(hit_times)))

    def expected(self) -> Itinerary:
        """Return the events with windows that are points."""
        return tuple(Expected(word, interval.ball(Fraction(t))) for word, t in self.events)


@dataclass(frozen=True)
class FixedPoint:
    """A proved fixed point P*: the only one in the rectangle S of half-widths ``reach`` around m.

    m is the centre of ``hint``, n = ``periods``.  P* lies in ``box``; ``orbit`` encloses the orbits
    from there.
    """

    hint: Preconditioner
    reach: Reach
    box: Box
    orbit: Orbit[Ball]
    periods: int = 1

    @property
    def events(self) -> Itinerary:
        """The events of P*, with the times proved for windows."""
        return tuple(Expected(event.word, event.time) for event in self.orbit.events)


class Existence(NamedTuple):
    """A rectangle S with exactly one fixed point: it lies in ``box``, in the interior of S.

    ``orbit`` encloses the orbits from S, ``image`` is Φ(m).
    """

    box: Box
    orbit: Orbit[Ball]
    image: Box


def existence(
    osc: Oscillator[Any],
    hint: Preconditioner,
    reach: Reach,
    expected: Itinerary,
    periods: int = 1,
) -> Existence:
    """Prove that Φⁿ has exactly one fixed point in the rectangle m ± ``reach``."""
    box = hint.box(reach)
    found = expected, strobe(osc, box, expected, BALLS, periods)
    return _contracted(osc, hint, box, found, periods)


def _contracted(
    osc: Oscillator[Any],
    hint: Preconditioner,
    box: Box,
    found: tuple[Itinerary, Orbit[Ball]],
    periods: int,
) -> Existence:
    """Prove the same with the windows and the orbits that are found for the box."""
    expected, orbit = found
    with interval.guarded():  # K cannot be narrower than Φⁿ(m)
        end = image(osc, hint.point, tightened(orbit, expected), periods)
    return Existence(contract(hint, end, orbit.monodromy, box), orbit, end)


def tightened(orbit: Orbit[Ball], expected: Itinerary) -> Itinerary:
    """Return the itinerary with windows a little wider than the times that ``orbit`` encloses.

    What is added exceeds the rounding errors of another computation: after a capture all orbits
    have the same times, so nothing else makes them wide.  The windows of captures are kept.
    """
    rounding = interval.rounding()
    return tuple(
        old
        if is_capture(old)
        else Expected(old.word, event.time + interval.symmetric(event.time) * rounding)
        for event, old in zip(orbit.events, expected, strict=True)
    )


def prove(
    osc: Oscillator[Any], start: Start, digits: int, scale: Reach = (Fraction(1), Fraction(1))
) -> FixedPoint:
    """Prove that a fixed point exists near ``start``; enclose it to about ``digits`` digits.

    Digits are relative to ``scale``, the units of x and v.  The fixed point is proved to be alone
    in the rectangle m ± 10^(2 - digits) scale, where m has just that many digits.
    """
    hint, events = refined(osc, start, [digits - interval.decade(unit) for unit in scale])
    radius, n = Fraction(100, 10**digits), start.periods
    reach = radius * scale[0], radius * scale[1]
    rectangle = hint.box(reach)
    found = find_windows(osc, rectangle, events, BALLS, n)
    box, orbit, end = _contracted(osc, hint, rectangle, found, n)
    expected, m = tightened(orbit, found[0]), hint.point
    while True:  # P* in box implies P* in K(box), with Φ' between m and P*: until nothing is gained
        way = interval.hull(box[0], m[0]), interval.hull(box[1], m[1])
        k = operator(hint, end, strobe(osc, way, expected, BALLS, n).monodromy, box)
        tighter = interval.intersection(k[0], box[0]), interval.intersection(k[1], box[1])
        if not any(10 * new.rad() < 9 * old.rad() for new, old in zip(tighter, box, strict=True)):
            return FixedPoint(hint, reach, box, strobe(osc, box, expected, BALLS, n), n)
        box = tighter


def refined(
    osc: Oscillator[Any], start: Start, places: Sequence[int]
) -> tuple[Preconditioner, Itinerary]:
    """Return a point of ``places`` decimals close to a fixed point, with C and the events.

    Newton's iteration on midpoints, from the guess; nothing is proved here.
    """
    centre = Fraction(start.x), Fraction(start.v)
    events = start.expected()
    for _ in range(max(places).bit_length() + 4):
        point = interval.ball(centre[0]), interval.ball(centre[1])
        windows, orbit = find_windows(osc, point, events, BALLS, start.periods)
        events = tuple(
            event._replace(window=_representative(event)) for event in tightened(orbit, windows)
        )
        inverse = matrix.inverse(matrix.minus_identity(orbit.monodromy))
        defect = orbit.end[0] - point[0], orbit.end[1] - point[1]
        step = tuple(interval.midpoint(entry) for entry in matrix.apply(inverse, defect))
        centre = round(centre[0] - step[0], places[0]), round(centre[1] - step[1], places[1])
        if all(abs(s) * 10**p < 1 for s, p in zip(step, places, strict=True)):
            break
    (a, b), (c, d) = inverse
    rows = (_short(a), _short(b)), (_short(c), _short(d))
    return Preconditioner(centre, rows), events


def _representative(event: Expected) -> Ball:
    """Return the middle of the window of an event, the end of that of a capture."""
    return (interval.upper if is_capture(event) else interval.point)(event.window)


def _short(x: Ball) -> Fraction:
    """Return a decimal with about ten digits near ``x``."""
    near = float(x.mid())
    if not isfinite(near):
        raise NotProved("preconditioner", "it is beyond floats: the fixed point may be double")
    return Fraction(f"{near:.9e}")


@dataclass(frozen=True)
class Neighbourhood:
    """The rectangle of half-widths ``reach`` around m holds one fixed point only.

    All orbits from there have the events of ``expected``, in its windows.
    """

    reach: Reach
    expected: Itinerary


def neighbourhood(osc: Oscillator[Any], point: FixedPoint, reach: Reach) -> Neighbourhood:
    """Prove that Φⁿ has exactly one fixed point in the rectangle of half-widths ``reach`` around m.

    Over Taylor models of order two, which hardly overestimate Φ' even on large boxes.
    """
    hint, m, n = point.hint, point.hint.point, point.periods
    box = hint.box(reach)
    state = Domain((box[0] - m[0], box[1] - m[1]), 2).variables(m)  # contains the box
    x, v = state
    expected, orbit = find_windows(osc, (x, v), point.events, TAYLOR_MODELS, n)
    end = image(osc, m, expected, n)
    contract(hint, end, orbit.monodromy, box, TAYLOR_MODELS.bound)
    return Neighbourhood(reach, expected)


def some_neighbourhood(osc: Oscillator[Any], point: FixedPoint, scale: Reach) -> Neighbourhood:
    """Return a rectangle of half-widths a multiple of ``scale``: 2^-30 or less."""
    return _first(_attempts(osc, point, scale), Fraction(1, 2**30))[0]


def largest_neighbourhood(osc: Oscillator[Any], point: FixedPoint, scale: Reach) -> Neighbourhood:
    """Return the largest rectangle found, of half-widths a multiple of ``scale``.

    From 2^-7 (halved first until it succeeds) the multiple is doubled until it fails or exceeds
    one, and then bisected four times.
    """
    attempt = _attempts(osc, point, scale)
    best, factor = _first(attempt, Fraction(1, 2**7))
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


Attempt = Callable[[Fraction], Neighbourhood | None]


def _attempts(osc: Oscillator[Any], point: FixedPoint, scale: Reach) -> Attempt:
    def attempt(factor: Fraction) -> Neighbourhood | None:
        try:
            return neighbourhood(osc, point, (factor * scale[0], factor * scale[1]))
        except NotProved:
            return None

    return attempt


def _first(attempt: Attempt, factor: Fraction) -> tuple[Neighbourhood, Fraction]:
    while not (found := attempt(factor)):
        factor /= 2
        if factor < Fraction(1, 2**60):
            raise NotProved("neighbourhood", "no rectangle around the fixed point succeeded", {})
    return found, factor
