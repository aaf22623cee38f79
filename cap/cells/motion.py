"""A set of states on its way through a period: what is known of it between two events."""

from cap.cells.flight import (
    Base,
    Flight,
    Matrix,
    Moment,
    NearFlight,
    System,
    drift,
    flown,
    slow,
    spread,
)
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, is_positive, lower, upper, widened
from cap.sets.records import Record

FLY, REST, WALL, LOST = 0, 1, 2, 3

WORDS = (
    "hit r",
    "hit l",
    "turn right",
    "turn left",
    "stick",
    "capture r",
    "capture l",
    "release right",
    "release left",
)
HIT_R, HIT_L, TURN_RIGHT, TURN_LEFT, STICK, CAPTURE_R, CAPTURE_L, RELEASE_R, RELEASE_L = range(9)
LONGEST = 15  # words of an itinerary that a number keeps: four bits each


class Motion(Record):
    """A set of motions, all with the same events so far.

    ``kind``: they fly, rest between the walls, rest at the wall ``flight.sign``, or are lost:
    nothing is known.  ``ended``: the end of the span is reached, and all below is about it.

    ``flight`` encloses when the present flight, or rest, began, and the speeds and gaps then.  If
    ``linear``, there is more: the motions depend smoothly on the states of a box, by the formulas,
    which may go on through states that do not follow them.  ``centre`` is the flight of the state
    m at which the box is based, and at any time t of the flight

        (s x, u) of z  is in  (s x, u) of m  +  M(t) (z - m),

    M(t) the drift of the matrix (a, b, c, d), by the mean value theorem: M(t) encloses the
    derivatives at all points of the box.  ``certain``: no event was a matter of choice, so that the
    states of the box have been mapped by one smooth map.

    ``rising``: v was 0 when the flight began, for some of the motions, and the forcing has pushed
    all of them ahead since.  ``bounced``: it began with a hit.  ``words`` has a bit for each of
    `WORDS` that occurred, ``maybe`` for others that may have; ``itinerary`` lists them (`tell`).  ``near`` is room for doubles.
    """

    kind: int
    ended: int
    certain: int
    linear: int
    rising: int
    bounced: int
    words: int
    maybe: int
    itinerary: int
    flight: Flight
    centre: Flight
    a: Interval
    b: Interval
    c: Interval
    d: Interval
    base: Base
    near: NearFlight


@kernel
def exact(value: float) -> Interval:
    """Return the interval of one double."""
    return Interval(value, 0.0)


@kernel
def tell(n: Motion, word: int) -> None:
    """Note an event; an itinerary that has become too long is -1."""
    n.words = n.words | 1 << word
    too_long = n.itinerary < 0 or n.itinerary >= 1 << (4 * (LONGEST - 1))
    n.itinerary = -1 if too_long else 16 * n.itinerary + word + 1


@kernel
def lose(n: Motion) -> None:
    """Give up: nothing is known."""
    n.kind, n.ended, n.certain, n.linear = LOST, 1, 0, 0


@kernel
def set_matrix(n: Motion, a: Interval, b: Interval, c: Interval, d: Interval) -> None:
    """Write the matrix."""
    n.a, n.b, n.c, n.d = a, b, c, d


@kernel
def matrix_at(y: System, n: Motion, t: Interval) -> Matrix:
    """Return M(t)."""
    return drift(y, Matrix(n.a, n.b, n.c, n.d), t - n.flight.t)


@kernel
def ranges(y: System, n: Motion, at: Moment) -> tuple[Interval, Interval]:
    """Return all speeds and gaps at a moment, by the formula of the flight."""
    if n.linear == 0:
        return flown(y, n.flight, at)
    speed, gap = flown(y, n.centre, at)
    m = matrix_at(y, n, at.t)
    return widened(speed, spread(m.c, m.d, n.base)), widened(gap, spread(m.a, m.b, n.base))


@kernel
def keeps_moving(y: System, n: Motion, until: Interval) -> bool:
    """Return whether u > 0 is certain at all slow times until then, and at the beginning.

    Then u > 0 on the whole flight, if it is also at its end: exp(μt) u is least at an end or at a
    slow time.  A flight that rises begins after a slow time and before the fast time that follows.
    """
    if not (n.rising != 0 or is_positive(n.flight.speed)):
        return False
    since = n.flight.t
    for k in range(4):
        at = slow(y, n.flight.sign, k)
        if lower(at.t) > upper(until):
            break
        before = lower(at.t) <= upper(since) if n.rising != 0 else upper(at.t) < lower(since)
        if not (before or is_positive(flown(y, n.flight, at)[0])):
            if n.linear == 0 or not is_positive(ranges(y, n, at)[0]):
                return False
    return True
