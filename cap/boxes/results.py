"""What is asked of cells, and what is proved of them, as arrays."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.flow.words import WORDS

Floats = NDArray[np.float64]
Numbers = NDArray[np.int64]

LONGEST = 15  # words of an itinerary that a number keeps: four bits each
SMOOTH, UNION, OPEN = 0, 1, 2
RELEASED, MOVING, UNDECIDED, SETTLED = 0, 1, 2, 3


@dataclass(frozen=True, slots=True)
class Images:
    """What is proved of N cells.

    ``verdict`` (N,): `SMOOTH`: the map from the beginning to the end is smooth on the cell, all of
    which has the same events; `UNION`: there may be several continuations, all are accounted for;
    `OPEN`: nothing is known (too many branches, or sets too wide).
    ``states`` (N, 2, 2): lower and upper ends of x and of v, of all states at the end, but for
    those that have reached a target before; NaN if there are none, and for open cells.
    ``derivative`` (N, 2, 2, 2): lower and upper ends of the entries of the derivative, rows (x, v),
    columns (x, v), at every state of the cell; NaN unless smooth.
    ``surely``, ``possibly`` (N,): bits for the `WORDS` of the events that all states have, and of
    those that some may have; one bit more says turn, stick or capture.  A capture stands for all
    hits and turns at that wall, also if it is not over at the end; so does a mass that is at rest
    at a wall, and pressed to it, at the start: it counts as one that turned and was captured.
    ``itinerary`` (N,): the events of the last period of a smooth cell, as a number (`words_of`); -1
    if there are more than 15.
    ``label`` (N,): all labels of targets that states of the cell reach.  ``alive`` (N,): how many
    sets of states are left that have reached none, -1 for open cells.  So if it is 0, each state of
    the cell reaches one of the targets with these labels.
    ``periods`` (N,): how many periods have been followed; ``branches`` (N,): how many branches.
    """

    verdict: NDArray[np.int8]
    label: Numbers
    periods: Numbers
    branches: Numbers
    alive: Numbers
    surely: Numbers
    possibly: Numbers
    itinerary: Numbers
    states: Floats
    derivative: Floats

    def __len__(self) -> int:
        return len(self.verdict)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle integers in as few bytes as they need: processes send them through pipes."""
        return _unpickled, tuple(_narrow(getattr(self, field.name)) for field in fields(self))

    @classmethod
    def unknown(cls, n: int) -> "Images":
        """Return what is known of n cells before they have been followed."""
        names = [field.name for field in fields(cls)]
        numbers: dict[str, Any] = {name: np.zeros(n, dtype=np.int64) for name in names}
        numbers["verdict"] = np.full(n, OPEN, dtype=np.int8)
        numbers["states"] = np.full((n, 2, 2), np.nan)
        numbers["derivative"] = np.full((n, 2, 2, 2), np.nan)
        return cls(**numbers)

    @classmethod
    def joined(cls, parts: Sequence["Images"]) -> "Images":
        """Return the images of several arrays of cells as one."""
        names = [field.name for field in fields(cls)]
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))


def _narrow(array: NDArray[Any]) -> NDArray[Any]:
    """Return an array with the narrowest signed integers that its numbers fit in."""
    if array.dtype != np.int64 or not array.size:
        return array
    ends = np.array([array.min(), array.max()])
    for narrow in (np.int8, np.int16, np.int32):
        if (ends.astype(narrow) == ends).all():
            return array.astype(narrow)
    return array


def _unpickled(verdict: NDArray[np.int8], *arrays: Any) -> Images:
    return Images(verdict, *(a if a.dtype.kind == "f" else a.astype(np.int64) for a in arrays))


def words_of(itinerary: int) -> tuple[str, ...]:
    """Return the words of an itinerary, from its number."""
    words = []
    while itinerary > 0:
        itinerary, word = divmod(itinerary, 16)
        words.append(WORDS[word - 1])
    return tuple(reversed(words))


def number_of(words: Sequence[str]) -> int:
    """Return the number of an itinerary, as in `Images`."""
    if len(words) > LONGEST:
        return -1
    number = 0
    for word in words:
        number = 16 * number + WORDS.index(word) + 1
    return number


@dataclass(frozen=True, slots=True)
class Region:
    """The states z with |W (z - centre)| <= 1: in the maximum norm, or in the Euclidean one."""

    centre: tuple[float, float]
    matrix: tuple[tuple[float, float], tuple[float, float]]
    label: int
    round: bool = False


