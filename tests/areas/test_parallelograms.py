"""Coverings in compiled code: what it sees is what the checker proves, and no more."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cap.areas.parallelograms import covering, planar
from cap.areas.parallelograms.covering import Engine, Stack, Task, numbers
from cap.areas.parallelograms.planar import Columns
from cap.checker.coverings import formulas
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.half_period import HalfPeriod
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.proofs.coverings import Asked, lemma_1_coverings
from cap.sets.doubles import Interval
from cap.system.files import planar as read

ROOT = Path(__file__).parents[2]
NAMES = "horseshoe-1", "map_horseshoe-1", "map_horseshoe-2"
MAPS = {"map_horseshoe-1": "henon.py", "map_horseshoe-2": "standard.py"}


def both(name):
    """Return a map for the checker, and compiled."""
    if name == "horseshoe-1":
        given = Fraction(2, 5), Fraction(1)
        return HalfPeriod(*given), planar.half_period(*given)
    given = json.loads((ROOT / f"certificates/{name}.json").read_text())["parameters"]
    exact = formulas.Map(formulas.formulas(matched(given, formulas.FORMULAS, "the map")))
    return exact, planar.formulas(read(ROOT / "examples/maps" / MAPS[name]))


def family(name):
    """Return the sets and the coverings of a stored certificate."""
    hints = json.loads((ROOT / f"certificates/{name}.json").read_text())["hints"]
    sets = [[Fraction(q) for q in row] for row in hints["sets"]]
    return sets, [[int(j) for j in row] for row in hints["coverings"]]


def checked(g, source, target):
    """Return whether the checker proves a covering."""
    try:
        covers(g, Parallelogram(source), [Parallelogram(target)])
    except Rejected:
        return False
    return True


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_all_coverings_of_a_certificate(name):
    """Each is seen, with few boxes."""
    sets, edges = family(name)
    engine, known = Engine(both(name)[1]), np.array([numbers(one) for one in sets])
    for i in range(0, len(sets), 7):
        assert engine.covered(known[i], known[edges[i]]).all()
    assert engine.boxes < 100 * len(sets)


@pytest.mark.parametrize("name", NAMES)
def test_what_is_seen_is_what_the_checker_proves(name, monkeypatch):
    """Targets that are moved, or grow."""
    exact, compiled = both(name)
    sets, edges = family(name)
    engine, draw = Engine(compiled), np.random.default_rng(5)
    monkeypatch.setattr("cap.checker.coverings.covering.MOST", 200)
    seen = []
    for i in draw.integers(len(sets), size=25).tolist():
        cx, cy, *axes = sets[edges[i][0]]
        by, aside, grow = (Fraction(x).limit_denominator(999) for x in draw.normal(size=3) / 6)
        dx, dy = by * axes[0] + aside * axes[2], by * axes[1] + aside * axes[3]
        target = [cx + dx, cy + dy, *(q * (1 + grow) for q in axes)]
        [held] = engine.covered(numbers(sets[i]), numbers(target)[None]).tolist()
        assert held == checked(exact, sets[i], target)
        seen.append(held)
    assert {*seen} == {True, False}


@pytest.mark.parametrize("name", NAMES)
def test_images_of_boxes(name):
    """They contain those of points, and products with the derivative; as the checker's do."""
    exact, compiled = both(name)
    sets, _ = family(name)
    unit = Columns(*(Interval(float(n), 0.0) for n in (1, 0, 0, 1)))
    for one in sets[::97]:
        x, v = float(one[0]), float(one[1])
        X, V, columns = planar.image(*compiled, Interval(x, 1e-4), Interval(v, 1e-4), unit)
        for dx, dv in ((-9e-5, 9e-5), (0, 0), (9e-5, -1e-5)):
            at = exact.image(Double(x + dx), Double(v + dv))
            (a, b), (c, d) = at.derivative
            pairs = zip((X, V, *columns), (at.x, at.y, a, c, b, d), strict=True)
            assert all(abs(wide.mid - q.mid) + q.rad <= wide.rad for wide, q in pairs)
        assert max(q.rad for q in (X, V)) < 0.1


def test_where_no_map_is_defined():
    """States beyond a wall, slow ones, and those at a cut of a torus."""
    unit = Columns(*(Interval(1.0, 0.0) for _ in range(4)))
    sigma, standard = (both(name)[1] for name in NAMES[::2])
    for g, x, v in (
        (sigma, 1.0, 1.0),
        (sigma, 0.0, -0.1),
        (sigma, -0.9, 0.1),
        (standard, np.pi, 0.0),
        (standard, 0.0, np.pi),
    ):
        image = planar.image(*g, Interval(x, 1e-3), Interval(v, 1e-3), unit)
        assert np.isnan(image[0].mid)
        assert np.isnan(image[2].x0.mid)
    outside = [Fraction(n) for n in ("1.5", "1", "0.1", "0", "0", "0.1")]
    assert not Engine(sigma).covered(numbers(outside), numbers(outside)[None]).any()


def test_one_that_fails_among_others(monkeypatch):
    """With too many boxes for all targets each is looked at alone."""
    sets, edges = family("horseshoe-1")
    i = next(i for i, of_i in enumerate(edges) if len(of_i) == 2)
    j, k = edges[i]
    cx, cy, ax, ay, bx, by = sets[j]
    thin = [cx, cy, ax, ay, bx / 50, by / 50]  # the image leaves it through its long sides
    three = np.array([numbers(one) for one in (sets[j], thin, sets[k])])
    engine = Engine(both("horseshoe-1")[1])
    assert engine.covered(numbers(sets[i]), three).tolist() == [True, False, True]
    assert engine.boxes > covering.MOST
    monkeypatch.setattr(covering, "Stack", lambda *_: pytest.fail("no room is asked for"))
    with pytest.raises(pytest.fail.Exception):
        engine.covered(numbers(sets[i]), three)


def test_python_does_what_compiled_code_does():
    """The same text, run by Python: the same number of boxes."""
    sets, edges = family("map_horseshoe-1")
    known = np.array([numbers(one) for one in sets])
    engine = Engine(both("map_horseshoe-1")[1])
    for i in range(3):
        engine.boxes, targets = 0, known[edges[i]]
        held, sides = np.zeros(len(targets), bool), np.zeros((2, len(targets)), np.int64)
        stack = Stack(np.empty((99, 4)), np.empty((99, len(targets)), bool))
        count = covering._covered(Task(*engine.g, known[i], targets), held, sides, stack)
        engine.covered(known[i], targets)
        assert (held.all(), count) == (True, engine.boxes)


class Rounds:
    """A runner that says nothing."""

    def tell(self, *_):
        """Say nothing."""


def test_the_lemma():
    """Coverings that are not there are left out."""
    sets, edges = family("map_horseshoe-1")
    exact, compiled = both("map_horseshoe-1")

    class Found:
        source = np.array([0, 0, 1])
        target = np.array([edges[0][0], 400, edges[1][0]])

    found = lemma_1_coverings(Asked(exact, compiled), sets, Found, Rounds())
    assert found == [(0, edges[0][0]), (1, edges[1][0])]
