"""Options of a command line: how each is read from its words."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from cap.errors import BadInput
from cap.parameters import exact

PARAMETERS = ("f", "F", "omega", "R", "e", "mu")
Reader = Callable[[Sequence[str], str], Any]


@dataclass(frozen=True)
class Option:
    """An option of a command: how it is read, from how many words; without a value a default.

    ``word`` is the keyword argument that it becomes, if that is not its name.  Where it is
    ``about`` the theorem asked for, the name of a certificate tells its value.
    """

    name: str
    reader: Reader | None
    help: str
    metavar: str | tuple[str, ...] | None = None
    nargs: int | str | None = None
    default: Any = None
    word: str = ""
    about: bool = False

    @property
    def flag(self) -> bool:
        """Whether it is given without a value."""
        return self.reader is None

    @property
    def keyword(self) -> str:
        """The keyword argument that it becomes."""
        return self.word or self.name.replace("-", "_")

    def read(self, text: str | Sequence[str]) -> Any:
        """Return its value; raise `BadInput` if it has none."""
        words = [text] if isinstance(text, str) else list(text)
        return self.reader(words, self.name) if self.reader else None


def integer(text: str, name: str, limits: tuple[int, int], longest: int = 9) -> int:
    """Return an integer within limits, of so many digits at most."""
    least, most = limits
    text = text.strip()
    fits = re.fullmatch(rf"\d{{1,{longest}}}", text, re.ASCII) and least <= int(text) <= most
    if not fits:
        raise BadInput(f"--{name} must be an integer from {least} to {most}: {text[:40]!r}")
    return int(text)


def count(least: int, most: int) -> Reader:
    """Read an integer within limits."""
    return lambda words, name: integer(words[0], name, (least, most))


def positive(words: Sequence[str], name: str) -> float:
    """Read a positive number."""
    return float(exact_positive(words, name))


def exact_number(words: Sequence[str], _name: str) -> Fraction:
    """Read a number, exactly."""
    return exact(words[0])


def exact_positive(words: Sequence[str], name: str) -> Fraction:
    """Read a positive number, exactly."""
    value = exact(words[0])
    if value <= 0:
        raise BadInput(f"--{name} must be positive: {words[0].strip()}")
    return value


def exact_part(words: Sequence[str], name: str) -> Fraction:
    """Read a positive number less than 1, exactly."""
    value = exact_positive(words, name)
    if value >= 1:
        raise BadInput(f"--{name} must be less than 1: {words[0].strip()}")
    return value


def positive_to(most: float) -> Reader:
    """Read a positive number up to a limit."""

    def read(words: Sequence[str], name: str) -> float:
        value = positive(words, name)
        if value > most:
            raise BadInput(f"--{name} must be at most {most:g}: {words[0].strip()}")
        return value

    return read


def numbers(words: Sequence[str], _name: str) -> tuple[float, ...]:
    """Read numbers."""
    return tuple(float(exact(word)) for word in words)


def exacts(words: Sequence[str], _name: str) -> tuple[Fraction, ...]:
    """Read numbers, exactly."""
    return tuple(exact(word) for word in words)


def masses(words: Sequence[str], _name: str) -> tuple[Fraction, ...]:
    """Read masses, exactly, separated by commas."""
    return tuple(exact(word) for word in words[0].split(","))


def counts(words: Sequence[str], name: str) -> tuple[int, ...]:
    """Read positive integers."""
    return tuple(integer(word, name, (1, 100_000)) for word in words)


def path(words: Sequence[str], _name: str) -> Path:
    """Read a path."""
    return Path(words[0])


def choice(*names: str) -> Reader:
    """Read one of some names."""

    def read(words: Sequence[str], name: str) -> str:
        if words[0] not in names:
            raise BadInput(f"--{name} must be one of {', '.join(names)}: {words[0][:40]!r}")
        return words[0]

    return read


def text(words: Sequence[str], _name: str) -> str:
    """Read a text."""
    return words[0]


def texts(words: Sequence[str], _name: str) -> tuple[str, ...]:
    """Read texts."""
    return tuple(words)


def names(words: Sequence[str], name: str) -> tuple[str, ...]:
    """Read names of parameters."""
    return tuple(choice(*PARAMETERS)([word], name) for word in words)
