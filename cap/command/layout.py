"""A verdict laid out for a terminal: the system, a line for each thing claimed, then the file.

An enclosure [0.10271, 0.10272] is printed as 0.1027[1..2]: its ends have the digits before the
bracket in common, and end with those in it.  A word that is longer than a line, as of symbols, is
cut.  Nothing else of the sentence is changed.
"""

import re
import textwrap

from cap.words import digits

ENCLOSURE = re.compile(r"\[(-?\d+\.\d+), (-?\d+\.\d+)\]")
LONG = re.compile(r"\w{80,}")
KEPT = 40  # letters of a long word


def laid_out(verdict: str, width: int) -> str:
    """Return a verdict in lines of this width; one that verifies nothing is only wrapped."""
    word, colon, sentence = verdict.partition(": ")
    if word != "VERIFIED":
        return "\n".join(_filled(verdict, width, "", "  "))
    sentence, beside, file = sentence.rpartition(' ("')  # in the file's name it would be escaped
    first, *rest = ENCLOSURE.sub(_common, LONG.sub(_cut, sentence)).split("; ")
    system, _, begin = first.partition(": ")
    lines = _filled(word + colon + system, width, "", "    ")
    for claim in filter(None, [begin, *rest]):
        lines += _filled(claim, width, "  - ", "    ")
    return "\n".join([*lines, f" {beside}{file}"])


def _common(found: re.Match[str]) -> str:
    return digits(*found.groups())


def _cut(found: re.Match[str]) -> str:
    """Return the beginning of a long word, and how long it is."""
    return f"{found[0][:KEPT]}... ({len(found[0])} letters)"


def _filled(text: str, width: int, first: str, later: str) -> list[str]:
    """Return a text in lines; words are not broken."""
    return textwrap.wrap(
        text,
        width,
        initial_indent=first,
        subsequent_indent=later,
        break_long_words=False,
        break_on_hyphens=False,
    )
