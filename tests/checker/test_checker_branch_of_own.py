"""Curves of orbits of one's own system: what is true of them, and lies, each with its reason."""

from __future__ import annotations

import math
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from branches import certificate
from own_systems import rejected

from cap.certificate.writer import dumps
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.contacts import Equations, Round
from cap.checker.system.curve import Cell, Curve, Line, determinant, minors
from cap.checker.system.curve_multipliers import happens
from cap.checker.system.curve_sentence import Sentence, _values
from cap.checker.system.passage import Contact
from cap.checker.theorems.contacts_branch import ContactsBranch
from cap.checker.verdict import check, words

E = 0.5


def accepted(given):
    """Return the sentence of a certificate that is accepted."""
    return words(check(dumps(given).encode(), lambda _: None))


@pytest.mark.parametrize(("leg", "mode"), [(1, "up"), (2, "down")])
def test_where_a_graze_is_told(leg, mode):
    """In the mode to which the contact before it leads."""
    graze = {"leg": leg, "cell": 1, "at": "A", "time": "B", "guard": "wall"}
    claims = {"contacts": [{"to": "up"}, {"to": "down"}], "grazes": [graze]}
    (said,) = Sentence(SimpleNamespace(state=("x", "p")), claims).told_grazes()
    assert f"after contact {leg}, 'wall' of '{mode}' touches 0" in said


def point(name, kind):
    """Return a point of a certificate, and where it is."""
    (found,) = (p for p in certificate(name)["claims"]["points"] if p["kind"] == kind)
    return found, [Fraction(q) for q in found["at"]]


def inside(value, low, high):
    """Return whether a number known to 1e-15 may lie between two, which are close."""
    return high - low < Fraction(1, 10**19) and abs(float(low) - value) < 2e-15


def test_the_closed_forms_of_the_ball():
    """It turns back at pi (1 - e)/(1 + e); a multiplier is -1 at Holmes's amplitude."""
    turn = math.pi * (1 - E) / (1 + E)
    assert inside(turn, *point("fold", "fold")[1])
    assert point("fold", "fold")[0]["outside"] in (["0", "1"], ["1", "0"])
    flip = math.hypot(turn, 2 * (1 + E * E) / (1 + E) ** 2)
    assert inside(flip, *point("flip", "flip")[1])
    assert point("flip", "flip")[0]["outside"] == ["0", "1"]
    pi20 = Fraction("3.14159265358979323846264338327950288")
    low, high = point("fold", "fold")[1]
    assert low < pi20 / 3 < high


def test_the_cells_are_near_the_closed_form():
    """cos t = pi (1 - e)/((1 + e) A) just before each bounce, y = A sin t, v = -pi."""
    for name in ("fold", "flip"):
        for cell in certificate(name)["claims"]["cells"]:
            t, y, v, A = (float(Fraction(q)) for q in cell["centre"])
            room = [float(Fraction(q)) for q in cell["reach"]]
            assert abs(A * math.cos(t) - math.pi / 3) < room[0] + room[3] + 1e-12
            assert abs(y - A * math.sin(t)) < room[1] + room[3] + 1e-12
            assert abs(v + math.pi) < room[2] + 1e-12


def test_the_sentence():
    """It says what is a parameter, which values it takes, and what happens where."""
    said = accepted(certificate("fold"))
    assert "its variable A is a parameter, which nothing moves" in said
    assert "A takes on it all values in [1.047197551197, 1.06]" in said
    assert "the curve turns back, and a multiplier is 1: " in said
    assert "1 of the 2 multipliers are outside the unit circle and none on it" in said
    assert "a multiplier is -1: 0 outside the unit circle on one side, 1 on the other" in accepted(
        certificate("flip")
    )
    assert "orbits of an unknown period" in accepted(certificate("clock"))


def along(given, *, parameter):
    """Return the number of a cell along the parameter, or along something else."""
    cells = given["claims"]["cells"]
    size = len(cells[0]["centre"]) - 1
    return next(k for k, c in enumerate(cells) if (int(c["along"]) == size) == parameter)


