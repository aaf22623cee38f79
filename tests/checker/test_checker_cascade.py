"""The theorem ``cascade``: the chain rule, two doublings, and certificates that lie."""

from __future__ import annotations

import copy
import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.cascade import Cascade, Derivatives
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

pytestmark = pytest.mark.usefixtures("releases_computed_once")

STORED = json.loads((Path(__file__).parents[2] / "certificates/cascade-1.json").read_text("utf-8"))


def shortened(number):
    """Return the certificate of the first doublings alone."""
    short = copy.deepcopy(STORED)
    short["hints"]["cycles"] = short["hints"]["cycles"][:number]
    for name, length in (("parameters", number), ("places", number), ("ratios", number - 2)):
        short["claims"][name] = short["claims"][name][:length]
    return short


TWO = shortened(2)


def moved(pair, by):
    """Return an enclosure moved by a multiple of its width."""
    low, high = map(Fraction, pair)
    return [str(low + by * (high - low)), str(high + by * (high - low))]


def test_two_doublings():
    """They are verified; the schema describes the stored one; the line names periods and sides."""
    assert len(verify(TWO)) == 4
    fits_the_schema(STORED)
    line = words(read(encode(STORED)))
    for part in ("period 96", "for smaller f", "it is not claimed that the cycle of f_(k+1)"):
        assert part in line


def test_ratios_are_told_where_there_are_some():
    """Of two doublings there is none; of three there is one."""
    assert "ratio" not in words(read(encode(TWO)))
    three = words(read(encode(shortened(3))))
    ratio = "[" + ", ".join(STORED["claims"]["ratios"][0]) + "]"
    assert f"are in {ratio}; it is not claimed" in three
    assert "nor that the ratios converge" in three


def test_the_ratios_stored():
    """They are those of the six parameters; that all is verified, as `TWO` is, says CI."""
    f = [Fraction(a) for a, _ in STORED["claims"]["parameters"]]
    steps = [b - a for a, b in pairwise(f)]
    for (a, b), claim in zip(pairwise(steps), STORED["claims"]["ratios"], strict=True):
        assert float(a / b) == pytest.approx(float(Fraction(claim[0])), rel=1e-9)


def test_the_chain_rule():
    """Of y -> 1 - a y^2 twice, a = 1 + t, against the polynomial by hand."""

    def point(q):
        return Interval.enclosing(Fraction(q), Fraction(q), 64)

    def at(x, a):
        return Derivatives(*map(point, (-2 * a * x, -x * x, -2 * a, -2 * x, 0)))

    a, x = Fraction(3, 2), Fraction(1, 2)
    y = 1 - a * x * x
    found = at(y, a).after(at(x, a))
    expected = (
        4 * a * a * x * y,
        -y * y + 2 * a * y * x * x,
        4 * a * a * y - 8 * a**3 * x * x,
        8 * a * x * y - 4 * a * a * x**3,
        -24 * a**3 * x,
    )
    for value, number in zip(found, expected, strict=True):
        assert abs(value.lower - number) < Fraction(1, 2**50)


def test_the_rest_of_krawczyk():
    """Of (1 - C H') (Z - m), H' = (G' - 1, its derivative), by hand."""

    def thin(q):
        return Interval.enclosing(Fraction(q), Fraction(q), 64)

    D = Derivatives(*map(thin, (3, 5, 7, 11, 13)))
    reach, rows = [thin(17), thin(19)], ((2, 3), (4, 5))
    for n, (a, b) in enumerate(rows):
        one = [(k == n) - (a * x + b * y) for k, (x, y) in enumerate(((2, 7), (5, 11)))]
        found = Cascade.rest(None, n, [thin(a), thin(b)], D, reach)
        assert found.lower == found.upper == one[0] * 17 + one[1] * 19


@pytest.mark.parametrize("name", ["parameters", "places"])
def test_the_numbers(name):
    """None can be moved."""
    for n in range(2):
        for by in (3, -3):
            rejected(
                changed(TWO, "claims", name, n, moved(TWO["claims"][name][n], by)),
                "does not contain",
            )
    rejected(changed(TWO, "claims", name, 0, ["-1", "1"]), "wider")
    rejected(changed(TWO, "claims", name, TWO["claims"][name][:1]), "not a list")


def test_the_ratios():
    """They follow from the parameters."""
    three = shortened(3)
    claim = moved(three["claims"]["ratios"][0], 5)
    rejected(changed(three, "claims", "ratios", 0, claim), "ratios.* does not contain")
    rejected(changed(TWO, "claims", "ratios", [claim]), "not a list")


def test_the_period_and_the_direction():
    """Another number of points, a cycle followed twice, the other side."""
    rejected(changed(TWO, "claims", "direction", "up"), "may not pass -1 in the direction")
    rejected(changed(TWO, "claims", "period", "1"), "windows of cycle 1 are not 1")
    twice = copy.deepcopy(TWO)
    twice["claims"]["period"] = "6"
    for cycle in twice["hints"]["cycles"]:
        cycle["events"] *= 2
    rejected(twice, "period of a cycle may be smaller|K.Z. is not inside")
    rejected(changed(TWO, "claims", "half_periods", "4"), "takes another time")


def test_the_hints():
    """Another centre, a box too large or without interior, a matrix of zeros: nothing is proved."""
    path = "hints", "cycles", 0
    cycle = TWO["hints"]["cycles"][0]
    x = str(Fraction(cycle["centre"][0]) + Fraction(1, 10**9))
    rejected(changed(TWO, *path, "centre", 0, x), "K.Z. is not inside")
    rejected(changed(TWO, *path, "reach", 0, "0"), "no interior")
    rejected(changed(TWO, *path, "reach", ["1/10", "1/10"]), ".")
    zero = [["0", "0"], ["0", "0"]]
    rejected(changed(TWO, *path, "inverse", zero), "K.Z. is not inside")
    events = cycle["events"]
    rejected(changed(TWO, *path, "events", [*events[1:], events[0]]), ".")
    rejected(changed(TWO, *path, "events", 0, events[0][1:]), "windows are not lists")


@pytest.mark.parametrize("to", [lambda t: -t, lambda t: 4 - t, lambda t: t + 4])
def test_theta(to):
    """At -theta the mass is released where the force becomes too weak; beyond pi/2, f < 0."""
    path = "hints", "cycles", 0, "centre"
    theta = Fraction(TWO["hints"]["cycles"][0]["centre"][1])
    rejected(changed(TWO, *path, 1, str(to(theta))), "theta is not between 0 and pi/2")


def test_the_itinerary():
    """No other word, and a release at its end alone."""
    for n in range(6):
        rejected(changed(TWO, "claims", "itinerary", n, "hit l" if n != 1 else "hit r"), ".")
    rejected(changed(TWO, "hints", "bits", "4096"), "hints.bits is not between")
    rejected(changed(STORED, "hints", "bits", "1024"), "too much")


def test_a_degenerate_doubling():
    """Where derivatives may vanish, nothing is said of what branches off."""
    proof = Cascade(read(encode(TWO)), lambda _: None)
    found = proof.doubling(read(encode(TWO)).hints["cycles"][0])
    zero = found.x.integer(0)
    flat = found.derivatives._replace(xx=zero, xxx=zero)
    with pytest.raises(Rejected, match="may not attract"):
        proof.bifurcates(found._replace(derivatives=flat._replace(xt=-found.x.integer(1))))
    with pytest.raises(Rejected, match="may not pass"):
        proof.bifurcates(found._replace(derivatives=flat._replace(xt=zero)))
