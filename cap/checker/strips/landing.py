"""Where the image of an arc is, in a column, and whether it is between two edges there.

An image is t(r), E(r), r in [-1, 1].  In a column s = (t - t_0)/d, and on an edge E = q(s).

*The part in a column.*  If t' has one sign on the whole arc, then by the mean value theorem t is
reached at (t - t(0))/t', for a value of t'; so the r with t in the column are in an interval [m,
n].  Only there E is compared.  For z with z'' >= b on the arc,

    z(r) >= z(0) + z'(0) r + b r^2/2.

If b <= 0, the right side is least at m or n.  If b > 0, it is so, too, unless z'(0) + b r changes
its sign between m and n; in any case it is at least z(0) - z'(0)^2/(2 b).

*Ends.*  If the image of an end of the arc is known not to be below an edge, and is in the column,
none of the image is there, if |z'(0)| >= |z''| and z grows from that end.

*Rounding.*  For |r| <= 1 each value of the right side, and of z'(0) + b r, has at most 6 roundings
of numbers below twice the sum of |z(0)|, |z'(0)| and |b|: ERROR = 2^-48 times that sum is more.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

from cap.checker.kernel.doubles import Double
from cap.checker.kernel.parabolas import Edge
from cap.checker.strips.arc import Taylor, negative
from cap.checker.strips.columns import UNIT
from cap.checker.strips.images import Image

ERROR = 2.0**-48
MORE = 1 + 2.0**-40

Part = tuple[float, float]
Ends = tuple[bool, bool]


class Target:
    """The interval of energies in a column into which a cell is to fly; None: no end.

    ``floor`` is above the whole lower edge, ``roof`` below the upper one.
    """

    def __init__(self, lower: Edge | None, upper: Edge | None) -> None:
        self.lower, self.upper = lower, upper
        a, b, c = lower or (-math.inf, 0, 0)
        self.floor = (a + abs(b) + abs(c)) * UNIT
        a, b, c = upper or (math.inf, 0, 0)
        self.roof = (a - abs(b) - abs(c)) * UNIT


class Place:
    """Where an image is in a column between two lines.

    To its times those are added that are up to ``wait`` later or, if that is negative, earlier.
    """

    def __init__(self, image: Image, between: tuple[float, float], wait: float = 0.0) -> None:
        self.image, self.E, self.between, self.wait = image, image.E, between, wait
        low, high = between
        self.middle, self.width = (low + high) / 2, high - low  # powers of 2
        self.part = _part(image, image.crossing, low + min(wait, 0.0), high + max(wait, 0.0))

    @cached_property
    def core(self) -> Part | None:
        """The part in the column, as small as it is known."""
        return _part(self.image, self.image.sharp_crossing, *self.between)

    def parabola(self, edge: Edge) -> tuple[float, float, float]:
        """Return the coefficients of an edge in t - t_0, exactly."""
        a, b, c = edge
        scale = 2 / self.width
        return a * UNIT, b * (UNIT * scale), c * (UNIT * scale * scale)

    def launch(self) -> tuple[float, float]:
        """Return s and E about in the middle of the part; it steers only."""
        r = (self.part[0] + self.part[1]) / 2 if self.part else 0.0
        t, E = (z[0].mid + r * (z[1].mid + r * z[2].mid / 2) for z in (self.image.T, self.E))
        return 2 * (t - self.middle) / self.width, E

    def within(self, target: Target, ends: Ends = (False, False)) -> bool:
        """Return whether the image is certainly between the edges; some of its ends are, if they
        are in the column.
        """
        if self.part and self.part[0] > -1 and self.part[1] < 1:  # it crosses the column
            least, most = self.energies(*self.part)
            if target.floor <= least and most <= target.roof:
                return True
        low, high = target.lower, target.upper
        above = low is None or self.clear(self.gap(low), ends)
        return above and (high is None or self.clear(negative(self.gap(high)), ends))

    def clear(self, z: Taylor, ends: Ends) -> bool:
        """Return whether z is certainly not negative in the column."""
        if positive(z, self.part) or self.grows(z, ends):
            return True
        return self.core is not None and positive(z, self.core)

    def grows(self, z: Taylor, ends: Ends) -> bool:
        """Return whether z certainly grows from an end that is in the column, where z >= 0."""
        one, two = z[1], z[2].magnitude
        first = one.mid > 0
        if not (ends[0 if first else 1] and abs(one.mid) >= (one.rad + two) * MORE):
            return False
        t = self.image.end(-1.0 if first else 1.0)
        return self.between[0] <= t.lower and t.upper <= self.between[1]

    def energies(self, first: float, last: float) -> tuple[float, float]:
        """Return bounds of E between two r: by its value at the middle, and its slope."""
        e, e1, e2 = self.E
        r, half = (first + last) / 2, (last - first) / 2
        middle = e.mid + r * (e1.mid + r * (e2.mid / 2))
        size = abs(e.mid) + abs(e1.mid) + abs(e2.mid) + e2.rad
        reach = e.rad + e1.rad + e2.rad / 2 + half * (abs(e1.mid) + abs(e2.mid) + e2.rad)
        reach = reach * MORE + ERROR * size
        return middle - reach, middle + reach

    def clears(self, z: Taylor, gain: float) -> bool:
        """Return whether z is certainly not negative in the column, nor z + gain |t - line| at the
        times beyond its line that are added.
        """
        if positive(z, self.part):
            return True
        line, rate = self.between[1 if self.wait > 0 else 0], math.copysign(gain, self.wait)
        t, t1, t2 = self.image.T
        more = z[0] + (t - line) * rate, z[1] + t1 * rate, z[2] + t2 * rate
        return positive(z, self.core) and positive(more, self.beyond(line))

    def beyond(self, line: float) -> Part | None:
        """Return the part beyond the line."""
        if self.part is None or _turns(self.image):
            return self.part
        (first, last), r = self.part, self.image.sharp_crossing(line)
        if self.image.dT.mid * self.wait > 0:
            first = max(first, r.lower)
        else:
            last = min(last, r.upper)
        return (first, last) if first <= last else None

    def gap(self, edge: Edge) -> Taylor:
        """Return E - q; with x = t - t_0 its bend is E'' - 2 c t'^2 - (b + 2 c x) t''."""
        (a, b, c), (t, t1, t2), slopes = self.parabola(edge), self.image.T, self.image.dT
        x, places = t - self.middle, self.image.all - self.middle
        value = self.E[0] - (x * (x * c + b) + a)
        slope = self.E[1] - (x * (2 * c) + b) * t1
        bend = self.E[2] - slopes * slopes * (2 * c) - (places * (2 * c) + b) * t2
        return value, slope, bend


