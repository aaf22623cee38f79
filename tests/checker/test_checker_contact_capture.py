"""The theorem ``contact_capture``: what is true is verified; each lie is noticed."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import combinations_with_replacement, pairwise
from pathlib import Path

import pytest
from support import seeded

from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.capture import HEIGHT, RATE, Modes, Wall
from cap.checker.system.polynomial import variable
from cap.checker.theorems import load
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

STORED = Path(__file__).parents[2] / "certificates"
EVER, RELEASED, MASSES, FOLLOWED = (
    json.loads((STORED / f"contact_capture-{n}.json").read_text("utf-8")) for n in (1, 2, 3, 4)
)
TURNING = json.loads(
    (Path(__file__).parents[1] / "certificates/accept/contact_capture_oscillator.json").read_text(
        "utf-8"
    )
)
FLY, REST = ("parameters", "modes", "fly"), ("parameters", "modes", "rest")
TABLE = (*FLY, "guards", "table")
STOP, BACK = (("parameters", "modes", m, "guards", "stop") for m in ("left", "right"))


def without(given, *path):
    """Return a copy without a field."""
    *path, last = path
    result = json.loads(encode(given))
    part = result
    for key in path:
        part = part[key]
    del part[last]
    return result


@pytest.mark.parametrize(("given", "steps"), [(EVER, 5), (RELEASED, 6), (MASSES, 5), (FOLLOWED, 6)])
def test_it_is_verified(given, steps):
    """Its steps are told; the schema describes it."""
    assert len(verify(given)) == steps
    fits_the_schema(given)


def test_the_state_follows_from_the_height_and_its_rate():
    """By linear equations, of which the determinant is 9 for a guard that is three times h."""
    given = changed(EVER, *TABLE, "value", [["-3/5", "sin"], ["3", "y"]])
    p = load("contact_capture")(read(encode(given)), lambda _: None).p
    wall = Wall(p, Modes("fly", "table", "fly"), Fraction(1, 2))
    assert wall.at(wall.h, {}) == variable(HEIGHT)
    assert wall.at(wall.rate, {}) == variable(RATE)


def nine(given):
    """Let a hit lead to nine modes."""
    modes = given["modes"]
    more = {f"rest{k}": modes["rest"] for k in range(8)}
    given["modes"] = modes | more
    modes["fly"]["guards"]["table"]["to"] += list(more)


def bent(given):
    """Let h depend on the square of a variable that stays as it is."""
    given["state"].append("z")
    for mode in given["modes"].values():
        mode["field"]["z"] = []
    given["modes"]["fly"]["guards"]["table"]["value"].append(["1", "z", "z"])


def table(**changes):
    """Return what changes the guard of a table."""
    return lambda given: given["modes"]["fly"]["guards"]["table"].update(changes)


MANY = [["1", *z] for k in (2, 3) for z in combinations_with_replacement(("sin", "v", "y"), k)]


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (table(divisor=[["1"], ["1", "v"]]), "what divides a reset is no rational number"),
        (table(reset={"v": [["-1/2", "v"], ["1", *"vvvy"]]}), "a reset has a degree above 3"),
        (table(value=[["1", "y"], *MANY]), "h or h' has more than 16 terms"),
        (nine, "a hit leads to more than 8 modes"),
        (bent, "h or h' is not linear in the state"),
    ],
)
def test_what_is_no_wall(change, why):
    """Each condition refuses something, for its own reason."""
    given = json.loads(encode(EVER))
    change(given["parameters"])
    p = load("contact_capture")(read(encode(given)), lambda _: None).p
    with pytest.raises(Rejected, match=why):
        Wall(p, Modes("fly", "table", "fly"), Fraction(1, 2))


def test_what_is_told():
    """The rule of the model, the box, when hits accumulate, how long it rests."""
    line = words(read(encode(EVER)))
    for part in (
        "mode 'fly', and 'rest' after infinitely many in finite time)",
        "at t = 0 is in the mode 'fly', all guards of which are positive, with (y, v) in [0, 10] x",
        "infinitely often, at times that accumulate at one in [0, 40.651], and until then nothing",
        "is at most 0.613 times that just before the hit before it",
        "in the mode 'rest', with h = h' = 0, for ever",
    ):
        assert part in line
    line = words(read(encode(RELEASED)))
    assert (
        "at least until t = 7.2682960905, and it leaves this mode before t = 7.2682960906" in line
    )


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("start",), "1", "hits accumulate before they begin"),
        (("start",), "2000000", "a time is larger"),
        (("mode",), "rest", "begin in another mode"),
        (("mode",), "nowhere", "begin in another mode"),
        (("box",), {"y": ["0", "10"]}, "claims.box is not one of the state"),
        (("box", "y"), ["0", "11"], "may leave the states that were looked at"),
        (("box", "v"), ["-7", "5"], "may leave the states that were looked at"),
        (("falling",), "rest", "there is no such guard, or mode"),
        (("guard",), "leave", "there is no such guard, or mode"),
        (("rising",), "rest", "h' is not the same in rest"),
        (("restitution",), "500000001/1000000000", "is not -e times that before it"),
        (("restitution",), "499999999/1000000000", "is not -e times that before it"),
        (("restitution",), "0", "0 < e <= 1 does not hold"),
        (("ratio",), "612/1000", "the ratio may be larger than claimed"),
        (("ratio",), "1", "the ratio is not below 1"),
        (("accumulation_time",), ["0", "40"], "may accumulate later than claimed"),
        (("accumulation_time",), ["1/1000", "41.25"], "may accumulate earlier than claimed"),
        (("rests_until",), "100", "not one of claims.rests_until and claims.for_ever"),
        (("released_by",), "100", "claims.released_by without claims.rests_until"),
        (("for_ever",), "no", "is none of: yes"),
    ],
)
def test_each_claim(path, value, why):
    """None may be another one, of a ball that rests for ever."""
    rejected(changed(EVER, "claims", *path, value), why)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("start",), "3.926", "may accumulate earlier than claimed|a hit may be later"),
        (("start",), "3.928", "hits accumulate before they begin"),
        (("box", "y"), ["-0.8486", "-0.74"], "may leave the states|a hit may be later"),
        (("box", "v"), ["-1.5", "-0.2585"], "may leave the states|a hit may be later"),
        (("start",), "2", "may not be positive at hints.state"),
        (("accumulation_time",), ["3.927", "5.88"], "may accumulate later than claimed"),
        (("accumulation_time",), ["3.928", "5.89"], "may accumulate earlier than claimed"),
        (("accumulation_time",), ["3.927", "7.3"], "it rests before hits accumulate"),
        (("rests_until",), "7.2682960907", "it is released before its rest is over"),
        (("rests_until",), "5", "it rests before hits accumulate"),
        (("released_by",), "7.26829609051", "it may rest longer than claimed"),
        (("released_by",), "7.2682960905", "it may rest longer than claimed"),
        (("released_by",), "7", "it is released before its rest is over"),
        (("ratio",), "61/100", "the ratio may be larger than claimed"),
    ],
)
def test_each_claim_of_a_release(path, value, why):
    """Nor of one that is thrown again."""
    rejected(changed(RELEASED, "claims", *path, value), why)


def test_a_rest_that_ends():
    """It is not one for ever, nor longer than it is."""
    claims = {
        k: v for k, v in RELEASED["claims"].items() if k not in ("rests_until", "released_by")
    }
    rejected(RELEASED | {"claims": claims | {"for_ever": "yes"}}, "leave of rest may come to 0")
    rejected(RELEASED | {"claims": claims}, "not one of claims.rests_until and claims.for_ever")
    late = changed(RELEASED, "claims", "rests_until", "7.26829609055")
    rejected(without(late, "claims", "released_by"), "leave of rest may come to 0")


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("pieces", 0, "height"), "40", "may leave the states that were looked at"),
        (("pieces", 0, "speed"), "8", "may leave the states that were looked at"),
        (("pieces", 0, "others"), {"y": ["0", "1"]}, "are not the other variables"),
        (("pieces", 0, "until"), ["14.6", "40.651"], "a hit may be later than its bound"),
        (("pieces", 0, "until"), ["14.715", "40"], "may accumulate later than claimed"),
        (("pieces", 0, "until"), ["14.715"], "there is no time until which hits accumulate"),
        (("pieces", 0, "until"), ["40.651", "14.715"], "the times of a piece are not in order"),
        (("pieces", 0, "until"), ["0", "40.651"], "hits accumulate before they begin"),
        (("pieces", 0, "until"), ["14.715", "15", "40.651"], "a hit may be later than its bound"),
        (("pieces", 0, "hits"), [["1", "2"]], "more hits|not certain to be in its window"),
        (("pieces",), [], "is not a list of 1"),
        (("tree",), "", "hints.tree ends before its last part"),
        (("tree",), "0..", "not as many pieces as are given"),
        (("tree",), "..", "hints.tree goes on after its last part"),
        (("tree",), "-", "left out may have states that are meant"),
        (("tree",), "0.", "hints.tree ends before its last part"),
        (("tree",), "2..", "hints.tree has another letter"),
        (("tree",), "x..", "hints.tree has another letter"),
        (("tree",), "0" * 50, "a piece is halved too often"),
        (("tree",), "0" * 9000, "longer than 8000 letters"),
        (("state", "y"), "11", "hints.state is not in the box"),
        (("state", "y"), "0", "may not be positive at hints.state"),
        (("state",), {"y": "1"}, "hints.state is not a state"),
        (("cuts",), ["0"], "cuts are not in order"),
        (("cuts",), ["100"], "cuts are not in order"),
        (("bits",), "2000", "more than 1024 bits"),
    ],
)
def test_hints(path, value, why):
    """A hint that is wrong proves nothing."""
    rejected(changed(EVER, "hints", *path, value), why)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        ((*TABLE, "rest"), "nowhere", "rests in an unknown mode"),
        ((*TABLE, "rest"), "fly", "h or h' does not stay 0 in fly"),
        ((*TABLE, "reset"), {}, "h' after a hit is not -e times"),
        ((*TABLE, "reset", "v"), [["-1/2", "v"]], "h' after a hit is not -e times"),
        ((*TABLE, "reset", "y"), [["2", "y"]], "h is not 0 after a hit"),
        ((*TABLE, "value"), [["-1/4", "sin"], ["1", "y"]], "h' after a hit is not -e times"),
        ((*TABLE, "value"), [["1", "y", "y"]], "are not linear|not linear in two"),
        ((*TABLE, "to"), ["fly", "rest"], "the mode rest may be open after a hit"),
        ((*TABLE, "to"), ["rest"], "a hit does not lead to fly|may be open"),
        ((*FLY, "field", "v"), [["1"]], "what chatters may be held off"),
        ((*FLY, "field", "v"), [["-1"], ["1/10", "cos"]], "may leave the states|may be larger"),
        ((*REST, "field", "y"), [["1/4", "cos"]], "h or h' does not stay 0 in rest"),
        ((*REST, "field", "v"), [["1/5", "sin"]], "h or h' does not stay 0 in rest"),
        ((*REST, "guards", "leave", "value"), [["1/6"], ["-1/5", "sin"]], "leave of rest may come"),
        ((*REST, "guards", "leave", "value"), [["1", "y"]], "leave of rest may come to 0"),
    ],
)
def test_other_systems(path, value, why):
    """The system in the certificate is the one that is proved to rest."""
    rejected(changed(EVER, *path, value), why)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        ((*STOP, "rest"), "held right", None),
        ((*STOP, "rest"), "rest", "stop of left names another mode of rest than held right"),
        ((*STOP, "rest"), "held left", "stop of left names another mode of rest than held right"),
        ((*STOP, "value"), [["1"]], "is constant"),
        ((*STOP, "value"), [["1", "v"]], "not one guard of left is h' times a positive number"),
        ((*STOP, "value"), [["-1", "v"], ["1"]], "not one guard of left is h' times a positive"),
        ((*STOP, "to"), ["rest"], "stop of left does not lead to right"),
        ((*STOP, "to"), ["right", "held right"], "the mode held right may be open where h' is 0"),
        ((*STOP, "reset"), {"x": [["1"]]}, "stop of left changes the state"),
        ((*STOP, "reset"), {"v": [["1/9"]]}, "stop of left changes the state"),
        ((*STOP, "reset"), {"v": [["-1/2", "v"]]}, None),
        ((*BACK, "value"), [["-1", "v"]], "no guard of right is h' times a negative number"),
        (("claims", "rising"), "right", "h' after a hit|to 0"),
        (
            ("parameters", "modes", "left", "guards", "wall", "value"),
            [["-999/1000"], ["1", "x"]],
            "wall of left may come to 0",
        ),
        (("parameters", "modes", "right", "guards", "wall", "to"), ["left", "rest"], None),
        (
            ("parameters", "modes", "right", "guards", "wall", "to"),
            ["left", "held right"],
            "the mode held right may be open after a hit",
        ),
        (("parameters", "modes", "right", "guards", "wall", "to"), ["left", "right"], None),
        (("parameters", "modes", "right", "guards", "wall", "to"), ["right"], "does not lead to"),
        (("parameters", "modes", "left", "field", "v"), [["-2/5"], ["1", "cos"]], "may leave the"),
        (("parameters", "modes", "left", "field", "v"), [["-2"], ["1", "cos"]], "be held off"),
    ],
)
def test_turns(path, value, why):
    """Where h rises in another mode than it falls, a turn leads from the one to the other."""
    given = changed(TURNING, *path, value)
    if why:
        rejected(given, why)
    else:
        verify(given)


def test_no_mode_of_rest():
    """Where the model does not say what follows infinitely many hits, nothing is proved."""
    rejected(without(EVER, *TABLE, "rest"), "the guard table of fly names no mode of rest")


@pytest.mark.parametrize(
    ("value", "why"),
    [
        ([["10"], ["-1", "y"]], "ceiling of fly may come to 0"),
        ([["42"], ["-1", "y"]], None),
        ([["2", "y"], ["-2/5", "sin"]], "ceiling of fly may come to 0"),
    ],
)
def test_another_guard(value, why):
    """One that is met, and one that is not: h ≤ 41; and the table twice."""
    ceiling = {"value": value, "reset": {}, "to": ["fly"]}
    given = changed(EVER, *FLY, "guards", "ceiling", ceiling)
    if why:
        rejected(given, why)
    else:
        verify(given)


@pytest.mark.parametrize(
    ("part", "path", "value", "why"),
    [
        ("hints", ("pieces", 0, "others", "p"), ["0.48", "0.52"], "p may leave its box"),
        ("hints", ("pieces", 0, "others", "u"), ["-0.01", "0.01"], "u may leave its box"),
        ("hints", ("pieces", 0, "others"), {}, "are not the other variables"),
        ("claims", ("box", "p"), ["0.4", "0.501"], "p may leave its box"),
        ("claims", ("box", "q"), ["0.09", "0.1"], "may leave the states"),
        ("claims", ("box", "v"), ["-0.01", "0.01"], "may leave the states"),
        ("claims", ("rests_until",), "1", "may leave its box"),
        ("claims", ("for_ever",), "yes", "not one of"),
    ],
)
def test_other_variables(part, path, value, why):
    """They stay in a box, which is proved."""
    rejected(changed(MASSES, part, *path, value), why)


def test_a_hit_that_moves_another_variable():
    """It is none of this theorem."""
    reset = ("parameters", "modes", "free", "guards", "wall", "reset", "u")
    rejected(changed(MASSES, *reset, [["-1", "u"]]), "a hit changes another variable")


def with_another(given, guard=()):
    """Return a certificate with a variable z, z' = 1, which a guard of rest may depend on."""
    given = json.loads(encode(given))
    given["parameters"]["state"].append("z")
    for mode in given["parameters"]["modes"].values():
        mode["field"]["z"] = [["1"]]
    given["parameters"]["modes"]["rest"]["guards"]["leave"]["value"] += guard
    given["claims"]["box"]["z"] = ["0", "0"]
    given["hints"]["state"]["z"] = "0"
    given["hints"]["pieces"][0]["others"]["z"] = ["-1/10", "5/2"]
    return given


