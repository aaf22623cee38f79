"""Certificates whose check takes long: accepted when the verdicts were recorded.

``accepted.json`` has a digest of each.  While the file is the same it is not checked again here;
``python -m cap.verify`` checks it, with all others, and so does CI with every change.
"""

import hashlib
import json
from functools import cache
from pathlib import Path

from cap.files import replacing

STORED = Path(__file__).with_name("accepted.json")
LONG = (
    "branch.json",
    "conservative.json",
    "converse.json",
    "horseshoe-1.json",
    "island-2.json",
    "islands.json",
    "mixed.json",
    "persistence.json",
)


def known(name: str, data: bytes) -> bool:
    """Return whether a certificate that takes long was accepted."""
    return name in LONG and _stored().get(name) == _digest(data)


def note(name: str, data: bytes) -> None:
    """Note that a certificate was accepted just now, if it takes long."""
    if name in LONG:
        _NEW[name] = _digest(data)


def taken() -> dict[str, str]:
    """Return what was noted in this process, and forget it: another one records it."""
    found = dict(_NEW)
    _NEW.clear()
    return found


def give(notes: dict[str, str]) -> None:
    """Note what another process took."""
    _NEW.update(notes)


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


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
