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

*One at a time.*  The bounds of one bounce need hold no longer than it lasts: so after each hit the
speed of the next one, and the time until which it happens, are bounded with r, a, b until then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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
AGAIN = 16  # times a bound of a time is made longer
LATER = Fraction(1, 1024)  # part of a time by which it is made longer
MOST = 24  # hits one at a time
FINEST = 1e-9  # of heights from which a fall is told to take some time

Window = tuple[Fraction, Fraction]
Ends = tuple[Fraction, Fraction]
Boxes = Mapping[str, Ends]


class Pull(NamedTuple):
    """Bounds r <= -h'' while h rises, and a <= -h'' <= b while it falls."""

    rising: Ball
    least: Ball
    most: Ball


class Hit(NamedTuple):
    """Bounds of a hit: until when it is, |h'| before it, and what that is at most times before."""

    until: Fraction
    speed: Ball
    ratio: Ball


class Found(NamedTuple):
    """What is claimed of a box: hits, and when they accumulate; what is not left on the way."""

    ratio: Ball
    time: Window
    hits: list[Hit]
    height: Fraction
    speed: Fraction
    others: Boxes


class Entry(NamedTuple):
    """How it begins: at a time in a window, at heights h, or, without them, with a hit.

    ``rate`` is h', before the hit if there is one; ``others`` are the other variables.
    """

    time: Window
    height: Ball | None
    rate: Ball
    others: Boxes


@dataclass(frozen=True)
class Start:
    """States at a time: an exact box."""

    wall: Wall
    time: Fraction
    box: Boxes

    def at(self, q: Polynomial) -> Ball:
        """Return an enclosure of a polynomial over the box."""
        known = {z: interval.hull(*map(interval.ball, ends)) for z, ends in self.box.items()}
        return value(q, known | clock(self.wall.system, interval.ball(self.time)))

    def entry(self) -> Entry:
        """Return how it begins."""
        others = {z: self.box[z] for z in self.wall.others}
        return Entry((self.time, self.time), self.at(self.wall.h), self.at(self.wall.rate), others)


def captured(place: Wall, entry: Entry, latest: Fraction) -> Found:
    """Apply the lemma, with bounds of h'' on a set that no motion leaves.

    ``latest`` is the latest time at which the other variables may matter; a bound of it that is
    too small is made larger.  Raises `NotProved` with what is not certain.
    """
    others, height, speed = entry.others, Fraction(0), Fraction(0)
    for _ in range(ROUNDS):
        near = Near(place, entry.time[0], height, speed, others)
        found = near.accumulated(entry)
        wide = near.moved(entry, max(found.time[1], latest))
        kept = found.height <= height and found.speed <= speed
        if kept and all(a < c and d < b for (a, b), (c, d) in _pairs(others, wide)):
            near.alone(found.time[1])
            return found._replace(height=height, speed=speed)
        height, speed = _wider(found.height, height), _wider(found.speed, speed)
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


def value(q: Polynomial, known: Mapping[str, Any]) -> Ball:
    """Return an enclosure of a polynomial."""
    found: Ball = q.evaluated(known, interval.ball, interval.pi())
    return found