def scaled(row, c):
    """Return numbers, scaled."""
    return [str(Fraction(q) * c) for q in row]


def cell(k, **changes):
    """Return what changes a cell."""
    return lambda given: given["claims"]["cells"][k].update(changes)


def short(**changes):
    """Return what changes the point."""
    return lambda given: given["claims"]["points"][0].update(changes)


def shifted(given):
    """Move the place of the point by its width."""
    a, b = map(Fraction, given["claims"]["points"][0]["at"])
    given["claims"]["points"][0]["at"] = [str(b), str(2 * b - a)]


def drop(k):
    """Return what leaves out a cell."""

    def change(given):
        for table, key in (("claims", "cells"), ("hints", "preconditioners"), ("hints", "cuts")):
            del given[table][key][k]

    return change


def no_cuts(given):
    """Leave out the cuts of a cell."""
    given["hints"]["cuts"][5][0]["table"] = []


def moves(given):
    """Let the parameter move."""
    given["parameters"]["modes"]["fly"]["field"]["A"] = [["1/1000000"]]


def jumps(given):
    """Let the parameter jump."""
    given["parameters"]["modes"]["fly"]["guards"]["table"]["reset"]["A"] = [["2", "A"]]


def other_system(given):
    """Change the restitution by 1e-9."""
    reset = given["parameters"]["modes"]["fly"]["guards"]["table"]["reset"]["v"]
    term = next(term for term in reset if term[1:] == ["v"])
    term[0] = str(Fraction(term[0]) + Fraction(1, 10**9))


LIES = {
    "a moving parameter": (moves, "A is no parameter: it moves in a mode"),
    "a jumping parameter": (jumps, "A is no parameter: it jumps"),
    "another restitution": (other_system, "K does not lie in|signs at its ends|not certain"),
    "a cell left out": (drop(30), "two cells are not certain to be one curve"),
    "no preconditioner": (
        lambda given: given["hints"]["preconditioners"].__setitem__(3, [["0"] * 3] * 3),
        "K does not lie in the interior of the box of a cell",
    ),
    "a preconditioner too small": (
        lambda given: given["hints"]["preconditioners"].__setitem__(3, [["1"] * 2] * 2),
        "a preconditioner of another size",
    ),
    "a preconditioner with a short row": (
        lambda given: given["hints"]["preconditioners"][3][1].pop(),
        "a preconditioner of another size",
    ),
    "a preconditioner left out": (
        lambda given: given["hints"]["preconditioners"].pop(),
        "hints.preconditioners is not a list of",
    ),
    "cuts left out": (lambda given: given["hints"]["cuts"].pop(), "hints.cuts is not a list of"),
    "a leg left out": (
        lambda given: given["hints"]["cuts"][3].append({}),
        "a cell has not a leg a contact",
    ),
    "no pieces": (no_cuts, "a guard"),
    "points left out": (lambda given: given["hints"]["points"].pop(), "hints.points is not a list"),
    "a wider range": (
        lambda given: given["claims"].update(range=["1.04", "1.06"]),
        "may not go through all of claims.range",
    ),
    "a higher range": (
        lambda given: given["claims"].update(range=["1.05", "1.07"]),
        "may not go through all of claims.range",
    ),
    "a range in the other order": (
        lambda given: given["claims"].update(range=["1.06", "1.05"]),
        "claims.range is not in order",
    ),
    "a wrong count": (
        lambda given: next(c for c in given["claims"]["cells"] if "outside" in c).update(
            outside="2"
        ),
        "so many multipliers are not certain to be outside",
    ),
    "a count where none is clear": (
        lambda given: given["claims"]["cells"][int(given["claims"]["points"][0]["cell"])].update(
            outside="1"
        ),
        "so many multipliers are not certain to be outside",
    ),
    "another kind": (short(kind="flip"), "the signs at its ends are not certain to differ"),
    "a pair": (short(kind="pair"), "the counts do not differ by two"),
    "other counts": (short(outside=["2", "0"]), "not so many multipliers are certain"),
    "another cell": (short(cell="0"), "point 0 is not certain to be on its cell"),
    "no cell": (short(cell="999"), "point 0 is on no cell"),
    "another place": (shifted, "does not contain the enclosure computed"),
    "a wide place": (short(at=["1", "2"]), "is wider than its digits allow"),
    "a slope that is not 1": (
        lambda given: given["claims"]["cells"][0].update(
            slope=scaled(given["claims"]["cells"][0]["slope"], 2)
        ),
        "the slope of a cell is not 1 along it",
    ),
    "ends in the other order": (
        lambda given: given["claims"]["cells"][0]["ends"].reverse(),
        "the ends of a cell are not in order",
    ),
    "no reach": (
        lambda given: given["claims"]["cells"][0].update(
            reach=scaled(given["claims"]["cells"][0]["reach"], 0)
        ),
        "the reach of a cell is not positive",
    ),
    "a small reach": (
        lambda given: given["claims"]["cells"][0].update(
            reach=scaled(given["claims"]["cells"][0]["reach"], Fraction(1, 5))
        ),
        "K does not lie in the interior of the box of a cell",
    ),
    "too few unknowns": (
        lambda given: [given["claims"]["cells"][1][key].pop() for key in ("centre",)],
        "a cell has not 4 unknowns",
    ),
    "along nothing": (cell(0, along="4"), "a cell goes along no unknown"),
    "too many bits": (lambda given: given["hints"].update(bits="1025"), "more than 1024 bits"),
    "another period": (
        lambda given: given["claims"].update(periods="2"),
        "K does not lie in the interior of the box of a cell",
    ),
}


