"""Slopes and units of cones: what they are fitted to, and which coverings are left out."""

from fractions import Fraction

import numpy as np
import pytest
from checker.linear import Linear

from cap.checker.coverings.cones import UNITS, cone, rates
from cap.checker.kernel.doubles import Double
from cap.errors import NotProved
from cap.floats.coverings.family import Family
from cap.proofs import cones, coverings
from cap.proofs.cone_fields import Sizes, fitted
from cap.runner import Runner

SOURCE, TARGET = np.array([0, 0, 1]), np.array([0, 1, 0])


def edges_of(*rows):
    """Return sizes of the golden mean's three edges."""
    return Sizes(*np.array(rows, dtype=float).T)


def test_no_single_slope_will_do():
    """One step shrinks what the next two stretch; cones are steep here and flat there."""
    sizes = edges_of((3, 0, 0, 0.3), (0.8, 0.01, 1, 0.2), (4, 1, 0.01, 0.5))
    field = fitted(sizes, SOURCE, TARGET, 2)
    assert not field.bad.any()
    L, u, w = field.slopes, field.u, field.w
    grown = sizes.along - L[SOURCE] * sizes.aside
    left = sizes.across + sizes.bent / L[SOURCE]
    assert (left * L[SOURCE] < L[TARGET] * grown).all()
    assert (grown * u[SOURCE] / u[TARGET]).min() > 1.001
    assert (left * w[SOURCE] / w[TARGET]).max() < 0.999
    digits = [[cones._digits(x) for x in row] for row in zip(L, u, w, strict=True)]
    fields = [cone([Fraction(0)] * 2, Fraction(1), row) for row in digits]
    alike = [cone([Fraction(0)] * 2, Fraction(1), UNITS)] * 2
    entries = [[Double(float(x)) for x in row] for row in zip(*sizes, strict=True)]
    matrices = [((a, b), (c, d)) for a, b, c, d in entries]
    ends = list(zip(SOURCE, TARGET, strict=True))
    found = [rates(A, fields[i], fields[j]) for A, (i, j) in zip(matrices, ends, strict=True)]
    assert min(r.stretch for r in found) > 1.001
    with pytest.raises(coverings.Rejected):
        [rates(A, alike[i], alike[j]) for A, (i, j) in zip(matrices, ends, strict=True)]


@pytest.mark.parametrize(
    "loop", [(0.9, 0, 0, 0.1), (3, 0, 0, 1.1), (1.2, 2, 2, 0.5), (-1, 0, 0, 0.1)]
)
def test_a_loop_without_cones(loop):
    """What does not stretch, does not shrink, turns, or has a fold."""
    field = fitted(edges_of(loop, (3, 0, 0, 0.3), (3, 0, 0, 0.3)), SOURCE, TARGET, 2)
    assert field.bad[0]
    two = fitted(edges_of((3, 0, 0, 0.3), (3, 0, 0, 0.3), (3, 0, 0, 0.3)), SOURCE, TARGET, 2)
    assert not two.bad.any()


def test_coverings_are_left_out(monkeypatch):
    """A fold beside a horseshoe of two sets; if there is nothing but folds, nothing is left."""
    good = ((Double(3.0), Double(0.0)), (Double(0.0), Double(0.25)))
    fold = ((Double(0.1, 3.0), Double(0.0)), (Double(0.0), Double(0.25)))
    edges = [(0, 0), (0, 1), (1, 0), (1, 1), (1, 2), (2, 0)]
    found = dict.fromkeys(edges, good) | {(1, 2): fold}
    monkeypatch.setattr(cones, "matrices", lambda *_: found)
    assert cones.with_cones(Linear(), [[]] * 3, edges, Runner()) == edges[:4]
    monkeypatch.setattr(cones, "matrices", lambda *_: dict.fromkeys(edges, fold))
    assert cones.with_cones(Linear(), [[]] * 3, edges, Runner()) == []


def test_hyperbolic_or_nothing(monkeypatch):
    """Coverings that hold are not enough."""
    squares = np.array([[x, 0, 1, 0, 0, 1] for x in (0.0, 4.0)])
    ends = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])
    pairs = list(zip(*(end.tolist() for end in ends), strict=True))
    monkeypatch.setattr(coverings, "lemma_1_coverings", lambda *_: pairs)
    monkeypatch.setattr(coverings, "periodic_orbits", lambda *_: [])
    family = Family(squares, *ends, 2.0)
    monkeypatch.setattr(cones, "matrices", lambda *_: {})
    with pytest.raises(NotProved, match="with cones make no two loops"):
        coverings.proved(coverings.Asked(Linear()), family, Runner(), "hyperbolic")
    assert coverings.proved(coverings.Asked(Linear()), family, Runner(), "disjoint").cones is None
    monkeypatch.setattr(coverings, "with_cones", lambda *_: pairs)
    with pytest.raises(NotProved, match="not all cones"):
        coverings.proved(coverings.Asked(Linear()), family, Runner(), "hyperbolic")
