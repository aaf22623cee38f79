"""The certified flow of a box of states, through any sequence of events.

An itinerary is a list of words (``certificates/FORMAT.md``, Events):

    hit r, hit l                  v -> -e v at this wall
    turn right, turn left         v passes through 0 strictly between the walls, |F cos ωt| > f
    stick                         v becomes 0 there, |F cos ωt| < f: the mass rests
    capture r, capture l          infinitely many hits accumulate: the mass rests at this wall
    release right, release left   the rest ends, when F cos ωt reaches f, -f

`follow` proves that all orbits from a box have the itinerary that is expected, each event in its
time window, and nothing else; `cap.flow.event` certifies the single event, `cap.flow.capture` the
capture. Which way the mass turns is decided by the forcing F cos ωt at that time, never by the sign
that the velocity had: the word is an expectation, and what does not fit it is not proved.
"""

from collections.abc import Sequence
from operator import methodcaller
from typing import Any

from cap.flow import relaxation
from cap.flow.event import E, Enclosure, Expected
from cap.flow.model import Constants, Functions, Moment, Oscillator
from cap.flow.orbit import Orbit, PartialOrbit, State
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.interval import Ball

__all__ = ["Orbit", "State", "follow", "of_constants", "oscillator", "strobe"]


FUNCTIONS = Functions[Ball](
    constant=interval.ball,
    pi=Ball(0),
    sin_cos=methodcaller("sin_cos"),  # of balls, and of jets and Taylor models over balls
    acos=Ball.acos,
    sqrt=Ball.sqrt,
    relax=relaxation.relax,
)
BEGIN = Moment(interval.ZERO, interval.ZERO, interval.ONE)


def oscillator(parameters: Parameters) -> Oscillator[Any]:
    """Return the oscillator with balls for constants, enclosed at the current precision.

    The states may be balls, or jets or Taylor models over balls.
    """
    return of_constants(Constants.of(parameters, interval.ball))


def of_constants(constants: Constants[Ball]) -> Oscillator[Any]:
    """Return the oscillator with these constants: with thick balls, a whole set of oscillators."""
    return Oscillator.over(constants, FUNCTIONS._replace(pi=interval.pi()))


def strobe(
    osc: Oscillator[Any],
    state: tuple[E, E],
    expected: Sequence[Expected],
    kind: Enclosure[E],
    periods: int = 1,
) -> Orbit[E]:
    """Return `follow` from t = 0 to ``periods`` T: the end is Φⁿ(state), the monodromy (Φⁿ)'."""
    x, v = state
    start, end = BEGIN, Moment(periods * osc.T, interval.ZERO, interval.ONE)
    return follow(osc, State(start, x, v), expected, end, kind)


def follow(
    osc: Oscillator[Any],
    start: State[E],
    expected: Sequence[Expected],
    end: Moment[Ball],
    kind: Enclosure[E],
) -> Orbit[E]:
    """Prove that all orbits from ``start`` have the ``expected`` events until ``end``, no others.

    On return each orbit has its k-th event in the k-th window; hits and turnings are transverse; at
    the end it is strictly between the walls and moves with a sign that is the same for all, or
    rests; the `Orbit` encloses all this.  Raises `NotProved` with the event that is undecided: the
    box or a window may be too large, or the orbits different.  ``expected`` needs no trust.
    """
    orbit = PartialOrbit(osc, start, kind)
    for number, event in enumerate(expected, start=1):
        orbit.meet(event, number)
    return orbit.finish(end)