class Near:
    """Bounds of what happens at 0 <= h <= ``height``, |h'| <= ``speed`` from a time on."""

    def __init__(
        self, place: Wall, begin: Fraction, height: Fraction, speed: Fraction, others: Boxes
    ) -> None:
        self.wall, self.begin, self.height, self.speed = place, begin, height, speed
        self.kept, self.others = others, {z: _hull(ends) for z, ends in others.items()}

    def over(self, q: Polynomial, until: Fraction, signs: str = "+-") -> Ball:
        """Return an enclosure of q in h, h', .. where h' has one of the signs, or is 0."""
        down, up = (self.speed * (sign in signs) for sign in "-+")
        known = {"(h)": _hull((Fraction(0), self.height)), "(h')": _hull((-down, up))}
        when = clock(self.wall.system, _hull((self.begin, until)))
        return value(q, {**known, **when, **self.others})

    def pull(self, until: Fraction) -> Pull:
        """Return bounds of -h''; raise `NotProved` if it may not be positive."""
        rises = self.over(self.wall.pull(self.wall.rising), until, "+")
        falls = self.over(self.wall.pull(self.wall.falling), until, "-")
        if not (rises > 0 and falls > 0):
            sets = {"-h'' rising": rises, "-h'' falling": falls, "until": until}
            raise NotProved("capture", "the wall may not attract near it, h'' < 0", sets)
        return Pull(interval.lower(rises), interval.lower(falls), interval.upper(falls))

    def accumulated(self, entry: Entry) -> Found:
        """Apply the lemma, after as few hits, one at a time, as will do.

        ``height`` and ``speed`` of what is found are those that are needed.
        """
        if self.wall.e == 1 and self.wall.rising == self.wall.falling:
            raise NotProved("capture", "the speeds at the hits may not decrease: e = 1")
        hits, tops, since = list[Hit](), [Fraction(0)], self.begin
        u, at = interval.upper(abs(entry.rate)), interval.ball(entry.time[1])
        if entry.height is not None:
            hit, top = self._first(entry.height, u, at)
            since += self._fall(entry.height, entry.rate, hit.until)
            hits.append(hit)
            tops.append(top)
            u, at = hit.speed, interval.ball(hit.until)
        speeds = [u]
        while True:
            try:
                last = self._all(u, at)
            except NotProved:
                if len(hits) == MOST:
                    raise
                last = None
            hit, top = last or self._next(u, at)
            tops.append(top)
            if last:
                ends = [interval.ends(interval.upper(x))[1] for x in speeds]
                time = since, hit.until
                return Found(interval.upper(hit.ratio), time, hits, max(tops), max(ends), self.kept)
            hits.append(hit)
            u, at = hit.speed, interval.ball(hit.until)
            speeds.append(u)

    def _until(self, at: Ball, lasts: Callable[[Pull], Ball]) -> tuple[Fraction, Pull]:
        """Return a time until which a motion that begins ``at`` a time at the latest is over.

        It ``lasts`` so long, under bounds that hold until then.
        """
        begin = interval.ends(at)[1]
        end = begin
        for _ in range(AGAIN):
            pull = self.pull(end)
            needed = interval.ends(interval.upper(lasts(pull)))[1]
            if begin + needed <= end:
                return end, pull
            unit = Fraction(10) ** (interval.decade(needed) - 4)
            end = unit * -(-(begin + needed * (1 + LATER)) // unit)
        raise NotProved("capture", "no time is found at which it is over", {"from": at})

    def _first(self, height: Ball, u: Ball, at: Ball) -> tuple[Hit, Fraction]:
        """Return the first hit, and the height until then."""
        d = interval.upper(height)
        if not d > 0:
            raise NotProved("capture", "the box lies beyond the wall", {"h": height})

        def top(pull: Pull) -> Ball:
            return d + u * u / (2 * pull.rising)

        until, pull = self._until(at, lambda p: u / p.rising + (2 * top(p) / p.least).sqrt())
        square = u * u * (pull.most / pull.rising).max(Ball(1)) + 2 * pull.most * d
        high = top(pull).max(square / (2 * pull.rising))
        speed = interval.upper(square.sqrt())
        return Hit(until, speed, Ball(0)), interval.ends(interval.upper(high))[1]

    def _next(self, u: Ball, at: Ball) -> tuple[Hit, Fraction]:
        """Return the hit after one of a speed of at most u, and the height until then."""
        w = interval.ball(self.wall.e) * u
        until, pull = self._until(at, lambda p: _lasts(p) * w)
        ratio = interval.ball(self.wall.e) * (pull.most / pull.rising).sqrt()
        hit = Hit(until, interval.upper(ratio * u), interval.upper(ratio))
        return hit, interval.ends(interval.upper(w * w / (2 * pull.rising)))[1]

    def _all(self, u: Ball, at: Ball) -> tuple[Hit, Fraction]:
        """Return the accumulation, as if it were a hit, and the height until then."""
        e = interval.ball(self.wall.e)

        def lasts(pull: Pull) -> Ball:
            k = e * (pull.most / pull.rising).sqrt()
            if not k < 1:
                raise NotProved("capture", "the speeds at the hits may not decrease", {"ratio": k})
            return _lasts(pull) * e * u / (1 - k)

        until, pull = self._until(at, lasts)
        ratio = e * (pull.most / pull.rising).sqrt()
        high = interval.ends(interval.upper(u * u / (2 * pull.rising)))[1]
        return Hit(until, Ball(0), interval.upper(ratio)), high

    def _fall(self, h: Ball, rate: Ball, until: Fraction) -> Fraction:
        """Return a short lower bound of the time until the first hit."""
        low = interval.lower(h)
        if not low > FINEST:
            return Fraction(0)
        both = [self.over(self.wall.pull(m), until) for m in (self.wall.falling, self.wall.rising)]
        a = interval.upper(both[0].max(both[1]))
        u = interval.upper((-rate).max(Ball(0)))
        s = interval.lower(2 * low / (u + (u * u + 2 * a * low).sqrt()))
        return interval.short(interval.ends(s)[0] * (1 - ROOM))

    def moved(self, entry: Entry, latest: Fraction) -> Boxes:
        """Return where the other variables are until ``latest``, if they do not leave their box."""
        place, found = self.wall, {}
        passed = _hull((Fraction(0), latest - self.begin))
        for z in place.others:
            begin, ends = _hull(entry.others[z]), []
            for mode in (place.falling, place.rising, place.rest):
                rate = place.system.modes[mode].field[z].substituted(place.solved)
                ends.append(interval.ends(begin + passed * self.over(rate, latest)))
            found[z] = min(a for a, _ in ends), max(b for _, b in ends)
        return found

    def alone(self, until: Fraction) -> None:
        """Raise `NotProved` if another guard may be met."""
        for mode, sign in ((self.wall.rising, "+"), (self.wall.falling, "-")):
            for key, guard in self.wall.system.modes[mode].guards.items():
                ends = any(guard.value.multiple_of(q) for q in (self.wall.h, self.wall.rate))
                height = self.over(guard.value.substituted(self.wall.solved), until, sign)
                if not (ends or height > 0):
                    sets = {"guard": height, "until": until}
                    raise NotProved("capture", f"{key} of {mode} may be met", sets)


def _lasts(pull: Pull) -> Ball:
    """Return how long a bounce lasts at most, for each unit of the speed with which it begins."""
    return 1 / pull.rising + 1 / (pull.rising * pull.least).sqrt()


def _hull(ends: Sequence[Fraction]) -> Ball:
    a, b = map(interval.ball, ends)
    return interval.hull(a, b)
