"""The form of a certificate: for each theorem its parameters, claims and hints, exactly.

How many events an orbit has, and of which kinds, and which order it is expanded to, follows from
the hints and the itinerary.

*Time.*  What is read here bounds the time that a proof may take: the precision, the number of
events and cells, the order, and the sizes of the parameters, as large numbers have more bits.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker import forms
from cap.checker.citations import CITES
from cap.checker.flow.itinerary import WORDS
from cap.checker.flow.mechanics import Parameters
from cap.checker.kernel.reading import (
    MAX_BYTES,
    anything,
    bounded,
    enclosure,
    exactly,
    length,
    matched,
    number,
    one_of,
    parsed,
    part,
    text,
    within,
)
from cap.checker.kernel.rejection import need

__all__ = ["MAX_BYTES", "Certificate", "read"]

MAX_EVENTS = 64
MAX_BITS = 4096
MAX_WORK = 3 << 18  # see ``work``
CELL_WORK = 1 << 10  # an event in a rectangle of persistence: 64 bits, four variables
MAX_CELLS = MAX_WORK // CELL_WORK
MAX_SIZE = 10**30  # of parameters, and of their inverses
MAX_PERIODS = 16
ORDERS = (3, 5, 7, 9)
WITHOUT_LOSSES = ("elliptic", "saddle")
SINKS = ("superstable", "sink focus", "sink node")
TYPES = (*SINKS, "elliptic", "saddle", "flip saddle")
_NAMES = Parameters._fields
_BOX = {"x": enclosure, "v": enclosure}


class Certificate(NamedTuple):
    """What a certificate says; ``claims`` and ``hints`` have the shapes below."""

    theorem: str
    parameters: Parameters
    digits: int
    claims: dict[str, Any]
    hints: dict[str, Any]


def read(data: bytes) -> Certificate:
    """Return the certificate in these bytes; anything that is not exactly of its form rejects."""
    fields = matched(parsed(data), _FIELDS, "certificate")
    need(fields["format"] == "cap-certificate/1", "the format is not cap-certificate/1")
    theorem = fields["theorem"]
    need(theorem in CITES, f"the theorem is none of: {', '.join(CITES)}")
    need(fields["cites"] == CITES[theorem], "cites is not the checker's own list")
    need(isinstance(fields["provenance"], dict), "provenance is not an object")
    p = read_parameters(theorem, fields["parameters"])
    hints = read_hints(theorem, fields["hints"])
    shape = claim_shape(theorem, fields["claims"], hints)
    claims = matched(fields["claims"], shape, "claims")
    return Certificate(theorem, p, bounded(fields["digits"], 6, 1000, "digits"), claims, hints)


def read_parameters(theorem: str, value: object) -> Parameters:
    """Return the parameters, of which e and mu belong to the theorems with losses.

    Two theorems are about all f: theirs is set to 0, and is not used.
    """
    names = _NAMES[:5] if theorem in (*WITHOUT_LOSSES, *forms.THEOREMS) else _NAMES
    shape = {name: number for name in names if name != "f" or theorem not in forms.FOR_ALL_F}
    p = Parameters(**{"f": Fraction(0)} | matched(value, shape, "parameters"))
    need(p.omega > 0, "omega is not positive")
    need(0 <= p.f < p.F, "0 <= f < F does not hold")
    need(theorem != "symmetric" or p.f > 0, "0 < f does not hold")
    need(p.l < p.r, "l < r does not hold")
    need(0 < p.e <= 1, "0 < e <= 1 does not hold")
    need(p.mu >= 0, "mu >= 0 does not hold")
    large = max(p.F, p.omega, abs(p.l), abs(p.r), p.mu) > MAX_SIZE
    small = min(p.F, p.omega, p.r - p.l) * MAX_SIZE < 1
    need(not (large or small), "the parameters are not between 10^-30 and 10^30 in size")
    return p


def read_hints(theorem: str, value: object) -> dict[str, Any]:
    """Return the hints: exact numbers, precision and order as integers."""
    if theorem in forms.THEOREMS:
        return forms.hints(theorem, value)
    if theorem == "impulse":
        hints: dict[str, Any] = matched(value, {"bits": text}, "hints")
        return {"bits": bounded(hints["bits"], 64, MAX_BITS, "bits")}
    name = "hit_times" if theorem in WITHOUT_LOSSES else "events"
    windows = [enclosure] * length(part(value, name, "hints"), 1, MAX_EVENTS, f"hints.{name}")
    inverse = {"centre": [number] * 2, "preconditioner": [[number] * 2] * 2}
    shape: dict[str, Any] = {"bits": text, name: windows}
    if theorem != "capture":
        shape |= {"radius": number} | inverse
    if theorem == "elliptic":
        shape["order"] = text
    if theorem == "persistence":
        cells = length(part(value, "cells", "hints"), 1, MAX_CELLS, "hints.cells")
        shape["cells"] = [{"events": windows} | inverse] * cells
    hints = matched(value, shape, "hints")
    hints["bits"] = bounded(hints["bits"], 64, MAX_BITS, "bits")
    if "order" in hints:
        hints["order"] = bounded(hints["order"], ORDERS[0], ORDERS[-1], "order")
        need(hints["order"] in ORDERS, "order is not odd")
    counts = len(windows), hints["bits"], hints.get("order", 0), len(hints.get("cells", ()))
    needed = work(*counts)
    need(needed <= MAX_WORK, f"bits, order, events and cells are too much: {needed} > {MAX_WORK}")
    need("radius" not in hints or hints["radius"] > 0, "radius is not positive")
    return hints


def work(events: int, bits: int, order: int = 0, cells: int = 0) -> int:
    """Return a measure of the time: 10 to 50 microseconds for each unit.  Jets have order >= 4."""
    return events * (bits * (max(order, 4) + 1) ** 2 + CELL_WORK * cells)


def claim_shape(theorem: str, value: object, hints: dict[str, Any]) -> dict[str, Any]:
    """Return the shape of the claims."""
    if theorem in forms.THEOREMS:
        return forms.claims(theorem, value, hints)
    if theorem == "impulse":
        return dict.fromkeys(("margin", "delay", "delay_per_speed", "gap"), enclosure)
    if theorem in WITHOUT_LOSSES:
        return conservative_shape(theorem, len(hints["hit_times"]), hints.get("order", 0))
    words, events = part(value, "itinerary", "claims"), len(hints["events"])
    shape: dict[str, Any] = {"itinerary": [one_of(WORDS)] * events, "box": _BOX}
    shape["event_times"] = [enclosure] * events
    if theorem == "capture":
        shape |= dict.fromkeys(("forcing", "accumulation_time", "release_time"), enclosure)
        return shape | {"wall": one_of(("r", "l")), "ratio": number}
    matched(words, shape["itinerary"], "claims.itinerary")
    shape |= dict.fromkeys(("x", "v", "trace", "determinant"), enclosure)
    shape |= {
        "period": within(1, MAX_PERIODS),
        "hit_speeds": [enclosure] * sum(w.startswith("hit") for w in words),
        "turning_factors": [enclosure] * sum(w.startswith("turn") for w in words),
        "jacobian": [[enclosure] * 2] * 2,
        "multipliers": [multiplier] * 2,
        "type": one_of(TYPES),
    }
    if part(value, "type", "claims") in SINKS:
        shape["basin"] = {"matrix": [[number] * 2] * 2, "contraction": number}
    if theorem == "persistence":
        shape["range"] = range_shape(part(value, "range", "claims"), len(hints["cells"]))
    return shape


def range_shape(value: object, cells: int) -> dict[str, Any]:
    """Return the shape of the range: the grid has as many rectangles as there are cells."""
    sides = [
        length(part(value, name, "claims.range"), 2, MAX_CELLS + 1, f"claims.range.{name}")
        for name in ("epsilon", "mu")
    ]
    need((sides[0] - 1) * (sides[1] - 1) == cells, "the grid has not as many rectangles as cells")
    return {"epsilon": [number] * sides[0], "mu": [number] * sides[1], "boxes": [_BOX] * cells}


def multiplier(value: Any, where: str) -> Any:
    """Return an enclosure of a real number, or those of the two parts of a complex number."""
    complex_shape = {"re": enclosure, "im": enclosure}
    return matched(value, complex_shape if isinstance(value, dict) else enclosure, where)


def conservative_shape(theorem: str, hits: int, order: int) -> dict[str, Any]:
    """Return the shape of the claims of the theorems without losses."""
    shape: dict[str, Any] = dict.fromkeys(
        ("x", "v", "least_speed", "trace", "determinant"), enclosure
    )
    shape |= {name: [enclosure] * hits for name in ("hit_times", "hit_speeds", "hit_forcing")}
    shape |= {"box": {"x": enclosure, "v": enclosure}, "jacobian": [[enclosure] * 2] * 2}
    if theorem == "saddle":
        return shape | {"multipliers": [enclosure] * 2}
    component = {f"{i},{n - i}": enclosure for n in range(2, order + 1) for i in range(n + 1)}
    shape |= dict.fromkeys(
        ("rotation_angle", "rotation_number", "twist", "twist_action"), enclosure
    )
    return shape | {
        "resonance_distances": dict.fromkeys(("0", "1/4", "1/3", "1/2"), enclosure),
        "taylor": {"x": component, "v": component},
        "higher_twists": [enclosure] * ((order - 3) // 2),
        "remainder": {"degree": exactly(str(order)), "radius": number, "x": number, "v": number},
    }


_FIELDS = dict.fromkeys(("format", "theorem", "digits"), text) | dict.fromkeys(
    ("parameters", "claims", "hints", "cites", "provenance"), anything
)
