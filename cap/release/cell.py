"""Pieces of an interval of releases, over each of which G, G' and G'' are enclosed.

All by Taylor models in the place, which hardly overestimate; G'' by jets over these.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from cap.flow.event import TAYLOR_MODELS, Expected
from cap.flow.model import Oscillator
from cap.flow.windows import Itinerary
from cap.release.jet import release_jet
from cap.release.passage import passage, windows
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

ORDER = 4  # of the Taylor models
SLACK = Fraction(1, 2)  # of the windows, beyond what is proved, to either side


@dataclass(frozen=True)
class Cell:
    """[lower, upper]: all releases from there have the events ``times``; G and G' there."""

    lower: Fraction
    upper: Fraction
    times: tuple[Expected, ...]
    value: Ball
    slope: Ball
    curve: Ball | None
    half_periods: int

    def windows(self) -> tuple[Expected, ...]:
        """Return time windows a little larger than what is proved."""
        return slack(self.times)

    def pieces(self, osc: Oscillator[Any], number: int) -> list["Cell"]:
        """Return cells, of so many equal parts."""
        cuts = [self.lower + (self.upper - self.lower) * k / number for k in range(number + 1)]
        middles = tuple(Expected(e.word, interval.point(e.window)) for e in self.times)
        curved = self.curve is not None
        return [cell(osc, a, b, middles, curved=curved) for a, b in pairwise(cuts)]


def slack(times: Itinerary) -> tuple[Expected, ...]:
    """Return windows a little larger than enclosures of times."""
    return tuple(each._replace(window=each.window + _wider(each.window)) for each in times)


def _wider(time: Ball) -> Ball:
    half = interval.symmetric(time - interval.point(time))
    return half * 2 * interval.ball(SLACK) + interval.symmetric(time) * interval.rounding()


def cell(
    osc: Oscillator[Any],
    lower: Fraction,
    upper: Fraction,
    expected: Itinerary,
    *,
    curved: bool = False,
) -> Cell:
    """Prove that all releases from [lower, upper] have the ``expected`` events; enclose G and G'.

    If ``curved``, also G''.  Raises `NotProved` with the event that is undecided.
    """
    m, reach = interval.ball((lower + upper) / 2), interval.ball((upper - lower) / 2)
    (x,) = Domain((reach,), ORDER).variables((m,))
    proved = passage(osc, x, windows(osc, x, expected, TAYLOR_MODELS), TAYLOR_MODELS)
    bound = TAYLOR_MODELS.bound
    captured = any(event.word.startswith("capture") for event in proved.events)
    curve = None
    if curved:  # after a capture G is constant
        curve = Ball(0) if captured else 2 * bound(release_jet(osc, x, proved.events, 2)[(2,)])
    value, slope = bound(proved.value), bound(proved.slope)
    return Cell(lower, upper, proved.times(bound), value, slope, curve, proved.half_periods)
