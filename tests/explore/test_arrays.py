"""Records as named arrays in .npz files, and back."""

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import pytest

from cap.errors import BadInput
from cap.explore.arrays import arrays, load
from cap.parameters import PAPER


class Pair(NamedTuple):
    """Two numbers."""

    first: float
    second: float


@dataclass(frozen=True)
class Orbit:
    """A row of a table."""

    kind: str
    x: float
    f: Fraction


@dataclass(frozen=True)
class Curve:
    """A record with an array, whose length differs from one to the next."""

    points: Any
    note: str | None = None


@dataclass(frozen=True)
class Everything:
    """A field of each kind."""

    parameters: Any = PAPER
    numbers: Any = (1.5, 2.5)
    exact: Any = Fraction(2, 5)
    rationals: Any = (Fraction(1, 3), Fraction(7))
    matrix: Any = None
    nothing: Any = None
    yes: bool = True
    pair: Any = None
    table: Any = (Orbit("sink", 0.5, Fraction(1, 2)), Orbit("saddle", -0.5, Fraction(3)))
    curves: Any = (Curve(np.zeros((2, 2))), Curve(np.ones((3, 2)), "last"))
    by_name: Any = None
    empty: Any = ()


EVERYTHING = Everything(matrix=np.eye(2), pair=Pair(3.0, 4.0), by_name={"a": 1, "b": "two"})


@pytest.fixture
def read(tmp_path):
    """Return a function that writes a record and reads it."""

    def written(record):
        np.savez_compressed(tmp_path / "a.npz", **arrays(record))
        return load(tmp_path / "a.npz")

    return written


def test_names():
    """They are paths; a table is one array for each of its fields."""
    found = arrays(EVERYTHING)
    assert list(found["table.kind"]) == ["sink", "saddle"]
    assert list(found["table.f"]) == ["1/2", "3"]
    assert str(found["exact"]) == str(found["parameters.f"]) == "2/5"
    assert list(found["rationals"]) == ["1/3", "7"]
    assert found["curves.1.points"].shape == (3, 2)
    assert found["numbers"].shape == (2,)
    assert float(found["pair.second"]) == 4
    assert "nothing" not in found
    assert all(array.dtype != object for array in found.values())


def test_what_is_written_is_read(read):
    """Parameters exactly, numbers and texts as they are, lists in their order."""
    found = read(EVERYTHING)
    assert found["parameters"] == PAPER
    assert found["exact"] == "2/5"
    assert found["yes"] is True
    assert found["pair"] == {"first": 3.0, "second": 4.0}
    assert found["by_name"] == {"a": 1, "b": "two"}
    assert list(found["table"]["x"]) == [0.5, -0.5]
    assert [len(curve["points"]) for curve in found["curves"]] == [2, 3]
    assert found["curves"][1]["note"] == "last"
    assert found["empty"].shape == (0,)
    assert np.array_equal(found["matrix"], np.eye(2))


def test_lists_of_more_than_ten(read):
    """They come back in the order of numbers, not of texts."""
    curves = tuple(Curve(np.full(1 + k % 3, k)) for k in range(12))
    assert [int(c["points"][0]) for c in read({"curves": curves})["curves"]] == list(range(12))


def test_nested_parameters(read):
    """Those of each part are read, too."""
    other = replace(PAPER, e=Fraction(9, 10))
    found = read({"parts": ({"parameters": PAPER}, {"parameters": other})})
    assert [part["parameters"] for part in found["parts"]] == [PAPER, other]


@pytest.mark.parametrize("value", [{1, 2}, len, [object()], np.array([None])], ids=range(4))
def test_what_no_array_can_hold(value):
    """It is an error, never left out."""
    with pytest.raises(TypeError, match="name cannot be written"):
        arrays({"name": value} if not isinstance(value, list) else {"name": value[0]})


def test_files_that_are_no_archive(tmp_path):
    """Text, an archive cut short, one array, a directory, nothing: one line that says so."""
    np.savez(tmp_path / "whole.npz", a=np.arange(100))
    whole = (tmp_path / "whole.npz").read_bytes()
    (tmp_path / "cut.npz").write_bytes(whole[:-30])
    (tmp_path / "text.npz").write_text("a,b\n")
    (tmp_path / "empty.npz").write_text("")
    np.save(tmp_path / "one.npy", np.arange(3))
    names = ["cut.npz", "text.npz", "empty.npz", "one.npy", "missing.npz", "."]
    for name in names:
        with pytest.raises(BadInput, match="cannot read"):
            load(tmp_path / name)