def test_others_matter_no_longer_than_they_have_to():
    """Until hits accumulate; to the end of the rest only if its guards depend on them."""
    verify(with_another(RELEASED))
    rejected(with_another(RELEASED, [["1/1000000000", "z"]]), "z may leave its box")
    short = with_another(RELEASED)
    short["hints"]["pieces"][0]["others"]["z"] = ["-1/10", "19/10"]
    rejected(short, "z may leave its box")


def test_others_that_the_clock_moves():
    """z' is almost 0 when the motions begin, not later."""
    given = with_another(RELEASED)
    given["hints"]["pieces"][0]["others"]["z"] = ["-1/100", "1/100"]
    for mode in given["parameters"]["modes"].values():
        mode["field"]["z"] = [["707113/1000000"], ["1", "sin"]]
    rejected(given, "z may leave its box")


def rising(**box):
    """Return the certificate of motions that begin in the mode that rises, at the wall."""
    given = changed(TURNING, "claims", "mode", "left")
    given["claims"]["box"] |= {"v": ["-0.03", "-0.001"]} | box
    given["hints"]["state"] = {"x": "0.999", "v": "-0.01"}
    return given


def test_motions_that_begin_to_rise():
    """They may not be beyond the wall; no first hit of theirs is followed."""
    verify(rising())
    rejected(rising(x=["0.998", "1.001"]), "h may be negative in the box")
    followed = changed(rising(), "claims", "followed", "1")
    hits = changed(followed, "hints", "pieces", 0, "hits", [["0.01", "0.02"]])
    rejected(hits, "hits are followed from the falling mode")


