"""Enclosures in rows, with labels in words, aligned at their decimal points."""

from collections.abc import Iterator
from typing import Any

from cap.certificate.writer import NONE


def rows(names: dict[str, str], claims: dict[str, Any]) -> list[tuple[str, list[str]]]:
    """Return labels and pairs of those of the claims that there are."""
    present = ((key, name) for key, name in names.items() if claims.get(key, NONE) != NONE)
    return [row for key, name in present for row in labelled(key, name, claims)]


def aligned(rows: list[tuple[str, list[str]]]) -> Iterator[str]:
    """Give a line for each label and enclosure, aligned at the decimal points."""
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


def labelled(key: str, name: str, claims: dict[str, Any]) -> Iterator[tuple[str, list[str]]]:
    """Give (label, pair) for each enclosure in the claim of a name; events by their words."""
    if key == "event_times" and key in claims:
        yield from zip(claims["itinerary"], claims[key], strict=True)
    else:
        yield from _flatten(name, claims.get(key, []))


def _flatten(label: str, value: Any) -> Iterator[tuple[str, list[str]]]:
    """Give (label, pair) for each enclosure in a claim."""
    if isinstance(value, dict):
        for key, pair in value.items():
            yield f"{label} {key}", pair
    elif value and isinstance(value[0], str):
        yield label, value
    else:
        for number, inner in enumerate(value, start=1):
            named = (
                f"tau_{number + 1} per |z|^{2 * number + 2}"
                if label == "tau"
                else f"{label} {number}"
            )
            yield from _flatten(named, inner)
