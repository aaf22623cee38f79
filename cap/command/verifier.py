"""The command ``python -m cap.verify [--explain] [--latex] FILE...``: verdicts on certificates.

``python -m cap.verify --reading THEOREM`` lists the files that prove a theorem.

For each file one line, ``VERIFIED: <the theorem> ("FILE")``, ``REJECTED: "FILE": <the reason>`` or
``CANNOT READ: "FILE": <the reason>``, with the name in quotation marks and what is not printable in
it escaped; on a terminal it is wrapped, and what follows its beginning is indented.
Exit status 0 if every file is verified, 1 if one is rejected, 2 for a wrong command line or if one
cannot be read, whatever the others are.  A certificate that is rejected may state a true theorem;
one that is verified is a proof, as far as ``cap.checker``, Python and the machine are right.
"""

from __future__ import annotations

import argparse
import os
import stat
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from errno import EINVAL
from pathlib import Path
from typing import TextIO

from cap.checker.kernel.certificate import MAX_BYTES
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import NAMES
from cap.checker.verdict import check, words
from cap.command.console import Parser, program, wrapped
from cap.words import printable, quoted, say, unread


def main(words: Sequence[str]) -> int:
    """Verify the files named one after the other; return the exit status."""
    parser = _parser()
    options = parser.parse_args(words)
    if options.reading:
        return _reading(options.reading)
    if not options.files:
        parser.error("the following arguments are required: FILE")
    if options.formal and (options.explain or options.latex):
        parser.error("--formal goes with neither --explain nor --latex")
    if options.formal:
        from cap.command import formal  # noqa: PLC0415 (the checker needs none of it)

        return formal.prove(options.files)
    return max([_verify(name, options) for name in options.files])


def _parser() -> Parser:
    """Return the command line."""
    parser = Parser(
        prog=program("cap.verify"),
        description="Verify certificates: each theorem is proved again, in other arithmetic and by "
        "other code than those that made the certificate; but conservative, and sinks, cycles and "
        "places in mixed, are proved by this code alone.",
        epilog="Example: python -m cap.verify --explain certificates/elliptic.json",
    )
    parser.add_argument("files", nargs="*", metavar="FILE", help="a certificate")
    parser.add_argument(
        "--reading",
        metavar="THEOREM",
        choices=NAMES,
        help="list the files that prove this theorem, in the order to read them, with their lines "
        f"of code and of mathematics; one of: {', '.join(NAMES)}",
    )
    parser.add_argument(
        "--jobs",
        type=_processes,
        default=1,
        metavar="N",
        help="processes, where a proof takes long and can be divided (default 1)",
    )
    parser.add_argument("--explain", action="store_true", help="print every step of the proof")
    parser.add_argument(
        "--formal",
        action="store_true",
        help="prove the theorem by Coq instead, with the library in proofs/formal: elliptic orbits "
        "and saddles with one hit of each wall",
    )
    parser.add_argument(
        "--latex",
        action="store_true",
        help="print the numbers as LaTeX macros; the verdicts go to stderr",
    )
    parser.add_argument(
        "--latex-digits",
        type=_digits,
        default=12,
        metavar="N",
        help="significant digits (default 12)",
    )
    return parser


def _reading(theorem: str) -> int:
    """Say what a referee of a theorem has to read; return 0."""
    from cap.command.reading import added, pages, told  # noqa: PLC0415 (for people, if they ask)

    for line in told(pages(theorem)):
        say(line, sys.stdout)
    for name, more in added(theorem):
        say(f"besides, where `{name}` is claimed:", sys.stdout)
        for line in told(more):
            say(line, sys.stdout)
    return 0


def _processes(text: str) -> int:
    """Return a number of processes."""
    if not (text.isascii() and text.isdigit() and len(text) <= 4 and 1 <= int(text) <= 1024):
        raise argparse.ArgumentTypeError("an integer from 1 to 1024 is needed")
    return int(text)


def _digits(text: str) -> int:
    """Return a number of digits."""
    if not (text.isascii() and text.isdigit() and len(text) <= 4 and 2 <= int(text) <= 1000):
        raise argparse.ArgumentTypeError("an integer from 2 to 1000 is needed")
    return int(text)


def _verify(name: str, options: argparse.Namespace) -> int:
    """Read and verify one file, print the verdict, and return its exit status."""
    out = sys.stderr if options.latex else sys.stdout
    try:
        data = content(Path(name))
    except (OSError, ValueError) as error:
        say(wrapped(unread(name, error), out), out)
        return 2
    return _verdict(name, data, options, out)


def _verdict(name: str, data: bytes, options: argparse.Namespace, out: TextIO | None) -> int:
    """Verify the content of a file, print the verdict, and return its exit status."""
    steps, definitions = list[str](), list[str]()
    try:
        with _telling() as tell:
            certificate = check(data, steps.append, options.jobs, tell)
        if options.latex:
            from cap.certificate.latex import macros  # noqa: PLC0415 (for people, if they ask)

            definitions += macros(certificate, Path(name).stem, options.latex_digits)
        verdict, status = f"VERIFIED: {words(certificate)} ({quoted(name)})", 0
    except Exception as reason:  # noqa: BLE001  (whatever goes wrong, nothing is proved)
        verdict, status = f"REJECTED: {quoted(name)}: {why(reason)}", 1
    for step in steps if options.explain else ():
        say(f"  {step}", out)
    say(wrapped(verdict, out), out)
    for line in definitions:
        say(line, sys.stdout)
    return status


@contextmanager
def _telling() -> Iterator[Callable[[str, float], None]]:
    """Give what hears how far a check is: on a terminal a line, cleared at the end; else nobody."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda _words, _part: None
        return
    from cap.command.progress import Progress  # noqa: PLC0415 (for people, where they look)

    progress = Progress()
    try:
        yield progress.tell
    finally:
        progress.clear()


def content(path: Path) -> bytes:
    """Return the content of a regular file, at most one byte more than a certificate may have.

    Raises `OSError` if it cannot be read, and `ValueError` if its name is none.
    """
    with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(EINVAL, "Not a regular file")
        return file.read(MAX_BYTES + 1)


def why(reason: Exception) -> str:
    """Return a reason in one short line."""
    if isinstance(reason, Rejected):
        return printable(str(reason))[:300]
    return f"{type(reason).__name__} while checking"