def test_for_ever_among_others():
    """What depends on other variables is not claimed for all times."""
    given = changed(without(MASSES, "claims", "rests_until"), "claims", "for_ever", "yes")
    rejected(given, "a guard of the mode of rest depends on other variables")


@pytest.mark.parametrize("end", ["-11", "-3", "-2"])
def test_a_window_that_ends_before_it_begins(end):
    """Thrown up, a ball is first met at 11.7; backward in time it was below the table, too."""
    given = changed(EVER, "claims", "box", {"y": ["9.9", "10"], "v": ["4.9", "5"]})
    given = changed(given, "hints", "state", {"y": "9.95", "v": "4.95"})
    given = changed(given, "claims", "accumulation_time", ["0", "8.1"])
    given = changed(given, "claims", "followed", "1")
    piece = {"hits": [["8", end]], "until": ["8.1"]}
    given["hints"]["pieces"][0] |= piece
    rejected(given, "has lower > upper")


def test_times_are_exact():
    """The least time of accumulation is that of a fall, for a box that is above the table."""
    box = {"y": ["1", "2"], "v": ["0", "0"]}
    given = changed(changed(EVER, "claims", "box", box), "hints", "state", {"y": "1", "v": "0"})
    verify(changed(given, "claims", "accumulation_time", ["1", "40.651"]))
    late = changed(given, "claims", "accumulation_time", ["2", "40.651"])
    rejected(late, "earlier than claimed")
    assert Fraction(given["claims"]["ratio"]) < 1


