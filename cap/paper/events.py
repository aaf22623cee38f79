"""The events of an orbit of a figure, counted."""

from collections import Counter
from collections.abc import Iterable

from cap.paper.figure import Found


def counted(words: Iterable[str]) -> Found:
    """Count hits of either wall, turns, rests and releases; ``pattern``: as the captions do."""
    number = Counter(str(word) for word in words)
    kinds = Counter(word.split()[0] for word in number.elements())
    right, left, turns = number["hit r"], number["hit l"], kinds["turn"]
    return {
        "right": right,
        "left": left,
        "turns": turns,
        "sticks": kinds["stick"],
        "releases": kinds["release"],
        "pattern": f"{right} right, {left} left, {turns} turns",
    }
