"""Nothing else happens: on each leg of an orbit all guards of its mode are positive.

Between the contacts at its ends each guard h of the mode is positive by a lemma of
`cap.system.lemmas`:

* *Lemma M*: h falls, so it is positive before its value at the end, which is positive or zero;
* *Lemma C*: h is positive at the times of `cap.orbits.minima`, and not negative at both ends;
* *Lemma B*: the leg is cut in halves until h is positive on each piece (`cap.orbits.pieces`).

At an end of the leg h may be zero: at the start by an identity (`cap.orbits.itinerary`), at the end
if it is the guard of the next contact.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from cap.orbits.along import Along
from cap.orbits.minima import Minimum
from cap.orbits.numbers import Clock
from cap.orbits.pieces import cuts_of
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.lemmas import Falls, Lemma


class Reason(NamedTuple):
    """Why a guard is positive on a leg: the lemma M, C or B, and the cuts of B, exact doubles."""

    leg: int
    guard: str
    lemma: str
    cuts: tuple[float, ...] = ()


def reason(
    along: Along,
    lemma: Lemma,
    minima: Sequence[Minimum] | None,
    longest: float = float("inf"),
    window: tuple[float, float] | None = None,
) -> Reason:
    """Prove that a guard is positive between the ends of a leg; no piece is longer than this.

    In a window nothing is proved.

    Raises `NotProved` with the leg, the guard, a time, and the guard then.
    """
    number, name = along.leg.number, along.name
    if isinstance(lemma, Falls):
        if along.vanishing:
            raise along.failed("falls from zero", along.leg.start.time, interval.ZERO)
        _end(along)
        return Reason(number, name, "M")
    if minima is None:
        return Reason(number, name, "B", tuple(cuts_of(along, longest, window)))
    if not along.vanishing:
        along.positive(along.at(along.leg.start), along.leg.start.time)
    _end(along)
    for time, clock in inside(along, minima):
        along.positive(along.height(time, clock), time)
    return Reason(number, name, "C")


def _end(along: Along) -> None:
    """Prove that h > 0 at the end if it does not vanish there."""
    if not along.last:
        along.positive(along.at(along.leg.end), along.leg.end.time)


def inside(along: Along, minima: Sequence[Minimum]) -> Iterator[tuple[Ball, Clock]]:
    """Yield the minima that may lie in the leg.

    If L h vanishes at the start and L² h > 0, the start itself is a minimum: that is left out.
    """
    leg = along.leg
    period, begin, end = leg.of.period, leg.start.time, leg.end.time
    for time, cos, sin in minima:
        for k in interval.integers((begin - time) / period, (end - time) / period):
            at = time + k * period if k else time
            if at < begin or at > end:
                continue
            is_start = along.vanishing > 1 and at.overlaps(begin) and along.bend(begin) > 0
            if not is_start:
                yield at, (cos, sin)