FIRST = ("pieces", 0, "hits", 0)


@pytest.mark.parametrize(
    ("part", "path", "value", "why"),
    [
        ("hints", FIRST, ["4.378", "4.384963301077"], "not certain to be in its window"),
        ("hints", FIRST, ["4.372434716499", "4.379"], "not certain to be in its window"),
        ("hints", FIRST, ["2", "4.384963301077"], "the windows of hits are not in order"),
        ("hints", ("pieces", 0, "hits"), [["5", "5.1"]], "not certain to be in its window"),
        ("hints", ("pieces", 0, "until", 0), "5", "a hit may be later than its bound"),
        ("hints", ("pieces", 0, "until", 19), "6.5", "may accumulate later than claimed"),
        ("hints", ("pieces", 0, "speed"), "1.4", "may leave the states"),
        ("hints", ("pieces", 0, "height"), "0.13", "may leave the states"),
        ("claims", ("followed",), "1", "more hits are followed than claimed"),
        ("claims", ("ratio",), "0.916", "the ratio may be larger than claimed"),
        ("claims", ("start",), "3.01", "not certain to be in its window"),
        ("claims", ("box", "y"), ["0.5", "0.6"], "not certain to be in its window"),
        ("claims", ("box", "v"), ["-0.6", "-0.49"], "not certain to be in its window"),
        ("claims", ("accumulation_time",), ["4.3725", "6.582694"], "earlier than claimed"),
        ("claims", ("accumulation_time",), ["4.372434716499", "6.58"], "later than claimed"),
    ],
)
def test_hits_that_are_followed(part, path, value, why):
    """Each window has one hit of every motion of its piece; the ratio is claimed after them."""
    rejected(changed(FOLLOWED, part, *path, value), why)


