"""Continuation, maps and inventories over parameters, against closed forms and proved orbits."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.errors import BadInput
from cap.explore.inventory import inventory
from cap.floats.diagnostics.continuation import continuation
from cap.floats.diagnostics.gallery import gallery
from cap.floats.diagnostics.grid import grid
from cap.floats.diagnostics.plane import plane
from cap.floats.engine import swarm
from cap.floats.variation import value_of, varied
from cap.parameters import PAPER

PITCHFORK = 2 / math.pi * math.sqrt(1 - (4 / (math.pi**2 - 4)) ** 2)
FOLD = 2 / math.pi
ELLIPTIC = 0.1002798898441954, 0.5419433067664584


@pytest.fixture(scope="module")
def over_friction():
    """Return the branches through P* over f."""
    return continuation(PAPER, range=(0.28, 0.7), points=200)


def values(found, label):
    """Return where the special points of a label are."""
    return [each.value for each in found.special if each.label == label]


@pytest.mark.slow
def test_pitchfork_and_fold_in_closed_form(over_friction):
    """f_pf = (2F/π) sqrt(1 - (2Rω²/(F(π²-4)))²), and the saddle-center at 2F/π."""
    assert values(over_friction, "pitchfork") == [pytest.approx(PITCHFORK, abs=1e-9)]
    assert values(over_friction, "fold") == [pytest.approx(FOLD, abs=1e-9)]
    assert len(over_friction.branches) == 2


@pytest.mark.slow
def test_the_branch_passes_known_orbits(over_friction):
    """P* and its mirror image at f = 2/5, both elliptic."""
    branch = over_friction.branches[0]
    at = np.flatnonzero(branch.value == 0.4)
    assert len(at) == 1
    assert (branch.x[at[0]], branch.v[at[0]]) == pytest.approx(ELLIPTIC, abs=1e-12)
    assert branch.trace[at[0]] == pytest.approx(-0.46028683457392888, abs=1e-9)
    upper = np.interp(0.4, branch.value[branch.x > 0.3], branch.x[branch.x > 0.3], period=10)
    assert upper == pytest.approx(0.559163, abs=1e-3)


@pytest.mark.slow
def test_the_symmetric_branch_in_closed_form(over_friction):
    """tr Φ' = (2 - k)² - 2, k = 2π²c/(2 + 2c), c = sqrt(1 - (πf/2)²), and det = 1."""
    branch = over_friction.branches[1]
    own = (branch.trace < 2) & (branch.value > PITCHFORK)
    c = np.sqrt(np.maximum(0, 1 - (np.pi * branch.value[own] / 2) ** 2))
    k = 2 * np.pi**2 * c / (2 + 2 * c)
    np.testing.assert_allclose(branch.trace[own], (2 - k) ** 2 - 2, atol=1e-6)
    np.testing.assert_allclose(branch.determinant[own], 1, atol=1e-9)
    assert branch.stable[own][3:-3].all()


def test_sticking_border(over_friction):
    """Where the least speed of P*'s orbit vanishes; below, the determinant is 0."""
    border = values(over_friction, "sticking border")
    assert border
    branch = over_friction.branches[0]
    assert border[-1] == pytest.approx(0.3478298, abs=1e-6)
    above = branch.value > border[-1] + 1e-6
    below = (branch.value < border[-1] - 1e-6) & (branch.value > 0.3)
    np.testing.assert_allclose(branch.determinant[above], 1, atol=1e-8)
    np.testing.assert_allclose(branch.determinant[below], 0, atol=1e-8)
    nearest = branch.least_speed[above][np.argmin(branch.value[above])]
    assert 0 < nearest < 1e-2


@pytest.mark.slow
def test_flip_and_fold_of_sinks():
    """The focus of F = 3: born in a fold, broken in a pitchfork, its pair flips."""
    p = replace(PAPER, F=Fraction(3))
    found = continuation(p, orbit=(0.4064, -0.6708), parameter="F", range=(2.6, 3.6), branches=2)
    assert values(found, "fold") == [pytest.approx(2.6574391, abs=1e-6)]
    assert values(found, "pitchfork") == [pytest.approx(3.2860673, abs=1e-5)]
    flips = [each for each in found.special if each.label == "flip"]
    assert len(flips) == 2
    for each in flips:
        assert each.value == pytest.approx(3.4422831, abs=1e-6)


