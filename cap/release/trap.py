"""An interval that the release map takes into itself, found in floats: it steers the prover."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from cap.errors import BadInput
from cap.flow.event import Expected
from cap.parameters import Parameters
from cap.release.passage import foreseen, words

PLACES = 400  # between the walls, at which the map is looked at
TRANSIENT, SEEN = 100, 60  # iterates
SAMPLES = 40  # of an interval
MARGINS = (0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)  # of the length of the core


@dataclass(frozen=True)
class Value:
    """The release map at a place, in floats."""

    x: float
    value: float
    slope: float
    words: tuple[str, ...]


@dataclass(frozen=True)
class Trap:
    """An interval around a ``critical`` point, whose releases have the ``events``, nearly."""

    lower: Fraction
    upper: Fraction
    critical: float
    events: tuple[Expected, ...]


def value(p: Parameters, x: float) -> Value | None:
    """Return the release map at a place, if there is a next release."""
    try:
        events, place, slope = foreseen(p, x)
    except (BadInput, ArithmeticError, ValueError):
        return None
    return Value(x, place, slope, words(events))


def critical_points(p: Parameters) -> list[float]:
    """Return the critical points of the release map in its branches on which its orbits end."""
    seen = {words for start in (2, 5, 8) for words in _ends(p, _place(p, start / 10))}
    found: list[float] = []
    grid = [value(p, _place(p, (k + 0.5) / PLACES)) for k in range(PLACES)]
    for a, b in pairwise(grid):
        if a and b and a.words == b.words and a.words in seen and a.slope * b.slope < 0:
            found.append(_root(p, a, b))
    return found


def _place(p: Parameters, part: float) -> float:
    return float(p.l) + part * float(p.R)


def _ends(p: Parameters, x: float) -> Iterator[tuple[str, ...]]:
    """Yield the itineraries of late iterates."""
    for n in range(TRANSIENT + SEEN):
        here = value(p, x)
        if here is None:
            return
        if n >= TRANSIENT:
            yield here.words
        x = here.value


def _root(p: Parameters, a: Value, b: Value) -> float:
    """Return the zero of the slope between two places."""
    for _ in range(60):
        middle = value(p, (a.x + b.x) / 2)
        if middle is None or not a.x < middle.x < b.x:
            break
        a, b = (middle, b) if middle.slope * a.slope > 0 else (a, middle)
    return (a.x + b.x) / 2


def turning_point(p: Parameters, near: float) -> Value | None:
    """Return the release map where its slope vanishes, near a place."""
    for reach in (0.01, 0.02, 0.04):
        a, b = (value(p, near + side * reach * float(p.R)) for side in (-1, 1))
        if a and b and a.slope * b.slope < 0:
            return value(p, _root(p, a, b))
    return None


def trap(p: Parameters, near: float) -> Trap:
    """Return an interval around a critical point that is mapped into itself with one itinerary.

    It is the largest of some around the core, which lies between the first two images of the
    critical point.  Raises `BadInput` if there is none.
    """
    c = value(p, near)
    first = value(p, c.value) if c else None
    if not c or not first:
        raise BadInput(f"after a release at x = {near:.6g} there is no next one, or none after it")
    ends = sorted((c.value, first.value))
    for margin in MARGINS:
        step = margin * (ends[1] - ends[0])
        steep = 1.5 * max(1.0, abs(first.slope)) * step
        low, high = (step, steep) if c.value < first.value else (steep, step)
        lower, upper = _short(ends[0] - low, step), _short(ends[1] + high, step)
        if _is_trap(p, c, lower, upper, step / 10):
            return Trap(lower, upper, near, foreseen(p, near)[0])
    raise BadInput(
        f"around the critical point x = {near:.6g} of the release map no interval was found that is"
        " mapped into itself with one itinerary and one turning point; over a range of f several"
        " itineraries are allowed: theorem attractor, --from Q --to Q"
    )


def _short(x: float, step: float) -> Fraction:
    """Return a decimal close to x, compared with the step."""
    grid = 10 ** max(0, 2 - round(_decade(step)))
    return Fraction(round(x * grid), grid)


def _decade(step: float) -> float:
    return len(f"{step:.0f}") if step >= 1 else float(f"{step:e}".partition("e")[2])


def _is_trap(p: Parameters, c: Value, lower: Fraction, upper: Fraction, room: float) -> bool:
    """Return whether samples of an interval are mapped inside by one itinerary, with one turn."""
    if not p.l < lower < upper < p.r:
        return False
    a, b = float(lower), float(upper)
    samples = [value(p, a + (b - a) * k / SAMPLES) for k in range(SAMPLES + 1)]
    if not all(y and y.words == c.words and a + room < y.value < b - room for y in samples):
        return False
    rising = [{y.slope > 0 for y in samples if y and (y.x < c.x) == left} for left in (True, False)]
    return len(rising[0]) == len(rising[1]) == 1 and rising[0] != rising[1]
