"""Capture in a system given as data: infinitely many hits of a wall accumulate in finite time.

On either side of a hit of a wall (`cap.orbits.wall`) h'' is a polynomial in h, h', the variables
that these do not give, and the clock.

*Lemma.*  Let -h'' >= r where h' >= 0 and 0 < a <= -h'' <= b where h' <= 0, for all states with 0 <=
h <= H, |h'| <= q that occur until the time t_d.  A bounce that leaves the wall with w rises at most
for w/r, to at most w²/(2r), for h + h'²/(2r) does not increase; it falls at most for sqrt(2h/a)
from there, and as h'² + 2bh does not increase it comes back with at most w sqrt(b/r), and leaves
with at most k w, k = e sqrt(b/r).  So if k < 1, all of them together take at most
(1/r + 1/sqrt(ra)) w/(1 - k), w the speed after the first hit.  From h <= d, |h'| <= u this is at
most e times sqrt(u² max(1, b/r) + 2bd), after at most u/r + sqrt(2(d + u²/(2r))/a).  If h and h'
keep within H and q on the way, and t_d is not earlier, the hits accumulate; h and h' tend to 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.orbits.wall import Wall
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.exponential import number
from cap.system.model import System
from cap.system.polynomial import COS, SIN, Polynomial

ROUNDS, ROOM = 60, Fraction(1, 64)  # of the search for what is not left; how much wider it is made
FINEST = 1e-9  # of heights from which a fall is told to take some time

Window = tuple[Fraction, Fraction]
Ends = tuple[Fraction, Fraction]
Boxes = Mapping[str, Ends]


class Pull(NamedTuple):
    """Bounds r <= -h'' while h rises, and a <= -h'' <= b while it falls."""

    rising: Ball
    least: Ball
    most: Ball


class Found(NamedTuple):
    """What is claimed of a box, with what is not left on the way."""

    ratio: Ball
    time: Window
    height: Fraction
    speed: Fraction
    others: Boxes


@dataclass(frozen=True)
class Start:
    """States at a time: an exact box, in which h <= ``height`` and |h'| <= ``speed``."""

    wall: Wall
    time: Fraction
    box: Boxes

    def at(self, q: Polynomial) -> Ball:
        """Return an enclosure of a polynomial over the box."""
        known = {z: interval.hull(*map(interval.ball, ends)) for z, ends in self.box.items()}
        return _value(q, known | clock(self.wall.system, interval.ball(self.time)))


def captured(start: Start, latest: Fraction) -> Found:
    """Apply the lemma, to the time until the first fixed point of its bound.

    ``latest`` is the latest time at which the other variables may matter; a bound of it that is
    too small is made larger.  Raises `NotProved` with what is not certain.
    """
    place, end, others = start.wall, start.time, dict(start.box)
    others = {z: start.box[z] for z in place.others}
    height = speed = Fraction(0)
    for _ in range(ROUNDS):
        near = Near(place, (start.time, end), height, speed, others)
        wide = near.moved(start, max(end, latest))
        found = near.accumulated(start)
        needed = found.height, found.speed, found.time[1]
        holds = needed[0] <= height and needed[1] <= speed and needed[2] <= end
        if holds and all(a < c and d < b for (a, b), (c, d) in _pairs(others, wide)):
            near.alone()
            return found._replace(height=height, speed=speed, time=(found.time[0], end))
        height, speed = (
            _wider(new, old) for new, old in zip(needed, (height, speed), strict=False)
        )
        end = start.time + _wider(needed[2] - start.time, end - start.time)
        others = {z: _around(wide[z], others[z]) for z in others}
    raise NotProved("capture", "no bounds are found that keep the motions near the wall")


def _pairs(one: Boxes, other: Boxes) -> Iterator[tuple[Ends, Ends]]:
    return ((one[z], other[z]) for z in one)


def _wider(new: Fraction, old: Fraction) -> Fraction:
    """Return a short number that is somewhat larger than ``new``, or ``old`` if that is enough."""
    return old if new <= old else _short(new * (1 + ROOM))


