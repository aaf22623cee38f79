"""The release map for an interval of f, in a coordinate that moves with f.

With f = F cos θ, θ near θ₀, and a number s, let y = x - s (θ - θ₀); H(y) is G(x), less s (θ - θ₀):
for each f a translate of G.  All is done by Taylor models in y and θ, so what depends on θ by
several ways is enclosed narrowly: f/F and the times of releases are simple functions of θ.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from cap.flow.event import TAYLOR_MODELS, Expected
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.flow.windows import Itinerary
from cap.parameters import Parameters
from cap.release.jet import release_jet
from cap.release.passage import Passage, passage, windows
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain, TaylorModel

ORDER = 4  # of the Taylor models
BOUND = TAYLOR_MODELS.bound


@dataclass(frozen=True)
class Image:
    """H over a set of y and θ: the events, H as a Taylor model, bounds of H' and, perhaps, H''."""

    times: tuple[Expected, ...]
    model: TaylorModel
    slope: Ball
    curve: Ball | None
    half_periods: int

    @property
    def value(self) -> Ball:
        """A ball with all values."""
        return BOUND(self.model)


@dataclass(frozen=True)
class Family:
    """The release maps for all f of [low, high]; the f of ``p`` lies there.  s is ``shear``, θ₀
    ``origin``."""

    p: Parameters
    low: Fraction
    high: Fraction
    shear: Fraction
    origin: Ball

    def part(self, low: Fraction, high: Fraction) -> "Family":
        """Return the same for fewer f."""
        return replace(self, p=replace(self.p, f=(low + high) / 2), low=low, high=high)

    @cached_property
    def theta(self) -> Ball:
        """A ball with all θ."""
        return interval.hull(*(phase(self.p, f) for f in (self.low, self.high)))

    @cached_property
    def alone(self) -> TaylorModel:
        """θ, as a Taylor model of itself."""
        return self.variables()[0]

    def variables(self, *places: tuple[Fraction, Fraction]) -> tuple[TaylorModel, ...]:
        """Return Taylor models of places y, in intervals, and of θ."""
        balls = [interval.hull(*map(interval.ball, ends)) for ends in places] + [self.theta]
        middle = [interval.point(z) for z in balls]
        reach = [abs(z - m) for z, m in zip(balls, middle, strict=True)]
        return Domain(reach, ORDER).variables(middle)

    def image(
        self, y: Any, theta: TaylorModel, expected: Itinerary, *, curved: bool = False
    ) -> Image:
        """Prove that all releases from y have the ``expected`` events; return H(y).

        Raises `NotProved` with the event that is undecided.
        """
        osc = over(self.p, theta)
        moved = self.moved(theta)
        x = y + moved
        times = windows(osc, x, expected, TAYLOR_MODELS)
        found: Passage[Any] = passage(osc, x, times, TAYLOR_MODELS)
        curve = 2 * BOUND(release_jet(osc, x, found.events, 2)[(2,)]) if curved else None
        times = found.times(BOUND)
        return Image(times, found.value - moved, BOUND(found.slope), curve, found.half_periods)

    def moved(self, theta: TaylorModel) -> TaylorModel:
        """Return s (θ - θ₀)."""
        return (theta - self.origin) * interval.ball(self.shear)


def phase(p: Parameters, f: Fraction) -> Ball:
    """Return arccos(f/F)."""
    return interval.ball(f / p.F).acos()


def over(p: Parameters, theta: Any) -> Oscillator[Any]:
    """Return the oscillators with f = F cos θ; the f of ``p`` is not used."""
    osc, (sin, cos) = oscillator(p), theta.sin_cos()
    pi = interval.pi()
    return replace(
        osc,
        f=cos * osc.F,
        ratio=cos,
        sine=sin,
        slow_right=(2 * pi - theta) / osc.omega,
        slow_left=(pi - theta) / osc.omega,
    )
