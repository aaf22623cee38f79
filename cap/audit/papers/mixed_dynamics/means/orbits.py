"""Orbits that decide claims: all orbits from a box of states, followed in balls."""

from dataclasses import dataclass
from fractions import Fraction

from cap.audit.filled import pair
from cap.flow.propagation import Image, after_periods, at_time_zero, propagate
from cap.parameters import PAPER, Parameters, at
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box

Number = Fraction | Ball


@dataclass(frozen=True)
class Followed:
    """What all orbits from a box of states at t = 0 do: their events, and Φⁿ at the end.

    ``stops``: the words of the events that are no hits; there are none if no velocity vanishes.
    ``determinant``, ``trace``: of the derivative.  ``turning``: the product over the turns of the
    factors (|F cos ωt| - f) / (|F cos ωt| + f).  ``box`` and ``events`` are in words.
    """

    words: tuple[str, ...]
    times: tuple[Ball, ...]
    stops: tuple[str, ...]
    state: Box
    determinant: Ball
    trace: Ball
    turning: Ball
    box: str
    events: str


def follow(
    x: str, v: str, radius: str = "0", periods: Fraction = Fraction(1), **others: str
) -> Followed:
    """Follow all orbits from a box, centre ± radius in x and in v, over some periods.

    At the paper's parameters but for others.
    """
    p, states = at(**others), [interval.around(Fraction(q), Fraction(radius)) for q in (x, v)]
    box = f"(x, v) = ({x}, {v})"
    if radius != "0":
        box = f"|x - ({x})| <= {radius}, |v - ({v})| <= {radius}"
    return _followed(p, after_periods(p, states[0], states[1], int(periods)), box)


def until(state: tuple[Number, Number], end: Number, **others: str) -> Followed:
    """Follow all orbits from a box at t = 0 until a time."""
    p, (x, v) = at(**others), map(_ball, state)
    return _followed(p, propagate(p, at_time_zero(x, v), _ball(end)))


def overlap(first: Number, second: Number) -> bool:
    """Return whether enclosures of what should be one number have one in common."""
    return _ball(first).overlaps(_ball(second))


def before_a_stop(cosine: Fraction) -> Box:
    """Return the state at t = 0, at the paper's parameters, of an orbit made to stop on purpose.

    It moves left, hits l at t = 3/2, and moves right until its velocity vanishes at the first time
    after that with cos t = ``cosine`` < f/F.
    """
    f, hit = interval.ball(PAPER.f), interval.ball(Fraction(3, 2))
    stop = interval.ball(cosine).acos()
    speed = hit.sin() - stop.sin() + f * (stop - hit)  # with which it leaves l
    v = -speed - hit.sin() - f * hit
    return interval.ball(PAPER.l) - v * hit - (1 - hit.cos()) - f * hit * hit / 2, v


def before_a_hit(shift: Fraction) -> Box:
    """Return a state at t = 0, this far to the right of one whose orbit hits r at t = 11/10.

    At the paper's parameters, with the speed 1.
    """
    f, hit = interval.ball(PAPER.f), interval.ball(Fraction(11, 10))
    v = 1 - hit.sin() + f * hit
    x = interval.ball(PAPER.r) - v * hit - (1 - hit.cos()) + f * hit * hit / 2
    return x + interval.ball(shift), v


def _ball(number: Number) -> Ball:
    return number if isinstance(number, Ball) else interval.ball(number)


def _followed(p: Parameters, image: Image, box: str = "") -> Followed:
    words = tuple(each.word for each in image.events)
    turning, f = Ball(1), interval.ball(p.f)
    for event in image.events:
        if event.word.startswith("turn"):
            force = abs(interval.ball(p.F) * (interval.ball(p.omega) * event.time).cos())
            turning = turning * (force - f) / (force + f)
    return Followed(
        words=words,
        times=tuple(each.time for each in image.events),
        stops=tuple(word for word in words if not word.startswith("hit")),
        state=image.state,
        determinant=matrix.determinant(image.monodromy),
        trace=matrix.trace(image.monodromy),
        turning=turning,
        box=box,
        events=", ".join(f"{each.word} at {pair(each.time, 3)}" for each in image.events),
    )
