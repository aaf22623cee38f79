"""The periodic orbits found, by type, over a parameter (`cap.floats.search.orbits`)."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from cap.certificate import naming
from cap.certificate import writer as certificate
from cap.command.console import quoted
from cap.command.output import writable_into
from cap.errors import BadInput, NotProved
from cap.floats.candidates import TYPES
from cap.floats.findings import Findings, Floats
from cap.floats.search.cycles import Cycle
from cap.floats.search.family import Family
from cap.floats.search.orbits import search
from cap.floats.variation import value_of, varied
from cap.floats.words import described, short
from cap.maps.fixed_point import Start
from cap.parameters import Parameters
from cap.runner import Runner

UNASKED, PROVED, FAILED = "", "proved", "not proved"
DIGITS = 12  # claimed, with --prove
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


def inventory(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    parameter: str = "F",
    values: tuple[float | Fraction, ...] = (),
    period: int = 1,
    prove: bool = False,
    certificates: Path | None = None,
    runner: Runner | None = None,
) -> Inventory:
    """Search at each value, or at the parameters as they are; then, if asked, prove each orbit.

    Values are taken as they are: 2/5 is no double.  The certificates go to a directory
    ``certificates``, if one is named.
    """
    runner = runner or Runner()
    if certificates:
        writable_into(certificates, ".json")
    systems = [varied(p, parameter, value) for value in dict.fromkeys(values)] or [p]
    own = [value_of(system, parameter) for system in systems]
    tasks = [(*each, period) for each in zip(systems, own, strict=True)]
    found = _searched(tasks, runner)
    orbits = [each for part, _ in found for each in part]
    entries = [entry for entry, _ in orbits]
    if prove or certificates:
        starts = [(systems[own.index(entry.value)], entry, start) for entry, start in orbits]
        paths = [_path(certificates, *task) for task in starts] if certificates else []
        proved = runner.map(_proved, starts, "proving", processes=True)
        entries = [entry for entry, _ in proved] + entries[len(proved) :]
        for path, (_, theorem) in zip(paths, proved, strict=False):
            _write(theorem, path)
    return Inventory(
        parameters=systems[0] if len(systems) == 1 else p,
        complete=not runner.interrupted,
        parameter=parameter,
        periods=period,
        values=np.array(own[: len(found)]),
        orbits=tuple(entries),
        families=tuple(each for _, part in found for each in part),
    )


Task = tuple[Parameters, float, int]


Listed = tuple[list[tuple[Entry, Start]], list[FamilyAt]]


def _searched(tasks: list[Task], runner: Runner) -> list[Listed]:
    """Search at each value; one search alone tells how far it is."""
    if len(tasks) > 1:
        return runner.map(_listed, tasks, "inventory", processes=True)
    tell = partial(runner.tell, "inventory")
    return runner.map(lambda task: _listed(task, tell), tasks, "")


def _listed(task: Task, tell: Callable[[float], None] = lambda _part: None) -> Listed:
    """Return what is found at one value."""
    p, value, period = task
    found = search(p, period, tell)
    orbits = [(_entry(p, value, cycle), _start(cycle)) for cycle in found.isolated]
    return orbits, [FamilyAt(value, family) for family in found.families]


def _start(cycle: Cycle) -> Start:
    return Start(cycle.x, cycle.v, cycle.events, cycle.periods)


def _entry(p: Parameters, value: float, cycle: Cycle) -> Entry:
    words = [word.split()[0] for word, _ in cycle.events]
    counts = [words.count(kind) for kind in ("hit", "turn", "stick", "capture")]
    kind = cycle.kind(conserves=p.conserves)
    hits, turns, sticks, captures = counts
    return Entry(
        value,
        cycle.x,
        cycle.v,
        kind,
        cycle.trace,
        cycle.determinant,
        hits,
        turns,
        sticks,
        captures,
        UNASKED,
    )


def _proved(task: tuple[Parameters, Entry, Start]) -> tuple[Entry, dict[str, Any] | None]:
    """Hand an orbit to the prover: Theorem periodic, which the independent checker accepts.

    Returns the certificate, too, or None.
    """
    from cap.proofs import theorems  # noqa: PLC0415 (only who proves waits for them)
    from cap.proofs.fixed_point import Setting  # noqa: PLC0415

    p, entry, start = task
    try:
        proved = theorems.accepted(theorems.THEOREMS["periodic"], Setting(p, start, DIGITS))
    except NotProved as failure:
        return replace(entry, verdict=FAILED, reason=str(failure)), None
    return replace(entry, verdict=PROVED), proved


def _path(directory: Path, p: Parameters, entry: Entry, start: Start) -> Path:
    """Return where `cap.prove` would write the certificate; `BadInput` if another file is there."""
    state, periods = (start.x, start.v), start.periods
    about = {"period": str(periods)} if periods > 1 else {}
    path = directory / naming.name("periodic", p, about | naming.of_state((entry.x, entry.v)))
    naming.free(path, "periodic", p, state)
    return path


def _write(proved: dict[str, Any] | None, path: Path) -> None:
    """Write a certificate, if there is one."""
    try:
        if proved:
            certificate.write(proved, path)
    except OSError as error:
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
