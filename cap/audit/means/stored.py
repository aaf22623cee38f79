"""Stored certificates: read, and checked by `cap.checker`.

Those that ``accepted.json`` names take long.  It has a digest of each as it was accepted when the
verdicts were recorded; while the file is the same it is not checked again here.  ``python -m
cap.verify`` checks it, with all others, and so does CI with every change.
"""

import hashlib
import json
from contextlib import suppress
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from cap.audit import subject
from cap.audit.means.need import made, need
from cap.audit.subject import cached
from cap.checker import verdict
from cap.checker.kernel import certificate
from cap.checker.kernel.rejection import Rejected
from cap.errors import NotProved
from cap.files import replacing
from cap.tree import inside

ACCEPTED = Path(__file__).with_name("accepted.json")
FOLDER = inside("certificates")
THE_PAPER = "the parameters of the paper"


class Stored(NamedTuple):
    """A certificate that the checker accepts: now, or when the verdicts were recorded."""

    name: str
    parameters: dict[str, Any]
    claims: dict[str, Any]


def stored(name: str) -> Stored:
    """Return a stored certificate, or raise `NotProved` if the checker rejects it."""
    made(name)
    return _accepted(name)


@cached
def of_the_paper() -> dict[str, Fraction]:
    """Return the parameters at which the numbers of the paper are, if it has some, by names."""
    return {name: Fraction(text) for name, text in subject.data("parameters.json").items()}


def at_the_paper(each: Stored) -> bool:
    """Return whether a certificate is about the paper's parameters, and has no others."""
    own = of_the_paper()
    return bool(own) and each.parameters == own


def claimed(name: str) -> Any:
    """Return what a stored certificate claims: ``elliptic.twist``, or nothing if there is none.

    ``elliptic.at`` is where it holds: THE_PAPER, or parameters, as in ``elliptic.at.f``; the
    paper's own are ``paper.f``.  An enclosure has the ends ``lower`` and ``upper``.
    """
    stem, *path = name.split(".")
    value: Any = of_the_paper()
    if stem != "paper":
        if not path or not (FOLDER / f"{stem}.json").is_file():
            return None
        found = stored(f"{stem}.json")
        if path == ["at"] and at_the_paper(found):
            return THE_PAPER
        value = {**found.claims, "at": found.parameters}
    for each in path:
        value = part(value, each)
        need(value is not None, f"{stem}.json claims no {name}")
    return value


def part(value: Any, name: str) -> Any:
    """Return what is of this name in a table, a list, an enclosure or an object, or nothing."""
    if isinstance(value, dict):
        return value.get(name)
    if name.isdigit() and isinstance(value, list | tuple):
        return value[int(name)]
    return getattr(value, name, None)


@cache
def _accepted(name: str) -> Stored:
    need((FOLDER / name).is_file(), f"there is no certificate {name}")
    data, done = (FOLDER / name).read_bytes(), accepted().get(name) == digest(name)
    try:
        found = certificate.read(data) if done else verdict.check(data, lambda _step: None)
    except Rejected as reason:
        raise NotProved("audit", f"the checker rejects {name}: {reason}") from None
    return Stored(name, found.parameters._asdict(), found.claims)


def digest(name: str) -> str:
    """Return a digest of a stored certificate, or nothing if there is none."""
    path = FOLDER / name
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


@cache
def accepted() -> dict[str, str]:
    """Return the digests of the certificates that take long, as they were accepted."""
    found: dict[str, str] = json.loads(ACCEPTED.read_text(encoding="utf-8"))
    return found


def accept() -> None:
    """Check those that take long and are others now; store their digests."""
    new = dict(accepted())
    for name in new:
        with suppress(NotProved):  # else what asks for it is undecided, and not recorded
            new[name] = digest(stored(name).name)
    if new != accepted():
        with replacing(ACCEPTED) as file:
            file.write(f"{json.dumps(new, indent=1)}\n".encode())
        accepted.cache_clear()
