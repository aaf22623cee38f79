"""One file that checks certificates: ``python -m cap.command.archive cap-check.pyz``.

It holds the checker and its command line, runs by bare Python (3.11 or later) anywhere, and takes
the words of `cap.verify`:

    python cap-check.pyz --explain elliptic.json

Two archives made from the same sources by the same Python are equal byte by byte: the files are in
the order of their names, and have no times.
"""

from __future__ import annotations

import hashlib
import io
import sys
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NoReturn

from cap.command import entry
from cap.command.console import Parser, program
from cap.files import replacing, tried
from cap.words import quoted, say

ROOT = Path(__file__).parents[1]
PARTS = (
    "__init__.py",
    "certificate/__init__.py",
    "certificate/latex.py",
    "checker/**/*.py",
    "command/__init__.py",
    "command/console.py",
    "command/entry.py",
    "command/layout.py",
    "command/outcome.py",
    "command/progress.py",
    "command/reading.py",
    "command/verifier.py",
    "errors.py",
    "process.py",
    "tree.py",
    "verify.py",
    "words.py",
)
"""What `cap.verify` may load, as patterns below `cap`; but for Coq's proofs, which need more."""

MAIN = b"from cap.verify import script\n\nif __name__ == '__main__':\n    script()\n"
FIRST_LINE = b"#!/usr/bin/env python3\n"
NO_TIME = (1980, 1, 1, 0, 0, 0)  # the first that an archive can tell


def run(words: Sequence[str]) -> int:
    """Write the archive, and say its size and digest; return the exit status."""
    commands = parser()
    path: Path = commands.parse_args(words).file
    try:
        tried(path)
    except (OSError, ValueError) as error:
        commands.error(f"{quoted(path)} cannot be written: {getattr(error, 'strerror', error)}")
    data = archive()
    with replacing(path) as file:
        file.write(data)
    digest = hashlib.sha256(data).hexdigest()
    say(f"{quoted(path)}: {len(data) // 1000} kB, SHA-256 {digest}", sys.stdout)
    return 0


def parser() -> Parser:
    """Return the command line."""
    words = Parser(
        prog=program("cap.command.archive"),
        description="Write the checker of certificates into one file, which bare Python runs.",
        epilog="Example: python -m cap.command.archive cap-check.pyz",
    )
    words.add_argument("file", type=Path, metavar="FILE", help="the archive, say cap-check.pyz")
    return words


def archive() -> bytes:
    """Return the archive's bytes."""
    whole = io.BytesIO(FIRST_LINE)
    whole.seek(0, io.SEEK_END)
    with zipfile.ZipFile(whole, "a", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        for name, data in sorted(sources()):
            entry_of_file = zipfile.ZipInfo(name, NO_TIME)
            entry_of_file.compress_type = zipfile.ZIP_DEFLATED
            entry_of_file.external_attr = 0o644 << 16
            file.writestr(entry_of_file, data)
    return whole.getvalue()


def sources() -> Iterator[tuple[str, bytes]]:
    """Give the names and contents of what the archive holds."""
    yield "__main__.py", MAIN
    for pattern in PARTS:
        for path in ROOT.glob(pattern):
            yield f"cap/{path.relative_to(ROOT).as_posix()}", path.read_bytes()


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return entry.run("cap.command.archive:run", words)


def script() -> NoReturn:
    """Run the command line, and exit with its status."""
    entry.leave(main())


if __name__ == "__main__":
    script()
