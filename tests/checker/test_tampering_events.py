"""Certificates with turns, sticks, captures and losses, tampered with number by number.

The flow does not depend on most of what is claimed, so it is computed once for equal arguments.
"""

import copy
import json
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

from cap.checker.flow.events import WORDS
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.periodic import TYPES
from cap.checker.verdict import check
from checker.test_tampering import changed, enclosures, get, leaves, text

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

STORED = Path(__file__).parents[2] / "certificates"
PERIODIC = sorted(STORED.glob("periodic*.json"))
FIXED_POINTS = [*PERIODIC, STORED / "persistence.json"]
OTHERS = {"periodic-2", "periodic-3", "periodic-5", "periodic-6"}  # longer, or as periodic-1
QUICK = [path for path in PERIODIC if path.stem not in OTHERS]
CAPTURES = sorted(STORED.glob("capture*.json"))
# turns, sticks and releases, two periods, every type; captures and losses are in the other files
SOON = {f"periodic-{n}" for n in (4, 8, 9, 11)} | {"persistence"} | {p.stem for p in CAPTURES}


def of(paths):
    """Return a mark for tests of files; those with no kind of event of their own repeat others."""
    repeats = [pytest.mark.beside]
    cases = [pytest.param(p, id=p.stem, marks=repeats * (p.stem not in SOON)) for p in paths]
    return pytest.mark.parametrize("path", cases)


each = {"orbit": of(FIXED_POINTS), "quick": of(QUICK), "capture": of(CAPTURES)}


def load(path):
    """Return a stored certificate; of that of persistence, with many cells, two by two of them."""
    good = json.loads(path.read_text("utf-8"))
    if "range" in good["claims"]:
        claim, hints = good["claims"]["range"], good["hints"]
        width = len(claim["mu"]) - 1
        for part, name in ((claim, "boxes"), (hints, "cells")):
            part[name] = [part[name][n] for n in (0, 1, width, width + 1)]
        for name in ("epsilon", "mu"):
            claim[name] = claim[name][:3]
    return good


def why(certificate):
    """Return why the checker rejects a certificate, for a reason of its own; None if it accepts."""
    try:
        check(json.dumps(certificate).encode(), lambda _step: None)
    except Rejected as reason:
        return str(reason)
    return None


def accepted(good, cases):
    """Return the names of the cases (name, path, value) that are accepted."""
    return [name for name, trail, value in cases if why(changed(good, trail, value)) is None]


def pairs(good, names):
    """Give the paths to the enclosures in these claims."""
    for trail in enclosures(good):
        if trail[-1] == 0 and trail[1] in names and isinstance(get(good, trail[:-1]), list):
            yield trail[:-1]


def without(good, n):
    """Return the certificate without its n-th event, and without all claims about it."""
    bad = copy.deepcopy(good)
    words, claims = good["claims"]["itinerary"], bad["claims"]
    for kind, name in (("hit", "hit_speeds"), ("turn", "turning_factors")):
        if words[n].startswith(kind) and name in claims:
            del claims[name][sum(word.startswith(kind) for word in words[:n])]
    for part in (claims["itinerary"], claims["event_times"], bad["hints"]["events"]):
        del part[n]
    return bad


@each["orbit"]
def test_every_enclosure_about_the_orbit(path):
    """An end moved onto the other, or far out, and the whole moved by its width, is rejected."""
    good = load(path)
    assert why(good) is None
    names = set(good["claims"]) - {"box", "basin", "range", "itinerary", "period", "type"}
    cases = []
    for trail in pairs(good, names):
        low, high = map(Fraction, get(good, trail))
        capture = trail[1] == "event_times" and good["claims"]["itinerary"][trail[2]][:3] == "cap"
        width, far = high - low or Fraction(1, 10**9), Fraction(0 if capture else 10**4)
        for name, ends in (
            ("up", (low + width, high + width)),
            ("down", (low - width, high - width)),
            ("lower", (low, low)),
            ("upper", (high, high)),
            ("far up", (low, high + far * width)),
            ("far down", (low - far * width, high)),
        ):
            if ends != (low, high):
                cases.append(((trail, name), trail, [text(q) for q in ends]))
    assert accepted(good, cases) == []


