"""The theorem ``contact_attractor``: what is true, and lies."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.passage import Contact
from cap.checker.system.releases import Releases
from cap.checker.theorems import contact_attractor
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

pytestmark = pytest.mark.usefixtures("release_cells_proved_once")

ROOT = Path(__file__).parents[2]
BELT = json.loads((ROOT / "certificates/contact_attractor-1.json").read_text("utf-8"))
TOSS = json.loads(
    (ROOT / "tests/certificates/accept/contact_attractor_toss.json").read_text("utf-8")
)
TINY = Fraction(1, 10**8)
BITS = 96


def releases(certificate):
    """Return F of a certificate."""
    contacts = [Contact(**contact) for contact in certificate["claims"]["contacts"]]
    given = matched(certificate["parameters"], SYSTEM, "the system")
    return Releases(model(given), contacts, BITS)


def exactly(q):
    """Return a number as an interval."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def windows(cell):
    """Return the windows of a cell."""
    return [Interval.enclosing(*map(Fraction, ends), BITS) for ends in cell["windows"]]


def test_one_orbit_attracts():
    """The steps are told; the schema describes it; the sentence has its system and numbers."""
    assert len(verify(BELT)) == 5
    fits_the_schema(BELT)
    line = words(read(encode(BELT)))
    for part in (
        "x' = 1/2, v' = 0, while 31/20 - 1/2 cos(omega t) + x > 0 ('ahead'",
        "a release is where 'back' of 'stick' falls through 0",
        "x = 29/20 + 1/2 cos(omega t) just before",
        "with the contacts 'catch' of 'slower', then 'stick', in order",
        "less 2 x 2 pi/omega",
        "exactly one fixed point there, in [4.7023317748, 4.7023317948]",
    ):
        assert part in line


def test_entropy():
    """Of a ball that is tossed again when it is caught: t' = t + 2 pi + 4.3 cos t."""
    fits_the_schema(TOSS)
    line = words(check(encode(TOSS), lambda _: None))
    assert "v becomes 43/20 cos(omega t) + pi" in line
    assert "the topological entropy of G on it lies in [0.8785" in line
    assert "one period 2 pi/omega lies in [0.8785" in line
    assert "released in [4.8941673962, 10.8137963675] have at the time 10.8137963675; G has" in line
    assert "at least 1, 3, 4, 10, 14, 30, " in line
    assert "orbits of all least periods, as it has one of the least period 3" in line


@pytest.mark.parametrize("k", [0, 10, 40])
def test_a_map_in_closed_form(k):
    """F and F' of the tossed ball, over a cell and at its end."""
    F, cells = releases(TOSS), TOSS["hints"]["cells"]
    low = TOSS["claims"]["interval"][0] if k == 0 else cells[k - 1]["to"]
    cell = cells[k]
    t = float(low)
    at = F.at(exactly(low), windows(cell))
    wide = F.over(Interval.enclosing(Fraction(low), Fraction(cell["to"]), BITS), windows(cell))
    known = t + 2 * math.pi + 4.3 * math.cos(t), 1 - 4.3 * math.sin(t)
    for value, found, over in zip(
        known, (at.time, at.by[0]), (wide[-1].time, wide[-1].by[0]), strict=True
    ):
        assert abs(float(found.midpoint().lower) - value) < 1e-12
        assert over.lower <= found.lower <= found.upper <= over.upper


def test_derivatives_are_those_of_differences():
    """Of the belt, whose flights have a spring and drag."""
    F, cell = releases(BELT), BELT["hints"]["cells"][9]
    t, h = Fraction(cell["to"]), Fraction(1, 10**8)
    one, other = (F.at(exactly(s), windows(cell)).time for s in (t - h, t))
    slope = F.at(exactly(t), windows(cell)).by[0]
    assert float((other - one).lower / h) == pytest.approx(float(slope.lower), abs=1e-6)


