"""The theorem ``persistence``: one analytic family of fixed points over a range of losses."""

from __future__ import annotations

import copy
from fractions import Fraction
from types import SimpleNamespace

import pytest

from cap.certificate.latex import macros
from cap.checker.flow.losses import INVERSE, Lossy
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet
from cap.checker.verdict import words
from checker.altered import changed, decimal, encode, fits_the_schema, rejected, verify
from checker.forge_hybrid import forge_periodic, forge_persistence
from checker.parts import Enclosure, Persistence, Rejected, read

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

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


@pytest.mark.parametrize(("mu", "why"), [("1/1000", "K does not lie"), ("1/20", "wall may not be")])
def test_viscosity_counts(mu, why):
    """Without viscosity one box holds the orbit for all mu; its fixed point moves with mu."""
    short = ("0", "1/100000")
    certificate = forge_persistence("elliptic", epsilon=short, mu=short)
    verify(certificate)
    rejected(changed(certificate, "claims", "range", "mu", ["0", mu]), why)


# one function: the rectangles are 0 and 1 in the first row, 2 and 3 in the second


def continued(continuation, places, fixed_point, **losses):
    """Try whether fixed points in boxes at some places are one function.

    A place is the middle of a box of half-width 1, where its fixed point is, or None: then the box
    contains all places, and its fixed point is at the first.
    """
    proof, _ = continuation
    altered = copy.copy(proof)
    altered.p = proof.p._replace(**{name: F(value) for name, value in losses.items()})
    sides = [
        [(-99, 99) if place is None else (place[k] - 1, place[k] + 1) for place in places]
        for k in (0, 1)
    ]
    boxes = [
        {
            name: Enclosure(F(side[n][0]), F(side[n][1]), ("", ""))
            for name, side in zip("xv", sides, strict=True)
        }
        for n in range(4)
    ]
    altered.claims = proof.claims | {"range": proof.claims["range"] | {"boxes": boxes}}
    images = iter([[proof.number(F(z)) for z in place or (0, 0)] for place in places])
    altered.rectangle = lambda *_: next(images)
    altered.continuation([proof.number(F(z)) for z in fixed_point])


@pytest.mark.parametrize("shift", [(3, 0), (-3, 0), (0, 3), (0, -3)], ids=str)
@pytest.mark.parametrize("edge", [(0, 1), (2, 3), (0, 2), (1, 3)], ids=str)
def test_neighbours_must_agree(continuation, edge, shift):
    """On each edge, and in each coordinate: one of the fixed points lies in the other's box."""
    here = (0, 0)
    places = [{edge[0]: here, edge[1]: shift}.get(n) for n in range(4)]
    with pytest.raises(Rejected, match="common edge"):
        continued(continuation, places, here)
    for n in edge:
        wider = [*places[:n], None, *places[n + 1 :]]
        continued(continuation, wider, wider[3] or here)
    places[edge[1]] = (shift[0] / 3, shift[1] / 3)  # it touches
    continued(continuation, places, here)


@pytest.mark.parametrize(
    ("losses", "around"),
    [
        ({"e": "1", "mu": "0"}, [0]),
        ({"e": "1", "mu": "1/1000"}, [1]),
        ({"e": "999/1000", "mu": "0"}, [2]),
        ({"e": "999/1000", "mu": "1/1000"}, [3]),
        ({"e": "1", "mu": "1/2000"}, [0, 1]),
        ({"e": "1999/2000", "mu": "1/1000"}, [1, 3]),
        ({"e": "1999/2000", "mu": "1/2000"}, [0, 1, 2, 3]),
    ],
    ids=str,
)
@pytest.mark.parametrize("beside", [(2, 0), (0, 2), (-2, 0), (0, -2)], ids=str)
def test_the_fixed_point_is_in_a_box_of_its_losses(continuation, losses, around, beside):
    """It may lie in one box of several, but must not lie in those of other losses alone."""
    places = [(0, 0)] * 4
    continued(continuation, places, (1, -1), **losses)
    with pytest.raises(Rejected, match="one continued"):
        continued(continuation, places, beside, **losses)
    for n in range(4):
        only = [None if n == m else (0, 0) for m in range(4)]
        if n in around:
            continued(continuation, only, beside, **losses)
        else:
            with pytest.raises(Rejected, match="one continued"):
                continued(continuation, only, beside, **losses)


@pytest.mark.parametrize("losses", [("998/1000", "0"), ("1", "2/1000"), ("998/1000", "2/1000")])
def test_losses_beyond_the_range(continuation, losses):
    """Both e and mu must be in the range."""
    with pytest.raises(Rejected, match="not in the range"):
        continued(continuation, [None] * 4, (0, 0), **dict(zip(("e", "mu"), losses, strict=True)))


def test_stability_on_every_rectangle(continuation, monkeypatch):
    """If 1 + determinant were below |trace|, about 0.44, the range would be refused."""
    proof, fixed_point = continuation
    for det, fine in (("-0.5", True), ("-0.6", False)):
        value = proof.number(Fraction(det)).with_bits(64)
        monkeypatch.setattr(
            "cap.checker.theorems.persistence.determinant", lambda _, value=value: value
        )
        if fine:
            proof.continuation(fixed_point)
        else:
            with pytest.raises(Rejected, match="may fail in a rectangle"):
                proof.continuation(fixed_point)


@pytest.mark.slow
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
        (("claims", "range", "boxes"), [], "list of 1 to"),
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
    certificate = read(encode(damped))
    line = words(certificate)
    for part in ("0 <= epsilon <= 1/1000 and 0 <= mu <= 1/1000", "analytic", "epsilon)^4"):
        assert part in line
    box = damped["claims"]["range"]["boxes"][1]["v"]
    expected = f"\\newcommand{{\\capARangeBoxesTwoV}}{{[{', '.join(box)}]}}"
    assert expected in list(macros(certificate, "a", 5))


def test_the_schema(damped):
    """The JSON Schema describes these certificates exactly."""
    fits_the_schema(damped)


def test_what_a_drag_is_divided_by():
    """1/(mu^2 + omega^2), of a drag that is a parameter."""
    m, z = (Interval.enclosing(Fraction(a), Fraction(b), 96) for a, b in (("1/2", "1/2"), (0, 1)))
    centre, box = (Jet(1, {(0,): q, (1,): q.integer(1)}) for q in (m, z))
    mu = Centred(centre.truncated(0), box, [z - m])
    given = SimpleNamespace(varying=lambda _: {"mu": mu})
    found = Lossy._parameters(given, SimpleNamespace(omega=Fraction(3)))[INVERSE]
    assert found.centre.constant.lower <= Fraction(4, 37) <= found.centre.constant.upper
    assert found.centre.constant.width < 100
    assert found.value.lower <= Fraction(1, 10)
    assert found.value.upper >= Fraction(1, 9)
