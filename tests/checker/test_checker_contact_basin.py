"""The theorem ``contact_basin``: what is true is verified; each lie is noticed."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from support import rounds, seeded

from cap.checker.kernel.certificate import read
from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.resting.fates import Fates
from cap.checker.resting.flights import Cell, Flights, Window
from cap.checker.resting.pull import Pull, Wave
from cap.checker.system.polynomial import variable
from cap.checker.theorems import contact_basin
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

ROOT = Path(__file__).parents[2]
STORED = json.loads((ROOT / "certificates/contact_basin-1.json").read_text("utf-8"))
GOOD = json.loads((ROOT / "tests/certificates/accept/contact_basin_ball.json").read_text("utf-8"))
FLY, REST = ("parameters", "modes", "fly"), ("parameters", "modes", "rest")
TABLE, LEAVE = (*FLY, "guards", "table"), (*REST, "guards", "leave")
TREE = GOOD["hints"]["tree"]


def altered(*path, value):
    """Return the small certificate with another value."""
    return changed(GOOD, *path, value)


def test_it_is_verified():
    """Its steps are told; the schema describes it; any number of processes."""
    steps = verify(GOOD)
    assert len(steps) == 4
    assert "cells hits accumulate in time" in steps[2]
    fits_the_schema(GOOD)


@pytest.mark.slow
def test_the_stored_one():
    """What is told: the shares, the times, the rule of the model."""
    line = words(check(encode(STORED), lambda _: None))
    for part in (
        "of the states (y, v) in [0, 2] x [-2, 2] at t = 0 in the mode 'fly', by their area",
        "at least the part 0.66",
        "these hits accumulate before t = 6, and the motion is then in the mode 'rest'",
        "at least the part 0.17",
        "finitely often until t = 6, and is in the mode 'fly' then, with h > 0",
    ):
        assert part in line


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("start",), "2.9", "h may be negative in a cell"),
        (("start",), "3.02", "a cell is not seen to"),
        (("start",), "7", "claims.until is not after claims.start"),
        (("until",), "6.9", "a cell is not seen to"),
        (("until",), "7.1", "a cell is not seen to"),
        (("until",), "1000", "is more than 500"),
        (("mode",), "rest", "there is no such guard, or mode"),
        (("guard",), "leave", "there is no such guard, or mode"),
        (("restitution",), "500000001/1000000000", "is not -e times that before it"),
        (("restitution",), "0", "0 < e <= 1 does not hold"),
        (("box", "y"), ["0.2", "1.21"], "a cell is not seen to"),
        (("box", "y"), ["1.2", "1.2"], "the rectangle has no area"),
        (("box", "v"), ["-1", "1.02"], "a cell is not seen to"),
        (("box",), {"y": ["0", "1"]}, "is not one of the state"),
    ],
)
def test_each_claim(path, value, why):
    """None may be another one."""
    rejected(altered("claims", *path, value=value), why)


@pytest.mark.parametrize(("name", "kind"), [("resting", "r"), ("flying", "f")])
def test_shares(name, kind):
    """They are sums of powers of 1/2, to the last one; less may be claimed."""
    share, waiting = Fraction(0), [0]
    for letter in TREE:
        depth = waiting.pop()
        if letter in "01":
            waiting += [depth + 1, depth + 1]
        elif letter == kind:
            share += Fraction(1, 2**depth)
    verify(altered("claims", name, value=str(share)))
    verify(altered("claims", name, value="0"))
    more = str(share + Fraction(1, 2**60))
    rejected(altered("claims", name, value=more), "are a smaller share than claimed")


def at(letter, n=0):
    """Return the place of a letter in the tree."""
    return [k for k, c in enumerate(TREE) if c == letter][n]


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("r", "f", "a cell is not seen to fly"),
        ("f", "r", "a cell is not seen to rest"),
        ("-", "f", "a cell is not seen to fly"),
        ("r", "-", "a smaller share"),
        ("f", "-", "a smaller share"),
        ("r", "x", "hints.tree has another letter"),
        ("r", "0", "ends before its last part|a cell is not seen"),
    ],
)
@pytest.mark.parametrize("n", [0, -1])
def test_letters(old, new, why, n):
    """No cell may have another fate."""
    k = at(old, n)
    claimed = altered("hints", "tree", value=TREE[:k] + new + TREE[k + 1 :])
    rejected(claimed, why)


@pytest.mark.parametrize(
    ("tree", "why"),
    [
        ("", "hints.tree ends before its last part"),
        ("r", "a cell is not seen to rest in time"),
        ("f", "a cell is not seen to fly at the end"),
        ("-", "are a smaller share than claimed"),
        ("0-", "hints.tree ends before its last part"),
        ("--", "hints.tree goes on after its last part"),
        ("0" * 60, "a part is halved too often"),
        ("-" * 1_000_001, "longer than 1000000 letters"),
    ],
)
def test_trees(tree, why):
    """They are read strictly."""
    rejected(altered("hints", "tree", value=tree), why)


def test_cells_that_swap_places():
    """The halves of a part are not those of another."""
    k = at("0")
    rejected(altered("hints", "tree", value=TREE[:k] + "1" + TREE[k + 1 :]), "a cell is not seen")


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        ((*TABLE, "reset", "v"), [["-1/2", "v"]], "h' after a hit is not -e times"),
        ((*TABLE, "to"), ["fly", "rest"], "a hit leads to another mode"),
        ((*TABLE, "rest"), "fly", "h or h' does not stay 0 in fly"),
        ((*FLY, "field", "v"), [["-1"], ["-1/10", "v"]], "-h'' is not m"),
        ((*FLY, "field", "v"), [["-1"], ["-1/10", "y"]], "-h'' is not m"),
        ((*FLY, "field", "v"), [["-1"], ["1/10", "cos"]], "not -h'' times a positive number"),
        ((*FLY, "field", "v"), [["-11/10"]], "not -h'' times a positive number"),
        ((*LEAVE, "value"), [["-1"], ["6/5", "sin"]], "not -h'' times a positive number"),
        ((*LEAVE, "value"), [["1"], ["-6/5", "sin"], ["1", "y"]], "not -h'' times"),
        ((*LEAVE, "value"), [["-1/100"], ["3/250", "sin"]], "not -h'' times a positive number"),
        ((*LEAVE, "value"), [["1", "sin", "sin"]], "not -h'' times a positive number"),
        (("parameters", "omega"), "101/100", "is not -e times|not stay 0"),
    ],
)
def test_other_systems(path, value, why):
    """The system of the certificate is the one in which states rest."""
    rejected(altered(*path, value=value), why)


def test_another_amplitude():
    """A table that vibrates more is another one."""
    text = json.dumps(GOOD).replace("6/5", "5/4").replace("9/5", "15/8")
    rejected(json.loads(text), "a cell is not seen to")


def test_another_guard():
    """A second guard of the mode may be met."""
    ceiling = {"value": [["10"], ["-1", "y"]], "reset": {}, "to": ["fly"]}
    rejected(altered(*FLY, "guards", "ceiling", value=ceiling), "the mode has other guards")


def test_a_third_variable():
    """Shares of its range would be none of an area."""
    given = json.loads(encode(GOOD))
    given["parameters"]["state"].append("z")
    for mode in given["parameters"]["modes"].values():
        mode["field"]["z"] = []
    given["claims"]["box"]["z"] = ["0", "1"]
    rejected(given, "the state has not two variables")


def test_a_guard_of_rest_may_be_a_multiple():
    """Or there may be none: then it rests for ever."""
    verify(altered(*LEAVE, "value", value=[["5"], ["-6", "sin"]]))
    verify(altered(*REST, "guards", value={}))


def test_both_variables_at_once():
    """What depends on y and on v is no side of a rectangle."""
    theorem = contact_basin.ContactBasin(read(encode(GOOD)), lambda _: None)
    for q in (variable("y") + variable("v"), variable("sin")):
        with pytest.raises(Rejected, match="depends on both variables"):
            theorem.side(q)


def test_the_work_is_bounded(monkeypatch):
    """Cells times steps of the grid of times; bits; numbers."""
    rejected(altered("hints", "bits", value="2000"), "more than 1024 bits")
    rejected(altered("claims", "until", value="1" + "0" * 31), "larger than")
    monkeypatch.setattr(contact_basin, "WORK", 1000)
    rejected(GOOD, "cells times steps are more than")


# the engine

END = 7.0
RNG = seeded(41)


def test_the_pull_over_times_contains_it_at_each():
    """Of any two waves, over times of any length; and it is no wider than they are high."""
    for _ in range(rounds(200)):
        m, c, d = (RNG.uniform(-3, 3) for _ in "mcd")
        w, a, b = RNG.uniform(0.3, 3), *sorted(RNG.uniform(0, END) for _ in "ab")
        pull, s = Pull(Wave(*map(Double, (m, c, d, w))), END), np.linspace(a, b, 200)
        found = pull.during(a, b)
        value = m + c * np.cos(w * s) + d * np.sin(w * s)
        assert found.lower <= value.min() + 1e-12
        assert value.max() - 1e-12 <= found.upper
        assert max(found.upper - m, m - found.lower) <= math.hypot(c, d) + 1e-12


def fates(A=1.2, e=0.5, end=END):
    """Return the fates of a ball on a table, h'' = -1 + A sin s."""
    wave = Wave(Double(1.0), Double(0.0), enclosing(Fraction(-A)), Double(1.0))
    return Fates(Pull(wave, end), Double(e), end, end)


def bounced(y, v, A, e, end, least=1e-9):
    """Return whether hits accumulate before the end, from h = y, h' = v at s = 0: in floats.

    Zeros are bracketed in small steps: no formula of the checker is used.
    """
    s, steps = 0.0, 4000
    for _ in range(100):
        grid = s + (end - s) * (np.arange(1, steps + 1) / steps) ** 2
        d = grid - s
        h = y + v * d - d * d / 2 - A * (np.sin(grid) - math.sin(s) - math.cos(s) * d)
        below = np.flatnonzero(h < 0)
        if not len(below):
            return False
        a, b = (s if below[0] == 0 else grid[below[0] - 1]), grid[below[0]]
        for _ in range(60):
            m = (a + b) / 2
            x = m - s
            k = y + v * x - x * x / 2 - A * (math.sin(m) - math.sin(s) - math.cos(s) * x)
            a, b = (m, b) if k > 0 else (a, m)
        x = b - s
        rate = v - x - A * (math.cos(b) - math.cos(s))
        s, y, v = b, 0.0, -e * rate
        if abs(v) < least:
            return True
    return s < end


@pytest.mark.slow
def test_fates_beside_floats():
    """Random cells and random states in them, for tables that vibrate more or less."""
    seen = {"r": 0, "f": 0}
    for _ in range(rounds(150)):
        A, e, end = RNG.uniform(0.1, 1.4), RNG.uniform(0.3, 0.7), RNG.uniform(3, 9)
        size = 2.0 ** -RNG.uniform(3, 8)
        y, v = RNG.uniform(0.01, 1.5), RNG.uniform(-2, 1.5)
        found = fates(A, e, end).of((y, y + size), (v, v + size))
        if found == "-":
            continue
        seen[found] += 1
        for _ in range(5):
            state = y + RNG.uniform(0, size), v + RNG.uniform(0, size)
            assert bounced(*state, A, e, end) == (found == "r")
    assert min(seen.values()) > 10


def test_windows_contain_hits():
    """The first hits of random states of random cells are in the window, with their speeds."""
    known = 0
    for _ in range(rounds(100)):
        A, size = RNG.uniform(0.1, 1.4), 2.0 ** -RNG.uniform(3, 9)
        y, v = RNG.uniform(0.01, 1.5), RNG.uniform(-2, 1.5)
        r = size / 2
        one, none = Double(1.0), Double(0.0)
        same = one, none, none, one
        cell = Cell(0.0, Double(y), Double(v), same, (r, r), v - r, v + r)
        pull = fates(A).pull
        window = Flights(pull, cell).window(END)
        if window is None or window.a == window.b:
            continue
        known += 1
        for _ in range(5):
            p, q = y + RNG.uniform(-r, r), v + RNG.uniform(-r, r)
            s = np.linspace(0, window.b, 2001)
            h = p + q * s - s * s / 2 - A * (np.sin(s) - s)
            rate = q - s - A * (np.cos(s) - 1)
            assert (h[s < window.a] > 0).all()
            assert h[-1] < 0
            inside = (s >= window.a) & (np.abs(h) < 1e-3)
            assert (rate[s >= window.a] < 0).all()
            assert (-rate[inside] > window.speed.lower - 0.02).all()
            assert (-rate[inside] < window.speed.upper + 0.02).all()
    assert known > 30


def lowest(y, v, A, until):
    """Return the least h of the flight from h = y, h' = v at s = 0 to a time: in floats."""
    s = np.linspace(0, until, 4001)
    return (y + v * s - s * s / 2 - A * (np.sin(s) - s)).min()


