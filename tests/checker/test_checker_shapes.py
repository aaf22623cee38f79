"""Shapes of values and of claims: each that does not match is refused for its reason."""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest

from cap.areas.listing import written
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import MAX_CHARACTERS, number
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Many, Whole, enclosure, matched
from cap.checker.kernel.theorem import Theorem
from cap.checker.strips.columns import columns


@pytest.mark.parametrize(
    ("value", "shape", "why"),
    [
        (["1"], [number, number], "x is not a list of 2"),
        (["1", "2", "3"], [number, number], "x is not a list of 2"),
        ({"0": "1", "1": "2"}, [number, number], "x is not a list of 2"),
        ("12", [number, number], "x is not a list of 2"),
        ([["1"]], [enclosure], r"x\[0\] is not a list of 2"),
        ("01", Whole(0, 9), "x is not between 0 and 9, as a plain integer"),
        ("1000000", Whole(0, 10**9), "x is not between 0 and 1000000000, as a plain integer"),
        ("5", Whole(6, 8), "x is not between 6 and 8, as a plain integer"),
        ("9", Whole(6, 8), "x is not between 6 and 8, as a plain integer"),
        ([], Many(number, 1, 2), "x is not a list of 1 to 2"),
        (["1"] * 3, Many(number, 1, 2), "x is not a list of 1 to 2"),
        ({"0": "1"}, Many(number, 1, 2), "x is not a list of 1 to 2"),
    ],
)
def test_what_does_not_match(value, shape, why):
    """Lengths, kinds and sizes."""
    with pytest.raises(Rejected, match=f"^{why}$"):
        matched(value, shape, "x")


def test_what_matches():
    """The same shapes, at their borders."""
    assert matched(["1", "2"], [number, number], "x") == [1, 2]
    assert [Whole(6, 8)(text, "x") for text in ("6", "8")] == [6, 8]
    assert Whole(0, 10**9)("999999", "x") == 999999
    assert [len(Many(number, 1, 2)(["1"] * n, "x")) for n in (1, 2)] == [1, 2]


def test_a_number_that_is_too_long():
    """It is not read."""
    assert number("1" * MAX_CHARACTERS, "x") > 0
    with pytest.raises(Rejected, match=f"x is longer than {MAX_CHARACTERS} characters"):
        number("1" * (MAX_CHARACTERS + 1), "x")


def claimed(low, high):
    """Return an enclosure of any width."""
    return enclosure([str(low), str(high)], "x")


def computed(low, high):
    """Return an interval."""
    return Interval.enclosing(low, high, 20)


def test_claims_are_compared_with_all_that_is_computed():
    """Lists of other lengths, objects with other fields, one part that is not contained."""
    theorem = SimpleNamespace(narrow=lambda *_: None)
    theorem.compare = lambda *given: Theorem.compare(theorem, *given)
    good, value, bad = claimed(0, 2), computed(1, 2), claimed(0, 1)
    theorem.compare("x", [good, {"y": good}], [value, {"y": value}])
    for claim, found, why in (
        ([good], [value, value], "x is not a list of 2"),
        ([good, good], [value], "x is not a list of 1"),
        ([], [value], "x is not a list of 1"),
        ([good, [good, bad]], [value, [value, value]], r"x\[1\]\[1\] does not contain"),
        ({"y": good, "z": good}, {"y": value}, "x has missing or unknown fields"),
        ({"y": good}, {"y": value, "z": value}, "x has missing or unknown fields"),
        ({"y": good, "z": bad}, {"y": value, "z": value}, "x.z does not contain"),
    ):
        with pytest.raises(Rejected, match=f"^{why}"):
            theorem.compare("x", claim, found)


@pytest.mark.parametrize("ends", [(-1, 1), (0, 1), (-1, 0), (0, 0)])
def test_division_by_what_may_vanish(ends):
    """Zero inside, and at an end."""
    with pytest.raises(Rejected, match="division by an interval that contains zero"):
        assert computed(1, 1) / computed(*ends)
    middle, radius = (float(sum(ends)) / 2, (ends[1] - ends[0]) / 2)
    with pytest.raises(Rejected, match="division by an interval that may contain zero"):
        assert Double(1.0) / Double(middle, radius)
    assert (computed(1, 1) / computed(ends[1] + 1, ends[1] + 2)).lower > Fraction(1, 4)


def test_edges_that_are_missing():
    """A text that ends before its edges do."""
    with pytest.raises(Rejected, match="edges are missing"):
        columns(written([1, 10, 5, 1, 2, 0, 0, 0]))
