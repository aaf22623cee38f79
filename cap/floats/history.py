"""One orbit in time, whatever moves on it: samples, events, and how these are told."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cap.floats.findings import Findings, Floats

MOST = 40  # events told


@dataclass(frozen=True, kw_only=True)
class History(Findings):
    """The orbit of a state from t = 0: t (K,), x and v (K, ...), with both velocities at a hit.

    ``words``, ``times``, ``places`` (E,): the events and where they happen; ``before``, ``after``
    (E, ...): the velocities.  ``strobe`` (M, ...): the states at t = 0, T, 2T, …
    """

    period: float
    t: Floats
    x: Floats
    v: Floats
    words: NDArray[np.str_]
    times: Floats
    places: Floats
    before: Floats
    after: Floats
    strobe: Floats

    def listed(self, head: str, row: Callable[..., str], end: str) -> list[str]:
        """Return the events in their order, each in a row, between two lines."""
        shown = zip(self.times, self.words, self.places, self.before, self.after, strict=True)
        rows = [row(*event) for event in shown]
        rest = [f"  … {len(rows) - MOST} more"] if len(rows) > MOST else []
        return [head, *rows[:MOST], *rest, end]


def arrays(events: Sequence[Any], shape: tuple[int, ...] = ()) -> dict[str, Any]:
    """Return what a history has of events; ``shape`` is that of a velocity."""
    return {
        "words": np.array([event.word for event in events], dtype=np.str_),
        "times": np.array([event.time for event in events]),
        "places": np.array([event.x for event in events]),
        "before": np.array([event.before for event in events]).reshape(-1, *shape),
        "after": np.array([event.after for event in events]).reshape(-1, *shape),
    }
