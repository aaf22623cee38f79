"""The width rule knows the unit of each claim: in a system of other units, to one part in fifty."""

from __future__ import annotations

from fractions import Fraction

import pytest

from checker.altered import changed, decimal, leaves, rejected, verify
from checker.forge import forge
from checker.forge_capture import forge_capture
from checker.forge_hybrid import forge_periodic
from checker.forge_impact import forge_branch, forge_pitchfork, forge_symmetric

pytestmark = pytest.mark.usefixtures("pairs_computed_once", "orbits_computed_once")

# R omega^2/F = 2 and f/F = 2/5, as in the paper, but all units differ
R, OMEGA, FORCE = Fraction(10**4), Fraction(1, 10), Fraction(50)
WALLS = {"F": "50", "omega": "1/10", "l": "-5000", "r": "5000"}
UNITS = {
    "x": R,
    "v": R * OMEGA,
    "hit_times": 1 / OMEGA,
    "event_times": 1 / OMEGA,
    "release_time": 1 / OMEGA,
    "half_trace_slope": 1 / FORCE,
    "velocity": R * OMEGA,
    **dict.fromkeys(("hit_speed", "hit_speeds", "least_speed"), R * OMEGA),
    **dict.fromkeys(("f", "f_start", "curvature", "saddle_center", "pitchfork"), FORCE),
    **dict.fromkeys(("minus_identity", "hit_forcing"), FORCE),
}


def unit_of(path):
    """Return the unit of the claim at a path."""
    if path[0] == "jacobian":
        return {(0, 1): 1 / OMEGA, (1, 0): OMEGA}.get(path[1:], 1)
    words = [word for word in path if word in UNITS and word != "pitchfork"] or list(path[:1])
    return UNITS.get(words[-1], 1)


def widths(certificate, skipped=()):
    """Check that a claim may be as wide as its unit and digits allow, and no wider."""
    digits = int(certificate["digits"])
    for path, (lower, upper) in leaves(certificate["claims"]):
        if path[0] in skipped:
            continue
        a, b = Fraction(lower), Fraction(upper)
        middle = (a + b) / 2
        size = max(abs(a), abs(b), Fraction(unit_of(path))) / 10**digits
        for part, fine in ((Fraction(49, 100), True), (Fraction(51, 100), False)):
            ends = [decimal(middle + side * size * part) for side in (-1, 1)]
            altered = changed(certificate, "claims", *path, ends)
            if fine:
                verify(altered)
            else:
                rejected(altered, "wider")


def test_symmetric():
    """Both orbits, the values of f, and the roots of the paper's equation."""
    widths(forge_symmetric(WALLS | {"f": "20"}, 9))


def test_pitchfork():
    """The orbit and the derivatives."""
    widths(forge_pitchfork(WALLS, 9))


def test_saddle():
    """Trace, multipliers and the orbit."""
    parameters, orbit = WALLS | {"f": "20"}, ("1717.6303", "387.65975")
    options = {"orbit": orbit, "digits": 9, "box_radius": "1"}
    widths(forge("saddle", parameters=parameters, **options), ("box",))


def test_periodic():
    """A sink with turns, and a node."""
    parameters = WALLS | {"F": "150", "f": "20", "e": "9/10", "mu": "1/100"}
    orbit = ("2000", "-300")
    certificate = forge_periodic("focus", parameters=parameters, orbit=orbit, radius="1", digits=9)
    widths(certificate, ("box", "basin"))


def test_capture():
    """The time of the release."""
    parameters, box = WALLS | {"f": "20", "e": "1", "mu": "0"}, (("4990", "5000"), ("-10", "10"))
    certificate = forge_capture(parameters=parameters, box=box, held=("5",), digits=9)
    widths(certificate, ("box", "itinerary", "event_times", "forcing", "accumulation_time"))


@pytest.fixture(scope="module")
def branch():
    """Return a valid certificate: unsigned, then a zero of the twist, then signed cells."""
    return forge_branch(WALLS, first="0.34", width="0.03")


def test_branch(branch):
    """What is claimed of a number."""
    names = ("f_end", "trace_end", "f_range", "resonances", "twist_zeros", "exceptions", "cells")
    widths(branch, names)


@pytest.mark.parametrize(
    ("path", "unit", "digits"),
    [
        (("cells", 3, "f"), FORCE, 6),
        (("cells", 3, "trace"), 1, 6),
        (("cells", 3, "least_speed"), R * OMEGA, 6),
        (("twist_zeros", 0), FORCE, 6),
        (("f_end",), FORCE, 10),
        (("trace_end",), 1, 10),
        (("resonances", 0, "f"), FORCE, 10),
    ],
    ids=str,
)
def test_what_is_taken_on_a_cell(branch, path, unit, digits):
    """Each end of a claim may be beyond what is taken by as much as unit and digits allow."""
    claim = branch["claims"]
    for key in path:
        claim = claim[key]
    a, b = map(Fraction, claim)
    room = max(abs(a), abs(b), Fraction(unit)) / Fraction(10) ** digits
    for part, fine in ((Fraction(2, 5), True), (Fraction(11, 10), False)):
        for ends in ((a - room * part, b), (a, b + room * part)):
            altered = changed(branch, "claims", *path, [decimal(q) for q in ends])
            if fine:
                verify(altered)
            else:
                rejected(altered, "is wider than")
