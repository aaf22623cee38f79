"""The table of the release map: against floats, against balls, and what is left over."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from cap.boxes.motion import HIT_R
from cap.boxes.release import passages
from cap.boxes.results import MOVING, RELEASED, SETTLED, UNDECIDED
from cap.errors import BadInput, NotProved
from cap.floats.engine.releases import images
from cap.flow.event import BALLS
from cap.flow.strobe import oscillator
from cap.parameters import PAPER
from cap.release import remainder
from cap.release.border import borders
from cap.release.passage import foreseen, passage, windows, words
from cap.release.rows import Row, gaps_between, shortened, turned
from cap.release.table import Table, curve, table, unfolded
from cap.sets import interval

LOSSY = replace(PAPER, e=Fraction(4, 5))
VISCOUS = replace(PAPER, mu=Fraction(1, 10), f=Fraction(1, 3))
NARROW = replace(PAPER, l=Fraction(-1, 3), r=Fraction(1, 7), f=Fraction(7, 10))
SYSTEMS = [PAPER, LOSSY, VISCOUS, NARROW]


@pytest.fixture(scope="module")
def found() -> Table:
    """The table at the paper's parameters, by doubles alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(remainder, "MOST", 0)
        return table(PAPER, 3)


@pytest.mark.slow
def test_branches_and_gaps_make_up_the_interval(found):
    """They follow each other; lengths add up to R exactly; little is left."""
    spans = sorted([(b.lower, b.upper) for b in found.branches] + list(found.gaps))
    assert spans[0][0] == PAPER.l
    assert spans[-1][1] == PAPER.r
    assert all(a[1] == b[0] for a, b in pairwise(spans))
    assert found.undecided + sum(b.length for b in found.branches) == PAPER.R
    assert found.undecided < PAPER.R / 50_000
    assert len(found.branches) > 80
    assert found.moving < PAPER.R / 12


@pytest.mark.slow
def test_against_floats(found):
    """Of 10 000 random places: the next release lies in the enclosure, at the time told, and the
    events are those of the branch, as far as floats count them."""
    places = np.random.default_rng(1).uniform(-1, 1, 10_000)
    floats, seen = images(PAPER, places), 0
    for k, x in enumerate(places.tolist()):
        branch = found.at(Fraction(x))
        if branch is None:
            continue
        seen += 1
        n = int(floats.half_periods[k])
        if not branch.half_periods:
            assert n == 0 or n >= 6
            continue
        assert n == branch.half_periods
        low, high = branch.value
        assert low - 1e-9 <= floats.value[k] <= high + 1e-9
        (row,) = [row for row in branch.rows if row.lower <= x < row.upper][:1]
        assert row.value[0] - 1e-9 <= floats.value[k] <= row.value[1] + 1e-9
        if np.isfinite(row.slope[0]):
            near = 1e-6 * (1 + abs(floats.slope[k]))
            assert row.slope[0] - near <= floats.slope[k] <= row.slope[1] + near
    assert seen > 9990


@pytest.mark.parametrize("p", SYSTEMS, ids=["paper", "lossy", "viscous", "narrow"])
def test_itineraries_against_floats(p):
    """Of random places the floats have the events of the cell, in this order."""
    places = np.random.default_rng(2).uniform(float(p.l), float(p.r), 120)
    result, known = passages(p, np.column_stack([places, places]), 4), 0
    for k, x in enumerate(places.tolist()):
        if result.verdict[k] != RELEASED:
            continue
        events, place, slope = foreseen(p, x)
        told = result.words(k)
        assert shortened(told) == shortened(words(events))
        low, high = result.value[k]
        assert low - 1e-7 <= place <= high + 1e-7
        near = 1e-4 * (1 + abs(slope))
        assert result.slope[k, 0] - near <= slope <= result.slope[k, 1] + near
        known += 1
    assert known > 50


