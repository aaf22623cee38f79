"""Two masses at other F, omega and masses: the stored saddle is verified in these units."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

from checker.altered import changed, rejected, verify

STORED = Path(__file__).parents[2] / "certificates/particles_saddle.json"
F, OMEGA, MASS = Fraction(3), Fraction(2), Fraction(2)
LENGTH, TIME = F / (MASS * OMEGA**2), 1 / OMEGA
SPEED = LENGTH * OMEGA
UNITS = {"t": TIME, "x": LENGTH, "v1": SPEED, "v2": SPEED}
UNKNOWNS, DEFECTS = (TIME, LENGTH, SPEED, SPEED), (LENGTH, LENGTH, SPEED, SPEED)


def times(value, unit):
    """Return numbers in another unit."""
    if isinstance(value, list):
        return [times(part, unit) for part in value]
    return str(Fraction(value) * unit)


def rescaled():
    """Return the stored certificate at other parameters."""
    certificate = json.loads(STORED.read_text("utf-8"))
    p, claims, hints = (certificate[name] for name in ("parameters", "claims", "hints"))
    for name, unit in (("F", F), ("f", F), ("omega", OMEGA), ("l", LENGTH), ("r", LENGTH)):
        p[name] = times(p[name], unit)
    p["masses"] = times(p["masses"], MASS)
    for contact in claims["box"]:
        contact.update({name: times(contact[name], UNITS[name]) for name in UNITS})
    for name, unit in (
        ("x", LENGTH),
        ("v", SPEED),
        ("hit_times", TIME),
        ("closing_speeds", SPEED),
        ("least_speeds", SPEED),
    ):
        claims[name] = times(claims[name], unit)
    states = LENGTH, LENGTH, SPEED, SPEED
    claims["monodromy"] = [
        [times(entry, one / other) for entry, other in zip(row, states, strict=True)]
        for row, one in zip(claims["monodromy"], states, strict=True)
    ]
    hints["centre"] = [
        [times(c, unit) for c, unit in zip(contact, UNKNOWNS, strict=True)]
        for contact in hints["centre"]
    ]
    hints["preconditioner"] = [
        [times(c, UNKNOWNS[i % 4] / DEFECTS[j % 4]) for j, c in enumerate(row)]
        for i, row in enumerate(hints["preconditioner"])
    ]
    return certificate


def test_a_saddle_in_other_units():
    """It is verified; what has a unit is not the same number as before."""
    certificate = rescaled()
    verify(certificate)
    stored = json.loads(STORED.read_text("utf-8"))["claims"]
    for name in ("x", "hit_times", "least_speeds", "closing_speeds"):
        lie = changed(certificate, "claims", name, stored[name])
        rejected(lie, "does not contain|not increasing|not before")
