"""Itineraries of periodic orbits: the words of their events over a period, in order."""

from collections.abc import Sequence

from cap.audit.means.need import need


def around_turns(words: Sequence[str]) -> list[str]:
    """Return the hit that comes before each turn, where one of the same wall comes after it."""
    around = zip((words[-1], *words[:-1]), words, (*words[1:], words[0]), strict=True)
    found = [(before, after) for before, word, after in around if word.startswith("turn")]
    need(all(before == after for before, after in found), "other hits are around a turn", w=words)
    need(all(before.startswith("hit") for before, _ in found), "turns follow each other", w=words)
    return [before for before, _ in found]
