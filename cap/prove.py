"""Prove a theorem: ``python -m cap.prove elliptic``.

Exit status 0 if everything was proved and the checker accepted the certificate, 1 if not, 2 on bad
input, 130 after an interrupt.  See `cap.command.prover`.
"""

from collections.abc import Sequence
from typing import NoReturn

from cap.command import entry


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return entry.run("cap.command.prover:main", words)


def script() -> NoReturn:
    """Run the command line, and exit with its status."""
    entry.leave(main())


if __name__ == "__main__":
    script()