# lies about what is claimed


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("claims", "rate"), "0.4", "lambda may be larger"),
        (("claims", "rate"), "0", "between 0 and 1"),
        (("claims", "rate"), "1", "between 0 and 1"),
        (("claims", "rate"), "1/3", "15 places"),
        (("claims", "periods"), "1", "take I into itself"),
        (("claims", "periods"), "3", "take I into itself"),
        (("claims", "fixed"), ["4.7023317749", "4.7023317750"], "elsewhere"),
        (("claims", "fixed"), ["4.7023317900", "4.7023317901"], "elsewhere"),
        (("claims", "fixed"), ["3", "4.8"], "not in I"),
        (("claims", "interval", 0), "3.6", "own|zero|fall|defined|begin"),
        (("claims", "interval", 1), "5.2", "do not cover"),
        (("claims", "interval", 1), "8", "not shorter than a period"),
        (("claims", "interval", 1), BELT["claims"]["interval"][0], "cells are not in order"),
        (("claims", "contacts", 0, "guard"), "ahead", "does not lead|another mode"),
        (("claims", "contacts", 0, "to"), "faster", "does not lead"),
        (("claims", "contacts", 1, "guard"), "turn", "there is no guard"),
        (("hints", "cells", 0, "to"), "3.7", "cells are not in order"),
        (("hints", "cells", 5, "windows"), [["0", "1"]], "not one window"),
        (("hints", "cells", 5, "windows", 0), ["4", "4.1"], "zero|fall"),
        (("hints", "cells", 5, "windows", 1), ["3", "20"], "begins before"),
        (("hints", "weights", 3), "0", "not positive"),
        (("hints", "weights"), ["1"], "not one weight"),
        (("hints", "weights", 30), "1" + "0" * 40, "lambda may be larger"),
        (("hints", "bits"), "257", "above 256"),
    ],
)
def test_lies(path, value, why):
    """Each is rejected for its reason."""
    rejected(changed(BELT, *path, value), why)


@pytest.mark.parametrize(
    ("given", "name", "step", "why"),
    [
        (BELT, "rate", -3, "lambda may be larger"),
        (TOSS, "laps", -3, "B may grow faster"),
        (TOSS, "growth", 1, "matrix may not grow"),
    ],
)
def test_the_smallest_lie(given, name, step, why):
    """The rate, the growth, and that of laps are as good as their last digits allow."""
    value = Fraction(given["claims"][name]) + step * TINY
    rejected(changed(given, "claims", name, f"{float(value):.8f}"), why)


@pytest.mark.parametrize("name", ["entropy", "entropy_per_period"])
@pytest.mark.parametrize("end", [0, 1])
def test_the_smallest_lie_about_entropy(name, end):
    """Both bounds are as near as their last digits allow."""
    value = Fraction(TOSS["claims"][name][end]) + (2, -2)[end] * TINY
    why = "another one" if "period" in name else ("below", "above")[end]
    rejected(changed(TOSS, "claims", name, end, f"{float(value):.8f}"), why)


@pytest.mark.parametrize("m", range(12))
def test_one_orbit_more(m):
    """Of each period one more is not proved."""
    more = str(int(TOSS["claims"]["orbits"][m]) + 1)
    rejected(changed(TOSS, "claims", "orbits", m, more), "orbits may be fewer")


@pytest.mark.parametrize(("m", "period"), [(2, "5"), (2, "2"), (2, "1"), (2, "12")])
def test_a_period_that_is_not_the_first(m, period):
    """It is the first one in the order among those claimed."""
    rejected(changed(TOSS, "claims", "period", period), "is first")
    without = changed(TOSS, "claims", "orbits", m, "0")
    rejected(without, "is first")


def test_fewer_orbits():
    """Less is claimed: no orbit of an odd period but 1, so the first period is 2 times 3."""
    given = changed(TOSS, "digits", "6")
    counts = given["claims"]["orbits"]
    given["claims"] |= {"orbits": [c if m % 2 else "0" for m, c in enumerate(counts)]}
    given["claims"]["period"] = "6"
    line = words(check(encode(given), lambda _: None))
    assert "of all least periods that come after it in the order 3, 5, 7, .., 2 x 3" in line
    rejected(changed(given, "claims", "orbits", ["0"] * 12), "is first")


