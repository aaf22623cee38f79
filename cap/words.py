"""Lines for people: what strangers named is quoted and escaped, so that it forges no sentence."""

from collections.abc import Iterable
from itertools import takewhile
from typing import TextIO


def printable(text: str) -> str:
    """Return ``text`` in one line of printable ASCII; other characters are escaped as in Python."""
    return "".join(c if " " <= c <= "~" else c.encode("unicode_escape").decode() for c in text)


def quoted(name: object) -> str:
    """Return a name, say of a file, in quotation marks: where it ends nothing in it can hide."""
    escaped = str(name).replace("\\", r"\\").replace('"', r"\"")
    return f'"{printable(escaped)}"'


def digits(lower: str, upper: str) -> str:
    """Return the enclosure of two decimals as the digits that both have in common, and the others
    of both: 0.1027[1..2].  If they have few in common, it is [lower, upper]."""
    pairs = zip(lower, upper, strict=False)
    common = "".join(a for a, _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
    unlike = len(lower) != len(upper) or lower == upper
    if unlike or "." not in common or len(lower) > 3 / 2 * len(common):
        return f"[{lower}, {upper}]"
    return f"{common}[{lower[len(common) :]}..{upper[len(common) :]}]"


def unread(name: object, error: Exception) -> str:
    """Return what is said of a file that cannot be read: it is no verdict."""
    return f"CANNOT READ: {quoted(name)}: {printable(getattr(error, 'strerror', '') or str(error))}"


def meant(word: str, names: Iterable[str]) -> str:
    """Return a guess, in words, of which of some names was meant; without one, nothing."""
    from difflib import get_close_matches  # noqa: PLC0415 (only after a mistake)

    near = get_close_matches(word, list(names), 3)
    return f": did you mean {' or '.join(near)}?" if near else ""


def say(line: str, stream: TextIO | None) -> None:
    """Print a line to a stream, if there is such a stream."""
    if stream is not None:
        print(line, file=stream)
