"""The theorem ``branch``: pairs of (1,1) orbits for a range of f."""

from __future__ import annotations

import copy
from fractions import Fraction

import pytest
from mpmath import mp

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.theorems.branch import LOW_ORDER, RATIOS, united
from cap.checker.verdict import words
from checker.altered import changed, decimal, encode, fits_the_schema, rejected, verify
from checker.forge import Flow, _twists
from checker.forge_impact import WALLS, System, _mp, forge_branch
from checker.tampered import accepted, malformed, survivors

pytestmark = pytest.mark.usefixtures("pairs_computed_once")

F = Fraction
NARROW = {"F": "1", "omega": "1", "l": "-7/10", "r": "7/10"}
NARROW_ZERO = "0.240703080213486"


@pytest.fixture(scope="module")
def whole():
    """Return a valid certificate down to the end of the branch, in cells of a fiftieth."""
    return forge_branch(width="0.02")


@pytest.fixture(scope="module")
def short():
    """Return the same in few cells: unsigned, then the zero of the twist, then five signed."""
    return forge_branch(first="0.34", width="0.03")


@pytest.fixture(scope="module")
def flipping():
    """Return a valid certificate of pairs that become saddles on the way."""
    return forge_branch(NARROW, first="0.05", width="0.015", zero=NARROW_ZERO)


def test_accepts(whole, short, flipping):
    """Down to the end, with and without rotation number 1/2; both twists."""
    for certificate in (whole, short, flipping):
        assert len(verify(certificate)) == 9
        fits_the_schema(certificate)
    assert [q["ratio"] for q in whole["claims"]["resonances"]][-1] == "2/5"
    assert [q["ratio"] for q in flipping["claims"]["resonances"]] == [str(q) for q in RATIOS]
    assert {c["twist"] for c in flipping["claims"]["cells"]} == {"+", "-", "none"}


@pytest.mark.slow
def test_accepts_others():
    """Another range, fewer digits, other units."""
    verify(forge_branch(first="0.2", width="0.03", last="0.3"))
    verify(forge_branch(digits=25, first="0.34", width="0.03"))
    scaled = {"F": "3", "omega": "2", "l": "1/4", "r": "7/4"}  # the same rho
    verify(forge_branch(scaled, first="0.34", width="0.03"))


@pytest.mark.parametrize("walls", [(WALLS, "0.36226226705284"), (NARROW, NARROW_ZERO)])
def test_the_sign_of_the_twist_is_that_of_the_normal_form(walls):
    """The zeros used here are zeros of the general normal form of the map of (x, v)."""
    parameters, zero = walls
    with mp.workdps(30):
        signs = []
        for step in ("-1e-9", "1e-9"):
            orbit = System(parameters).pair(_mp(F(zero)) + mp.mpf(step))
            flow = Flow(parameters | {"f": "1"})
            flow.f = orbit.alpha
            tau = _twists(flow.period_map(*orbit.start, 3)[2], 3, 90)[0]
            signs.append(mp.sign((1 + orbit.trace) * tau))
        assert signs == [-1, 1]


def test_every_number(short):
    """No number claimed can be moved; f_range cannot be extended."""
    assert survivors(short, ("f_range",)) == []
    low, high = map(F, short["claims"]["f_range"])
    for ends, why in (
        ([low - F(1, 10**10), high], "may not be positive"),
        ([low, F(short["claims"]["f_start"][1])], "does not end below"),
        ([high, high], "is empty"),
    ):
        value = [decimal(end) for end in ends]
        rejected(changed(short, "claims", "f_range", value), why)


def test_a_smaller_range_with_its_exceptions(short):
    """A part of the range is as true; its exceptions are cut."""
    part = changed(short, "claims", "f_range", ["0.381", "0.39"])
    rejected(part, "there are")
    verify(changed(part, "claims", "exceptions", cut(short, "0.381", "0.39")))


def cut(certificate, low, high):
    """Return the exceptions within a smaller range."""
    pieces = [
        (max(F(a), F(low)), min(F(b), F(high))) for a, b in certificate["claims"]["exceptions"]
    ]
    return [[str(a), str(b)] for a, b in pieces if a <= b]


def test_what_is_malformed(short):
    """Fields missing, added, of another type are noticed when read, or later."""
    bad = [altered for _, altered in malformed(short)]
    assert len(bad) > 1000
    assert not any(accepted(altered) for altered in bad)


@pytest.mark.parametrize("name", ["F", "omega", "l", "r"])
def test_other_parameters(short, name):
    """The claims hold at no other parameters; there is no f."""
    value = F(short["parameters"][name]) + F(1, 10**9)
    assert not accepted(changed(short, "parameters", name, str(value)))
    rejected(changed(short, "parameters", "f", "2/5"), "missing or unknown")


