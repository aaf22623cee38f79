"""The fixed points of ``inventory`` in other units, and when orbits of several hits are apart."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest

from cap.checker.flow.launches import apart
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.inventory import Inventory
from checker.altered import encode

STORED = Path(__file__).parents[2] / "certificates/inventory.json"
F, OMEGA = Fraction(3), Fraction(2)


def rescaled(length, speed):
    """Return the stored certificate at other F and omega, with fixed points in these units."""
    certificate = json.loads(STORED.read_text("utf-8"))
    scale, parameters = F / OMEGA**2, certificate["parameters"]
    certificate["parameters"] = parameters | {
        "F": str(F * Fraction(parameters["F"])),
        "omega": str(OMEGA * Fraction(parameters["omega"])),
        "f": str(F * Fraction(parameters["f"])),
        **{name: str(scale * Fraction(parameters[name])) for name in "lr"},
    }
    for point in certificate["claims"]["fixed_points"]:
        for name, unit in (("x", length), ("v", speed)):
            point[name] = [str(unit * Fraction(end)) for end in point[name]]
    return certificate


def test_fixed_points_in_other_units():
    """Lengths are F/omega^2, speeds F/omega, and nothing else."""

    def points(length, speed):
        Inventory(read(encode(rescaled(length, speed))), lambda _: None).points()

    length, speed = F / OMEGA**2, F / OMEGA
    points(length, speed)
    for wrong in ((speed, length), (length, length), (speed, speed), (1, 1)):
        with pytest.raises(Rejected, match="does not contain"):
            points(*wrong)


def number(x):
    """Return a thin interval."""
    return Interval.enclosing(Fraction(x), Fraction(x), 80)


@pytest.mark.parametrize(
    ("e", "is_apart"),
    [
        (("0.09", "0"), False),
        (("0.11", "0"), True),
        (("0", "0.19"), False),
        (("0", "0.21"), True),
        (("-0.09", "-0.19"), False),
        (("-0.11", "0.1"), True),
        (("0.05", "-0.21"), True),
    ],
)
def test_orbits_close_where_a_linear_map_says(e, is_apart):
    """t' = t + (k + 2) pi + 2 e_1 + e_2/2 - ..., u' = ...: the only closing orbit is at e."""
    x, y = map(Fraction, e)
    gap = SimpleNamespace(pi=number(3), turn=number(6))
    a, b, c, d = map(Fraction, ("2", "1/2", "3/10", "3"))
    g, h = -((a - 1) * x + b * y), -(c * x + (d - 1) * y)
    first = SimpleNamespace(centre=SimpleNamespace(x=number(1)), speed=number(5))
    now = SimpleNamespace(
        centre=SimpleNamespace(x=number(1 + 3 * 4 + g)),
        speed=number(5 + h),
        dt=(number(a), number(b)),
        du=(number(c), number(d)),
        reach=(number("1/10"), number("1/5")),
        first=True,
    )
    may_be = Interval.enclosing(Fraction(5), Fraction(7), 80), Interval.enclosing(-1, 1, 80)
    assert apart(gap, first, now, may_be, 2) is is_apart
    assert not apart(gap, first, SimpleNamespace(first=False), may_be, 2)
    assert apart(gap, first, now, (number(5), may_be[1]), 2)
    assert apart(gap, first, now, (may_be[0], number(1)), 2)
