"""Verdicts kept from one run to the next, by the content of what decided them.

An entry is one file, named by a digest of the claim, its data, and of all sources and libraries; it
also names the stored certificates that were asked for, with their digests, and holds only while
these are the same.  The folder is ``$CAP_CACHE`` or ``cap/audit`` in the user's cache folder; where
it cannot be read or written there is no cache.
"""

import hashlib
import json
import os
import sys
from contextlib import suppress
from dataclasses import asdict
from functools import cache
from importlib.metadata import version
from pathlib import Path

from cap import tree
from cap.audit.claim import Claim
from cap.audit.means import stored
from cap.audit.verdict import Outcome, Verdict, verdict
from cap.files import replacing

LIBRARIES = ("python-flint", "sympy", "numpy", "numba", "mpmath")


def folder() -> Path:
    """Return the folder of the cache."""
    if own := os.environ.get("CAP_CACHE"):
        return Path(own)
    user = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(user) / "cap" / "audit"


@cache
def sources() -> str:
    """Return a digest of all that may decide any claim: modules, data, tables, the libraries.

    Whatever changes there, everything is decided anew: no list of imports can be wrong.  What a
    claim itself is given is not here: see `Claim.content`.
    """
    total = hashlib.sha256(" ".join([sys.version, *map(version, LIBRARIES)]).encode())
    for root in (tree.ROOT, tree.inside("proofs"), tree.inside("examples")):
        for file in sorted(root.rglob("*.*")):
            read = file.suffix in (".py", ".json", ".csv") or file.parent.name == "tables"
            if read and file.name != "recorded.json":
                name = file.relative_to(root).as_posix()
                total.update(name.encode() + hashlib.sha256(file.read_bytes()).digest())
    return total.hexdigest()


def known(claim: Claim) -> Verdict | None:
    """Return the verdict that is kept, if what decides the claim is as it was then."""
    with suppress(OSError, RuntimeError):  # RuntimeError: there is no home
        text = _path(claim).read_text(encoding="utf-8")
        with suppress(ValueError, KeyError, TypeError, AttributeError):  # none that is a verdict
            entry = json.loads(text)
            if all(stored.digest(name) == value for name, value in entry["certificates"].items()):
                return verdict(entry["verdict"])
    return None


def keep(claim: Claim, decided: Verdict, certificates: dict[str, str]) -> None:
    """Keep a verdict, if the folder can be written; what is undecided is not kept."""
    if decided.outcome is Outcome.UNDECIDED:
        return
    entry = {"verdict": asdict(decided), "certificates": certificates}
    with suppress(OSError, RuntimeError):
        path = _path(claim)
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as file:
            file.write(json.dumps(entry).encode())


def _path(claim: Claim) -> Path:
    name = f"{claim.id} {claim.content} {sources()}"
    return folder() / f"{hashlib.sha256(name.encode()).hexdigest()[:40]}.json"
