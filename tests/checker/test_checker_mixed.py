"""The theorem ``mixed``: what is true is verified, every lie is noticed."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cap.areas.listing import written
from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.mixed import Mixed
from cap.checker.verdict import check, words
from checker.altered import changed, encode, rejected
from checker.mixed_small import certificate, counted, even, here, parted, small

pytestmark = pytest.mark.usefixtures("releases_computed_once")

LATE, EARLY, TURNS = (("hints", "stops", name) for name in ("late", "early", "turns"))


@pytest.fixture(scope="module")
def true():
    """Return a small certificate."""
    return certificate()


def test_it_is_verified(true):
    """With its lemmas, in two processes; and it says what was shown."""
    steps = []
    told = words(check(encode(true), steps.append, jobs=2))
    assert any("entropy" in step or "tent maps" in step for step in steps)
    assert steps[-1] == "the shares follow from the areas"
    part = true["claims"]["shares"]
    assert f"at least the part {part['attractor'][0]} is attracted" in told
    assert f"of the part {part['undecided'][1]} at most nothing is shown" in told


def shift(pair, by):
    """Return a pair with its lower end moved."""
    return [f"{float(pair[0]) + by:.6f}", pair[1]]


PARTS = {}  # by the trees, computed once


def sums(lie):
    """Check the sums of a certificate, without its lemmas."""
    places = small()[1]
    theorem = Mixed(read(encode(lie)), lambda _step: None)
    theorem.box()
    trees = str(theorem.hints["stops"])
    if trees not in PARTS:
        PARTS[trees] = counted(theorem, places)
    theorem.sums(PARTS[trees])


def test_shares_enlarged(true):
    """Each share, and the area, a little too good."""
    sums(true)
    claims = true["claims"]["shares"]
    for name in ("attractor", "segment", "either", "stops"):
        lie = changed(true, "claims", "shares", name, shift(claims[name], 1e-4))
        with pytest.raises(Rejected, match=f"shares.{name} does not contain"):
            sums(lie)
    upper = float(claims["undecided"][1])
    lie = changed(true, "claims", "shares", "undecided", ["0", f"{upper - 1e-4:.6f}"])
    with pytest.raises(Rejected, match="undecided does not contain"):
        sums(lie)
    area = float(true["claims"]["never_stopping_area"][1])
    lie = changed(true, "claims", "never_stopping_area", ["0", f"{area - 1e-3:.6f}"])
    with pytest.raises(Rejected, match="never_stopping_area does not contain"):
        sums(lie)


@pytest.mark.slow
def test_regions_dropped(true):
    """Trees of nothing, flights that are not followed, parts that are not."""
    for at, tree in (
        (LATE, written([0])),
        (EARLY, written([0])),
        (TURNS, written([0])),
        (LATE, even(3, 3, 1)),
        (TURNS, parted(3, 3, 1, (2, 2))),
        (TURNS, parted(3, 3, 20, (0, 0))),
        (TURNS, parted(2, 3, 20, (0, 0))),
    ):
        with pytest.raises(Rejected, match="does not contain"):
            sums(changed(true, *at, tree))


@pytest.mark.parametrize(
    ("tree", "complaint"),
    [
        ("", "base 85|too long"),
        (written([]), "no kind"),
        (written([1]), "no kind"),
        (written([0, 0]), "goes on"),
        (written([-1]), "no kind"),
        (written([67]), "no kind"),
        (written([2]), "too far|below"),
        (written([2, 2**41, 0, 0, 0, 0]), "not below"),
        (written([2, 0, 2**41, 0, 0, 0]), "not below"),
        (written([2, 0, 0, 2**46, 0, 0]), "too far"),
        (written([1] * 21 + [0] * 22), "halved too often"),
        (written([2, 0, 0, 0] * 61 + [0] * 62), "not below|too often"),
        ("A A", "base 85|too long"),
    ],
)
def test_what_is_no_tree(true, tree, complaint):
    """Ends early, goes on, cuts beyond an edge, too often, other letters."""
    with pytest.raises(Rejected, match=complaint):
        sums(changed(true, *LATE, tree))


@pytest.mark.parametrize(
    ("tree", "complaint"),
    [
        (written([12]), "no kind"),
        (written([12, 4]), "no kind"),
        (written([12, 1, 3]), "no kind"),
        (written([12, 3, 3]), "goes on"),
        (written([12, 2, 2**41, 0, 0, 3, 3]), "not below"),
        (written([12, *[1] * 21, *[0] * 22]), "halved too often"),
    ],
)
def test_what_is_no_tree_of_parts(true, tree, complaint):
    """None, of another kind, ends early, goes on, beyond an edge, too often."""
    with pytest.raises(Rejected, match=complaint):
        sums(changed(true, *TURNS, tree))


def test_other_boxes(true):
    """Past a wall, not to a wall, not symmetric."""
    for x in (["-1", "1.1"], ["-0.9", "1"]):
        rejected(changed(true, "claims", "box", "x", x), "wall to wall")
    for v in (["-3", "4"], ["3", "3"], ["3", "-3"]):
        rejected(changed(true, "claims", "box", "v", v), "box")


def test_other_lemmas(true):
    """An interval that G does not keep, other entropy, a larger basin of the segment."""
    at = "claims", "attractor"
    rejected(changed(true, *at, "interval", ["-0.7", "-0.5"]), "interval")
    entropy = ["0.443", "0.4430000000001"]
    rejected(changed(true, *at, "entropy", entropy), "entropy")
    basin = {"speed": "0.2", "drift": ["4.81839722", "0.211206897"]}
    rejected(changed(true, "claims", "segment", "basin", basin), "wall|fast|drift")


def test_shares_beyond_the_whole(true):
    """Whatever is counted: no part is more than all."""
    theorem = Mixed(read(encode(true)), lambda _step: None)
    with pytest.raises(Rejected, match="more than the whole"):
        theorem.sums((Fraction(0), *[Fraction(1019, 1000)] * 3))
    with pytest.raises(Rejected, match="more than the whole"):
        theorem.sums((Fraction(2, 3), Fraction(1, 2), Fraction(0), Fraction(0)))


@pytest.mark.slow
def test_places(true):
    """A tree that is none; with a node that cannot be followed, or one that counts and is not."""
    at = "hints", "places", "tree"
    tree = true["hints"]["places"]["tree"]
    rejected(changed(true, *at, tree[:-1]), "not whole")
    rejected(changed(true, *at, tree + "0"), "after its end")
    for wrong in "10":
        lie = Mixed(read(encode(changed(true, *at, wrong))), lambda _step: None)
        with pytest.raises(Rejected, match="does not contain"):
            lie.sums(counted(lie, lie.places(here)))


def tree_of(depth):
    """Return the tree with all nodes of a depth."""
    return "1" if not depth else "2" + 2 * tree_of(depth - 1)


def test_work_is_bounded(true):
    """Too many pieces are refused before anything is computed."""
    full = {"level": "12", "tree": tree_of(17)}
    rejected(changed(true, "hints", "places", full), "too many places")
    rejected(changed(true, *LATE, written([66] * 500000)), "too many flights")
    rejected(changed(true, *TURNS, written([12, 3] * 700000)), "too many flights")
