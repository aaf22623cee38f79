"""Where commands write: tried before anything is computed, and refused in one line."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cap.errors import BadInput
from cap.files import tried
from cap.words import quoted


def add_out(p: argparse.ArgumentParser, there: str) -> None:
    """Add the option that says where certificates go; ``there`` is what holds in a directory."""
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a file ending in .json, which is replaced; or a directory (default: certificates), "
        f"which is made if it is missing: there {there}",
    )


def writable(path: Path) -> None:
    """Raise `BadInput` if a file certainly cannot be written to ``path``, which is not touched.

    Its directory must be there.
    """
    _try(path, path)


def writable_into(directory: Path, kind: str = "") -> None:
    """Raise `BadInput` if certainly no file can be written into a directory, which is not touched.

    It may be missing, not so the one above it.  A missing one whose name has a suffix was meant for
    a file, which would end in ``kind``.
    """
    if directory.suffix and not directory.exists():
        advice = f"; the name of a file ends in {kind}" if kind else ""
        raise BadInput(f"cannot write into {quoted(directory)}: there is no such directory{advice}")
    _try(directory / "file" if directory.exists() else directory, directory)


def _try(path: Path, named: Path) -> None:
    """Try a path; the complaint is about the one that was named."""
    try:
        tried(path)
    except FileNotFoundError as error:
        above = f"{error.strerror}: {quoted(path.parent)}"
        raise BadInput(f"cannot write {quoted(named)}: {above}") from None
    except OSError as error:
        raise BadInput(f"cannot write {quoted(named)}: {error.strerror}") from None


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Raise `BadInput` if what writes to ``path``, inside, fails."""
    try:
        yield
    except OSError as error:
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
