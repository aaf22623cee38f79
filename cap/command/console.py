"""What the command lines share: complaints in one line, names in quotation marks, and lines that
somebody may hear."""

import argparse
import re
import sys
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


def protected(word: str) -> str:
    """Return ``word`` such that argparse takes a negative number, also -1/2, for a value."""
    return " " + word if re.fullmatch(r"-[\d.]\S*", word) else word


def say(line: str, stream: TextIO | None) -> None:
    """Print a line to a stream, if there is such a stream."""
    if stream is not None:
        print(line, file=stream)
