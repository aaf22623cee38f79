"""Where a branch may end: a stop, a release from a known place, a region at a strobe.

A label is a set of bits, which mean what the caller says.  A branch that reaches a target with a
label that is not 0 is not followed further.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.boxes.doubleton import Doubleton, frame_box
from cap.boxes.flight import Constants
from cap.boxes.motion import LOST, STOPPED, Motion, exact
from cap.boxes.units import Units, place, speed_of
from cap.sets.compiled import kernel
from cap.sets.doubles import Interval, lower, magnitude, upper

BOX, ELLIPSE = 0.0, 1.0

Floats = NDArray[np.float64]
Labels = NDArray[np.int64]


class Targets(NamedTuple):
    """The targets, in the units of the parameters.

    ``stop`` is the label of the first turn, stick or capture; 0: it is no target.
    ``places_right`` (K + 1,) are the ends of K intervals of places x, in order, and
    ``labels_right`` (K,) the labels of motions released there to the right, 0 for none; likewise to
    the left.  ``regions`` (M, 7) are rows (x, v, a, b, c, d, shape): the states z at a strobe with
    |W (z - (x, v))| <= 1, W = ((a, b), (c, d)), in the maximum norm for the shape `BOX`, in the
    Euclidean one for `ELLIPSE`; ``region_labels`` (M,) are their labels.
    """

    stop: int
    places_right: Floats
    labels_right: Labels
    places_left: Floats
    labels_left: Labels
    regions: Floats
    region_labels: Labels


@kernel
def place_label(places: Floats, labels: Labels, low: float, high: float) -> int:
    """Return the labels of all intervals that [low, high] meets; 0 if one of them has none."""
    count = len(labels)
    if count == 0 or not (places[0] <= low and high <= places[count]):
        return 0
    found = 0
    for k in range(np.searchsorted(places, low), count + 1):
        if k > 0:
            if labels[k - 1] == 0:
                return 0
            found |= labels[k - 1]
        if places[k] > high:
            break
    return found


@kernel
def event_label(targets: Targets, units: Units, y: Constants, n: Motion, released: bool) -> int:
    """Return the label that the last event of a motion gives it."""
    if n.kind == LOST:
        return 0
    if targets.stop != 0 and n.words >> STOPPED & 1 != 0:
        return targets.stop
    right = n.flight.sign > 0
    if not released or len(targets.labels_right if right else targets.labels_left) == 0:
        return 0
    x = place(units, -n.flight.gap if right else n.flight.gap - y.width)
    if right:
        return place_label(targets.places_right, targets.labels_right, lower(x), upper(x))
    return place_label(targets.places_left, targets.labels_left, lower(x), upper(x))


@kernel
def strobe_label(targets: Targets, units: Units, d: Doubleton) -> int:
    """Return the label of the first region that contains a set at a strobe."""
    for k in range(len(targets.regions)):
        row = targets.regions[k]
        first = _size(units, d, (row[0], row[1]), (row[2], row[3]))
        second = _size(units, d, (row[0], row[1]), (row[4], row[5]))
        if row[6] == BOX and first <= 1 and second <= 1:
            return int(targets.region_labels[k])
        if row[6] == ELLIPSE and magnitude(exact(first * first + second * second)) <= 1:
            return int(targets.region_labels[k])
    return 0


@kernel
def _size(
    units: Units, d: Doubleton, centre: tuple[float, float], row: tuple[float, float]
) -> float:
    """Return a bound of |a (x - x0) + b (v - v0)| over a set."""
    x, v = frame_box(d.errors)
    a, b = exact(row[0]) * units.length, exact(row[1]) * units.speed
    middle = exact(row[0]) * (place(units, exact(d.x)) - exact(centre[0]))
    middle = middle + exact(row[1]) * (speed_of(units, exact(d.v)) - exact(centre[1]))
    first = magnitude(a * exact(d.p) + b * exact(d.r))
    second = magnitude(a * exact(d.q) + b * exact(d.w))
    rest = magnitude(a) * x + magnitude(b) * v
    return magnitude(Interval(magnitude(middle) + first, second + rest))
