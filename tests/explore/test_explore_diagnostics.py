"""Diagnostics against what is known: rotations, saddles, invariant curves, analytic partitions."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.errors import BadInput
from cap.floats.diagnostics import (
    alignment,
    attractor,
    chatter,
    entropy,
    fate,
    lyapunov,
    manifold,
    portrait,
    rotation,
)
from cap.floats.diagnostics.grid import grid, whole
from cap.floats.diagnostics.manifold import crossings, manifolds
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine.reversal import retrace
from cap.floats.engine.swarm import follow, stretch
from cap.floats.search.fixed_point import elliptic_point
from cap.parameters import PAPER
from cap.runner import Runner

ELLIPTIC = 0.1002798898441954, 0.5419433067664584
TWISTS = 0.113477977036708622, -37869.18  # certified: certificates/elliptic.json
ROTATION = 0.28695976518442772
SADDLE = 0.3435260593, 0.775319501
FRAME = [[1.0, 0.0], [0.0, 1.0]]


def turned_by(angle, periods):
    """Return the derivatives of a rotation."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.tile([[cos, -sin], [sin, cos]], (1, periods, 1, 1))


def test_indices_of_a_rotation():
    """Vectors keep their angle: SALI stays at √2, GALI at 1."""
    units, growth = stretch(turned_by(1.8, 500), FRAME)
    np.testing.assert_allclose(alignment.smaller(units[:, :, 0], units[:, :, 1]), math.sqrt(2))
    np.testing.assert_allclose(alignment.area(units[:, :, 0], units[:, :, 1]), 1)
    assert np.abs(growth).max() < 1e-12


def test_indices_of_a_hyperbolic_map():
    """diag(λ, 1/λ) brings vectors that are not its own together as λ^(-2n)."""
    periods, rate = 8, 1.7
    units, _ = stretch(np.tile(np.diag([rate, 1 / rate]), (1, periods, 1, 1)), [[1, 1], [-1, 1]])
    sali = alignment.smaller(units[0, :, 0], units[0, :, 1])
    np.testing.assert_allclose(sali[3:] / sali[2:-1], rate**-2, rtol=0.05)