def test_guesses_only_steer(monkeypatch):
    """Wherever zeros are guessed to be: who flies until the end does not hit; windows are right.

    A window that begins after the end says that there is no hit until then: it has to be proved.
    """
    seen = {"none": 0, "window": 0}
    for _ in range(rounds(400)):
        A, end = RNG.uniform(0.1, 1.4), RNG.uniform(1, 6)
        y, v, r = RNG.uniform(0.01, 1.5), RNG.uniform(-2, 1.5), 2.0 ** -RNG.uniform(6, 12)
        one, none = Double(1.0), Double(0.0)
        cell = Cell(0.0, Double(y), Double(v), (one, none, none, one), (r, r), v - r, v + r)
        flights = Flights(fates(A, end=end).pull, cell)
        first = flights.first()
        near = end if first is None else first[1]
        low, high = near + RNG.uniform(-0.1, 0.1), near + RNG.uniform(-0.1, 0.2)
        monkeypatch.setattr(Flights, "zero", lambda _self, side, _y: (low, high)[side > 0])  # noqa: B023
        late = near if RNG.random() < 0.5 else near + RNG.uniform(-0.05, 0.05)
        window = flights.window(late)
        if window is None:
            seen["none"] += 1
            assert lowest(y, v, A, late) > 0
        elif window.a < window.b:
            seen["window"] += 1
            assert lowest(y, v, A, window.a) > 0
            assert lowest(y, v, A, window.b) < 0
    assert min(seen.values()) > 10


