"""Explore the oscillator in floats: ``python -m cap.explore portrait --out portrait.png``.

Exit status 0; 1 if something asked for was not proved; 2 on bad input; 130 after an interrupt, when
what had been done is written.  See `cap.explore.explorer`.
"""

from collections.abc import Sequence
from typing import NoReturn

from cap.command import entry


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return entry.run("cap.explore.explorer:main", words)


def script() -> NoReturn:
    """Run the command line, and exit with its status."""
    entry.leave(main())


if __name__ == "__main__":
    script()
