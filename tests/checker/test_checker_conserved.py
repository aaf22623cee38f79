"""The exact product of two multipliers, and which orbits are elliptic."""

from __future__ import annotations

from copy import deepcopy
from fractions import Fraction
from functools import cache

import pytest
from own_systems import CASES, certificate

from cap.certificate.writer import dumps
from cap.checker.kernel.certificate import read as parsed
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.conserved import product_of_two
from cap.checker.system.model import Guard, Mode, Model
from cap.checker.system.polynomial import ONE, variable
from cap.checker.theorems.contacts import Contacts
from cap.checker.verdict import check, words
from cap.orbits import conserved
from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs.contacts import prove
from cap.system.files import read


def model(given):
    """Return the system of a certificate as the checker reads it."""
    return Contacts(parsed(dumps(given).encode()), lambda _: None).p


def contacts(given):
    """Return its contacts."""
    return [tuple(contact.values()) for contact in given["claims"]["contacts"]]


@cache
def ball(e):
    """Return the certificate of the ball that bounces once, with a restitution."""
    system = read("examples/ball.py", {"A": "6/5", "e": e})
    guess = [0.51, 0.58, -3.14]
    return prove(Itinerary(system, [Contact("fly", "table", "fly")]), guess)


@pytest.mark.parametrize("e", ["1/2", "2/3"])
def test_the_ball(e):
    """The product is e squared, and lies in what is claimed."""
    given = ball(e)
    exact = product_of_two(model(given), contacts(given))
    assert exact == Fraction(e) ** 2
    low, high = map(Fraction, given["claims"]["symmetric"][1])
    assert low <= exact <= high
    assert "kind" not in given["claims"]


def test_prover_and_checker_agree():
    """1 for the oscillator; none for a spring with damping, and for two masses."""
    for name, expected in (
        ("elliptic", 1),
        ("spring", None),
        ("two masses", None),
        ("ball", "1/4"),
    ):
        given = certificate(name)
        value = None if expected is None else Fraction(expected)
        assert product_of_two(model(given), contacts(given)) == value
        assert conserved.product_of_two(CASES[name]()[0]) == value


def test_a_reset_that_stretches():
    """In a spring, (x, v) -> 2 (x, v): areas by 4; with a divisor it is not found."""
    x, v = variable("x"), variable("v")
    reset = {"x": x * 2, "v": v * 2}
    for divisor, expected in ((ONE, 4), (ONE * 2, None)):
        guard = Guard(x + v, reset, ("fly",), divisor)
        system = Model(("x", "v"), Fraction(1), {"fly": Mode({"x": v, "v": -x}, {"hit": guard})})
        assert product_of_two(system, [("fly", "hit", "fly")]) == expected


def test_elliptic():
    """It is said, and claimed of nothing else."""
    given = certificate("elliptic")
    assert given["claims"]["kind"] == "elliptic"
    said = words(check(dumps(given).encode(), lambda _: None))
    assert said.endswith(
        "their product is 1 exactly and they lie on the unit circle; it is elliptic"
    )
    for name in ("spring", "two masses", "ball"):
        other = certificate(name)
        other["claims"]["kind"] = "elliptic"
        rejected(other, "the product of the multipliers is not found to be 1")


def test_a_saddle_is_not_elliptic():
    """Of the same system, with another pair of hits: the trace is 3.4."""
    itinerary = CASES["elliptic"]()[0]
    saddle = prove(itinerary, [0.67939, 1.0, 1.13188, 3.82098, -1.0, -1.13188])
    assert saddle["claims"]["unstable"] == "1"
    changed = deepcopy(saddle)
    changed["claims"]["kind"] = "elliptic"
    rejected(changed, "the sum of the multipliers may be 2 or more in size")


def rejected(given, reason):
    """Check that a certificate is rejected for this reason."""
    with pytest.raises(Rejected, match=reason):
        check(dumps(given).encode(), lambda _: None)
