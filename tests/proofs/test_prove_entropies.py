"""The theorem entropies: over sets of places and f, against floats; and refusals."""

import json
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest

from cap.errors import BadInput, NotProved
from cap.floats.engine.releases import images
from cap.flow.event import Expected
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import entropies
from cap.proofs.fixed_point import Setting
from cap.release import kneading, piece, strip
from cap.release.passage import words
from cap.sets import interval
from cap.sets.interval import Ball

CLAIMS = json.loads(
    (Path(__file__).parents[2] / "certificates/entropies-1.json").read_text("utf-8")
)["claims"]


def in_the_middle(low, high, near):
    """Return the core of a strip."""
    low, high = Fraction(low), Fraction(high)
    return strip.core(replace(PAPER, f=(low + high) / 2), near, low, high)


def against_floats(found, cell):
    """Check that the images of places in a cell, for f of the strip, are enclosed, and G'."""
    a, b = float(cell.lower), float(cell.upper)
    for part, f in product((0, 0.3, 1), (found.family.low, found.family.high)):
        y, shift = a + part * (b - a), found.shift(f)
        here = images(replace(PAPER, f=f), [y + shift])
        near = Ball(0, 1e-9)
        assert (cell.value + near).contains(Ball(float(here.value[0]) - shift))
        assert (cell.slope + near).contains(Ball(float(here.slope[0])))


def test_cells():
    """Over a strip; and over a set where some turn before they stick, and some do not."""
    with interval.workprec(80):
        found = in_the_middle("0.4195", "0.4200", -0.475)
        halts = 0
        for low in ("-0.66", "-0.48", "-0.305"):
            ends = Fraction(low), Fraction(low) + Fraction(1, 250)
            f = found.family.low, found.family.high
            expected = found.expected((float(ends[0]), float(ends[1])), f)
            halts += words(expected)[-2].startswith("halt")
            against_floats(found, strip.over(found, ends, expected))
        assert halts


def test_an_interval_with_which_the_checker_agrees():
    """Of the intervals around a cycle the longest is taken that the caller, too, can follow."""
    with interval.workprec(80):
        found = in_the_middle("0.3900", "0.3905", -0.6603)
        part = found.family.part(found.family.low, found.family.high)
        near = piece.line(found, part)
        images = list(piece.images(found, part, piece.critical_point(found, part, near, 1)[1]))
        asked = []

        def agrees(cycle):
            asked.append(cycle.reach)
            return len(asked) > 2

        cycle = piece.attracting(found, part, images, agrees)
        assert cycle.period == 3
        assert cycle.reach == min(asked)
        assert len(asked) >= 3
        assert piece.attracting(found, part, images, lambda _: False) is None


def test_windows_foreseen_over_a_set():
    """They hold the times at its corners, and a little more."""
    with interval.workprec(80):
        found = in_the_middle("0.3900", "0.3905", -0.6603)
        f = found.family.low, found.family.high
        events = found.expected((-0.70, -0.69), f)
        for q, y in product(f, (-0.70, -0.69)):
            corner = found.expected((y, y), (q, q))
            assert words(corner) == words(events)
            assert all(
                wide.window.contains(here.window) for wide, here in zip(events, corner, strict=True)
            )


def test_halting():
    """A turn and a stick, or a stick, become a halt; other events do not."""
    here = Ball(1)
    stick, last = Expected("stick", here), Expected("release left", here)
    turn = Expected("turn right", here)
    assert words(strip.halting((turn, stick, last))) == ("halt right", "release left")
    assert words(strip.halting((stick, last))) == ("halt right", "release left")
    with pytest.raises(NotProved, match="differ by more than a turn"):
        strip.halting((Expected("capture r", here), last))


def test_bounds_of_the_entropy():
    """With more symbols they are closer; symbols that are not known widen them."""
    golden = 0.48121182505960347
    wide, close, unknown = map(entropies.entropy, ("RLL", "RLLRLLRLL", "RL?RL?RL?"))
    for low, high in (wide, close, unknown):
        assert float(low) <= golden <= float(high)
    assert float(wide[0]) <= float(close[0]) < float(close[1]) <= float(wide[1])
    assert entropies.entropy("R" + "?" * 5)[0] == "0.000000"
    assert kneading.extreme("R?", least=True) == "RR"
    assert kneading.extreme("R?", least=False) == "RL"


def test_the_stored_pieces_in_floats():
    """The first symbols of the critical orbit for f at the ends and in the middle of each piece."""
    near = -0.6663
    for claim in CLAIMS["strips"][0]["pieces"]:
        low, high = map(Fraction, claim["f"])
        for f in (low, (low + high) / 2, high):
            p = replace(PAPER, f=f)
            turning = strip.turning_point(p, near)
            near, x = turning.x, turning.value
            for symbol in claim["kneading"][:9]:
                side = "R" if x < near else "L"
                assert symbol in (side, "?") or abs(x - near) < 1e-6
                x = float(images(p, [x]).value[0])


def test_refusals():
    """Without a range; where no interval is mapped into itself; where there is no turning point."""
    with pytest.raises(BadInput, match="--from Q --to Q"):
        entropies.prove(Setting(PAPER, Start(0.0, 0.0, ()), 6))
    with interval.workprec(80):
        with pytest.raises(NotProved, match="takes into itself"):
            in_the_middle("0.4315", "0.4320", -0.4)
        with pytest.raises(NotProved, match="not found for all f"):
            in_the_middle("0.40", "0.401", 0.5)
    one = {"half_periods": "3", "turn": "minimum"}
    assert entropies.shares([{**one, "claim": {"pieces": []}}], Fraction(1))["undecided"] == "1"
