"""Half a period of sets of states with one hit each, in balls; see `cap.tori.half_period`.

On the way back from the hit the speed is least π - arccos α after the strobe, or at the hit: it is
at least V - c there, c = sqrt(1 - α²) - α arccos α, where (X, V) = σ(x, v).
"""

import math
from dataclasses import dataclass
from fractions import Fraction

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball, Box, pi
from cap.sets.matrix import Matrix
from cap.tori import flights


@dataclass(frozen=True)
class States:
    """The states ``middle`` + B y with |y1|, |y2| <= 1, for all numbers in the balls."""

    middle: Box
    B: Matrix[Ball]

    def range(self, row: int) -> Ball:
        """Return what x, or v, may be."""
        p, q = self.B[row]
        return self.middle[row] + interval.symmetric(p) + interval.symmetric(q)


@dataclass(frozen=True)
class Motion:
    """The constants α and a, and c."""

    alpha: Ball
    a: Ball
    least: Ball

    @classmethod
    def of(cls, alpha: Fraction, a: Fraction) -> "Motion":
        """Return them at the working precision."""
        ratio = interval.ball(alpha)
        least = (1 - ratio * ratio).sqrt() - ratio * ratio.acos()
        return cls(ratio, interval.ball(a), least)

    def after(self, z: States) -> States:
        """Return σ of all these states: each has one hit, and a velocity that never vanishes.

        Verifies: v > 0 and |x| < a at first, the hit in (0, π) with u > 0; at the end V > c and
        |X| < a.  Raises `NotProved` with the set for which one of these may fail.
        """
        v = z.range(1)
        self._need(v > 0, "the velocity at the strobe may not be positive", v)
        self._inside(z.range(0))
        t = self._hit(z)
        u = flights.speed(self.alpha, v, t, t.sin())
        self._need(u > 0, "the speed at the hit may not be positive", u)
        k, d = -2 * t.cos() / u, pi() - t
        (p, q), (r, s) = z.B
        p, q = p + t * r, q + t * s
        r, s = r + k * p, s + k * q
        image = States(self._middle(z, t), ((p + d * r, q + d * s), (r, s)))
        slow = image.range(1) - self.least
        self._need(slow > 0, "the velocity may vanish on the way back", slow)
        self._inside(image.range(0))
        return image

    def _need(self, holds: bool, why: str, value: Ball) -> None:
        if not holds:
            raise NotProved("states", why, {"value": value})

    def _inside(self, x: Ball) -> None:
        self._need(abs(x) < self.a, "a state may be beyond a wall", x)

    def _hit(self, z: States) -> Ball:
        """Return a ball in (0, π) with the times of all hits: a wall is between its ends."""
        t, far = self._guess(z)
        low, high = Ball(t - far), Ball(t + far)
        self._need(
            low > 0 and high < pi(), "the hit may not be in (0, π)", interval.hull(low, high)
        )
        before, after = self._beyond(z, low), self._beyond(z, high)
        self._need(before < 0, "a hit may be earlier", before)
        self._need(after > 0, "a hit may be later", after)
        return interval.hull(low, high)

    def _beyond(self, z: States, t: Ball) -> Ball:
        """Return x(t) - a of all states, at a time that is a point."""
        (p, q), (r, s) = z.B
        reach = interval.symmetric(p + r * t) + interval.symmetric(q + s * t)
        return self._of_middle(z, t) + reach

    def _of_middle(self, z: States, t: Ball) -> Ball:
        found: Ball = flights.beyond(self.alpha, self.a, z.middle, t, t.cos())
        return found

    def _guess(self, z: States) -> tuple[float, float]:
        """Return the time of the hit of the middle, and how far others are, in doubles."""
        x, v = (float(interval.midpoint(c)) for c in z.middle)
        alpha, a = (float(interval.midpoint(c)) for c in (self.alpha, self.a))
        t = (a - x) / v
        for _ in range(30):
            u = flights.speed(alpha, v, t, math.sin(t))
            if not (abs(u) > 1e-9 and abs(t) < 10):
                raise NotProved("states", "no hit is found", {"x": z.middle[0], "v": z.middle[1]})
            t -= flights.beyond(alpha, a, (x, v), t, math.cos(t)) / u
        reach = [[float(interval.midpoint(abs(b).upper())) for b in row] for row in z.B]
        far = sum(p + r * abs(t) for p, r in zip(*reach, strict=True)) / abs(u)
        return t, 1.1 * far + 2 * far * far + 1e-12

    def _middle(self, z: States, t: Ball) -> Box:
        """Return σ of the middle, whose hit is in t: Newton's method makes that sharp first."""
        _, v = z.middle
        for _ in range(6):
            m = interval.point(t)
            step = m - self._of_middle(z, m) / flights.speed(self.alpha, v, t, t.sin())
            t = interval.intersection(t, step)
        sin, d = t.sin(), pi() - t
        u = flights.speed(self.alpha, v, t, sin)
        place = flights.landing(self.alpha, self.a, u, (sin, t.cos()), d)
        return place, flights.speed(self.alpha, v, pi(), 2 * sin)


def covering(
    centre: tuple[Fraction, Fraction], axes: Matrix[Fraction], half: Fraction, count: int
) -> "list[States]":
    """Return count² parallelograms that cover ``centre`` + ``axes`` [-half, half]²."""
    part = half / count
    (a, b), (c, d) = (tuple(interval.ball(entry * part) for entry in row) for row in axes)
    result = []
    for i in range(-count + 1, count, 2):
        for j in range(-count + 1, count, 2):
            x, v = (
                m + (row[0] * i + row[1] * j) * part for m, row in zip(centre, axes, strict=True)
            )
            result.append(States((interval.ball(x), interval.ball(v)), ((a, b), (c, d))))
    return result