@dataclass(frozen=True, slots=True)
class Goals:
    """Targets: a branch of a cell that reaches one is not followed further.

    Labels are positive integers, sets of bits below 2^62 that mean what the caller says.
    ``stops``: the label of the first turn, stick or capture; 0: it is no target.
    ``right``, ``left``: intervals of places x, as their ends in order, and the label of each: where
    a mass is released to the right, or the left.  A label 0 is none: from there, it is followed.
    ``regions``: of states after each whole number of periods.
    """

    stops: int = 0
    right: tuple[Sequence[float], Sequence[int]] = ((), ())
    left: tuple[Sequence[float], Sequence[int]] = ((), ())
    regions: Sequence[Region] = ()

    def __post_init__(self) -> None:
        """Raise `BadInput` unless the intervals are in order, and the labels sets of bits."""
        for ends, labels in (self.right, self.left):
            if len(labels) and (len(ends) != len(labels) + 1 or any(np.diff(ends) <= 0)):
                raise BadInput("the places of release must be the ends of intervals, in order")
        labels = [self.stops, *self.right[1], *self.left[1], *(r.label for r in self.regions)]
        if any(not 0 <= label < 1 << 62 for label in labels):
            raise BadInput("a label must not be negative, and below 2^62")


NOWHERE = Goals()


@dataclass(frozen=True, slots=True)
class FixedPoints:
    """What is proved of N boxes.

    ``proved`` (N,): Φ maps the box smoothly, has exactly one fixed point in it, and this lies in
    the interior of the box, in ``boxes`` (N, 2, 2), lower and upper ends of x and v.  For a range
    of frictions: at each of them.
    ``itinerary`` (N,): the events of all orbits from the box, as a number (`words_of`).
    ``trace`` (N, 2): lower and upper ends of the trace of Φ' on the whole box.  ``rotation``
    (N, 2): the same for Θ/2π in (0, 1/2) with 2 cos Θ = trace, NaN unless |trace| < 2 is certain;
    where det Φ' = 1, the multipliers are exp(±iΘ).
    NaN, and -1, where the box is not mapped smoothly, which is not proved to be so then.
    """

    proved: NDArray[np.bool_]
    itinerary: NDArray[np.int64]
    boxes: Floats
    trace: Floats
    rotation: Floats


HITS, STOPS, EITHER = 0, 1, 2


@dataclass(frozen=True, slots=True)
class Launches:
    """What is proved of N boxes of launches, in units of 1/ω for t and F/ω for u.

    ``verdict`` (N,): `HITS`: all reach the other wall, and (t1, u1) depends smoothly on (t, u);
    `STOPS`: the velocity of all vanishes before; `EITHER`: that is not decided.
    ``images`` (N, 2, 2): lower and upper ends of t1 and u1; t1 is not reduced.  ``derivative``
    (N, 2, 2, 2): lower and upper ends of its entries.  Both NaN unless all reach the wall.
    """

    verdict: NDArray[np.int8]
    images: Floats
    derivative: Floats


@dataclass(frozen=True, slots=True)
class Passages:
    """What is proved of all masses released to the right from N cells of places.

    ``verdict`` (N,): `RELEASED`: they have the same events up to the next release; `SETTLED`: they
    have, but for hits and turns near a wall where all of them come to rest, or by which all are
    captured, before they are released from there or from near it; `MOVING`: they have the same
    events in all the periods followed, and no release; `UNDECIDED`: nothing is known.
    ``half_periods`` (N,) from the first release to the next, 0 if there is none.  ``events``
    (N, M): those after the first release, each as 1 and its place in `WORDS`, then zeros; ``maybe``
    (N,): bits for others, in a settled cell.  ``value`` (N, 2): lower and upper ends of G,
    ``slope`` (N, 2): those of G'; NaN where they are not known.
    """

    verdict: NDArray[np.int8]
    half_periods: NDArray[np.int64]
    events: NDArray[np.int8]
    maybe: NDArray[np.int64]
    value: Floats
    slope: Floats

    def words(self, k: int) -> tuple[str, ...]:
        """Return the events of a cell after the first release."""
        return tuple(WORDS[word - 1] for word in self.events[k].tolist() if word)