@pytest.mark.parametrize("p", SYSTEMS, ids=["paper", "lossy", "viscous", "narrow"])
def test_against_balls(p):
    """G and G' of balls at 120 bits lie in the enclosures of wider cells."""
    places = np.linspace(float(p.l), float(p.r), 33)[1:-1]
    result, known = passages(p, np.column_stack([places, places + 2e-4 * float(p.R)]), 4), 0
    with interval.workprec(120):
        osc = oscillator(p)
        for k, x in enumerate((places + 1e-4 * float(p.R)).tolist()):
            expected = foreseen(p, x)[0] if result.verdict[k] == RELEASED else ()
            if not expected:
                continue
            m = interval.Ball(x)
            proved = passage(osc, m, windows(osc, m, expected, BALLS), BALLS)
            assert proved.half_periods == result.half_periods[k]
            for value, ends in ((proved.value, result.value[k]), (proved.slope, result.slope[k])):
                lower, upper = interval.ends(value)
                assert Fraction(ends[0]) <= lower <= upper <= Fraction(ends[1])
            known += 1
    assert known > 8


@pytest.mark.slow
@pytest.mark.parametrize("p", SYSTEMS[1:], ids=["lossy", "viscous", "narrow"])
def test_other_systems(p, monkeypatch):
    """Branches and gaps make up [l, r]; floats agree; borders are proved."""
    monkeypatch.setattr(remainder, "MOST", 0)
    found = table(p, 2, Fraction(1, 10**5))
    assert found.undecided + sum(b.length for b in found.branches) == p.R
    assert found.undecided < p.R / 1000
    places = np.random.default_rng(3).uniform(float(p.l), float(p.r), 400)
    floats, seen = images(p, places), 0
    for k, x in enumerate(places.tolist()):
        branch = found.at(Fraction(x))
        if branch is None or not branch.half_periods:
            continue
        seen += 1
        assert floats.half_periods[k] == branch.half_periods
        low, high = branch.value
        assert low - 1e-9 <= floats.value[k] <= high + 1e-9
    assert seen > 100
    assert any(each.proved for each in borders(found))


def test_a_cell_with_a_border_is_undecided():
    """Across the end of a branch nothing is known, near it all."""
    edge = -0.3871770
    found = passages(PAPER, [[edge - 1e-3, edge + 1e-3], [edge - 11e-4, edge - 1e-3]], 4)
    assert found.verdict.tolist() == [UNDECIDED, RELEASED]
    assert np.isnan(found.value[0]).all()


def test_captures_and_what_settles():
    """A capture takes all to one place; where captures begin G is known, but not how many hits."""
    found = passages(PAPER, [[0.98, 0.9801], [0.9121, 0.91210001]], 2)
    assert found.verdict.tolist() == [RELEASED, SETTLED]
    assert shortened(found.words(0)) == ("hit r", "capture r", "release left")
    assert found.value[0].tolist() == pytest.approx([-1, -1], abs=1e-14)
    assert abs(found.slope[0]).max() < 1e-300
    assert found.maybe[1] >> HIT_R & 1
    assert -1 <= found.value[1, 1] < -0.999
    assert np.isnan(found.slope[1]).all()


def test_a_mass_that_moves_on():
    """In two periods there is no release from here, in four there is."""
    short, long = (passages(PAPER, [[0.34, 0.3401]], n) for n in (2, 4))
    assert short.verdict[0] == MOVING
    assert long.verdict[0] == RELEASED
    assert long.half_periods[0] >= 4


@pytest.mark.slow
def test_borders(found):
    """Each kind is proved, with exactly one place where the events change."""
    seen = borders(found)
    assert {each.kind for each in seen if each.proved} == {"graze", "stop", "slow"}
    others = [each.kind for each in seen if not each.proved]
    assert set(others) <= {"horizon", "same", "capture", "unknown"}
    assert others.count("unknown") <= 1
    assert sum(each.proved for each in seen) > 40
    for each in seen:
        assert each.lower < each.upper
        left, right = found.at(each.lower), found.at(each.upper)
        assert left.itinerary[: each.events] == right.itinerary[: each.events]
        assert each.proved == (each.kind in ("graze", "stop", "slow"))