def test_cells_that_do_not_cover(short):
    """A cell missing, twice, exchanged, empty, or beginning late; not from 0 on; beyond pi/2."""
    cells = short["claims"]["cells"]
    for wrong, why in (
        (cells[1:], "does not begin with 0"),
        (cells[:1] + cells[2:], "does not begin where"),
        (cells[:-1], "do not end with the bracket"),
        ([cells[0] | {"delta": ["0", "0"]}, *cells], "is empty"),
        ([*cells[:2], cells[1], *cells[2:]], "does not begin where"),
        ([cells[1], cells[0], *cells[2:]], "does not begin with 0"),
        ([], "list of 1 to"),
        (cells * 200, "list of 1 to"),
    ):
        rejected(changed(short, "claims", "cells", wrong), why)
    low, high = cells[1]["delta"]
    path = "claims", "cells", 1, "delta"
    rejected(changed(short, *path, [str(F(low) + F(1, 10**30)), high]), "does not begin where")
    rejected(changed(short, *path, [low, low]), "is empty")
    far = changed(short, "claims", "cells", [cells[0] | {"delta": ["0", "1.5708"]}])
    rejected(far, "not below pi/2")


def test_signs(short):
    """A sign is not the other one, nor claimed where there is none; it can be withheld."""
    cells = short["claims"]["cells"]
    for n, cell in enumerate(cells):
        for sign in {"+", "-"} - {cell["twist"]}:
            assert not accepted(signed(short, n, sign)), (n, sign)
            assert not accepted(signed(short, n, sign, ["1", "2"])), (n, sign)
    plus = next(n for n, cell in enumerate(cells) if cell["twist"] == "+")
    rejected(signed(short, plus, "none", "none"), "exceptions")
    rejected(signed(short, plus, "none"), "one is missing")
    rejected(signed(short, plus, "+", "none"), "one is missing")


def signed(certificate, n, sign, value=None):
    """Return a copy with another sign of a cell, and another value if one is given."""
    bad = changed(certificate, "claims", "cells", n, "twist", sign)
    return bad if value is None else changed(bad, "claims", "cells", n, "regular_twist", value)


def test_values_of_the_twist(short):
    """They contain what is taken, exclude 0, and are not much wider."""
    cells = short["claims"]["cells"]
    n = next(n for n, cell in enumerate(cells) if cell["twist"] == "+")
    low, high = map(F, cells[n]["regular_twist"])
    for ends, why in (
        ((low * F(11, 10), high), "does not contain"),
        ((low, high * F(9, 10)), "does not contain"),
        ((-low, high), "wider|contains 0"),
        ((low, high * 2), "wider"),
        ((F(0), high), "wider|contains 0"),
    ):
        rejected(signed(short, n, "+", [str(end) for end in ends]), why)


def test_saddles_have_no_sign(flipping):
    """Beyond the rotation number 1/2 no sign can be claimed."""
    last = len(flipping["claims"]["cells"]) - 1
    for sign in ("+", "-"):
        value = ["1", "2"] if sign == "+" else ["-2", "-1"]
        rejected(signed(flipping, last, sign, value), "may be negative")


def without(certificate, name, n):
    """Return a copy without the n-th claim and hint of a list."""
    bad = copy.deepcopy(certificate)
    for part in ("claims", "hints"):
        del bad[part][name][n]
    return bad


def test_resonances(short, flipping):
    """None can be left out, added, exchanged, or placed elsewhere."""
    for certificate in (short, flipping):
        for n in range(len(certificate["claims"]["resonances"])):
            rejected(without(certificate, "resonances", n), "the rotation numbers are")
    more = copy.deepcopy(short)
    for part in ("claims", "hints"):
        more[part]["resonances"].append(more[part]["resonances"][-1])
    rejected(more, "the rotation numbers are")
    rejected(changed(short, "claims", "resonances", 0, "ratio", "1/7"), "rotation numbers are")
    rejected(changed(short, "claims", "resonances", 4, "ratio", "2/8"), "ratio is none of")
    brackets = short["hints"]["resonances"]
    rejected(changed(short, "hints", "resonances", 0, brackets[1]), "does not cross")
    rejected(changed(short, "hints", "resonances", 0, ["0", "0.1"]), "where the orbits")
    rejected(changed(short, "hints", "resonances", 0, ["0.1", "0.1"]), "where the orbits")
    rejected(changed(short, "hints", "resonances", 0, ["0.1", "0.6"]), "where the orbits")
    wide = ["0.05", brackets[0][1]]
    rejected(changed(short, "hints", "resonances", 0, wide), "does not contain")


def test_a_wide_bracket_is_refused(short):
    """A claim that fits its wide bracket has too few digits."""
    bad = copy.deepcopy(short)
    low, high = short["hints"]["resonances"][0]
    bad["hints"]["resonances"][0] = [str(F(low) - F(1, 10**6)), high]
    orbit = System(WALLS).pair(_mp(F(low) - F(1, 10**6)))
    upper = F(int(mp.ceil(orbit.alpha * 10**14)), 10**14)
    bad["claims"]["resonances"][0]["f"][1] = decimal(upper + F(1, 10**13))
    rejected(bad, "wider than its digits")