def test_a_window_past_the_end(monkeypatch):
    """All of these flights hit before the end: a guess that they hit later proves nothing."""
    one, none = Double(1.0), Double(0.0)
    r = 2.0**-8
    cell = Cell(0.0, Double(0.5), none, (one, none, none, one), (r, r), -r, r)
    flights = Flights(fates(0.0).pull, cell)  # h = 1/2 - s^2/2
    monkeypatch.setattr(Flights, "first", lambda _: (0.5, 1.5))
    monkeypatch.setattr(Flights, "zero", lambda *_: 1.4)
    window = flights.window(1.25)
    assert window is not None
    assert window.a == window.b


def test_hits_accumulate_before_the_end():
    """A bounce that begins at the end is not over then, however short it is."""
    ball = fates(0.1)
    assert ball.accumulate(6.0, 6.5, 1e-20, 1e-19)
    assert ball.accumulate(6.0, math.nextafter(END, 0), 1e-20, 1e-19)
    assert not ball.accumulate(6.0, END, 1e-20, 1e-19)
    found = ball.bounce(6.0, 6.5, 1e-20, 1.1)
    assert found is not None
    assert found[1] > 6.5


def flight(y, v, A=0.0, mean=1.0):
    """Return the flights from about h = y, h' = v, h'' = -mean + A sin s."""
    one, none = Double(1.0), Double(0.0)
    wave = Wave(Double(mean), none, enclosing(Fraction(-A)), one)
    r = 2.0**-10
    cell = Cell(0.0, Double(y), Double(v), (one, none, none, one), (r, r), v - r, v + r)
    return Flights(Pull(wave, END), cell)


