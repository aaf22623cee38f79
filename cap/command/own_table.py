"""A table of published orbits: each row proved and compared, on several processes, with journal."""

import sys
from collections import Counter
from collections.abc import Iterator
from functools import partial
from hashlib import sha256
from pathlib import Path

from cap.command.progress import Progress
from cap.proofs import published
from cap.proofs.published import Row, Verdict
from cap.runner import Plan, Runner
from cap.system.model import System
from cap.words import printable, say

CLOSE = 1.0  # units of the last place that is printed


def proved(
    system: System, table: Path, digits: int, jobs: int, journal: Path | None, progress: Progress
) -> int:
    """Prove the orbits of a table, print what became of them; return the status."""
    rows = published.rows(system, table)
    contents = "\n".join([rows[0].system, *map(repr, rows), str(digits)])
    plan = Plan[tuple[int, Row], Verdict](
        key=f"orbits of a table, {sha256(contents.encode()).hexdigest()}",
        name=lambda task: str(task[0]),
        encode=Verdict.encoded,
        decode=Verdict.decoded,
        total=len(rows),
        words="proving and checking rows",
    )
    runner = Runner(jobs, progress.tell, None, journal, whole=True)
    work = partial(_second, digits=digits)
    found = {task[0]: verdict for task, verdict in runner.run(work, enumerate(rows), plan)}
    verdicts = [found[k] for k in range(len(rows))]
    progress.clear()
    for line in _failures(rows, verdicts):
        say(printable(line), sys.stderr)
    print("\n".join(_summary(verdicts)), flush=True)
    return 0 if all(v.proved and v.places <= CLOSE for v in verdicts) else 1


def _second(task: tuple[int, Row], digits: int) -> Verdict:
    return published.verdict(task[1], digits)


def _failures(rows: list[Row], verdicts: list[Verdict]) -> Iterator[str]:
    """Give a line for each row that is not proved, or whose orbit is another one."""
    for row, verdict in zip(rows, verdicts, strict=True):
        if not verdict.proved:
            yield f"row {row.name}: NOT PROVED.  {verdict.reason}"
        elif verdict.places > CLOSE:
            yield (
                f"row {row.name}: the orbit proved from it is another one: a number differs by "
                f"{verdict.places:.3g} units of its last printed place"
            )


def _summary(verdicts: list[Verdict]) -> Iterator[str]:
    """Give the lines that sum up."""
    good = [v for v in verdicts if v.proved and v.places <= CLOSE]
    away = max((v.places for v in good), default=0.0)
    yield (
        f"{len(good)} of {len(verdicts)} rows proved, and accepted by the independent checker; all "
        f"their numbers are within {away:.2f} units of the last printed place"
    )
    kinds = Counter((v.unstable, v.radius) for v in good)
    for (count, radius), orbits in sorted(kinds.items(), key=lambda kind: -kind[1]):
        circle = (
            "the unit circle, none on it" if radius == "1" else f"the circle of radius {radius}"
        )
        outside = "not decided" if count is None else f"{count} outside {circle}"
        yield f"  multipliers: {outside}: {orbits} orbits"
