"""The basin of `contacts`: motions in floats stay in it; each condition, broken, is a rejection."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from own_systems import certificate, rejected

from cap.certificate.writer import dumps
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.ellipsoid import contracts
from cap.checker.verdict import check, words
from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs.contacts import prove
from cap.system.files import read

CLOCK = {"f": 0, "d": "1/10", "k": 1}
A, E = 1.2, 0.5  # of the ball


def bounce(t, v):
    """Return the time and velocity at the next bounce of the ball, in floats."""
    v = -E * v + (1 + E) * A * math.cos(t)
    y, start = A * math.sin(t), t

    def height(s):
        return y + v * s - s * s / 2 - A * math.sin(start + s)

    low = 0.02
    while height(low) > 0:
        low += 0.02
    a, b = low - 0.02, low
    for _ in range(60):
        a, b = ((a + b) / 2, b) if height((a + b) / 2) > 0 else (a, (a + b) / 2)
    return start + a, v - a


def test_motions_in_floats_come_nearer():
    """From random states of the section, |W (z - z*)| falls by the factor claimed, or more."""
    given = certificate("ball")
    basin, centre = given["claims"]["basin"], given["hints"]["centre"][0]
    W = np.array([[float(Fraction(q)) for q in row] for row in basin["matrix"]])
    z0, kappa = np.array([float(Fraction(q)) for q in centre]), float(basin["contraction"])
    drawn, most = random.Random(3), 0.0  # noqa: S311
    for _ in range(300):
        s = np.array([drawn.gauss(0, 1) for _ in range(3)])
        t, _, v = z0 + np.linalg.solve(W, s / np.linalg.norm(s) * drawn.random() ** 0.5)
        size = np.linalg.norm(W @ ([t, A * math.sin(t), v] - z0))
        if size > 1:
            continue
        t, v = bounce(t, v)
        t -= 2 * math.pi
        most = max(most, np.linalg.norm(W @ ([t, A * math.sin(t), v] - z0)) / size)
    assert 0.3 < most <= kappa


def test_the_sentence():
    """It says W, kappa, and of which contact they are."""
    sentence = said(certificate("ball"))
    assert "all motions that come to 'table' of 'fly' with |W (z - z*)| at most 1, W = " in sentence
    assert "t less the periods that have passed" in sentence


def said(given):
    """Return the sentence of a certificate that is accepted."""
    return words(check(dumps(given).encode(), lambda _: None))


def lie(change, reason):
    """Check that the ball's certificate is rejected after a change, for this reason."""
    given = certificate("ball")
    change(given)
    rejected(given, reason)


def scaled(rows, c):
    """Return a matrix of decimals, scaled."""
    return [[str(Fraction(q) * c) for q in row] for row in rows]


LIES = {
    "a larger ellipsoid": (
        lambda given: given["claims"]["basin"].update(
            matrix=scaled(given["claims"]["basin"]["matrix"], Fraction(1, 2))
        ),
        "images of the basin may leave the boxes",
    ),
    "a larger one with boxes": (
        lambda given: (
            given["claims"]["basin"].update(
                matrix=scaled(given["claims"]["basin"]["matrix"], Fraction(1, 20))
            ),
            given["hints"].update(reach=scaled(given["hints"]["reach"], 20)),
        ),
        "may not be contracted|may leave the boxes|may not be crossed",
    ),
    "a smaller factor": (
        lambda given: given["claims"]["basin"].update(contraction="0.5"),
        "the basin may not be contracted",
    ),
    "no contraction": (
        lambda given: given["claims"]["basin"].update(contraction="1"),
        "not between 0 and 1",
    ),
    "a negative factor": (
        lambda given: given["claims"]["basin"].update(contraction="-0.9"),
        "not between 0 and 1",
    ),
    "a singular matrix": (
        lambda given: given["claims"]["basin"]["matrix"][1].__setitem__(1, "0"),
        "may be singular",
    ),
    "no triangle": (
        lambda given: given["claims"]["basin"]["matrix"][2].__setitem__(0, "1"),
        "is not upper triangular",
    ),
    "another size": (
        lambda given: given["claims"]["basin"]["matrix"].pop(),
        "the matrix of the basin is not 3 x 3",
    ),
    "a row too short": (
        lambda given: given["claims"]["basin"]["matrix"][0].pop(),
        "the matrix of the basin is not 3 x 3",
    ),
    "smaller boxes": (
        lambda given: given["hints"].update(reach=scaled(given["hints"]["reach"], Fraction(4, 5))),
        "images of the basin may leave the boxes",
    ),
    "negative boxes": (
        lambda given: given["hints"].update(reach=scaled(given["hints"]["reach"], -1)),
        "hints.reach is not positive",
    ),
    "no boxes": (lambda given: given["hints"].pop("reach"), "hints.reach is not that of a basin"),
    "boxes of nothing": (
        lambda given: given["claims"].pop("basin"),
        "hints.reach is not that of a basin",
    ),
    "boxes of another size": (
        lambda given: given["hints"]["reach"][0].pop(),
        "the unknowns are not as many everywhere",
    ),
    "more boxes": (
        lambda given: given["hints"]["reach"].append(given["hints"]["reach"][0]),
        "hints.reach is not a list of 1",
    ),
    "no sink": (
        lambda given: given["claims"].pop("unstable"),
        "is not that of an orbit that attracts",
    ),
    "cuts of the orbit alone": (
        lambda given: given["hints"]["cuts"][0]["table"].clear(),
        "a guard",
    ),
}


@pytest.mark.parametrize("what", LIES)
def test_lies(what):
    """Each is rejected for its own reason."""
    lie(*LIES[what])


def test_each_row_of_an_image():
    """Of a later contact, and of the period without a clock, each row is compared."""
    zero, one, half = (Interval.enclosing(Fraction(q), Fraction(q), 80) for q in ("0", "1", "1/2"))
    part = [[zero, zero], [one, half]]
    W, r = [[Fraction(1)]], [[Fraction(9, 8), Fraction(9, 8)], [Fraction(1, 8), Fraction(9, 8)]]
    contracts([part, part], W, Fraction(1, 2), r, autonomous=True)
    for k, i in ((0, 0), (0, 1), (1, 0), (1, 1)):
        low = [list(row) for row in r]
        low[k][i] = Fraction(0)
        with pytest.raises(Rejected, match="images of the basin may leave the boxes"):
            contracts([part, part], W, Fraction(1, 2), low, autonomous=True)
    with pytest.raises(Rejected, match="may not be contracted"):
        contracts([part, part], W, Fraction(1, 5), r, autonomous=True)


def test_without_a_clock():
    """The escapement attracts an ellipse of states; its period lies in the box."""
    contacts = ("coming", "kick", "going"), ("going", "stop", "back"), ("back", "turn", "coming")
    orbit = Itinerary(read("examples/clock.py", CLOCK), [Contact(*names) for names in contacts])
    given = prove(orbit, [6.36, 0.01, 1.19, 1.5, 1.8, 0, 4.6, -1.3, 0])
    assert [len(row) for row in given["claims"]["basin"]["matrix"]] == [2, 2]
    assert "t less" not in said(given)
    given["hints"]["reach"][0][0] = "1/1000000000"
    rejected(given, "images of the basin may leave the boxes")
