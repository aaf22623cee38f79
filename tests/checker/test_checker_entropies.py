"""The theorem ``entropies``: its strips and pieces, halts, and certificates that lie."""

from __future__ import annotations

import copy
import json
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.release.driven import DrivenMap, phases
from cap.checker.release.kneading import extreme, order
from cap.checker.release.sheared import Line, Near, Passage, Sheared
from cap.checker.release.strip import Strip, fitted
from cap.checker.theorems.entropies import Entropies
from cap.checker.verdict import words
from cap.floats.engine.releases import images
from cap.parameters import PAPER
from checker.altered import changed, encode, fits_the_schema, rejected

pytestmark = pytest.mark.usefixtures("releases_computed_once")

STORED = json.loads(
    (Path(__file__).parents[2] / "certificates/entropies-1.json").read_text("utf-8")
)
WITH_CYCLE = 1  # a piece


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
    n = WITH_CYCLE
    symbols = STORED["claims"]["strips"][0]["pieces"][n]["kneading"]
    examined(at, n)
    for k in (0, 1, 4):
        other = symbols[:k] + ("L" if symbols[k] == "R" else "R") + symbols[k + 1 :]
        refused(at, f"symbol {k + 1} of a kneading", n, lie(n, "kneading", other))
    refused(at, "too short to be compared", n, lie(n, "kneading", symbols[:1]))


def test_the_entropies(at):
    """No bound can be moved inwards, nor be negative; without symbols nothing is decided."""
    n = WITH_CYCLE
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
    n = WITH_CYCLE
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


@pytest.mark.slow
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


def test_the_shares_count_what_they_name():
    """A piece that may have no entropy, a piece without a cycle, a range that goes on."""
    pieces = STORED["claims"]["strips"][0]["pieces"]
    zero = lie(0, "entropy", ["0", pieces[0]["entropy"][1]])
    without = lie(0, "cycle", "none")
    wider = changed(STORED, "claims", "range", [STORED["claims"]["range"][0], "0.392"])
    for certificate, why in (
        (zero, "entropy is 3/4"),
        (without, "with cycles"),
        (wider, "positiv"),
    ):
        with pytest.raises(Rejected, match=f"the share .*{why}"):
            Entropies(read(encode(certificate)), lambda _: None).shares()


@pytest.mark.parametrize("range_", [["0", "0.391"], ["-1", "0.391"], ["0.389", "1"]])
def test_the_range(range_):
    """It lies between 0 and F, without its ends."""
    rejected(changed(STORED, "claims", "range", range_), r"the range is not in \(0, F\)")


@pytest.mark.parametrize("n", ["0", "-1", "33"])
def test_half_periods(n):
    """One at least, and not too many."""
    rejected(changed(STORED, "claims", "half_periods", n), "half_periods")


@pytest.mark.parametrize("name", ["words", "events"])
def test_a_cell_of_one_word(name):
    """It has two at least, and as many windows."""
    path = "hints", "strips", 0, "cells", 0, name
    one = STORED["hints"]["strips"][0]["cells"][0][name][:1]
    rejected(changed(STORED, *path, one), f"{name} is not a list of 2")


def told(*bounds):
    """Return the sentence with these bounds of entropies, on all the pieces in turn."""
    certificate = copy.deepcopy(STORED)
    for n, piece in enumerate(certificate["claims"]["strips"][0]["pieces"]):
        piece["entropy"] = list(bounds[n % len(bounds)])
    return words(read(encode(certificate)))


def test_the_sentence_says_how_large_entropies_are():
    """Positive on some pieces, on none, zero on all."""
    some = told(("0", "0.1"), ("0.3", "0.4"), ("0.2", "0.5"))
    assert "it is positive, at least 0.2, on the share" in some
    assert "nowhere in these pieces above 0.5;" in some
    none = told(("0", "0.1"), ("0", "0"))
    assert "it is shown to be positive in none of them, and nowhere there above 0.1;" in none
    assert "it is zero in all of them;" in told(("0", "0"))
    assert "it is positive" not in none + told(("0", "0"))


def test_the_interval_moves_with_f(at):
    """I is [a, b] in the middle of the strip, and moves with the shear that is claimed."""
    assert "for the middle of each strip of values of f and moving with f" in words(
        read(encode(STORED))
    )
    strip = at()
    f = (strip.claim["pieces"][0]["f"].lower + strip.claim["pieces"][-1]["f"].upper) / 2
    middle = strip.on((f, f))
    assert middle.theta.lo == middle.origin.lo
    assert middle.theta.hi == middle.origin.hi
    for shear in ("0", "28/5"):
        other = changed(STORED, "claims", "strips", 0, "shear", shear)
        with pytest.raises(Rejected, match=r"interior|when a window ends"):
            at(other).boundary()
    hint = copy.deepcopy(STORED)
    hint["hints"]["strips"][0]["shear"] = hint["claims"]["strips"][0].pop("shear")
    rejected(hint, "missing or unknown fields")


