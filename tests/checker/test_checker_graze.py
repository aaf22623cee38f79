"""Where a curve of orbits comes to a graze: what is true of it, and lies, each with its reason."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from branches import certificate
from own_systems import rejected

from cap.certificate.writer import dumps
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.contacts import Equations, Round
from cap.checker.system.curve import Curve, Line, exact
from cap.checker.system.graze import drift, inside, sign, turns
from cap.checker.system.legs import Leg
from cap.checker.system.passage import Contact
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.quiet import Watched, stays_positive
from cap.checker.theorems.contacts_branch import ContactsBranch
from cap.checker.verdict import check, words

G, E = 0.1, 0.5  # of the model
PI = math.pi


def fly(t0, z, v, t):
    """Return place and speed of z'' = cos(pi t) + G, integrated by hand."""
    w = v - math.sin(PI * t0) / PI
    d = t - t0
    place = z + w * d - (math.cos(PI * t) - math.cos(PI * t0)) / PI**2 + G * d * d / 2
    return place, w + math.sin(PI * t) / PI + G * d


def equations(u):
    """Return what vanishes: 1:1 orbits of the pair that touch the top at the time tau."""
    t0, v0, t1, s, tau = u
    low, speed = fly(t0, s / 2, -E * v0, t1)
    high, again = fly(t1, -s / 2, -E * speed, t0 + 2)
    touch, slow = fly(t0, s / 2, -E * v0, tau)
    return np.array([low + s / 2, high - s / 2, again - v0, touch - s / 2, slow])


def solved(u):
    """Return the zero of the equations by Newton's method with differences."""
    u = np.array(u, float)
    for _ in range(30):
        f = equations(u)
        J = np.array([(equations(u + h) - equations(u - h)) / 2e-6 for h in 1e-6 * np.eye(5)]).T
        u = u - np.linalg.solve(J, f)
    return u


def test_the_graze_of_the_pair():
    """Parameter and time are those of the equations written by hand."""
    (graze,) = certificate("graze")["claims"]["grazes"]
    (a, b), (c, d) = ([Fraction(q) for q in graze[key]] for key in ("at", "time"))
    *_, s, tau = solved([-0.018, 0.566, 1.474, 0.1743, 0.806])
    assert b - a < Fraction(1, 10**19)
    assert d - c < Fraction(1, 10**18)
    assert float(a) == pytest.approx(s, abs=1e-9)
    assert float(c) == pytest.approx(tau, abs=1e-8)


def test_the_sentence():
    """It says which guard is touched where, and what that means."""
    said = words(check(dumps(certificate("graze")).encode(), lambda _: None))
    assert "to exactly one graze on it, with s in [0.174329428380286936719" in said
    assert "after contact 1, 'top' of 'free' touches 0, its first derivative along" in said
    assert "just beyond it the guard is negative" in said


def test_the_sentence_with_a_symmetry():
    """The leg after the last contact is looked at where its image ends, at the first contact."""
    given = certificate("level")
    (graze,), (cell, *_) = given["claims"]["grazes"], given["claims"]["cells"]
    assert float(graze["time"][1]) < float(cell["centre"][0])
    said = words(check(dumps(given).encode(), lambda _: None))
    assert ", before contact 1, after the image of contact 1, 'bottom' of 'free' touches 0" in said
    assert "vanishes elsewhere but at the contacts, and at the image; until there" in said


def of(part, key, value):
    """Return what changes an entry of a graze."""
    return lambda given: given[part]["grazes"][0].__setitem__(key, value)


def moved(key):
    """Return what moves an interval by its width."""

    def change(given):
        graze = given["claims"]["grazes"][0]
        a, b = map(Fraction, graze[key])
        graze[key] = [str(b), str(2 * b - a)]

    return change


def part(name, **changes):
    """Return what changes a piece."""
    return lambda given: given["claims"]["grazes"][0][name].update(changes)


def far_cell(given):
    """Let the piece go on from the cell at the other end."""
    given["claims"]["grazes"][0]["cell"] = str(len(given["claims"]["cells"]) - 1)


def cut_off(given):
    """Let the cuts of the guard that is touched be none."""
    del given["hints"]["grazes"][0]["cuts"][0]["top"]


def no_window(given):
    """Let the window be none of the pieces."""
    given["hints"]["grazes"][0]["cuts"][0]["top"].pop()


