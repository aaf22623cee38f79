"""A proof from the command line: its certificate is written, and the theorem printed."""

import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from cap.certificate import report, writer
from cap.command.console import columns
from cap.command.progress import Progress
from cap.errors import BadInput, NotProved
from cap.words import printable, quoted, say


def proved(
    theorem: str,
    prove: Callable[[], dict[str, Any]],
    path: Path,
    progress: Progress,
    *,
    about: str = "",
    remarks: Callable[[], Iterable[str]] = tuple,
) -> int:
    """Prove a theorem ``about`` an orbit, write and print it, with remarks; return the status."""
    try:
        certificate = prove()
    except NotProved as failure:
        progress.clear()
        named = ", ".join([theorem, printable(about)] if about else [theorem])
        say(f"NOT PROVED ({named}).  {failure}", sys.stderr)
        return 1
    progress.clear()
    told = report.theorem(certificate, columns(sys.stdout) or report.WIDTH)
    try:
        written = writer.write(certificate, path)
    except OSError as error:
        print(told)
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
    print("\n".join([told, *map(printable, remarks())]))
    accepted = f"({written}; the independent checker accepts it)"
    print(f"\nCertificate: {quoted(path)} {accepted}\n", flush=True)
    return 0
