"""The one search: what is known is found, no command lists what another omits, families."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest

from cap.errors import NotProved
from cap.explore.inventory import inventory
from cap.floats import candidates
from cap.floats.candidates import Request
from cap.floats.search import periodic
from cap.floats.search.cycles import StroboscopicMap
from cap.floats.search.family import families
from cap.floats.search.inventory import Inventory
from cap.floats.search.orbits import search
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER
from cap.proofs import theorems
from cap.proofs.fixed_point import Setting

KNOWN = {  # changes of the paper's parameters, and how many isolated T-periodic orbits are known
    ("f", "1/4"): 4,
    ("f", "1/10"): 8,
    ("f", "1/100"): 8,
    ("F", "3"): 25,
}
FOUND = {}


def at(name, value):
    """Return the paper's parameters but for one."""
    return replace(PAPER, **{name: Fraction(value)})


def found(p):
    """Return what is found, searched for once."""
    if p not in FOUND:
        FOUND[p] = search(p)
    return FOUND[p]


def starts(lines):
    """Return the states at the beginning of lines about orbits."""
    states = [line.split("x = ")[1].split(",")[0:2] for line in lines if ", trace" in line]
    return {(float(x), float(v.split("=")[1])) for x, v in states}


@pytest.mark.slow
@pytest.mark.parametrize(("change", "number"), KNOWN.items())
def test_all_known_orbits_are_found(change, number):
    """As many as ever were found and proved; each closes up and is found once."""
    p = at(*change)
    orbits = found(p).isolated
    assert len(orbits) == number
    strobe = StroboscopicMap(p)
    for k, one in enumerate(orbits):
        path = strobe.path((one.x, one.v))
        assert strobe.size(strobe.defect(path, (one.x, one.v))) < 1e-14 * (1e3 + abs(one.trace))
        assert all(strobe.size((one.x - c.x, one.v - c.v)) > 1e-7 for c in orbits[:k])


@pytest.mark.slow
@pytest.mark.parametrize("change", KNOWN)
def test_no_command_lists_what_another_omits(change, monkeypatch):
    """The lists of elliptic, saddle, periodic and inventory: each is the part asked for of one."""
    p = at(*change)
    found(p)
    for module in ("floats.candidates", "explore.inventory"):
        monkeypatch.setattr(f"cap.{module}.search", lambda p, *_, **__: found(p))
    every = {(c.x, c.v): c for c in found(p).isolated}
    listed = {(o.x, o.v): o.kind for o in inventory(p).orbits}
    assert listed == {z: c.kind(conserves=True) for z, c in every.items()}
    cyclic = candidates.cyclic(Request("periodic", p, every=True)).candidates
    assert {(c.start.x, c.start.v) for c in cyclic} == set(every)
    never = {z for z, c in every.items() if c.kinds == {"hit"}}
    shown = set()
    for kind in ("elliptic", "saddle"):
        if any(guess.kind == kind for guess in found(p).never_stopping):
            given = candidates.non_sticking(Request(kind, p, every=True)).candidates
            shown |= {(c.start.x, c.start.v) for c in given}
    assert shown == never
    by_hit_times = {(g.x, g.v) for hits in (2, 4, 6) for g in periodic.orbits(p, hits)}
    assert by_hit_times <= never


@pytest.mark.slow
def test_what_only_the_hit_times_find():
    """The strong saddle at f = 1/4, and that at f = 1/100 with a multiplier of 6e9."""
    quarter, small = (found(at("f", f)).isolated for f in ("1/4", "1/100"))
    assert any(abs(c.x + 0.921573) < 1e-6 and abs(c.v - 0.342949) < 1e-6 for c in quarter)
    strong = max(small, key=lambda c: abs(c.trace))
    assert strong.trace > 1e9
    assert strong.path.words == ("hit r", "hit l")


