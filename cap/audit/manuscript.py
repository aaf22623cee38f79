"""The text of the paper: where a piece of TeX stands in it, and what is wrong with its syntax.

Pieces are found however their lines are broken.  The syntax is right, as far as it is seen without
TeX, if braces, dollars, displays and environments are nested, each label is there once, and
references have a label.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from cap.errors import BadInput

_MARK = re.compile(
    r"\\\\|\\[{}$%]|(?P<comment>%.*)|(?P<verb>\\verb\*?(?P<bar>[^a-zA-Z\s*]).*?(?P=bar))"
    r"|\\(?P<way>begin|end)\{(?P<name>[^{}]*)\}|(?P<open>\{|\\\[|\\\()|(?P<close>\}|\\\]|\\\))"
    r"|(?P<dollar>\$\$?)"
)
_HIDDEN = re.compile(
    r"(?<!\\)(?P<before>(?:\\\\)*)%.*|\\iffalse\b[\s\S]*?\\fi\b"
    r"|\\begin\{comment\}[\s\S]*?\\end\{comment\}|(?<=\\end\{document\})[\s\S]+"
)
_PAIRS = {"}": "{", r"\]": r"\[", r"\)": r"\("}
_LABEL = re.compile(r"\\label\{([^{}]*)\}")
_REFERENCE = re.compile(r"\\(?:eq|page|auto|[cC])?ref\{([^{}]*)\}")


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

    @cached_property
    def printed(self) -> "Manuscript":
        """The text, on the same lines, without comments and what else TeX does not print."""
        return Manuscript(
            _HIDDEN.sub(lambda each: (each["before"] or "") + "\n" * each[0].count("\n"), self.text)
        )

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
    """Return a pattern of the piece, with its lines broken at will; no part of a word or number."""
    words = r"\s+".join(map(re.escape, piece.split()))
    before = r"(?<![\w.])" if words[:1].isalnum() else ""
    before += "(?<!-)" if words[:1].isdigit() else ""
    return before + words + (r"(?!\w|\.\d)" if words[-1:].isalnum() else "")


def faults(text: str) -> list[str]:
    """Return what is wrong, in words, with lines; nothing if no fault is seen."""
    found = list(_nesting(text))
    bare = Manuscript(text).printed.text
    labels = Counter(_LABEL.findall(bare))
    found += [f"{label} is a label {count} times" for label, count in labels.items() if count > 1]
    cited = {label for each in _REFERENCE.findall(bare) for label in each.split(",")}
    return found + [f"there is no label {label}" for label in sorted(cited - labels.keys())]


def _nesting(text: str) -> Iterator[str]:
    opened: list[tuple[str, int]] = []
    for mark in _MARK.finditer(text):
        line = text.count("\n", 0, mark.start()) + 1
        sign = mark["open"] or mark["dollar"] or mark["name"]
        if mark["open"] or mark["way"] == "begin":
            opened.append((sign, line))
        elif mark["dollar"] and (not opened or opened[-1][0] != sign):
            if "$" in {each for each, _ in opened}:
                yield f"line {line}: a {sign} inside of mathematics"
                return
            opened.append((sign, line))
        elif mark["close"] or mark["way"] or mark["dollar"]:
            wanted = _PAIRS.get(mark[0], sign)
            if not opened or opened[-1][0] != wanted:
                yield f"line {line}: {mark[0]} closes nothing that is open"
                return
            opened.pop()
    yield from (f"line {line}: {sign} is not closed" for sign, line in opened[:1])
