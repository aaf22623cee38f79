"""The theorem ``horseshoe``: its search in floats, what is proved, and where it is refused."""

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.areas.parallelograms.planar import half_period as compiled_half_period
from cap.checker.coverings.half_period import HalfPeriod
from cap.errors import BadInput, NotProved
from cap.floats.coverings import search
from cap.floats.coverings.family import Family
from cap.floats.coverings.planar import formulas, half_period, images
from cap.floats.coverings.saddles import saddles
from cap.floats.coverings.sizes import Sizes
from cap.maps.fixed_point import Start
from cap.maps.graphs import components, fastest
from cap.parameters import PAPER
from cap.proofs import horseshoe
from cap.proofs.coverings import Asked, diamonds, entropy, lemma_2_no_diamond, proved
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted
from cap.runner import Runner
from cap.system.files import planar

STANDARD = planar(Path(__file__).parents[2] / "examples/maps/standard.py")
PHI_A = Fraction(2, 5), Fraction(1)
SETTING = Setting(PAPER, Start(0.0, 0.0, ()), 6)


@pytest.mark.slow
def test_it_is_proved(monkeypatch):
    """With short words; the checker accepts it.  The regions of a saddle are found once."""
    known, regions = {}, search.regions

    def once(g, saddle):
        key = saddle.point.tobytes()
        if key not in known:
            known[key] = regions(g, saddle)
        return known[key]

    monkeypatch.setattr(search, "regions", once)
    for which, effort in (("any", 3), ("disjoint", 4), ("hyperbolic", 4)):
        options = {"effort": effort, "sets": which}
        claims = accepted(THEOREMS["horseshoe"], replace(SETTING, options=options))["claims"]
        assert Fraction(claims["entropy"]) > Fraction(1, 5)
        assert which == "any" or claims["together"] == "1"
        assert which != "hyperbolic" or float(claims["cones"]["stretch"]) > 1


@pytest.mark.parametrize("changed", [{"e": Fraction(9, 10)}, {"mu": Fraction(1, 10)}, {"f": 0}])
def test_what_it_is_not_about(changed):
    """Losses, and no friction."""
    with pytest.raises(BadInput, match="needs f > 0"):
        horseshoe.prove(replace(SETTING, parameters=replace(PAPER, **changed)))


def test_without_a_saddle(monkeypatch):
    """It is said that nothing is proved."""
    monkeypatch.setattr(horseshoe.candidates, "families", lambda *_: iter(()))
    with pytest.raises(NotProved, match="no saddle"):
        horseshoe.prove(SETTING)
    none = Family(np.zeros((0, 6)), *np.zeros((2, 0), dtype=np.int64), 0.0)
    monkeypatch.setattr(horseshoe.candidates, "families", lambda *_: iter([none]))
    with pytest.raises(NotProved, match="two loops"):
        horseshoe.prove(SETTING)


def test_the_saddles():
    """Both symmetric saddles of the paper's parameters, whose maps preserve area."""
    found = saddles(half_period(0.4, 1.0))
    assert [round(s.large + s.small, 4) for s in found] == [-2.3185, 36.5793]
    for s in found:
        assert np.allclose(images(half_period(0.4, 1.0), s.point[None])[0, :2], s.point)
        assert abs(s.large * s.small - 1) < 1e-9


def test_a_hit_time_that_is_met_exactly():
    """Newton's method may end at an end of its bracket: images are smooth to rounding."""
    z = np.stack([np.linspace(0.34, 0.35, 2001), np.full(2001, 0.77)], axis=1)
    bends = np.diff(images(half_period(0.4, 1.0), z)[:, 0], 2)
    assert np.abs(bends).max() < 1e-8


@pytest.mark.slow
def test_sizes_grow_only_for_coverings_that_hold():
    """One that asks for too much is given up, and leaves no trace; one that holds is kept."""
    axes = np.array([1, 3**0.5 - 1, 1, -1 - 3**0.5])  # of the saddle 0 of the standard map, K = 2
    frames = np.array([[x, 0.0, *axes] for x in (0.0, 3.0)])
    sizes = Sizes(formulas(STANDARD), frames, np.array([[-0.1, 0.1], [-0.1, 0.1]]), 4.0)
    source, target = arrays([(0, 0), (0, 1)])
    before = sizes.U.copy(), sizes.W.copy()
    assert list(sizes.grown(source, target, np.array([1]))) == [False, False]
    assert all(map(np.array_equal, before, (sizes.U, sizes.W)))
    assert list(sizes.grown(source, target, np.array([1, 0]))) == [True, False]
    scores = sizes.scores(source, target)
    assert scores[0] < 0 < scores[1]


def arrays(edges):
    """Return sources and targets."""
    return np.array(edges, dtype=np.int64).T.copy()


def test_the_part_that_grows_fastest():
    """The golden mean beats a loop; what leads nowhere is not in it."""
    edges = [(0, 0), (0, 1), (1, 0), (1, 2), (2, 3), (3, 2)]
    part = fastest(*arrays(edges), 4)
    assert abs(part.growth - (1 + 5**0.5) / 2) < 1e-9
    assert list(part.inside(*arrays(edges))) == [True, True, True, False, False, False]
    assert sorted(map(len, components(*arrays(edges), 4))) == [2, 2]
    assert fastest(*arrays([(0, 1)]), 2).growth == 0


SQUARES = [[Fraction(n) for n in (x, 0, 1, 0, 0, 1)] for x in (0, 1, 10, 20)]
BOTH = [(2, 0), (2, 1), (0, 3), (1, 3), (3, 2), (3, 3)]  # 0 and 1 overlap: a diamond from 2 to 3


def test_diamonds_are_cut():
    """One covering of the diamond is given up; or one of the two sets that overlap."""
    overlapping = [{1}, {0}, set(), set()]
    assert set(next(diamonds(BOTH, overlapping))) == {(2, 0), (2, 1), (0, 3), (1, 3)}
    for disjoint in (False, True):
        part, kept = lemma_2_no_diamond(SQUARES, BOTH, disjoint=disjoint)
        assert list(diamonds(kept, overlapping)) == []
        assert len({0, 1} & {i for i, _ in kept}) == 1
        assert 1 < part.growth < 2


@pytest.mark.parametrize("compiled", [None, compiled_half_period(*PHI_A)])
def test_coverings_that_do_not_hold_are_left_out(compiled):
    """Of sets that cover nothing, nothing is proved."""
    sets = np.array([[0.3, 0.7, 0.01, 0, 0, 0.01], [0.35, 0.8, 0.01, 0, 0, 0.01]])
    family = Family(sets, *arrays([(0, 0), (0, 1), (1, 0), (1, 1)]), 2.0)
    with pytest.raises(NotProved, match="two loops"):
        proved(Asked(HalfPeriod(*PHI_A), compiled), family, Runner(), "any")


def test_entropy_is_rounded_down():
    """Of the square of sqrt 2, a little less than log 2."""
    assert entropy(Fraction(141421356, 10**8), 2) == Fraction("0.69314717")
    assert entropy(Fraction(2), 1) == Fraction("0.69314718")