def test_taylor_models_take_over():
    """A plateau of 2e-5 that doubles leave is decided."""
    rows = [
        Row(-1.0, 0.90618, (("x",), 1), (0, 0), (0, 0)),
        Row(0.9062, 1.0, (("y",), 1), (0, 0), (0, 0)),
    ]
    more = remainder.refined(PAPER, rows, 2, Fraction(1, 10**5))
    assert sum(b - a for a, b in gaps_between(PAPER, more)) <= Fraction(1, 10**5)
    kinds = {row.kind[0][-2:] for row in more[1:-1]}
    assert kinds == {("stick", "release left")}


@pytest.mark.slow
def test_with_both_losses():
    """Taylor models decide most of what doubles leave; their cells agree with floats."""
    p = replace(PAPER, e=Fraction(9, 10), mu=Fraction(1, 20))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(remainder, "MOST", 0)
        before = table(p, 2, Fraction(1, 25_000))
    rows = [row for branch in before.branches for row in branch.rows]
    known = set(rows)
    more = remainder.refined(p, rows, 2, p.R / 25_000)
    assert before.undecided > p.R / 25_000 >= sum(b - a for a, b in gaps_between(p, more))
    new = [row for row in more if row not in known]
    places = np.array([(row.lower + row.upper) / 2 for row in new])
    floats = images(p, places)
    for k, row in enumerate(new):
        assert floats.half_periods[k] == row.kind[1]
        assert row.value[0] - 1e-9 <= floats.value[k] <= row.value[1] + 1e-9


@pytest.mark.slow
def test_second_derivative(found):
    """G'' is enclosed, as the differences of G' have it; after a capture it is zero."""
    branch = found.at(Fraction("-0.6"))
    row = next(row for row in branch.rows if row.upper > -0.6)
    low, high = curve(PAPER, row)
    x = np.array([row.lower, row.upper])
    rise = np.diff(images(PAPER, x).slope)[0] / (x[1] - x[0])
    assert low < rise < high < low + 1
    assert curve(PAPER, Row(0.98, 0.9801, (("hit r",), 1), (0, 0), (0, 0))) == (0, 0)
    with pytest.raises(NotProved):
        curve(PAPER, row._replace(lower=-0.9))


@pytest.mark.slow
def test_unfolded(found):
    """To the left all is the mirror image."""
    right, left = (unfolded(found, side) for side in ("right", "left"))
    for one, other in zip(right, reversed(left), strict=True):
        assert (one.lower, one.upper) == (-other.upper, -other.lower)
        assert turned(one.itinerary) == other.itinerary
        if one.value:
            low, high = one.value
            assert other.value == (-high, -low)
    one = next(b for b in right if b.itinerary[-1] == "release left")
    x = float(one.lower + one.upper) / 2
    low, high = one.value
    assert float(low) <= -images(PAPER, [x]).value[0] <= float(high)


def test_words():
    """What a capture stands for is dropped; a settling takes its place."""
    many = ("hit l", "hit r", "turn right", "hit r", "capture r", "release left")
    assert shortened(many) == ("hit l", "hit r", "capture r", "release left")
    settled = ("hit r", "turn right", "release left")
    assert shortened(settled, "r") == ("settle r", "release left")
    assert shortened(("stick",)) == ("stick",)
    assert turned(many[1:3]) == ("hit l", "turn left")


def test_what_is_refused():
    """No friction, no part, no cell, no period."""
    with pytest.raises(BadInput, match="friction"):
        table(replace(PAPER, f=Fraction(0)))
    with pytest.raises(BadInput, match="undecided"):
        table(PAPER, undecided=Fraction(1))
    with pytest.raises(BadInput, match="in order"):
        passages(PAPER, [[0.2, 0.1]], 2)
    with pytest.raises(BadInput, match="between the walls"):
        passages(PAPER, [[0.2, 1.1]], 2)
    with pytest.raises(BadInput, match="one period"):
        passages(PAPER, [[0.2, 0.3]], 0)
