"""The theorem ``attractor``: its steps, and certificates that lie.

The whole check takes seconds: most lies are told to the one step that must notice them.
"""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import islice, pairwise
from pathlib import Path

import pytest
from mpmath import mp, mpf

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.release.kneading import doubling, order
from cap.checker.theorems import attractor
from cap.checker.theorems.attractor import Attractor
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected
from checker.tampered import accepted

pytestmark = pytest.mark.usefixtures("releases_computed_once")

STORED = json.loads((Path(__file__).parents[2] / "certificates/attractor.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def cells():
    """Return the cells of the stored certificate, proved."""
    return list(Attractor(read(encode(STORED)), lambda _: None).covered())


@pytest.fixture
def at(cells):
    """Return the checker of a certificate, with its cells, which did not change."""

    def prepared(certificate=STORED):
        proof = Attractor(read(encode(certificate)), lambda _: None)
        proof.cells = cells
        return proof

    return prepared


def lie(*path_and_value):
    """Return the stored certificate with another claim."""
    return changed(STORED, "claims", *path_and_value)


def shifted(pair, by):
    """Return an enclosure moved by a multiple of its width."""
    low, high = map(Fraction, pair)
    return [str(low + by * (high - low)), str(high + by * (high - low))]


def refuses(step, why, *arguments):
    """Check that a step rejects for this reason."""
    with pytest.raises(Rejected, match=why):
        step(*arguments)


def test_it_is_verified():
    """In six steps; the schema describes it; the line says what was proved and what was not."""
    steps = []
    certificate = read(encode(STORED))
    Attractor(certificate, steps.append).prove()
    assert len(steps) == 6
    fits_the_schema(STORED)
    line = words(certificate)
    for part in ("takes I = [", "topological entropy of G on I", "it is not claimed that no"):
        assert part in line
    assert "a box of the area 0.000046717225, comes to be released in I, or to the left" in line
    shown = "\n".join(macros(certificate, "a", 6))
    assert "capAEntropy}{[0.44252, 0.44253]}" in shown
    assert "capAInterval}{" + str(certificate.claims["interval"]) in shown


def test_orbits_at_a_wall_when_masses_are_released(cells):
    """Some are: so the entropy per period is said of states of which those at a hit are one."""
    half, bits = math.pi, int(STORED["hints"]["cell_bits"])
    proof = Attractor(read(encode(STORED)), lambda _: None)
    release = 2 * math.pi - math.acos(0.4)

    def delay(x, windows):
        M = proof.phi(windows).mechanics([x], [x], 2)
        first, *later = M.minima[1]
        start = M.flight(1, first, M.variables[0], M.constant(x.integer(0)))
        start = start._replace(minima=later, at_rest=True)
        return float(proof.phi(windows).follow(M, start)[0][0].moment.t.value.lower) - release

    delays = [
        delay(Interval.enclosing(x, x, bits), cell.windows)
        for cell in cells
        for x in [(cell.lower + cell.upper) / 2]
    ]
    assert STORED["claims"]["itinerary"][0] == "hit r"
    assert min(delays) < half - 0.005 < half + 0.005 < max(delays)
    line = words(read(encode(STORED)))
    assert "(wall, v) before a hit and (wall, -e v) after it count as one state" in line


def test_the_order_of_sequences():
    """R turns the order round; and a sequence that does not differ decides nothing."""
    for smaller, larger in (("L", "R"), ("RR", "RL"), ("RLR", "RLL"), ("RLRL", "RLRR")):
        assert order(smaller, iter(larger)) == -1
        assert order(larger, iter(smaller)) == 1
    refuses(order, "too short", "RL", iter("RLR"))


def test_the_limit_of_period_doubling():
    """Its first 31 symbols, as in the literature; all tent maps have larger sequences."""
    limit = "".join(islice(doubling(), 31))
    assert limit == "RLRRRLRLRLRRRLRRRLRRRLRLRLRRRLR"
    proof = Attractor(read(encode(STORED)), lambda _: None)
    for entropy in ("0.05", "0.1", "0.3", "0.5", "0.69"):
        tent = "".join(islice(proof.tent(Fraction(entropy)), 150))
        assert order(tent, doubling()) == 1


def test_kneading_grows_with_the_slope():
    """Of tent maps, each against the next."""
    proof = Attractor(read(encode(STORED)), lambda _: None)
    entropies = [Fraction(n, 100) for n in range(12, 69, 3)]
    sequences = ["".join(islice(proof.tent(h), 80)) for h in entropies]
    for small, large in pairwise(sequences):
        assert order(small, iter(large)) == -1


def test_tents_against_exact_orbits():
    """The sequence of slope exp(h), enclosed, is that of mpmath's orbit."""
    proof = Attractor(read(encode(STORED)), lambda _: None)
    with mp.workdps(120):
        s = mp.exp(mpf(3) / 10)
        y, exact = s / 2, ""
        for _ in range(100):
            exact += "L" if y < mpf(1) / 2 else "R"
            y = s * min(y, 1 - y)
    assert "".join(islice(proof.tent(Fraction(3, 10)), 100)) == exact
    refuses(lambda: list(islice(proof.tent(Fraction(7, 10)), 3)), "no tent map")
    refuses(lambda: list(islice(proof.tent(Fraction(3, 10)), 3000)), "not decided")


def test_the_entropy(at):
    """Neither bound can be moved inwards, nor widened; nor can what is per period."""
    at().entropy()
    claim, each = STORED["claims"]["entropy"], STORED["claims"]["entropy_per_period"]
    for by in (2, 10, 10**6):
        refuses(at(lie("entropy", shifted(claim, by))).entropy, "below its lower bound")
        refuses(at(lie("entropy", shifted(claim, -by))).entropy, "above its upper bound")
        for sign in (1, -1):
            moved = lie("entropy_per_period", shifted(each, sign * by))
            refuses(at(moved).entropy, "per period")
    low, high = map(Fraction, claim)
    wide = [str(low - Fraction(1, 10**9)), str(high)]
    refuses(at(lie("entropy", wide)).entropy, "wider")
    refuses(at(lie("entropy", ["0", "0"])).entropy, "may be positive")
    refuses(at(lie("entropy", ["-1", claim[1]])).entropy, "negative")
    refuses(at(lie("entropy", ["0", claim[1]])).entropy, "wider")
    refuses(at(lie("entropy_per_period", ["0", "1"])).entropy, "wider")
    refuses(at(lie("half_periods", "5")).entropy, "per period")


def test_the_symbols(at):
    """No symbol can be another one, early or late; without the last ones nothing is decided."""
    symbols = STORED["claims"]["kneading"]
    c = Interval.enclosing(
        *map(Fraction, STORED["hints"]["critical"]), int(STORED["hints"]["bits"])
    )
    x = at().into_itself(c)
    for n in (0, 1, 7, 12):
        flipped = symbols[:n] + ("L" if symbols[n] == "R" else "R") + symbols[n + 1 : n + 3]
        refuses(at(lie("kneading", flipped)).kneading, f"symbol {n + 1} of", c, x)
    at(lie("kneading", symbols[:15])).kneading(c, x)
    refuses(at(lie("kneading", symbols[:60])).entropy, "too short")
    late = symbols[:-40] + ("L" if symbols[-40] == "R" else "R") + symbols[-39:]
    refuses(at(lie("kneading", late)).entropy, "entropy may be")
    refuses(at(lie("turn", "maximum")).kneading, "symbol 1 of", c, x)


def test_the_last_symbol_is_decided_by_the_map(at):
    """A sequence that only its last symbol makes false is followed to the end."""
    symbols = STORED["claims"]["kneading"][:20]
    c = Interval.enclosing(
        *map(Fraction, STORED["hints"]["critical"]), int(STORED["hints"]["bits"])
    )
    x = at().into_itself(c)
    false = symbols[:-1] + ("L" if symbols[-1] == "R" else "R")
    refuses(at(lie("kneading", false)).kneading, "symbol 20 of", c, x)


def test_the_critical_point(at):
    """It lies where it is claimed, and G' changes its sign at the hint."""
    at().critical_point()
    claim = STORED["claims"]["critical_point"]
    for by in (3, -3):
        moved = lie("critical_point", shifted(claim, by))
        refuses(at(moved).critical_point, "does not contain")
    refuses(at(lie("critical_point", ["-0.7", "-0.5"])).critical_point, "wider")
    low, high = map(Fraction, STORED["hints"]["critical"])
    for wrong in ([low - 1, low], [low, Fraction(-2, 5) + 1]):
        hint = changed(STORED, "hints", "critical", [str(q) for q in wrong])
        refuses(at(hint).critical_point, "not in I")
    for wrong in ([low - (high - low), low], [high, high + (high - low)]):
        hint = changed(STORED, "hints", "critical", [str(q) for q in wrong])
        refuses(at(hint).critical_point, "may not change its sign")
    refuses(at(lie("turn", "maximum")).critical_point, "may not change its sign")


def test_the_interval(at):
    """An interval whose end is mapped beyond the other end, or that excludes the critical value."""
    bits = int(STORED["hints"]["bits"])
    c = Interval.enclosing(*map(Fraction, STORED["hints"]["critical"]), bits)
    low, high = STORED["claims"]["interval"]
    refuses(at(lie("interval", [low, "-0.42"])).into_itself, "into its interior", c)
    refuses(at(lie("interval", ["-0.763", high])).into_itself, "into its interior", c)
    value = STORED["claims"]["critical_value"]
    refuses(at(lie("critical_value", shifted(value, 3))).into_itself, "does not contain", c)
    rejected(lie("interval", ["-1", high]), "not between the walls")
    rejected(lie("interval", [high, high]), "not between the walls")
    rejected(lie("interval", [low, "-0.4"]), "leave the interval|do not cover")


def test_the_cells(at, cells):
    """In order, up to both ends; all with the itinerary; and the signs of a unimodal map."""
    path = "hints", "cells"
    hints = STORED["hints"]["cells"]
    rejected(changed(STORED, *path, hints[1:]), ".")
    refuses(list, "do not cover", at(changed(STORED, *path, hints[:1])).covered())
    backwards = changed(STORED, *path, 1, "to", hints[0]["to"])
    refuses(list, "not in order", at(backwards).covered())
    for n, cell in enumerate(cells):
        other = list(cells)
        other[n] = cell._replace(slope=-cell.slope, curve=-cell.curve)
        proof = at()
        proof.cells = other
        refuses(proof.unimodal, "may turn elsewhere|may not be monotone")
        if not cell.slope:
            other[n] = cell._replace(curve=-cell.curve)
            refuses(proof.unimodal, "may not be monotone")
    proof = at()
    proof.cells = [cell for cell in cells if cell.slope]
    refuses(proof.unimodal, "no cell has a critical point")
    at().unimodal()
    refuses(at(lie("turn", "maximum")).unimodal, "may turn elsewhere")


def test_the_itinerary():
    """No other word in any place, no other duration; the last must be a release."""
    itinerary = STORED["claims"]["itinerary"]
    for n, word in enumerate(itinerary):
        for other in ("hit r", "hit l", "turn left", "turn right", "stick", "release right"):
            if other != word:
                assert not accepted(lie("itinerary", n, other)), (n, other)
    for n in ("1", "2", "4"):
        rejected(lie("half_periods", n), "takes another time")
    windows = STORED["hints"]["cells"][0]["events"]
    rejected(changed(STORED, "hints", "cells", 0, "events", windows[::-1]), ".")


def test_windows_and_images(at):
    """As many windows as events; and no events for a place that is not in I."""
    short = STORED["hints"]["basin_events"][:-1]
    rejected(changed(STORED, "hints", "basin_events", short), "windows are not lists of 6")
    refuses(at().windows, "is not in I", Interval.enclosing(0, 0, 64))


def test_one_release_only():
    """What follows a release on the way is not said of the release map, but of an iterate."""
    twice = lie("itinerary", STORED["claims"]["itinerary"] * 2)
    for cell in (*twice["hints"]["cells"], twice["hints"]):
        cell["events" if "events" in cell else "basin_events"] *= 2
    rejected(twice, "only release")


def test_without_the_release(at):
    """Events that end with the stick are no passage."""
    short = changed(lie("itinerary", STORED["claims"]["itinerary"][:-1]),
                    "hints", "basin_events", STORED["hints"]["basin_events"][:-1])  # fmt: skip
    for cell in short["hints"]["cells"]:
        del cell["events"][-1]
    refuses(at(short).basin, "does not end with a release")


def test_the_basin(at):
    """The box has an interior, and what it holds is released in I."""
    at().basin()
    box = STORED["claims"]["basin"]
    (a, b), (c, d) = (map(Fraction, box[z]) for z in "xv")
    flat = {"x": [str(a), str(a)], "v": box["v"]}
    refuses(at(lie("basin", flat)).basin, "no interior")
    refuses(at(lie("basin", {"x": box["x"], "v": [str(c), str(c)]})).basin, "no interior")
    for shift in (Fraction(1, 10), Fraction(-1, 10)):
        other = {"x": [str(a + shift), str(b + shift)], "v": box["v"]}
        refuses(at(lie("basin", other)).basin, ".")
        other = {"x": box["x"], "v": [str(c + shift), str(d + shift)]}
        refuses(at(lie("basin", other)).basin, ".")
    narrow = lie("interval", ["-0.77043", "-0.7704"])
    refuses(at(narrow).basin, "may not lie in I")


def test_the_form():
    """Letters other than R and L, too many of them, too much work, other parameters."""
    rejected(lie("kneading", ""), "sequence of at most")
    rejected(lie("kneading", "RLC"), "sequence of at most")
    rejected(lie("kneading", "R" * 9000), "sequence of at most|too much")
    rejected(changed(STORED, "hints", "bits", "4096"), "too much")
    rejected(changed(STORED, "hints", "cell_bits", "63"), "cell_bits")
    rejected(lie("turn", "inflection"), "none of")
    rejected(lie("half_periods", "0"), "half_periods")
    rejected(changed(STORED, "parameters", "f", "0"), "0 < f does not")
    for name in STORED["parameters"]:
        value = Fraction(STORED["parameters"][name]) + Fraction(1, 1000) * (-1) ** (name == "e")
        assert not accepted(changed(STORED, "parameters", name, str(value))), name
    rejected(changed(STORED, "cites", STORED["cites"][1:]), "cites")
    assert attractor.sign(Interval(-1, 1, 64)) == 0
