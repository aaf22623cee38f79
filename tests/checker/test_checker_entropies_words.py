"""The line of ``entropies``: the bounds it gives are those of its pieces."""

from __future__ import annotations

import copy
import json
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.verdict import words
from checker.altered import encode

STORED = Path(__file__).parents[2] / "certificates/entropies-1.json"


@pytest.mark.parametrize(
    ("bounds", "least", "most"),
    [
        (["0.4", "0.5"], "0.4", "0.5"),
        (["0.1", "0.6"], "0.1", "0.6"),
        (["0", "0.6"], "0.4", "0.6"),
        (["0.45", "0.47"], "0.4", "0.5"),
    ],
)
def test_the_least_and_the_largest_entropy(bounds, least, most):
    """Of those that are positive the least lower end; of all the largest upper end."""
    certificate = copy.deepcopy(json.loads(STORED.read_text("utf-8")))
    pieces = [piece for strip in certificate["claims"]["strips"] for piece in strip["pieces"]]
    for piece in pieces:
        piece["entropy"] = ["0.4", "0.5"]
    pieces[len(pieces) // 2]["entropy"] = bounds
    line = words(read(encode(certificate)))
    assert f"it is positive, at least {least}, on the share" in line
    assert f"nowhere in these pieces above {most};" in line
    assert line.count(f"entropy in [{bounds[0]}, {bounds[1]}]") == (
        1 if bounds[0] != "0.4" else len(pieces)
    )