def test_one_release_only(at):
    """What follows a release on the way is not said of the release map, but of an iterate."""
    twice = copy.deepcopy(STORED)
    cell = twice["hints"]["strips"][0]["cells"][0]
    for name in ("words", "events"):
        cell[name] *= 2
    with pytest.raises(Rejected, match="only release"):
        list(at(twice).covered())


def test_cells_that_end_early(at):
    """The last one ends at b."""
    path = "hints", "strips", 0, "cells"
    short = changed(STORED, *path, STORED["hints"]["strips"][0]["cells"][:1])
    with pytest.raises(Rejected, match="do not cover"):
        list(at(short).covered())
    events = STORED["hints"]["strips"][0]["cells"][3]["events"]
    rejected(changed(STORED, *path, 3, "events", events[1:]), "not as many as its words")


def test_work():
    """What would take hours is not begun."""
    certificate = read(encode(STORED))
    hints, claims = (
        part | {"strips": part["strips"] * 200} for part in (certificate.hints, certificate.claims)
    )
    with pytest.raises(Rejected, match="are too much"):
        Entropies.limit(hints, claims)


def test_a_map_that_may_be_monotone(at, cells):
    """Without cells on one side of those where H' may vanish."""
    flat = [n for n, cell in enumerate(cells) if not cell.slope]
    for part in (cells[flat[0] :], cells[: flat[-1] + 1]):
        strip = at()
        strip.cells = part
        with pytest.raises(Rejected, match="may be monotone"):
            strip.unimodal()


def test_a_second_derivative_of_both_signs():
    """It is positive at the middle of what is known of it."""
    known = {(2, 0): Interval.enclosing(Fraction(-1, 10), Fraction(3, 10), 64)}
    H = SimpleNamespace(places=lambda _: known[2, 0].integer(0), near=lambda *_: known)
    strip = SimpleNamespace(bits=64, turn=1, passage=lambda _: None)
    with pytest.raises(Rejected, match="second derivative may vanish"):
        Strip.critical(strip, H, None, Fraction(1, 100))


def test_the_critical_point(at):
    """It lies in I, where H'' has the sign of the turn claimed."""
    other = changed(STORED, "claims", "turn", "maximum")
    refused(at, "second derivative may vanish", 0, other)
    strip = at()
    with pytest.raises(Rejected, match="an image of the critical point is not in I"):
        strip.passage(Interval.enclosing(0, 0, 96))
    strip.a, claim, hint = strip.b - Fraction(1, 1000), *piece_of(strip)
    with pytest.raises(Rejected, match="the critical point is not in I"):
        strip.piece(claim, hint)


def piece_of(strip):
    """Return what is claimed of a piece, and the hint."""
    return strip.claim["pieces"][0], strip.hint["pieces"][0]


def test_the_image_that_is_named(at):
    """It is among those that are followed."""
    many = len(STORED["claims"]["strips"][0]["pieces"][WITH_CYCLE]["kneading"])
    beyond = lie(WITH_CYCLE, "cycle", "image", str(many + 1))
    refused(at, "beyond the kneading sequence", WITH_CYCLE, beyond)


def test_an_iterate_that_does_not_contract(at, monkeypatch):
    """It takes J into its interior, but the derivative may be 1: then it may have more cycles."""
    strip = at()
    claim = strip.claim["pieces"][WITH_CYCLE]["cycle"]
    H = strip.on((Fraction("0.39"), Fraction("0.39")))
    line = Line(claim["at"], claim["rate"])
    inside = Near(line, H.theta.integer(0))
    images = [inside] * claim["image"]
    away = Near(line._replace(at=line.at + 1), H.theta.integer(0))

    def steps(slope):
        results = iter([away, away, inside])
        monkeypatch.setattr(Sheared, "straightened", lambda *_: next(results))
        monkeypatch.setattr(strip, "image", lambda *_: {(1, 0): slope})
        strip.cycle(H, claim, images)

    steps(Interval.enclosing(Fraction(-99, 100), Fraction(99, 100), 96))
    for slope in (1, -1):
        with pytest.raises(Rejected, match="may not contract J"):
            steps(Interval.enclosing(slope, slope, 96))


def test_a_release_at_a_wall(at):
    """Nothing is said of it."""
    strip = at()
    near = Interval.enclosing(Fraction(99, 100), Fraction(101, 100), 96)
    with pytest.raises(Rejected, match="a release is not between the walls"):
        strip.H.over(near, strip.cells[0].passage)


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