def test_a_guard_on_the_way():
    """A floor that is met before the first hit, one while hits accumulate, and one far below."""
    for height, why in (
        ("0.5", "too many pieces"),
        ("1.16", "floor of fly may come to 0"),
        ("2", None),
    ):
        floor = {"value": [[height], ["1", "y"]], "reset": {}, "to": ["fly"]}
        given = changed(FOLLOWED, *FLY, "guards", "floor", floor)
        if why:
            rejected(given, why)
        else:
            verify(given)


def test_hits_are_followed_in_one_mode():
    """A hit that may lead elsewhere is none of those that are followed."""
    given = changed(FOLLOWED, *TABLE, "to", ["fly", "rest"])
    rejected(given, "hits are followed in one mode alone")


def test_a_part_that_is_left_out():
    """The half of a box that lies below the table has no states that are meant."""
    box = {"y": ["-1.2", "1"], "v": ["0", "0"]}
    given = changed(changed(EVER, "claims", "box", box), "hints", "state", {"y": "1", "v": "0"})
    verify(changed(given, "hints", "tree", "0-."))
    rejected(changed(given, "hints", "tree", "0.-"), "left out may have states")
    pieces = given["hints"]["pieces"] * 2
    both = changed(changed(given, "hints", "tree", "0.."), "hints", "pieces", pieces)
    rejected(both, "a piece has no states that are meant")


