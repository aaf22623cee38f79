"""The text of the paper: where a piece of TeX stands in it, however its lines are broken."""

import re
from dataclasses import dataclass
from pathlib import Path

from cap.errors import BadInput


@dataclass(frozen=True)
class Manuscript:
    """The text of a TeX file."""

    text: str

    @classmethod
    def read(cls, path: Path) -> "Manuscript":
        """Return the text of a file; `BadInput` if it cannot be read."""
        try:
            return cls(path.read_bytes().decode("utf-8"))
        except UnicodeDecodeError:
            raise BadInput(f"cannot read {path}: it is not in UTF-8") from None
        except OSError as error:
            raise BadInput(f"cannot read {path}: {error.strerror}") from None

    def argument(self, command: str) -> str:
        """Return the argument of the first command of this name, in one line, or nothing."""
        found = re.search(rf"\\{command}\{{([^{{}}]*)\}}", self.text)
        return " ".join(found[1].split()) if found else ""

    def lines(self, piece: str) -> list[int]:
        """Return the lines in which a piece begins, from 1."""
        found = re.finditer(_broken(piece), self.text)
        return [self.text.count("\n", 0, each.start()) + 1 for each in found]

    def count(self, piece: str) -> int:
        """Return how often a piece occurs."""
        return len(re.findall(_broken(piece), self.text))

    def replaced(self, old: str, new: str) -> "Manuscript":
        """Return the text with ``new`` in each place of ``old``."""
        return Manuscript(re.sub(_broken(old), lambda _: new, self.text))


def _broken(piece: str) -> str:
    """Return a pattern of the piece, with its lines broken at will."""
    return r"\s+".join(map(re.escape, piece.split()))
