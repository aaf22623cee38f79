"""The theorem ``conservative``: a proof by few flights, and where it is refused."""

from dataclasses import replace
from fractions import Fraction

import pytest
from support import proving

from cap.cells.strips import World, even, strips, together
from cap.errors import NotProved
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import conservative
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, accepted

SETTING = Setting(PAPER, Start(0.0, 0.0, ()), 6)


def test_two_flights(monkeypatch):
    """With wide columns: the checker accepts it, and more flights leave less."""
    monkeypatch.setattr(conservative, "WIDTH", Fraction(1, 8))
    areas = []
    for flights in (1, 2):
        monkeypatch.setattr(conservative, "FLIGHTS", flights)
        found = accepted(THEOREMS["conservative"], SETTING)
        areas.append(Fraction(found["claims"]["area"]))
        assert Fraction(found["claims"]["speed"]) ** 2 >= Fraction(528, 100)
    assert areas[1] < areas[0] < 3


def test_fates_are_those_of_orbits():
    """Strips lie one above the other, of all fates within three flights."""
    lines = even(*conservative.CEILING, Fraction(1, 16))
    world = World(0.4, 2.0, *map(float, conservative.CEILING), lines, 3)
    found = together([strips(world, j) for j in (40, 50)])
    assert set(found.fates[1, : found.number[1]].tolist()) == {-1, -2, -3, -4}
    middle = found.ends[1, : found.number[1], 2]
    assert (middle[:, 0] < middle[:, 1]).all()
    assert (middle[1:, 0] >= middle[:-1, 1] - 1e-8).all()


def test_other_parameters_need_another_ceiling():
    """At f = 1/10 the function does not decrease: not proved, before any strip is looked for."""
    setting = replace(SETTING, parameters=replace(PAPER, f=Fraction(1, 10)))
    with pytest.raises(NotProved, match="another one"):
        conservative.prove(setting)


@pytest.mark.parametrize("words", [("--orbit", "0", "1"), ("--f", "0"), ("--e", "9/10")])
def test_bad_input(capsys, tmp_path, monkeypatch, words):
    """The theorem is about all motions, with friction and nothing else lost."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, "conservative", *words)
    assert status == 2
    assert err.count("\n") == 1