@pytest.mark.slow
@pytest.mark.parametrize("f", ["1/4", "1/10", "1/100"])
def test_what_is_found_can_be_proved(f):
    """And the checker accepts it; but for the saddle at f = 1/100 with a multiplier of 6e9."""
    p = at("f", f)
    for each in candidates.cyclic(Request("periodic", p, every=True)).candidates:
        setting = Setting(p, each.start, 10)
        if "e+09" in each.shown:
            with pytest.raises(NotProved, match="no rectangle"):
                theorems.accepted(theorems.THEOREMS["periodic"], setting)
        else:
            theorems.accepted(theorems.THEOREMS["periodic"], setting)


def free_stroke(p):
    """Return the length of the free oscillation with two turns, as Den Hartog has it."""
    F, f, omega = float(p.F), float(p.f), float(p.omega)
    return 2 * F / omega**2 * math.sqrt(1 - (math.pi * f / (2 * F)) ** 2)


@pytest.mark.parametrize("f", ["0", "1/100", "1/4", "2/5", "1/2", "53/100"])
def test_families_without_a_stick(f):
    """Their stroke in closed form, up to f/F = 2/sqrt(4 + pi^2); each x in the range closes up."""
    p = replace(at("f", f), r=Fraction(2))
    (family,) = families(p)
    assert family.stroke == pytest.approx(free_stroke(p), abs=1e-12)
    assert family.high - family.low == pytest.approx(3 - family.stroke, abs=1e-12)
    assert family.sticks == 0
    for part in (0.01, 0.5, 0.99):
        x = family.low + part * (family.high - family.low)
        path = itinerary(p, x, family.v, 2 * math.pi)
        assert path.end == pytest.approx((x, family.v), abs=1e-12)
        assert {word.split()[0] for word in path.words} == {"turn"}


def test_families_with_sticks():
    """Beyond that friction the mass rests twice in a period."""
    limit = 2 / math.sqrt(4 + math.pi**2)
    for f, sticks in ((limit - 1e-4, 0), (limit + 1e-4, 2), (0.9, 2)):
        (family,) = families(at("f", Fraction(f)))
        assert (family.turns, family.sticks) == (2 - sticks, sticks)


@pytest.mark.parametrize(("r", "number"), [("0.5558", 0), ("0.556", 1)])
def test_families_need_room(r, number):
    """At f = 2/5 the stroke is 1.5559: the walls must be further apart."""
    assert len(families(replace(PAPER, r=Fraction(r)))) == number


def test_families_with_losses_and_other_units():
    """Viscous friction makes them smaller; e does not matter; the stroke scales with F/omega^2."""
    (plain,), (viscous,) = families(PAPER), families(replace(PAPER, mu=Fraction(1, 10)))
    assert viscous.stroke < plain.stroke
    assert families(replace(PAPER, e=Fraction(1, 2))) == (plain,)
    units = replace(PAPER, F=Fraction(8), f=Fraction(16, 5), omega=Fraction(2))
    (scaled,) = families(replace(units, l=Fraction(-2), r=Fraction(2)))
    assert scaled.stroke == pytest.approx(2 * plain.stroke)
    assert scaled.v == pytest.approx(4 * plain.v)


@pytest.mark.slow
def test_families_are_told_and_not_counted(capsys):
    """In the lines of the inventory and among the candidates; none in its counts."""
    (family,) = families(PAPER)
    findings = Inventory(
        parameters=PAPER, parameter="F", periods=1, values=[1.0], orbits=(), families=()
    )
    assert "family" not in "\n".join(findings.lines())
    listed = inventory(PAPER)
    assert len(listed.families) == 1
    assert any("family" in line and "not counted" in line for line in listed.lines())
    assert listed.lines()[1].startswith("F = 1.0: 4 orbits: ")
    told = candidates.cyclic(Request("periodic", PAPER)).lines
    assert told[-1] == f"A family of orbits that touch no wall: {family.line()}"


def test_orbits_of_twice_the_period_have_no_families():
    """What touches no wall has the period T already; no orbit found is one of period T."""
    twice = search(PAPER, 2)
    assert twice.families == ()
    assert all(c.periods == 2 and "hit" in c.kinds for c in twice.isolated)
