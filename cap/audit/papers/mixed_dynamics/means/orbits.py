"""Orbits that decide claims: all orbits from a box of states, followed in balls."""

from dataclasses import dataclass
from fractions import Fraction

from cap.audit.means.balls import between
from cap.audit.means.need import need
from cap.flow.propagation import Image, after_periods, at_time_zero, propagate
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix

BITS = 100


@dataclass(frozen=True)
class Followed:
    """What all orbits from a box of states at t = 0 do: their events, and Φⁿ and its derivative."""

    words: tuple[str, ...]
    times: tuple[Ball, ...]
    state: Box
    monodromy: Matrix[Ball]

    def only_hits(self) -> bool:
        """Return whether nothing but hits happens: the velocity never vanishes."""
        return all(word.startswith("hit") for word in self.words)

    def has(self, verb: str) -> bool:
        """Return whether an event of this kind happens."""
        return any(word.startswith(verb) for word in self.words)

    def shown(self) -> str:
        """Return the events in words, with the times."""
        pairs = zip(self.words, self.times, strict=True)
        return ", ".join(f"{word} at {between(time, 3)}" for word, time in pairs)


@dataclass(frozen=True)
class States:
    """A box of states: centre ± radius in x and in v, as exact decimals."""

    x: str
    v: str
    radius: str = "0"

    def __str__(self) -> str:
        """Return it in words."""
        if self.radius == "0":
            return f"(x, v) = ({self.x}, {self.v})"
        return f"|x - ({self.x})| <= {self.radius}, |v - ({self.v})| <= {self.radius}"

    def follow(self, periods: int, p: Parameters = PAPER, bits: int = BITS) -> Followed:
        """Follow all orbits over some periods."""
        radius = Fraction(self.radius)
        with interval.workprec(bits):
            box = [interval.around(Fraction(q), radius) for q in (self.x, self.v)]
            return _followed(after_periods(p, box[0], box[1], periods))


def _followed(image: Image) -> Followed:
    return Followed(
        tuple(each.word for each in image.events),
        tuple(each.time for each in image.events),
        image.state,
        image.monodromy,
    )


def until(state: Box, end: Ball) -> Followed:
    """Follow all orbits from a box at t = 0 until a time, at the paper's parameters."""
    return _followed(propagate(PAPER, at_time_zero(*state), end))


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


def hits_only(states: States, periods: int = 1) -> Followed:
    """Return what all orbits do, if that is only to hit walls."""
    found = states.follow(periods)
    need(found.only_hits(), "the orbits do not only hit walls", events=found.words)
    return found
