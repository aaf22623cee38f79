"""A family of periodic orbits: what is true of it, and lies, each rejected for its own reason."""

from __future__ import annotations

import json
from copy import deepcopy
from fractions import Fraction
from pathlib import Path

import mpmath
import pytest
from own_systems import rejected

from cap.certificate.writer import dumps
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.family import Linear, _named, exact
from cap.checker.system.model import Mode, Model
from cap.checker.system.polynomial import ONE, Polynomial, variable
from cap.checker.theorems.contacts_family import ContactsFamily
from cap.checker.verdict import check, words

STORED = json.loads(Path("certificates/contacts_family-1.json").read_text("utf-8"))
x, v, y, u, cos, sin = map(variable, ("x", "v", "y", "u", "cos", "sin"))


def given():
    """Return the stored certificate, which may be changed."""
    return deepcopy(STORED)


def claim(key, value):
    """Return what changes a claim."""
    return lambda lie: lie["claims"].__setitem__(key, value)


def hint(key, value):
    """Return what changes a hint."""
    return lambda lie: lie["hints"].__setitem__(key, value)


def state(contact, place, value):
    """Return what changes a variable of a state."""
    return lambda lie: lie["claims"]["states"][contact].__setitem__(place, value)


def mode(name, *path, value):
    """Return what changes a mode of the system."""

    def change(lie):
        part = lie["parameters"]["modes"][name]
        for key in path[:-1]:
            part = part[key]
        part[path[-1]] = value

    return change


def system(key, value):
    """Return what changes the system."""
    return lambda lie: lie["parameters"].__setitem__(key, value)


def friction(lie):
    """Let the friction on the way to the left be so large that the mass stops before."""
    mode("left", "field", "v", value=[["3/2"], ["1", "cos"], ["-1", "x"]])(lie)


def sticky(lie):
    """Let the mass rest where the force is less than 2/5."""
    guards = lie["parameters"]["modes"]["rest"]["guards"]
    guards["to right"]["value"] = [["2/5"], ["-1", "cos"], ["1", "x"]]
    guards["to left"]["value"] = [["2/5"], ["1", "cos"], ["-1", "x"]]


def called_c(lie):
    """Let the velocity be called c."""
    lie["parameters"] = json.loads(dumps(lie["parameters"]).replace('"v"', '"c"'))


def popped(where, key):
    """Return what takes the last of a list away."""
    return lambda lie: lie[where][key].pop()