def narrow_wide(given):
    """Let the narrow window begin before the window."""
    graze = given["hints"]["grazes"][0]
    graze["narrow"][0] = str(Fraction(given["claims"]["grazes"][0]["window"][0]) - 1)


def narrow_aside(given):
    """Let the narrow window begin after the touch."""
    graze = given["hints"]["grazes"][0]
    a, b = map(Fraction, graze["narrow"])
    graze["narrow"] = [str(b), str(2 * b - a)]
    given["claims"]["grazes"][0]["time"] = ["0.80590836499319942", "0.80590836499319943"]
    moved("time")(given)


def short_window(given):
    """Let the window end before the touch, and the cuts with it."""
    a, b = given["claims"]["grazes"][0]["window"]
    end = "0.79"
    given["claims"]["grazes"][0]["window"] = [a, end]
    cuts = given["hints"]["grazes"][0]["cuts"][0]["top"]
    cuts[cuts.index(b)] = end
    cuts.append(b)


def other_end(given):
    """Let the short cell be one before the graze."""
    graze = given["claims"]["grazes"][0]
    short, shift = graze["short"], Fraction(1, 10**22)
    rate = [Fraction(q) for q in short["slope"]]
    short["ends"] = [str(Fraction(q) + shift) for q in short["ends"]]
    short["centre"] = [
        str(Fraction(c) + shift * r) for c, r in zip(short["centre"], rate, strict=True)
    ]


LIES = {
    "hints left out": (lambda given: given["hints"].update(grazes=[]), "are not those of claims"),
    "claims left out": (lambda given: given["claims"].update(grazes=[]), "are not those of claims"),
    "no cell": (of("claims", "cell", "999"), r"grazes\[0\] is on no cell"),
    "a far cell": (far_cell, "is not certain to be one curve with its cell"),
    "no leg": (of("claims", "leg", "3"), "a graze is on no leg"),
    "the other leg": (of("claims", "leg", "2"), "a window|the window|a guard"),
    "the other guard": (of("claims", "guard", "bottom"), "a guard may vanish near 0.8059"),
    "no such guard": (of("claims", "guard", "side"), "no such guard to be grazed"),
    "no cuts": (cut_off, "no cuts of a guard with a window"),
    "no window": (no_window, "the window is none of the pieces of its leg"),
    "a window in the other order": (
        lambda given: given["claims"]["grazes"][0]["window"].reverse(),
        "the ends of a window are not in order",
    ),
    "a window before the touch": (short_window, "a guard may not turn|a guard may vanish"),
    "a narrow window outside": (narrow_wide, "is not in its window"),
    "a narrow window beside": (narrow_aside, "does not contain|may not turn"),
    "another place": (moved("at"), "does not contain the enclosure computed"),
    "another time": (moved("time"), "does not contain the enclosure computed"),
    "a legless piece": (
        lambda given: given["hints"]["grazes"][0]["cuts"].pop(),
        "a cell has not a leg a contact",
    ),
    "no reach": (part("piece", reach=["0"] * 7), "the reach of a cell is not positive"),
    "no preconditioner": (
        of("hints", "piece", [["0"] * 6] * 6),
        "K does not lie in the interior of the box of a cell",
    ),
    "no short preconditioner": (
        of("hints", "short", [["0"] * 6] * 6),
        "K does not lie in the interior of the box of a cell",
    ),
    "a short cell beside": (
        other_end,
        "K does not lie in the interior of the box of a cell",
    ),
    "a wider range": (
        lambda given: given["claims"].update(range=["0.1743", "0.19"]),
        "may not go through all of claims.range",
    ),
}


@pytest.mark.parametrize("what", LIES)
def test_lies(what):
    """Each is rejected for its own reason."""
    change, reason = LIES[what]
    given = certificate("graze")
    change(given)
    rejected(given, reason)


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("sign", lambda *_: 0, r"grazes\[0\]: what comes to 0 may not change its sign"),
        ("sign", lambda *_: 1, r"grazes\[0\]: what comes to 0 may not change its sign"),
        (
            "drift",
            lambda *_: Interval.enclosing(-1, 1, 96),
            "what comes to 0 may not be monotone",
        ),
    ],
)
def test_what_is_needed_of_the_least_value(monkeypatch, name, value, reason):
    """It changes its sign, and is monotone."""
    given = certificate("graze")
    monkeypatch.setattr(f"cap.checker.system.graze.{name}", value)
    rejected(given, reason)


