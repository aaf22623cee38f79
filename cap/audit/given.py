"""Claims that are data: ``claims.toml`` of a paper, decided by functions of a few kinds.

[[claim]]
id = "labels.a2.0-e0.89-E1.0"
where = "a2.0-e0.89-E1.0"
kind = "number"
says = "The rows of this table are orbits at e = 0.89."
stated = "e = 0.89"
decide = "label"                  # a function of the paper's module `deciding`
with = { row = 1, e = "0.8" }     # what it is given
"""

import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

from cap.audit.claim import Claim, Kind
from cap.audit.verdict import Verdict


def claims(path: Path, deciding: ModuleType) -> tuple[Claim, ...]:
    """Return the claims of a file; functions of a module decide them."""
    entries = tomllib.loads(path.read_text(encoding="utf-8"))["claim"]
    return tuple(_claim(each, deciding) for each in entries)


def _claim(given: Mapping[str, Any], deciding: ModuleType) -> Claim:
    function: Callable[..., Verdict] = getattr(deciding, given["decide"])
    decide = partial(function, given["where"], **given.get("with", {}))
    return Claim(
        id=given["id"],
        where=given["where"],
        kind=Kind(given["kind"]),
        says=given["says"],
        stated=given["stated"],
        decide=decide,
        by=deciding.__name__,
    )