def _short(q: Fraction) -> Fraction:
    """Return a decimal of four digits that is at least q > 0."""
    scale = Fraction(10) ** (3 - interval.decade(q))
    return Fraction(-(-q * scale // 1)) / scale


def _around(new: Ends, old: Ends) -> Ends:
    """Return short ends of an interval with ``new`` inside; the old one if that is enough."""
    (a, b), room = new, _short((new[1] - new[0]) * ROOM + Fraction(1, 10**6))
    if old[0] < a and b < old[1]:
        return old
    return room * ((a - room) // room), room * -((-b - room) // room)


def clock(system: System, t: Ball) -> dict[str, Ball]:
    """Return enclosures of cos and sin."""
    s, c = (number(system.omega) * t).sin_cos()
    return {COS: c, SIN: s}


def _value(q: Polynomial, known: Mapping[str, Any]) -> Ball:
    value: Ball = q.evaluated(known, interval.ball, interval.pi())
    return value


class Near:
    """Bounds of what happens at 0 <= h <= ``height``, |h'| <= ``speed`` during a window."""

    def __init__(
        self, place: Wall, window: Window, height: Fraction, speed: Fraction, others: Boxes
    ) -> None:
        self.wall, self.window, self.height, self.speed = place, window, height, speed
        self.others = {z: _hull(ends) for z, ends in others.items()}
        self.kept = others

    def over(
        self, q: Polynomial, signs: str = "+-", height: int = 1, window: Window | None = None
    ) -> Ball:
        """Return an enclosure of q in h, h', .. where h' has one of the signs, or is 0."""
        down, up = (self.speed * (sign in signs) for sign in "-+")
        known = {"(h)": _hull((Fraction(0), self.height * height)), "(h')": _hull((-down, up))}
        when = clock(self.wall.system, _hull(window or self.window))
        return _value(q, {**known, **when, **self.others})

    def pull(self) -> Pull:
        """Return bounds of -h''; raise `NotProved` if it may not be positive."""
        rises = self.over(self.wall.pull(self.wall.rising), "+")
        falls = self.over(self.wall.pull(self.wall.falling), "-")
        if not (rises > 0 and falls > 0):
            sets = {"-h'' rising": rises, "-h'' falling": falls, "until": self.window[1]}
            raise NotProved("capture", "the wall may not attract near it, h'' < 0", sets)
        return Pull(interval.lower(rises), interval.lower(falls), interval.upper(falls))

    def accumulated(self, start: Start) -> Found:
        """Apply the lemma; ``height`` and ``speed`` of what is found are those that are needed."""
        r, a, b = self.pull()
        e = interval.ball(self.wall.e)
        k = e * (b / r).sqrt()
        if not k < 1:
            sets = {"ratio": k, "until": self.window[1]}
            raise NotProved("capture", "the speeds at the hits may not decrease", sets)
        h, rate = start.at(self.wall.h), start.at(self.wall.rate)
        if not interval.upper(h) > 0:
            raise NotProved("capture", "the box lies beyond the wall", {"h": h})
        d, u = interval.upper(h), interval.upper(abs(rate))
        square = u * u * (b / r).max(Ball(1)) + 2 * b * d
        q, top = square.sqrt(), d + u * u / (2 * r)
        first = u / r + (2 * top / a).sqrt()
        whole = first + (1 / r + 1 / (r * a).sqrt()) * e * q / (1 - k)
        height = top.max(square / (2 * r))
        early, late = self._first(h, rate), interval.ball(start.time) + interval.upper(whole)
        ends = [interval.ends(interval.upper(x))[1] for x in (height, q, late)]
        since = start.time + early
        return Found(interval.upper(k), (since, ends[2]), ends[0], ends[1], self.kept)

    def _first(self, h: Ball, rate: Ball) -> Fraction:
        """Return a short lower bound of the time until the first hit."""
        low = interval.lower(h)
        if not low > FINEST:
            return Fraction(0)
        both = [self.over(self.wall.pull(m)) for m in (self.wall.falling, self.wall.rising)]
        a = interval.upper(both[0].max(both[1]))
        u = interval.upper((-rate).max(Ball(0)))
        s = interval.lower(2 * low / (u + (u * u + 2 * a * low).sqrt()))
        return interval.short(interval.ends(s)[0] * (1 - ROOM))

    def moved(self, start: Start, latest: Fraction) -> Boxes:
        """Return where the other variables are until ``latest``, if they do not leave their box."""
        passed, place, found = _hull((Fraction(0), latest - start.time)), self.wall, {}
        window = start.time, latest
        for z in place.others:
            begin, ends = _hull(start.box[z]), []
            for mode in (place.falling, place.rising, place.rest):
                rate = place.system.modes[mode].field[z].substituted(place.solved)
                ends.append(interval.ends(begin + passed * self.over(rate, window=window)))
            found[z] = min(a for a, _ in ends), max(b for _, b in ends)
        return found

    def alone(self) -> None:
        """Raise `NotProved` if another guard may be met."""
        for mode, sign in ((self.wall.rising, "+"), (self.wall.falling, "-")):
            for key, guard in self.wall.system.modes[mode].guards.items():
                zero = guard.value.multiple_of(self.wall.h) or guard.value.multiple_of(
                    self.wall.rate
                )
                value = self.over(guard.value.substituted(self.wall.solved), sign)
                if not (zero or value > 0):
                    sets = {"guard": value, "until": self.window[1]}
                    raise NotProved("capture", f"{key} of {mode} may be met", sets)


def _hull(ends: Sequence[Fraction]) -> Ball:
    a, b = map(interval.ball, ends)
    return interval.hull(a, b)