def test_a_graze_beside_its_piece(monkeypatch):
    """The short cell lies on the piece."""
    given, theorem = certificate("graze"), "cap.checker.theorems.contacts_branch.ContactsBranch"
    monkeypatch.setattr(f"{theorem}.lies", lambda *_: False)
    rejected(given, r"grazes\[0\] is not certain to be on its piece")


# parts


class Parabola:
    """Flights on which a guard is c + (t - 1)^2, from t = 0 on."""

    def __init__(self, c, bend=2):
        self.c, self.bend, self.start = c, bend, interval(0, 0)

    def over(self, g, t):
        """Return h, L h or L^2 h, which are named so."""
        u = t - interval(1, 1)
        (name,) = g.variables
        found = {"h": u.square() + interval(self.c, self.c), "r": u * 2}
        return found[name] if name in found else interval(self.bend, self.bend)

    def begun(self, g):
        """Return the same at the start."""
        return self.over(g, self.start)


def interval(a, b):
    """Return an interval."""
    return Interval.enclosing(Fraction(a), Fraction(b), 60)


H = Watched(*(Polynomial({(name,): Fraction(1)}) for name in "hrb"))


def test_the_sign_of_a_least_value():
    """Where it is known to be above or below zero, and where not."""
    narrow = interval("0.99", "1.01")
    assert sign(Parabola("1/100"), H, narrow) == 1
    assert sign(Parabola("-1/100"), H, narrow) == -1
    assert sign(Parabola(0), H, narrow) == 0
    assert sign(Parabola("-1/20000"), H, narrow) == 0


def test_what_is_needed_of_a_window():
    """It lies in the leg, the guard is convex in it, and turns."""
    end, window = interval(2, 2), interval("1/2", "3/2")
    turns(Parabola(0), H, end, window)
    with pytest.raises(Rejected, match="a window is not in its leg"):
        turns(Parabola(0), H, interval("3/2", 2), window)
    with pytest.raises(Rejected, match="a window is not in its leg"):
        turns(Parabola(0), H, end, interval(0, "3/2"))
    with pytest.raises(Rejected, match="may not be convex"):
        turns(Parabola(0, 0), H, end, window)
    for beside in (interval("1/2", "3/4"), interval("5/4", "3/2")):
        with pytest.raises(Rejected, match="may not turn"):
            inside(Parabola(0), H, beside)


@pytest.mark.slow
def test_how_a_value_changes_without_a_clock():
    """The first contact is at the time 0: beside differences between the ends of a cell."""
    given = ContactsBranch(read(dumps(certificate("clock")).encode()), lambda _: None)
    contacts = [Contact(**contact) for contact in given.claims["contacts"]]
    given.orbit = Round(given.p, contacts, given.claims["periods"])
    curve = Curve(Equations(given.orbit, given.hints["bits"]))
    assert curve.equations.autonomous
    cell = curve.cell(Line.of(given.claims["cells"][0]), given.hints["preconditioners"][0])
    late = exact(curve.expanded(cell.box)[curve.equations.n + 1].lower / 2, cell.error[0])
    rates = curve.rates(curve.steps(cell.box), cell.line.along)
    for z in given.p.state[:-1]:
        change, values = drift(curve, cell.box, rates, 0, late, variable(z)), []
        for s in cell.line.ends:
            w = cell.at(s)
            after = dict(zip(given.p.state, curve.steps(w)[0].after, strict=True))
            start = curve.equations.start(curve.expanded(w), 0)
            leg = Leg(given.p, given.orbit.flown(0), start, after)
            values.append(leg.over(variable(z), late))
        between = (values[1] - values[0]) / exact(cell.line.ends[1] - cell.line.ends[0], late)
        assert change.lower <= between.lower
        assert between.upper <= change.upper


def test_a_window_is_left_out():
    """In it a guard may be negative; elsewhere it may not, nor is it the first or last piece."""
    flights, end, window = Parabola("-1/100"), interval(2, 2), interval("1/2", "3/2")
    cuts = [Fraction(1, 2), Fraction(3, 2)]
    stays_positive(flights, H, end, cuts, (0, 0), window)
    with pytest.raises(Rejected, match="a guard may vanish"):
        stays_positive(flights, H, end, cuts)
    with pytest.raises(Rejected, match="none of the pieces"):
        stays_positive(flights, H, end, [Fraction(1, 2)], (0, 0), interval(0, "1/2"))