def test_the_middle_does_not_hit_before(monkeypatch):
    """A window of its own begins after no hit."""
    flights = flight(0.5, 0.0)  # hits at s = 1
    whole = flights.window(END)
    alone = Flights(flights.pull, flights.cell._replace(r=(0.0, 0.0), down=0.0, up=0.0))
    thin = alone.among(whole)
    assert whole.a < thin.a < 1 < thin.b < whole.b
    monkeypatch.setattr(Flights, "zero", lambda *_: whole.b)
    late = alone.among(whole)
    assert late.a == late.b


def test_a_hit_while_the_table_falls_away():
    """P < 0 there, so that h may dip between two times: but it decreases."""
    flights = flight(1.926, -1.56, 1.2)
    hit = flights.window(END)
    assert hit.pull.upper < 0
    assert hit.b - hit.a < 0.01
    assert lowest(1.926, -1.56, 1.2, hit.a) > 0
    x = hit.a - 0.1
    assert not flights._stays(x, flights.height(x, flights.pull.sums(x))[0], hit.a, 1e-7)
    assert flights.flies(x, hit.a)
    assert not flights.flies(x, hit.b)
    assert not flight(0.1, -0.5, mean=-1.0).flies(0.0, 1.0)  # it dips below zero and comes back


def test_a_landing_is_as_sharp_as_its_window():
    """Late, when the integrals are large, it is: beside the same in fractions, P = 1."""
    pull, e = flight(0.0, 0.0).pull, Fraction(1, 2)
    a, s, b = (Fraction(5 * 2**20 + k, 2**20) for k in (0, 3, 64))
    speed, ball = Double(0.25), Fates(pull, Double(0.5), END, END)
    hit = Window(float(a), float(s), *(pull.during(float(a), float(s)),) * 2, speed)
    h, v = ball.landed(hit, float(b))
    for t in (a, s):
        rate = e / 4 - (b - t)
        height = e / 4 * (b - t) - (b - t) ** 2 / 2
        assert h.lower <= height <= h.upper
        assert v.lower <= rate <= v.upper
    assert h.rad < s - a
    assert v.rad < s - a


