"""The box, the square S and the disk of the remainder: each wrong one is refused for its reason."""

from __future__ import annotations

import copy
from fractions import Fraction

import pytest

from cap.checker.kernel.rejection import Rejected
from checker.altered import changed, decimal, encode, rejected, verify
from checker.parts import Centred, Elliptic, Jet, read

pytestmark = pytest.mark.usefixtures("orbits_computed_once")


def test_the_box_must_be_between_the_walls(good):
    """A box that touches either wall is refused."""
    rejected(changed(good, "claims", "box", "x", ["0.09", "1"]), "between the walls")
    rejected(changed(good, "claims", "box", "x", ["-1", "0.11"]), "between the walls")


def test_the_box_must_not_contain_rest(good):
    """A box with v = 0 at its edge or inside is refused."""
    rejected(changed(good, "claims", "box", "v", ["0", "0.55"]), "velocity vanishes in the box")
    rejected(changed(good, "claims", "box", "v", ["-0.1", "0.55"]), "velocity vanishes in the box")


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("side", [-1, 1])
def test_the_centre_must_lie_in_the_box(good, axis, side):
    """A box beside the centre, on each of four sides, is refused."""
    name = "xv"[axis]
    centre = Fraction(good["hints"]["centre"][axis])
    ends = sorted((centre + side * Fraction(1, 10**6), centre + side * Fraction(1, 500)))
    rejected(changed(good, "claims", "box", name, [decimal(q) for q in ends]), "centre")


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("side", [-1, 1])
def test_the_square_must_lie_in_the_box(good, axis, side):
    """The centre is in the box and K(box) is inside, but S reaches over one side."""
    certificate, reach = changed(good, "hints", "radius", "0.0001"), Fraction(11, 100000)
    for n, name in enumerate("xv"):
        centre = Fraction(good["hints"]["centre"][n])
        ends = [centre - reach, centre + reach]
        if n == axis:
            ends[(side + 1) // 2] = centre + side * Fraction(1, 20000)
        certificate["claims"]["box"][name] = [decimal(q) for q in ends]
    rejected(certificate, "S is not in the box")


def test_a_box_that_is_too_large(good):
    """Moderately: K is not inside; then the windows do not hold all hits."""
    box = {"x": ["0.08", "0.12"], "v": ["0.52", "0.56"]}
    windows = [["1.03", "1.17"], ["3.3", "3.7"]]
    rejected(
        changed(changed(good, "claims", "box", box), "hints", "hit_times", windows), "interior"
    )
    rejected(changed(good, "claims", "box", box), "wall may")


def test_a_box_without_a_fixed_point(good):
    """A box moved off P*, with windows that fit, fails Krawczyk's inclusion."""
    shift = Fraction(1, 100)
    certificate = copy.deepcopy(good)
    for n, name in enumerate("xv"):
        ends = [Fraction(q) + shift for q in good["claims"]["box"][name]]
        certificate["claims"]["box"][name] = [decimal(q) for q in ends]
        certificate["hints"]["centre"][n] = decimal(sum(ends) / 2)
    certificate["hints"]["hit_times"] = [["1.04", "1.12"], ["3.45", "3.65"]]
    rejected(certificate, "interior")


@pytest.mark.parametrize("n", [0, 1])
@pytest.mark.parametrize("m", [0, 1])
def test_a_bad_preconditioner(good, n, m):
    """Any one entry of C spoiled: the inclusion fails."""
    rejected(changed(good, "hints", "preconditioner", n, m, "5"), "interior")


def test_a_square_that_does_not_hold_the_fixed_point(good):
    """S moved by 1e-20, more than its size: the inclusion fails."""
    centre = decimal(Fraction(good["hints"]["centre"][0]) + Fraction(1, 10**20))
    rejected(changed(good, "hints", "centre", 0, centre), "interior")


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("name", ["x", "v"])
def test_the_interior_at_each_side(good, name, side):
    """A box around S that ends just beyond the fixed point on one side: K(box) reaches over it."""
    certificate = copy.deepcopy(good)
    n = "xv".index(name)
    value = Fraction(good["claims"][name][0])
    ends = [value - Fraction(1, 1000), value + Fraction(1, 1000)]
    ends[side] = value + Fraction(side * 2 - 1, 10**9)
    certificate["claims"]["box"][name] = [decimal(q) for q in ends]
    rejected(certificate, "interior")
    certificate["hints"]["centre"][n] = decimal(sum(ends) / 2)
    rejected(certificate, "interior")


# the remainder


@pytest.mark.parametrize("component", ["x", "v"])
def test_the_remainder_must_be_large_enough(good, component):
    """A quarter of the bound claimed is too small, for x and for v."""
    bound = Fraction(good["claims"]["remainder"][component])
    rejected(
        changed(good, "claims", "remainder", component, decimal(bound / 4, 80)),
        f"remainder of {component}",
    )


@pytest.mark.parametrize("component", ["x", "v"])
def test_the_remainder_to_the_last_digit(good, component, monkeypatch):
    """What is claimed may be Lagrange's bound times the radius^(order + 1), but no less."""
    computed, found = Elliptic.lagrange, []
    monkeypatch.setattr(Elliptic, "lagrange", lambda *q: found.append(computed(*q)) or found[-1])
    verify(good)
    radius = Fraction(good["claims"]["remainder"]["radius"])
    bound = found["xv".index(component)].upper * radius**4
    path = "claims", "remainder", component
    verify(changed(good, *path, str(bound)))
    rejected(changed(good, *path, str(bound * (1 - Fraction(1, 10**30)))), "remainder of")


def test_the_form_of_lagrange(good):
    """The sum of |c_ij| sqrt(i^i j^j / n^n) over i + j = n, for c_ij of either sign, by hand."""
    proof = Elliptic(read(encode(good)), print)
    one = proof.number(Fraction(1))
    jet = Jet(2, {(0, 0): one * 0, (2, 0): one * -3, (1, 1): one * 8, (0, 2): one * -5})
    result = proof.lagrange(Centred(jet, jet, (one - one, one - one)), 2)
    assert abs(result.upper - 12) + abs(result.lower - 12) < Fraction(1, 10**30)


def test_the_remainder_disk(good):
    """Radius zero or negative, another degree, and a disk larger than the box are refused."""
    rejected(changed(good, "claims", "remainder", "radius", "0"), "radius")
    rejected(changed(good, "claims", "remainder", "radius", "-0.0001"), "radius")
    rejected(changed(good, "claims", "remainder", "degree", "5"), "degree")
    rejected(changed(good, "claims", "remainder", "radius", "0.0021"), "in the box")


@pytest.mark.parametrize("name", ["x", "v"])
def test_the_remainder_disk_lies_in_the_box_on_all_sides(good, name):
    """A box that cuts the disk on any one of four sides is refused."""
    value = Fraction(good["claims"][name][0])
    for ends in ((Fraction(1, 20000), Fraction(1, 500)), (Fraction(1, 500), Fraction(1, 20000))):
        certificate = copy.deepcopy(good)
        certificate["claims"]["box"][name] = [decimal(value - ends[0]), decimal(value + ends[1])]
        other = "xv"[name == "x"]
        middle = Fraction(good["claims"][other][0])
        reach = Fraction(11, 100000)
        certificate["claims"]["box"][other] = [decimal(middle - reach), decimal(middle + reach)]
        with pytest.raises(Rejected, match=r"in the box|interior"):
            verify(certificate)
