"""Verify certificates: ``python -m cap.verify FILE...``.

Exit status 0 if every file is verified, 1 if one is rejected, 2 for a wrong command line, 130 after
an interrupt.  See `cap.command.verifier`.
"""

from collections.abc import Sequence
from typing import NoReturn

from cap.command import entry


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return entry.run("cap.command.verifier:main", words)


def script() -> NoReturn:
    """Run the command line, and exit with its status."""
    entry.leave(main())


if __name__ == "__main__":
    script()
