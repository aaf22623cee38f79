"""``python -m cap.explore --paper LABEL``: the table of a figure of the paper, and its picture."""

import sys
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from cap.command.entry import INTERRUPTED
from cap.command.output import writable_into, writing
from cap.errors import BadInput, NotProved
from cap.explore import export
from cap.files import replacing
from cap.paper.figure import Compared, Run, figure, labelled
from cap.runner import Runner, Tell
from cap.words import quoted, say

TABLE = "comparison.md"
RULE = (
    "A number agrees if it is at most one unit of the last printed digit away; a count, if it is "
    "equal; an enclosure, if it holds what is proved."
)


def run(
    label: str,
    out: Sequence[Path],
    progress: Tell,
    *,
    jobs: int = 2,
    quick: bool = False,
) -> int:
    """Print the table of a figure, or of all; return the exit status.

    ``out`` are files: a picture (.png, .pdf, .svg) or the table (.csv, .npz, .md).  With ``all`` it
    is one directory, for pictures and the table of all, which is written anew after each figure.
    ``progress`` hears what is done, and which part.  Status 1: a theorem that a table asks for was
    not proved.  Raises `BadInput` if there is no such figure, or ``out`` cannot be written.
    """
    labels, many = labelled(label), label == "all"
    if many and len(out) > 1:
        raise BadInput("--paper all goes to one directory: give one --out")
    for path in out:
        _prepare(path, many)
    tables, status = [RULE], 0
    print(RULE)
    for each in labels:
        began = time.monotonic()
        progress(each, 0.0)
        try:
            runner = Runner(jobs, partial(_tell, progress, each), whole=True)
            lines = _figure(each, out, many, Run(runner, quick))
        except KeyboardInterrupt:
            say(f"interrupted in {each}; what was done before is kept", sys.stderr)
            return INTERRUPTED
        except NotProved as failure:
            say(f"{each}: not proved: {failure}", sys.stderr)
            status = 1
            continue
        tables += lines
        if many:
            for path in out:
                _text(path / TABLE, tables)
            say(f"{each}: {time.monotonic() - began:.1f} s", sys.stderr)
    return status


def _figure(label: str, out: Sequence[Path], many: bool, how: Run) -> list[str]:
    """Compute a figure, print its table, write its files; return the lines of the table."""
    found = figure(label).compared(how)
    lines = ["", *found.lines()]
    print("\n".join(lines), flush=True)
    for path in out:
        for file in [path / f"{label[4:]}.{kind}" for kind in ("png", "pdf")] if many else [path]:
            _write(found, file, lines)
    return lines


def _tell(progress: Tell, label: str, words: str, part: float | None) -> None:
    progress(f"{label} {words}", part)


def _prepare(out: Path, many: bool) -> None:
    """Raise `BadInput` if ``out`` cannot be written; make the directory."""
    if many:
        writable_into(out)
        try:
            out.mkdir(exist_ok=True)
        except OSError as error:
            raise BadInput(f"cannot make the directory {quoted(out)}: {error.strerror}") from None
    elif out.suffix != ".md":
        export.kind(out)


def _write(found: Compared, path: Path, lines: list[str]) -> None:
    if path.suffix == ".md":
        _text(path, [RULE, *lines])
    else:
        export.write(found, path, lambda: figure(found.label).picture(found))
    print(f"{quoted(path)}: written")


def _text(path: Path, lines: list[str]) -> None:
    with writing(path), replacing(path) as file:
        file.write(("\n".join(lines) + "\n").encode())
