"""Cells of a map of releases: its second derivative, its laps and its images."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.checker.system import release_cells
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.passage import Contact
from cap.checker.system.release_bend import bend
from cap.checker.system.release_cells import Cell, cell, confirm_laps, coverings, met
from cap.checker.system.releases import Releases
from checker.altered import changed

ROOT = Path(__file__).parents[2]
BELT = json.loads((ROOT / "certificates/contact_attractor-1.json").read_text("utf-8"))
TOSS = json.loads(
    (ROOT / "tests/certificates/accept/contact_attractor_toss.json").read_text("utf-8")
)
BITS = 96
TURN = math.pi - math.asin(1 / 4.3) + 2 * math.pi  # of t + 4.3 cos t


def releases(certificate):
    """Return F of a certificate."""
    contacts = [Contact(**contact) for contact in certificate["claims"]["contacts"]]
    given = matched(certificate["parameters"], SYSTEM, "the system")
    return Releases(model(given), contacts, BITS)


def between(low, high):
    """Return an interval."""
    return Interval.enclosing(Fraction(low), Fraction(high), BITS)


def tossed(low, high):
    """Return a cell of the toss."""
    times = [t + 2 * math.pi + 4.3 * math.cos(t) for t in (low, (low + high) / 2, high)]
    window = between(min(times) - 0.2, max(times) + 0.2)
    return cell(releases(TOSS), 1, (Fraction(low), Fraction(high)), [window])


@pytest.mark.parametrize("t", [5.1, 7.3, 8.9, 10.2])
def test_the_second_derivative_in_closed_form(t):
    """Of the toss it is -4.3 cos t; over an interval it contains those of its points."""
    F, s = releases(TOSS), t + 2 * math.pi + 4.3 * math.cos(t)
    window = [between(s - 0.5, s + 0.5)]
    for h in (0, 0.01):
        where = between(t - h, t + h)
        found = bend(F, where, F.over(where, window))
        for x in (t - h, t, t + h):
            known = -4.3 * math.cos(x)
            assert float(found.lower) - 1e-9 <= known <= float(found.upper) + 1e-9
    assert found.upper - found.lower < 4


def test_the_second_derivative_is_that_of_differences():
    """Of the belt, with two contacts, a spring and drag."""
    F, hint = releases(BELT), BELT["hints"]["cells"][9]
    windows = [between(*ends) for ends in hint["windows"]]
    t, h = Fraction(hint["to"]), Fraction(1, 10**8)
    one, other = (F.at(between(s, s), windows).by[0] for s in (t - h, t))
    found = bend(F, between(t, t), F.over(between(t, t), windows))
    assert float((other - one).lower / h) == pytest.approx(float(found.lower), abs=1e-5)


def test_the_second_derivative_with_a_divisor():
    """v is reset to D/(2 D): that is 1/2, and x stays as it is."""
    F, hint = releases(BELT), BELT["hints"]["cells"][9]
    catch = ("parameters", "modes", "slower", "guards", "catch")
    double = changed(BELT, *catch, "reset", "v", [["3/2"], ["1/2", "cos"], ["1/8", "x"]])
    G = releases(changed(double, *catch, "divisor", [["3"], ["1", "cos"], ["1/4", "x"]]))
    windows, t = [between(*ends) for ends in hint["windows"]], between(hint["to"], hint["to"])
    one, other = (bend(each, t, each.over(t, windows)) for each in (F, G))
    assert not (one - other).magnitude().upper > Fraction(1, 10**15)


def test_laps():
    """A cell with a turn inside has two laps, one beside it one, though S contains 0 there."""
    assert tossed(TURN - 0.01, TURN + 0.01).laps == 2
    for low, high in ((TURN + 1e-6, TURN + 0.01), (TURN - 0.01, TURN - 1e-6)):
        beside = tossed(low, high)
        assert beside.slope.contains_zero() or beside.laps == 1
        assert beside.laps == 1
    assert tossed(7, 7.05).laps == 1


def test_images():
    """That of a cell with a turn has the value there; that of a lap is as wide as the map is."""
    value = TURN + 4.3 * math.cos(TURN)
    image = tossed(TURN - 0.01, TURN + 0.02).image
    assert image.lower < value < image.upper
    low, high = 7.0, 7.05
    image = tossed(low, high).image
    ends = sorted(t + 4.3 * math.cos(t) for t in (low, high))
    assert [float(image.lower), float(image.upper)] == pytest.approx(ends, abs=1e-9)


def test_cells_that_an_image_only_touches():
    """They are met; a cell between the images of the ends is covered in their interior alone."""

    def sent(k, low, high):
        ends = between(low, low), between(high, high)
        return Cell(Fraction(k), Fraction(k + 1), (), between(1, 1), ends, between(low, high), 1)

    half = Fraction(1, 2)
    cells = [sent(0, 1, 2), sent(1, half, 2 + half), sent(2, 1, 2 + half), sent(3, half, 2)]
    assert met(cells) == [range(3), range(3), range(3), range(3)]
    assert [[*c] for c in coverings(cells)] == [[], [1], [], []]


def test_turns_that_are_not_counted(monkeypatch):
    """Where the second derivative may vanish, nothing is known of the laps."""
    monkeypatch.setattr(release_cells, "bend", lambda *_: between(-1, 1))
    unknown = tossed(TURN - 0.01, TURN + 0.01)
    assert unknown.laps == 0
    with pytest.raises(Rejected, match="more than once"):
        confirm_laps([unknown])


def test_the_second_derivative_where_a_reset_divides():
    """A toss of pi + 43/20 cos t over 2 + cos t: t' = t + 2 (pi + 43/20 cos t)/(2 + cos t)."""
    given = changed(TOSS, "digits", "6")
    guard = given["parameters"]["modes"]["fly"]["guards"]["hand"]
    guard["divisor"] = [["2"], ["1", "cos"]]
    F = releases(given)

    def later(t):
        return t + 2 * (math.pi + 2.15 * math.cos(t)) / (2 + math.cos(t))

    for t in (0.3, 2.0, 4.4):
        window, where = [between(later(t) - 0.05, later(t) + 0.05)], between(t, t)
        found = bend(F, where, F.over(where, window))
        h = 1e-4
        known = (later(t + h) - 2 * later(t) + later(t - h)) / h**2
        assert float(found.lower) == pytest.approx(known, abs=1e-5)
