"""The command ``python -m cap.verify [--explain] [--latex] FILE...``: verdicts on certificates.

``python -m cap.verify --reading THEOREM`` lists the files that prove a theorem.

For each file one line, ``VERIFIED: <the theorem> ("FILE")``, ``REJECTED: "FILE": <the reason>`` or
``CANNOT READ: "FILE": <the reason>``, with the name in quotation marks and what is not printable in
it escaped; on a terminal it is laid out (`cap.command.layout`), unless one line is asked for.
Exit status 0 if every file is verified, 1 if one is rejected, 2 for a wrong command line or if one
cannot be read, whatever the others are.  A certificate that is rejected may state a true theorem;
one that is verified is a proof, as far as ``cap.checker``, Python and the machine are right.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from cap.checker.theorems import NAMES
from cap.command.console import Parser, add_jobs, columns, integers, program
from cap.command.layout import laid_out
from cap.command.outcome import Outcome, expected, found, outcome
from cap.words import quoted, say

LONG = 5  # seconds
LARGE = 150_000  # bytes: such a certificate may take minutes, and its proof is divided itself


def main(words: Sequence[str]) -> int:
    """Verify the files named; return the exit status."""
    commands = parser()
    options = commands.parse_args(words)
    if options.reading:
        return _reading(options.reading)
    if not options.files:
        commands.error("the following arguments are required: FILE")
    if options.formal and (options.explain or options.latex):
        commands.error("--formal goes with neither --explain nor --latex")
    if options.formal and sys.platform == "win32":
        commands.error("--formal limits the time of Coq, which Windows cannot: use it elsewhere")
    if options.formal:
        try:
            from cap.command import formal  # noqa: PLC0415 (the checker needs none of it)
        except ImportError:
            commands.error("--formal needs the whole package: this archive holds the checker alone")
        return formal.prove(options.files)
    return _verify(options.files, options)


def parser() -> Parser:
    """Return the command line."""
    words = Parser(
        prog=program("cap.verify"),
        description="Verify certificates: each theorem is proved again, in other arithmetic and by "
        "other code than those that made the certificate; but conservative, contact_attractor, and "
        "parts of mixed, horseshoes and particles_stability, are proved by this code alone "
        "(docs/certificates.md).",
        epilog=f"Example: {program('cap.verify')} --explain certificates/elliptic.json",
    )
    words.add_argument(
        "files", nargs="*", metavar="FILE", help="a certificate, or the bare name of a stored one"
    )
    words.add_argument(
        "--reading",
        metavar="THEOREM",
        choices=NAMES,
        help="list the files that prove this theorem, in the order to read them, with their lines "
        f"of code and of mathematics; one of: {', '.join(NAMES)}",
    )
    add_jobs(
        words, "processes, for several files and for a long proof that can be divided (default 1)"
    )
    words.add_argument(
        "--one-line", action="store_true", help="print a verdict in one line, also on a terminal"
    )
    words.add_argument("--explain", action="store_true", help="print every step of the proof")
    words.add_argument(
        "--formal",
        action="store_true",
        help="prove the theorem by Coq instead, with the library in proofs/formal: elliptic orbits "
        "and saddles with one hit of each wall",
    )
    words.add_argument(
        "--latex",
        action="store_true",
        help="print the numbers as LaTeX macros; the verdicts go to stderr",
    )
    words.add_argument(
        "--latex-digits",
        type=integers(2, 1000),
        default=12,
        metavar="N",
        help="significant digits (default 12)",
    )
    return words


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


def _verify(names: Sequence[str], options: argparse.Namespace) -> int:
    """Verify the files, small ones first; print each verdict, and in the end the time of all."""
    began, status, verified = time.monotonic(), 0, 0
    for name, result in _outcomes(sorted(names, key=_size), options.jobs):
        status = max(status, result.status)
        verified += result.certificate is not None
        _show(name, result, options)
    if len(names) > 1:
        seconds = time.monotonic() - began
        say(f"{verified} of {len(names)} verified in {seconds:.0f} s", sys.stderr)
    return status


def _outcomes(names: Sequence[str], jobs: int) -> Iterator[tuple[str, Outcome]]:
    """Give each file with its outcome; small ones side by side, large ones one by one."""
    small = [name for name in names if _size(name) < LARGE] if jobs > 1 else []
    if len(small) > 1:
        from cap.checker.kernel.processes import each  # noqa: PLC0415 (takes time to load)

        yield from zip(small, each(min(jobs, len(small)), _alone, small), strict=True)
    for name in names[len(small) :] if len(small) > 1 else names:
        announce(name)
        with _telling() as tell:
            result = outcome(name, jobs, tell)
        yield name, result


def announce(name: str) -> None:
    """Say how long the check of a large file takes, if that is known and not short."""
    seconds = expected(name) if _size(name) >= LARGE else 0
    if seconds >= LONG:
        say(f"{quoted(name)}: about {seconds} s", sys.stderr)


def _alone(name: str) -> Outcome:
    """Check a file in one process, without a word."""
    return outcome(name, 1, lambda _words, _part: None)


def _size(name: str) -> int:
    """Return the size of a file in bytes; what cannot be read has none."""
    try:
        return found(name).stat().st_size
    except (OSError, ValueError):
        return 0


def _show(name: str, result: Outcome, options: argparse.Namespace) -> None:
    """Print what was found, and the numbers as macros if they are asked for."""
    out = sys.stderr if options.latex else sys.stdout
    for step in result.steps if options.explain else ():
        say(f"  {step}", out)
    width = None if options.one_line else columns(out)
    say(laid_out(result.verdict, width) if width else result.verdict, out)
    if options.latex and result.certificate is not None:
        from cap.certificate.latex import macros  # noqa: PLC0415 (for people, if they ask)

        for line in macros(result.certificate, Path(name).stem, options.latex_digits):
            say(line, sys.stdout)


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