LEADS = "does not lead to the next contact"
LIES = {
    "a state aside": (state(1, 0, ["-2666666667/1000000000", "1"]), LEADS),
    "another slope": (state(1, 0, ["-8/3", "2"]), LEADS),
    "a single orbit": (
        claim("states", [[["6/5", "0"], ["0", "0"]], [["-22/15", "0"], ["0", "0"]]]),
        "nothing depends on c",
    ),
    "a mass that moves": (state(0, 1, ["0", "1/1000"]), "contact 1: its guard does not vanish"),
    "too many variables": (state(0, 0, ["0", "1", "0"]), "list of 2|is not"),
    "a variable more": (
        lambda lie: [q.append(["0", "0"]) for q in lie["claims"]["states"]],
        "a state has not 2 variables",
    ),
    "a variable c": (called_c, "has the name of the number c"),
    "a quarter later": (claim("quarters", ["0", "3"]), f"quarters of a turn|{LEADS}"),
    "a period later": (claim("quarters", ["0", "6"]), "the contacts are not in order"),
    "the other order": (claim("quarters", ["2", "0"]), "the contacts are not in order"),
    "two periods": (claim("periods", "2"), "a guard may vanish|too long for an exponential"),
    "one contact": (popped("claims", "contacts"), "is not a list of 1"),
    "the other way": (
        lambda lie: lie["claims"]["contacts"].reverse(),
        "a guard may vanish again just after the start",
    ),
    "no clock": (hint("frequencies", ["1"]), "no sums of these frequencies"),
    "no spring": (hint("frequencies", ["1/2"]), "no sums of these frequencies"),
    "a frequency twice": (hint("frequencies", ["1/2", "1", "1"]), "positive and different"),
    "a negative one": (hint("frequencies", ["1/2", "-1"]), "positive and different"),
    "one too many": (hint("frequencies", ["1/2", "1", "1/3"]), "quarters of a turn"),
    "a longer range": (
        lambda lie: lie["claims"]["range"].__setitem__(1, "1.5667"),
        "a guard may vanish|may be crossed|may not be crossed|may be open",
    ),
    "a lower range": (
        lambda lie: lie["claims"]["range"].__setitem__(0, "1.0999"),
        "a guard may vanish|may not be crossed|may be open",
    ),
    "no range": (claim("range", ["1.3", "1.3"]), "the parts of the range are not in order"),
    "parts in another order": (
        lambda lie: lie["hints"]["parts"].reverse(),
        "the parts of the range are not in order",
    ),
    "a part without cuts": (popped("hints", "cuts"), "hints.cuts is not a list of"),
    "a leg without cuts": (
        lambda lie: lie["hints"]["cuts"][3].pop(),
        "a part has not a leg a contact",
    ),
    "no cuts of a guard": (
        lambda lie: lie["hints"]["cuts"][3][0].clear(),
        "no cuts, and no Lemma M, for stop",
    ),
    "one piece": (
        lambda lie: lie["hints"]["cuts"][3][0].__setitem__("stop", []),
        "0 at both ends of a piece",
    ),
    "a smaller product": (claim("product", ["-0.0074", "0.28"]), "claims.product does not contain"),
    "a positive product": (claim("product", ["0.001", "0.3179"]), "claims.product does not"),
    "too many bits": (hint("bits", "2000"), "more than 1024 bits|is not from"),
    "another friction": (friction, "a guard may vanish"),
    "another frequency": (system("omega", "500000001/1000000000"), "no sums of these frequencies"),
    "pi in the clock": (system("times_pi", "1"), "the clock has no rational frequency"),
    "damping": (
        mode("left", "field", "v", value=[["1/10"], ["1", "cos"], ["-1", "x"], ["-1/100", "v"]]),
        "no sums of these frequencies",
    ),
    "a mass that sticks": (sticky, "another mode may be open after a contact"),
    "a divisor": (
        mode("right", "guards", "stop", "divisor", value=[["2"]]),
        "contact 1: a reset has a divisor",
    ),
    "another spring": (
        mode("left", "field", "v", value=[["1/10"], ["1", "cos"], ["-1000000001/1000000000", "x"]]),
        "no sums of these frequencies",
    ),
    "a stronger force": (
        mode("left", "field", "v", value=[["1/10"], ["1000000001/1000000000", "cos"], ["-1", "x"]]),
        LEADS,
    ),
    "a guard with pi": (
        mode("right", "guards", "stop", "value", value=[["1", "v", "pi"]]),
        "contact 1: more than the state and the clock occurs",
    ),
    "a reset that moves it": (
        mode("right", "guards", "stop", "reset", value={"v": [], "x": [["1", "x"], ["1/100"]]}),
        LEADS,
    ),
}


@pytest.mark.parametrize("what", LIES)
def test_lies(what):
    """Each is rejected for its own reason."""
    change, reason = LIES[what]
    lie = given()
    change(lie)
    rejected(lie, reason)


def test_more_frequencies_do_no_harm():
    """What is no frequency of a flight may be listed, if its angles are quarters of turns."""
    more = given()
    more["hints"]["frequencies"] = ["1/2", "1", "3"]
    check(dumps(more).encode(), lambda _: None)


def test_one_contact():
    """It is a round, too."""
    hints = {"bits": 64, "parts": [], "cuts": [[{}]]}
    claims = {"contacts": [{}], "quarters": [0], "states": [[(0, 1), (1, 0)]]}
    ContactsFamily.limit(hints, claims)
    with pytest.raises(Rejected, match=r"claims.states is not a list of 1"):
        ContactsFamily.limit(hints, claims | {"states": []})
    with pytest.raises(Rejected, match="bits x variables x pieces of legs"):
        ContactsFamily.limit(hints | {"cuts": [[{"wall": range(1 << 18)}]]}, claims)


def test_the_sentence():
    """It says for which c there are orbits, which, and what their multipliers are."""
    said = words(check(dumps(STORED).encode(), lambda _: None))
    low, high = STORED["claims"]["range"]
    assert f"for every c from {low} to {high} it has an orbit of period 1 x 2 pi/omega" in said
    assert "'stop' of 'right' at t = 0 with (x, v) = (c, 0), then 'left'" in said
    assert "at t = 1/2 x 2 pi/omega with (x, v) = (c - 8/3, 0), then 'right'" in said
    assert "one of their 2 multipliers is 1, the other is in [-0.0074, 0.3179], inside" in said