def test_the_period_of_the_sink_at_3_2_doubles():
    """At F = 1.5292 a branch of period 2T begins, of sinks that have no shorter period."""
    p = replace(PAPER, F=Fraction(3, 2))
    sink = (0.6276, -0.1184)
    found = continuation(p, orbit=sink, parameter="F", range=(1.48, 1.56), branches=2)
    assert values(found, "flip") == [pytest.approx(1.5292254, abs=1e-6)]
    assert [each.label for each in found.special] == ["flip"]
    single, doubled = found.branches
    assert (single.period, doubled.period) == (1, 2)
    assert single.stable[single.value < 1.5292].all()
    assert not single.stable[single.value > 1.5293].any()
    assert doubled.stable[doubled.value > 1.5293].all()
    assert doubled.value.min() == pytest.approx(1.5292254, abs=1e-5)
    own = doubled.value > 1.55
    assert {x > found.special[0].x for x in doubled.x[own].tolist()} == {True, False}
    for F, x, v in zip(doubled.value[own], doubled.x[own], doubled.v[own], strict=True):
        here = replace(p, F=Fraction(float(F)))
        once, twice = (swarm.follow(here, [(x, v)], n).states[0] for n in (1, 2))
        assert np.abs(twice - (x, v)).max() < 1e-9
        assert np.abs(once - (x, v)).max() > 0.01


def test_unstable_branches_are_followed_far():
    """The other symmetric saddle: no divided difference spans a change of its events."""
    found = continuation(PAPER, orbit=(-0.7914, 0.4979), range=(0.2, 0.42), points=300)
    (branch,) = found.branches
    c = -np.sqrt(1 - (np.pi * branch.value / 2) ** 2)
    k = 2 * np.pi**2 * c / (2 + 2 * c)
    np.testing.assert_allclose(branch.trace, (2 - k) ** 2 - 2, rtol=1e-5)
    assert branch.value.min() < 0.201
    assert branch.trace.max() > 3e4
    assert not found.special


def test_no_branch_point_next_to_a_grazing():
    """There the trace passes infinity: 1 - trace + det changes its sign, but is not 0."""
    p = replace(PAPER, F=Fraction(36, 5))
    found = continuation(p, orbit=(0.5199, -4.1594), parameter="F", range=(7.15, 7.3), branches=1)
    assert found.special[-1].label == "end: grazing"
    assert found.special[-1].value == pytest.approx(7.284525, abs=1e-5)
    for each in found.special:
        assert each.label not in ("fold", "branch point", "pitchfork")


def test_an_end_has_a_reason():
    """If it is only that the points are used."""
    found = continuation(PAPER, points=3, branches=1)
    assert [each.label for each in found.special] == ["followed no further: 3 points"] * 2


def test_crossing_branches_are_followed():
    """Over F too the pair around P* leaves the symmetric branch, which ends at F = πf/2."""
    found = continuation(PAPER, parameter="F", range=(0.6, 1.02), points=300)
    assert len(found.branches) == 2
    assert values(found, "pitchfork") == [pytest.approx(0.9269277, abs=1e-5)]
    assert values(found, "fold") == [pytest.approx(math.pi * 0.4 / 2, abs=1e-7)]


@pytest.mark.parametrize("parameter", ["mu", "e"])
def test_losses_make_sinks(parameter):
    """The elliptic orbit becomes a sink with det = exp(-2πμ), e⁴."""
    limits = (0.0, 0.02) if parameter == "mu" else (0.98, 1.0)
    found = continuation(PAPER, parameter=parameter, range=limits, branches=1)
    branch = found.branches[0]
    value = branch.value
    exact = np.exp(-2 * np.pi * value) if parameter == "mu" else value**4
    np.testing.assert_allclose(branch.determinant, exact, atol=1e-7)
    assert not found.special


