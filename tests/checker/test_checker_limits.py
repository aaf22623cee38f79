"""What bounds the checker's time: what exceeds it is refused before anything is computed."""

import json
import time
from pathlib import Path

import pytest

from cap.checker.flow.events import limit_events
from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import columns, matched
from cap.checker.theorems import branch, load
from checker.altered import changed, encode, rejected

STORED = Path(__file__).parents[2] / "certificates"
POINT = {"radius": "1", "centre": ["0"] * 2, "preconditioner": [["0"] * 2] * 2}
WINDOW = ["1", "2"]


def stored(name):
    """Return a stored certificate."""
    return json.loads((STORED / f"{name}.json").read_text("utf-8"))


def read_parameters(value):
    """Read the parameters of a capture."""
    theorem = load("capture")
    return theorem.parameters(matched(value, theorem.PARAMETERS, "parameters"))


def hinted(theorem, bits, events, order=None, cells=None):
    """Read hints with so many bits, events and cells; return the bits."""
    name = "hit_times" if theorem in ("saddle", "elliptic") else "events"
    hints = {"bits": str(bits), name: [WINDOW] * events}
    if theorem != "capture":
        hints |= POINT
    if order:
        hints["order"] = str(order)
    if cells:
        cell = {key: POINT[key] for key in ("centre", "preconditioner")}
        hints["cells"] = [cell | {"events": hints["events"]}] * cells
    read_hints = matched(hints, columns(load(theorem).HINTS), "hints")
    limit = load(theorem).limit if theorem in ("saddle", "elliptic") else limit_events
    limit(read_hints, dict.fromkeys(("itinerary", "event_times"), [None] * events))
    return read_hints["bits"]


LARGEST = [  # events (bits (order + 1)^2 + 1024 cells) is at most 786432, or just that
    ("saddle", 491, 64, None, None),
    ("saddle", 4096, 7, None, None),
    ("periodic", 2621, 12, None, None),
    ("capture", 4096, 7, None, None),
    ("elliptic", 4096, 7, 3, None),
    ("elliptic", 3932, 2, 9, None),
    ("elliptic", 122, 64, 9, None),
    ("elliptic", 2048, 6, 7, None),
    ("persistence", 737, 2, None, 366),
    ("persistence", 122, 64, None, 9),
]


@pytest.mark.parametrize(("theorem", "bits", "events", "order", "cells"), LARGEST)
def test_the_work_is_bounded(theorem, bits, events, order, cells):
    """With the bits given it is read; with one bit, event or cell more it is refused."""
    assert hinted(theorem, bits, events, order, cells) == bits
    with pytest.raises(Rejected, match=r"too much|between 64 and 4096"):
        hinted(theorem, bits + 1, events, order, cells)
    with pytest.raises(Rejected, match=r"too much|list of 1 to 64"):
        hinted(theorem, bits, events + 1, order, cells)
    if cells:
        with pytest.raises(Rejected, match="too much"):
            hinted(theorem, bits, events, order, cells + 1)


def test_bits_are_bounded_where_nothing_else_counts():
    """Of the closed forms as of the others."""
    for name in ("symmetric", "pitchfork", "branch"):
        rejected(changed(stored(name), "hints", "bits", "4097"), "between 64 and 4096")


@pytest.mark.parametrize("zeros", [1, 64])
def test_cells_of_a_branch_are_bounded(zeros):
    """The square of the bits, times cells and zeros of the twist."""
    certificate = stored("branch")
    for part in ("claims", "hints"):
        several = certificate[part]["twist_zeros"] * zeros
        certificate = changed(certificate, part, "twist_zeros", several)
    pieces = len(certificate["claims"]["cells"]) + zeros
    most = int((branch.MAX_WORK / pieces) ** 0.5)
    assert read(encode(changed(certificate, "hints", "bits", str(most)))).hints["bits"] == most
    rejected(changed(certificate, "hints", "bits", str(most + 1)), "too much")
    cells = certificate["claims"]["cells"]
    many = changed(certificate, "claims", "cells", cells[:1] * 513)
    rejected(many, "list of 1 to 512")


SIZES = [("F", "1"), ("omega", "1"), ("l", "-1"), ("r", "1"), ("mu", "1")]


@pytest.mark.parametrize(("name", "sign"), SIZES)
def test_parameters_are_not_too_large(name, sign):
    """They would have more bits than the precision: 10^30 is read, more is not."""
    parameters = stored("capture")["parameters"] | {"f": "0"}
    most = ("-" if sign == "-1" else "") + "1" + "0" * 30
    read_parameters(parameters | {name: most})
    with pytest.raises(Rejected, match="in size"):
        read_parameters(parameters | {name: most + ".1"})


@pytest.mark.parametrize("name", ["F", "omega", "r"])
def test_parameters_are_not_too_small(name):
    """Their inverses would be as large: F, omega and R = r = 10^-30 are read, less is not."""
    parameters = stored("capture")["parameters"] | {"f": "0", "l": "0"}
    read_parameters(parameters | {name: "0." + "0" * 29 + "1"})
    with pytest.raises(Rejected, match="in size"):
        read_parameters(parameters | {name: "0." + "0" * 30 + "9"})


@pytest.mark.slow
def test_the_worst_takes_well_under_a_minute():
    """As many bits as are read for pairs on 111 cells: of the worst known, the longest proof.

    Its time is that of the cells: of every tenth it is a tenth.
    """
    certificate = stored("branch-2")
    pieces = len(certificate["claims"]["cells"]) + len(certificate["hints"]["twist_zeros"])
    bits = int((branch.MAX_WORK / pieces) ** 0.5)
    worst = read(encode(changed(certificate, "hints", "bits", str(bits))))
    proof = branch.Branch(worst, lambda _: None)
    cells = [*enumerate(worst.claims["cells"])][::10]
    began = time.process_time()
    for n, cell in cells:
        proof.cell(n, cell)
    assert time.process_time() - began < 60 * len(cells) / pieces


def test_orbits_of_integrals_are_limited_as_others():
    """By their events, bits and order."""
    hints = {"hit_times": [WINDOW] * 1000, "bits": 4096, "order": "24", "integral": []}
    with pytest.raises(Rejected, match="are too much"):
        load("effective_stability").limit(hints, {})