def test_entropy_over_more_periods():
    """Where n is 1 the two entropies agree; half of it is another one."""
    low, high = (Fraction(q) for q in TOSS["claims"]["entropy"])
    half = [f"{float(low / 2):.9f}", f"{float(high / 2):.9f}"]
    rejected(changed(TOSS, "claims", "entropy_per_period", half), "another one")


@pytest.mark.parametrize("end", [0, 1])
def test_entropy_over_two_periods(monkeypatch, end):
    """It is half of that of G, on both sides; the bounds by coverings and laps are taken as known.

    The cells are those of one period.
    """
    counted = []
    monkeypatch.setattr(contact_attractor, "confirm_growth", lambda *_: None)
    monkeypatch.setattr(
        contact_attractor, "confirm_bound", lambda _, laps, *__: counted.append(laps)
    )
    given = changed(TOSS, "claims", "periods", "2")
    ends = [Fraction(q) / 2 for q in TOSS["claims"]["entropy"]]
    for step, right in ((0, True), ((1, -1)[end] * TINY, False)):
        ends[end] += step
        given["claims"]["entropy_per_period"] = [f"{float(q):.9f}" for q in ends]
        theorem = contact_attractor.THEOREM(read(encode(given)), lambda _: None)
        theorem.cells = [SimpleNamespace(laps=2), SimpleNamespace(laps=1)]
        theorem.met = theorem.covered_cells = []
        if right:
            theorem.entropy()
        else:
            with pytest.raises(Rejected, match="another one"):
                theorem.entropy()
    assert counted == [[2, 1]] * 2


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("claims", "entropy", 0), "0.89", "below its lower bound"),
        (("claims", "entropy", 1), "0.89", "above its upper bound"),
        (("claims", "entropy", 1), "64", "between 0 and 64"),
        (("claims", "entropy", 0), "0", "between 0 and 64"),
        (("claims", "growth"), "2.5", "may not grow"),
        (("claims", "laps"), "7/3", "15 places"),
        (("claims", "entropy_per_period", 0), "1/3", "15 places"),
        (("hints", "weights", 0), "0", "not positive"),
        (("claims", "growth"), "1", "not above 1"),
        (("hints", "vector", 0), "-1", "negative somewhere"),
        (("hints", "cells", 20, "to"), "7", "cells|zero|begins|fall|grow|turn"),
        (("hints", "vector"), ["1"], "not one entry"),
    ],
)
def test_lies_about_entropy(path, value, why):
    """Each is rejected for its reason."""
    rejected(changed(TOSS, *path, value), why)


def test_entropy_of_two_rounds():
    """States do not tell how many releases of a round have been: its entropy is not claimed."""
    rejected(changed(TOSS, "claims", "contacts", TOSS["claims"]["contacts"] * 2), "one round alone")


def test_a_vector_of_other_cells():
    """One that does not grow."""
    vector = TOSS["hints"]["vector"]
    rejected(changed(TOSS, "hints", "vector", [*vector[9:], *vector[:9]]), "may not grow")
    rejected(changed(TOSS, "hints", "vector", ["0"] * len(vector)), "or zero")


def test_parts_that_are_missing_or_too_many():
    """A fixed point without a rate, entropy with it, one of its claims alone, a vector."""
    rejected(changed(BELT, "claims", "growth", "2"), "alone")
    for given, names in ((BELT, ("rate", "fixed")), (TOSS, ("growth", "laps", "orbits", "period"))):
        for key in names:
            less = changed(given, "digits", "6")
            del less["claims"][key]
            rejected(less, "alone")
    rejected(
        changed(BELT, "hints", "vector", ["1"] * len(BELT["hints"]["cells"])), "if and only if"
    )


