"""The (1,1) orbits in closed form, as floats: midpoints of balls.  Their velocity never vanishes.

δ is the asymmetry, α = f/F, ρ = Rω²/F; speeds in units of F/ω: see `cap.one_one.closed_form`.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from cap.errors import NotProved
from cap.floats.findings import Floats
from cap.maps.twist import regular_twist
from cap.one_one.closed_form import Orbit, asymmetric, symmetric
from cap.one_one.transport import period_jet
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 80


class Member(NamedTuple):
    """An orbit as floats; nan where there is none."""

    alpha: float
    trace: float
    least_speed: float


NONE = Member(math.nan, math.nan, math.nan)


@contextmanager
def precise() -> Iterator[None]:
    """Compute with a few digits more than doubles have."""
    with interval.workprec(BITS):
        yield


def _ball(value: float) -> Ball:
    return interval.ball(Fraction(value))


def symmetric_member(alpha: float, rho: float, sign: int) -> Member:
    """Return the symmetric orbit ``plus`` (1) or ``minus`` (-1), genuine or not."""
    if alpha >= 2 / math.pi:
        return NONE
    with precise():
        orbit = symmetric(_ball(alpha), _ball(rho), sign)
        if not orbit.mean_speed > 0:  # no speed is positive
            return Member(alpha, math.nan, float(orbit.mean_speed))
        return _member(orbit)


def pair_member(delta: float, rho: float) -> Member:
    """Return the orbit of the asymmetric pair with this δ > 0, genuine or not."""
    with precise():
        orbit = asymmetric(_ball(delta), _ball(rho))
        if not orbit.alpha.is_finite():
            return NONE
        try:
            return _member(orbit)
        except NotProved:
            return NONE


def _member(orbit: Orbit) -> Member:
    return Member(float(orbit.alpha), float(orbit.trace()), float(orbit.least_speed()))


@dataclass(frozen=True)
class PairCurve:
    """The pair along δ (N,) at one ρ: α descends; nan where S > 1."""

    delta: Floats
    alpha: Floats
    trace: Floats
    least_speed: Floats


def pair_curve(rho: float, points: int) -> PairCurve:
    """Return the pair from its birth to f = 0, denser towards that; empty if there is none."""
    if rho >= (math.pi**2 - 4) / 2:
        none = np.empty(0)
        return PairCurve(none, none, none, none)
    last = asymmetry(1e-6, rho)
    delta = last * (1 - np.linspace(1, 0, points) ** 2) + 1e-9
    members = [pair_member(d, rho) for d in delta.tolist()]
    alpha, trace, least = np.array(members).T
    use = np.isfinite(alpha)
    return PairCurve(delta[use], alpha[use], trace[use], least[use])


def state(delta: float, rho: float) -> tuple[float, float, float]:
    """Return α, the way from the right wall, and the speed at t = 0, of an orbit of the pair.

    In units of F/ω² and F/ω; δ may be negative: the mirror image.
    """
    with precise():
        orbit = asymmetric(_ball(abs(delta)), _ball(rho))
        way, velocity = (orbit.mirrored() if delta < 0 else orbit).start()
        return float(orbit.alpha), float(way), float(velocity)


def asymmetry(alpha: float, rho: float) -> float:
    """Return δ > 0 of the pair at α; nan if there is none."""

    def above(delta: float) -> float:
        found = pair_member(delta, rho).alpha
        return found - alpha if math.isfinite(found) else -1.0

    return root(above, 1e-9, math.pi / 2 - 1e-9)


def symmetric_state(alpha: float, rho: float, sign: int) -> tuple[float, float]:
    """Return the way from the right wall, and the speed at t = 0, of a symmetric orbit."""
    with precise():
        way, velocity = symmetric(_ball(alpha), _ball(rho), sign).start()
        return float(way), float(velocity)


def twist(delta: float, rho: float) -> float:
    """Return τ₁ per |z|² at an elliptic orbit of the pair, in units of ω³/F² per area."""
    with precise():
        energy, delay = period_jet(asymmetric(_ball(delta), _ball(rho)), 3)
        sign = 1 if delay[1, 0] > 0 else -1
        regular = regular_twist(energy, delay, sign)
        return float(regular / (1 + energy[1, 0] + delay[0, 1]))


def turn(trace: float | Floats) -> Floats:
    """Return the rotation number, in [0, 1/2], of an elliptic orbit; nan of a saddle."""
    with np.errstate(invalid="ignore"):
        return np.asarray(np.arccos(np.asarray(trace) / 2) / (2 * np.pi))


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function changes its sign, by bisection; nan if it does not."""
    a, b = function(low), function(high)
    if not a * b <= 0:
        return math.nan
    for _ in range(80):
        middle = (low + high) / 2
        value = function(middle)
        if value * a > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2