def test_more_variables():
    """Two that each stop makes smaller: of four multipliers the product of all is told."""
    more, names = given(), ["a", "b"]
    more["parameters"]["state"] += names
    for part in more["parameters"]["modes"].values():
        part["field"] |= {z: [] for z in names}
    for key in ("right", "left"):
        reset = {z: [["-9/10", z]] for z in names}
        more["parameters"]["modes"][key]["guards"]["stop"]["reset"] |= reset
    for q in more["claims"]["states"]:
        q += [["0", "0"] for _ in names]
    ends = more["hints"]["parts"][41:43]
    more["claims"] |= {"range": ends, "product": ["0.17", "0.2"]}
    more["hints"] |= {"parts": [], "cuts": more["hints"]["cuts"][42:43]}
    said = words(check(dumps(more).encode(), lambda _: None))
    assert "one of their 4 multipliers is 1, the product of all is in [0.17, 0.2]" in said
    K, C = 1 / 3, sum(map(float, map(Fraction, ends))) / 2 - 4 / 3 - 0.1
    other = (K + C) * (K - 0.2 - C) / ((K + C + 0.2) * (K - C))
    assert 0.17 < other * 0.9**4 < 0.2
    more["claims"]["product"] = ["0.17", "0.183"]
    rejected(more, "claims.product does not contain")


# flights


@pytest.mark.parametrize("quarter", range(-3, 9))
def test_the_clock_at_quarters(quarter):
    """It turns by a right angle with each."""
    found = _named(springs(), [Linear(Fraction(k), Fraction(1)) for k in range(4)], quarter)
    turn = 1j**quarter
    assert (found["cos"], found["sin"]) == tuple(
        Polynomial.of(Fraction(round(part))) for part in (turn.real, turn.imag)
    )
    assert found["y"] == variable("c") + 2


def springs():
    """Return two coupled springs of the frequencies 1 and 2, forced."""
    field = {
        "x": v,
        "v": x * Fraction(-5, 2) + y * Fraction(3, 2) + cos + Fraction(1, 7),
        "y": u,
        "u": x * Fraction(3, 2) + y * Fraction(-5, 2) + sin * 2,
    }
    rest = dict.fromkeys("xvyu", Polynomial({}))
    fall = {"x": v, "v": ONE, "y": u, "u": ONE}
    modes = {"fly": Mode(field, {}), "rest": Mode(rest, {}), "fall": Mode(fall, {})}
    return Model(("x", "v", "y", "u"), Fraction(1, 2), modes)


@pytest.mark.parametrize("quarters", [1, 2, 3, 5, -2])
def test_flights_are_exact(quarters):
    """They are those of the exponential of the matrix written by hand."""
    M = mpmath.matrix(7, 7)
    M[0, 1] = M[2, 3] = 1
    M[1, 0], M[1, 2], M[1, 4], M[1, 6] = -2.5, 1.5, 1, mpmath.mpf(1) / 7
    M[3, 0], M[3, 2], M[3, 5] = 1.5, -2.5, 2
    M[4, 5], M[5, 4] = -0.5, 0.5
    found = exact(springs(), "fly", quarters, [Fraction(1, 2), Fraction(1), Fraction(2)])
    near = mpmath.expm(M * (quarters * mpmath.pi))
    assert all(abs(float(found[i][j]) - float(near[i, j])) < 1e-9
               for i in range(7) for j in range(7))  # fmt: skip


def test_flights_that_are_not():
    """A frequency is missing, the angle is no quarter of a turn, or they grow."""
    half, one, two = Fraction(1, 2), Fraction(1), Fraction(2)
    with pytest.raises(Rejected, match="no sums"):
        exact(springs(), "fly", 2, [half, one])
    with pytest.raises(Rejected, match="no sums"):
        exact(springs(), "fall", 2, [half, one, two])
    with pytest.raises(Rejected, match="quarters of a turn"):
        exact(springs(), "rest", 1, [half, Fraction(1, 3)])
    at_rest = exact(springs(), "rest", 1, [half])
    assert [row[:4] for row in at_rest[:4]] == [[int(i == j) for j in range(4)] for i in range(4)]
