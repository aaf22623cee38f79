"""Strips of values of f, over which the release map is proved to be unimodal, and their pieces."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce
from itertools import pairwise

from cap.errors import NotProved
from cap.flow.event import Expected
from cap.flow.windows import Itinerary
from cap.parameters import Parameters
from cap.release.cell import Cell, slack
from cap.release.family import Family, phase
from cap.release.passage import words
from cap.release.trap import Value, turning_point, value
from cap.release.unimodal import nearby, turning
from cap.sets import interval
from cap.sets.interval import Ball

PIECES, FINEST = 12, 2**9  # of an interval: cells at least, at most
SAMPLES = 24
MARGINS = (0.01, 0.02, 0.005, 0.05, 0.002, 0.1)  # of the length of the core
DECIMALS = 10**6
SPREAD = Ball(0, 0.2)  # of the window of an event, how much wider it is than floats tell
SHORT = 0.4  # between a turn and a stick, as a phase
Ends = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Core:
    """In floats, for some f: the critical point, the coordinate that moves with f, [a, b]."""

    family: Family
    critical: float
    lower: Fraction
    upper: Fraction

    def shift(self, f: Fraction) -> float:
        """Return x - y."""
        family = self.family
        theta = float((phase(family.p, f) - family.origin).mid())
        return float(family.shear) * theta

    def expected(self, y: tuple[float, float], f: Ends) -> Itinerary:
        """Return the events foreseen over a set of y and f, with a halt where they differ by it."""
        p = self.family.p
        middle = sum(y) / 2 + self.shift((f[0] + f[1]) / 2)
        events = nearby(replace(p, f=(f[0] + f[1]) / 2), middle)
        corners = [nearby(replace(p, f=q), z + self.shift(q)) for q in f for z in y]
        if all(words(corner) == words(events) for corner in corners):
            return tuple(map(_spread, *corners))
        return halting(events)


def _spread(*events: Expected) -> Expected:
    """Return an event with a window a little wider than from its first time to its last."""
    window = reduce(interval.hull, (event.window for event in events))
    return events[0]._replace(window=window + (window - interval.point(window)) * SPREAD)


def halting(events: Itinerary) -> Itinerary:
    """Return events that end with a halt for those that end with a stick, after a turn or not."""
    *before, last = events
    if before[-1].word != "stick":
        raise NotProved("halt", "the events over a set differ by more than a turn")
    before.pop()
    if before and before[-1].word.startswith("turn"):
        turn = before.pop()
        return (*before, turn._replace(word=turn.word.replace("turn", "halt")), last)
    stick = events[-2]
    side = "left" if last.word == "release right" else "right"
    return (*before, Expected(f"halt {side}", stick.window), last)


def core(p: Parameters, near: float, low: Fraction, high: Fraction) -> Core:
    """Return the core around a critical point near a float, for f in [low, high].

    Raises `NotProved` if none is found.
    """
    here, first, last = (_critical(replace(p, f=f), near) for f in (p.f, low, high))
    theta = [float(phase(p, f).mid()) for f in (low, high)]
    shear = Fraction(round(10 * (last.value - first.value) / (theta[1] - theta[0])), 10)
    family = Family(p, low, high, shear, interval.point(phase(p, p.f)))
    second = _value(p, here.value)
    ends = sorted((here.value, second.value))
    for margin in MARGINS:
        step = margin * (ends[1] - ends[0])
        steep = 1.5 * max(1.0, abs(second.slope)) * step
        low_by, high_by = (step, steep) if here.value < second.value else (steep, step)
        a, b = (decimal(q) for q in (ends[0] - low_by, ends[1] + high_by))
        found = Core(family, here.x, a, b)
        if _stays(found, step / 10):
            return found
    raise NotProved("interval", "none is found that the release map takes into itself")


def decimal(q: float | Fraction) -> Fraction:
    """Return a short decimal near a number."""
    return Fraction(round(Fraction(q) * DECIMALS), DECIMALS)


def _critical(p: Parameters, near: float) -> Value:
    found = turning_point(p, near)
    if found is None:
        raise NotProved("critical point", "it is not found for all f", {"near": near})
    return found


def _value(p: Parameters, x: float) -> Value:
    found = value(p, x)
    if found is None:
        raise NotProved("release map", "a mass is not released again", {"x": x})
    return found


def _stays(found: Core, room: float) -> bool:
    """Return whether samples of [a, b] are mapped inside, with one turn, for some f."""
    a, b = float(found.lower), float(found.upper)
    family = found.family
    for f in (family.low, family.p.f, family.high):
        p, shift = replace(family.p, f=f), found.shift(f)
        if not p.l < a + shift < b + shift < p.r:
            return False
        seen = [value(p, a + shift + (b - a) * k / SAMPLES) for k in range(SAMPLES + 1)]
        if not all(v and a + room < v.value - shift < b - room for v in seen):
            return False
        turns = sum(u.slope * v.slope < 0 for u, v in pairwise(seen) if u and v)
        if turns != 1:
            return False
    return True


Follows = Callable[[Fraction, Fraction, Itinerary], bool]


def cover(found: Core, follows: Follows) -> list[Cell]:
    """Return cells that cover [a, b], with the events of all f and a sign of H' or H''.

    Cells are cut until the caller ``follows``.  Raises `NotProved` if one stays undecided.
    """
    a, b = found.lower, found.upper
    cuts = [a + (b - a) * k / PIECES for k in range(PIECES + 1)]
    return [cell for ends in pairwise(cuts) for cell in _decided(found, ends, follows)]


def _decided(found: Core, ends: Ends, follows: Follows) -> list[Cell]:
    a, b = ends
    finest = (found.upper - found.lower) / FINEST
    for expected in _alternatives(found, ends):
        try:
            cell = over(found, ends, expected)
        except NotProved:
            if b - a < finest:
                raise
            continue
        if _signed(cell) and follows(a, b, slack(cell.times)):
            return [cell]
    middle = (a + b) / 2
    if b - a < finest:
        raise NotProved("cells", "the release map may turn", {"y": [float(a), float(b)]})
    return _decided(found, (a, middle), follows) + _decided(found, (middle, b), follows)


def _alternatives(found: Core, ends: Ends) -> Iterator[Itinerary]:
    """Yield the events foreseen; with a halt, too, where a turn is shortly before a stick."""
    family = found.family
    expected = found.expected((float(ends[0]), float(ends[1])), (family.low, family.high))
    yield expected
    times = [float(event.window.mid()) * float(family.p.omega) for event in expected]
    if expected[-3].word.startswith("turn") and times[-2] - times[-3] < SHORT:
        yield halting(expected)


def _signed(cell: Cell) -> bool:
    return bool(cell.slope > 0 or cell.slope < 0 or (cell.curve is not None and cell.curve != 0))


def over(found: Core, ends: Ends, expected: Itinerary) -> Cell:
    """Return a cell: H over an interval of y, for all f."""
    family = found.family
    y, theta = family.variables(ends)
    curved = not any(e.word.startswith("halt") for e in expected)
    image = family.image(y, theta, expected, curved=curved)
    return Cell(*ends, image.times, image.value, image.slope, image.curve, image.half_periods)


def proved(found: Core, cells: list[Cell]) -> int:
    """Prove that H is unimodal on [a, b] and maps its ends inside; return 1 at a minimum, else -1.

    That the critical value lies inside is proved on the pieces.
    """
    if len({cell.half_periods for cell in cells}) > 1:
        raise NotProved("unimodal", "the release map takes several times")
    turn = turning(cells)
    for end in (found.lower, found.upper):
        expected = next(_alternatives(found, (end, end)))
        stays(found, over(found, (end, end), expected).value)
    return turn


def stays(found: Core, y: Ball) -> None:
    """Prove that an image lies in (a, b)."""
    if not interval.ball(found.lower) < y < interval.ball(found.upper):
        raise NotProved("interval", "the release map may not take it into its interior", {"y": y})