@pytest.mark.parametrize("what", LIES)
def test_lies(what):
    """Each is rejected for its own reason."""
    change, reason = LIES[what]
    given = certificate("fold")
    change(given)
    rejected(given, reason)


def test_a_fold_along_the_parameter():
    """There dp/ds is 1."""
    given = certificate("flip")
    given["claims"]["points"][0]["kind"] = "fold"
    rejected(given, "along the parameter there is no fold")


def test_a_clock_has_no_periods():
    """Without a clock the round is one period, which is unknown."""
    given = certificate("clock")
    given["claims"]["periods"] = "2"
    rejected(given, "claims.periods is not 1, but the system has no clock")


def test_work_is_bounded():
    """Pieces of legs and entries of matrices."""
    given = certificate("fold")
    given["hints"]["cuts"] = [
        [{"table": [str(k) for k in range(1000)]}] for _ in given["hints"]["cuts"]
    ]
    rejected(given, "bits x variables x pieces of legs are more than 2")
    given = certificate("fold")
    given["claims"]["contacts"] *= 64
    given["hints"]["cuts"] = [legs * 64 for legs in given["hints"]["cuts"]]
    cells, row = given["claims"]["cells"], ["1"] * 200
    cells[0].update(centre=row, slope=row, reach=row)
    rejected(given, "cells x unknowns.2 x contacts are more than 2")


def test_a_system_of_a_parameter_alone():
    """Nothing moves in it."""
    given = certificate("fold")
    p = given["parameters"]
    p["state"] = ["A"]
    p["modes"]["fly"]["field"] = {"A": []}
    p["modes"]["fly"]["guards"]["table"].update(reset={}, value=[["1", "A"]])
    rejected(given, "there is no variable but the parameter")


# parts


def thin(q):
    """Return the enclosure of a number."""
    return Interval.enclosing(Fraction(q), Fraction(q), 100)


def test_what_the_parameter_lies_between():
    """On a cell along another unknown, by its slope, either way, and its reach."""
    half, nothing = Fraction(1, 2), Fraction(0)
    for slope in (Fraction(3), Fraction(-3)):
        cell = Line(0, (-half, Fraction(1)), (nothing, Fraction(7)), (1, slope), (0, half))
        low, high = sorted((-half * slope, slope))
        assert _values(cell) == (7 - half + low, 7 + half + high)
    assert _values(cell._replace(along=1)) == (-half, 1)


