"""The part of the basin of the segment that ``mixed`` uses, in units that are not 1."""

from __future__ import annotations

from fractions import Fraction
from types import SimpleNamespace

import pytest
from support import rounds, seeded

from cap.checker.attracting.segment import Touching
from cap.checker.folded.basins import bounds_of
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.shapes import Enclosure
from cap.checker.system.walls import Parameters

OTHER = Parameters(*map(Fraction, (3, 2, "3/5", "-1/2", 1)))
NEAR = 1e-6


def pair(lower, upper):
    """Return an enclosure of decimals."""
    return Enclosure(Fraction(lower), Fraction(upper), (lower, upper))


CLAIMS = {
    "left": pair("-0.31", "-0.3"),
    "right": pair("0.6", "0.62"),
    "v": pair("0.69", "0.71"),
    "basin": {"speed": Fraction(1, 4), "drift": (Fraction(2), Fraction(3))},
}


def room(x, v):
    """Return by how much a state is in the basin that is claimed, in x and in v; or is not."""
    d, (a, b) = CLAIMS["basin"]["speed"], CLAIMS["basin"]["drift"]
    k, left, right = a + b * d, CLAIMS["left"].upper, CLAIMS["right"].lower
    apart = [v - u for u in CLAIMS["v"][:2]]
    ends = [x, *(x + k * w for w in apart)]
    return float(min(*(d - abs(w) for w in apart), min(ends) - left, right - max(ends)))


def strip():
    """Return the strip."""
    return Touching(SimpleNamespace(p=OTHER), CLAIMS).strip()


def contains(x, v):
    """Return whether the strip contains a state."""
    length, speed = OTHER.omega**2 / OTHER.F, OTHER.omega / OTHER.F
    p, s = q.model(one=float((x - OTHER.r) * length)), q.model(one=float(v * speed))
    return strip().contains(bounds_of(q, p, s))


def test_it_is_the_basin_that_is_claimed():
    """States in it, and near it, by the inequalities of the theorem ``segment``."""
    random, seen = seeded(4), {True: 0, False: 0}
    for _ in range(rounds(500)):
        x, v = Fraction(random.uniform(-0.5, 0.8)), Fraction(random.uniform(0.4, 1))
        known = room(x, v)
        if abs(known) > NEAR:
            assert contains(x, v) is (known > 0)
            seen[known > 0] += 1
    assert min(seen.values()) > 25


@pytest.mark.parametrize(
    ("x", "v", "dx", "dv"),
    [
        ("-0.3", "0.71", 1, 0),  # left, by the slowest orbit
        ("0.6", "0.69", -1, 0),
        ("0.5", "0.46", 0, 1),  # as slow, and as fast, as is allowed
        ("-0.2", "0.94", 0, -1),
        ("0.3425", "0.783636363636", 0, -1),  # x + k (v - u) at the right end
    ],
)
def test_its_borders(x, v, dx, dv):
    """They are those of the claims: a state just inside, and one just outside."""
    x, v = Fraction(x), Fraction(v)
    for side in (1, -1):
        state = x + side * Fraction(dx, 10**5), v + side * Fraction(dv, 10**5)
        assert contains(*state) is (room(*state) > 0) is (side > 0)
