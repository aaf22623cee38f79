"""Events that all motions of a set have, and that depend smoothly on the state.

For an event at the zero of g(t; z), near a time t_c: let w enclose ∂g/∂t for all states z of the
box and all |t - t_c| <= R, and w not contain 0.  If N = -g(t_c; z)/w, over all z, lies in the
interior of [-R, R], then g(.; z) has exactly one zero t(z) in t_c + [-R, R], for each z; it lies in
t_c + N, and depends smoothly on z.  (The interval Newton method with a parameter.)  The same for
the point m alone, with a smaller R, gives t(m).
"""

from typing import NamedTuple

from cap.boxes.flight import Constants, Moment, flown, force, launch, moment, spread, steepest
from cap.boxes.motion import (
    HIT_L,
    HIT_R,
    REST,
    STICK,
    TURN_LEFT,
    TURN_RIGHT,
    Motion,
    exact,
    keeps_moving,
    matrix_at,
    set_matrix,
    tell,
)
from cap.sets.circular import shifted
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    TINY,
    Interval,
    below,
    is_negative,
    is_positive,
    magnitude,
    widened,
)


class Zero(NamedTuple):
    """When an event happens: ``box`` over the box, ``point`` at its point m, relative to ``at``.

    ``slope`` encloses w; the ``speed`` and ``gap`` are those of the point m at ``at``.
    """

    found: bool
    at: Moment
    box: Interval
    point: Interval
    slope: Interval
    speed: Interval
    gap: Interval


@kernel
def _slope(y: Constants, at: Moment, speed: Interval, radius: float, hit: bool) -> Interval:
    """Return an enclosure of gap' = -u, or of u', within a radius of a moment."""
    most = steepest(y, at, speed, radius)
    if hit:
        return widened(-speed, magnitude(exact(most * radius)))
    turned = radius * (magnitude(at.sin) + radius) + magnitude(y.mu) * most * radius
    return widened(force(y, at.cos, speed), magnitude(Interval(turned, TINY)))


@kernel
def _radius(value: Interval, slope: float) -> float:
    """Return a radius in which -value/slope may lie; any number will do."""
    return 1.25 * (abs(value.mid) + value.rad) / abs(slope) + 1e-15


@kernel
def _zero(y: Constants, n: Motion, time: float, hit: bool) -> Zero:
    """Prove that all motions have the event near a time, if they follow the formula until then."""
    at = moment(n.flight.sign, exact(time))
    speed, gap = flown(y, n.centre, at)
    m = matrix_at(y, n, at.t)
    speeds = widened(speed, spread(m.c, m.d, n.base))
    gaps = widened(gap, spread(m.a, m.b, n.base))
    value, values = (gap, gaps) if hit else (speed, speeds)
    guess = -speeds.mid if hit else force(y, at.cos, speed).mid
    radius, found, steps, slope = _radius(values, guess), False, values, values
    for _ in range(3):
        slope = _slope(y, at, speeds, radius, hit)
        steps = -values / slope
        found = magnitude(steps) < radius
        if found:
            break
        radius = 1.5 * magnitude(steps)
    small = _radius(value, guess)
    step = -value / _slope(y, at, speed, small, hit)
    return Zero(found and magnitude(step) < small, at, steps, step, slope, speed, gap)


@kernel
def _moved(at: Moment, by: Interval) -> Moment:
    sine, cosine = shifted(at.sin, at.cos, by)
    return Moment(at.t + by, sine, cosine)


@kernel
def reversed_(at: Moment) -> Moment:
    """Return a moment as a flight of the other sign sees it."""
    return Moment(at.t, -at.sin, -at.cos)


