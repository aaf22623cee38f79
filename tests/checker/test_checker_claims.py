"""Each number claimed is compared at both ends and for its width; conclusions need all of it."""

from __future__ import annotations

from fractions import Fraction

import pytest

from checker.altered import changed, decimal, leaves, rejected, verify
from checker.forge import forge
from checker.parts import Theorem

pytestmark = pytest.mark.usefixtures("orbits_computed_once")


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
        parameters=parameters,
        orbit=("10.027988984", "5.41943306"),
        box_radius="0.02",
        digits=9,
        order=5,
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
    units["higher_twists"] = 1 / (R**2 * w) ** 2
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


# the conclusions, also for numbers that cannot be reached with true enclosures


@pytest.fixture
def uncompared(monkeypatch):
    """No claim is compared with what is computed: only what follows from the claims can fail."""
    monkeypatch.setattr(Theorem, "compare", lambda *_: None)


def replaced(certificate, claims):
    """Return a certificate with other claims."""
    return {**certificate, "claims": certificate["claims"] | claims}


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"least_speed": ["0", "1"]}, "least speed"),
        ({"least_speed": ["-1", "1"]}, "least speed"),
    ],
    ids=str,
)
def test_conclusions_of_both(good, saddle, uncompared, claims, why):
    """A least speed for which no theorem follows."""
    for certificate in (good, saddle):
        verify(certificate)
        rejected(replaced(certificate, claims), why)


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"trace": ["2", "3"]}, "trace"),
        ({"trace": ["-3", "-2"]}, "trace"),
        ({"multipliers": [["1", "2"], ["1/3", "1/2"]]}, "outer"),
        ({"multipliers": [["-2", "-1"], ["1/3", "1/2"]]}, "outer"),
        ({"multipliers": [["2", "3"], ["1/3", "1"]]}, "inner"),
        ({"multipliers": [["2", "3"], ["-1", "1/2"]]}, "inner"),
    ],
    ids=str,
)
def test_conclusions_of_hyperbolicity(saddle, uncompared, claims, why):
    """A trace or multiplier that touches the boundary is not enough; one below -1 is."""
    verify(
        replaced(saddle, {"trace": ["-3", "-2.1"], "multipliers": [["-2", "-1.1"], ["-1/2", "0"]]})
    )
    rejected(replaced(saddle, claims), why)


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"trace": ["-1", "2"]}, "trace"),
        ({"trace": ["-2", "1"]}, "trace"),
        ({"twist": ["0", "1"]}, "twist does"),
        ({"twist": ["-1", "0"]}, "twist does"),
    ],
    ids=str,
)
def test_conclusions_of_ellipticity(good, uncompared, claims, why):
    """Trace or twist at the boundary are not enough."""
    verify(good)
    rejected(replaced(good, claims), why)


@pytest.mark.parametrize("name", ["0", "1/4", "1/3", "1/2"])
def test_each_resonance_counts(good, uncompared, name):
    """A distance that may vanish is not enough, whichever it is."""
    path = "claims", "resonance_distances", name
    rejected(changed(good, *path, ["0", "1"]), "resonance distance is not positive")