@each["orbit"]
def test_type_and_period(path):
    """No orbit is of two types, nor closed after another number of periods (here)."""
    good = load(path)
    cases = [(kind, ("claims", "type"), kind) for kind in TYPES if kind != good["claims"]["type"]]
    period = int(good["claims"]["period"])
    cases += [(n, ("claims", "period"), str(n)) for n in {1, period + 1, 2 * period, 16} - {period}]
    assert accepted(good, cases) == []


@each["orbit"]
def test_the_basin(path):
    """A basin larger than the box, flat, or contracted more than it is, is rejected."""
    good = load(path)
    basin = ("claims", "basin")
    if "basin" not in good["claims"]:
        return
    rows = [[Fraction(q) for q in row] for row in good["claims"]["basin"]["matrix"]]
    for name, matrix in (
        ("ten times", [[q / 10 for q in row] for row in rows]),
        ("huge", [[q / 10**30 for q in row] for row in rows]),
        ("one row", [rows[0], rows[0]]),
        ("zero", [[0, 0], [0, 0]]),
        ("nearly flat", [rows[0], [q + Fraction(1, 10**30) for q in rows[0]]]),
    ):
        entries = [[text(q) for q in row] for row in matrix]
        assert why(changed(good, (*basin, "matrix"), entries)), name
    larger = good["claims"]["multipliers"][0]
    parts = [larger] if isinstance(larger, list) else larger.values()
    modulus = max(abs(float(ends[0])) for ends in parts)  # or less: no norm is below it
    for value in (Fraction(1), Fraction(2), -Fraction(1, 2), Fraction(0), Fraction(modulus) / 2):
        assert why(changed(good, (*basin, "contraction"), text(value))), value


@each["quick"]
def test_every_word(path):
    """Each event replaced, left out, or exchanged with the next, is rejected."""
    good = load(path)
    words = good["claims"]["itinerary"]
    survivors = []
    for n, word in enumerate(words):
        others = [w for w in WORDS if w != word and w.split()[0] == word.split()[0]]
        others += ["stick", f"capture {'rl'[n % 2]}", "release left", "release right"]
        cases = [((n, w), ("claims", "itinerary", n), w) for w in others if w != word]
        survivors += accepted(good, cases)
        if len(words) > 1 and why(without(good, n)) is None:
            survivors.append((n, "left out"))
    for n, (one, two) in enumerate(pairwise(words)):
        swapped = [*words[:n], two, one, *words[n + 2 :]]
        if one != two and why(changed(good, ("claims", "itinerary"), swapped)) is None:
            survivors.append((n, "exchanged"))
    assert survivors == []


@each["quick"]
@pytest.mark.parametrize(
    "pair", [("turn right", "turn left"), ("turn left", "turn right"), ("stick", "release left")]
)
def test_two_events_too_many(path, pair):
    """Two stops in a moment, between any two events, are rejected."""
    good = load(path)
    events = good["hints"]["events"]
    starts = ["0", *(high for _, high in events)]
    ends = [*(low for low, _ in events), "6.28"]
    for n, (low, high) in enumerate(zip(map(Fraction, starts), map(Fraction, ends), strict=True)):
        bad = copy.deepcopy(good)
        claims, step = bad["claims"], (high - low) / 1000
        marks = [text(high - k * step) for k in (4, 3, 2, 1)]
        windows = [marks[:2], marks[2:]]
        claims["itinerary"][n:n] = pair
        claims["event_times"][n:n] = windows
        bad["hints"]["events"][n:n] = windows
        turns = sum(word.startswith("turn") for word in claims["itinerary"])
        claims["turning_factors"] = [["0", "1"]] * turns
        assert why(bad), n


