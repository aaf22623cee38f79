"""Search for periodic orbits (`cap.floats.search.orbits`) over a parameter; prove each if asked."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from cap.certificate import naming
from cap.certificate import writer as certificate
from cap.command.output import writable_into, writing
from cap.errors import NotProved
from cap.floats.search.cycles import Cycle
from cap.floats.search.inventory import FAILED, PROVED, UNASKED, Entry, FamilyAt, Inventory
from cap.floats.search.orbits import search
from cap.floats.variation import value_of, varied
from cap.maps.fixed_point import Start
from cap.parameters import Parameters
from cap.runner import Runner

DIGITS = 12  # claimed, with --prove


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
        prover = partial(_proved, widest=bool(certificates))
        proved = runner.map(prover, starts, "proving", processes=True)
        entries = [entry for entry, _ in proved] + entries[len(proved) :]
        for path, (_, theorem) in zip(paths, proved, strict=False):
            if theorem:
                with writing(path):
                    certificate.write(theorem, path)
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


def _proved(
    task: tuple[Parameters, Entry, Start], *, widest: bool = True
) -> tuple[Entry, dict[str, Any] | None]:
    """Hand an orbit to the prover: Theorem periodic, which the independent checker accepts.

    Returns the certificate, too, or None; ``widest``: with the largest box that is found.
    """
    from cap.proofs import theorems  # noqa: PLC0415 (only who proves waits for them)
    from cap.proofs.fixed_point import Setting  # noqa: PLC0415

    p, entry, start = task
    try:
        setting = Setting(p, start, DIGITS, widest=widest)
        proved = theorems.accepted(theorems.THEOREMS["periodic"], setting)
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
