"""What enters the strip of the stored theorem, with few regions."""

from fractions import Fraction
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import pytest

from cap.cells.constants import system_of
from cap.cells.contraction import hoped
from cap.cells.entries import Strip, entered
from cap.cells.listing import written
from cap.cells.regions import Limits, Region
from cap.checker.folded import strips
from cap.checker.folded.backward import System
from cap.checker.folded.regions import UNIT
from cap.checker.kernel.certificate import read
from cap.checker.theorems.mixed import Mixed, below
from cap.parameters import PAPER
from cap.proofs import strip
from cap.runner import Runner

STORED = Path(__file__).parents[2] / "certificates/mixed.json"
SETTING = SimpleNamespace(parameters=PAPER, runner=Runner())


@cache
def stored():
    """Return the stored theorem, of which nothing is proved."""
    return Mixed(read(STORED.read_bytes()), lambda _: None)


@pytest.fixture(scope="module")
def found():
    """Return the area of what enters, and the trees."""
    patch = pytest.MonkeyPatch()
    patch.setattr(strip, "WORTH", 1e-3)
    yield strip.by_strip(SETTING, stored())
    patch.undo()


def target():
    """Return the strip."""
    known = stored().strip()
    return Strip(*known[:6], *known.edge)


def halves():
    """Give the halves of the strip as regions of speeds, from the slower one."""
    for fast in (False, True):
        root, (low, high) = strips.half_strip(System(stored().p), stored().strip(), fast=fast)
        edges = (tuple(z * UNIT for z in edge) for edge in (root.low, root.high))
        yield Region(*edges, (low + high) / 2, (high - low) / 2)


def test_the_checker_finds_the_same(found):
    """Region by region: what the trees say is there."""
    area, trees = found
    theorem = Mixed(stored().certificate, lambda _: None)
    theorem.hints = stored().hints | {"strip": trees}
    y, V = System(theorem.p), below(theorem.region()[1])
    leaves = list(theorem.strips(y))
    areas = [strips.entered(y, theorem.strip(), V, leaf) for leaf in leaves]
    assert 50 < len(leaves) < 300
    assert min(areas) > 0
    assert theorem.inside(y, V) + sum(areas) == pytest.approx(float(area), abs=1e-5)
    for (leaf, fast), other in zip(leaves[::7], areas[::7], strict=True):
        assert part(leaf.region, fast) == pytest.approx(other, abs=1e-6)


def area_of(region, there=None):
    """Return the area of what enters a region of a strip."""
    return entered(system_of(PAPER), there or target(), region, Limits(3.0, 60, 3.0)).area


def part(region, fast, there=None):
    """Return the area of what enters a region of a tree."""
    whole = list(halves())[fast]
    edges = (tuple(z * UNIT for z in edge) for edge in (region.low, region.high))
    middle = (2 * region.j + 1) * 0.5**region.n - 1
    times = whole.middle + whole.half * middle, whole.half * 0.5**region.n
    return area_of(Region(*edges, *times), there)


def test_areas_are_below_those_of_orbits(found):
    """They are most of what enters by orbits in floats."""
    near = sum(hoped(system_of(PAPER), target(), half, 3.0, 24, 25)[0] for half in halves())
    theorem = stored()
    inside = theorem.inside(System(theorem.p), below(theorem.region()[1]))
    assert 0.55 * near < float(found[0]) - inside < near


def test_only_what_was_outside_counts(found):
    """Nothing enters the whole of a half, nor a strip as large as all there is."""
    theorem = Mixed(stored().certificate, lambda _: None)
    theorem.hints = stored().hints | {"strip": found[1]}
    leaf, fast = next(theorem.strips(System(theorem.p)))
    large = target()._replace(left=-99.0, right=99.0, d=9.0)
    assert part(leaf.region, fast) > 0
    assert part(leaf.region, fast, large) == 0
    assert all(area_of(half) == 0 for half in halves())


def test_strips_of_which_states_may_stick_do_not_count(monkeypatch):
    """Then there is nothing in the trees."""
    monkeypatch.setattr(strip, "counts", lambda *_: False)
    theorem = stored()
    area, trees = strip.by_strip(SETTING, theorem)
    assert area == Fraction(theorem.inside(System(theorem.p), below(theorem.region()[1])))
    assert trees == {"slow": written([0]), "fast": written([0])}