def positive(z: Taylor, part: Part | None) -> bool:
    """Return whether z is certainly not negative on a part."""
    if part is None:
        return True
    (one, two), (first, last), b = z[:2], part, z[2].lower
    value, slope = one.mid, two.mid
    err = (one.rad + two.rad) * MORE + ERROR * (abs(value) + abs(slope) + abs(b))
    for r in (first, last):
        if not value + (slope + 0.5 * b * r) * r >= err:  # nor NaN
            return False
    if b <= 0 or slope + b * first >= err or slope + b * last <= -err:
        return True
    return value - (abs(slope) + err) ** 2 / (2 * b) * MORE >= err


def _turns(image: Image) -> bool:
    """Return whether T' may vanish."""
    return not abs(image.dT.mid) > 2 * image.dT.rad


def _part(
    image: Image, crossing: Callable[[float], Double], low: float, high: float
) -> Part | None:
    """Return the ends of an interval of all r at which a column may be met; None: it is not met."""
    if _turns(image):
        return -1.0, 1.0
    begins, ends, rises = image.times.lower < low, image.times.upper > high, image.dT.mid > 0
    first, last = -1.0, 1.0
    if begins if rises else ends:
        first = max(first, crossing(low if rises else high).lower)
    if ends if rises else begins:
        last = min(last, crossing(high if rises else low).upper)
    return (first, last) if first <= last else None