def test_indices_of_a_shear():
    """On invariant curves vectors align like a power: n^(-2) for SALI and GALI."""
    n = 4000
    units, _ = stretch(np.tile([[1.0, 0.5], [0.0, 1.0]], (1, n, 1, 1)), [[1, 1], [-1, 1]])
    for index in (alignment.smaller, alignment.area):
        values = index(units[0, :, 0], units[0, :, 1])
        assert math.log(values[-1] / values[n // 2 - 1]) / math.log(2) == pytest.approx(
            -2, abs=0.01
        )


def test_the_paper_s_sali_grid():
    """257 cells that turn, as in the paper; the rest depends on the vectors, by three cells."""
    found = alignment.sali(PAPER, points=22).counts
    assert found["turned"] == 257
    assert abs(found["regular"] - 165) <= 4
    assert sum(found.values()) == 484


def test_sali_and_gali_agree():
    """For two unit vectors at the angle φ they are 2 sin φ/2 and sin φ."""
    sali, gali = (
        index(PAPER, points=12, seed=3).index for index in (alignment.sali, alignment.gali)
    )
    np.testing.assert_allclose(gali, sali * np.sqrt(1 - sali**2 / 4), atol=1e-12)


def test_exponents_of_a_saddle():
    """Over one period they are the logarithms of its multipliers."""
    state = elliptic_point(PAPER, SADDLE)
    monodromy = follow(PAPER, [state], 1, derivative=True).monodromy[0]
    multipliers = np.sort(np.abs(np.linalg.eigvals(monodromy)))[::-1]
    periods = 12  # before rounding takes the orbit away
    found = lyapunov.exponents(PAPER, np.array([state]), periods)
    growth = found.exponents[0] * found.after[:, None] * found.period
    late = (growth[-1] - growth[-4]) / (found.after[-1] - found.after[-4])
    np.testing.assert_allclose(late, np.log(multipliers), rtol=1e-5)


def test_exponents_on_an_invariant_curve():
    """Both tend to 0, and cancel: areas are kept."""
    found = lyapunov.exponents(PAPER, np.array([[ELLIPTIC[0] + 0.01, ELLIPTIC[1]]]), 3000)
    assert np.abs(found.exponents[0, -1]).max() < 1e-3
    np.testing.assert_allclose(found.exponents[0].sum(axis=1), 0, atol=1e-13)
    assert not found.turned[0]


def test_exponents_of_a_sink():
    """At the focus of F = 3 both are half the logarithm of the determinant."""
    p = replace(PAPER, F=Fraction(3))
    state = elliptic_point(p, (0.4064, -0.6708))
    determinant = np.linalg.det(follow(p, [state], 1, derivative=True).monodromy[0])
    found = lyapunov.exponents(p, np.array([state]), 400)
    expected = math.log(determinant) / 2 / found.period
    np.testing.assert_allclose(found.exponents[0, -1], expected, atol=2e-3)
    assert found.turned[0]


def test_exponents_after_a_stick():
    """The second is minus infinity."""
    found = lyapunov.exponents(PAPER, np.array([[0.0, 0.1]]), 30)
    assert np.isneginf(found.exponents[0, -1, 1])
    assert np.isfinite(found.exponents[0, -1, 0])


def test_areas_inside_curves_are_kept():
    """The area of a polygon of states is that of its image, around P*."""
    angle = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    loop = np.array(ELLIPTIC) + 0.005 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    image = follow(PAPER, loop, 5)
    assert not image.turned.any()
    before, after = (
        0.5 * np.sum(x * np.roll(v, -1) - v * np.roll(x, -1)) for x, v in (loop.T, image.states.T)
    )
    assert after == pytest.approx(before, rel=1e-3)


def test_rotation_number_and_twist():
    """Both are those proved."""
    found = rotation.rotation(PAPER, orbits=80, periods=3000)
    assert found.limit == pytest.approx(ROTATION, abs=1e-12)
    assert found.twist[0] == pytest.approx(TWISTS[0], rel=1e-4)
    assert found.twist[1] == pytest.approx(TWISTS[1], rel=1e-3)
    assert found.rotation[0] == pytest.approx(ROTATION, abs=1e-8)


@pytest.mark.parametrize("options", [{"periods": 200}, {"near": 1e-5}, {}])
def test_a_twist_is_as_good_as_it_says(options):
    """Few periods, or curves that are too near, leave it open."""
    found = rotation.rotation(PAPER, orbits=40, **options)
    for value, error, known in zip(found.twist, found.error, TWISTS, strict=True):
        assert abs(value - known) < error
    assert bool(options) == (found.error[0] > 1e-3)


def test_rotation_of_an_exact_turn():
    """A circle of radius r: the rotation number, |z|² = r²."""
    number, radius = 0.3819660112, 0.7
    orbit = radius * np.exp(2j * np.pi * number * np.arange(2001))[None]
    size, found, quality = rotation._curves(orbit, 0.38)
    assert found[0] == pytest.approx(number, abs=1e-13)
    assert size[0] == pytest.approx(radius**2, abs=1e-12)
    assert quality[0] < 1e-13


def test_entropy_of_one_colour():
    """There is none."""
    assert entropy.entropy(np.zeros((20, 20), int), 5) == (0.0, 0.0, 16, 0)


def test_entropy_of_a_chessboard():
    """Every box of 2 x 2 cells is half black: log 2, of k colours with equal shares log k."""
    board = np.indices((12, 12)).sum(axis=0) % 2
    found = entropy.entropy(board, 2)
    assert found.mean == found.boundary == pytest.approx(math.log(2))
    colours = np.indices((12, 12))[0] % 4
    assert entropy.entropy(colours, 4).mean == pytest.approx(math.log(4))


def test_entropy_of_a_straight_border():
    """A border that cuts a column of boxes at a quarter: one box in a row, with its entropy."""
    size, count = 8, 6
    board = np.indices((size * count,) * 2)[1] < size * 2 + size // 4
    part = 1 / 4
    each = -part * math.log(part) - (1 - part) * math.log(1 - part)
    found = entropy.entropy(board, size)
    assert found.boundary == pytest.approx(each)
    assert found.mean == pytest.approx(each / count)
    assert (found.boxes, found.mixed) == (count**2, count)


def test_uncertainty_exponent_of_a_smooth_border():
    """S_b ~ ε for a slanted line: the exponent is 1."""
    i, j = np.indices((720, 720))
    board = 7 * i + 10 * j < 6000
    sizes = (3, 4, 5, 6, 8, 10, 12, 15, 20, 24, 30)
    slope, error, _ = entropy._fit(sizes, [entropy.entropy(board, s).mean for s in sizes])
    assert slope == pytest.approx(1, abs=0.05)
    assert error < 0.05


def test_entropy_of_what_is_known():
    """Boxes with an unknown cell count for nothing."""
    board = np.indices((8, 8)).sum(axis=0) % 2
    known = np.ones((8, 8), dtype=bool)
    board[:4], known[:4, :3] = 0, False
    assert entropy.entropy(board, 2, known).boxes == 12
    assert entropy.entropy(board, 2, known).mean == pytest.approx(math.log(2) * 8 / 12)


def test_two_colours_are_told_their_most(capsys):
    """The criterion log 2 says nothing of two colours: no entropy exceeds it."""
    said = entropy.basin_entropy(PAPER, points=8, boxes=(2,)).lines()[0]
    assert "of two colours at most log 2" in said


def test_lost_orbits_are_not_said_to_turn():
    """A mass that is too fast is followed by nobody."""
    box = (-0.9, 0.9, 0.5, 1e7)
    found = alignment.sali(PAPER, box=box, points=3)
    assert found.counts == {"regular": 0, "chaotic": 0, "turned": 3, "lost or not done": 6}
    assert fate.fate(PAPER, box=box, points=3, periods=1).lines()[-1].endswith("not done 6")
    assert "6 were lost" in portrait.portrait(PAPER, box=box, orbits=9, periods=2).lines()[-1]
    ends = attractor.attractors(PAPER, box=box, points=3, transient=5)
    assert ends.lines()[-1] == "  6 seeds were lost, or not done"
    assert np.isnan(entropy.basin_entropy(PAPER, box=box, points=3, boxes=(3,)).mean[0])


def test_the_paper_s_basin():
    """22.7 % never turn (the paper: 22.6 %), and its entropies to a few thousandths."""
    found = entropy.basin_entropy(PAPER, points=60, boxes=(5,))
    basin = found.basin[0]
    assert abs(basin.counts["never turns"] - 814) <= 5
    assert found.mean[0] == pytest.approx(0.189, abs=0.004)
    assert found.boundary[0] == pytest.approx(0.349, abs=0.005)


def test_fates_and_their_times():
    """What turns, turns once at least; the times are those of single orbits."""
    found = fate.fate(PAPER, box=(-0.9, 0.9, -1, 1), points=15, periods=4)
    assert sum(found.counts.values()) == found.fate.size
    k = np.flatnonzero(found.fate.ravel() > 0)[7]
    state = grid(PAPER, (-0.9, 0.9, -1, 1), 15).states(slice(k, k + 1))[0]
    events = trajectory(PAPER, orbit=tuple(state), exactly=True, periods=4)
    first = next(
        t for w, t in zip(events.words, events.times, strict=True) if w[:2] in ("tu", "st")
    )
    assert found.first.ravel()[k] == pytest.approx(first, abs=1e-9)


def test_portrait_follows_orbits():
    """Its states are those of the swarm; around P* they never turn."""
    found = portrait.portrait(PAPER, radius=1 / 1000, orbits=5, periods=10)
    assert found.states.shape == (5, 11, 2)
    assert not found.turned.any()
    expected = follow(PAPER, found.states[:, 0], 10).states
    np.testing.assert_allclose(found.states[:, -1], expected, atol=1e-12)


@pytest.mark.parametrize("force", ["1", "3"])
def test_trajectory_solves_the_equation(force):
    """Between its events x' = v and v' = F cos ωt - f sgn v, and the events are on it."""
    p = replace(PAPER, F=Fraction(force))
    found = trajectory(p, orbit=(0.35, 0.9), exactly=True, periods=3)
    inner = np.diff(found.t) > 1e-6
    t, dt = (found.t[1:] + found.t[:-1])[inner] / 2, np.diff(found.t)[inner]
    v = (found.v[1:] + found.v[:-1])[inner] / 2
    assert np.abs(np.diff(found.x)[inner] / dt - v).max() < 1e-3
    force = float(p.F) * np.cos(t) - float(p.f) * np.sign(v)
    rest = (found.v[1:] == 0)[inner] & (found.v[:-1] == 0)[inner]
    assert np.abs(np.diff(found.v)[inner] / dt - np.where(rest, 0, force)).max() < 1e-3
    assert np.isin(found.times, found.t).all()
    end = follow(p, [(0.35, 0.9)], 3).states[0]
    np.testing.assert_allclose([found.x[-1], found.v[-1]], end, atol=1e-10)


def test_chatter_is_the_capture_proved():
    """The state of the theorem: captured before t = 0.656, with the ratio of the lemma."""
    found = chatter.chatter(PAPER, orbit=(0.9990, 0.01))
    assert found.end < 0.656
    assert (np.diff(found.speeds) < 0).all()
    assert found.speeds[-1] / found.speeds[-2] == pytest.approx(found.ratio, rel=1e-6)
    a = math.cos(found.end)
    assert found.ratio == pytest.approx(math.sqrt((a - 0.4) / (a + 0.4)))


def test_backwards_and_forwards():
    """What did not stick comes back, over hits and turns."""
    p = replace(PAPER, F=Fraction(3))
    states = np.random.default_rng(5).uniform([-0.95, -3], [0.95, 3], size=(400, 2))
    there = follow(p, states, 2)
    well = ~(there.stuck | there.captured)
    error = np.abs(retrace(p, there.states, 2) - states).max(axis=1)[well]
    assert (there.turned & well).sum() > 50
    assert error.max() < 1e-6
    assert np.median(error) < 1e-11
    with pytest.raises(BadInput):
        retrace(replace(p, e=Fraction(1, 2)), states, 1)


def test_crossings_of_curves():
    """A circle and a line cross twice, at angles that are known; pieces are not joined."""
    angle = np.linspace(0, 2 * np.pi, 4000)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    x = np.linspace(-2, 2, 501)
    line = np.stack([x, np.full_like(x, 0.5)], axis=-1)
    found = crossings(circle, line)
    np.testing.assert_allclose(
        np.sort(found.points[:, 0]), [-math.sqrt(0.75), math.sqrt(0.75)], atol=1e-5
    )
    np.testing.assert_allclose(found.angles, 60, atol=0.1)
    line[240:260] = np.nan
    assert len(crossings(circle, line).points) == 2
    line[:] = np.nan
    assert len(crossings(circle, line).points) == 0


def test_crossings_in_pieces(monkeypatch):
    """All pairs of segments are tried, however few at a time."""
    t = np.linspace(0, 20, 300)
    curves = np.stack([np.sin(t), np.cos(1.3 * t)], -1), np.stack([np.cos(2.1 * t), np.sin(t)], -1)
    expected = crossings(*curves)
    monkeypatch.setattr(manifold, "PAIRS", 50)
    found = crossings(*curves)
    assert len(found.points) > 50
    np.testing.assert_array_equal(found.points, expected.points)


@pytest.mark.slow
def test_a_long_manifold_is_bounded(monkeypatch):
    """All its images together have no more points than one may have, and one image's more."""
    monkeypatch.setattr(manifold, "MOST", 2000)
    parts = []
    found = manifolds(PAPER, length=1e9, runner=Runner(tell=lambda _, part: parts.append(part)))
    assert max(len(found.unstable), len(found.stable)) < 2 * 2 * 2000 + 10
    assert parts == [0.25, 0.5, 0.75, 1.0]


@pytest.mark.slow
def test_manifolds_are_invariant_and_cross():
    """Points of the unstable manifold go to it, forwards; of the stable one backwards."""
    found = manifolds(PAPER, length=1.5, spacing=0.004, periods=20)
    large, small = found.multipliers
    assert large * small == pytest.approx(1, rel=1e-9)
    assert len(found.homoclinic) > 5
    for curve, move in (
        (found.unstable, lambda z: follow(PAPER, z, 1).states),
        (found.stable, lambda z: retrace(PAPER, z, 1)),
    ):
        near = curve[np.hypot(*(curve - np.array(found.saddle)).T) < 0.02]
        image = move(near)
        known = curve[np.isfinite(curve).all(axis=1)]
        distance = [np.hypot(*(known - z).T).min() for z in image]
        assert max(distance) < 0.01


def test_attractors_of_the_paper():
    """At F = 9/2 the focus of the paper and its mirror image, with the hits it counts."""
    p = replace(PAPER, F=Fraction(9, 2))
    found = attractor.attractors(p, points=10, transient=3000).found
    foci = [each for each in found if each.kind == "period 1"]
    assert {each.hits for each in foci} >= {(2.0, 3.0), (3.0, 2.0)}
    states = np.array([each.states[0] for each in foci])
    assert np.abs(states - (0.2156, -0.8293)).max(axis=1).min() < 1e-3


def test_a_sink_that_never_turns_is_an_attractor():
    """With e < 1 the elliptic orbit is one: nothing keeps areas."""
    p = replace(PAPER, e=Fraction(99, 100))
    box = (0.099, 0.101, 0.54, 0.543)
    (found,) = attractor.attractors(p, box=box, points=2, transient=3000).found
    assert (found.kind, found.turns) == ("period 1", 0)


def test_islands_are_no_attractors():
    """At the paper's parameters some seeds never turn, most end in chaos with sticking."""
    found = attractor.attractors(PAPER, box=(0.05, 0.15, 0.5, 0.6), points=6, transient=200).found
    kinds = {each.kind for each in found}
    assert "never turns" in kinds
    assert "chaotic" in kinds


def test_boxes():
    """Boxes have an inside between the walls."""
    assert grid(PAPER, whole(PAPER), 3).x.tolist() == [-1, 0, 1]
    for box in ((0.5, 0.4, 0, 1), (0, 1, 1, 1), (-2, 0, 0, 1)):
        with pytest.raises(BadInput):
            grid(PAPER, box, 5)
    with pytest.raises(BadInput):
        grid(PAPER, whole(PAPER), 10_000)
