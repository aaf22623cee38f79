"""The command ``python -m cap.explore certificate FILE``: the picture of a theorem that is proved.

The theorem is proved again, as by `cap.verify`; if the checker rejects the certificate there is no
picture, and the exit status is 1.  What of a picture is proved, and what is floats, it says.
"""

import argparse
import sys
from concurrent.futures import BrokenExecutor
from pathlib import Path
from typing import Any

from cap.checker.kernel.certificate import Certificate, read
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Theorem
from cap.command import entry
from cap.command.console import add_jobs
from cap.command.outcome import content, found, why
from cap.command.progress import Progress
from cap.errors import BadInput
from cap.files import replacing
from cap.words import quoted, say, unread

NAME = "certificate"
SUMMARY = "what a certificate proves, which is verified first"
MORE = """
The theorem is proved again, as by cap.verify: a certificate that is rejected is not drawn
(exit status 1).  What is proved says so; curves in floats are there to find one's way.
Most take seconds, mixed and conservative some minutes (--jobs).
"""
EXAMPLE = f"python -m cap.explore {NAME} elliptic --out elliptic.png"


def add(commands: Any) -> None:
    """Add the command to others."""
    p = commands.add_parser(
        NAME,
        help=SUMMARY,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description=f"Draw {SUMMARY}.\n{MORE}",
        epilog=f"Example:\n  {EXAMPLE}",
    )
    p.add_argument("file", metavar="FILE", help="a certificate, or the bare name of a stored one")
    p.add_argument(
        "--out",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help="write FILE.png, .pdf or .svg (default: NAME.png); may be repeated",
    )
    add_jobs(p)


def run(options: argparse.Namespace, progress: Progress) -> int:
    """Verify the certificate, and draw it."""
    with entry.loading():  # slow to load: not for --help
        from cap.explore import export  # noqa: PLC0415
        from cap.pictures import theorems  # noqa: PLC0415

    out = [*options.first_out, *options.out] or [Path(f"{Path(options.file).stem}.png")]
    kinds = [export.image(path) for path in out]
    certificate = opened(options.file)
    theorem = theorems.proof(certificate.theorem)(certificate, lambda _step: None)
    theorem.jobs = options.jobs
    theorem.tell = progress.tell
    if reason := rejected(theorem):
        progress.clear()
        say(f"REJECTED: {quoted(options.file)}: {reason}; no picture is drawn", sys.stdout)
        return 1
    figure = theorems.drawn(theorem)
    progress.clear()
    for path, kind in zip(out, kinds, strict=True):
        with replacing(path) as file:
            export.save(figure, kind, file)
    written = ", ".join(quoted(path) for path in out)
    say(f"VERIFIED: {quoted(options.file)}; {written}: written", sys.stdout)
    return 0


def opened(name: str) -> Certificate:
    """Return the certificate in a file, or the stored one of a name."""
    try:
        return read(content(found(name)))
    except OSError as error:
        raise BadInput(unread(name, error).replace("CANNOT READ: ", "cannot read ", 1)) from None
    except Rejected as reason:
        raise BadInput(f"{quoted(name)} is no certificate: {reason}") from None


def rejected(theorem: Theorem) -> str:
    """Return why the checker rejects a certificate; nothing if it proves the theorem."""
    try:
        theorem.prove()
    except BrokenExecutor:
        raise BadInput("a process was killed: that is no verdict") from None
    except Exception as reason:  # noqa: BLE001 (whatever goes wrong, nothing is proved)
        return why(reason)
    return ""
