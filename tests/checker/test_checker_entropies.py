"""The theorem ``entropies``: its strips and pieces, halts, and certificates that lie."""

from __future__ import annotations

import copy
import json
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest

from cap.checker.flow.driven import DrivenMap, phases
from cap.checker.flow.kneading import extreme, order
from cap.checker.flow.sheared import Line, Near, Passage, Sheared
from cap.checker.flow.strip import Strip, fitted
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.entropies import Entropies
from cap.checker.verdict import words
from cap.floats.releases import images
from cap.parameters import PAPER
from checker.altered import changed, encode, fits_the_schema, rejected

STORED = json.loads((Path(__file__).parents[2] / "certificates/entropies-1.json").read_text())


@pytest.fixture(scope="module")
def cells():
    """Return the cells of the first strip of the stored certificate, proved."""
    proof = Entropies(read(encode(STORED)), lambda _: None)
    return list(strip_of(proof).covered())


def strip_of(proof):
    """Return the first strip of a certificate."""
    return proof.strip(proof.claims["strips"][0], proof.hints["strips"][0])


@pytest.fixture
def at(cells):
    """Return the first strip of a certificate, with its cells, which did not change."""

    def prepared(certificate=STORED):
        strip = strip_of(Entropies(read(encode(certificate)), lambda _: None))
        strip.cells = cells
        return strip

    return prepared


def number_of(kind):
    """Return the number of a piece of the first strip with a cycle, or without."""
    pieces = STORED["claims"]["strips"][0]["pieces"]
    return next(n for n, q in enumerate(pieces) if (q["cycle"] == "none") == (kind == "none"))


def lie(n, *path_and_value):
    """Return the stored certificate with another claim on a piece of the first strip."""
    return changed(STORED, "claims", "strips", 0, "pieces", n, *path_and_value)


def examined(at, n, certificate=STORED):
    """Examine one piece."""
    strip = at(certificate)
    strip.piece(strip.claim["pieces"][n], strip.hint["pieces"][n])


def refused(at, why, n, certificate):
    """Check that the lie is noticed, for this reason, in the piece."""
    with pytest.raises(Rejected, match=why):
        examined(at, n, certificate)


@pytest.mark.slow
def test_it_is_verified():
    """The schema describes it; the line says what was proved and what was not."""
    steps = []
    certificate = read(encode(STORED))
    Entropies(certificate, steps.append).prove()
    assert len(steps) == 2 + len(STORED["claims"]["strips"])
    fits_the_schema(STORED)
    line = words(certificate)
    for part in ("not claimed that it is monotone", "a cycle of period 3", "kneading RLL"):
        assert part in line


def test_the_extreme_sequences():
    """Of all sequences with R or L in the places of ?, in the twisted order."""
    for symbols in ("R?L?R", "?RR??L", "RL?RL?"):
        places = [n for n, symbol in enumerate(symbols) if symbol == "?"]
        found = set()
        for chosen in product("RL", repeat=len(places)):
            letters = list(symbols)
            for n, letter in zip(places, chosen, strict=True):
                letters[n] = letter
            found.add("".join(letters))
        least, most = ("".join(extreme(symbols, least=which)) for which in (True, False))
        assert {least, most} <= found
        assert all(order(each, iter(most)) < 0 for each in found - {most})
        assert all(order(each, iter(least)) > 0 for each in found - {least})


def test_the_symbols(at):
    """None can be another one, where it is certain."""
    n = number_of("cycle")
    symbols = STORED["claims"]["strips"][0]["pieces"][n]["kneading"]
    examined(at, n)
    for k in (0, 1, 4):
        other = symbols[:k] + ("L" if symbols[k] == "R" else "R") + symbols[k + 1 :]
        refused(at, f"symbol {k + 1} of a kneading", n, lie(n, "kneading", other))
    refused(at, "too short to be compared", n, lie(n, "kneading", symbols[:1]))