def test_a_hit_may_pass_the_strobe():
    """As f falls the mirror image's hit passes t = 0: the branch goes on."""
    found = continuation(PAPER, range=(0.25, 0.5), branches=1)
    branch = found.branches[0]
    assert (branch.v < 0).any()
    assert not [each for each in found.special if each.label.startswith("end")]


def test_a_hit_may_pass_the_strobe_as_e_varies():
    """The velocity after a hit at t = 0 is -e times that before; e varies."""
    p = replace(PAPER, F=Fraction(3))
    found = continuation(
        p, orbit=(0.4064, -0.6708), parameter="e", range=(0.55, 1.0), branches=1, points=300,
    )  # fmt: skip
    assert found.branches[0].value.min() < 0.56
    assert not found.special


def test_parameters_vary_exactly():
    """R moves both walls; what is no oscillator is refused."""
    wide = varied(PAPER, "R", 3.0)
    assert (wide.l, wide.r, value_of(wide, "R")) == (Fraction(-3, 2), Fraction(3, 2), 3.0)
    for name, value in (("f", 1.0), ("F", 0.3), ("R", 0.0), ("e", 1.5), ("mu", -1.0), ("x", 1.0)):
        with pytest.raises(BadInput):
            varied(PAPER, name, value)


def test_no_orbit_above_the_impulse_bound():
    """Over (f, R): none where f > 2F/π; both kinds at the paper's parameters."""
    found = plane(PAPER, first=(0.4, 0.7), second=(1.9, 2.1), points=3)
    assert [found.names[k] for k in found.code[1]] == [*["elliptic and saddle"] * 2, "none"]
    np.testing.assert_array_equal(found.number[:, 2], 0)


def test_attractors_over_a_plane():
    """Outside f < F there is no oscillator; at f > 2F/π masses end without hits."""
    found = plane(
        PAPER, axes=("f", "F"), first=(0.5, 0.9), second=(0.6, 1.2), points=3, what="attractors"
    )
    outside = found.first[None, :] >= found.second[:, None]
    np.testing.assert_array_equal(found.code < 0, outside)
    assert found.names[found.code[2, 2]] == "never hits a wall"


@pytest.mark.slow
def test_inventory_of_the_paper():
    """Four orbits at F = 1, as proved: two elliptic, two saddles."""
    found = inventory(PAPER, values=(1.0, 1.5))
    assert found.count("elliptic").tolist() == [2, 0]
    assert found.count("saddle").tolist()[0] == 2
    assert found.count("sink focus").tolist() == [0, 2]
    assert found.failed == 0
    assert all(each.verdict == "" for each in found.orbits)


@pytest.mark.slow
@pytest.mark.parametrize(("force", "count"), [("3/2", 7), ("2", 11)])
def test_inventory_from_many_seeds(force, count):
    """576 seeds find 5 and 9 orbits; all of these can be proved, as can the 25 at F = 3."""
    found = inventory(replace(PAPER, F=Fraction(force)))
    assert len(found.orbits) == count


def test_an_empty_box():
    """Its ends are told as they were given."""
    with pytest.raises(BadInput, match=r"the box is empty: x from 0 to 1, v from 2 to -2$"):
        grid(PAPER, (0.0, 1.0, 2.0, -2.0), 4)
    with pytest.raises(BadInput, match=r"between the walls -1 and 1: x from 0 to 5$"):
        grid(PAPER, (0.0, 5.0, -2.0, 2.0), 4)


def test_chaos_has_no_trace():
    """What closes has its trace and determinant; of what does not nothing is said."""
    found = gallery(PAPER, values=(50.0,), periods=1)
    assert np.isnan(found.trace[0])
    assert "nan" not in found.lines()[1]


@pytest.mark.slow
def test_gallery_has_traces():
    """At F = 9/2 the focus of the paper or its mirror image."""
    found = gallery(PAPER, values=(4.5,), periods=1)
    assert found.trace[0] == pytest.approx(-0.520, abs=1e-3)
    assert found.determinant[0] == pytest.approx(0.559, abs=1e-3)
    assert found.orbits[0].counts()["hit"] == 5
    assert "; trace -0.52" in found.lines()[1]
