"""Pictures of certificates: each is verified before it is drawn."""

from concurrent.futures import BrokenExecutor
from pathlib import Path

from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Certificate, Theorem
from cap.command.outcome import content, why
from cap.errors import BadInput
from cap.explore.export import IMAGES, kind
from cap.words import quoted


def rejected(theorem: Theorem) -> str:
    """Return why the checker rejects a certificate; nothing if it proves the theorem."""
    try:
        theorem.prove()
    except BrokenExecutor:
        raise BadInput("a process was killed: that is no verdict") from None
    except Exception as reason:  # noqa: BLE001 (whatever goes wrong, nothing is proved)
        return why(reason)
    return ""


def image(out: Path) -> None:
    """Refuse a file that is no picture, or that cannot be written."""
    if kind(out) not in IMAGES:
        raise BadInput(f"no picture: {quoted(out)}")


def certificate(file: Path, theorem: str) -> Certificate:
    """Return a certificate of a theorem."""
    try:
        found = read(content(file))
    except OSError as error:
        raise BadInput(f"cannot read {quoted(file)}: {error.strerror}") from None
    except Rejected as reason:
        raise BadInput(f"{quoted(file)} is no certificate: {reason}") from None
    if found.theorem != theorem:
        raise BadInput(f"{quoted(file)} is about the theorem {found.theorem}, not {theorem}")
    return found
