"""The form of the certificates on no one orbit; what does not exist is the string "none"."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from cap.checker.flow.itinerary import WORDS
from cap.checker.kernel.reading import (
    bounded,
    enclosure,
    exactly,
    length,
    matched,
    number,
    one_of,
    part,
    text,
    within,
)
from cap.checker.kernel.rejection import need

THEOREMS = ("symmetric", "pitchfork", "branch", "segment", "attractor")
WITH_LOSSES = ("segment", "attractor")
FOR_ALL_F = ("pitchfork", "branch")
MAX_CELLS = 512
MAX_BITS = 4096
MAX_WORK = 1 << 27  # bits^2 times cells and zeros of the twist
MAX_RESONANCES = 16
MAX_ZEROS = 64
MAX_RELEASE_CELLS = 512
MAX_SYMBOLS = 8192
MAX_RELEASE_EVENTS = 32
MAX_RELEASE_WORK = 3 << 20  # events times (bits times symbols, and bits of cells times 25 cells)

_STATE = {
    "x": enclosure,
    "v": enclosure,
    "hit_times": [enclosure] * 2,
    "hit_speed": enclosure,
    "least_speed": enclosure,
}
_SEGMENT = dict.fromkeys(("left", "right", "v", "stroke", "basin_area"), enclosure) | {
    "turning_times": [enclosure] * 2,
    "multipliers": [enclosure] * 2,
    "basin": {"speed": number, "drift": [number] * 2},
}


def or_none(shape: Any) -> Callable[[Any, str], Any]:
    """Return a reader of values of this shape, and of "none" as None."""
    return lambda value, where: None if value == "none" else matched(value, shape, where)


def hints(theorem: str, value: object) -> dict[str, Any]:
    """Return the hints of one of these theorems."""
    shape: dict[str, Any] = {"bits": text}
    if theorem == "branch":
        shape["end"] = or_none([number] * 2)
        for name, most in (("resonances", MAX_RESONANCES), ("twist_zeros", MAX_ZEROS)):
            count = length(part(value, name, "hints"), 0, most, f"hints.{name}")
            shape[name] = [enclosure] * count
    if theorem == "attractor":
        shape |= attractor_hints(value)
    result: dict[str, Any] = matched(value, shape, "hints")
    if theorem == "attractor":
        result["cell_bits"] = bounded(result["cell_bits"], 64, MAX_BITS, "cell_bits")
    result["bits"] = bounded(result["bits"], 64, MAX_BITS, "bits")
    return result


def claims(theorem: str, value: object, hints: dict[str, Any]) -> dict[str, Any]:
    """Return the shape of the claims of one of these theorems."""
    if theorem == "symmetric":
        return symmetric_shape(value)
    if theorem == "segment":
        return _SEGMENT
    if theorem == "attractor":
        return attractor_shape(value, hints)
    if theorem == "pitchfork":
        slopes = ("half_trace_slope", "cubic", "linear_slope", "curvature", "trace_curvature")
        return {"f": enclosure} | _STATE | dict.fromkeys(slopes, enclosure)
    return branch_shape(value, hints)


def symmetric_shape(value: object) -> dict[str, Any]:
    """Return the shape of the claims about symmetric orbits."""
    roots = length(part(value, "paper_roots", "claims"), 0, 2, "claims.paper_roots")
    return {
        "branches": dict.fromkeys(("plus", "minus"), or_none(symmetric_orbit)),
        "saddle_center": enclosure,
        "pitchfork": or_none(enclosure),
        "minus_identity": or_none(enclosure),
        "paper_roots": [{"theta": enclosure, "velocity": enclosure}] * roots,
    }


def symmetric_orbit(value: Any, where: str) -> Any:
    """Return the claims about a symmetric orbit, or about a formula that is not one."""
    if part(value, "genuine", where) == "no":
        shape = {"genuine": exactly("no"), "hit_speed": enclosure, "least_speed": enclosure}
        return matched(value, shape, where)
    kind = {"genuine": exactly("yes"), "type": one_of(("elliptic", "saddle"))}
    return matched(value, _STATE | kind | {"half_trace": enclosure, "trace": enclosure}, where)


def branch_shape(value: object, hints: dict[str, Any]) -> dict[str, Any]:
    """Return the shape of the claims about a branch."""
    cells = length(part(value, "cells", "claims"), 1, MAX_CELLS, "claims.cells")
    work = hints["bits"] ** 2 * (cells + len(hints["twist_zeros"]))
    need(work <= MAX_WORK, f"bits and cells are too much: {work} > {MAX_WORK}")
    most = cells + MAX_RESONANCES
    exceptions = length(part(value, "exceptions", "claims"), 0, most, "claims.exceptions")
    end = enclosure if hints["end"] is not None else or_none(exactly("none"))
    cell = dict.fromkeys(("delta", "f", "trace", "least_speed"), enclosure)
    values = {"twist": or_none(one_of(("+", "-"))), "regular_twist": or_none(enclosure)}
    return {
        "f_start": enclosure,
        "f_end": end,
        "trace_end": end,
        "f_range": enclosure,
        "resonances": [{"ratio": text, "f": enclosure}] * len(hints["resonances"]),
        "twist_zeros": [enclosure] * len(hints["twist_zeros"]),
        "exceptions": [enclosure] * exceptions,
        "cells": [cell | values] * cells,
    }


def attractor_hints(value: object) -> dict[str, Any]:
    """Return the shape of the hints of an attractor, beside the precision."""
    windows = part(value, "basin_events", "hints")
    events = length(windows, 2, MAX_RELEASE_EVENTS, "hints.basin_events")
    cells = length(part(value, "cells", "hints"), 1, MAX_RELEASE_CELLS, "hints.cells")
    return {
        "cell_bits": text,
        "critical": enclosure,
        "cells": [{"to": number, "events": [enclosure] * events}] * cells,
        "basin_events": [enclosure] * events,
    }


def attractor_shape(value: object, hints: dict[str, Any]) -> dict[str, Any]:
    """Return the shape of the claims of an attractor."""
    events, symbols = (
        len(hints["basin_events"]),
        text(part(value, "kneading", "claims"), "kneading"),
    )
    steps = hints["bits"] * len(symbols) + 25 * hints["cell_bits"] * len(hints["cells"])
    work = events * steps
    need(work <= MAX_RELEASE_WORK, f"bits, symbols and cells are too much: {work}")
    names = ("interval", "critical_point", "critical_value", "entropy", "entropy_per_period")
    return dict.fromkeys(names, enclosure) | {
        "itinerary": [one_of(WORDS)] * events,
        "half_periods": within(1, 32),
        "turn": one_of(("minimum", "maximum")),
        "kneading": branches,
        "basin": {"x": enclosure, "v": enclosure},
    }


def branches(value: Any, where: str) -> str:
    """Return a sequence of the letters R and L."""
    letters = text(value, where)
    fits = re.fullmatch("[RL]+", letters) is not None and len(letters) <= MAX_SYMBOLS
    need(fits, f"{where} is not a sequence of at most {MAX_SYMBOLS} letters R and L")
    return letters
