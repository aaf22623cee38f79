"""The theorem ``persistence``: one analytic family of fixed points over a range of losses."""

from __future__ import annotations

import copy
from fractions import Fraction

import pytest
from checker.altered import changed, decimal, encode, fits_the_schema, rejected, verify
from checker.forge_hybrid import forge_periodic, forge_persistence

from cap.checker.certificate import read
from cap.checker.persistence import Persistence
from cap.checker.rejection import Rejected
from cap.checker.statement import macros, words
from cap.checker.theorem import check

SMALL = ("0", "1/20000", "1/10000")


@pytest.fixture(scope="module")
def damped():
    """Return a valid certificate of an orbit with losses."""
    return forge_persistence()


@pytest.fixture(scope="module")
def conservative():
    """Return a valid certificate of the elliptic orbit, that persists in a small range."""
    return forge_persistence("elliptic", epsilon=("0", "1/1000"), mu=("0", "1/2000"))


@pytest.fixture(scope="module")
def continuation(damped):
    """Return the proof of the certificate, at its last step, and the fixed point."""
    proof = Persistence(read(encode(damped)), lambda _: None)
    return proof, proof.localisation()


def test_accepts(damped, conservative):
    """A sink at small losses, and the elliptic point at none."""
    assert len(verify(damped)) == 11
    assert conservative["claims"]["type"] == "elliptic"
    assert len(verify(conservative)) == 10


def refused(continuation, why, **changes):
    """Check that the last step fails for other ranges or cells."""
    proof, fixed_point = continuation
    proof.continuation(fixed_point)
    altered = copy.copy(proof)
    altered.claims = proof.claims | {"range": proof.claims["range"] | changes}
    with pytest.raises(Rejected, match=why):
        altered.continuation(fixed_point)


F = Fraction


@pytest.mark.parametrize("name", ["epsilon", "mu"])
def test_a_larger_range(continuation, name):
    """The last number of the grid doubled: the boxes or windows do not hold all fixed points."""
    refused(continuation, "K|wall|window", **{name: [F(0), F(1, 2000), F(1, 250)]})


@pytest.mark.parametrize("name", ["epsilon", "mu"])
def test_a_grid_that_is_none(continuation, name):
    """It begins with 0, increases, and epsilon stays below 1."""
    refused(continuation, "begin with 0", **{name: [F(1, 10**9), F(1, 2000), F(1, 1000)]})
    refused(continuation, "begin with 0", **{name: [F(-1), F(1, 2000), F(1, 1000)]})
    refused(continuation, "increase", **{name: [F(0), F(1, 2000), F(1, 2000)]})
    refused(continuation, "increase", **{name: [F(0), F(1, 1000), F(1, 2000)]})
    if name == "epsilon":
        refused(continuation, "below 1", epsilon=[F(0), F(1, 2), F(1)])


@pytest.mark.parametrize("n", range(4))
@pytest.mark.parametrize("axis", ["x", "v"])
def test_each_box_counts(damped, n, axis):
    """A box that is too small, too large, or beside its centre is refused."""
    ends = damped["claims"]["range"]["boxes"][n][axis]
    a, b = map(Fraction, ends)
    m, r = (a + b) / 2, (b - a) / 2
    for low, high in ((m - r / 20, m + r / 20), (m - 40 * r, m + 40 * r), (b, b + r)):
        box = [decimal(low), decimal(high)]
        with pytest.raises(Rejected, match=r"K|window|wall|velocity|centre|\|trace\|"):
            verify(changed(damped, "claims", "range", "boxes", n, axis, box))


def test_each_cell_counts(damped):
    """A wrong window, centre or preconditioner is refused."""
    path = "hints", "cells", 3
    rejected(changed(damped, *path, "events", 1, ["3.6", "3.7"]), "wall")
    rejected(changed(damped, *path, "centre", 0, "0.5"), "centre")
    rejected(changed(damped, *path, "preconditioner", 0, 0, "9"), "interior")
    rejected(changed(damped, *path, "events", [["1", "2"]]), "list of 2")