@each["quick"]
def test_the_windows(path):
    """A window before or after its event, before 0, after nT, or that of another, is rejected.

    Of a release any window is as good that contains its time.
    """
    good = load(path)
    events, words = good["hints"]["events"], good["claims"]["itinerary"]
    T = Fraction(710, 113) / Fraction(good["parameters"]["omega"]) * int(good["claims"]["period"])
    cases = []
    for n, (low, high) in enumerate([Fraction(q) for q in window] for window in events):
        width = high - low
        beside = {"later": (low + 2 * width, high + 2 * width), "after nT": (low, high + T)}
        beside |= {"earlier": (low - 2 * width, high - 2 * width), "before 0": (low - T, high)}
        beside |= {"a period later": (low + T, high + T), "a point": (low, low)}
        for name, ends in beside.items():
            if not (words[n].startswith("release") and name in ("after nT", "before 0")):
                cases.append(((n, name), ("hints", "events", n), [text(q) for q in ends]))
    cases += [
        ((n, "exchanged"), ("hints", "events"), [*events[:n], two, one, *events[n + 2 :]])
        for n, (one, two) in enumerate(pairwise(events))
    ]
    assert accepted(good, cases) == []


@each["quick"]
def test_the_parameters(path):
    """The claims hold at no other parameters, but for those of a wall that is not hit."""
    good = load(path)
    idle = {"l", "r"} - {word[-1] for word in good["claims"]["itinerary"] if word[:3] == "hit"}
    cases = [
        ((name, step), ("parameters", name), text(Fraction(value) + step))
        for name, value in good["parameters"].items()
        for step in (Fraction(1, 10**20), -Fraction(1, 10**20))
        if name not in idle
    ]
    assert accepted(good, cases) == []


@each["quick"]
def test_other_hints(path):
    """Hints far off prove nothing."""
    good = load(path)
    hints = {key: good["hints"][key] for key in ("centre", "radius", "preconditioner")}
    cases = []
    for trail in leaves(hints):
        value = 1000 * Fraction(get(hints, trail)) + 1000
        cases.append((trail, ("hints", *trail), text(value)))
    cases += [("none", ("hints", "radius"), "0"), ("less", ("hints", "radius"), "-1/1000")]
    assert accepted(good, [*cases, ("bits", ("hints", "bits"), "64")]) == []


@each["capture"]
def test_captures(path):
    """Every end moved inwards past what is computed, and every claim moved as a whole."""
    good = load(path)
    words, claims = good["claims"]["itinerary"], good["claims"]
    cases = []
    for trail in pairs(good, ("forcing", "accumulation_time", "release_time", "event_times")):
        low, high = map(Fraction, get(good, trail))
        width = high - low
        released = width < Fraction(1, 10**9)  # its time is known, and its claim rounded outwards
        for part in (1 if released else Fraction(1, 4), 2, -2, 1000):
            ends = [text(low + part * width), text(high + part * width)]
            cases.append(((trail, part), trail, ends))
    ratio = Fraction(claims["ratio"])
    cases += [
        (("ratio", q), ("claims", "ratio"), text(q)) for q in (ratio * 99 / 100, 0, -ratio, 1, 2)
    ]
    cases += [("wall", ("claims", "wall"), "l" if claims["wall"] == "r" else "r")]
    for n, word in enumerate(words):
        cases += [((n, w), ("claims", "itinerary", n), w) for w in WORDS if w != word]
    assert accepted(good, cases) == []
    assert [n for n in range(len(words)) if why(without(good, n)) is None] == []


@each["capture"]
def test_the_window_of_a_capture(path):
    """Until the force may be too weak, or pushes again, too short, too late, or inverted."""
    good = load(path)
    n = len(good["hints"]["events"]) - 2
    low, high = map(Fraction, good["hints"]["events"][n])
    T = Fraction(710, 113) / Fraction(good["parameters"]["omega"])
    out = Fraction(good["claims"]["release_time"][0])
    for ends in (
        (low, out),
        (low, low + T / 2),
        (low, high + T),
        (low - T, high),
        (low + T, high + T),
        (low, low),
        (low, low + (high - low) / 2),
        (high, low),
    ):
        bad = changed(good, ("hints", "events", n), [text(q) for q in ends])
        assert why(bad), ends
    if n:
        later = Fraction(good["hints"]["events"][n - 1][1])
        bad = changed(good, ("hints", "events", n), [text(later), text(high)])
        assert why(bad) == "the window of a capture begins after the hit before it"


