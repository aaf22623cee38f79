"""What the command lines share: complaints in one line, names in quotation marks, lines that
somebody may hear, as wide as their terminal, and guesses of what was meant."""

import argparse
import os
import re
import sys
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NoReturn, TextIO

from cap import __version__


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


def program(module: str) -> str:
    """Return how a command was called: as the script ``cap-prove`` or as a module."""
    script = module.replace(".", "-")
    called = Path(sys.argv[0] if sys.argv else "").stem
    return script if called == script else f"python -m {module}"


def printable(text: str) -> str:
    """Return ``text`` in one line of printable ASCII; other characters are escaped as in Python."""
    return "".join(c if " " <= c <= "~" else c.encode("unicode_escape").decode() for c in text)


def quoted(name: object) -> str:
    """Return a name, say of a file, in quotation marks: where it ends nothing in it can hide."""
    escaped = str(name).replace("\\", r"\\").replace('"', r"\"")
    return f'"{printable(escaped)}"'


def unread(name: object, error: Exception) -> str:
    """Return what is said of a file that cannot be read: it is no verdict."""
    return f"CANNOT READ: {quoted(name)}: {printable(getattr(error, 'strerror', '') or str(error))}"


def meant(word: str, names: Iterable[str]) -> str:
    """Return a guess, in words, of which of some names was meant; without one, nothing."""
    from difflib import get_close_matches  # noqa: PLC0415 (only after a mistake)

    near = get_close_matches(word, list(names), 3)
    return f": did you mean {' or '.join(near)}?" if near else ""


def columns(stream: TextIO | None) -> int | None:
    """Return the width of the terminal that a stream is, or None if it is none."""
    try:
        return os.get_terminal_size(stream.fileno()).columns or None if stream else None
    except (OSError, ValueError):
        return None


def wrapped(line: str, stream: TextIO | None) -> str:
    """Return a line as wide as the terminal, if the stream is one: what follows is indented."""
    width = columns(stream)
    if not width:
        return line
    return textwrap.fill(
        line, width, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )


def protected(word: str) -> str:
    """Return ``word`` such that argparse takes a negative number, also -1/2, for a value."""
    return " " + word if re.fullmatch(r"-[\d.]\S*", word) else word


def say(line: str, stream: TextIO | None) -> None:
    """Print a line to a stream, if there is such a stream."""
    if stream is not None:
        print(line, file=stream)
