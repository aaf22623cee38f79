"""The search for strips in rounds: cells in order, columns that are cut, and the journal."""

import json
import math
from fractions import Fraction
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from cap.areas.listing import listed, runs
from cap.areas.strips import strips
from cap.areas.strips.fit import UNIT
from cap.areas.strips.rounds import Round, Rounds
from cap.checker.strips.columns import columns
from cap.errors import BadInput
from cap.runner import Runner

# compiled anew in a fresh clone: tens of seconds; the checker has its own code
pytestmark = pytest.mark.slow

CEILING = 0.8, 0.1, 0.64
GRAIN = strips.GRAIN._replace(step=1e-4)
ROUNDS = Rounds((Round(1, GRAIN, 1e-6), Round(2, GRAIN, 0)), 1 / 32)
STEPS = 1 * 2 + 1 + 2 * 2


def begun(world):
    """Return columns without cells."""
    return world.cover(), world.mirrored.cover()


def world():
    """Return a world with columns of a width of 1/16."""
    lines = strips.lines(strips.window(*CEILING), Fraction(1, 16))
    return strips.World(0.4, 2.0, *CEILING, lines)


@cache
def found():
    """Return what is found without a journal."""
    return ROUNDS.found(world(), begun, Runner())


def same(one, two):
    """Return whether two results are the same."""
    pairs = zip(one[1], two[1], strict=True)
    fields = ("lines", "start", "cells", "levels", "top", "bottom", "has_bottom")
    return one[0] == two[0] and all(
        np.array_equal(getattr(a, name), getattr(b, name)) for a, b in pairs for name in fields
    )


def test_cells_are_in_order():
    """In each column each is above the one before, and a multiple of the unit."""
    for cover in found()[1]:
        own = strips.columns_of(cover)
        assert set(cover.levels.tolist()) == {1, 2}
        assert (np.rint(cover.cells / UNIT) * UNIT == cover.cells).all()
        for s in (-1, 0, 1):
            ends = cover.cells @ np.array([[1, 0], [s, 0], [s * s, 0], [0, 1], [0, s], [0, s * s]])
            assert (ends[:, 0] < ends[:, 1]).all()
            follows = own[1:] == own[:-1]
            assert (ends[1:, 0] >= ends[:-1, 1])[follows].all()


def test_thin_parts_of_strips_are_apart():
    """Parts that rounding would make touch others are left out: the checker reads the columns."""
    grain = GRAIN._replace(thin=1e-7, halvings=8)
    _, family = Rounds((Round(3, grain, 0),), 1).found(world(), begun, Runner())
    for cover in family:
        assert columns(listed([runs(cover, j) for j in range(len(cover.top))]))


def test_threads_find_the_same():
    """However many there are."""
    assert same(ROUNDS.found(world(), begun, Runner(3)), found())


def test_columns_are_cut_between_rounds():
    """The other lines stay."""
    cut = found()[0]
    assert set(world().lines) < set(cut.lines)
    assert {32 * (b - a) for a, b in pairwise(cut.lines)} == {1, 2}


def test_progress_is_told():
    """Which round it is, and how much of all: each takes twice the time of the one before."""
    told = []
    ROUNDS.found(world(), begun, Runner(tell=lambda words, part: told.append((words[:12], part))))
    words, parts = zip(*told, strict=True)
    assert words == ("round 1 of 2", "round 2 of 2", "round 2 of 2")
    assert parts == pytest.approx((1 / 3, 2 / 3, 1))


@pytest.mark.parametrize("lines", range(1, STEPS + 2))
def test_a_journal_is_gone_on_with(tmp_path, monkeypatch, lines):
    """Wherever it was cut short, the rest is done, and what is found is the same."""
    path, done = tmp_path / "journal", []
    assert same(ROUNDS.found(world(), begun, Runner(journal=path)), found())
    whole = path.read_text(encoding="ascii").splitlines(keepends=True)
    assert len(whole) == 1 + STEPS
    path.write_text("".join(whole[:lines]) + "[half of", encoding="ascii")
    for name in ("grown", "lossy"):
        real = getattr(strips, name)
        monkeypatch.setattr(strips, name, lambda *a, real=real: done.append(0) or real(*a))
    assert same(ROUNDS.found(world(), begun, Runner(journal=path)), found())
    assert len(done) == 1 + STEPS - lines
    assert path.read_text(encoding="ascii") == "".join(whole)


def test_an_interrupt_leaves_a_journal(tmp_path):
    """After ctrl-C all steps done are in it."""

    def stop(_words, part):
        if 0.5 < part < 1:
            raise KeyboardInterrupt

    path = tmp_path / "journal"
    with pytest.raises(KeyboardInterrupt):
        ROUNDS.found(world(), begun, Runner(tell=stop, journal=path))
    assert len(path.read_text(encoding="ascii").splitlines()) == 1 + 3 + 2
    assert same(ROUNDS.found(world(), begun, Runner(journal=path)), found())


@pytest.mark.parametrize(
    "other",
    [
        Rounds(ROUNDS.each[1:], 1 / 32),
        Rounds(ROUNDS.each, 1 / 64),
        Rounds((ROUNDS.each[0]._replace(loss=2e-6), ROUNDS.each[1]), 1 / 32),
    ],
)
def test_a_journal_of_another_search(tmp_path, other):
    """It is refused."""
    path = tmp_path / "journal"
    ROUNDS.found(world(), begun, Runner(journal=path))
    with pytest.raises(BadInput, match="about something else"):
        other.found(world(), begun, Runner(journal=path))


def _other_columns(whole):
    name, _ = json.loads(whole[1])
    return json.dumps([name, json.loads(whole[4])[1]])


def _no_text(whole):
    return json.dumps([json.loads(whole[1])[0], "A" * 99])


def _truncated(whole):
    name, text = json.loads(whole[1])
    return json.dumps([name, text[: len(text) // 8 * 4]])


@pytest.mark.parametrize("damage", [_other_columns, _no_text, _truncated])
def test_a_damaged_journal(tmp_path, damage):
    """It is refused in one line."""
    path = tmp_path / "journal"
    ROUNDS.found(world(), begun, Runner(journal=path))
    whole = path.read_text(encoding="ascii").splitlines()
    path.write_text("\n".join([whole[0], damage(whole), *whole[2:]]) + "\n", encoding="ascii")
    with pytest.raises(BadInput, match="damaged: remove it"):
        ROUNDS.found(world(), begun, Runner(journal=path))


def test_a_window_is_where_energies_are_positive():
    """At its ends the ceiling is at E = 0."""
    a, b, c = CEILING
    for end in strips.window(a, b, c):
        assert math.isclose(a * math.cos(end - b), c)