def test_neighbours_must_agree(continuation):
    """Two halves of the range with boxes that hold their own fixed points only."""
    proof, fixed_point = continuation
    altered = copy.copy(proof)
    images = iter([fixed_point, tuple(z + 1 for z in fixed_point)] * 2)
    altered.rectangle = lambda *_: next(images)
    with pytest.raises(Rejected, match="common edge"):
        altered.continuation(fixed_point)


def test_stability_on_every_rectangle(continuation, monkeypatch):
    """If 1 + determinant were below |trace|, about 0.44, the range would be refused."""
    proof, fixed_point = continuation
    for det, fine in (("-0.5", True), ("-0.6", False)):
        value = proof.number(Fraction(det)).with_bits(64)
        monkeypatch.setattr("cap.checker.persistence.determinant", lambda _, value=value: value)
        if fine:
            proof.continuation(fixed_point)
        else:
            with pytest.raises(Rejected, match="may fail in a rectangle"):
                proof.continuation(fixed_point)


def test_the_parameters_are_in_the_range():
    """e = 999/1000 is not in a range that ends at 1/10000."""
    rejected(forge_persistence(epsilon=SMALL, mu=("0", "1/1000")), "not in the range")
    rejected(forge_persistence(epsilon=("0", "1/1000"), mu=SMALL), "not in the range")


def test_the_fixed_point_is_the_one_continued(damped):
    """P* of the mirror orbit, with the range of the other one, is refused."""
    mirror = forge_periodic("damped", theorem="persistence", orbit=("0.5592", "1.067"))
    mirror["claims"]["range"] = damped["claims"]["range"]
    mirror["hints"]["cells"] = damped["hints"]["cells"]
    rejected(mirror, "one continued")


def test_other_orbits_do_not_persist(damped):
    """An orbit with turns, a saddle of hits, an orbit over two periods."""
    for name, why in (("focus", "not a hit"), ("double", "period is not 1")):
        certificate = forge_periodic(name, theorem="persistence")
        certificate["claims"]["range"] = damped["claims"]["range"]
        certificate["hints"]["cells"] = [
            cell | {"events": certificate["hints"]["events"]} for cell in damped["hints"]["cells"]
        ]
        rejected(certificate, why)
    saddle = forge_periodic("damped", theorem="persistence", orbit=("0.3435", "0.7753"))
    assert saddle["claims"]["type"] == "saddle"
    saddle["claims"]["range"] = damped["claims"]["range"]
    saddle["hints"]["cells"] = damped["hints"]["cells"]
    rejected(saddle, "neither a sink nor elliptic")


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("claims", "range", "epsilon"), ["0", "1/2000"], "as many rectangles"),
        (("claims", "range", "epsilon"), ["0"], "list of 2"),
        (("claims", "range", "boxes"), [], "list of 4"),
        (("hints", "cells"), [], "list of 1 to 768"),
        (("claims", "range"), [], "not an object"),
        (("cites",), [], "cites"),
    ],
    ids=str,
)
def test_the_form(damped, path, value, why):
    """Grids, boxes and cells that do not match are refused."""
    rejected(changed(damped, *path, value), why)


@pytest.mark.parametrize("name", ["e", "mu"])
def test_other_parameters(damped, name):
    """The orbit at other losses is another."""
    value = Fraction(damped["parameters"][name]) - Fraction(1, 10**9)
    with pytest.raises(Rejected):
        verify(changed(damped, "parameters", name, decimal(value)))


def test_words_and_macros(damped):
    """The line states the range; the boxes are printed as they are."""
    certificate = check(encode(damped), lambda _: None)
    line = words(certificate)
    for part in ("0 <= epsilon <= 1/1000 and 0 <= mu <= 1/1000", "analytic", "epsilon)^4"):
        assert part in line
    box = damped["claims"]["range"]["boxes"][1]["v"]
    expected = f"\\newcommand{{\\capARangeBoxesTwoV}}{{[{', '.join(box)}]}}"
    assert expected in list(macros(certificate, "a", 5))


def test_the_schema(damped):
    """The JSON Schema describes these certificates exactly."""
    fits_the_schema(damped)