def test_a_rate_in_the_place_of_entropy():
    """The toss does not contract."""
    given = changed(TOSS, "digits", "6")
    for key in contact_attractor.CHAOTIC:
        del given["claims"][key]
    del given["hints"]["vector"]
    given["claims"] |= {"rate": "0.99", "fixed": ["7.8", "7.9"]}
    rejected(given, "lambda may be larger")


# other systems


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda m: m["stick"]["guards"]["back"]["value"][0].__setitem__(0, "1.4"), "no zero"),
        (lambda m: m["stick"]["guards"]["back"]["reset"].update(v=[["1", "v"]]), "not given by"),
        (lambda m: m["stick"]["guards"]["back"]["value"].append(["1", "v"]), "one variable"),
        (lambda m: m["stick"]["guards"]["back"]["value"].append(["1", "x", "cos"]), "degree 1"),
        (lambda m: m["slower"]["guards"]["catch"].update(to=["stick", "faster"]), "may be open"),
        (lambda m: m["slower"]["guards"].update(
            wall={"value": [["9/10"], ["1", "v"]], "reset": {"v": []}, "to": ["slower"]}), "guard"),
        (lambda m: m["slower"]["field"]["v"].append(["1", "sin"]), "may have no zero"),
    ],
)  # fmt: skip
def test_another_system(change, why):
    """A release of another place, resets that keep the state, another mode open, a wall."""
    given = changed(BELT, "digits", "6")
    change(given["parameters"]["modes"])
    rejected(given, why)


def test_a_wall_beyond_the_motions():
    """What is not reached makes another system, in the sentence, and no other proof."""
    given = changed(BELT, "digits", "6")
    wall = {"value": [["9"], ["1", "v"]], "reset": {"v": []}, "to": ["slower"]}
    given["parameters"]["modes"]["slower"]["guards"]["wall"] = wall
    assert "9 + v > 0 ('wall'" in words(check(encode(given), lambda _: None))


def test_a_system_without_a_clock():
    """It has no phases."""
    given = changed(TOSS, "parameters", "modes", "fly", "guards", "hand", "reset", "v", [["1"]])
    rejected(given, "clock occurs nowhere")


def test_pieces_of_flights_are_limited(monkeypatch):
    """A hostile certificate cannot ask for any number of them."""
    monkeypatch.setattr(contact_attractor, "WORK", 16)
    rejected(BELT, "pieces")


def test_the_rate_of_a_window_is_seen():
    """A window in which a guard may rise."""
    F, cell = releases(BELT), BELT["hints"]["cells"][9]
    wide = [Interval.enclosing(5, 9, BITS), windows(cell)[1]]
    with pytest.raises(Rejected, match=r"fall|too long"):
        F.at(exactly(cell["to"]), wide)


def test_the_window_is_one_of_all_releases():
    """That of the middle one alone is not enough."""
    F, t = releases(TOSS), Fraction(7)
    middle = F.at(exactly(t), [Interval.enclosing(15, 17, BITS)]).time
    narrow = [Interval.enclosing(middle.lower - TINY, middle.upper + TINY, BITS)]
    near = Interval.enclosing(t - TINY / 100, t + TINY / 100, BITS)
    assert F.over(near, narrow)[-1].time.lies_inside(narrow[0].lower, narrow[0].upper)
    wide = Interval.enclosing(t - TINY, t + TINY, BITS)
    with pytest.raises(Rejected, match="'hand' may have no zero in its window"):
        F.over(wide, narrow)


def test_a_guard_that_rises_is_no_contact():
    """Below a ceiling that is at 0 the ball would come back through it."""
    path = ("parameters", "modes", "fly", "guards", "hand", "value")
    F = releases(changed(TOSS, *path, [["-1", "y"]]))
    with pytest.raises(Rejected, match="may not fall"):
        F.at(exactly(7), [Interval.enclosing(15, 17, BITS)])
