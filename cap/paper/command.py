"""``python -m cap.explore --paper LABEL``: the table of a figure of the paper, and its picture."""

import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from cap import export
from cap.console import quoted, say
from cap.errors import BadInput, NotProved
from cap.files import replacing
from cap.paper.figure import Compared, Run, Whole
from cap.paper.registry import figure, labelled

INTERRUPTED = 130
TABLE = "comparison.md"
RULE = (
    "A number agrees if it is at most one unit of the last printed digit away; a count, if it is "
    "equal; an enclosure, if it holds what is proved."
)


def run(
    label: str,
    out: Path | None,
    progress: Callable[[str, float], None],
    *,
    jobs: int = 2,
    quick: bool = False,
) -> int:
    """Print the table of a figure, or of all; return the exit status.

    ``out`` is a file: a picture (.png, .pdf, .svg) or the table (.csv, .npz, .md).  With ``all`` it
    is a directory, for pictures and the table of all.  ``progress`` hears what is done, and which
    part.  Status 1: a theorem that a table asks for was not proved.  Raises `BadInput` if there is
    no such figure, or ``out`` cannot be written.
    """
    labels = labelled(label)
    many = label == "all"
    if out is not None:
        _prepare(out, many)
    tables, status = [RULE], 0
    print(RULE)
    for each in labels:
        began = time.monotonic()
        one = figure(each)
        work = Whole(jobs, partial(_tell, progress, each))
        progress(each, 0.0)
        try:
            found = one.compared(each, Run(work, quick))
        except KeyboardInterrupt:
            say(f"interrupted in {each}; what was done before is kept", sys.stderr)
            status = INTERRUPTED
            break
        except NotProved as failure:
            say(f"{each}: not proved: {failure}", sys.stderr)
            status = 1
            continue
        lines = ["", *found.lines()]
        print("\n".join(lines), flush=True)
        tables += lines
        if out is not None:
            files = [out] if not many else [out / f"{each[4:]}.{kind}" for kind in ("png", "pdf")]
            for path in files:
                _write(found, path, lines)
        if many:
            say(f"{each}: {time.monotonic() - began:.1f} s", sys.stderr)
    if out is not None and many:
        _text(out / TABLE, tables)
    return status


def _tell(progress: Callable[[str, float], None], label: str, words: str, part: float) -> None:
    progress(f"{label} {words}", part)


def _prepare(out: Path, many: bool) -> None:
    """Raise `BadInput` if ``out`` cannot be written; make the directory."""
    if many:
        try:
            out.mkdir(parents=True, exist_ok=True)
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
    try:
        with replacing(path) as file:
            file.write(("\n".join(lines) + "\n").encode())
    except OSError as error:
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