def test_the_entropies(at):
    """No bound can be moved inwards, nor be negative; without symbols nothing is decided."""
    n = number_of("cycle")
    strip = at()
    piece = STORED["claims"]["strips"][0]["pieces"][n]
    low, high = map(Fraction, piece["entropy"])
    little, symbols = Fraction(1, 10**4), piece["kneading"]
    strip.entropy(symbols, low, high)
    for bounds, why in (
        ((low + little, high), "below its lower|too short"),
        ((low, high - little), "above its upper|too short"),
        ((low, Fraction(0)), "may be positive"),
        ((-little, high), "negative"),
    ):
        with pytest.raises(Rejected, match=why):
            strip.entropy(symbols, *bounds)
    with pytest.raises(Rejected, match=r"too short|below"):
        strip.entropy("?" * len(symbols), low, high)
    strip.entropy("?", Fraction(0), Fraction(7, 10))


def test_the_cycle(at):
    """J too large, too small, elsewhere; another period."""
    n = number_of("cycle")
    path = n, "cycle"
    cycle = STORED["claims"]["strips"][0]["pieces"][n]["cycle"]
    refused(at, "no interior", n, lie(*path, "reach", "0"))
    refused(at, ".", n, lie(*path, "reach", "1/10"))
    refused(at, "may not", n, lie(*path, "reach", "1/100000"))
    elsewhere = str(Fraction(cycle["at"]) + Fraction(1, 9))
    refused(at, "may not lie in J", n, lie(*path, "at", elsewhere))
    refused(at, "may not take J", n, lie(*path, "period", "1"))
    refused(at, "period of a cycle may be smaller", n, lie(*path, "period", "6"))
    refused(at, "may not lie in J", n, lie(*path, "image", "1"))


def test_the_hints(at):
    """A line that is not near c, or too short a reach."""
    path = "hints", "strips", 0, "pieces", 0
    at_c = Fraction(STORED["hints"]["strips"][0]["pieces"][0]["at"])
    refused(at, "may not be near", 0, changed(STORED, *path, "at", str(at_c + Fraction(1, 100))))
    refused(at, "may not be near", 0, changed(STORED, *path, "reach", "1/1000000000"))
    refused(at, "not positive", 0, changed(STORED, *path, "reach", "-1"))


def test_the_strip(at, cells):
    """The interval, the cells in order, and the signs of a unimodal map."""
    at().unimodal()
    at().boundary()
    interval = STORED["claims"]["strips"][0]["interval"]
    narrow = changed(STORED, "claims", "strips", 0, "interval", [interval[0], "-0.6"])
    with pytest.raises(Rejected, match="into its interior"):
        at(narrow).boundary()
    for n, cell in enumerate(cells):
        strip = at()
        strip.cells = [*cells]
        strip.cells[n] = cell._replace(slope=-cell.slope, curve=-cell.curve)
        with pytest.raises(Rejected, match=r"may turn|may not be monotone|may be monotone"):
            strip.unimodal()
    strip = at()
    strip.cells = [cell for cell in cells if cell.slope]
    with pytest.raises(Rejected, match=r"no critical point|no cell"):
        strip.unimodal()
    backwards = copy.deepcopy(STORED)
    hints = backwards["hints"]["strips"][0]["cells"]
    hints[1]["to"] = hints[0]["to"]
    with pytest.raises(Rejected, match="not in order"):
        list(at(backwards).covered())


def test_the_order():
    """Strips and pieces in order; shares exact; as many hints as claims."""
    path = "claims", "strips"
    pieces = STORED["claims"]["strips"][0]["pieces"]
    rejected(changed(STORED, *path, 0, "pieces", pieces[::-1]), "do not follow each other")
    rejected(changed(STORED, *path, 0, "pieces", pieces[1:]), "pieces are not as many")
    rejected(changed(STORED, *path, 0, "pieces", 0, "f", ["0.3891", "0.3895"]), ".")
    rejected(changed(STORED, "claims", "range", ["0.3", "0.31"]), "leaves the range")
    rejected(changed(STORED, "claims", "range", ["0.3891", "0.4"]), "not in order")
    rejected(changed(STORED, *path, STORED["claims"]["strips"] * 2), "not as many")
    proof = Entropies(read(encode(STORED)), lambda _: None)
    proof.shares()
    for name in ("positive", "periodic", "undecided"):
        other = Entropies(read(encode(changed(STORED, "claims", name, "1/7"))), lambda _: None)
        with pytest.raises(Rejected, match="the share"):
            other.shares()


