"""Enclosures in rows, with labels in words, aligned at their decimal points."""

from collections.abc import Iterator
from typing import Any

from cap.certificate import NONE
from cap.checker.kernel.shapes import Table

Row = tuple[str, list[str]]


def rows(table: Table, claims: dict[str, Any]) -> list[Row]:
    """Return labels and enclosures of those of the claims that have a label.

    A label that is the name of a claim stands for its words, one for each enclosure.
    """
    found = list[Row]()
    for field in table:
        value = claims.get(field.name, NONE)
        if field.label in claims and field.label != field.name:
            found += zip(claims[field.label], value, strict=True)
        elif field.label and value != NONE:
            found += _flat(field.label, value)
    return found


def aligned(rows: list[Row]) -> Iterator[str]:
    """Give a line for each label and enclosure, aligned at the decimal points."""
    if not rows:
        return
    whole, part = (max(len(side) for _, pair in rows for side in _sides(pair, n)) for n in (0, 1))
    width = max(len(label) for label, _ in rows)
    for label, pair in rows:
        lower, upper = (
            f"{a:>{whole}}{b:<{part}}"
            for a, b in zip(*(_sides(pair, n) for n in (0, 1)), strict=True)
        )
        yield f"  {label:<{width}}  [{lower}, {upper}]"


def _sides(pair: list[str], side: int) -> list[str]:
    """Return what stands before (0) the decimal points of both ends, or from them on (1)."""
    split = [(whole, point + part) for whole, point, part in (end.partition(".") for end in pair)]
    return [halves[side] for halves in split]


def _flat(label: str, value: Any) -> Iterator[Row]:
    """Give a label for each enclosure in a claim; words in it belong to the label."""
    if isinstance(value, dict):
        words = _words(value)
        sets = {key: part for key, part in value.items() if not isinstance(part, str)}
        for key, part in sets.items():
            yield from _flat(" ".join([label, *(words or [key])]), part)
    elif value and isinstance(value[0], str):
        yield label, value
    else:
        for number, inner in enumerate(value, start=1):
            named = isinstance(inner, dict) and _words(inner)
            yield from _flat(label if named else f"{label} {number}", inner)


def _words(value: dict[str, Any]) -> list[str]:
    """Return the words of an object; counts are none."""
    return [part for part in value.values() if isinstance(part, str) and not part.isdigit()]
