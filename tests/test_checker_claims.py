"""Each number claimed is compared at both ends and for its width; conclusions need all of it."""

from __future__ import annotations

from fractions import Fraction

import pytest
from checker.altered import changed, decimal, encode, leaves, rejected, verify
from checker.forge import forge

from cap.checker.certificate import read
from cap.checker.reading import Enclosure
from cap.checker.rejection import Rejected
from cap.checker.theorem import Elliptic, Saddle


def enclosures(certificate):
    """Return the path and the value of every claimed enclosure but the box."""
    return [(p, v) for p, v in leaves(certificate["claims"]) if p[0] != "box"]


@pytest.mark.parametrize("theorem", ["elliptic", "saddle"])
def test_every_claim_is_compared_at_both_ends_and_for_its_width(theorem, good, saddle):
    """Either end moved past the truth, in or out, and both moved apart, are noticed everywhere."""
    certificate = good if theorem == "elliptic" else saddle
    for path, (lower, upper) in enclosures(certificate):
        a, b = Fraction(lower), Fraction(upper)
        middle, width = (a + b) / 2, b - a
        for low, high, why in (
            (a, a + width / 8, "contain"),
            (b - width / 8, b, "contain"),
            (a - width, a, "contain"),
            (b, b + width, "contain"),
            (a - 20 * width * max(1, abs(middle)), b + 20 * width * max(1, abs(middle)), "wider"),
        ):
            rejected(changed(certificate, "claims", *path, [decimal(low), decimal(high)]), why)


def test_the_width_rule_is_sharp(good):
    """The unit of x is R = 2, so the width may be 2e-30 at 30 digits."""
    lower = Fraction(good["claims"]["x"][0])
    for excess, fine in ((0, True), (Fraction(1, 10**40), False)):
        claim = [decimal(lower), decimal(lower + Fraction(2, 10**30) + excess)]
        certificate = changed(good, "claims", "x", claim)
        if fine:
            verify(certificate)
        else:
            rejected(certificate, "wider")


def test_each_comparison_uses_its_unit():
    """In a system with R = 200, omega = 1/10, widths that the unit allows exactly are accepted."""
    parameters = {"F": "1", "omega": "1/10", "f": "2/5", "l": "-100", "r": "100"}
    R, w = Fraction(200), Fraction(1, 10)
    certificate = forge(
        parameters=parameters, orbit=("10.027988984", "5.41943306"), box_radius="0.02", digits=9
    )
    units = {
        "x": R,
        "v": R * w,
        "hit_times": 1 / w,
        "hit_speeds": R * w,
        "least_speed": R * w,
        "hit_forcing": 1,
    }
    units |= {"twist": 1 / (R**2 * w), "twist_action": 1 / (R**2 * w)}
    for path, (lower, upper) in enclosures(certificate):
        unit = units.get(path[0], 1)
        if path[0] == "jacobian":
            unit = {(0, 1): 1 / w, (1, 0): w}.get(path[1:], 1)
        if path[0] == "taylor":
            i, j = (int(n) for n in path[2].split(","))
            unit = (R if path[1] == "x" else R * w) / R**i / (R * w) ** j
        a, b = Fraction(lower), Fraction(upper)
        allowed = max(abs(a), abs(b), unit) / 10**9
        middle = (a + b) / 2
        fine = [decimal(middle + side * allowed * Fraction(49, 100)) for side in (-1, 1)]
        wide = [decimal(middle + side * allowed * Fraction(51, 100)) for side in (-1, 1)]
        verify(changed(certificate, "claims", *path, fine))
        rejected(changed(certificate, "claims", *path, wide), "wider")


# the conclusions, for numbers that cannot be reached with true enclosures


def proof(certificate, **claims):
    """Return the proof of a certificate of which some claims are replaced."""
    theorem = {"elliptic": Elliptic, "saddle": Saddle}[certificate["theorem"]]
    result = theorem(read(encode(certificate)), lambda _: None)
    for name, value in claims.items():
        result.claims[name] = value
    return result


def pair(lower, upper):
    """Return an enclosure with these ends."""
    return Enclosure(Fraction(lower), Fraction(upper), (str(lower), str(upper)))


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"hit_times": [pair(0, 1), pair(2, 3)]}, "not positive"),
        ({"hit_times": [pair(1, 2), pair(2, 3)]}, "increasing"),
        ({"hit_times": [pair(1, 2), pair("5/2", "6.29")]}, "before T"),
        ({"hit_speeds": [pair(1, 2), pair(0, 1)]}, "hit speed"),
        ({"least_speed": pair(0, 1)}, "least speed"),
        ({"determinant": pair("1.001", "1.002")}, "determinant"),
        ({"determinant": pair("0.998", "0.999")}, "determinant"),
    ],
    ids=str,
)
def test_conclusions_of_both(good, claims, why):
    """Hit times, speeds and determinant for which no theorem follows, one at a time."""
    proof(good).conclusion_of_both()
    with pytest.raises(Rejected, match=why):
        proof(good, **claims).conclusion_of_both()


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"trace": pair(2, 3)}, "trace"),
        ({"trace": pair(-3, -2)}, "trace"),
        ({"multipliers": [pair(1, 2), pair("1/3", "1/2")]}, "outer"),
        ({"multipliers": [pair(-2, -1), pair("1/3", "1/2")]}, "outer"),
        ({"multipliers": [pair(2, 3), pair("1/3", 1)]}, "inner"),
        ({"multipliers": [pair(2, 3), pair(-1, "1/2")]}, "inner"),
    ],
    ids=str,
)
def test_conclusions_of_hyperbolicity(saddle, claims, why):
    """A trace or multiplier that touches the boundary is not enough."""
    proof(saddle).hyperbolicity()
    with pytest.raises(Rejected, match=why):
        proof(saddle, **claims).hyperbolicity()


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"trace": pair(-1, 2)}, "trace"),
        ({"trace": pair(-2, 1)}, "trace"),
        ({"rotation_angle": pair(-1, 0)}, "exclude 0"),
        ({"rotation_angle": pair(0, 1)}, "exclude 0"),
        ({"rotation_angle": pair(1, "3.1416")}, "rotation angle"),
        ({"rotation_angle": pair("-3.1416", -1)}, "rotation angle"),
        ({"rotation_number": pair(0, "1/3")}, "rotation number"),
        ({"rotation_number": pair("1/3", "1/2")}, "rotation number"),
        ({"resonance_distances": {"0": pair(1, 1), "1/4": pair(0, 1)}}, "resonance"),
        ({"twist": pair(0, 1)}, "twist does"),
        ({"twist": pair(-1, 0)}, "twist does"),
        ({"twist_action": pair(-1, 1)}, "twist_action does"),
    ],
    ids=str,
)
def test_conclusions_of_ellipticity(good, claims, why):
    """Trace, angle, number, distance or twist at the boundary are not enough."""
    proof(good).ellipticity()
    with pytest.raises(Rejected, match=why):
        proof(good, **claims).ellipticity()
