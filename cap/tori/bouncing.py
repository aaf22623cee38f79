"""An elastic ball on a table that vibrates: from one impact to the next, as a map of functions.

Units ω = g = 1; the table is at a sin t, 0 < a < 1.  After an impact at t the ball leaves it with
the speed v > 0, relative to it; the next impact is at t' = t + s, where

    a sin t + (v + a cos t) s - s²/2 = a sin t',     v' = s - v - a cos t + a cos t'.

As the table falls less than freely, the height over it is strictly concave: there is exactly one
s > 0, and v' > 0.  The coordinates are t and w = v²/2, as ∮ w dt is kept along closed curves
(`cap.checker.tori.bouncing` has the proof).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.fourier import Circle, FourierModel, perturbed, root
from cap.sets.interval import Ball, ComplexBall
from cap.tori.approximate import model, rounded
from cap.tori.invariant_curve import Curve, Image, Vector
from cap.tori.newton import shortened

HALF_I = ComplexBall(0, Ball((1, -1)))
ROUGH = 20  # decimal places of reciprocals
STEPS = 3  # of Newton's method for hints, with reciprocals in doubles
POLISHED = 60  # steps of Newton's method for one flight


class Flight(NamedTuple):
    """Hints along a curve: v and nearly 1/v, the time s of the flight and nearly 1/v'."""

    speed: FourierModel
    inverse: FourierModel
    time: FourierModel
    later: FourierModel


@dataclass(frozen=True)
class Bouncing:
    """The map near a curve."""

    circle: Circle
    a: Ball
    flight: Flight

    @classmethod
    def of(cls, circle: Circle, a: Ball, rows: Sequence[Sequence[complex]]) -> "Bouncing":
        """Return the map with hints in doubles."""
        return cls(circle, a, Flight(*(model(circle, row[: circle.degree + 1]) for row in rows)))

    def _start(self, x: FourierModel) -> tuple[FourierModel, FourierModel]:
        """Return a cos t and a sin t."""
        circle = self.circle
        sine = circle.model([HALF_I, ComplexBall(0), -HALF_I])
        cosine = circle.model([ComplexBall(1) / 2, ComplexBall(0), ComplexBall(1) / 2])
        s, k = x.sin_cos()
        return (cosine * k - sine * s) * self.a, (sine * k + cosine * s) * self.a

    def __call__(self, x: FourierModel, y: FourierModel) -> Image:
        """Return the image of the curves (θ + x, w) in the models."""
        hint = self.flight
        p = hint.speed.centre()
        v = root(p, p * p - y * 2, lambda e: p.widened_to(e) * 2, hint.inverse / 2)
        per_v = v.reciprocal_near(hint.inverse)
        if not v.mean.real > 0:
            raise NotProved("flight", "a speed may not be positive", {"mean speed": v.mean.real})
        cos, sin = self._start(x)
        up, q = v + cos, hint.time.centre()
        ahead = q.sin_cos()
        value = sin + up * q - q * q / 2 - sin * ahead[1] - cos * ahead[0]

        def slope(e: Ball) -> FourierModel:
            d, c = perturbed(ahead, e)
            return up - q.widened_to(e) - cos * c + sin * d

        time = root(q, value, slope, -hint.later)
        if not time.mean.real - time.swing - time.error > 0:
            raise NotProved("flight", "it may take no time", {"mean time": time.mean.real})
        d, c = perturbed(ahead, time.error)
        after, high = cos * c - sin * d, sin * c + cos * d
        u = time - v - cos + after
        per_u = u.reciprocal_near(hint.later)

        def tangent(z: Vector) -> Vector:
            dt, dv = z[0], per_v * z[1]
            ds = per_u * ((cos - sin * time - after) * dt + time * dv)
            dt_after = dt + ds
            return dt_after, u * (ds - dv + sin * dt - high * dt_after)

        return Image(x + time, u * u / 2, tangent)

    def along(self, curve: Curve) -> "Bouncing":
        """Return the map with its hints improved for a curve."""
        v, inverse, s, later = self.flight
        cos, sin = self._start(curve.x)
        for _ in range(STEPS):
            v = _whole(v - inverse / 2 * (v * v - curve.v * 2))
            d, c = s.sin_cos()
            above = sin + (v + cos) * s - s * s / 2 - sin * c - cos * d
            s = _whole(s + later * above)
        return Bouncing(self.circle, self.a, Flight(v, inverse, s, later))

    def written(self, places: int) -> tuple[dict[str, Any], "Bouncing"]:
        """Return the hints with decimals for coefficients, and the map with them."""
        digits = places, ROUGH, places, ROUGH
        pairs = [rounded(u, n) for u, n in zip(self.flight, digits, strict=True)]
        words = {name: w for name, (_, w) in zip(Flight._fields, pairs, strict=True)}
        return {"flight": words}, Bouncing(self.circle, self.a, Flight(*(u for u, _ in pairs)))


def impact(a: Ball, t: Ball, v: Ball) -> tuple[Ball, Ball]:
    """Return the phase and the speed after the next impact of the motions from these states.

    Newton's method with intervals: the time s > 0 is in S if m - h(m)/h'(S) lies in S > 0.  Raises
    `NotProved`.
    """
    m = _polished(a, interval.point(t), interval.point(v))
    cos, sin = a * t.cos(), a * t.sin()
    value = sin + (v + cos) * m - m * m / 2 - a * (t + m).sin()
    width = interval.upper(abs(2 * value / v))
    s = m
    for _ in range(3):
        wide = m + interval.symmetric(2 * width)
        s = m - value / (v + cos - wide - a * (t + wide).cos())
        if wide > 0 and interval.subset(s, wide):
            later = t + s
            return later, s - v - cos + a * later.cos()
        width *= 8
    raise NotProved("motion", "an impact is not certain", {"phase": t, "speed": v, "time": s})


def _polished(a: Ball, t: Ball, v: Ball) -> Ball:
    """Return a point near the time of flight from a state, by Newton's method from the right."""
    cos, sin = a * t.cos(), a * t.sin()
    up = v + cos
    s = interval.point(up + (up * up + 4 * a).sqrt())
    small = interval.upper(abs(s)) * interval.rounding() * 16
    for _ in range(POLISHED):
        step = interval.point(
            (sin + up * s - s * s / 2 - a * (t + s).sin()) / (up - s - a * (t + s).cos())
        )
        s = interval.point(s - step)
        if not abs(step) > small:
            break
    return s


def _whole(u: FourierModel) -> FourierModel:
    """Return points for all coefficients, without the error."""
    return shortened(u, Fraction(1))
