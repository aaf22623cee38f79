"""What the check of one file gives: a verdict, the steps, an exit status.

The verdict is ``VERIFIED: <the theorem> ("FILE")``, ``REJECTED: "FILE": <the reason>``, or
``CANNOT READ: "FILE": <the reason>``, which is none; what is not printable in it is escaped.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Callable
from errno import EINVAL
from pathlib import Path
from typing import NamedTuple, Protocol, runtime_checkable

from cap.checker.kernel.certificate import MAX_BYTES, read
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems import load
from cap.checker.verdict import check, words
from cap.tree import inside
from cap.words import meant, printable, quoted, unread

STORED = inside("certificates")


class Outcome(NamedTuple):
    """The verdict on a file, the exit status, the steps of the proof, and what was proved."""

    verdict: str
    status: int
    steps: list[str]
    certificate: Certificate | None = None


@runtime_checkable
class Measured(Protocol):
    """A theorem whose checks may take long: somebody has measured how long."""

    def seconds(self) -> int:
        """Return about how long a check takes."""


def outcome(name: str, jobs: int, tell: Callable[[str, float], None]) -> Outcome:
    """Check a file, or a stored certificate by its name, with as many processes."""
    steps = list[str]()
    try:
        data = content(found(name))
    except (OSError, ValueError) as error:
        return Outcome(unread(name, error) + _guess(name), 2, steps)
    try:
        certificate = check(data, steps.append, jobs, tell)
        return Outcome(f"VERIFIED: {words(certificate)} ({quoted(name)})", 0, steps, certificate)
    except Exception as reason:  # noqa: BLE001  (whatever goes wrong, nothing is proved)
        return Outcome(f"REJECTED: {quoted(name)}: {why(reason)}", 1, steps)


def expected(name: str) -> int:
    """Return about how many seconds a check takes; 0 if that is not known, or there is no check."""
    try:
        return seconds(content(found(name)))
    except Exception:  # noqa: BLE001  (the check will say why)
        return 0


def seconds(data: bytes) -> int:
    """Return about how long a check takes, if that is known, or raise an exception."""
    certificate = read(data)
    theorem = load(certificate.theorem)(certificate, lambda _: None)
    return theorem.seconds() if isinstance(theorem, Measured) else 0


def found(name: str) -> Path:
    """Return the path of a file; a bare name may be that of a stored certificate."""
    return STORED / f"{name}.json" if name in stored() and not Path(name).exists() else Path(name)


def stored() -> list[str]:
    """Return the names of the stored certificates, where the package has them beside it."""
    return sorted(path.stem for path in STORED.glob("*.json"))


def _guess(name: str) -> str:
    """Return which stored certificate may have been meant, in words, for a bare name."""
    return meant(name, stored()) if re.fullmatch(r"[\w-]+", name) else ""


def content(path: Path) -> bytes:
    """Return the content of a regular file, at most one byte more than a certificate may have.

    Raises `OSError` if it cannot be read, and `ValueError` if its name is none.
    """
    with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK), "rb") as file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            raise OSError(EINVAL, "Not a regular file")
        return file.read(MAX_BYTES + 1)


def why(reason: Exception) -> str:
    """Return a reason in one short line."""
    if isinstance(reason, Rejected):
        return printable(str(reason))[:300]
    return f"{type(reason).__name__} while checking"
