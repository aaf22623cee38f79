"""Compiled: where the image of an arc is, in a column, as `cap.checker.strips.landing` has it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.areas.strips.arcs import ROOM, Image
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, lower, upper

Floats = NDArray[np.float64]


class Place(NamedTuple):
    """Where the image of an arc is in a column: s; it is there for r from ``first`` to ``last``."""

    s: float
    scale: float
    first: float
    last: float


@kernel
def placed(picture: Image, t: float, low: float, high: float) -> Place:
    """Return where an image, whose middle is at t, is between two lines: not if last < first."""
    scale, first, last = 2 / (high - low), -1.0, 1.0
    if abs(picture.slopes.mid) > 2.1 * picture.slopes.rad:
        one, two = (low - t) / picture.slopes, (high - t) / picture.slopes
        first = max(-1.0, min(lower(one), lower(two)) - ROOM)
        last = min(1.0, max(upper(one), upper(two)) + ROOM)
    return Place((t - low) * scale - 1, scale, first, last)


@kernel
def aim(picture: Image, place: Place) -> tuple[float, float]:
    """Return s and E about in the middle of the part of an image in a column."""
    r = 0.5 * (place.first + place.last)
    s = place.s + r * (picture.T1 + 0.5 * r * picture.T2.mid) * place.scale
    E = picture.E + r * (picture.E1 + 0.5 * r * picture.E2.mid)
    return min(max(s, -1.0), 1.0), E


@kernel
def beyond(picture: Image, p: Floats, place: Place, up: float) -> bool:
    """Return whether up (E - q) > 0 on the part of an image in a column."""
    s, scale, first, last = place
    value = up * (picture.E - p[0] - s * (p[1] + s * p[2]))
    slope = up * (picture.E1 - (s * 2 * p[2] + p[1]) * picture.T1 * scale)
    ds, whole = picture.slopes * scale, Interval(s, picture.times.rad * scale)
    bends = picture.E2 - ds * ds * (2 * p[2]) - (whole * (2 * p[2]) + p[1]) * (picture.T2 * scale)
    bend = lower(bends * up)
    for r in (first, last):
        if not value + (slope + 0.5 * bend * r) * r >= ROOM:
            return False
    if bend <= 0 or slope + bend * first >= 0 or slope + bend * last <= 0:
        return True
    return bool(value - 0.5 * slope * slope / bend >= ROOM)
