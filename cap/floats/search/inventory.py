"""The periodic orbits found, by type, over a parameter: rows, counts and lines."""

from dataclasses import dataclass

import numpy as np

from cap.floats.candidates import TYPES
from cap.floats.findings import Findings, Floats
from cap.floats.search.family import Family
from cap.floats.words import described, short

UNASKED, PROVED, FAILED = "", "proved", "not proved"
KINDS = (*TYPES, "degenerate")


@dataclass(frozen=True)
class Entry:
    """An orbit of period n T at the ``value`` of the parameter, with the number of its events.

    ``verdict``: proved (and accepted by the checker), not proved, or empty: no proof asked for.
    """

    value: float
    x: float
    v: float
    kind: str
    trace: float
    determinant: float
    hits: int
    turns: int
    sticks: int
    captures: int
    verdict: str
    reason: str = ""


@dataclass(frozen=True)
class FamilyAt:
    """A family of orbits that touch no wall, at a ``value`` of the parameter."""

    value: float
    family: Family


@dataclass(frozen=True, kw_only=True)
class Inventory(Findings):
    """The isolated orbits of least period n T found at the values (K,) of a parameter.

    ``families``: at each of the values, those of orbits that touch no wall.
    """

    parameter: str
    periods: int
    values: Floats
    orbits: tuple[Entry, ...]
    families: tuple[FamilyAt, ...]

    @property
    def failed(self) -> int:
        """How many orbits were to be proved and were not."""
        return sum(each.verdict == FAILED for each in self.orbits)

    def count(self, kind: str) -> "np.ndarray[tuple[int], np.dtype[np.int64]]":
        """Return how many isolated orbits of a kind there are at each value."""
        return np.array(
            [
                sum(o.kind == kind and o.value == value for o in self.orbits)
                for value in self.values
            ],
            dtype=np.int64,
        )

    def varying(self) -> dict[str, Floats]:
        """Return the values of the parameter, if there are several."""
        return {self.parameter: self.values} if len(self.values) > 1 else {}

    def columns(self) -> dict[str, "np.ndarray[tuple[int], np.dtype[np.generic]]"]:
        """Return one row for each isolated orbit."""
        names = [name for name in Entry.__dataclass_fields__ if name != "value"]
        columns = {name: np.array([getattr(each, name) for each in self.orbits]) for name in names}
        return {self.parameter: np.array([each.value for each in self.orbits]), **columns}

    def lines(self) -> list[str]:
        """Return the counts by type, the isolated orbits, and the families."""
        over = f" over {self.parameter}" if len(self.values) > 1 else ""
        system = described(self.parameters, self.varying())
        head = f"isolated orbits of period {self.periods} found{over} at {system}"
        rows = []
        for value in self.values:
            own = [each for each in self.orbits if each.value == value]
            kinds = [each.kind for each in own]
            counts = ", ".join(f"{kinds.count(k)} {k}" for k in KINDS if k in kinds) or "none found"
            rows.append(f"{self.parameter} = {short(str(value))}: {len(own)} orbits: {counts}")
            rows += [f"  {_shown(each)}" for each in own]
            rows += [
                f"  a family of orbits that touch no wall, not counted: {each.family.line()}"
                for each in self.families
                if each.value == value
            ]
        return [head, *rows]


def _shown(each: Entry) -> str:
    events = f"{each.hits} hits, {each.turns} turns, {each.sticks} sticks, {each.captures} captures"
    return (
        f"({each.x:< .10g}, {each.v:< .10g}) {each.kind:<12} trace {each.trace:< .6g}, det "
        f"{each.determinant:.4g}; {events}" + (f"  {each.verdict}" if each.verdict else "")
        + (f": {each.reason[:90]}" if each.reason else "")
    )  # fmt: skip
