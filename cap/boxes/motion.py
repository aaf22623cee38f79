"""A set of states on its way through a period: what is known of it between two events."""

from cap.boxes.flight import (
    Base,
    Constants,
    Flight,
    Matrix,
    Moment,
    NearFlight,
    drift,
    flown,
    launch,
    slow,
    spread,
)
from cap.boxes.results import LONGEST
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, is_positive, lower, upper, widened
from cap.sets.records import Record

FLY, REST, WALL, NEAR, LOST = 0, 1, 2, 3, 4

HIT_R, HIT_L, TURN_RIGHT, TURN_LEFT, STICK, CAPTURE_R, CAPTURE_L, RELEASE_R, RELEASE_L = range(9)
# the places in `cap.flow.words.WORDS`
STOPPED = 9  # a turn, a stick or a capture: not a word, but a bit beside theirs


class Motion(Record):
    """A set of motions, all with the same events so far.

    ``kind``: they fly, rest between the walls, rest at the wall ``flight.sign``, are near it, with
    these gaps and at most this speed in size, or are lost: nothing is known.  ``ended``: the end of
    the span is reached, and all below is about it.

    ``flight`` encloses when the present flight, or rest, began, and the speeds and gaps then.  The
    motions are among those that depend smoothly, by the formulas, on a point z of a set: ``base``
    and a point m.  ``centre`` is the flight for m, and at any time t of the flight

        (s x, u) for z  is in  (s x, u) for m  +  M(t) (z - m),

    M(t) the drift of the matrix (a, b, c, d), by the mean value theorem: M(t) encloses the
    derivatives at all points of the set.  At first z is the state at the beginning, and as long as
    no event was a matter of choice, ``certain``, all states of the set have been mapped by one
    smooth map.  After a choice (`rebase`) z is what is not known of the new flight.

    ``rising``: v was 0 when the flight began, for some of the motions, and the forcing has pushed
    all of them ahead since.  ``bounced``: it began with a hit.  ``words`` has a bit for each of
    `WORDS` that occurred, ``maybe`` for others that may have; ``itinerary`` lists them (`tell`).
    ``near`` is room for doubles.
    """

    kind: int
    ended: int
    certain: int
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
    stops = TURN_RIGHT <= word <= CAPTURE_L
    n.words = n.words | 1 << word | (1 << STOPPED if stops else 0)
    too_long = n.itinerary < 0 or n.itinerary >= 1 << (4 * (LONGEST - 1))
    n.itinerary = -1 if too_long else 16 * n.itinerary + word + 1


@kernel
def lose(n: Motion) -> None:
    """Give up: nothing is known."""
    n.kind, n.ended, n.certain = LOST, 1, 0


@kernel
def set_matrix(n: Motion, a: Interval, b: Interval, c: Interval, d: Interval) -> None:
    """Write the matrix."""
    n.a, n.b, n.c, n.d = a, b, c, d


@kernel
def rebase(n: Motion, first: float, second: float) -> None:
    """Let z be two numbers that differ from those of m by at most these."""
    base = n.base
    base.p, base.q, base.r, base.w, base.x, base.v = first, 0.0, 0.0, second, 0.0, 0.0


@kernel
def place_anywhere(n: Motion) -> None:
    """Let z be the gap, of a set at rest or with a speed that is known exactly."""
    f, zero = n.flight, exact(0.0)
    launch(n.centre, f.sign, Moment(f.t, f.sin, f.cos), f.speed, exact(f.gap.mid))
    rebase(n, f.gap.rad, 0.0)
    set_matrix(n, exact(-1.0), zero, zero, zero)


@kernel
def matrix_at(y: Constants, n: Motion, t: Interval) -> Matrix:
    """Return M(t)."""
    return drift(y, Matrix(n.a, n.b, n.c, n.d), t - n.flight.t)


@kernel
def ranges(y: Constants, n: Motion, at: Moment) -> tuple[Interval, Interval]:
    """Return all speeds and gaps at a moment, by the formula of the flight."""
    speed, gap = flown(y, n.centre, at)
    m = matrix_at(y, n, at.t)
    return widened(speed, spread(m.c, m.d, n.base)), widened(gap, spread(m.a, m.b, n.base))


@kernel
def keeps_moving(y: Constants, n: Motion, until: Interval) -> bool:
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
        quickly = before or is_positive(flown(y, n.flight, at)[0])
        if not (quickly or is_positive(ranges(y, n, at)[0])):
            return False
    return True
