"""What each claim is taken from, word by word: a piece of TeX.

Each piece is in the paper once, so that its line follows, and so that a piece which is gone from
another version of the paper says that the claim has to be looked at again.
"""

import hashlib
import json
from dataclasses import replace
from pathlib import Path

from cap.audit import errata, labels, ledger, subject
from cap.audit.manuscript import Manuscript
from cap.audit.subject import cached
from cap.errors import BadInput


@cached
def stored() -> dict[str, str]:
    """Return the pieces by the ids of the claims."""
    return {name: each.quote for name, each in ledger.claims().items()}


def lines(manuscript: Manuscript) -> dict[str, int]:
    """Return the lines in which the pieces begin, of those that are in the text once."""
    found = {name: manuscript.lines(piece) for name, piece in stored().items()}
    return {name: each[0] for name, each in found.items() if len(each) == 1}


def bound() -> str:
    """Return a digest of the quotations and the erratum as they are stored."""
    own = json.dumps(stored(), sort_keys=True).encode()
    return hashlib.sha256(own + subject.file("errata.toml").read_bytes()).hexdigest()


def fitted(path: Path) -> labels.Paper:
    """Return the places of a TeX file that every quotation and every change fits, or `BadInput`."""
    found = lines(manuscript := Manuscript.read(path))
    if missing := stored().keys() - found:
        raise BadInput(f"not once in {path}: what is quoted by {', '.join(sorted(missing))}")
    errata.corrected(manuscript)
    return replace(labels.read(path), lines=found, bound=bound())