def test_a_cell_of_more_than_a_unit():
    """From h = 8 with |h'| <= 2, P = 1, e = 1/2: all of h' after the hit, in closed form."""
    one, none = Double(1.0), Double(0.0)
    ball = fates(0.0)
    cell = Cell(0.0, Double(8.0), none, (one, none, none, one), (0.0, 2.0), -2.0, 2.0)
    hit = Flights(ball.pull, cell).during(2.47, 6.48)._replace(speed=Double(4.24, 0.24))
    middle = cell._replace(r=(0.0, 0.0), down=0.0, up=0.0)
    thin = Flights(ball.pull, middle).during(3.999, 4.001)
    after = ball.after(cell, hit, thin)
    for v in np.linspace(-2, 2, 41):
        fast = math.sqrt(v * v + 16)
        assert after.down <= 0.5 * fast - (6.48 - (v + fast)) <= after.up


def test_windows_in_which_some_rise():
    """They are none: h' < 0 throughout."""
    flights = flight(0.5, 1.0)  # highest at s = 1, hits at s = 2.41
    rises, falls = flights.hits(0.9, 3.0), flights.hits(1.1, 3.0)
    assert rises.a == rises.b
    assert (falls.a, falls.b) == (1.1, 3.0)


def test_the_integral_of_a_window():
    """It is that of all of its times."""
    flights = flight(0.5, 1.0, 0.5)
    hit = flights.hits(3.5, 4.5)
    assert (hit.a, hit.b) == (3.5, 4.5)
    for s in np.linspace(hit.a, hit.b, 30):
        assert hit.first.lower <= flights.pull.guess(s)[0] <= hit.first.upper


def test_between_two_heights_it_may_dip():
    """h = c - s/2 + s^2/2 comes to c - 1/8: at both ends it is c."""
    flights = flight(0.1, -0.5, mean=-1.0)
    assert not flights._stays(0.0, 0.1, 1.0, 0.1)
    assert not flights._stays(0.0, 0.0, 1.0, 0.4)
    assert flights._stays(0.0, 0.13, 1.0, 0.13)
    dipping = flight(0.05, -0.4, mean=-1.0)  # at 1 h is 0.15, at 1/2 -0.025
    assert dipping._within(0.0, 0.05, 1.0) == (0.0, 0.5)


def test_two_hits_in_a_window():
    """A slow one may be followed by another."""
    one = Double(1.0)
    ball, window = fates(0.0), Window(0.0, 1.0, one, one, one)  # e = 1/2
    assert ball.hits_again(window._replace(speed=Double(0.9)))
    assert not ball.hits_again(window._replace(speed=Double(1.1)))


def test_the_pull_of_a_bounce_is_that_until_its_end():
    """P rises: the next hit is faster than at the pull of the beginning."""
    ball, v, s = fates(1.2), 0.6, 3.5

    def pull(t):
        return 1 - 1.2 * math.sin(t)

    fast, until = ball.bounce(s, s, v, 1.36)
    assert until >= s + 2 * v / pull(s)
    assert fast >= v * math.sqrt(pull(min(until, 1.5 * math.pi)) / pull(s))


def test_the_pull_where_it_turns():
    """What P differs from that in the middle of a time is of second order there."""
    p = fates(1.2).pull
    for a, b in ((1.0, 2.1), (4.2, 5.3), (3.0, 3.4)):
        found = p.during(a, b)
        pulls = 1 - 1.2 * np.sin(np.linspace(a, b, 50))
        assert found.lower <= pulls.min() < found.lower + 0.01
        assert found.upper >= pulls.max() > found.upper - 0.01
    assert fates(1e308).pull.during(1.0, 2.1).lower == -math.inf


def test_the_end_is_between_doubles():
    """Rest is before one, flight until the other."""
    for q in (Fraction(1, 3), Fraction(2, 3), Fraction(10, 3), Fraction(7)):
        early, late = map(Fraction, contact_basin._beside(q))
        assert early <= q <= late
        assert late - early < Fraction(1, 10**15)


def test_no_number_is_no_height():
    """What is not finite proves nothing: not at the beginning, not at the end."""
    flights = Flights(
        fates().pull, Cell(0.0, *(Double(1.0),) * 2, (Double(1.0),) * 4, (0, 0), 1, 1)
    )
    assert flights._stays(0.0, 1.0, 0.1, 1.0)
    assert not flights._stays(0.0, 1.0, 0.1, math.nan)
    assert not flights._stays(0.0, math.nan, 1.5, 1e-9)


def test_what_is_too_long_is_rejected():
    """A time beyond the grid is no time of a flight."""
    with pytest.raises(Rejected):
        fates().pull.sums(1e6)
