"""Certificates whose check takes minutes: accepted when the verdicts were recorded.

``accepted.json`` has for each a digest of the file and of all that the checker reads for its
theorem.  While both are the same a check would end as it did then, so it is left out; if anything
is another, the certificate is checked now.
"""

import hashlib
import json
from functools import cache
from pathlib import Path

from cap.audit.dependencies import sources
from cap.files import replacing

STORED = Path(__file__).with_name("accepted.json")
LONG = ("conservative.json", "mixed.json")


def known(name: str, data: bytes) -> bool:
    """Return whether a certificate that takes long was accepted, by the same checker."""
    return name in LONG and _stored().get(name) == _digest(name, data)


def note(name: str, data: bytes) -> None:
    """Note that a certificate was accepted just now, if it takes long."""
    if name in LONG:
        _NEW[name] = _digest(name, data)


def record() -> None:
    """Store what was noted."""
    if _NEW:
        text = json.dumps(_stored() | _NEW, indent=1, sort_keys=True)
        with replacing(STORED) as file:
            file.write(f"{text}\n".encode())
        _stored.cache_clear()


_NEW: dict[str, str] = {}


@cache
def _stored() -> dict[str, str]:
    if not STORED.is_file():
        return {}
    found: dict[str, str] = json.loads(STORED.read_text(encoding="utf-8"))
    return found


def _digest(name: str, data: bytes) -> str:
    from cap.checker import theorems, verdict  # noqa: PLC0415 (the checker, where it is needed)

    theorem = name.partition(".")[0].partition("-")[0]
    own = f"{theorems.__name__}.{theorem}", *theorems.load(theorem).PARTS.values()
    read = sources(*own, verdict.__name__)
    return hashlib.sha256(data + read.encode()).hexdigest()