def bounces(A, t, y, v):
    """Give times and speeds of the bounces of a ball, e = 1/2, in floats, until they are slow."""
    speed = 1.0
    step = 2e-3
    while speed > 1e-5:
        height = lambda s: y + v * s - s * s / 2 - A * math.sin(t + s)  # noqa: B023, E731
        b = step
        while height(b) > 0:
            b += step
        a = b - step
        for _ in range(50):
            m = (a + b) / 2
            a, b = (m, b) if height(m) > 0 else (a, m)
        t, v = t + b, v - b
        y, table = A * math.sin(t), A * math.cos(t)
        speed, v = table - v, table - (v - table) / 2
        step = speed / 400
        yield t, speed


@pytest.mark.parametrize(("given", "A"), [(EVER, 0.2), (RELEASED, 1.2), (FOLLOWED, 1.2)])
def test_motions_in_floats(given, A):
    """Hits of random states of the box accumulate when it is claimed, with the ratio claimed."""
    claims, random = given["claims"], seeded(1)
    box = [tuple(map(float, claims["box"][z])) for z in ("y", "v")]
    low, high = map(float, claims["accumulation_time"])
    start, count = float(claims["start"]), 0
    while count < 20:
        y, v = (random.uniform(*side) for side in box)
        if y <= A * math.sin(start):
            continue
        count += 1
        times, speeds = zip(*bounces(A, start, y, v), strict=True)
        assert low < times[-1] < high
        pairs = pairwise(speeds[max(int(claims["followed"]) - 1, 0) :])
        assert all(after < float(claims["ratio"]) * before for before, after in pairs)
