"""What each claim is taken from, word by word: ``quotes.toml``, a piece of TeX for each claim.

Each piece is in the paper once, so that its line follows, and so that a piece which is gone from
another version of the paper says that the claim has to be looked at again.
"""

import tomllib

from cap.audit import subject
from cap.audit.manuscript import Manuscript
from cap.audit.subject import cached


@cached
def stored() -> dict[str, str]:
    """Return the pieces by the ids of the claims."""
    return tomllib.loads(subject.file("quotes.toml").read_text(encoding="utf-8"))


def quote(name: str) -> str:
    """Return the piece that the claim of this id is taken from."""
    return stored().get(name, "")


def lines(manuscript: Manuscript) -> dict[str, int]:
    """Return the lines in which the pieces begin, of those that are in the text once."""
    found = {name: manuscript.lines(piece) for name, piece in stored().items()}
    return {name: each[0] for name, each in found.items() if len(each) == 1}
