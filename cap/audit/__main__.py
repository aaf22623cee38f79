"""Audit the paper, claim by claim: ``python -m cap.audit``.  See `cap.audit.command`."""

from collections.abc import Sequence
from typing import NoReturn

from cap.command import entry


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return entry.run("cap.audit.command:main", words)


def script() -> NoReturn:
    """Run the command line, and exit with its status."""
    entry.leave(main())


if __name__ == "__main__":
    script()
