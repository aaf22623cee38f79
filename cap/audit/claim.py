"""A claim of the paper: what is claimed, where, in what words, and who decides it."""

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from cap.audit.verdict import Verdict


class Kind(StrEnum):
    """What a claim is."""

    THEOREM = "statement"
    STEP = "step of a proof"
    FORMULA = "formula"
    NUMBER = "number"
    INEQUALITY = "inequality"
    DEFINITION = "definition"
    CONSISTENCY = "consistency"
    WORDS = "description"


Decide = Callable[[], Verdict]


@dataclass(frozen=True)
class Claim:
    """A claim: its place, a label of the paper; in our words; the value stated; who decides it.

    ``quote`` is the piece of TeX it is taken from, which is in the paper once; ``content`` is a
    digest of the data that it is given.  If it is a row of a table, it says itself what is proved;
    ``table`` is the label of this.
    """

    id: str
    where: str
    kind: Kind
    says: str
    stated: str
    decide: Decide
    quote: str = ""
    content: str = ""
    table: str = ""


def content(*data: Any) -> str:
    """Return a digest of the data that a claim is given."""
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()
