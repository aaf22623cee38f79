"""What the command lines share: a parser that complains in one line, and lines as wide as the
terminal."""

import argparse
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn, TextIO

from cap import __version__
from cap.words import meant, printable


class Parser(argparse.ArgumentParser):
    """A parser that knows the version, and complains in one line, with exit status 2."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.add_argument(
            "--version",
            action="version",
            version=f"cap {__version__}",
            help="say which version this is, and exit",
        )

    def error(self, message: str) -> NoReturn:
        """Print the complaint and exit."""
        self.exit(2, f"error: {printable(message)} (--help says more)\n")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse what is none of the choices, with a guess of what was meant."""
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            guess = meant(str(value), map(str, action.choices or ()))
            raise argparse.ArgumentError(action, f"{error.message}{guess}") from None

    def _print_message(self, message: str, file: Any = None) -> None:
        """Print help or a complaint; `argparse` would be silent about a file that is full."""
        if file is not None:
            file.write(message)


def integers(least: int, most: int) -> Callable[[str], int]:
    """Return what reads an integer within limits."""

    def read(text: str) -> int:
        if not (
            text.isascii() and text.isdigit() and len(text) <= 4 and least <= int(text) <= most
        ):
            raise argparse.ArgumentTypeError(f"an integer from {least} to {most} is needed")
        return int(text)

    return read


def add_jobs(
    p: argparse._ActionsContainer, about: str = "processes (default 1)", default: int = 1
) -> None:
    """Add the option that says how many processes, or threads, there are."""
    p.add_argument("--jobs", type=integers(1, 1024), default=default, metavar="N", help=about)


def program(module: str) -> str:
    """Return how a command was called: as the script ``cap-prove``, an archive, or a module."""
    script = module.replace(".", "-")
    called = Path(sys.argv[0] if sys.argv else "")
    if called.suffix == ".pyz":
        return f"python {called.name}"
    return script if called.stem == script else f"python -m {module}"


def columns(stream: TextIO | None) -> int | None:
    """Return the width of the terminal that a stream is, or None if it is none."""
    try:
        return os.get_terminal_size(stream.fileno()).columns or None if stream else None
    except (OSError, ValueError):
        return None


def protected(word: str) -> str:
    """Return ``word`` such that argparse takes a negative number, also -1/2, for a value."""
    return " " + word if re.fullmatch(r"-[\d.]\S*", word) else word