@pytest.mark.parametrize("count", [1, 2])
def test_the_derivative_of_the_equations(count):
    """It encloses differences of F, by each unknown, by p as well; p is at every contact."""
    given = ContactsBranch(read(dumps(certificate("fold")).encode()), lambda _: None).p
    curve = Curve(Equations(Round(given, [Contact("fly", "table", "fly")] * count, count), 100))
    w = [thin(q) for k in range(count) for q in (Fraction(1 + 25 * k, 4), "1/3", "-3")]
    w, step = [*w, thin("11/10")], thin(Fraction(1, 2**20))
    before = curve.value(w)
    for i in range(len(w)):
        there = [x + step if j == i else x for j, x in enumerate(w)]
        both = zip(w, there, strict=True)
        rows = curve.slope(curve.steps([Interval(x.lo, y.hi, 100) for x, y in both]))
        for row, a, b in zip(rows, before, curve.value(there), strict=True):
            between, found = (b - a) / step, row.get(i, thin(0))
            assert found.width < step.hi * 64
            assert found.lower <= between.upper
            assert between.lower <= found.upper


def test_minors_are_the_symmetric_functions():
    """Of a matrix of numbers, against its characteristic polynomial in doubles."""
    D = [[2, -1, 3, 0], [1, 4, 0, -2], [0, 5, -3, 1], [7, 1, 2, 1]]
    rows = [[thin(q) for q in row] for row in D]
    p = np.poly(np.array(D, float))
    for k in range(1, 5):
        assert float(minors(rows, k).lower) == pytest.approx((-1) ** k * p[k])
    assert float(determinant(rows).lower) == pytest.approx(np.linalg.det(np.array(D, float)))


def test_a_determinant_is_bounded_work(monkeypatch):
    """Of nine rows, each minor of the last ones is computed once: 2^9, not 9! products."""
    multiply, count = Interval.__mul__, []

    def counted(self, other):
        count.append(1)
        return multiply(self, other)

    D = np.random.default_rng(1).integers(1, 9, (9, 9)).tolist()
    rows = [[thin(x) for x in row] for row in D]
    monkeypatch.setattr(Interval, "__mul__", counted)
    found = determinant(rows)
    assert len(count) <= 2 * 9 * 2**8
    assert float(found.lower) == pytest.approx(np.linalg.det(np.array(D, float)))


def test_a_zero_among_those_of_another_cell():
    """Of a cell along another unknown, or the same; at its end, and beyond it."""
    zero = thin(0)
    one = Line(0, (Fraction(0), Fraction(1)), [Fraction(1, 2)] * 2, [Fraction(1)] * 2,
               [Fraction(0), Fraction(1, 10)])  # fmt: skip
    two = one._replace(along=1, reach=[Fraction(1, 10), Fraction(0)])
    cell = Cell(one, [zero, zero])
    for line in (one, two):
        assert cell.holds(line, Fraction(1), [thin(1), thin("21/20")])
    assert not cell.holds(one, Fraction(1), [thin("3/4"), thin("4/5")])
    assert cell.holds(two, Fraction(1), [thin("3/4"), thin("4/5")])
    assert not cell.holds(one, Fraction(2), [thin(2), thin(2)])
    assert not cell.holds(two, Fraction(1), [thin("3/4"), thin("9/10")])
    assert not cell.holds(two, Fraction(1), [thin("11/10"), thin("11/10")])


@pytest.mark.parametrize(("product", "accepted"), [("1/2", True), ("-1", False)])
def test_a_pair_needs_more_than_its_count(product, accepted):
    """Where 1 or -1 may be a multiplier of the short cell, it may be that which passes."""
    found = iter([[thin(0), thin("1/2")], [thin(0), thin(2)], [thin(0), thin(product)]])
    fine = SimpleNamespace(steps=lambda _: [], multipliers=lambda _: next(found))
    line = Line(1, (Fraction(0), Fraction(1)), [], [], [])
    pieces = SimpleNamespace(line=line, at=lambda _: [], box=[])
    given = {"kind": "pair", "outside": [0, 2]}
    if accepted:
        happens(0, given, fine, pieces)
    else:
        with pytest.raises(Rejected, match="a multiplier may be 1 or -1"):
            happens(0, given, fine, pieces)