def test_one_release_only(at):
    """What follows a release on the way is not said of the release map, but of an iterate."""
    twice = copy.deepcopy(STORED)
    cell = twice["hints"]["strips"][0]["cells"][0]
    for name in ("words", "events"):
        cell[name] *= 2
    with pytest.raises(Rejected, match="only release"):
        list(at(twice).covered())


def test_words_of_cells():
    """A halt stands for a turn and a stick, or a stick; nothing else does."""
    plain = ["hit r", "turn right", "stick", "release left"]
    windows = [(Fraction(n), Fraction(n + 1)) for n in range(4)]
    halt = ["hit r", "halt right", "release left"]
    assert fitted(Passage(plain, windows), halt) == [windows[0], windows[1], windows[3]]
    assert fitted(Passage(plain, windows), plain) == windows
    short = Passage(["hit r", "stick", "release left"], windows[:3])
    assert fitted(short, halt) == windows[:3]
    for other in (["hit l", "halt right", "release left"], ["hit r", "halt left", "release left"]):
        with pytest.raises(Rejected, match="several itineraries"):
            fitted(Passage(plain, windows), other)
    with pytest.raises(Rejected, match="several itineraries"):
        fitted(Passage(plain, windows), ["hit r", "stick", "release left"])


def test_a_halt_encloses_both_itineraries():
    """At f = 0.42 the place after it, over a set in which some turn, against floats."""
    f, ends = Fraction(42, 100), (Fraction(-306, 1000), Fraction(-300, 1000))
    p = read(encode(STORED)).parameters
    theta = phases(p, (f, f), 96)
    H = Sheared(p, theta, Fraction(0), theta.midpoint(), 3)
    halting = ["hit r", "hit l", "hit r", "halt right", "release left"]
    ranges = ("7.7", "7.9"), ("9.9", "10.1"), ("12.75", "12.95"), ("13.6", "13.8"), ("14.5", "14.6")
    windows = [(Fraction(a), Fraction(b)) for a, b in ranges]
    x = [float(ends[0]) + 0.006 * k / 40 for k in range(41)]
    found = images(replace(PAPER, f=f), x)
    times = Passage(halting, windows)
    image = H.over(Interval.enclosing(*ends, 96), times)
    low, high = float(image.value.lower), float(image.value.upper)
    assert all(low <= y <= high for y in found.value)
    slope = image[(1, 0)]
    assert all(float(slope.lower) <= s <= float(slope.upper) for s in found.slope)
    assert high - low < 0.01
    with pytest.raises(Rejected):
        H.over(Interval.enclosing(*ends, 96), Passage([*halting[:3], "stick", halting[4]], windows))


def test_lines():
    """A function is its line and its rest."""
    p = read(encode(STORED)).parameters
    theta = phases(p, (Fraction(39, 100), Fraction(391, 1000)), 96)
    H = Sheared(p, theta, Fraction(0), theta.midpoint(), 3)
    line = Line(Fraction(1, 2), Fraction(3))
    near = Near(line, theta.integer(0))
    assert H.distance(near, line).magnitude().hi <= 1
    half = H.distance(near, Line(Fraction(0), Fraction(3)))
    assert half.lies_in(Fraction(49, 100), Fraction(51, 100))
    assert isinstance(DrivenMap(p, [], []).mechanics([theta], [theta], 1).f, Interval)
    assert isinstance(strip_of(Entropies(read(encode(STORED)), lambda _: None)), Strip)