def test_zeros_of_the_twist(short, whole):
    """A zero cannot be left out, nor be where there is none, nor be at trace -1."""
    rejected(without(whole, "twist_zeros", 0), "zero of the twist is missing")
    hint = "hints", "twist_zeros", 0
    rejected(changed(short, *hint, ["0.38", "0.39"]), "does not change its sign")
    rejected(changed(short, *hint, ["0.35", "0.44"]), "trace may be -1")
    rejected(changed(short, *hint, ["0.3", "0.9"]), "where the orbits")
    twice = copy.deepcopy(short)
    for part in ("claims", "hints"):
        twice[part]["twist_zeros"] *= 2
    rejected(twice, "not in order")


def test_the_end(short, whole):
    """The bracket has the zero of the least speed, and the cells end with it."""
    low, high = short["hints"]["end"]
    rejected(changed(short, "hints", "end", [str(F(low) - F(1, 10**9)), low]), "do not end")
    rejected(changed(short, "hints", "end", [high, high]), "do not end")
    rejected(changed(short, "hints", "end", ["-1", high]), "do not end")
    over = F(high) - F(1, 10**16)
    rejected(changed(short, "hints", "end", [str(over), high]), "vanishes before")
    rejected(changed(short, "hints", "end", "none"), "f_end")
    none = changed(short, "hints", "end", "none")
    for name in ("f_end", "trace_end"):
        none = changed(none, "claims", name, "none")
    rejected(none, "may vanish")
    early = forge_branch(first="0.2", width="0.03", last="0.3")
    early = changed(early, "hints", "end", ["0.29", "0.3"])
    for name in ("f_end", "trace_end"):
        early = changed(early, "claims", name, ["0.4", "0.5"])
    rejected(early, "does not vanish")


def test_exceptions(short, flipping):
    """None can be left out or made smaller; none added, joined, exchanged or made larger."""
    for certificate in (short, flipping):
        given = certificate["claims"]["exceptions"]
        for n, (low, high) in enumerate(given):
            rejected(
                changed(certificate, "claims", "exceptions", given[:n] + given[n + 1 :]), "there"
            )
            for ends, why in (
                ([F(low) + F(1, 10**16), F(high)], "too small"),
                ([F(low), F(high) - F(1, 10**16)], "too small"),
                ([F(low) - F(1, 10**5), F(high)], "larger|disjoint"),
                ([F(low), F(high) + F(1, 10**5)], "larger|disjoint"),
            ):
                value = [str(end) for end in ends]
                bad = changed(certificate, "claims", "exceptions", n, value)
                if why == "too small" or certificate is short or n > 0:
                    rejected(bad, why)
                else:  # below the rotation number 1/2 an exception says nothing
                    assert accepted(bad) == (ends[0] < F(low))
        joined = [[given[0][0], given[1][1]], *given[2:]]
        rejected(changed(certificate, "claims", "exceptions", joined), "there are")
        rejected(changed(certificate, "claims", "exceptions", given[::-1]), "disjoint")
        rejected(changed(certificate, "claims", "exceptions", [*given, ["2", "3"]]), "there are")
        rejected(changed(certificate, "claims", "exceptions", []), "there are")


def test_hints_far_off(short, whole):
    """Too few bits prove nothing; the work is bounded."""
    precise = forge_branch(digits=25, first="0.2", width="0.03", last="0.3")
    assert not accepted(changed(precise, "hints", "bits", "64"))
    rejected(changed(short, "hints", "bits", "63"), "bits")
    rejected(changed(whole, "hints", "bits", "4096"), "too much")


def test_wide_cells_prove_nothing():
    """One signed cell over most of the branch: nothing is certain."""
    wide = forge_branch(first="0.05", width="0.3")
    rejected(wide, "may")


def test_no_pair():
    """Walls too far apart."""
    certificate = forge_branch(first="0.2", width="0.03", last="0.3")
    rejected(changed(certificate, "parameters", "r", "2"), "no pair is born")


def test_the_rotation_numbers():
    """All fractions in (0, 1/2] with denominators 2 to 8; those of low order besides 1/2."""
    assert len(RATIOS) == 11
    assert RATIOS[0] == F(1, 8)
    assert RATIOS[-1] == F(1, 2)
    assert [F(1, 4), F(1, 3)] == LOW_ORDER


def test_components():
    """Overlapping and touching intervals are united; empty ones disappear."""
    pieces = [(5, 6), (1, 2), (2, 3), (9, 8), (F(5, 2), F(11, 4)), (6, 7)]
    assert united(pieces) == [(1, 3), (5, 7)]


def test_words_and_macros(whole, flipping):
    """The line states the range, the end, the exceptions; cells are printed as they are."""
    certificate = read(encode(whole))
    line = words(certificate)
    for part in ("for every f in [0.3478", "1/4 at f in", "the least speed vanishes", "Moser"):
        assert part in line
    assert "saddles" not in line
    shown = list(macros(certificate, "a", 5))
    assert "\\newcommand{\\capACellsOneDelta}{[0, 1/20]}" in shown
    line = words(read(encode(flipping)))
    assert "below that of 1/2 both are saddles" in line
    none = read(encode(forge_branch(first="0.2", width="0.03", last="0.3")))
    assert "vanishes at f" not in words(none)
    assert not [m for m in macros(none, "a", 5) if "FEnd" in m]
