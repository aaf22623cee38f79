"""The theorem ``conservative``: a proof by few flights, and where it is refused."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from support import proving

from cap.areas.strips import strips
from cap.areas.strips.rounds import Round, Rounds
from cap.errors import NotProved
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import conservative
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted
from cap.runner import Runner

SETTING = Setting(PAPER, Start(0.0, 0.0, ()), 6)


@pytest.fixture(autouse=True)
def wide(monkeypatch):
    """Columns are wide, and few."""
    monkeypatch.setattr(conservative, "WIDE", Fraction(1, 8))
    monkeypatch.setattr(conservative, "FINE", 1 / 16)
    monkeypatch.setattr(conservative, "LOSSES", (1e-7,))


@pytest.mark.slow
def test_two_flights():
    """The checker accepts the theorem, and more flights leave less; in processes, or here."""
    areas = []
    for flights in (1, 2):
        setting = replace(SETTING, options={"flights": flights}, runner=Runner(flights))
        found = accepted(THEOREMS["conservative"], setting)
        areas.append(Fraction(found["claims"]["area"]))
        assert Fraction(found["claims"]["speed"]) ** 2 >= Fraction(528, 100)
    assert areas[1] < areas[0] < 3


@pytest.mark.slow
def test_how_far_it_is():
    """The part that is done grows, from the search to the end of the check."""
    told = []
    runner = Runner(tell=lambda *each: told.append(each))
    accepted(THEOREMS["conservative"], replace(SETTING, options={"flights": 1}, runner=runner))
    parts = [part for _, part in told if part is not None]
    assert parts == sorted(parts)
    assert parts[-1] == pytest.approx(1)
    assert list(dict.fromkeys(words for words, _ in told)) == [
        "round 1 of 2, flights followed",
        "round 2 of 2, flights followed",
        "families are listed",
        "the area that is left is bounded",
        "check: forward cells are followed",
        "check: backward cells are followed",
        "check: the area that is left is bounded",
    ]


@pytest.mark.slow
def test_an_interrupted_proof_goes_on(tmp_path, monkeypatch):
    """With a journal; ctrl-C leaves one that has all that was done."""

    def interrupt(_words, part):
        if part is not None:
            raise KeyboardInterrupt

    def setting(**more):
        runner = Runner(journal=tmp_path / "journal", whole=True, **more)
        return replace(SETTING, options={"flights": 1}, runner=runner)

    with pytest.raises(KeyboardInterrupt):
        conservative.prove(setting(tell=interrupt))
    proved = conservative.prove(setting())(Fraction(1))
    monkeypatch.setattr(strips, "grown", None)  # nothing is looked for again
    assert conservative.prove(setting())(Fraction(1)) == proved


@cache
def family(flights):
    """Return a world with its cells."""
    a, b, c = map(float, conservative.CEILING)
    lines = strips.lines(strips.window(a, b, c), Fraction(1, 16))
    rounds = Rounds((Round(flights, strips.GRAIN, 0),), 1)
    begin = lambda world: (world.cover(), world.mirrored.cover())  # noqa: E731
    world, found = rounds.found(strips.World(0.4, 2.0, a, b, c, lines), begin, Runner())
    return world, *found


@pytest.mark.slow
def test_what_is_worth_little_is_left_out():
    """The more, the more area a cell has to take away."""
    _, one, two = family(2)
    counts = [len(strips.worthy((one, two), least)[0].cells) for least in (1e-9, 1e-4, 10.0)]
    assert counts[0] > counts[1] > counts[2] == 0


@pytest.mark.slow
def test_columns_are_cut_where_much_is_lost():
    """Not where nothing is, and not below the finest width; the other lines stay."""
    world, one, two = family(2)
    parts = strips.lossy((one, two), 2, 1e-6, 1 / 32, Runner())
    assert set(parts.tolist()) == {1, 2}
    lines = world.cut(parts).lines
    assert set(world.lines) < set(lines)
    assert {32 * (b - a) for a, b in pairwise(lines)} == {1, 2}
    assert set(strips.lossy((one, two), 2, 1e-6, 1 / 16, Runner()).tolist()) == {1}
    assert set(strips.lossy((one, two), 2, 10.0, 1 / 64, Runner()).tolist()) == {1}
    assert (strips.lossy((one, two), 2, 1e-6, 1 / 128, Runner(2)) >= parts).all()


@pytest.mark.slow
def test_too_many_cells(monkeypatch):
    """What the checker does not read is not proved; that is said before anything is tried."""
    monkeypatch.setattr("cap.checker.strips.columns.LONGEST", 2)
    with pytest.raises(NotProved, match="too many"):
        conservative.prove(replace(SETTING, options={"flights": 1}))


def test_other_parameters_need_another_ceiling():
    """At f = 1/10 the function does not decrease: not proved, before any strip is looked for."""
    setting = replace(SETTING, parameters=replace(PAPER, f=Fraction(1, 10)))
    with pytest.raises(NotProved, match="another one"):
        conservative.prove(setting)


@pytest.mark.parametrize(
    "words", [("--orbit", "0", "1"), ("--f", "0"), ("--e", "9/10"), ("--flights", "0")]
)
def test_bad_input(capsys, tmp_path, monkeypatch, words):
    """The theorem is about all motions, with friction and nothing else lost."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, "conservative", *words)
    assert status == 2
    assert err.count("\n") == 1