@kernel
def hit(y: Constants, n: Motion, time: float, end: Moment) -> bool:
    """Prove that all motions hit the wall ahead near a time and before the end; then pass the hit.

    The speed u at the hit has the derivative ∂u + u' ∂t, ∂t = -∂(s x)/u that of the time.
    The saltation matrix ((-e, 0), (κ, -e)), κ = ((1 + e) cos t + (1 - e) α)/u, is mirrored.
    """
    z = _zero(y, n, time, True)
    box, point = _moved(z.at, z.box), _moved(z.at, z.point)
    if not (z.found and below(box.t, end.t) and keeps_moving(y, n, box.t)):
        return False
    m = matrix_at(y, n, box.t)
    rate = force(y, box.cos, -z.slope) / -z.slope
    one = z.speed + z.point * _slope(y, z.at, z.speed, magnitude(z.point), False)
    speed = widened(one, spread(m.c - rate * m.a, m.d - rate * m.b, n.base))
    if not is_positive(speed):
        return False
    sign = -n.flight.sign
    if y.elastic != 0:
        kick = 2.0 * box.cos / speed
        set_matrix(n, m.a, m.b, m.c - kick * m.a, m.d - kick * m.b)
    else:
        e = y.e
        kick = ((1.0 + e) * box.cos + (1.0 - e) * y.alpha) / speed
        set_matrix(n, e * m.a, e * m.b, e * m.c - kick * m.a, e * m.d - kick * m.b)
        speed, one = e * speed, e * one
    tell(n, HIT_L if sign > 0 else HIT_R)
    launch(n.flight, sign, reversed_(box), speed, y.width)
    launch(n.centre, sign, reversed_(point), one, y.width)
    n.rising, n.bounced = 0, 1
    return True


@kernel
def stop(y: Constants, n: Motion, time: float, end: Moment) -> bool:
    """Prove that all speeds vanish near a time, before the end and the wall; pass turn or stick.

    There (s x) has the derivative that it has at a fixed time, as u = 0.
    """
    z = _zero(y, n, time, False)
    box, point = _moved(z.at, z.box), _moved(z.at, z.point)
    falls = is_negative(z.slope) and below(box.t, end.t)
    if not (z.found and falls and keeps_moving(y, n, box.t)):
        return False
    m = matrix_at(y, n, box.t)
    step = magnitude(z.point)
    flown_on = step * (magnitude(z.speed) + magnitude(z.slope) * step)
    one = widened(z.gap, magnitude(Interval(flown_on, TINY)))
    gap = widened(one, spread(m.a, m.b, n.base))
    pushed = box.cos + y.alpha
    turns, sticks = is_negative(pushed), is_positive(pushed) and is_negative(box.cos - y.alpha)
    if not (is_positive(gap) and (turns or sticks)):
        return False
    sign, zero = n.flight.sign, exact(0.0)
    n.bounced = 0
    if sticks:
        n.kind, n.rising = REST, 0
        launch(n.flight, sign, box, zero, gap)
        launch(n.centre, sign, point, zero, one)
        set_matrix(n, m.a, m.b, zero, zero)
        tell(n, STICK)
        return True
    n.rising = 1
    launch(n.flight, -sign, reversed_(box), zero, y.width - gap)
    launch(n.centre, -sign, reversed_(point), zero, y.width - one)
    factor = pushed / (box.cos - y.alpha)  # the saltation is diag(1, this)
    set_matrix(n, -m.a, -m.b, -(factor * m.c), -(factor * m.d))
    tell(n, TURN_LEFT if sign > 0 else TURN_RIGHT)
    return True


@kernel
def arrive(y: Constants, n: Motion, end: Moment) -> bool:
    """Prove that all motions fly until the end; ``end`` is as the flight sees it."""
    speed, gap = flown(y, n.centre, end)
    m = matrix_at(y, n, end.t)
    speeds = widened(speed, spread(m.c, m.d, n.base))
    gaps = widened(gap, spread(m.a, m.b, n.base))
    moves = below(n.flight.t, end.t) and is_positive(speeds) and is_positive(gaps)
    if not (moves and keeps_moving(y, n, end.t)):
        return False
    set_matrix(n, m.a, m.b, m.c, m.d)
    launch(n.centre, n.flight.sign, end, speed, gap)
    launch(n.flight, n.flight.sign, end, speeds, gaps)
    n.ended = 1
    return True
