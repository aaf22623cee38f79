"""The paper that is audited: a folder of `cap.audit.papers`, chosen by its name.

Its files are described in ``docs/own-paper.md``.  Nothing outside of the folder knows what the
paper says.
"""

import json
import tomllib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from cap.audit.papers import FIRST
from cap.errors import BadInput
from cap.files import replacing
from cap.words import meant

T = TypeVar("T")
FOLDER = Path(__file__).with_name("papers")
_chosen = [FIRST]
_kept: list[Any] = []


def cached(function: Callable[[], T]) -> Callable[[], T]:
    """Return a function of the paper whose value is kept, until another paper is chosen."""
    kept = cache(function)
    _kept.append(kept)
    return kept


def forget() -> None:
    """Read everything again when it is asked for."""
    for each in _kept:
        each.cache_clear()


def names() -> list[str]:
    """Return the names of the papers."""
    return sorted(path.parent.name for path in FOLDER.glob("*/paper.toml"))


def choose(name: str) -> None:
    """Audit the paper of this name from now on; `BadInput` if there is none."""
    if name not in names():
        raise BadInput(f"no paper {name!r} is audited{meant(name, names())}")
    if name != _chosen[0]:
        _chosen[0] = name
        forget()


def chosen() -> str:
    """Return the name of the paper."""
    return _chosen[0]


def file(name: str) -> Path:
    """Return the path of one of its files."""
    return FOLDER / _chosen[0] / name


def module(name: str) -> str:
    """Return a module of its own: ``claims.GROUP``, or one of ``means``."""
    return f"{__package__}.papers.{_chosen[0]}.{name}"


def data(name: str) -> dict[str, Any]:
    """Return what one of its files says, in TOML or JSON; nothing if it is not there."""
    return read(file(name)) if file(name).is_file() else {}


def read(path: Path) -> dict[str, Any]:
    """Return what a file says, in TOML or JSON; `BadInput` if it is neither."""
    loads = tomllib.loads if path.suffix == ".toml" else json.loads
    try:
        return loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise BadInput(f"{path}: {error}") from None


def store(name: str, text: str) -> None:
    """Write one of its files; read everything again when it is asked for."""
    with replacing(file(name)) as stored:
        stored.write(text.encode())
    forget()


@cached
def paper() -> dict[str, Any]:
    """Return what ``paper.toml`` says."""
    return data("paper.toml")
