"""The syntax of a TeX file, as far as it is seen without TeX.

Braces, dollars, displays and environments are nested, each label is there once, and references
have a label.
"""

import re
from collections import Counter
from collections.abc import Iterator

_MARK = re.compile(
    r"\\\\|\\[{}$%]|(?P<comment>%.*)|(?P<verb>\\verb\*?(?P<bar>[^a-zA-Z\s*]).*?(?P=bar))"
    r"|\\(?P<way>begin|end)\{(?P<name>[^{}]*)\}|(?P<open>\{|\\\[|\\\()|(?P<close>\}|\\\]|\\\))"
    r"|(?P<dollar>\$\$?)"
)
_PAIRS = {"}": "{", r"\]": r"\[", r"\)": r"\("}
_LABEL = re.compile(r"\\label\{([^{}]*)\}")
_REFERENCE = re.compile(r"\\(?:eq|page|auto|[cC])?ref\{([^{}]*)\}")


def faults(text: str) -> list[str]:
    """Return what is wrong, in words, with lines; nothing if no fault is seen."""
    found = list(_nesting(text))
    bare = re.sub(r"(?<!\\)%.*", "", text)
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
