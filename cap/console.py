"""What the command lines share: complaints in one line, names in quotation marks, and output that
nobody can read."""

import argparse
import io
import os
import re
import sys
from collections.abc import Callable
from typing import NoReturn, TextIO


class Parser(argparse.ArgumentParser):
    """A parser that complains in one line, with exit status 2."""

    def error(self, message: str) -> NoReturn:
        """Print the complaint and exit."""
        self.exit(2, f"error: {printable(message)} (--help says more)\n")


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


def closing_quietly(command: Callable[[], int]) -> int:
    """Run ``command`` and return its status; what goes wrong with standard output is no traceback.

    Returns 141 if a reader has closed it, as ``| head`` does, and 2 if it cannot be written.
    Characters that it cannot encode are escaped.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        status = command()
        if sys.stdout is not None:
            sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what is still buffered goes nowhere
        if isinstance(error, BrokenPipeError):
            return 141
        say(f"error: standard output cannot be written: {error.strerror}", sys.stderr)
        return 2
    return status


def say(line: str, stream: TextIO | None) -> None:
    """Print a line to a stream, if there is such a stream."""
    if stream is not None:
        print(line, file=stream)