@each["capture"]
def test_the_box_of_a_capture(path):
    """Beyond the walls, without interior, farther or faster than the lemma allows."""
    good = load(path)
    for axis in ("x", "v"):
        low, high = map(Fraction, good["claims"]["box"][axis])
        width = high - low
        for ends in (
            (low - 30 * width, high),
            (low, high + 30 * width),
            (low, low),
            (high, low),
            (low + 40 * width, high + 40 * width),
        ):
            bad = changed(good, ("claims", "box", axis), [text(q) for q in ends])
            assert why(bad), (axis, ends)


@each["capture"]
def test_the_system_of_a_capture(path):
    """Too weak a force, no loss at all, too much viscosity, walls too near: rejected."""
    good = load(path)
    F, r, l = (Fraction(good["parameters"][name]) for name in ("F", "r", "l"))
    cases = [
        ("f", F * 99 / 100),
        ("f", F),
        ("mu", 10**3),
        ("mu", -1),
        ("e", 0),
        ("e", Fraction(11, 10)),
        ("F", F * 2),
        ("omega", 10),
        ("omega", 0),
        ("l", r - Fraction(1, 10**5)),
        ("r", r + Fraction(1, 100)),
        ("r", l),
    ]
    for name, value in cases:
        assert why(changed(good, ("parameters", name), text(value))), (name, value)
    elastic = {**good["parameters"], "f": "0", "e": "1"}
    assert why(changed(good, ("parameters",), elastic))


def test_the_range():
    """Grid, boxes and cells of a persistence certificate."""
    good = load(STORED / "persistence.json")
    assert why(good) is None
    claim, cells = good["claims"]["range"], good["hints"]["cells"]
    boxes = claim["boxes"]
    for name in ("epsilon", "mu"):
        nodes = claim[name]
        for bad in (
            ["1/100000", *nodes[1:]],
            ["-1/100000", *nodes[1:]],
            [nodes[0], nodes[0], *nodes[2:]],
            [nodes[0], nodes[2], nodes[2]],
            [nodes[1], nodes[0], *nodes[2:]],
            nodes[::-1],
            [*nodes[:-1], "1"],
            [*nodes[:-1], text(2 * Fraction(nodes[-1]))],
            nodes[:-1],
            [*nodes, text(2 * Fraction(nodes[-1]))],
        ):
            assert why(changed(good, ("claims", "range", name), bad)), (name, bad)
        last = Fraction(nodes[-1])
        key, outside = ("e", 1 - 2 * last) if name == "epsilon" else ("mu", 2 * last)
        assert why(changed(good, ("parameters", key), text(outside)))
    last = len(boxes) - 1
    for axis in ("x", "v"):
        low, high = map(Fraction, boxes[0][axis])
        for ends in ((low, (low + high) / 2), (low - 1, high), (low, high + 1), (high, high + 1)):
            bad = changed(good, ("claims", "range", "boxes", 0, axis), [text(q) for q in ends])
            assert why(bad), (axis, ends)
    swapped = [boxes[last], *boxes[1:last], boxes[0]]
    assert why(changed(good, ("claims", "range", "boxes"), swapped))
    both = changed(good, ("claims", "range", "boxes"), swapped)
    both["hints"]["cells"] = [cells[last], *cells[1:last], cells[0]]
    assert why(both)
    away = Fraction(cells[0]["centre"][0]) + Fraction(1, 10)
    assert why(changed(good, ("hints", "cells", 0, "centre", 0), text(away)))
    events = [*cells[0]["events"][1:], cells[0]["events"][0]]
    assert why(changed(good, ("hints", "cells", 0, "events"), events))
